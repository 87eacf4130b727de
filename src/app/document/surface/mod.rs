//! Operations on the patches of an object. Positions are in object space, unless a function says world space.
//!
//! | file | holds |
//! |---|---|
//! | `connectivity` | control points at one position, edges, seams |
//! | `mirror` | [`Mirror`]: the plane of a symmetry, and the partner of each position |
//! | `tangents` | tangent planes across seams, kept while control points move |
//! | `coupling` | [`Coupling`]: which control points follow the moved ones |
//! | `split` | exact splitting of patches and of strips of patches |
//! | `thicken` | closed bodies from open sheets |
//! | `plane_fit` | the plane nearest to points |
//! | `fairing` | flattening, smoothing and resetting of control points |

mod connectivity;
mod coupling;
mod fairing;
mod mirror;
mod plane_fit;
mod split;
mod tangents;
mod thicken;

pub(crate) use coupling::Coupling;
pub(crate) use fairing::{flattened, reset, smoothed};
pub(crate) use mirror::Mirror;
pub(crate) use split::{Cut, split};
pub(crate) use thicken::{thickened, usual_thickness};
