use super::bezier::PatchHit;
use super::blocks::PrimitiveBlocks;
use super::{Bvh, Hit, Primitive};
use crate::math::lanes::{LANES, Lanes, set_bits, simd_dispatch, with_lanes};
use crate::math::{Aabb, Ray};
use glam::DVec3;

/// Up to this many quads and spheres go into blocks, which every ray tests; more of them go into the BVH.
const MAX_IN_BLOCKS: usize = 24;

/// All primitives of a scene. Every ray tests the planes and, where they are few, the quads and spheres; a BVH holds the
/// other primitives.
#[derive(Clone, Debug, Default)]
pub struct Aggregate {
    primitives: Vec<Primitive>,
    planes: Vec<u32>,
    blocks: PrimitiveBlocks,
    /// The primitives in the blocks, for distances to points.
    blocks_bvh: Bvh,
    /// The primitives that are neither planes nor in the blocks.
    bvh: Bvh,
}

impl Aggregate {
    /// Builds the aggregate, in O(n log n) for n primitives.
    pub fn new(primitives: Vec<Primitive>) -> Self {
        let planes = (0..primitives.len() as u32).filter(|&i| matches!(primitives[i as usize], Primitive::Plane(_)));
        let (in_blocks, others) = boxes(&primitives);
        Self {
            planes: planes.collect(),
            blocks: blocks(&primitives),
            blocks_bvh: Bvh::build(&in_blocks),
            bvh: Bvh::build(&others),
            primitives,
        }
    }

    /// The aggregate of moved primitives, of the same number, kinds and order: its BVH is refitted, in O(n).
    pub fn refitted(&self, primitives: Vec<Primitive>) -> Self {
        let (in_blocks, others) = boxes(&primitives);
        let (mut blocks_bvh, mut bvh) = (self.blocks_bvh.clone(), self.bvh.clone());
        blocks_bvh.refit(&in_blocks);
        bvh.refit(&others);
        Self { planes: self.planes.clone(), blocks: blocks(&primitives), blocks_bvh, bvh, primitives }
    }

    /// The primitives, in the order given to [`Aggregate::new`].
    pub fn primitives(&self) -> &[Primitive] {
        &self.primitives
    }

    /// The planes: primitives without bounds.
    pub fn unbounded(&self) -> impl Iterator<Item = &Primitive> {
        self.planes.iter().map(|&plane| &self.primitives[plane as usize])
    }

    /// The box around all bounded primitives.
    pub fn bounds(&self) -> Aabb {
        self.blocks_bvh.bounds().union(&self.bvh.bounds())
    }

    /// The nearest hit with `t_min < t < t_max`; `None` for a miss.
    #[inline]
    pub fn closest_hit(&self, ray: &Ray) -> Option<Hit> {
        closest_hit(self, ray)
    }

    /// The nearest hit of each ray of a packet; `None` for a miss. The hits equal the results of
    /// [`Aggregate::closest_hit`] up to rounding; for coherent rays this is faster.
    #[inline]
    pub fn closest_hits(&self, rays: &[Ray; LANES]) -> [Option<Hit>; LANES] {
        closest_hits(self, rays)
    }

    /// Whether the ray has any hit with `t_min < t < t_max`.
    #[inline]
    pub fn occluded(&self, ray: &Ray) -> bool {
        occluded(self, ray)
    }

    /// The distance of a point to the nearest primitive with an index that `includes` accepts, or `limit` if that is less;
    /// for a patch, the distance to the boxes around its subpatches.
    pub fn distance(&self, point: DVec3, limit: f64, includes: impl Fn(u32) -> bool) -> f64 {
        let to = |primitive: u32, limit: f64| {
            if includes(primitive) { self.primitives[primitive as usize].distance(point, limit) } else { limit }
        };
        let to_planes = self.planes.iter().fold(limit, |nearest, &plane| to(plane, nearest));
        let to_blocks = self.blocks_bvh.distance(point, to_planes, to);
        self.bvh.distance(point, to_blocks, to)
    }

    /// Shortens the ray to its nearest hit in the blocks, if any.
    #[inline(always)]
    fn intersect_blocks(&self, ray: &mut Ray, closest: &mut Option<Hit>) {
        with_lanes!(l => self.blocks.intersect(l.simd(), ray, closest));
    }

    /// Whether the ray hits a primitive in the blocks.
    #[inline(always)]
    fn blocks_occlude(&self, ray: &Ray) -> bool {
        with_lanes!(l => self.blocks.occluded(l.simd(), ray))
    }

    /// Shortens the ray to its hit with one primitive, if any.
    #[inline(always)]
    fn intersect(&self, primitive: u32, ray: &mut Ray, closest: &mut Option<Hit>) {
        if let Some((t, u, v)) = self.primitives[primitive as usize].intersect(ray) {
            ray.t_max = t;
            *closest = Some(Hit { t, primitive, u, v });
        }
    }
}

/// Whether the quads and spheres are few enough for blocks.
fn uses_blocks(primitives: &[Primitive]) -> bool {
    primitives.iter().filter(|primitive| primitive.is_in_blocks()).count() <= MAX_IN_BLOCKS
}

fn blocks(primitives: &[Primitive]) -> PrimitiveBlocks {
    if uses_blocks(primitives) { PrimitiveBlocks::new((0..).zip(primitives)) } else { PrimitiveBlocks::default() }
}

/// For each primitive, its box in the BVH of the blocks and its box in the BVH of the primitives outside of blocks;
/// empty in a BVH that does not hold the primitive.
fn boxes(primitives: &[Primitive]) -> (Vec<Aabb>, Vec<Aabb>) {
    let uses_blocks = uses_blocks(primitives);
    let boxed = |primitive: &Primitive, wanted: bool| if wanted { primitive.bounds() } else { Aabb::EMPTY };
    let boxes =
        |in_blocks: bool| primitives.iter().map(|p| boxed(p, (uses_blocks && p.is_in_blocks()) == in_blocks)).collect();
    (boxes(true), boxes(false))
}

simd_dispatch! {
    fn closest_hit(aggregate: &Aggregate, ray: &Ray) -> Option<Hit> {
        let mut ray = *ray;
        let mut closest = None;
        for &plane in &aggregate.planes {
            aggregate.intersect(plane, &mut ray, &mut closest);
        }
        aggregate.intersect_blocks(&mut ray, &mut closest);
        aggregate.bvh.traverse(&mut ray, |primitive, ray| {
            aggregate.intersect(primitive, ray, &mut closest);
            true
        });
        closest
    }
}

simd_dispatch! {
    fn closest_hits(aggregate: &Aggregate, rays: &[Ray; LANES]) -> [Option<Hit>; LANES] {
        let mut rays = *rays;
        let mut closest = [None; LANES];
        for (ray, closest) in rays.iter_mut().zip(&mut closest) {
            for &plane in &aggregate.planes {
                aggregate.intersect(plane, ray, closest);
            }
            aggregate.intersect_blocks(ray, closest);
        }
        aggregate.bvh.traverse_packet(&mut rays, |primitive, active, rays| {
            if let Primitive::Patch(patch) = &aggregate.primitives[primitive as usize] {
                for (lane, hit) in patch.intersect_packet(rays, active).into_iter().enumerate() {
                    if let Some(PatchHit { t, u, v }) = hit {
                        rays[lane].t_max = t;
                        closest[lane] = Some(Hit { t, primitive, u, v });
                    }
                }
            } else {
                for lane in set_bits(active) {
                    aggregate.intersect(primitive, &mut rays[lane], &mut closest[lane]);
                }
            }
        });
        closest
    }
}

simd_dispatch! {
    fn occluded(aggregate: &Aggregate, ray: &Ray) -> bool {
        if aggregate.planes.iter().any(|&plane| aggregate.primitives[plane as usize].intersect(ray).is_some()) {
            return true;
        }
        if aggregate.blocks_occlude(ray) {
            return true;
        }
        let mut found = false;
        aggregate.bvh.traverse(&mut ray.clone(), |primitive, ray| {
            found = match &aggregate.primitives[primitive as usize] {
                Primitive::Patch(patch) => patch.occluded(ray),
                other => other.intersect(ray).is_some(),
            };
            !found
        });
        found
    }
}

#[cfg(test)]
mod tests;
