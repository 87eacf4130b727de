//! The first rays of a light's paths that may meet a ball, such as the one around an object.

use super::bundle::Bundle;
use super::chart::Chart;
use super::cone::Cone;
use crate::geometry::{Primitive, Sphere};
use crate::math::Aabb;
use crate::world::{Light, World};
use glam::DVec3;
use std::collections::BTreeMap;

/// Radius of a ball in the chart (radians where the chart is of directions) below which cells around it are refined: it fills less than a
/// cell.
const SMALL: f64 = 0.02;

/// Places in the chart over rays from which on the rays are a bundle: of the paths to those places, the others miss the ball. A density
/// takes more time with bundles.
const WASTE: f64 = 16.0;

/// A function that tells whether photons are to reach a primitive.
pub(super) trait Aim: Fn(u32) -> bool + Sync {}
impl<F: Fn(u32) -> bool + Sync> Aim for F {}

/// The first rays of a light's paths that may meet a ball.
#[derive(Clone, Copy, Debug)]
pub(super) enum RaysToBall {
    /// Nearly the same places of the chart from all points of the light.
    Cone(Cone),
    /// From each point of a wide light other places.
    Bundle(Bundle),
}

impl RaysToBall {
    /// `None` if the ball surrounds the light, and for an unbounded one.
    pub(super) fn new(light: &Light, chart: &Chart, ball: Sphere) -> Option<Self> {
        let cone = chart.cone(ball);
        let in_chart = cone.map_or(1.0, |cone| cone.fraction_of_chart());
        let is_narrower = |bundle: &Bundle| WASTE * bundle.fraction_of(light) < in_chart;
        Bundle::new(light, ball).filter(is_narrower).map(Self::Bundle).or(cone.map(Self::Cone))
    }

    /// The cone in the chart; `None` for a bundle.
    pub(super) fn cone(&self) -> Option<&Cone> {
        match self {
            Self::Cone(cone) => Some(cone),
            Self::Bundle(_) => None,
        }
    }

    /// Fraction of the light's rays, or of its chart.
    pub(super) fn fraction_of(&self, light: &Light) -> f64 {
        match self {
            Self::Cone(cone) => cone.fraction_of_chart(),
            Self::Bundle(bundle) => bundle.fraction_of(light),
        }
    }

    /// Whether so few rays meet the ball that the probe rays of a projection map may all miss it.
    pub(super) fn are_few(&self) -> bool {
        match self {
            Self::Cone(cone) => cone.radius < SMALL,
            Self::Bundle(_) => true,
        }
    }
}

/// For each object with surfaces to reach a ball around them; of infinite radius around a plane.
pub(super) fn balls_of_objects(world: &World, aim: &impl Aim) -> BTreeMap<u32, Sphere> {
    let mut bounds = BTreeMap::<u32, Aabb>::new();
    for (p, primitive) in (0..).zip(world.aggregate.primitives()) {
        if let Some(object) = world.object_of(p).filter(|_| aim(p)) {
            let unbounded = Aabb { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY };
            let of_primitive = if matches!(primitive, Primitive::Plane(_)) { unbounded } else { primitive.bounds() };
            let of_object = bounds.entry(object).or_insert(Aabb::EMPTY);
            *of_object = of_object.union(&of_primitive);
        }
    }
    bounds.iter().map(|(&object, bounds)| (object, ball_around(bounds))).collect()
}

/// The fraction of the light's rays that may meet the objects to reach; `None` if one surrounds the light.
pub(super) fn fraction_of_objects(world: &World, light: &Light, chart: &Chart, aim: &impl Aim) -> Option<f64> {
    let of_ball = |ball| RaysToBall::new(light, chart, ball).map(|rays| rays.fraction_of(light));
    balls_of_objects(world, aim).into_values().map(of_ball).sum()
}

/// The rays to a ball around what matters in the view, if objects take a far greater fraction of the light's rays (`None`: they surround
/// the light), at least `spread` times as great, so that photons are to aim at the view. `None` also for a view beside a beam.
pub(super) fn rays_to_view(
    light: &Light,
    chart: &Chart,
    ball: Sphere,
    by_objects: Option<f64>,
    spread: f64,
) -> Option<RaysToBall> {
    let is_small_part = |rays: &RaysToBall| by_objects.unwrap_or(1.0) > spread * rays.fraction_of(light);
    RaysToBall::new(light, chart, ball)
        .filter(|rays| is_small_part(rays) && rays.cone().is_none_or(|cone| chart.meets(cone)))
}

/// The ball around a box.
pub(super) fn ball_around(bounds: &Aabb) -> Sphere {
    Sphere { center: bounds.center(), radius: 0.5 * bounds.diagonal() }
}
