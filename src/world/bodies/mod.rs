//! Bodies of glass: which of them contain a point, and which body's medium applies.
//!
//! | file | holds |
//! |---|---|
//! | `media` | [`Media`]: the bodies around a point of a path |
//! | `crossings` | the points in which a line crosses a surface |
//! | `body` | [`Body`]: one piece of glass |
//! | `group` | from the objects of a scene to bodies in the order of their rank |
//! | `surroundings` | the bodies around a point |
//! | `light_media` | [`LightMedia`]: the media in which the paths of a light begin |
//! | `coincidence` | whether two primitives coincide over an area |
//! | `contact` | [`Contacts`]: surfaces that coincide |

mod body;
mod coincidence;
mod contact;
mod crossings;
mod group;
mod light_media;
mod media;
mod surroundings;

pub use body::Body;
pub(super) use coincidence::{TOUCHING, touching};
pub use contact::Contacts;
pub(super) use crossings::{point_of, spread};
pub(super) use group::bodies;
pub use light_media::LightMedia;
pub use media::Media;
pub(super) use surroundings::Surroundings;
