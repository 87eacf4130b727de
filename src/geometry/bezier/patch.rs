use super::ControlNet;
use super::intersect::{Hit, PreparedPatch, has_hit, nearest_hit, nearest_hit_of_each};
use super::normal::unit_normal;
use super::unit::{UnitMap, UnitRay};
use crate::math::lanes::{LANES, set_bits};
use crate::math::{Aabb, Ray};
use glam::DVec3;
use std::sync::OnceLock;

/// A bicubic Bezier patch for ray intersection. The first ray that comes near prepares it (cuts it and builds its
/// tree), so a patch that no ray reaches takes no time.
///
/// ```
/// use glam::DVec3;
/// use patchlight::geometry::bezier::{ControlNet, Patch};
/// use patchlight::math::Ray;
///
/// // A hill over the unit square: the four inner control points are 1 high.
/// let mut net = ControlNet { points: [[DVec3::ZERO; 4]; 4] };
/// for i in 0..4 {
///     for j in 0..4 {
///         let height = if (1..3).contains(&i) && (1..3).contains(&j) { 1.0 } else { 0.0 };
///         net.points[i][j] = DVec3::new(i as f64 / 3.0, j as f64 / 3.0, height);
///     }
/// }
/// let patch = Patch::new(net);
/// let ray = Ray::new(DVec3::new(0.5, 0.5, 3.0), DVec3::NEG_Z);
/// let hit = patch.intersect(&ray).expect("a ray at the top of the hill");
/// assert!((hit.u - 0.5).abs() < 1e-12 && (hit.v - 0.5).abs() < 1e-12);
/// // The inner Bernstein weights are 3/8 each, in u and in v: the top is 0.75 * 0.75 high.
/// assert!((hit.t - (3.0 - 0.5625)).abs() < 1e-12);
/// assert!(patch.normal(hit.u, hit.v).distance(DVec3::Z) < 1e-12);
/// ```
#[derive(Clone, Debug)]
pub struct Patch {
    net: ControlNet,
    /// Whether the normal is against `dS/du x dS/dv`.
    is_mirrored: bool,
    unit_map: UnitMap,
    unit_net: ControlNet,
    prepared: OnceLock<PreparedPatch>,
}

/// The hit of a ray on a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchHit {
    /// The ray parameter of the hit, in units of the ray's direction.
    pub t: f64,
    /// The parameter u of the hit, from 0 to 1.
    pub u: f64,
    /// The parameter v of the hit, from 0 to 1.
    pub v: f64,
}

impl From<Hit> for PatchHit {
    fn from(Hit { root, t }: Hit) -> Self {
        let parameter = |x: f64| (0.5 * x + 0.5).clamp(0.0, 1.0);
        Self { t, u: parameter(root.x), v: parameter(root.y) }
    }
}

impl Patch {
    /// The patch with this control net. No ray hits a patch with a coordinate that is not finite.
    pub fn new(net: ControlNet) -> Self {
        let unit_map = UnitMap::new(&net);
        let unit_net = net.map(|p| unit_map.point(p));
        Self { net, is_mirrored: false, unit_map, unit_net, prepared: OnceLock::new() }
    }

    /// The patch with its normal against `dS/du x dS/dv` where `is_mirrored`: a transform that mirrors a surface keeps its outside.
    #[must_use]
    pub fn mirrored(self, is_mirrored: bool) -> Self {
        Self { is_mirrored, ..self }
    }

    /// Whether the normal is against `dS/du x dS/dv`.
    pub fn is_mirrored(&self) -> bool {
        self.is_mirrored
    }

    /// The patch as intersection reads it; the first call prepares it.
    fn prepared(&self) -> &PreparedPatch {
        self.prepared.get_or_init(|| PreparedPatch::new(&self.unit_net))
    }

    /// Prepares the patch now instead of at the first ray.
    pub fn prepare(&self) {
        self.prepared();
    }

    /// Whether the patch is prepared.
    pub fn is_prepared(&self) -> bool {
        self.prepared.get().is_some()
    }

    /// The control net, in scene space.
    pub fn net(&self) -> &ControlNet {
        &self.net
    }

    /// A box that holds the patch and every computed point of it, in scene space.
    pub fn bounds(&self) -> Aabb {
        let bounds = self.net.bounds();
        // Evaluation rounds some ten times, each by at most half an ulp of the largest coordinate.
        bounds.inflated(1e-15 * bounds.min.abs().max(bounds.max.abs()).max_element())
    }

    /// The nearest hit with `t_min < t < t_max`; `None` for a miss.
    pub fn intersect(&self, ray: &Ray) -> Option<PatchHit> {
        let ray = self.unit_map.ray(ray)?;
        Some(nearest_hit(self.prepared(), ray)?.into())
    }

    /// The nearest hit of each ray of a packet; `None` for a miss, and for a ray whose bit in `active` is not set. The
    /// hits equal the results of [`Patch::intersect`] up to rounding; for coherent rays this is faster.
    pub fn intersect_packet(&self, rays: &[Ray; LANES], active: u32) -> [Option<PatchHit>; LANES] {
        let mut unit_rays = [UnitRay::MISS; LANES];
        for k in set_bits(active) {
            unit_rays[k] = self.unit_map.ray(&rays[k]).unwrap_or(UnitRay::MISS);
        }
        nearest_hit_of_each(self.prepared(), &unit_rays).map(|hit| hit.map(PatchHit::from))
    }

    /// Whether the ray hits the patch at any `t_min < t < t_max`.
    pub fn occluded(&self, ray: &Ray) -> bool {
        self.unit_map.ray(ray).is_some_and(|ray| has_hit(self.prepared(), ray))
    }

    /// The distance of a point to the boxes around the subpatches, or `limit` if that is less, in scene units: a lower bound
    /// of its distance to the patch.
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

    /// The geometric unit normal, along `dS/du x dS/dv` (against it for a mirrored patch); the limit of the normal on collapsed edges,
    /// equal rows and cusps. Never NaN.
    pub fn normal(&self, u: f64, v: f64) -> DVec3 {
        let normal = self.unit_map.normal_to_scene(unit_normal(&self.unit_net, u, v));
        if self.is_mirrored { -normal } else { normal }
    }

    /// Bytes of memory of the patch with everything that it owns so far.
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

    /// Rays of all kinds at a patch: through its points in many directions, along its edges, past it, from far away.
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
    fn degenerate_patches_are_intersected_safely() {
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
    fn rays_without_direction_and_nan_miss() {
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
        // A cone: all normals along the ruling v are equal, up to the tip at u = 0.
        let cone = Patch::new(net(|u, v| DVec3::new(u * v, u * (1.0 - v), u * (1.0 + v * (1.0 - v)))));
        for v in [0.0, 0.3, 1.0] {
            // Computed in the limit from derivatives that are exact to 1e-15.
            assert!(cone.normal(0.0, v).distance(cone.normal(0.5, v)) < 1e-9, "at v = {v}");
        }
        // Two equal rows: S(u, v) = (3 u^2 - 2 u^3, v, 0).
        let flat = Patch::new(net(|u, v| DVec3::new((3.0 * u - 1.0).clamp(0.0, 1.0), v, 0.0)));
        assert!(flat.normal(0.0, 0.5).distance(DVec3::Z) < 1e-9);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        /// Any net and any ray: a hit lies on the ray and within range.
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
