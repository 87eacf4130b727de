//! Requests of the user, as data.
//!
//! | file | holds |
//! |---|---|
//! | `action` | commands without parameters, with their labels and keys in one table |
//! | `command` | [`AppCommand`]: every request that a widget or key can make |

pub(crate) mod action;
mod command;

pub(crate) use action::Action;
pub(crate) use command::{Answer, AppCommand, Next};
