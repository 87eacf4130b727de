//! The camera that shows given balls as large as the picture holds them.

use super::extent::bounds;
use super::turntable::{axes, is_usable};
use crate::geometry::Sphere;
use crate::scene::Camera;
use glam::DVec3;

/// Share of the picture's width or height that framed balls fill.
const FILL: f64 = 0.9;
/// Smallest distance to the nearest ball over the diagonal of the box around all balls: a thin shape that is seen from its
/// end stays before the camera.
const CLEARANCE: f64 = 0.1;

/// The camera with its present direction that shows all balls as large as a picture holds them with a margin; `aspect` is
/// the picture's width over its height. A single point keeps its depth. `None` without balls, for a camera without
/// direction or angle of view, and where no scene may hold the camera.
pub(crate) fn framed(camera: &Camera, aspect: f64, balls: &[Sphere]) -> Option<Camera> {
    let (forward, right, _) = axes(camera)?;
    let bounds = bounds(balls)?;
    let center = bounds.center();
    let tan = FILL * (0.5 * camera.fov_y.to_radians()).tan();
    if !(camera.fov_y > 0.0 && camera.fov_y < 180.0 && aspect > 0.0) {
        return None;
    }
    let wedge = Wedge { balls, center, forward };
    let (x, depth_x) = wedge.apex(right, tan * aspect);
    let (y, depth_y) = wedge.apex(right.cross(forward), tan);
    let depth = depth_x.min(depth_y).min(wedge.nearest() - CLEARANCE * bounds.diagonal());
    let target = center + x * right + y * right.cross(forward);
    let at = |depth: f64| Camera { position: target + depth * forward, target, ..*camera };
    let present = (target - camera.position).dot(forward);
    let behind = camera.position.distance(camera.target);
    let present = if present > 0.0 { present } else { behind };
    [at(depth), at(-present)].into_iter().find(|camera| depth <= 0.0 && is_usable(camera))
}

/// Balls with a view direction. Depths and positions are relative to `center`.
struct Wedge<'a> {
    balls: &'a [Sphere],
    center: DVec3,
    forward: DVec3,
}

impl Wedge<'_> {
    /// Position along `axis` and depth of the camera whose two planes with the slope `tan` to both sides enclose all balls
    /// most closely: each plane touches a ball.
    fn apex(&self, axis: DVec3, tan: f64) -> (f64, f64) {
        let slant = (1.0 + tan * tan).sqrt();
        // A ball at (x, z) with radius r is inside while tan (z - depth) - (x - position) >= slant r, and mirrored.
        let plane = |axis: DVec3| {
            let offsets = self.balls.iter().map(|ball| {
                let at = ball.center - self.center;
                at.dot(axis) - tan * at.dot(self.forward) + slant * ball.radius
            });
            offsets.fold(f64::NEG_INFINITY, f64::max)
        };
        let (a, b) = (plane(axis), plane(-axis));
        (0.5 * (a - b), -0.5 * (a + b) / tan)
    }

    /// Depth of the nearest point of any ball.
    fn nearest(&self) -> f64 {
        let depths = self.balls.iter().map(|ball| (ball.center - self.center).dot(self.forward) - ball.radius);
        depths.fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::canvas::Projection;
    use crate::scene::Film;
    use glam::DVec2;

    fn camera() -> Camera {
        Camera { position: DVec3::new(3.0, 2.0, 5.0), target: DVec3::new(0.5, 0.0, 0.2), ..Camera::default() }
    }

    fn points(points: &[DVec3]) -> Vec<Sphere> {
        points.iter().map(|&center| Sphere { center, radius: 0.0 }).collect()
    }

    /// Largest distance of the points from the film centre along x and y, over half the film size.
    fn filled(camera: &Camera, film: &Film, points: &[DVec3]) -> DVec2 {
        let projection = Projection::new(camera, film).unwrap();
        let half = 0.5 * DVec2::new(f64::from(film.width), f64::from(film.height));
        let offsets = points.iter().map(|&point| (projection.project(point).unwrap() - half).abs() / half);
        offsets.fold(DVec2::ZERO, DVec2::max)
    }

    #[test]
    fn framed_points_fill_the_picture_up_to_the_margin() {
        for size in [1e-6, 1.0, 1e6] {
            let corners: Vec<DVec3> = (0..8)
                .map(|k| size * DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1) * 0.3, f64::from(k >> 2)))
                .collect();
            for (width, height) in [(640, 480), (200, 800)] {
                let film = Film { width, height, ..Film::default() };
                let aspect = f64::from(width) / f64::from(height);
                let framed = framed(&camera(), aspect, &points(&corners)).unwrap();
                let filled = filled(&framed, &film, &corners);
                assert!((filled.max_element() - FILL).abs() < 1e-12, "{filled} at size {size} on {width} x {height}");
                let direction = |camera: &Camera| (camera.target - camera.position).normalize();
                assert!(direction(&framed).distance(direction(&camera())) < 1e-12, "the direction stays");
            }
        }
    }

    #[test]
    fn a_framed_ball_touches_the_margin() {
        let ball = Sphere { center: DVec3::new(7.0, -1.0, 2.0), radius: 0.5 };
        let framed = framed(&camera(), 1.5, &[ball]).unwrap();
        assert!(framed.target.distance(ball.center) < 1e-14, "in the middle");
        let sine = ball.radius / framed.position.distance(ball.center);
        let tan = FILL * (0.5 * camera().fov_y.to_radians()).tan();
        assert!((sine / (1.0 - sine * sine).sqrt() - tan).abs() < 1e-14, "{sine}");
    }

    #[test]
    fn a_single_point_keeps_its_depth() {
        let forward = (camera().target - camera().position).normalize();
        let point = camera().position + 2.0 * forward + 0.3 * DVec3::Y;
        let depth = 2.0 + 0.3 * forward.y;
        let framed = framed(&camera(), 1.0, &points(&[point])).unwrap();
        assert_eq!(framed.target, point);
        assert!((framed.position.distance(point) - depth).abs() < 1e-14, "{framed:?}");
    }

    #[test]
    fn a_line_along_the_view_stays_before_the_camera() {
        let forward = (camera().target - camera().position).normalize();
        let line = [DVec3::ONE, DVec3::ONE + 3.0 * forward];
        let framed = framed(&camera(), 1.0, &points(&line)).unwrap();
        assert!(((DVec3::ONE - framed.position).dot(forward) - 0.3).abs() < 1e-12, "{framed:?}");
    }

    #[test]
    fn nothing_and_a_camera_without_direction_frame_nothing() {
        assert_eq!(framed(&camera(), 1.0, &[]), None);
        let lost = Camera { target: camera().position, ..camera() };
        assert_eq!(framed(&lost, 1.0, &points(&[DVec3::ONE])), None);
        assert_eq!(framed(&Camera { fov_y: 180.0, ..camera() }, 1.0, &points(&[DVec3::ONE])), None);
    }
}
