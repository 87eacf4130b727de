//! Sampling of many lights: a few shadow rays, each to a light that probably contributes, at a cost per light far below a ray's.

use crate::math::Rgb;
use crate::math::lanes::simd_dispatch;
use crate::transport::points::Vertex;
use crate::world::{Light, World};
use glam::{DVec3, Vec3};
use std::f64::consts::PI;

/// Up to this many lights are all sampled; of more, this many samples are drawn.
pub(in crate::transport) const MOST_SAMPLED: usize = 8;
/// Lights whose contributions are summed before the sampler looks at single ones.
const CHUNK: usize = 16;

/// Distance of the light that stands for parallel rays, in radii of their disc: its light is parallel up to the rounding of `f32`.
const FAR_AWAY: f64 = 1e7;

/// Samples lights in proportion to their expected contribution at a point.
#[derive(Clone, Debug)]
pub struct LightSampler {
    columns: Columns,
    /// Origin of the coordinates in the columns.
    center: DVec3,
}

/// The lights as a structure of arrays.
#[derive(Clone, Debug, Default)]
struct Columns {
    center: [Vec<f32>; 3],
    /// Unit normal of a quad; 0 for lights that shine to all sides.
    front: [Vec<f32>; 3],
    /// Radius of a ball about the center that holds the light.
    bounding_radius: Vec<f32>,
    /// Greatest intensity over the directions, W/sr.
    intensity: Vec<f32>,
}

impl LightSampler {
    /// The sampler for the lights of a world.
    pub(in crate::transport) fn new(world: &World) -> Self {
        Self::of(&world.lights, world.view.origin)
    }

    fn of(lights: &[Light], center: DVec3) -> Self {
        let mut columns = Columns::default();
        for light in lights {
            let front = if let Light::Quad { quad, .. } = light { quad.normal() } else { DVec3::ZERO };
            let (at, radius) = match light {
                Light::Parallel(rays) => {
                    let far = FAR_AWAY * rays.radius;
                    (rays.center - far * rays.direction, far * rays.half_angle.tan())
                }
                _ => (light.center(), light.bounding_radius()),
            };
            push(&mut columns.center, (at - center).as_vec3());
            push(&mut columns.front, front.as_vec3());
            columns.bounding_radius.push(radius as f32);
            columns.intensity.push(greatest_intensity(light) as f32);
        }
        Self { columns, center }
    }

    fn count(&self) -> usize {
        self.columns.intensity.len()
    }

    /// Whether there are more lights than a point samples.
    #[inline]
    pub(in crate::transport) fn draws(&self) -> bool {
        self.count() > MOST_SAMPLED
    }

    /// Calls `sample(light, weight)` for the lights that a vertex samples. Few lights are all sampled with weight 1. Of many lights
    /// [`MOST_SAMPLED`] are drawn (one light perhaps several times), with weights that make the sum unbiased.
    ///
    /// The draw is systematic resampling: equal steps from the random number `u` through the sum of the expected contributions, so
    /// that a light that contributes more than a step is always sampled.
    #[inline]
    pub(in crate::transport) fn sample(&self, vertex: &Vertex, u: f64, mut sample: impl FnMut(usize, f32)) {
        let count = self.count();
        if !self.draws() {
            return (0..count).for_each(|light| sample(light, 1.0));
        }
        let mut contributions = vec![0.0; count];
        let position = (vertex.point.position - self.center).as_vec3();
        expected_contributions(&self.columns, position, vertex.n_side.as_vec3(), &mut contributions);
        let chunks = contributions.chunks(CHUNK).map(|chunk| (chunk, chunk.iter().map(|&x| f64::from(x)).sum::<f64>()));
        let step = chunks.clone().map(|(_, sum)| sum).sum::<f64>() / MOST_SAMPLED as f64;
        let (mut passed, mut next) = (0.0, u * step);
        for (first, (chunk, sum)) in (0..).step_by(CHUNK).zip(chunks) {
            if next < passed + sum {
                let contributions = (first..).zip(chunk.iter().map(|&x| f64::from(x)));
                next = resample(contributions, step, (passed, next), &mut sample);
            }
            passed += sum;
        }
    }
}

/// Samples each light once for every step that falls into its contribution, from the sum `passed` and the step `next` on; returns the
/// step after the last one.
fn resample(
    contributions: impl Iterator<Item = (usize, f64)>,
    step: f64,
    (mut passed, mut next): (f64, f64),
    sample: &mut impl FnMut(usize, f32),
) -> f64 {
    for (light, contribution) in contributions {
        passed += contribution;
        // Written so that contributions that are all 0, or NaN, draw no light.
        while next < passed {
            sample(light, (step / contribution) as f32);
            next += step;
        }
    }
    next
}

fn push(columns: &mut [Vec<f32>; 3], value: Vec3) {
    columns.iter_mut().zip(value.to_array()).for_each(|(column, x)| column.push(x));
}

/// Greatest intensity of a light, or of the far light that stands for parallel rays, over the directions, of its strongest channel, W/sr.
fn greatest_intensity(light: &Light) -> f64 {
    let strength = |c: Rgb| f64::from(c.max_element());
    match light {
        Light::Point { intensity, .. } => strength(*intensity),
        Light::Sphere { sphere, radiance } => strength(*radiance) * PI * sphere.radius * sphere.radius,
        Light::Quad { quad, radiance } => strength(*radiance) * quad.area(),
        Light::Parallel(rays) => strength(rays.irradiance) * (FAR_AWAY * rays.radius).powi(2),
    }
}

simd_dispatch! {
    /// Estimates the irradiance, W per square scene unit, that a point gets from each light without occluders: intensity over squared
    /// distance times an upper bound of the cosine, for a ball that holds the light. 0 only where the light cannot reach the point.
    fn expected_contributions(lights: &Columns, position: Vec3, n_side: Vec3, contributions: &mut [f32]) {
        /// Least cosine at the point: a tilted shading normal may see what the surface hardly does.
        const LEAST_COS: f32 = 0.1;
        /// Sines of angles that are no more than rounding errors.
        const ROUNDING: f32 = 1e-5;
        /// Least cosine at a quad: for a quad seen edge-on, rounding may hide which side is seen.
        const LEAST_COS_OF_QUAD: f32 = 1e-3;
        let count = contributions.len();
        let [x, y, z] = lights.center.each_ref().map(|column| &column[..count]);
        let [front_x, front_y, front_z] = lights.front.each_ref().map(|column| &column[..count]);
        let (bounding_radius, intensity) = (&lights.bounding_radius[..count], &lights.intensity[..count]);
        for k in 0..count {
            let offset = [x[k] - position.x, y[k] - position.y, z[k] - position.z];
            let squared = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
            let squared = squared.max(f32::MIN_POSITIVE);
            let distance = squared.sqrt();
            let height = offset[0] * n_side.x + offset[1] * n_side.y + offset[2] * n_side.z;
            let highest = (height + bounding_radius[k]) / distance;
            let along_front = offset[0] * front_x[k] + offset[1] * front_y[k] + offset[2] * front_z[k];
            let is_quad = front_x[k] * front_x[k] + front_y[k] * front_y[k] + front_z[k] * front_z[k] > 0.5;
            let cos_of_quad = (-along_front / distance).clamp(LEAST_COS_OF_QUAD, 1.0);
            let towards_point = if is_quad { intensity[k] * cos_of_quad } else { intensity[k] };
            let contribution = towards_point * highest.clamp(LEAST_COS, 1.0) / squared.max(0.25 * bounding_radius[k] * bounding_radius[k]);
            let is_lit = (highest > -ROUNDING) & (along_front <= ROUNDING * distance);
            contributions[k] = if is_lit { contribution } else { 0.0 };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Hit, Quad, Sphere};
    use crate::math::chi_square::assert_has_frequencies;
    use crate::math::{Sampler, Stream, warp};
    use crate::world::{Lobe, Scattering, SurfacePoint};

    fn vertex() -> Vertex {
        let hit = Hit { t: 1.0, primitive: 0, u: 0.5, v: 0.5 };
        let point = SurfacePoint { position: DVec3::ZERO, n_geom: DVec3::Y, front: true, hit };
        let scattering = Scattering { albedo: Rgb::ONE, lobe: Lobe::None };
        Vertex { point, side: 0, material: 0, scattering, n_side: DVec3::Y, n_shade: DVec3::Y, wo: DVec3::Y }
    }

    fn sampler(lights: &[Light]) -> LightSampler {
        LightSampler::of(lights, DVec3::ZERO)
    }

    fn lights(count: u64) -> Vec<Light> {
        let light = |k: u64| {
            let mut s = Sampler::new(3, Stream::Camera, 1, k);
            let position = (0.2 + 5.0 * s.next_1d()) * warp::uniform_sphere(s.next_2d());
            let strength = Rgb::splat(s.next_1d().powi(4) as f32 + 1e-3);
            match k % 3 {
                0 => Light::Point { position, intensity: strength },
                1 => Light::Sphere { sphere: Sphere { center: position, radius: 0.05 }, radiance: strength },
                _ => Light::Quad { quad: Quad::new(position, 0.2 * DVec3::X, 0.3 * DVec3::Z), radiance: strength },
            }
        };
        (0..count).map(light).collect()
    }

    /// The weights of each light average to 1 where it contributes at all.
    #[test]
    fn the_mean_is_the_sum_over_all_lights() {
        let (vertex, lights) = (vertex(), lights(100));
        let sampler = sampler(&lights);
        let rounds = 20_000;
        let mut sums = vec![0.0; lights.len()];
        for round in 0..rounds {
            let u = (f64::from(round) + 0.5) / f64::from(rounds);
            let mut sampled = 0;
            sampler.sample(&vertex, u, |light, weight| {
                sampled += 1;
                sums[light] += f64::from(weight) / f64::from(rounds);
            });
            assert!(
                sampled == MOST_SAMPLED || sampled == MOST_SAMPLED - 1,
                "{sampled}: the last step may fall off by rounding"
            );
        }
        let mut contributions = vec![0.0; lights.len()];
        expected_contributions(&sampler.columns, Vec3::ZERO, Vec3::Y, &mut contributions);
        let contributions: Vec<f64> = contributions.into_iter().map(f64::from).collect();
        assert!(contributions.contains(&0.0), "some are below the horizon");
        let step = contributions.iter().sum::<f64>() / MOST_SAMPLED as f64;
        for ((light, sum), contribution) in lights.iter().zip(sums).zip(contributions) {
            let expected = if contribution > 0.0 { 1.0 } else { 0.0 };
            // A light is sampled in one interval of u, whose length the rounds know to one of them at each end.
            let tolerance = if contribution > 0.0 { 2.0 * step / contribution / f64::from(rounds) + 1e-6 } else { 0.0 };
            assert!((sum - expected).abs() <= tolerance, "{sum} for {light:?} that contributes {contribution}");
        }
    }

    /// One of the draws at random is each light with the probability of its expected contribution.
    #[test]
    fn draws_are_as_frequent_as_the_contributions_are_large() {
        let (vertex, lights) = (vertex(), lights(60));
        let sampler = sampler(&lights);
        let mut contributions = vec![0.0; lights.len()];
        expected_contributions(&sampler.columns, Vec3::ZERO, Vec3::Y, &mut contributions);
        let total = contributions.iter().map(|&c| f64::from(c)).sum::<f64>();
        let rounds = 50_000;
        let mut counts = vec![0; lights.len()];
        for round in 0..rounds {
            let mut numbers = Sampler::new(3, Stream::Camera, 2, round << 32);
            let mut draws = Vec::new();
            sampler.sample(&vertex, numbers.next_1d(), |light, weight| draws.push((light, weight)));
            let (light, weight) = draws[(numbers.next_1d() * draws.len() as f64) as usize];
            let expected = total / (MOST_SAMPLED as f64 * f64::from(contributions[light]));
            assert!((f64::from(weight) / expected - 1.0).abs() < 1e-4, "the weight is 1 over the expected draws");
            counts[light] += 1;
        }
        let expected: Vec<f64> = contributions.iter().map(|&c| rounds as f64 * f64::from(c) / total).collect();
        assert_has_frequencies("lights", &counts, &expected);
    }

    #[test]
    fn few_lights_are_all_sampled() {
        let mut sampled = 0;
        sampler(&lights(MOST_SAMPLED as u64)).sample(&vertex(), 0.5, |_, weight| {
            assert_eq!(weight, 1.0);
            sampled += 1;
        });
        assert_eq!(sampled, MOST_SAMPLED);
    }
}
