use super::ControlNet;
use super::normal::unit_normal;
use super::power::PowerForm;
use super::traverse::{Hit, has_hit, nearest_hit};
use super::tree::PartTree;
use super::unit::UnitMap;
use crate::math::{Aabb, Ray};
use glam::DVec3;

/// A patch made ready to be met by rays. Immutable.
#[derive(Clone, Debug)]
pub struct Patch {
    net: ControlNet,
    unit_map: UnitMap,
    prepared: Prepared,
}

/// What rays in unit space need.
#[derive(Clone, Debug)]
pub(super) struct Prepared {
    pub(super) net: ControlNet,
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

impl Patch {
    /// Prepares a patch. Coordinates that are not finite give a patch that no ray meets.
    pub fn new(net: ControlNet) -> Self {
        let bounds = net.bounds();
        let unit_map = UnitMap::new(bounds.center(), bounds.diagonal());
        let unit_net = net.map(|p| unit_map.point(p));
        let prepared = Prepared { net: unit_net, power: PowerForm::new(&unit_net), tree: PartTree::new(&unit_net) };
        Self { net, unit_map, prepared }
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
        let Hit { root, t } = nearest_hit(&self.prepared, ray)?;
        let parameter = |x: f64| (0.5 * x + 0.5).clamp(0.0, 1.0);
        Some(PatchHit { t, u: parameter(root.x), v: parameter(root.y) })
    }

    /// Whether the ray meets the patch at any `t_min < t < t_max`.
    pub fn occluded(&self, ray: &Ray) -> bool {
        self.unit_map.ray(ray).is_some_and(|ray| has_hit(&self.prepared, ray))
    }

    /// The unit geometric normal `dS/du x dS/dv`; its limit on collapsed edges, equal rows and cusps. Never NaN.
    pub fn normal(&self, u: f64, v: f64) -> DVec3 {
        unit_normal(&self.prepared.net, u, v)
    }

    /// Memory of the patch with everything it owns.
    pub fn memory_bytes(&self) -> usize {
        size_of::<Self>() + self.prepared.tree.heap_bytes()
    }
}
