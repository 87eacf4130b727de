//! The canvas: the picture, with handles to select and drag.
//!
//! | file | holds |
//! |---|---|
//! | `view` | zoom and pan: the map between film pixels and screen points |
//! | `projection` | the pinhole camera: the map between world space and film pixels |
//! | `pixels` | the grid and the numbers of magnified pixels |
//! | `drag` | the position of a dragged handle |
//! | `picking` | the nearest object under a film point |
//! | `stage` | the handles on the screen, and which handles a click or drag affects |
//! | `navigation` | [`Navigation`](navigation::Navigation): drags and the wheel move the camera |
//! | `overlay` | painting of control nets, handles and drag axes |
//! | `widget` | [`Canvas`]: pointer and keyboard input on the picture |

mod drag;
mod navigation;
mod overlay;
mod picking;
mod pixels;
mod projection;
mod stage;
mod view;
mod widget;

pub(crate) use projection::Projection;
#[cfg(test)]
pub(crate) use view::View;
pub(crate) use widget::{Canvas, Picture};
