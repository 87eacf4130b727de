//! Which lights a point asks for direct light where there are many: few shadow rays, each for a light that probably
//! matters, at a cost per light that is far below a ray's.

use super::direct::Vertex;
use crate::math::Rgb;
use crate::world::{Light, World};
use glam::{DVec3, Vec3};
use multiversion::multiversion;
use std::f64::consts::PI;

/// So many lights or fewer are all asked; of more, so many are chosen.
pub(super) const CHOSEN: usize = 8;
/// Lights whose shares are added up before any of them is looked at.
const RUN: usize = 16;

/// What the choice must know of the lights.
#[derive(Clone, Debug)]
pub struct LightChoice {
    columns: Columns,
    /// All places are relative to it.
    center: DVec3,
}

/// The lights side by side.
#[derive(Clone, Debug, Default)]
struct Columns {
    center: [Vec<f32>; 3],
    /// The side that a quad shines to; 0 for others, which shine to all.
    front: [Vec<f32>; 3],
    /// Of a ball about the center that holds the light.
    reach: Vec<f32>,
    /// Intensity towards where it is strongest.
    sent: Vec<f32>,
}

impl LightChoice {
    /// For the lights of a world.
    pub(super) fn new(world: &World) -> Self {
        Self::of(&world.lights, world.center)
    }

    fn of(lights: &[Light], center: DVec3) -> Self {
        let mut columns = Columns::default();
        for light in lights {
            let front = if let Light::Quad { quad, .. } = light { quad.normal() } else { DVec3::ZERO };
            push(&mut columns.center, (light.center() - center).as_vec3());
            push(&mut columns.front, front.as_vec3());
            columns.reach.push(light.reach() as f32);
            columns.sent.push(sent(light) as f32);
        }
        Self { columns, center }
    }

    fn count(&self) -> usize {
        self.columns.sent.len()
    }

    /// Whether there are more lights than a point asks.
    pub(super) fn is_needed(&self) -> bool {
        self.count() > CHOSEN
    }

    /// Calls `ask(light, factor)` for all of few lights, with the factor 1; of many, for [`CHOSEN`] (perhaps one of them
    /// several times), by their places, with factors that make up for the others in the mean.
    ///
    /// The choice is systematic resampling: equal steps from the random number `u` through the sum of the lights' expected
    /// shares, so that a light with more than a step is asked for sure.
    pub(super) fn choose(&self, vertex: &Vertex, u: f64, mut ask: impl FnMut(usize, f32)) {
        let count = self.count();
        if !self.is_needed() {
            return (0..count).for_each(|light| ask(light, 1.0));
        }
        let mut shares = vec![0.0; count];
        let position = (vertex.point.position - self.center).as_vec3();
        expected_shares(&self.columns, position, vertex.n_side.as_vec3(), &mut shares);
        let runs = shares.chunks(RUN).map(|run| (run, run.iter().map(|&share| f64::from(share)).sum::<f64>()));
        let step = runs.clone().map(|(_, sum)| sum).sum::<f64>() / CHOSEN as f64;
        let (mut passed, mut next) = (0.0, u * step);
        for (first, (run, sum)) in (0..).step_by(RUN).zip(runs) {
            if next < passed + sum {
                let shares = (first..).zip(run.iter().map(|&share| f64::from(share)));
                next = resample(shares, step, (passed, next), &mut ask);
            }
            passed += sum;
        }
    }
}

/// Asks each light for each step that falls into its share, from the sum so far and the next step on; returns the step after
/// the last.
fn resample(
    shares: impl Iterator<Item = (usize, f64)>,
    step: f64,
    (mut passed, mut next): (f64, f64),
    ask: &mut impl FnMut(usize, f32),
) -> f64 {
    for (light, share) in shares {
        passed += share;
        // Written so that shares that are all 0, or not numbers, choose none.
        while next < passed {
            ask(light, (step / share) as f32);
            next += step;
        }
    }
    next
}

fn push(columns: &mut [Vec<f32>; 3], value: Vec3) {
    columns.iter_mut().zip(value.to_array()).for_each(|(column, x)| column.push(x));
}

/// Intensity of a light towards where it is strongest.
fn sent(light: &Light) -> f64 {
    let strength = |c: Rgb| f64::from(c.max_element());
    match light {
        Light::Point { intensity, .. } => strength(*intensity),
        Light::Sphere { sphere, radiance } => strength(*radiance) * PI * sphere.radius * sphere.radius,
        Light::Quad { quad, radiance } => strength(*radiance) * quad.area(),
    }
}

/// About how much light a point gets from each light if nothing is between: intensity over squared distance times about the
/// cosine there, of a ball that holds the light; 0 only where it gets none.
#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
fn expected_shares(lights: &Columns, position: Vec3, n_side: Vec3, shares: &mut [f32]) {
    /// Of the full cosine: a tilted shading normal may see what the surface hardly does.
    const LEAST_COS: f32 = 0.1;
    /// Sines of angles that are no more than rounding.
    const ROUNDING: f32 = 1e-5;
    /// Of the cosine at a quad: at one that is seen edge-on rounding may hide which side is seen.
    const LEAST_COS_OF_QUAD: f32 = 1e-3;
    let count = shares.len();
    let [x, y, z] = lights.center.each_ref().map(|column| &column[..count]);
    let [front_x, front_y, front_z] = lights.front.each_ref().map(|column| &column[..count]);
    let (reach, sent) = (&lights.reach[..count], &lights.sent[..count]);
    for k in 0..count {
        let offset = [x[k] - position.x, y[k] - position.y, z[k] - position.z];
        let squared = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
        let squared = squared.max(f32::MIN_POSITIVE);
        let distance = squared.sqrt();
        let height = offset[0] * n_side.x + offset[1] * n_side.y + offset[2] * n_side.z;
        let highest = (height + reach[k]) / distance;
        let along_front = offset[0] * front_x[k] + offset[1] * front_y[k] + offset[2] * front_z[k];
        let is_quad = front_x[k] * front_x[k] + front_y[k] * front_y[k] + front_z[k] * front_z[k] > 0.5;
        let cos_of_quad = (-along_front / distance).clamp(LEAST_COS_OF_QUAD, 1.0);
        let sent_here = if is_quad { sent[k] * cos_of_quad } else { sent[k] };
        let share = sent_here * highest.clamp(LEAST_COS, 1.0) / squared.max(0.25 * reach[k] * reach[k]);
        let is_lit = (highest > -ROUNDING) & (along_front <= ROUNDING * distance);
        shares[k] = if is_lit { share } else { 0.0 };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Hit, Quad, Sphere};
    use crate::math::{Sampler, Stream, warp};
    use crate::world::{Lobe, Scattering, SurfacePoint};

    fn vertex() -> Vertex {
        let hit = Hit { t: 1.0, primitive: 0, u: 0.5, v: 0.5 };
        let point = SurfacePoint { position: DVec3::ZERO, n_geom: DVec3::Y, front: true, hit };
        let scattering = Scattering { albedo: Rgb::ONE, lobe: Lobe::None };
        Vertex { point, scattering, n_side: DVec3::Y, n_shade: DVec3::Y, wo: DVec3::Y, seen_in: None }
    }

    fn choice(lights: &[Light]) -> LightChoice {
        LightChoice::of(lights, DVec3::ZERO)
    }

    fn lights(count: u64) -> Vec<Light> {
        let light = |k: u64| {
            let mut s = Sampler::new(3, Stream::Test, 1, k);
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

    /// Each light's factors average to 1 wherever it gives light at all.
    #[test]
    fn the_mean_is_all_lights() {
        let (vertex, lights) = (vertex(), lights(100));
        let choice = choice(&lights);
        let rounds = 20_000;
        let mut sums = vec![0.0; lights.len()];
        for round in 0..rounds {
            let u = (f64::from(round) + 0.5) / f64::from(rounds);
            let mut asked = 0;
            choice.choose(&vertex, u, |light, factor| {
                asked += 1;
                sums[light] += f64::from(factor) / f64::from(rounds);
            });
            assert!(asked == CHOSEN || asked == CHOSEN - 1, "{asked}: the last step may fall off by rounding");
        }
        let mut shares = vec![0.0; lights.len()];
        expected_shares(&choice.columns, Vec3::ZERO, Vec3::Y, &mut shares);
        let shares: Vec<f64> = shares.into_iter().map(f64::from).collect();
        assert!(shares.contains(&0.0), "some are below the horizon");
        let step = shares.iter().sum::<f64>() / CHOSEN as f64;
        for ((light, sum), share) in lights.iter().zip(sums).zip(shares) {
            let expected = if share > 0.0 { 1.0 } else { 0.0 };
            // A light is asked in one interval of u, whose length the rounds know to one of them at each end.
            let tolerance = if share > 0.0 { 2.0 * step / share / f64::from(rounds) + 1e-6 } else { 0.0 };
            assert!((sum - expected).abs() <= tolerance, "{sum} for {light:?} of share {share}");
        }
    }

    #[test]
    fn few_are_all_asked() {
        let mut asked = 0;
        choice(&lights(CHOSEN as u64)).choose(&vertex(), 0.5, |_, factor| {
            assert_eq!(factor, 1.0);
            asked += 1;
        });
        assert_eq!(asked, CHOSEN);
    }
}
