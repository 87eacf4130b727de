//! Probe rays from a light into the cells of its chart, and to balls around small objects.

use super::chart::{Chart, crossing_at};
use super::cone::Cone;
use super::emission::{self, Origin};
use super::rays_to_ball::{Aim, RaysToBall};
use super::small_targets::Place;
use crate::geometry::Sphere;
use crate::math::{OrthonormalBasis, Ray, Sampler, Stream, warp};
use crate::world::{Light, World};
use glam::{DVec2, DVec3};

/// Cells along a side of the chart: of directions, a cell subtends about 3 degrees, narrower than most objects.
pub(in crate::transport) const SIDE: usize = 64;
/// Probe rays along a side of a cell; one in scenes where points sample only some of many lights. Three would take 37 000 instead of 16 000
/// rays for each light after an edit; with one, more mirrors are found by the defensive paths alone, which leaves their caustics noisy.
pub(super) const PROBES_ALONG_SIDE: u64 = 2;
/// Rays to a small object that tell whether the light meets it. Fewer may all miss an object of which others hide all but a tenth, whose
/// light is then left to the defensive paths; more would take time for each object and light after an edit.
const RAYS_TO_SMALL_OBJECT: u64 = 32;
/// The same for an object beside a wide light: most of the rays pass beside a flat lamp that is seen aslant.
const RAYS_OF_BUNDLE: u64 = 256;

/// Probe rays from a light.
pub(super) struct Probes<'a> {
    pub(super) world: &'a World,
    pub(super) light: &'a Light,
    pub(super) light_index: u64,
    pub(super) chart: Chart,
}

/// The part of a probe ray that its place in the chart leaves open.
enum Start {
    Origin(Origin),
    /// The direction of a ray through a disc.
    Direction(DVec3),
}

impl Probes<'_> {
    /// Whether the probe ray into one of the `along` times `along` strata of a cell meets such a surface first.
    pub(super) fn meet_in_cell(&self, cell: usize, probe: u64, along: u64, is_aim: &impl Aim) -> bool {
        let index = cell as u64 * along * along + probe;
        let mut sampler = Sampler::new(0, Stream::Probe, self.light_index, index);
        let start = self.start(&mut sampler);
        let stratum = DVec2::new((probe % along) as f64, (probe / along) as f64);
        let within = (stratum + sampler.next_2d()) / along as f64;
        let corner = DVec2::new((cell % SIDE) as f64, (cell / SIDE) as f64);
        self.meet(&start, self.chart.place_from_square()((corner + within) / SIDE as f64), is_aim)
    }

    /// How many of some rays to a ball meet such a surface first, and the number of rays. From each point of a lamp, and in each
    /// direction of a sun, the rays aim at the ball.
    pub(super) fn count_met(
        &self,
        ball_index: u64,
        ball: Sphere,
        rays: RaysToBall,
        is_aim: &impl Aim,
    ) -> (usize, usize) {
        let sampler = |count: u64, k: u64| {
            let index = (SIDE * SIDE) as u64 * PROBES_ALONG_SIDE * PROBES_ALONG_SIDE + ball_index * count + k;
            Sampler::new(0, Stream::Probe, self.light_index, index)
        };
        let cone = match rays {
            RaysToBall::Cone(cone) => cone,
            RaysToBall::Bundle(bundle) => {
                let rays: Vec<(DVec3, DVec3)> = (0..RAYS_OF_BUNDLE)
                    .filter_map(|k| bundle.sample(self.light, &mut sampler(RAYS_OF_BUNDLE, k)))
                    .collect();
                let meets = |&&(origin, direction): &&(DVec3, DVec3)| self.meets(&self.ray(origin, direction), is_aim);
                return (rays.iter().filter(meets).count(), rays.len());
            }
        };
        let meets = |&k: &u64| {
            let mut sampler = sampler(RAYS_TO_SMALL_OBJECT, k);
            let start = self.start(&mut sampler);
            let u = sampler.next_2d();
            let place = match &start {
                Start::Origin(origin) => {
                    let seen = Cone::around(ball.center - origin.position, ball.radius).unwrap_or(cone);
                    // 1 - cos of the angle.
                    let height = 2.0 * (0.5 * seen.radius).sin().powi(2);
                    OrthonormalBasis::from_normal(seen.middle).world_from_local(warp::uniform_cone(u, height))
                }
                Start::Direction(direction) => {
                    return self.meets(&self.ray(self.chart.point_before(ball, *direction, u), *direction), is_aim);
                }
            };
            self.meet(&start, place, is_aim)
        };
        ((0..RAYS_TO_SMALL_OBJECT).filter(meets).count(), RAYS_TO_SMALL_OBJECT as usize)
    }

    fn start(&self, sampler: &mut Sampler) -> Start {
        match &self.chart {
            Chart::Directions { .. } => Start::Origin(emission::sample_origin(self.light, sampler)),
            Chart::Disc(rays) => Start::Direction(rays.sample_direction(sampler).0),
        }
    }

    fn meet(&self, start: &Start, place: Place, is_aim: &impl Aim) -> bool {
        let ray = match (&self.chart, start) {
            (Chart::Disc(rays), Start::Direction(direction)) => self.ray(rays.point(crossing_at(place)), *direction),
            (_, Start::Origin(origin)) if origin.normal.is_none_or(|normal| normal.dot(place) > 0.0) => {
                self.ray(origin.position, place)
            }
            _ => return false,
        };
        self.meets(&ray, is_aim)
    }

    fn meets(&self, ray: &Ray, is_aim: &impl Aim) -> bool {
        self.world.aggregate.closest_hit(ray).is_some_and(|hit| is_aim(hit.primitive))
    }

    fn ray(&self, origin: DVec3, direction: DVec3) -> Ray {
        emission::ray_from_light(self.world, self.light_index as usize, origin, direction)
    }
}
