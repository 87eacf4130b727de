//! Light sheets: where the light of a point lands after mirrors and glass alone is a function of its direction. That function is smooth in
//! pieces, one **light sheet** for each sequence of surfaces. Traced on a lattice of directions, a cell of the lattice becomes
//! a small quadrilateral on the receiver, which holds exactly the light of the cell \[Watt90\].
//!
//! Every path counts once: a cell claims a sequence of surfaces, and photons of the cell that took that sequence leave nothing. Where the
//! corners of the smallest cells took different ways, nothing is claimed, and photons bring the light.
//!
//! | file | holds |
//! |---|---|
//! | `query` | `SheetQuery`: a point that asks for the light of sheets |
//! | `coverage` | how much of a triangle lies in a square |
//! | `landing` | `Landing`: where the light of one ray lands, along all branches |
//! | `regions` | `Regions`: which sequences each part of the lattice claims, and where photons still have to go |
//! | `tree` | `BoxTree`: the cells near a point |
//! | `cell` | `SheetCell`: the light of one cell where it lands |
//! | `smoothness` | how well quadrilaterals follow the map from direction to landing place |
//! | `subdivision` | a quadtree of directions, divided until its cells are smooth |
//! | `sheets` | `LightSheets`: all sheets of an iteration, and the light that they bring to a point |

mod cell;
mod coverage;
mod landing;
mod query;
mod regions;
mod sheets;
mod smoothness;
mod subdivision;
mod tree;

pub(in crate::transport) use query::SheetQuery;
pub use sheets::LightSheets;
pub(in crate::transport) use sheets::SheetsOfLight;
pub(in crate::transport) use subdivision::{Divided, Lattice};
