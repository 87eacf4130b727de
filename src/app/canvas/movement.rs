//! A move of handles from its first to its last frame. Knows no widget.

use super::drag::{Constraint, Drag};
use super::falloff::weight;
use super::snap::snapped;
use super::stage::Stage;
use crate::app::document::{Edit, Handle};
use glam::{DVec2, DVec3};
use std::collections::BTreeSet;

/// The handles that a drag moves, and how they follow the pointer.
#[derive(Clone, Debug)]
pub(crate) struct Movement {
    drag: Drag,
    /// The handles whose mean position follows the pointer.
    anchor: Vec<Handle>,
    /// The handles that move by the whole way.
    moved: Vec<Handle>,
    /// The constraint of the dragged part of the gizmo; facing for a handle.
    bound: Constraint,
    /// The surface normal at the start.
    pub(crate) normal: Option<DVec3>,
    /// The other control points of the object, which follow by soft selection.
    followers: Vec<Follower>,
    /// The largest extent of the object's control points along an axis of the world, scene units.
    pub(crate) extent: f64,
}

/// A control point that may follow.
#[derive(Clone, Copy, Debug)]
struct Follower {
    handle: Handle,
    /// The position before the move, world space.
    start: DVec3,
    /// Distance to the nearest moved control point before the move, scene units.
    distance: f64,
}

impl Movement {
    /// Starts to drag one handle; `None` where it is behind the camera.
    pub(crate) fn of_handle(stage: &Stage<'_>, handle: Handle, pointer: DVec2, normal: Option<DVec3>) -> Option<Self> {
        Self::new(stage, vec![handle], (Constraint::Facing, normal), Some(pointer))
    }

    /// Starts to drag the selection by a part of its gizmo; `None` where the selection is behind the camera.
    pub(crate) fn of_selection(
        stage: &Stage<'_>,
        bound: Constraint,
        pointer: DVec2,
        normal: Option<DVec3>,
    ) -> Option<Self> {
        Self::new(stage, stage.selected_handles(), (bound, normal), Some(pointer))
    }

    /// Starts to move the selection by keys; `None` where it is behind the camera.
    pub(crate) fn by_keys(stage: &Stage<'_>) -> Option<Self> {
        Self::new(stage, stage.selected_handles(), (Constraint::Facing, None), None)
    }

    fn new(
        stage: &Stage<'_>,
        anchor: Vec<Handle>,
        (bound, normal): (Constraint, Option<DVec3>),
        pointer: Option<DVec2>,
    ) -> Option<Self> {
        let start = stage.mean_position(&anchor)?;
        let pointer = pointer.or_else(|| stage.projection.project(start))?;
        let drag = Drag::new(start, pointer, &stage.projection)?;
        let moved = stage.moved_with(*anchor.first()?);
        let (followers, extent) = followers(stage, &moved);
        Some(Self { drag, anchor, moved, bound, normal, followers, extent })
    }

    /// Whether the handle is the one that follows the pointer.
    pub(crate) fn follows(&self, handle: Handle) -> bool {
        self.anchor == [handle]
    }

    /// Whether control points move, which others may follow.
    pub(crate) fn moves_points(&self) -> bool {
        matches!(self.anchor.first(), Some(Handle::Point { .. }))
    }

    /// The constraint: of the key that is held down, or else of the gizmo's part.
    pub(crate) fn constraint(&self, key: Option<Constraint>) -> Constraint {
        key.unwrap_or(self.bound)
    }

    /// The world vector from the start to the present position.
    pub(crate) fn delta(&self, stage: &Stage<'_>) -> DVec3 {
        self.position(stage).map_or(DVec3::ZERO, |present| present - self.drag.start)
    }

    /// The present position of what follows the pointer, world space.
    pub(crate) fn position(&self, stage: &Stage<'_>) -> Option<DVec3> {
        stage.mean_position(&self.anchor)
    }

    /// Where the pointer, at a film point, brings the handles: on the grid with this step, or anywhere.
    pub(crate) fn target(&self, stage: &Stage<'_>, pointer: DVec2, constraint: Constraint, grid: Option<f64>) -> DVec3 {
        let target = self.drag.target(pointer, constraint, &stage.projection);
        grid.map_or(target, |step| snapped(target, self.drag.start, constraint, step))
    }

    /// The edit that brings the handles to `target`, and control points within `radius` after them; `None` where they are there.
    pub(crate) fn edit(&self, stage: &Stage<'_>, target: DVec3, radius: Option<f64>) -> Option<Edit> {
        let by = target - self.position(stage)?;
        if !by.is_finite() {
            return None;
        }
        match radius.filter(|_| self.moves_points()) {
            None => (by != DVec3::ZERO).then(|| Edit::Move(self.moved.clone(), by)),
            Some(radius) => {
                let following = self.followers.iter().filter_map(|follower| {
                    let place = follower.start + weight(follower.distance, radius) * (target - self.drag.start);
                    Some((follower.handle, place - follower.handle.position(stage.document.scene())?))
                });
                let all = self.moved.iter().map(|handle| (*handle, by)).chain(following);
                let moving: Vec<_> = all.filter(|(_, way)| *way != DVec3::ZERO && way.is_finite()).collect();
                (!moving.is_empty()).then_some(Edit::MoveEach(moving))
            }
        }
    }
}

/// The control points of the object beside the moved ones, and the object's extent; none for lights and whole objects.
fn followers(stage: &Stage<'_>, moved: &[Handle]) -> (Vec<Follower>, f64) {
    let Some(Handle::Point { object, .. }) = moved.first() else { return (Vec::new(), 0.0) };
    let (object, scene) = (*object, stage.document.scene());
    let place = |handle: &Handle| handle.position(scene);
    let fixed: BTreeSet<Handle> = moved.iter().copied().collect();
    let centers: Vec<DVec3> = moved.iter().filter_map(place).collect();
    let all = stage.sight.welds.groups().iter().flatten().map(|point| Handle::Point { object, point: *point });
    let placed: Vec<(Handle, DVec3)> = all.filter_map(|handle| Some((handle, place(&handle)?))).collect();
    let low = placed.iter().fold(DVec3::INFINITY, |low, (_, at)| low.min(*at));
    let high = placed.iter().fold(DVec3::NEG_INFINITY, |high, (_, at)| high.max(*at));
    let others = placed.iter().filter(|(handle, _)| !fixed.contains(handle)).map(|&(handle, start)| {
        let distance = centers.iter().map(|center| center.distance(start)).fold(f64::INFINITY, f64::min);
        Follower { handle, start, distance }
    });
    (others.collect(), (high - low).max_element())
}
