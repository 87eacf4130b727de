//! Where a dragged handle goes: in the plane through it that faces the camera, or along one axis. Knows no widget.

use super::projection::Projection;
use crate::app::document::Handle;
use glam::{DVec2, DVec3};

/// A view this close to an axis gives no way along it: the cosine squared of about 2 degrees.
const PARALLEL: f64 = 0.999;

/// What a drag is bound to.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub(crate) enum Constraint {
    /// The plane through the handle that faces the camera.
    #[default]
    Facing,
    /// A line through the handle along this unit vector.
    Axis(DVec3),
}

/// A drag of a handle from its first to its last moment. It depends on where the pointer is, not on how it came
/// there, so no error accumulates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Drag {
    /// What is dragged.
    pub(crate) handle: Handle,
    /// Where it was.
    start: DVec3,
    /// From the pointer to the handle as it was grabbed, film pixels.
    grip: DVec2,
}

impl Drag {
    /// Begins with the pointer at `pointer`, in film pixels; `None` where the handle is behind the eye.
    pub(crate) fn new(handle: Handle, start: DVec3, pointer: DVec2, projection: &Projection) -> Option<Self> {
        Some(Self { handle, start, grip: projection.project(start)? - pointer })
    }

    /// Where the handle is with the pointer at `pointer`, in film pixels.
    pub(crate) fn target(&self, pointer: DVec2, constraint: Constraint, projection: &Projection) -> DVec3 {
        let film = pointer + self.grip;
        match constraint {
            Constraint::Facing => projection.unproject(film, projection.depth(self.start)),
            Constraint::Axis(axis) => self.along(axis, film, projection),
        }
    }

    /// The point of the axis nearest to the eye ray; the start where they are about parallel.
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
    fn a_grab_beside_the_middle_does_not_make_the_handle_jump() {
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
    fn an_axis_is_not_left_and_the_way_along_it_follows_the_pointer() {
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
    fn an_axis_towards_the_eye_moves_nothing() {
        let start = DVec3::new(0.3, -0.2, 0.5);
        let (drag, pointer) = grabbed(start, DVec2::ZERO);
        let axis = (start - DVec3::new(1.0, 2.0, 4.0)).normalize();
        assert_eq!(drag.target(pointer, Constraint::Axis(axis), &projection()), start);
    }
}
