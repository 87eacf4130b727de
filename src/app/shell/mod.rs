//! Around the picture: menus, messages and dialogs. Each is a function of the parts that it shows, and pushes commands.
//!
//! | file | holds |
//! |---|---|
//! | `menu` | the menu bar with its buttons |
//! | `notices` | messages over the picture: failures, problems of the scene, a slow file dialog |
//! | `status_bar` | engine status, counts, the pixel under the pointer, the zoom |
//! | `dialogs` | modal dialogs: unsaved changes, errors, paths, surface export, help |

mod dialogs;
mod menu;
mod notices;
mod status_bar;

pub(crate) use dialogs::{Dialog, dialog_ui, dropped_files};
pub(crate) use menu::menu_ui;
pub(crate) use notices::notices_ui;
pub(crate) use status_bar::status_bar_ui;
