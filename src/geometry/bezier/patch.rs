use super::ControlNet;
use super::normal::unit_normal;
use super::power::PowerForm;
use super::row_net::RowNet;
use super::together::nearest_hits;
use super::traverse::{Hit, has_hit, nearest_hit};
use super::tree::PartTree;
use super::unit::{UnitMap, UnitRay};
use crate::math::lanes::{LANES, set_bits};
use crate::math::{Aabb, Ray};
use glam::DVec3;
use std::sync::OnceLock;

/// A patch to be met by rays. The first one that comes near makes it ready, so that one that is hidden costs nothing.
#[derive(Clone, Debug)]
pub struct Patch {
    net: ControlNet,
    unit_map: UnitMap,
    unit_net: ControlNet,
    prepared: OnceLock<Prepared>,
}

/// What rays in unit space need.
#[derive(Clone, Debug)]
pub(super) struct Prepared {
    pub(super) net: RowNet,
    pub(super) power: PowerForm,
    pub(super) tree: PartTree,
}

/// Where a ray meets a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchHit {
    /// Of the ray's point nearest to `S(u, v)`, in units of the ray's direction.
    pub t: f64,
    /// In `[0, 1]`.
    pub u: f64,
    /// In `[0, 1]`.
    pub v: f64,
}

impl From<Hit> for PatchHit {
    fn from(Hit { root, t }: Hit) -> Self {
        let parameter = |x: f64| (0.5 * x + 0.5).clamp(0.0, 1.0);
        Self { t, u: parameter(root.x), v: parameter(root.y) }
    }
}

impl Patch {
    /// The patch of a net. Coordinates that are not finite give a patch that no ray meets.
    pub fn new(net: ControlNet) -> Self {
        // No ray meets an empty box.
        let bounds = if net.is_finite() { net.bounds() } else { Aabb::EMPTY };
        let unit_map = UnitMap::new(bounds.center(), bounds.diagonal());
        let unit_net = net.map(|p| unit_map.point(p));
        Self { net, unit_map, unit_net, prepared: OnceLock::new() }
    }

    /// What rays need; the first call prepares it.
    fn prepared(&self) -> &Prepared {
        self.prepared.get_or_init(|| {
            let rows = RowNet::new(&self.unit_net);
            Prepared { net: rows, power: PowerForm::new(&self.unit_net), tree: PartTree::new(&rows) }
        })
    }

    /// Makes the patch ready now; else the first ray that comes near does.
    pub fn prepare(&self) {
        self.prepared();
    }

    /// Whether anything made it ready.
    pub fn is_prepared(&self) -> bool {
        self.prepared.get().is_some()
    }

    /// The control points.
    pub fn net(&self) -> &ControlNet {
        &self.net
    }

    /// A box that holds the patch and every computed point of it.
    pub fn bounds(&self) -> Aabb {
        let bounds = self.net.bounds();
        // Evaluation rounds some ten times, each by at most half an ulp of the largest coordinate.
        bounds.inflated(1e-15 * bounds.min.abs().max(bounds.max.abs()).max_element())
    }

    /// The nearest hit with `t_min < t < t_max`.
    pub fn intersect(&self, ray: &Ray) -> Option<PatchHit> {
        let ray = self.unit_map.ray(ray)?;
        Some(nearest_hit(self.prepared(), ray)?.into())
    }

    /// The nearest hits of those rays whose bits are set in `counting`: the same as one by one, but quicker for rays that
    /// go nearly the same way.
    pub fn intersect_together(&self, rays: &[Ray; LANES], counting: u32) -> [Option<PatchHit>; LANES] {
        let mut unit_rays = [UnitRay::NONE; LANES];
        for k in set_bits(counting) {
            unit_rays[k] = self.unit_map.ray(&rays[k]).unwrap_or(UnitRay::NONE);
        }
        nearest_hits(self.prepared(), &unit_rays).map(|hit| hit.map(PatchHit::from))
    }

    /// Whether the ray meets the patch at any `t_min < t < t_max`.
    pub fn occluded(&self, ray: &Ray) -> bool {
        self.unit_map.ray(ray).is_some_and(|ray| has_hit(self.prepared(), ray))
    }

    /// How far a point is from boxes that hold the patch closely, or `limit` if that is less.
    pub fn distance(&self, point: DVec3, limit: f64) -> f64 {
        let far = self.bounds().distance(point);
        if far >= limit {
            return limit;
        }
        far.max(
            self.prepared().tree.distance(self.unit_map.point(point), limit * self.unit_map.scale())
                / self.unit_map.scale(),
        )
    }

    /// The unit geometric normal `dS/du x dS/dv`; its limit on collapsed edges, equal rows and cusps. Never NaN.
    pub fn normal(&self, u: f64, v: f64) -> DVec3 {
        unit_normal(&self.unit_net, u, v)
    }

    /// Memory of the patch with everything it owns so far.
    pub fn memory_bytes(&self) -> usize {
        size_of::<Self>() + self.prepared.get().map_or(0, |prepared| prepared.tree.heap_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::array::from_fn;

    fn net(f: impl Fn(f64, f64) -> DVec3) -> ControlNet {
        ControlNet { points: from_fn(|i| from_fn(|j| f(i as f64 / 3.0, j as f64 / 3.0))) }
    }

    /// Rays of all kinds at a patch: through points of it in many directions, along its edges, past it, from far away.
    fn rays(net: &ControlNet) -> Vec<Ray> {
        let size = net.bounds().diagonal().max(1e-3);
        let mut rays = Vec::new();
        for k in 0..200 {
            let x = f64::from(k);
            let target = net.eval((0.7 * x).fract(), (0.3 * x).fract());
            let direction = DVec3::new((1.1 * x).sin(), (2.3 * x).cos(), (0.7 * x).sin() + 1e-3);
            let along_axis = DVec3::AXES[k as usize % 3];
            rays.push(Ray::new(target - size * direction, direction));
            rays.push(Ray::new(target - 1e6 * size * direction, 1e-3 * direction));
            rays.push(Ray::new(target - size * along_axis, along_axis));
            rays.push(Ray::new(target, net.points[3][3] - net.points[0][0] + 1e-9 * direction));
        }
        rays
    }

    fn check(name: &str, net: &ControlNet) {
        let patch = Patch::new(*net);
        for ray in rays(net) {
            let Some(hit) = patch.intersect(&ray) else { continue };
            let inside = |x: f64| (0.0..=1.0).contains(&x);
            assert!(hit.t > 0.0 && hit.t.is_finite() && inside(hit.u) && inside(hit.v), "{name}: {hit:?}");
            assert!(patch.occluded(&ray), "{name}: {ray:?}");
        }
        for k in 0..25 {
            let normal = patch.normal(f64::from(k / 5) / 4.0, f64::from(k % 5) / 4.0);
            assert!(normal.is_normalized(), "{name}: {normal}");
        }
        patch.prepare();
        assert!(patch.memory_bytes() < 65_536, "{name}: {} bytes", patch.memory_bytes());
    }

    #[test]
    fn degenerate_patches_are_met_without_harm() {
        let dome = |u: f64, v: f64| DVec3::new(u, v, u * (1.0 - u) + v * (1.0 - v));
        let table: [(&str, ControlNet); 12] = [
            ("a point", net(|_, _| DVec3::ONE)),
            ("the origin", net(|_, _| DVec3::ZERO)),
            ("a line", net(|u, _| DVec3::new(u, 2.0 * u, 0.5))),
            ("a line run back and forth", net(|u, v| DVec3::X * (u * (1.0 - u) + v))),
            ("a curve", net(|u, _| DVec3::new(u, u * u, u * u * u))),
            ("an edge that is a point", net(|u, v| DVec3::new(u * v, u * (1.0 - v), u * u))),
            ("two edges that are points", net(|u, v| DVec3::new(u * (1.0 - u) * v, u, u * (1.0 - u) * (1.0 - v)))),
            ("equal rows", net(|u, v| dome(if u < 0.5 { 0.0 } else { u }, v))),
            ("folded on itself", net(|u, v| dome((2.0 * u - 1.0).abs(), v))),
            ("tiny", net(|u, v| 1e-150 * dome(u, v))),
            ("huge", net(|u, v| 1e150 * dome(u, v))),
            ("far away", net(|u, v| dome(u, v) + DVec3::new(1e9, -1e9, 1e9))),
        ];
        for (name, net) in &table {
            check(name, net);
        }
    }

    #[test]
    fn rays_without_direction_and_numbers_that_are_none_meet_nothing() {
        let patch = Patch::new(net(|u, v| DVec3::new(u, v, 0.0)));
        let through = DVec3::new(0.5, 0.5, 1.0);
        for direction in [DVec3::ZERO, DVec3::NAN, DVec3::INFINITY] {
            assert_eq!(patch.intersect(&Ray::new(through, direction)), None, "{direction}");
        }
        assert_eq!(patch.intersect(&Ray::new(DVec3::NAN, DVec3::NEG_Z)), None);
        let broken = Patch::new(net(|u, v| DVec3::new(u, v, if u > 0.9 { f64::NAN } else { 0.0 })));
        assert_eq!(broken.intersect(&Ray::new(through, DVec3::NEG_Z)), None);
    }

    #[test]
    fn normals_have_their_limits_where_the_cross_product_vanishes() {
        // A cone: all normals along the ruling v are the same, up to the tip at u = 0.
        let cone = Patch::new(net(|u, v| DVec3::new(u * v, u * (1.0 - v), u * (1.0 + v * (1.0 - v)))));
        for v in [0.0, 0.3, 1.0] {
            // Computed in the limit from derivatives that are exact to 1e-15.
            assert!(cone.normal(0.0, v).distance(cone.normal(0.5, v)) < 1e-9, "at v = {v}");
        }
        // Twice the same row: S(u, v) = (3 u^2 - 2 u^3, v, 0).
        let flat = Patch::new(net(|u, v| DVec3::new((3.0 * u - 1.0).clamp(0.0, 1.0), v, 0.0)));
        assert!(flat.normal(0.0, 0.5).distance(DVec3::Z) < 1e-9);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        /// Any net and any ray: a hit lies on the ray and within range, or there is none.
        #[test]
        fn any_hit_is_on_the_ray(
            coordinates in prop::collection::vec(-1.0f64..1.0, 48),
            snap in 0u32..4,
            origin in prop::array::uniform3(-2.0f64..2.0),
            direction in prop::array::uniform3(-1.0f64..1.0),
        ) {
            // Coarse grids make collinear and equal points.
            let round = |x: f64| if snap == 0 { x } else { (x * f64::from(snap)).round() / f64::from(snap) };
            let at = |k: usize| DVec3::from_slice(&coordinates[3 * k..]).to_array().map(round);
            let net = ControlNet { points: from_fn(|i| from_fn(|j| DVec3::from_array(at(4 * i + j)))) };
            let ray = Ray::new(DVec3::from_array(origin), DVec3::from_array(direction.map(round)));
            let patch = Patch::new(net);
            patch.prepare();
            prop_assert!(patch.memory_bytes() < 65_536, "{} bytes", patch.memory_bytes());
            if let Some(hit) = patch.intersect(&ray) {
                // 1e-9 of the size is the largest piece that counts as touching.
                prop_assert!(hit.t > 0.0 && net.eval(hit.u, hit.v).distance(ray.at(hit.t)) < 1e-8);
            }
        }
    }
}
