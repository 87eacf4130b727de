//! Rays against a patch in unit space.
//!
//! | file | holds |
//! |---|---|
//! | `prepared` | `PreparedPatch`: the forms of a patch that intersection reads |
//! | `query` | `RayQuery`: the state of one ray, its nearest hit so far |
//! | `traversal` | one ray through the tree |
//! | `ray_packet` | a packet of eight rays through the tree |
//! | `subdivision` | roots where the paraboloids do not decide |
//! | `ray_aligned_net` | `RayAlignedNet`: a control net in the coordinates of a ray |
//! | `newton` | Newton's method, and the proof that a root is unique |
//! | `power` | `PowerForm`: a patch as Newton's method evaluates it |

mod newton;
mod power;
mod prepared;
mod query;
mod ray_aligned_net;
mod ray_packet;
mod subdivision;
mod traversal;

pub(super) use prepared::PreparedPatch;
pub(super) use query::Hit;
pub(super) use ray_packet::nearest_hit_of_each;
pub(super) use traversal::{has_hit, nearest_hit};
