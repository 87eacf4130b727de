//! The camera that the window shows the scene with. Knows no widget.
//!
//! | file | holds |
//! |---|---|
//! | `turntable` | orbit, pan and dolly of a camera whose up axis stays |
//! | `extent` | the balls that enclose the selection or all objects |

mod extent;
mod turntable;

pub(crate) use extent::{center, of_selection};
pub(crate) use turntable::{dollied, moved, orbited};
