//! The photon map: a kd-tree with spatial-median splits over photons in Morton order, eight children a node.
//!
//! Every node keeps the moments of its children's photons. The kernel is quadratic, so the moments give the sum over a child
//! inside the disc without a visit to its photons.
//!
//! | file | holds |
//! |---|---|
//! | `node` | nodes, moments and leaves in structure-of-arrays form |
//! | `morton` | sorting along a space-filling curve |
//! | `build` | construction |
//! | `query` | the disc of a density estimate, in every SIMD lane |
//! | `map` | the map and its sums over discs |

mod build;
mod map;
mod morton;
mod node;
mod query;

pub use map::PhotonMap;
pub(in crate::transport) use map::Stack;
pub use query::Query;

#[cfg(test)]
mod tests;
