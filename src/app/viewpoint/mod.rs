//! The camera that the window shows the scene with. Knows no widget.
//!
//! | file | holds |
//! |---|---|
//! | `named_view` | [`NamedView`]: the views that the user asks for by name |
//! | `turntable` | orbit, pan and dolly of a camera whose up axis stays |
//! | `extent` | the balls that enclose the selection or all objects |
//! | `sides` | front, right, top, opposite |
//! | `framing` | the camera that shows balls as large as the picture holds them |
//! | `visited` | [`Visited`]: back and forward through views |
//! | `seen` | [`Viewpoint`]: the scene with the document's camera and film size, or with the window's own |
//! | `resting_size` | [`RestingSize`]: whether the canvas still changes its size |

mod extent;
mod framing;
mod named_view;
mod resting_size;
mod seen;
mod sides;
mod turntable;
mod visited;

pub(crate) use extent::{center, of_objects, of_selection};
pub(crate) use framing::framed;
pub(crate) use named_view::{NamedView, Side};
pub(crate) use resting_size::{REST, RestingSize};
pub(crate) use seen::Viewpoint;
pub(crate) use sides::seen_from;
pub(crate) use turntable::{dollied, moved, orbited};
pub(crate) use visited::Visited;
