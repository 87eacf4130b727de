use super::ControlNet;
use super::normal::unit_normal;
use super::ray_net::{RayNet, RaySpace};
use super::search::Search;
use crate::math::{Aabb, Ray};
use glam::DVec3;

/// A patch made ready to be met by rays. Immutable.
#[derive(Clone, Debug)]
pub struct Patch {
    net: ControlNet,
    /// The net relative to `center`, so that a patch far from the origin loses no digits.
    local: ControlNet,
    center: DVec3,
    /// The diagonal of the control points' box.
    size: f64,
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
        let center = bounds.center();
        Self { net, local: net.map(|p| p - center), center, size: bounds.diagonal() }
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
        let ray = Ray { origin: ray.origin - self.center, ..*ray };
        let space = RaySpace::new(&ray)?;
        let net = RayNet::new(&self.local, &space);
        let root = Search::new(&net, &space, self.size, ray.t_min, ray.t_max).run()?;
        Some(PatchHit { t: root.t, u: root.u, v: root.v })
    }

    /// Whether the ray meets the patch at any `t_min < t < t_max`.
    pub fn occluded(&self, ray: &Ray) -> bool {
        self.intersect(ray).is_some()
    }

    /// The unit geometric normal `dS/du x dS/dv`; its limit on collapsed edges, equal rows and cusps. Never NaN.
    pub fn normal(&self, u: f64, v: f64) -> DVec3 {
        unit_normal(&self.local, u, v)
    }

    /// Memory of the patch with everything it owns.
    pub fn memory_bytes(&self) -> usize {
        size_of::<Self>()
    }
}
