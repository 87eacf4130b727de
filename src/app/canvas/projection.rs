//! The pinhole camera in film pixels: projection of world points, and camera rays. Knows no widget.

use crate::math::Ray;
use crate::scene::{Camera, Film};
use glam::{DVec2, DVec3};

/// The near plane as a fraction of the distance to the target: nearer points would project to huge coordinates.
const NEAREST_DEPTH: f64 = 1e-6;

/// The near plane of lines, as a fraction of the distance to the target.
const NEAREST_OF_LINES: f64 = 1e-3;

/// The map of a pinhole camera between world space and film space. Film coordinates are pixels: x to the right, y down,
/// (0, 0) at the top-left corner of the top-left pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Projection {
    position: DVec3,
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    /// Distance from the camera to the film, pixels.
    focal: f64,
    center: DVec2,
    near: f64,
}

impl Projection {
    /// The projection of a camera; `None` where its view is undefined: the target equals the position, `up` is parallel to the
    /// view direction, or the angle of view lies outside (0, 180) degrees.
    pub(crate) fn new(camera: &Camera, film: &Film) -> Option<Self> {
        let forward = (camera.target - camera.position).try_normalize()?;
        let right = forward.cross(camera.up).try_normalize()?;
        if !(camera.fov_y > 0.0 && camera.fov_y < 180.0) {
            return None;
        }
        let size = DVec2::new(f64::from(film.width), f64::from(film.height));
        Some(Self {
            position: camera.position,
            right,
            up: right.cross(forward),
            forward,
            focal: 0.5 * size.y / (0.5 * camera.fov_y.to_radians()).tan(),
            center: 0.5 * size,
            near: NEAREST_DEPTH * camera.position.distance(camera.target),
        })
    }

    /// Depth of a point along the view direction, scene units; negative behind the camera.
    pub(crate) fn depth(&self, world: DVec3) -> f64 {
        (world - self.position).dot(self.forward)
    }

    /// Film pixels per scene unit at depth `depth`, across the view direction.
    pub(crate) fn pixels_per_unit(&self, depth: f64) -> f64 {
        self.focal / depth
    }

    /// The speed on the film of a point at `world` that moves along `direction`, pixels per length of `direction`.
    pub(crate) fn slope(&self, world: DVec3, direction: DVec3) -> DVec2 {
        let depth = self.depth(world);
        let offset = world - self.position;
        // The derivative of focal (x / depth) by the quotient rule.
        let across = |axis: DVec3| direction.dot(axis) - offset.dot(axis) * direction.dot(self.forward) / depth;
        self.pixels_per_unit(depth) * DVec2::new(across(self.right), -across(self.up))
    }

    /// The film point of a world point, pixels; `None` behind the near plane.
    pub(crate) fn project(&self, world: DVec3) -> Option<DVec2> {
        let depth = self.depth(world);
        if depth <= self.near {
            return None;
        }
        let offset = world - self.position;
        let scale = self.pixels_per_unit(depth);
        Some(self.center + DVec2::new(offset.dot(self.right), -offset.dot(self.up)) * scale)
    }

    /// The part of a segment in front of a near plane before the camera; `None` for none. Its ends project to coordinates that the screen
    /// can draw.
    pub(crate) fn clipped(&self, [from, to]: [DVec3; 2]) -> Option<[DVec3; 2]> {
        let near = NEAREST_OF_LINES * self.near / NEAREST_DEPTH;
        let depths = [from, to].map(|end| self.depth(end));
        let on_plane = || from.lerp(to, (near - depths[0]) / (depths[1] - depths[0]));
        match depths.map(|depth| depth > near) {
            [true, true] => Some([from, to]),
            [true, false] => Some([from, on_plane()]),
            [false, true] => Some([on_plane(), to]),
            [false, false] => None,
        }
    }

    /// The world point at depth `depth` that projects to the film point `film`.
    pub(crate) fn unproject(&self, film: DVec2, depth: f64) -> DVec3 {
        let offset = (film - self.center) * (depth / self.focal);
        self.position + self.forward * depth + self.right * offset.x - self.up * offset.y
    }

    /// One over the depth at which the camera ray through a film point meets a plane, given by a point and a normal; negative
    /// where it meets the plane behind the camera, 0 on the horizon.
    pub(crate) fn inverse_depth(&self, film: DVec2, point: DVec3, normal: DVec3) -> f64 {
        let direction = self.unproject(film, 1.0) - self.position;
        direction.dot(normal) / (point - self.position).dot(normal)
    }

    /// The segment from the camera to a world point: t is 1 at the point.
    pub(crate) fn sight(&self, world: DVec3) -> Ray {
        Ray::between(self.position, world)
    }

    /// The camera ray through a film point, with a direction of length 1.
    pub(crate) fn ray(&self, film: DVec2) -> Ray {
        Ray::new(self.position, (self.unproject(film, 1.0) - self.position).normalize())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    // Coordinates are of size 1 to 1000 and a projection is about ten roundings, so 1e-10 is a thousand times the rounding error.
    const TOLERANCE: f64 = 1e-10;

    fn projection() -> Projection {
        let camera =
            Camera { position: DVec3::new(1.0, 2.0, 8.0), target: DVec3::new(0.5, 0.0, -1.0), ..Camera::default() };
        Projection::new(&camera, &Film { width: 640, height: 480, ..Film::default() }).unwrap()
    }

    #[test]
    fn the_target_projects_to_the_film_centre() {
        let center = projection().project(DVec3::new(0.5, 0.0, -1.0)).unwrap();
        assert!(center.distance(DVec2::new(320.0, 240.0)) < TOLERANCE, "{center}");
    }

    #[test]
    fn the_angle_of_view_spans_the_film_height() {
        let camera = Camera { position: DVec3::ZERO, target: DVec3::NEG_Z, fov_y: 90.0, ..Camera::default() };
        let projection = Projection::new(&camera, &Film { width: 200, height: 100, ..Film::default() }).unwrap();
        let top_right = projection.project(DVec3::new(2.0, 1.0, -1.0)).unwrap();
        assert!(top_right.distance(DVec2::new(200.0, 0.0)) < TOLERANCE, "{top_right}");
    }

    #[test]
    fn unproject_undoes_project() {
        let projection = projection();
        for world in [DVec3::new(0.3, -0.4, 0.5), DVec3::new(-2.0, 3.0, -7.0)] {
            let film = projection.project(world).unwrap();
            assert!(projection.unproject(film, projection.depth(world)).distance(world) < TOLERANCE, "{world}");
        }
    }

    #[test]
    fn the_camera_ray_meets_the_projected_point() {
        let projection = projection();
        let world = DVec3::new(0.3, -0.4, 0.5);
        let ray = projection.ray(projection.project(world).unwrap());
        let off = (world - ray.origin).cross(ray.direction).length();
        assert!(off < TOLERANCE, "the ray misses by {off}");
    }

    #[test]
    fn a_point_behind_the_camera_has_no_projection() {
        assert_eq!(projection().project(DVec3::new(1.5, 4.0, 17.0)), None);
    }

    #[test]
    fn segments_are_clipped_before_the_camera() {
        let projection = projection();
        let (before, behind) = (DVec3::new(0.5, 0.0, -1.0), DVec3::new(1.5, 4.0, 17.0));
        assert_eq!(projection.clipped([before, 0.5 * before]), Some([before, 0.5 * before]));
        assert_eq!(projection.clipped([behind, behind]), None);
        let near = 1e-3 * projection.depth(before);
        for ends in [[before, behind], [behind, before]] {
            let clipped = projection.clipped(ends).unwrap();
            let [a, b] = clipped.map(|end| projection.depth(end));
            assert!((a.min(b) - near).abs() < TOLERANCE && clipped.contains(&before), "{clipped:?}");
            assert!(clipped.iter().all(|end| projection.project(*end).is_some()));
        }
    }

    #[test]
    fn a_camera_without_direction_has_no_projection() {
        let looks_nowhere = Camera { target: Camera::default().position, ..Camera::default() };
        let up_along_view = Camera { up: DVec3::Z, ..Camera::default() };
        for camera in [looks_nowhere, up_along_view, Camera { fov_y: 180.0, ..Camera::default() }] {
            assert_eq!(Projection::new(&camera, &Film::default()), None, "{camera:?}");
        }
    }
}
