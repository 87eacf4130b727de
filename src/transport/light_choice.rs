//! Which lights a point asks for direct light where there are many: few shadow rays, each for a light that probably
//! matters, at a cost per light that is far below a ray's.

use super::direct::Vertex;
use super::relevance::Relevance;
use crate::math::Rgb;
use crate::world::Light;
use glam::DVec3;
use std::f64::consts::PI;

/// So many lights or fewer are all asked; of more, so many are chosen.
pub(super) const CHOSEN: usize = 8;

/// Whether there are lights that not all points ask.
pub(super) fn chooses(relevances: &[Relevance]) -> bool {
    relevances.len() > CHOSEN || relevances.iter().any(|relevance| relevance.asked < 1.0)
}

/// Calls `ask(light, factor)` for some of the lights, with factors that make up for the others in the mean: of few lights
/// for each with the probability that its relevance says; of many, for [`CHOSEN`] (perhaps one of them several times).
///
/// The choice is systematic resampling: equal steps from the random number `u` through the sum of the lights' expected
/// shares, so that a light with more than a step is asked for sure.
pub(super) fn choose(
    lights: &[Light],
    relevances: &[Relevance],
    vertex: &Vertex,
    u: f64,
    mut ask: impl FnMut(&Light, f32),
) {
    if !chooses(relevances) {
        return lights.iter().for_each(|light| ask(light, 1.0));
    }
    let share = |(light, relevance): (&Light, &Relevance)| relevance.asked * expected_share(light, vertex);
    let (shares, step): (Vec<f64>, f64) = if lights.len() <= CHOSEN {
        // Each light's share is at most a step.
        (relevances.iter().map(|relevance| relevance.asked).collect(), 1.0)
    } else {
        let shares: Vec<f64> = lights.iter().zip(relevances).map(share).collect();
        let step = shares.iter().sum::<f64>() / CHOSEN as f64;
        (shares, step)
    };
    let mut next = u * step;
    let mut passed = 0.0;
    for (light, share) in lights.iter().zip(shares) {
        passed += share;
        // Written so that shares that are all 0, or not numbers, choose none.
        while next < passed {
            ask(light, (step / share) as f32);
            next += step;
        }
    }
}

/// About how much light a point gets from a light if nothing is between; 0 only where it gets none.
fn expected_share(light: &Light, vertex: &Vertex) -> f64 {
    let offset = light.center() - vertex.point.position;
    let strength = |c: Rgb| f64::from(c.max_element());
    let sent = match light {
        Light::Point { intensity, .. } => strength(*intensity),
        Light::Sphere { sphere, radiance } => strength(*radiance) * PI * sphere.radius * sphere.radius,
        Light::Quad { quad, radiance } if offset.dot(quad.normal()) < 0.0 => strength(*radiance) * quad.area(),
        Light::Quad { .. } => 0.0,
    };
    sent * received(vertex, offset, light.reach())
}

/// Inverse squared distance times about the cosine, of light from a ball of this radius at this offset; 0 only where the
/// ball is below the horizon.
fn received(vertex: &Vertex, offset: DVec3, radius: f64) -> f64 {
    /// Of the full cosine: a tilted shading normal may see what the surface hardly does.
    const LEAST: f64 = 0.1;
    let distance = offset.length().max(f64::MIN_POSITIVE);
    let highest = (offset.dot(vertex.n_side) + radius) / distance;
    if highest > 0.0 { highest.clamp(LEAST, 1.0) / (distance * distance).max(0.25 * radius * radius) } else { 0.0 }
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
        Vertex { point, scattering, n_side: DVec3::Y, n_shade: DVec3::Y, wo: DVec3::Y }
    }

    fn relevances(count: usize) -> Vec<Relevance> {
        vec![Relevance { asked: 1.0, of_paths: 1.0 }; count]
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
        let rounds = 20_000;
        let mut sums = vec![0.0; lights.len()];
        for round in 0..rounds {
            let u = (f64::from(round) + 0.5) / f64::from(rounds);
            let mut asked = 0;
            choose(&lights, &relevances(100), &vertex, u, |light, factor| {
                asked += 1;
                let index = lights.iter().position(|other| std::ptr::eq(other, light)).expect("one of them");
                sums[index] += f64::from(factor) / f64::from(rounds);
            });
            assert!(asked == CHOSEN || asked == CHOSEN - 1, "{asked}: the last step may fall off by rounding");
        }
        let shares: Vec<f64> = lights.iter().map(|light| expected_share(light, &vertex)).collect();
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
        choose(&lights(CHOSEN as u64), &relevances(CHOSEN), &vertex(), 0.5, |_, factor| {
            assert_eq!(factor, 1.0);
            asked += 1;
        });
        assert_eq!(asked, CHOSEN);
    }

    #[test]
    fn those_out_of_view_are_asked_seldom_and_count_the_more() {
        let mut relevances = relevances(3);
        relevances[1].asked = 0.125;
        let rounds = 1000;
        let (mut asked, mut sums) = ([0; 3], [0.0; 3]);
        let lights = lights(3);
        for round in 0..rounds {
            choose(&lights, &relevances, &vertex(), (f64::from(round) + 0.5) / f64::from(rounds), |light, factor| {
                let index = lights.iter().position(|other| std::ptr::eq(other, light)).expect("one of them");
                asked[index] += 1;
                sums[index] += factor;
            });
        }
        assert_eq!(asked, [1000, 125, 1000]);
        assert!(sums.iter().all(|sum| (sum - 1000.0).abs() < 1e-3), "{sums:?}");
    }
}
