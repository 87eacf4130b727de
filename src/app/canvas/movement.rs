//! A move of handles from its first to its last frame. Knows no widget.

use super::drag::{Constraint, Drag};
use super::falloff::weight;
use super::snap::snapped;
use super::stage::Stage;
use crate::app::document::{Edit, Handle};
use crate::scene::Shape;
use glam::{DVec2, DVec3};
use std::collections::BTreeSet;

/// Rounding errors of a position, over its distance from the origin: of a few operations in double precision, and far below what can be seen.
const ROUNDING: f64 = 1e-12;

/// Sine of the angle between the line of sight and a plane below which a pointer's place in the plane is too uncertain, 12 degrees.
const EDGE_ON: f64 = 0.2;

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
        let bound = profile_plane(stage, handle).map_or(Constraint::Facing, Constraint::Plane);
        Self::new(stage, vec![handle], (bound, normal), Some(pointer))
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
        let present = self.position(stage)?;
        if !(target - present).is_finite() {
            return None;
        }
        let way = way(present, target);
        match radius.filter(|_| self.moves_points()) {
            None => way.map(|way| Edit::Move(self.moved.clone(), way)),
            Some(radius) => {
                let following = self.followers.iter().filter_map(|follower| {
                    let place = follower.start + weight(follower.distance, radius) * (target - self.drag.start);
                    Some((follower.handle, self::way(follower.handle.position(stage.document.scene())?, place)?))
                });
                let moved = self.moved.iter().filter_map(|handle| Some((*handle, way?)));
                let moving: Vec<_> = moved.chain(following).collect();
                (!moving.is_empty()).then_some(Edit::MoveEach(moving))
            }
        }
    }
}

/// The normal of the plane in which the profile of a surface of revolution lies, world space; `None` for handles off such a
/// profile, and where the camera sees that plane nearly from the edge: there the pointer has no place in the plane.
fn profile_plane(stage: &Stage<'_>, handle: Handle) -> Option<DVec3> {
    let Handle::Point { object, .. } = handle else { return None };
    let Shape::Revolution(revolution) = &stage.document.scene().objects.get(object)?.shape else { return None };
    let axes = revolution.transform().world_from_object().matrix3;
    let normal = axes.x_axis.cross(axes.y_axis).try_normalize()?;
    let film = stage.projection.project(handle.position(stage.document.scene())?)?;
    let sine = stage.projection.ray(film).direction.try_normalize()?.dot(normal).abs();
    (sine > EDGE_ON).then_some(normal)
}

/// The way from one position to another; `None` where it is no longer than rounding errors: a point of an object that is turned never comes
/// exactly where it should, and each try would begin the picture anew while the pointer rests.
fn way(from: DVec3, to: DVec3) -> Option<DVec3> {
    let way = to - from;
    (way.is_finite() && way.length() > ROUNDING * (from.length() + to.length())).then_some(way)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Transform;

    /// A point of a turned and scaled object ends its way to a target, whatever the last bits do.
    #[test]
    fn a_point_of_a_turned_object_arrives() {
        let transform = Transform {
            translate: DVec3::new(0.3, -1.7, 2.9),
            rotate: DVec3::new(17.0, 33.0, -71.0),
            scale: DVec3::splat(0.7),
        };
        let world_from_object = transform.world_from_object();
        let mut point = DVec3::new(0.1, 0.2, 0.3);
        for k in 0..200 {
            let target = DVec3::new(0.7 + 0.013 * f64::from(k), 0.31, -1.1);
            let ways = (0..4).filter(|_| {
                let way = way(world_from_object.transform_point3(point), target);
                point += way.map_or(DVec3::ZERO, |way| world_from_object.inverse().transform_vector3(way));
                way.is_some()
            });
            assert!(ways.count() <= 2, "the point is still on its way to {target}");
        }
        assert!(way(DVec3::ONE, DVec3::ONE + DVec3::X * 1e-9).is_some(), "what can be seen is a way");
    }
}
