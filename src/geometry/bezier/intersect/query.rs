use super::newton::Root;
use super::prepared::PreparedPatch;
use crate::geometry::bezier::unit::UnitRay;

/// A root within the range of the ray, with the parameter t of the scene ray.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit {
    pub(crate) root: Root,
    pub(crate) t: f64,
}

/// Subpatches that subdivision may look at before it gives up on a ray, which then runs within the surface; rays that
/// graze the surface need a few dozen.
const MAX_SUBDIVISIONS: usize = 5_000;

/// The state of one ray on its way through a patch.
pub(crate) struct RayQuery<'a> {
    pub(crate) patch: &'a PreparedPatch,
    /// Ends at the nearest hit so far.
    pub(crate) ray: UnitRay,
    pub(crate) nearest: Option<Hit>,
    pub(crate) subdivisions_left: usize,
}

impl<'a> RayQuery<'a> {
    /// The query of a ray without a hit so far.
    #[inline(always)]
    pub(crate) fn new(patch: &'a PreparedPatch, ray: UnitRay) -> Self {
        Self { patch, ray, nearest: None, subdivisions_left: MAX_SUBDIVISIONS }
    }

    /// Takes a root as the hit if it is nearer than the nearest so far.
    #[inline(always)]
    pub(crate) fn accept(&mut self, root: Root) {
        if root.z < self.ray.z_max
            && let Some(t) = self.ray.t_in_range(root.z)
        {
            self.nearest = Some(Hit { root, t });
            self.ray.z_max = root.z;
        }
    }
}
