//! Bicubic Bezier patches: evaluate, subdivide, bound, intersect, tessellate.

mod bpt;
mod cubic;
mod net;
mod normal;
mod patch;
mod ray_net;
mod search;

pub use bpt::{BptError, BptProblem, read_bpt, write_bpt};
pub use net::{ControlNet, Derivatives};
pub use patch::{Patch, PatchHit};
