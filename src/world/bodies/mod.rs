//! Bodies of glass: which of them contain a point, and which of these counts.
//!
//! | file | holds |
//! |---|---|
//! | `media` | [`Media`]: the bodies around a point of a path |
//! | `crossings` | the points in which a line crosses a surface |
//! | `body` | [`Body`]: one piece of glass |
//! | `group` | from the objects of a scene to bodies in the order of their rank |
//! | `origin` | [`Origin`]: the media in which paths begin |
//! | `contact` | [`Contacts`]: surfaces that coincide |

mod body;
mod contact;
mod crossings;
mod group;
mod media;
mod origin;

pub use body::Body;
pub use contact::Contacts;
pub(super) use contact::touching;
pub(super) use crossings::{point_of, spread};
pub(super) use group::bodies;
pub use media::Media;
pub use origin::Origin;
pub(super) use origin::Surroundings;
