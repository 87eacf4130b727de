//! The position of a dragged handle: in the plane through it that faces the camera, or along one axis. Knows no widget.

use super::projection::Projection;
use crate::app::document::Handle;
use glam::{DVec2, DVec3};

/// Squared cosine above which a camera ray counts as parallel to an axis, about 2 degrees: the pointer then gives no
/// position along the axis.
const PARALLEL: f64 = 0.999;

/// The plane or line that a drag moves in.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub(crate) enum Constraint {
    /// The plane through the handle that faces the camera.
    #[default]
    Facing,
    /// The line through the handle along this unit vector.
    Axis(DVec3),
}

/// A drag of a handle. The handle's position depends on the present pointer position alone, so no error accumulates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Drag {
    /// The dragged handle.
    pub(crate) handle: Handle,
    /// The handle's position before the drag, world space.
    start: DVec3,
    /// From the pointer to the handle at the start of the drag, film pixels.
    grab_offset: DVec2,
}

impl Drag {
    /// Starts a drag with the pointer at `pointer`, film pixels; `None` where the handle is behind the camera.
    pub(crate) fn new(handle: Handle, start: DVec3, pointer: DVec2, projection: &Projection) -> Option<Self> {
        Some(Self { handle, start, grab_offset: projection.project(start)? - pointer })
    }

    /// The handle's world position while the pointer is at `pointer`, film pixels.
    pub(crate) fn target(&self, pointer: DVec2, constraint: Constraint, projection: &Projection) -> DVec3 {
        let film = pointer + self.grab_offset;
        match constraint {
            Constraint::Facing => projection.unproject(film, projection.depth(self.start)),
            Constraint::Axis(axis) => self.along(axis, film, projection),
        }
    }

    /// The point of the axis nearest to the camera ray; the start where both are nearly parallel.
    fn along(&self, axis: DVec3, film: DVec2, projection: &Projection) -> DVec3 {
        let ray = projection.ray(film);
        let cosine = axis.dot(ray.direction);
        if cosine * cosine > PARALLEL {
            return self.start;
        }
        let to_start = self.start - ray.origin;
        let distance = (cosine * ray.direction.dot(to_start) - axis.dot(to_start)) / (1.0 - cosine * cosine);
        self.start + axis * distance
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Camera, Film};

    // Positions of size 1 through about twenty roundings.
    const TOLERANCE: f64 = 1e-12;

    fn projection() -> Projection {
        let camera =
            Camera { position: DVec3::new(1.0, 2.0, 4.0), target: DVec3::new(0.0, 0.2, 0.0), ..Camera::default() };
        Projection::new(&camera, &Film::default()).unwrap()
    }

    fn grabbed(start: DVec3, off: DVec2) -> (Drag, DVec2) {
        let pointer = projection().project(start).unwrap() + off;
        (Drag::new(Handle::Light(0), start, pointer, &projection()).unwrap(), pointer)
    }

    #[test]
    fn grabbing_a_handle_off_centre_does_not_move_it() {
        let start = DVec3::new(0.3, -0.2, 0.5);
        let (drag, pointer) = grabbed(start, DVec2::new(3.0, -2.0));
        let there = drag.target(pointer, Constraint::Facing, &projection());
        assert!(there.distance(start) < TOLERANCE, "{there}");
    }

    #[test]
    fn the_handle_follows_the_pointer_at_its_depth() {
        let (projection, start) = (projection(), DVec3::new(0.3, -0.2, 0.5));
        let (drag, pointer) = grabbed(start, DVec2::ZERO);
        let there = drag.target(pointer + DVec2::new(40.0, 25.0), Constraint::Facing, &projection);
        let film = projection.project(there).unwrap();
        assert!(film.distance(pointer + DVec2::new(40.0, 25.0)) < 1e-9, "film coordinates of size 500: {film}");
        assert!((projection.depth(there) - projection.depth(start)).abs() < TOLERANCE, "in the facing plane");
    }

    #[test]
    fn a_handle_on_an_axis_follows_the_pointer_along_it() {
        let (projection, start) = (projection(), DVec3::new(0.3, -0.2, 0.5));
        let (drag, _) = grabbed(start, DVec2::ZERO);
        for axis in DVec3::AXES {
            let wanted = start + 0.37 * axis;
            let there = drag.target(projection.project(wanted).unwrap(), Constraint::Axis(axis), &projection);
            assert!(
                there.distance(wanted) < 1e-10,
                "{there} along {axis}: the lines meet at an angle, which costs digits"
            );
        }
    }

    #[test]
    fn a_drag_along_an_axis_towards_the_camera_moves_no_handle() {
        let start = DVec3::new(0.3, -0.2, 0.5);
        let (drag, pointer) = grabbed(start, DVec2::ZERO);
        let axis = (start - DVec3::new(1.0, 2.0, 4.0)).normalize();
        assert_eq!(drag.target(pointer, Constraint::Axis(axis), &projection()), start);
    }
}
