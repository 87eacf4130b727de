//! The scene that the user edits.
//!
//! | file | holds |
//! |---|---|
//! | `selection` | the selected item and control points |
//! | `names` | names that are unique among the items of a kind |
//! | `handles` | the draggable points of a scene: which exist, where they lie, how they move |
//! | `welds` | [`Welds`]: the welded control points of an object |
//! | `growth` | sets of control points to select: all, rows, columns |
//! | `profile` | operations on the profile of a surface of revolution |
//! | `surface/` | operations on the patches of an object, and which control points move together |
//! | `placement` | the places and sizes of new items |
//! | `edit` | [`Edit`]: every change of a scene, as data |
//! | `changed_field` | the field that an edit changes |
//! | `edit_name` | the names of edits in menus and in the history |
//! | `history` | undo and redo of whole states |
//! | `kinds` | the kinds of shapes, lights, materials and textures: names, and conversions |
//! | `presets` | materials with the parameters of real glass, metals and paint |
//! | `new_items` | the items that "Add", "Duplicate" and "New scene" create |
//! | `mirror_copy` | mirror images of objects and lights |
//! | `stamp` | the state of a file on disk |
//! | `state` | [`Document`]: the scene with its file, selection and history |

mod changed_field;
mod edit;
mod edit_name;
mod growth;
pub(crate) mod handles;
mod history;
pub(crate) mod kinds;
mod mirror_copy;
mod names;
pub(crate) mod new_items;
mod placement;
pub(crate) mod presets;
pub(crate) mod profile;
mod selection;
mod stamp;
mod state;
pub(crate) mod surface;
mod welds;

pub(crate) use edit::{Edit, texture_names, user_of};
pub(crate) use growth::{Direction, all_points, profile_points, with_lines};
pub(crate) use handles::Handle;
pub(crate) use mirror_copy::mirror_copy;
pub(crate) use new_items::NewItem;
pub(crate) use selection::{Item, PointIndex, Selection};
pub(crate) use stamp::Stamp;
pub(crate) use state::Document;
pub(crate) use welds::Welds;
