//! The rays of a light through one of its points.

use super::chart::Chart;
use super::emission::{self, Emission, Origin};
use crate::geometry::Sphere;
use crate::math::{Rgb, Sampler, warp};
use crate::world::{Light, World};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// The rays of a light through one of its points, or in one direction of a sun, over the unit square of the light's chart. The mean over all
/// points of the light is all its light.
pub(in crate::transport) struct Pencil {
    chart: Chart,
    rays: Rays,
    /// Over the light of the rays if there were no other points.
    share: f32,
}

enum Rays {
    FromPoint(Origin),
    /// All through a point in a ball, with this intensity in all directions.
    ThroughBall(DVec3, Sphere, Rgb),
    /// In this unit direction, with this irradiance across the axis.
    Parallel(DVec3, Rgb),
}

impl Pencil {
    /// Whether a light has more than one pencil.
    pub(in crate::transport) fn varies(light: &Light) -> bool {
        match light {
            Light::Point { .. } => false,
            Light::Parallel(rays) => rays.half_angle > 0.0,
            Light::Sphere { .. } | Light::Quad { .. } => true,
        }
    }

    /// One of this many pencils that share the light. Draws numbers only for lights that have more than one.
    pub(in crate::transport) fn sample(world: &World, light: usize, count: u64, sampler: &mut Sampler) -> Self {
        let light = &world.lights[light];
        let rays = match light {
            Light::Parallel(rays) => {
                let (direction, irradiance) = rays.sample_direction(sampler);
                Rays::Parallel(direction, irradiance)
            }
            Light::Sphere { sphere, radiance } => {
                let point = warp::ball_of_even_discs(sampler.next_2d(), sampler.next_1d());
                through_ball(sphere.center + sphere.radius * point, *sphere, *radiance)
            }
            Light::Point { .. } | Light::Quad { .. } => Rays::FromPoint(emission::sample_origin(light, sampler)),
        };
        Self { chart: Chart::new(light), rays, share: 1.0 / count as f32 }
    }

    /// The pencil of the middle of a light, as if all light came from there.
    pub(in crate::transport) fn middle(world: &World, light: usize) -> Self {
        let light = &world.lights[light];
        let rays = match light {
            Light::Parallel(rays) => Rays::Parallel(rays.direction, rays.irradiance),
            Light::Sphere { sphere, radiance } => through_ball(sphere.center, *sphere, *radiance),
            Light::Point { .. } | Light::Quad { .. } => {
                Rays::FromPoint(emission::origin_at(light, || DVec2::splat(0.5)))
            }
        };
        Self { chart: Chart::new(light), rays, share: 1.0 }
    }

    /// The ray at a point of the square, its flux for a density of 1 over the square; `None` where the light does not shine.
    #[inline]
    pub(in crate::transport) fn ray(&self, square: DVec2) -> Option<Emission> {
        let emission = match (&self.chart, &self.rays) {
            (Chart::Disc(disc), Rays::Parallel(direction, irradiance)) => {
                let at = 2.0 * square - 1.0;
                let shines = disc.from_outside || at.length_squared() <= 1.0;
                let flux = *irradiance * (2.0 * disc.radius).powi(2) as f32;
                shines.then(|| Emission { origin: disc.point(at), direction: *direction, flux })
            }
            (chart, Rays::FromPoint(Origin { position, normal, strength })) => {
                let direction = chart.place_from_square()(square);
                let cos = normal.map_or(1.0, |normal| normal.dot(direction));
                let flux = *strength * (4.0 * PI * cos) as f32;
                (cos > 0.0).then_some(Emission { origin: *position, direction, flux })
            }
            (chart, Rays::ThroughBall(point, sphere, intensity)) => {
                let direction = chart.place_from_square()(square);
                let origin = exit(*point, direction, *sphere);
                Some(Emission { origin, direction, flux: *intensity * (4.0 * PI) as f32 })
            }
            (Chart::Directions { .. }, Rays::Parallel(..)) => None,
        };
        emission.map(|emission| Emission { flux: emission.flux * self.share, ..emission })
    }

    /// The part of the rays that goes between three of them: through the triangle that the rays at these points of the square span.
    pub(in crate::transport) fn part_between(&self, corners: [DVec2; 3]) -> f64 {
        self.chart.triangle_area(corners)
    }
}

/// The rays of a ball of light through one of its points: its intensity is the radiance times the area of its disc. Points of which the
/// ball's disc is full along every direction ([`warp::ball_of_even_discs`]) send out together what the ball sends out.
fn through_ball(point: DVec3, sphere: Sphere, radiance: Rgb) -> Rays {
    Rays::ThroughBall(point, sphere, radiance * (PI * sphere.radius * sphere.radius) as f32)
}

/// Where a ray from a point within a ball leaves it.
fn exit(point: DVec3, direction: DVec3, sphere: Sphere) -> DVec3 {
    let offset = point - sphere.center;
    let along = offset.dot(direction);
    let across = offset - along * direction;
    let half_chord = (sphere.radius * sphere.radius - across.length_squared()).max(0.0).sqrt();
    sphere.center + across + half_chord * direction
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Stream;
    use crate::transport::testing;

    /// The mean flux over the square and over the points of the lamp is the power.
    #[test]
    fn rays_carry_the_power_of_the_light() {
        let point = "[[light]]\nname = \"l\"\ntype = \"point\"\nposition = [0, 1, 0]\nintensity = [1, 2, 3]\n";
        let sphere =
            "[[light]]\nname = \"l\"\ntype = \"sphere\"\ncenter = [0, 1, 0]\nradius = 0.1\nradiance = [1, 2, 3]\n";
        let beam = "[[light]]\nname = \"l\"\ntype = \"beam\"\ncenter = [0, 1, 0]\ndirection = [0, -1, 0.2]\nradius = 0.3\npower = [1, 2, 3]\n";
        for light in [point, sphere, beam] {
            let world = testing::world(light);
            let mut sum = DVec3::ZERO;
            let (points, side) = (256, 64);
            for k in 0..points {
                let pencil = Pencil::sample(&world, 0, 1, &mut Sampler::new(1, Stream::LightSheets, 0, k));
                for cell in 0..side * side {
                    let square = (DVec2::new(f64::from(cell % side), f64::from(cell / side)) + 0.5) / f64::from(side);
                    sum += pencil.ray(square).map_or(Rgb::ZERO, |emission| emission.flux).as_dvec3();
                }
            }
            let mean = sum / f64::from(points as u32 * side * side);
            let ratio = mean / world.lights[0].power().as_dvec3();
            assert!((ratio - 1.0).abs().max_element() < 0.01, "{ratio} {light}");
        }
    }
}
