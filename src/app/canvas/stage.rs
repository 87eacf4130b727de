//! The scene on the canvas in one frame: where handles are, and which handles a click or drag affects.

use super::projection::Projection;
use super::view::ScreenTransform;
use crate::app::document::{Document, Handle, Selection, handles};
use egui::{Pos2, Rect, Vec2};
use glam::DVec3;
use std::collections::BTreeSet;

/// Side of the square around a handle that takes the pointer, screen points.
const GRAB_SIZE: f32 = 16.0;

/// Distance from a handle at which a press outside of every square still means the handle, screen points.
const REACH: f32 = 14.0;

/// The document with its transforms to the screen, for one frame of the canvas.
pub(crate) struct Stage<'a> {
    pub(crate) document: &'a Document,
    pub(crate) transform: ScreenTransform,
    pub(crate) projection: Projection,
}

/// A handle on the screen.
pub(crate) struct ScreenHandle {
    pub(crate) handle: Handle,
    /// The handle's centre, screen points.
    pub(crate) screen: Pos2,
    /// Depth in front of the camera, scene units.
    depth: f64,
}

impl ScreenHandle {
    /// The area that takes the pointer, screen points.
    pub(crate) fn grab_rect(&self) -> Rect {
        Rect::from_center_size(self.screen, Vec2::splat(GRAB_SIZE))
    }
}

/// The handle that a press at `at` grabs: the topmost of the handles whose square contains `at`, or else the nearest within
/// reach; `None` away from all handles.
pub(crate) fn grabbed(drawn: &[ScreenHandle], at: Pos2) -> Option<Handle> {
    let distance = |handle: &&ScreenHandle| handle.screen.distance(at);
    // The last handle is on top.
    let exact = drawn.iter().rev().find(|handle| handle.grab_rect().contains(at));
    let near =
        || drawn.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).filter(|near| distance(near) <= REACH);
    exact.or_else(near).map(|handle| handle.handle)
}

impl Stage<'_> {
    /// The screen point of a world point; `None` behind the camera.
    pub(crate) fn screen(&self, world: DVec3) -> Option<Pos2> {
        self.projection.project(world).map(|film| self.transform.to_screen(film))
    }

    /// Whether the selection contains the handle's control point or item.
    pub(crate) fn is_selected(&self, handle: Handle) -> bool {
        let selection = &self.document.selection;
        match handle {
            Handle::Point { point, .. } => selection.item == handle.item() && selection.points.contains(&point),
            Handle::Object(_) | Handle::Light(_) => selection.item == handle.item(),
        }
    }

    /// The handles on the canvas, farthest first: the nearest is drawn on top and takes the pointer first.
    pub(crate) fn handles(&self) -> Vec<ScreenHandle> {
        let scene = self.document.scene();
        let mut drawn: Vec<ScreenHandle> = Vec::new();
        for handle in handles::visible(scene, self.document.selection.item) {
            let Some(world) = handle.position(scene) else { continue };
            let Some(screen) = self.screen(world) else { continue };
            if self.transform.canvas.contains(screen) {
                drawn.push(ScreenHandle { handle, screen, depth: self.projection.depth(world) });
            }
        }
        drawn.sort_by(|a, b| b.depth.total_cmp(&a.depth));
        drawn
    }

    /// The selection after a click on a handle; `extend` toggles a control point instead of selecting it alone.
    pub(crate) fn clicked(&self, handle: Handle, extend: bool) -> Selection {
        let mut selection = self.document.selection.clone();
        if selection.item != handle.item() {
            selection = Selection::of(handle.item());
        }
        match handle {
            Handle::Point { point, .. } => selection.click_point(point, extend),
            Handle::Object(_) | Handle::Light(_) => selection.points.clear(),
        }
        selection
    }

    /// The handles that a drag of `handle` moves: for a selected control point all selected control points, with the
    /// control points welded to them.
    pub(crate) fn moved_with(&self, handle: Handle) -> Vec<Handle> {
        let Handle::Point { object, point } = handle else { return vec![handle] };
        let selection = &self.document.selection;
        let Some(bezier) = selection.bezier(self.document.scene()) else { return vec![handle] };
        let grabbed = if self.is_selected(handle) { selection.points.clone() } else { BTreeSet::from([point]) };
        let moving: BTreeSet<_> = grabbed.into_iter().flat_map(|point| handles::welded(bezier, point)).collect();
        moving.into_iter().map(|point| Handle::Point { object, point }).collect()
    }
}
