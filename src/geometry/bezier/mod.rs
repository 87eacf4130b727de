//! Bicubic Bezier patches: evaluate, subdivide, bound, intersect, tessellate.

mod bending;
mod bpt;
mod cubic;
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
