//! The window's content, without the window and without the engine.
//!
//! | file | holds |
//! |---|---|
//! | `opened_scene` | a scene file that was opened before a question |
//! | `state` | [`Editor`]: all that the window shows and remembers |
//! | `views` | changes the camera that the window shows the scene with |
//! | `path_request` | asks the user for a path, by file dialog or by path field |
//! | `comparing` | takes, compares, restores and keeps snapshots |
//! | `inspecting` | shows what the picture measures, writes profiles |
//! | `scenes` | opens, saves and leaves scenes |
//! | `recovery` | writes unsaved changes, and recovers those of former windows |
//! | `preferences` | applies and remembers the looks of the window |
//! | `keeping` | what the editor keeps in the user's folders |
//! | `outside` | follows changes of the scene's files by other programs |
//! | `chosen_path` | uses a chosen path: open, save, export, add |
//! | `selecting` | selects control points |
//! | `shaping` | operations on the patches of the selected object |
//! | `adding` | adds objects and lights where the camera looks |
//! | `apply` | the one place that carries out commands |
//! | `layout` | draws the content, then carries out the commands that its parts push |

mod adding;
mod apply;
mod chosen_path;
mod comparing;
mod inspecting;
mod keeping;
mod layout;
mod opened_scene;
mod outside;
mod path_request;
mod preferences;
mod recovery;
mod scenes;
mod selecting;
mod shaping;
mod state;
mod views;

#[cfg(test)]
mod tests;

pub(crate) use state::Editor;
