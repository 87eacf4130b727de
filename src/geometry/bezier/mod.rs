//! Bicubic Bezier patches: evaluate, subdivide, bound, intersect, tessellate.

mod net;
pub use net::ControlNet;
