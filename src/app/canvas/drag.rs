//! The position of a dragged handle: in the plane through it that faces the camera, in another plane, or along one axis. Knows
//! no widget.

use super::projection::Projection;
use glam::{DVec2, DVec3};

/// Sine of the angle between an axis and the camera ray below which perspective gives no usable position along the axis,
/// 30 degrees: near the axis's vanishing point a few pixels are an endless way.
const STEEP: f64 = 0.5;
/// Sine of the angle below which an axis has no visible direction on the film, about 3 degrees.
const END_ON: f64 = 0.05;
/// The nearest depth that a drag reaches, as a fraction of the depth at its start.
const NEAREST: f64 = 0.1;
/// The greatest speed along an axis over the speed at the start of the drag, and the greatest depth in a plane over the depth
/// at the start.
const FASTEST: f64 = 10.0;

/// The plane or line that a drag moves in.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub(crate) enum Constraint {
    /// The plane through the handle that faces the camera.
    #[default]
    Facing,
    /// The line through the handle along this unit vector.
    Axis(DVec3),
    /// The plane through the handle with this normal.
    Plane(DVec3),
}

/// A drag of a handle. The handle's position depends on the present pointer position alone, so no error accumulates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Drag {
    /// The handle's position before the drag, world space.
    pub(crate) start: DVec3,
    /// From the pointer to the handle at the start of the drag, film pixels.
    grab_offset: DVec2,
}

impl Drag {
    /// Starts a drag with the pointer at `pointer`, film pixels; `None` where the handle is behind the camera.
    pub(crate) fn new(start: DVec3, pointer: DVec2, projection: &Projection) -> Option<Self> {
        Some(Self { start, grab_offset: projection.project(start)? - pointer })
    }

    /// The handle's world position while the pointer is at `pointer`, film pixels.
    pub(crate) fn target(&self, pointer: DVec2, constraint: Constraint, projection: &Projection) -> DVec3 {
        let film = pointer + self.grab_offset;
        match constraint {
            Constraint::Facing => projection.unproject(film, projection.depth(self.start)),
            Constraint::Axis(axis) => self.along(axis, film, projection),
            Constraint::Plane(normal) => self.within(normal, film, projection),
        }
    }

    /// The point of the plane with this normal that projects to `film`. Where the plane there is out of reach, because it passes
    /// the camera or vanishes at the horizon, the nearest point in reach on the way to `film`.
    fn within(&self, normal: DVec3, film: DVec2, projection: &Projection) -> DVec3 {
        let Some(start) = projection.project(self.start) else { return self.start };
        // The inverse depth of a plane is affine in film coordinates.
        let first = 1.0 / projection.depth(self.start);
        let last = projection.inverse_depth(film, self.start, normal);
        let reachable = last.clamp(first / FASTEST, first / NEAREST);
        let way = if last == reachable { 1.0 } else { (reachable - first) / (last - first) };
        let target = projection.unproject(start + way * (film - start), 1.0 / reachable);
        if target.is_finite() { target } else { self.start }
    }

    /// The point of the axis whose projection is nearest to `film`. Along a steep axis the handle moves instead as far as
    /// the same pixels move it sideways, in the direction of the projected axis.
    fn along(&self, axis: DVec3, film: DVec2, projection: &Projection) -> DVec3 {
        let Some(start) = projection.project(self.start) else { return self.start };
        let depth = projection.depth(self.start);
        // The film point of start + t axis is start + t slope / (1 + t growth).
        let growth = (projection.depth(self.start + axis) - depth) / depth;
        let slope = projection.slope(self.start, axis);
        let sideways = projection.pixels_per_unit(depth);
        let direction = if slope.length() > END_ON * sideways {
            slope.normalize()
        } else {
            // Down is towards the viewer: y of the film points down.
            DVec2::new(0.0, -growth.signum())
        };
        let pixels = (film - start).dot(direction);
        let distance = if slope.length() < STEEP * sideways {
            pixels / sideways
        } else {
            pixels / (slope.length() - growth * pixels).max(slope.length() / FASTEST)
        };
        let reach = (1.0 - NEAREST) / growth.abs();
        let distance = if growth < 0.0 { distance.min(reach) } else { distance.max(-reach) };
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
        (Drag::new(start, pointer, &projection()).unwrap(), pointer)
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
    fn a_handle_in_a_plane_follows_the_pointer_within_it() {
        let (projection, start) = (projection(), DVec3::new(0.3, -0.2, 0.5));
        let (drag, _) = grabbed(start, DVec2::ZERO);
        for normal in DVec3::AXES {
            let wanted = start + 0.2 * (DVec3::ONE - normal);
            let there = drag.target(projection.project(wanted).unwrap(), Constraint::Plane(normal), &projection);
            assert!(there.distance(wanted) < 1e-11, "{there} across {normal}: the ray meets the plane at an angle");
        }
    }

    #[test]
    fn no_pointer_moves_a_handle_in_a_plane_endlessly_far_or_behind_the_camera() {
        let (projection, start) = (projection(), DVec3::new(0.3, -0.2, 0.5));
        let (drag, pointer) = grabbed(start, DVec2::ZERO);
        let depth = projection.depth(start);
        for normal in DVec3::AXES {
            for k in 0..64 {
                let way = 3000.0 * DVec2::from_angle(f64::from(k) * 0.1);
                let there = drag.target(pointer + way, Constraint::Plane(normal), &projection);
                let reached = projection.depth(there) / depth;
                assert!(reached > 0.999 * NEAREST && reached < 1.001 * FASTEST, "{there} across {normal}");
                assert!((there - start).dot(normal).abs() < 1e-9 * depth, "{there} left the plane across {normal}");
            }
        }
    }

    #[test]
    fn an_axis_towards_the_camera_moves_as_far_as_the_same_pixels_sideways() {
        let projection = projection();
        let start = DVec3::new(0.05, 0.2, 0.0);
        let (drag, pointer) = grabbed(start, DVec2::ZERO);
        let axis = (DVec3::new(1.0, 2.0, 4.0) - start).normalize();
        let moved = |pixels: DVec2, constraint| drag.target(pointer + pixels, constraint, &projection) - start;
        let mut last = 0.0;
        for pixels in [10.0, 20.0, 60.0] {
            let nearer = moved(DVec2::new(0.0, pixels), Constraint::Axis(axis)).dot(axis);
            let sideways = moved(DVec2::new(pixels, 0.0), Constraint::Facing).length();
            assert!((nearer - sideways).abs() < 1e-9, "{pixels} pixels down: {nearer} nearer, {sideways} sideways");
            assert!(nearer > last, "farther with every pixel");
            last = nearer;
            let farther = moved(DVec2::new(0.0, -pixels), Constraint::Axis(axis)).dot(axis);
            assert!((farther + nearer).abs() < 1e-9, "up moves away from the camera: {farther}");
        }
    }

    #[test]
    fn no_pointer_moves_a_handle_along_an_axis_endlessly_far_or_behind_the_camera() {
        let (projection, start) = (projection(), DVec3::new(0.3, -0.2, 0.5));
        let (drag, pointer) = grabbed(start, DVec2::ZERO);
        for axis in DVec3::AXES {
            for k in 0..64 {
                let way = 2000.0 * DVec2::from_angle(f64::from(k) * 0.1);
                let there = drag.target(pointer + way, Constraint::Axis(axis), &projection);
                let sideways = 2000.0 / projection.pixels_per_unit(projection.depth(start));
                assert!(there.distance(start) <= sideways * FASTEST / STEEP, "{there} along {axis}");
                assert!(projection.depth(there) > 0.0, "{there} is in front of the camera");
            }
        }
    }
}
