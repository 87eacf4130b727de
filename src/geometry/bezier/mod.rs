//! Bicubic Bezier patches: evaluate, subdivide, bound, intersect, tessellate.
//!
//! How a ray finds its nearest hit: `unit` carries it into a space in which the patch has unit size; `tree` leads it through
//! boxes to packets of eight parts, into which `bending` had the patch cut; `packet` meets it with the paraboloids that
//! stand for them, which tell where there may be a root, and mostly that it is the only one; `newton` finds it and proves
//! it; `search` halves those parts of which the paraboloids tell nothing. `together` does the same for eight rays at once.

mod bending;
mod bpt;
mod cubic;
mod lineup;
mod mesh;
mod net;
mod newton;
mod node;
mod normal;
mod packet;
mod paraboloid;
mod patch;
mod power;
mod ray_net;
mod row;
mod row_net;
mod search;
mod surface;
mod together;
mod traverse;
mod tree;
mod unit;

pub use bpt::{BptError, BptProblem, read_bpt, write_bpt};
pub use mesh::QuadMesh;
pub use net::{ControlNet, Derivatives};
pub use patch::{Patch, PatchHit};
pub use surface::Curvature;
