//! Sheets: the patches of an object that make one smooth surface, over whose seams a density estimate goes on.
//!
//! Bodies of glass are made of whole objects and may have creases; a sheet has no inside. The two meet in the control points alone:
//! edges are made equal before bodies are read.
//!
//! | file | holds |
//! |---|---|
//! | `shared_edges` | [`SharedEdges`] of a patch with its sheet |
//! | `edge` | an edge of a patch, and how near another one must be to be the same |
//! | `union_find` | sets of control points, and of patches with normals on either side |
//! | `seam` | pairs of edges at the same place |
//! | `weld` | makes the control points of such edges equal |
//! | `sheet` | from the patches of an object to its sheets |

mod edge;
mod seam;
mod shared_edges;
mod sheet;
mod union_find;
mod weld;

pub use shared_edges::SharedEdges;
pub(super) use sheet::{Place, welded_sheets};
