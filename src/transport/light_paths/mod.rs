//! Light paths: what a designer reads from a surface of mirror or glass. Each point `S(u, v)` of a patch that a light shines on sends the
//! light on to a **landing place**; the map from (u, v) to the landing place shows the shape of the patch.
//!
//! A way follows the strongest branch alone: reflected at mirrors, refracted at glass, reflected where reflection is total. Lights with an
//! extent shine from their centre, suns in the direction of their axis.
//!
//! | file | holds |
//! |---|---|
//! | `polyline` | [`Polyline`]: a curve in the room, and which of its points the camera sees |
//! | `source` | `Source`: a light and a patch; the way of the light through a point of the patch |
//! | `images` | the images of lines of equal u and v on the surfaces where their light lands |
//! | `edges` | the edges of the caustic: where the map from (u, v) to the landing place folds |
//! | `all` | [`LightPaths`] of a surface |

mod all;
mod edges;
mod images;
mod polyline;
mod source;

pub use all::{LightPaths, light_paths};
pub use polyline::Polyline;
