//! Requests of the user, as data.
//!
//! | file | holds |
//! |---|---|
//! | `action` | commands without parameters, with their labels and keys in one table |
//! | `purpose` | the purposes of a file: open, save, export, add |
//! | `length_unit` | the name of the unit of lengths |
//! | `comparison` | ways to compare two pictures, requests to snapshots |
//! | `picture_view` | [`PictureView`]: what the canvas shows of the scene |
//! | `command` | [`AppCommand`]: every request that a widget or key can make |

pub(crate) mod action;
mod command;
mod comparison;
mod length_unit;
mod picture_view;
mod purpose;

pub(crate) use action::Action;
pub(crate) use command::{Answer, AppCommand, Next};
pub(crate) use comparison::{Comparison, SnapshotCommand};
pub(crate) use length_unit::LengthUnit;
pub(crate) use picture_view::{COMPONENTS, PictureView};
pub(crate) use purpose::Purpose;
