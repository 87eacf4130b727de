//! Menus, messages and dialogs around the picture. Each is a function of the data that it shows, and pushes commands.
//!
//! | file | holds |
//! |---|---|
//! | `menu_item` | the entries of menus |
//! | `surface_menu` | the menu of operations on the patches of the selected object |
//! | `inspect_menu` | the menu of what the canvas shows, profiles and comparisons |
//! | `menu` | the menu bar, with buttons for frequent actions |
//! | `notices` | messages over the picture: failures, problems of the scene, a lack of light, a slow file dialog |
//! | `status_bar` | engine status, counts, the pixel under the pointer, the zoom |
//! | `history` | the list of undo steps |
//! | `guide` | the guide |
//! | `drop_hint` | what a file that is dragged over the window will do |
//! | `first_hint` | the hint for a first start |
//! | `palette` | the command palette: every action, item and example by its name |
//! | `primary` | the first button of a dialog |
//! | `recovery` | the dialog about unsaved changes of former windows |
//! | `dialogs` | modal dialogs: unsaved changes, recovery, errors, paths, surface export, help, the palette |

mod dialogs;
mod drop_hint;
mod first_hint;
mod guide;
mod history;
mod inspect_menu;
mod menu;
mod menu_item;
mod notices;
mod palette;
mod primary;
mod recovery;
mod status_bar;
mod surface_menu;

pub(crate) use dialogs::{Dialog, dialog_ui};
pub(crate) use drop_hint::{drop_hint, drop_hint_ui};
pub(crate) use first_hint::first_hint_ui;
pub(crate) use guide::guide_ui;
pub(crate) use history::history_ui;
pub(crate) use menu::{Visibility, menu_ui};
pub(crate) use notices::{looking_ui, notices_ui};
pub(crate) use palette::Palette;
pub(crate) use status_bar::status_bar_ui;
