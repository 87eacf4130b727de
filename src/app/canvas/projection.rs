//! From the scene to the picture and back: the pinhole camera in film pixels. Knows no widget.

use crate::math::Ray;
use crate::scene::{Camera, Film};
use glam::{DVec2, DVec3};

/// What lies nearer to the eye than this part of the distance to the target is not drawn, for it would project to huge coordinates.
const NEAREST_DEPTH: f64 = 1e-6;

/// The pinhole camera as a map between world space and film space: pixels, x to the right, y down, (0, 0) the
/// top-left corner of the top-left pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Projection {
    eye: DVec3,
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    /// Pixels from the eye to the film.
    focal: f64,
    center: DVec2,
    near: f64,
}

impl Projection {
    /// `None` where the camera has no direction: its target at its position, `up` along the view, an angle outside (0, 180).
    pub(crate) fn new(camera: &Camera, film: &Film) -> Option<Self> {
        let forward = (camera.target - camera.position).try_normalize()?;
        let right = forward.cross(camera.up).try_normalize()?;
        if !(camera.fov_y > 0.0 && camera.fov_y < 180.0) {
            return None;
        }
        let size = DVec2::new(f64::from(film.width), f64::from(film.height));
        Some(Self {
            eye: camera.position,
            right,
            up: right.cross(forward),
            forward,
            focal: 0.5 * size.y / (0.5 * camera.fov_y.to_radians()).tan(),
            center: 0.5 * size,
            near: NEAREST_DEPTH * camera.position.distance(camera.target),
        })
    }

    /// Distance in front of the eye along the view direction, scene units; negative behind it.
    pub(crate) fn depth(&self, world: DVec3) -> f64 {
        (world - self.eye).dot(self.forward)
    }

    /// Film pixels; `None` for a point behind the eye.
    pub(crate) fn project(&self, world: DVec3) -> Option<DVec2> {
        let depth = self.depth(world);
        if depth <= self.near {
            return None;
        }
        let offset = world - self.eye;
        let scale = self.focal / depth;
        Some(self.center + DVec2::new(offset.dot(self.right), -offset.dot(self.up)) * scale)
    }

    /// The world point that projects to `film` and lies `depth` in front of the eye.
    pub(crate) fn unproject(&self, film: DVec2, depth: f64) -> DVec3 {
        let offset = (film - self.center) * (depth / self.focal);
        self.eye + self.forward * depth + self.right * offset.x - self.up * offset.y
    }

    /// The ray from the eye through a film point; its direction has length 1.
    pub(crate) fn ray(&self, film: DVec2) -> Ray {
        Ray::new(self.eye, (self.unproject(film, 1.0) - self.eye).normalize())
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
    fn the_target_is_in_the_middle() {
        let middle = projection().project(DVec3::new(0.5, 0.0, -1.0)).unwrap();
        assert!(middle.distance(DVec2::new(320.0, 240.0)) < TOLERANCE, "{middle}");
    }

    #[test]
    fn the_angle_of_view_is_the_whole_height() {
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
    fn the_ray_through_a_pixel_meets_what_projects_there() {
        let projection = projection();
        let world = DVec3::new(0.3, -0.4, 0.5);
        let ray = projection.ray(projection.project(world).unwrap());
        let off = (world - ray.origin).cross(ray.direction).length();
        assert!(off < TOLERANCE, "the ray misses by {off}");
    }

    #[test]
    fn behind_the_eye_nothing_is_projected() {
        assert_eq!(projection().project(DVec3::new(1.5, 4.0, 17.0)), None);
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
