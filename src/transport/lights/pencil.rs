//! The rays of a light through one of its points.

use super::chart::Chart;
use super::emission::{self, Emission, Origin};
use crate::math::{Rgb, Sampler};
use crate::world::{Light, World};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// The rays of a light through one of its points, or in one direction of a sun, over the unit square of the light's chart. The mean over all
/// points of the light is all its light.
pub(in crate::transport) struct Pencil {
    chart: Chart,
    rays: Rays,
}

enum Rays {
    FromPoint(Origin),
    /// In this unit direction, with this irradiance across the axis.
    Parallel(DVec3, Rgb),
}

impl Pencil {
    /// The rays through a point that is even over the light. Draws numbers only for lights that have an extent.
    pub(in crate::transport) fn sample(world: &World, light: usize, sampler: &mut Sampler) -> Self {
        let light = &world.lights[light];
        let rays = match light {
            Light::Parallel(rays) => {
                let (direction, irradiance) = rays.sample_direction(sampler);
                Rays::Parallel(direction, irradiance)
            }
            _ => Rays::FromPoint(emission::sample_origin(light, sampler)),
        };
        Self { chart: Chart::new(light), rays }
    }

    /// The ray at a point of the square, its flux for a density of 1 over the square; `None` where the light does not shine.
    #[inline]
    pub(in crate::transport) fn ray(&self, square: DVec2) -> Option<Emission> {
        match (&self.chart, &self.rays) {
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
            (Chart::Directions { .. }, Rays::Parallel(..)) => None,
        }
    }

    /// The part of the rays that goes between three of them: through the triangle that the rays at these points of the square span.
    pub(in crate::transport) fn part_between(&self, corners: [DVec2; 3]) -> f64 {
        self.chart.triangle_area(corners)
    }
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
                let pencil = Pencil::sample(&world, 0, &mut Sampler::new(1, Stream::LightSheets, 0, k));
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
