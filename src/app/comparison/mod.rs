//! Snapshots of the picture, and comparisons of two pictures.
//!
//! | file | holds |
//! |---|---|
//! | `snapshot` | [`Snapshot`]: a picture with its scene, error and time |
//! | `folder` | the folder beside a scene that keeps its snapshots |
//! | `difference` | the difference of two pictures in false colours and in numbers |
//! | `snapshots` | [`Snapshots`]: all snapshots of the window, and what is compared how |
//! | `thumbnail` | a small picture of a snapshot |
//! | `strip` | the strip of snapshots |

mod difference;
mod folder;
mod snapshot;
mod snapshots;
mod strip;
mod thumbnail;

pub(crate) use folder::{read_snapshots, write_snapshots};
pub(crate) use snapshot::Snapshot;
pub(crate) use snapshots::{Shown, Snapshots};
pub(crate) use strip::strip_ui;
