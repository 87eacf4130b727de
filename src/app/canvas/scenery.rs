//! The handles and the gizmo of one frame, and what a press of the pointer takes.

use super::gizmo::{Gizmo, Part};
use super::normal;
use super::stage::{self, Look, ScreenHandle, Stage};
use crate::app::document::Handle;
use egui::Pos2;
use glam::DVec3;

/// Distance from a visible handle within which it comes before the gizmo, screen points.
const DOT: f32 = 5.0;

/// The handles and the gizmo of one frame.
pub(crate) struct Scenery {
    pub(crate) drawn: Vec<ScreenHandle>,
    pub(crate) gizmo: Option<Gizmo>,
    /// The surface normal at the selection.
    pub(crate) normal: Option<DVec3>,
}

/// What a press of the pointer takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Target {
    Handle(Handle),
    Part(Part),
}

impl Scenery {
    /// The handles and the gizmo on the stage.
    pub(crate) fn new(stage: &Stage<'_>) -> Self {
        let normal = normal::at_selection(stage.document.scene(), &stage.document.selection);
        let center = stage.mean_position(&stage.selected_handles()).filter(|_| stage.shows_handles);
        let gizmo = center.and_then(|center| Gizmo::new(stage, center, normal));
        Self { drawn: stage.handles(), gizmo, normal }
    }

    /// What a press at a screen point takes: a visible handle right there, or else a part of the gizmo, or else a handle nearby.
    pub(crate) fn target(&self, at: Pos2) -> Option<Target> {
        let handle = || stage::grabbed(&self.drawn, at).map(Target::Handle);
        let part = || self.gizmo.as_ref()?.part_at(at).map(|part| Target::Part(part.part));
        let is_dot = |drawn: &ScreenHandle| drawn.look != Look::Hidden && drawn.screen.distance(at) <= DOT;
        if self.drawn.iter().any(is_dot) { handle() } else { part().or_else(handle) }
    }
}
