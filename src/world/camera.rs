use crate::math::Ray;
use crate::scene;
use glam::{DVec2, DVec3};

/// A pinhole camera with the pixel grid of its film. Film coordinates are in pixels; (0, 0) is the top-left corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The pinhole, in scene units.
    pub position: DVec3,
    /// Pixels per row.
    pub width: u32,
    /// Rows of pixels.
    pub height: u32,
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    /// The side of a pixel on the image plane at distance 1.
    pixel_side: f64,
}

/// The projection of a point onto the film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projected {
    /// Index of the pixel, row by row from the top.
    pub pixel: u32,
    /// Unit vector from the point to the pinhole.
    pub to_camera: DVec3,
    /// Distance to the pinhole, in scene units.
    pub distance: f64,
    /// Pixels per steradian there: 1 over the solid angle of the pixel.
    pub pixels_per_steradian: f64,
}

impl Camera {
    /// The camera of a scene for a film of this size (at least 1 x 1). If `up` is parallel to the view, it picks an up vector.
    pub fn new(camera: &scene::Camera, width: u32, height: u32) -> Self {
        let forward = (camera.target - camera.position).normalize_or(DVec3::NEG_Z);
        let right = forward.cross(camera.up);
        let right = right.try_normalize().unwrap_or_else(|| forward.any_orthonormal_vector());
        let (width, height) = (width.max(1), height.max(1));
        let pixel_side = 2.0 * (0.5 * camera.fov_y.to_radians()).tan() / f64::from(height);
        Self { position: camera.position, width, height, right, up: right.cross(forward), forward, pixel_side }
    }

    /// The camera with the same view and another number of pixels (at least 1 x 1).
    pub fn resized(&self, width: u32, height: u32) -> Self {
        let (width, height) = (width.max(1), height.max(1));
        Self { width, height, pixel_side: self.pixel_side * f64::from(self.height) / f64::from(height), ..*self }
    }

    /// The number of pixels.
    pub fn pixel_count(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// The ray through a film position; its direction has unit length.
    pub fn ray(&self, film: DVec2) -> Ray {
        let x = (film.x - 0.5 * f64::from(self.width)) * self.pixel_side;
        let y = (0.5 * f64::from(self.height) - film.y) * self.pixel_side;
        Ray::new(self.position, (self.forward + x * self.right + y * self.up).normalize())
    }

    /// The film position of a point, which may lie outside of the film; `None` for points behind the camera.
    pub fn film_position(&self, point: DVec3) -> Option<DVec2> {
        let offset = point - self.position;
        let depth = offset.dot(self.forward);
        if depth <= 0.0 || depth.is_nan() {
            return None;
        }
        let scale = 1.0 / (depth * self.pixel_side);
        let x = 0.5 * f64::from(self.width) + offset.dot(self.right) * scale;
        let y = 0.5 * f64::from(self.height) - offset.dot(self.up) * scale;
        Some(DVec2::new(x, y))
    }

    /// The projection of a point; `None` for points behind the camera or outside of the film.
    pub fn project(&self, point: DVec3) -> Option<Projected> {
        let DVec2 { x, y } = self.film_position(point)?;
        if !(x >= 0.0 && y >= 0.0 && x < f64::from(self.width) && y < f64::from(self.height)) {
            return None;
        }
        let offset = point - self.position;
        let distance = offset.length();
        let cos = offset.dot(self.forward) / distance;
        Some(Projected {
            pixel: y as u32 * self.width + x as u32,
            to_camera: -offset / distance,
            distance,
            // A pixel of side s on the plane at distance 1 has the solid angle s^2 cos^3.
            pixels_per_steradian: 1.0 / (self.pixel_side * self.pixel_side * cos * cos * cos),
        })
    }

    /// Where the pixel with this index lies on a plane, given by a point and a normal: its middle, and from there the middles of its right and
    /// of its lower side. `None` where the pixel sees more of the plane than `limit` pixel footprints each way, or the plane's horizon.
    pub fn pixel_on_plane(&self, pixel: u32, point: DVec3, normal: DVec3, limit: f64) -> Option<[DVec3; 3]> {
        let middle = DVec2::new(f64::from(pixel % self.width) + 0.5, f64::from(pixel / self.width) + 0.5);
        let height = (point - self.position).dot(normal);
        let distance = |film: DVec2| {
            let ray = self.ray(film);
            (ray.direction, height / ray.direction.dot(normal))
        };
        let at = |film: DVec2| {
            let (direction, t) = distance(film);
            (t > 0.0).then_some(direction * t)
        };
        let [middle, right, below] = [at(middle)?, at(middle + 0.5 * DVec2::X)?, at(middle + 0.5 * DVec2::Y)?];
        let most = 0.5 * limit * self.footprint(middle.length());
        let sides = [right - middle, below - middle];
        let fits = sides.iter().all(|side| side.length() <= most);
        fits.then(|| [self.position + middle, sides[0], sides[1]])
    }

    /// The side of a pixel's footprint across the ray, at this distance along the path, in scene units.
    pub fn footprint(&self, distance: f64) -> f64 {
        self.pixel_side * distance
    }

    /// Whether a part of a ball may be visible on the film. Conservative: `false` only if no part is.
    pub fn may_see(&self, center: DVec3, radius: f64) -> bool {
        let offset = center - self.position;
        let (x, y, z) = (offset.dot(self.right), offset.dot(self.up), offset.dot(self.forward));
        // Signed distance to a side plane of the view pyramid, whose slope is `tan`.
        let outside = |across: f64, tan: f64| (across.abs() - tan * z) / (1.0 + tan * tan).sqrt() > radius;
        let tan = |pixels: u32| 0.5 * f64::from(pixels) * self.pixel_side;
        z > -radius && !outside(x, tan(self.width)) && !outside(y, tan(self.height))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pixel_shows_the_piece_of_a_plane_between_its_sides() {
        let scene = scene::Camera { position: DVec3::new(0.3, 2.0, 4.0), target: DVec3::ZERO, ..Default::default() };
        let camera = Camera::new(&scene, 40, 30);
        let (pixel, normal) = (17 * 40 + 25, DVec3::Y);
        let [middle, right, below] =
            camera.pixel_on_plane(pixel, DVec3::new(7.0, -0.5, 3.0), normal, 16.0).expect("seen");
        for (film, point) in [((25.5, 17.5), middle), ((26.0, 17.5), middle + right), ((25.5, 18.0), middle + below)] {
            assert!((point.y + 0.5).abs() < 1e-12);
            let found = camera.film_position(point).expect("in front of the camera");
            assert!(found.distance(film.into()) < 1e-9, "{found} {film:?}");
        }
        let along = camera.ray(DVec2::new(25.5, 17.5)).direction;
        let grazing = along.any_orthonormal_vector();
        assert!(camera.pixel_on_plane(pixel, camera.position, grazing, 16.0).is_none(), "through the camera");
        assert!(camera.pixel_on_plane(pixel, DVec3::new(0.0, 5.0, 0.0), normal, 16.0).is_none(), "behind it");
    }

    #[test]
    fn project_undoes_ray() {
        let description = scene::Camera { position: DVec3::new(1.0, 2.0, 3.0), ..scene::Camera::default() };
        let camera = Camera::new(&description, 300, 200);
        for (x, y) in [(0.5, 0.5), (299.5, 0.5), (150.5, 100.5), (17.25, 180.75)] {
            let ray = camera.ray(DVec2::new(x, y));
            let seen = camera.project(ray.at(7.0)).expect("in front of the camera");
            assert_eq!(seen.pixel, y as u32 * 300 + x as u32);
            assert!(camera.may_see(ray.at(7.0), 0.0), "a point on the film may be seen");
        }
        assert!(camera.project(camera.ray(DVec2::new(300.1, 50.0)).at(1.0)).is_none(), "right of the film");
        assert!(camera.project(camera.ray(DVec2::new(150.0, 50.0)).at(-1.0)).is_none(), "behind");
        assert!(!camera.may_see(camera.ray(DVec2::new(150.0, 100.0)).at(-5.0), 1.0), "a ball behind");
    }

    #[test]
    fn pixels_fill_the_view_pyramid() {
        let camera = Camera::new(&scene::Camera { fov_y: 90.0, ..scene::Camera::default() }, 64, 64);
        let solid_angle: f64 = (0..64 * 64)
            .map(|k| DVec2::new(f64::from(k % 64) + 0.5, f64::from(k / 64) + 0.5))
            .filter_map(|film| camera.project(camera.ray(film).at(1.0)))
            .map(|seen| 1.0 / seen.pixels_per_steradian)
            .sum();
        // One face of a cube; the midpoint rule on 64 x 64 cells errs by some 1e-4.
        assert!((solid_angle - 4.0 * std::f64::consts::PI / 6.0).abs() < 1e-3, "{solid_angle}");
    }
}
