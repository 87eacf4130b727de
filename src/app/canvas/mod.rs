//! The canvas: the picture, with handles to select and drag.
//!
//! | file | holds |
//! |---|---|
//! | `view` | zoom and pan: the map between film pixels and screen points |
//! | `projection` | the pinhole camera: the map between world space and film pixels |
//! | `pixels` | the grid and the numbers of magnified pixels |
//! | `split` | a second picture to the right of a line |
//! | `drag` | the position of a dragged handle |
//! | `picking` | the surfaces of the objects, and the nearest along a ray |
//! | `free_space` | [`free_ball`]: the place of a new item in the picture |
//! | `visibility` | which handles the camera sees |
//! | `normal` | the surface normal at the selection |
//! | `sight` | [`Sight`](sight::Sight): surfaces, welded points and visibility, kept from frame to frame |
//! | `stage` | the handles on the screen, and which handles a click or drag affects |
//! | `gizmo` | arrows and squares on the selection |
//! | `scenery` | handles and gizmo of one frame, and what a press takes |
//! | `snap` | the grid that drags snap to |
//! | `falloff` | soft selection: how far neighbours follow |
//! | `movement` | a move of handles from its first to its last frame |
//! | `nudge` | moves by arrow keys |
//! | `rectangle` | selection of control points by a rectangle |
//! | `navigation` | [`Navigation`](navigation::Navigation): drags and the wheel move the camera |
//! | `overlay` | painting of control nets, handles, gizmo and drag axes |
//! | `readout` | the way of a drag in numbers |
//! | `handle_widgets` | tooltips and accessible names of handles and gizmo |
//! | `steering` | the keys that steer a drag, and where it ends |
//! | `grasp` | [`Grasp`](grasp::Grasp): pointer and keys on handles and gizmo |
//! | `analysis/` | isolines, curvature and reflection lines of the selected surface |
//! | `light_paths/` | what light does at the selected surface of mirror or glass |
//! | `widget` | [`Canvas`]: pointer and keyboard input on the picture |

mod analysis;
mod drag;
mod falloff;
mod free_space;
mod gizmo;
mod grasp;
mod handle_widgets;
mod light_paths;
mod movement;
mod navigation;
mod normal;
mod nudge;
mod overlay;
mod picking;
mod pixels;
mod projection;
mod readout;
mod rectangle;
mod scenery;
mod sight;
mod snap;
mod split;
mod stage;
mod steering;
mod view;
mod visibility;
mod widget;

pub(crate) use analysis::{Analysis, Shading};
pub(crate) use free_space::{Aim, free_ball};
pub(crate) use projection::Projection;
pub(crate) use snap::{automatic_step, steps_around};
#[cfg(test)]
pub(crate) use view::View;
pub(crate) use widget::{Canvas, Picture};
