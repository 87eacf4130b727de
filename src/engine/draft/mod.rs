//! Quick first pictures of a scene that was edited: drafts with few pixels, and what the picture before the edit tells about the others.
//!
//! An edit leaves most of the light as it was. The picture before it has converged, so where the edit changes the light smoothly or not at
//! all, that picture is shown, times the change. A draft of the scene after the edit over a draft of the scene before it, with the same
//! random numbers, is the change: noise that both have in common cancels. Elsewhere the draft itself is shown.
//!
//! | file | holds |
//! |---|---|
//! | `image` | a draft |
//! | `pace` | how coarse drafts are |
//! | `grid` | positions between the middles of pixels |
//! | `upsampling` | the light of a draft at more pixels than it has |
//! | `change` | how the light has changed between two drafts |
//! | `reprojection` | where a camera that has moved saw before what it sees now |
//! | `preview` | a draft, and the picture before the edit where that stands in for it |

mod change;
mod grid;
mod image;
mod pace;
mod preview;
mod reprojection;
mod upsampling;

pub use image::Draft;
pub(super) use pace::DraftPace;
pub(super) use preview::{Before, Preview};
pub(super) use upsampling::{Upsampling, detail_coarseness};
