//! Bundles: the rays that go from a wide light to a ball.

use crate::geometry::Sphere;
use crate::math::{OrthonormalBasis, Ray, Sampler, warp};
use crate::world::Light;
use glam::DVec3;
use std::f64::consts::PI;

/// Rays in a cone of directions that meet a ball, even over the directions and over the disc of the ball across each. All rays from the
/// light to the ball are among them. In proportion to the light's emission hardly any path would meet a ball that is small beside
/// a far light.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bundle {
    ball: Sphere,
    /// Unit axis of the cone, from the light.
    axis: DVec3,
    /// `1 - cos` of half the angle of the cone.
    one_minus_cos: f64,
}

impl Bundle {
    /// The rays from a light to a ball; `None` unless the light is wider than the ball, as seen from the ball: from a narrower one the rays to
    /// the ball have nearly the same directions wherever they begin.
    pub(super) fn new(light: &Light, ball: Sphere) -> Option<Self> {
        let (axis, sine) = match light {
            Light::Point { .. } => return None,
            Light::Parallel(rays) => {
                let aside = (ball.center - rays.center).dot(rays.direction).abs() * rays.half_angle.tan();
                (aside > ball.radius).then_some((rays.direction, rays.half_angle.sin()))?
            }
            Light::Sphere { .. } | Light::Quad { .. } => {
                let (offset, of_light) = (ball.center - light.center(), light.bounding_radius());
                let sine = (of_light + ball.radius) / offset.length();
                (of_light > ball.radius).then_some((offset.normalize_or(DVec3::Z), sine))?
            }
        };
        // Without cancellation for a small angle; all directions from a ball within the light's.
        let one_minus_cos = if sine < 1.0 { sine * sine / (1.0 + (1.0 - sine * sine).sqrt()) } else { 2.0 };
        (ball.radius > 0.0).then_some(Self { ball, axis, one_minus_cos })
    }

    /// Etendue of the rays, steradians times square scene units, over that of all rays of the light.
    pub(super) fn fraction_of(&self, light: &Light) -> f64 {
        let of_light = match light {
            Light::Point { .. } => return 1.0,
            Light::Sphere { sphere, .. } => PI * 4.0 * PI * sphere.radius * sphere.radius,
            Light::Quad { quad, .. } => PI * quad.area(),
            Light::Parallel(rays) => self.solid_angle() * rays.area(),
        };
        1.0 / (self.density() * of_light)
    }

    /// Density of the rays, per steradian and area across them.
    pub(super) fn density(&self) -> f64 {
        1.0 / (self.solid_angle() * PI * self.ball.radius * self.ball.radius)
    }

    fn solid_angle(&self) -> f64 {
        2.0 * PI * self.one_minus_cos
    }

    /// Whether a ray that leaves a point of the light in this direction (unit length) is one of the bundle.
    #[inline]
    pub(super) fn contains(&self, light_point: DVec3, direction: DVec3) -> bool {
        let offset = self.ball.center - light_point;
        // Away from the ball go rays of other directions.
        let is_in_cone = self.one_minus_cos > 1.0 || direction.dot(self.axis) > 0.0;
        is_in_cone
            && (offset - offset.dot(direction) * direction).length_squared() <= self.ball.radius * self.ball.radius
    }

    /// Samples a ray: the point of a light that it leaves (of a sun, any point on it), and its direction; `None` for a ray beside the light.
    pub(super) fn sample(&self, light: &Light, sampler: &mut Sampler) -> Option<(DVec3, DVec3)> {
        let direction = OrthonormalBasis::from_normal(self.axis)
            .world_from_local(warp::uniform_cone(sampler.next_2d(), self.one_minus_cos));
        let across = (self.ball.radius * warp::concentric_disc(sampler.next_2d())).extend(0.0);
        let point = self.ball.center + OrthonormalBasis::from_normal(direction).world_from_local(across);
        match light {
            Light::Point { .. } => None,
            Light::Sphere { sphere, .. } => {
                let offset = point - sphere.center;
                let across = offset - offset.dot(direction) * direction;
                let half_chord = (sphere.radius * sphere.radius - across.length_squared()).sqrt();
                (!half_chord.is_nan()).then(|| (sphere.center + across + half_chord * direction, direction))
            }
            Light::Quad { quad, .. } => {
                let line = Ray { t_min: f64::NEG_INFINITY, ..Ray::new(point, direction) };
                let (_, u, v) = quad.intersect(&line)?;
                (direction.dot(quad.normal()) > 0.0).then(|| (quad.position(u, v), direction))
            }
            Light::Parallel(_) => Some((point, direction)),
        }
    }
}
