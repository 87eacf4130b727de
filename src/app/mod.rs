//! The window: shows the scene while it converges and lets the user change it.
//!
//! Frames come in from the engine, commands go out to it. Panels, canvas and menus read the document and push
//! commands; the editor alone carries them out.
//!
//! A module uses only modules above it in this table.
//!
//! | module | holds |
//! |---|---|
//! | `theme` | every colour of the window |
//! | `keyboard` | corrections of egui's handling of keys |
//! | `document` | the edited scene: selection, handles, edits, undo |
//! | `viewpoint` | the camera that the window shows the scene with: orbit, framing, looking around |
//! | `commands` | every request of the user, as data |
//! | `keeping` | what outlives the window: unsaved changes, recent files, preferences; files that other programs change |
//! | `rendering` | the engine as the window sees it: commands out, frames in, the texture |
//! | `canvas` | the picture with its handles: zoom, pick, drag |
//! | `panels` | the side panels: outline, properties, progress |
//! | `inspection` | what the picture measures: irradiance, error, distance; albedo and normals |
//! | `comparison` | snapshots of the picture, and comparisons of two pictures |
//! | `files` | file dialogs, typed paths, exports |
//! | `shell` | menu bar, status bar, notices, dialogs |
//! | `editor` | all that the window shows and remembers, the one `apply`, the layout |
//! | `window` | the editor in a window of the desktop, with an engine |
//! | `startup` | from a scene to an open window, or to a clear message |
//! | `drag_replay` | a drag in a real window, with measurements of the window's thread |

mod canvas;
mod commands;
mod comparison;
mod document;
mod drag_replay;
mod editor;
mod files;
mod inspection;
mod keeping;
mod keyboard;
mod panels;
mod rendering;
mod shell;
mod startup;
mod theme;
mod viewpoint;
mod window;

pub use drag_replay::{WindowFrame, replay_drag};
pub use startup::{AppError, run};
