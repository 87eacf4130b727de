//! Roots by subdivision, where a ray grazes a part or a part is not flat: halve until a piece is missed for certain or
//! holds at most one root for certain.

use super::newton::{Domain, Knowledge, Outcome, Root, solve};
use super::ray_net::{ROUNDING, RayNet};
use super::traverse::Walk;
use crate::math::lanes::{Lanes, simd_dispatch};
use arrayvec::ArrayVec;

/// A piece within a box of this size around the ray is a hit even where no single root can be told apart: at a point
/// where the ray touches the surface. In unit space.
const TOUCHING: f64 = 1e-9;

/// Halvings after which what is left is a miss.
const MAX_DEPTH: usize = 80;

/// Each halving leaves one half for later.
const MAX_OPEN: usize = MAX_DEPTH + 1;

/// Part of the part to be searched.
struct Piece {
    net: RayNet,
    domain: Domain,
    depth: usize,
}

simd_dispatch! {
    /// Finds the nearest root in a part of the patch.
    #[cold]
    pub(super) fn subdivide(l: impl Lanes, walk: &mut Walk, part: &Domain) {
        search(l, walk, part)
    }
}

#[inline(always)]
fn search(l: impl Lanes, walk: &mut Walk, part: &Domain) {
    let mut open: ArrayVec<Piece, MAX_OPEN> = ArrayVec::new();
    let net = RayNet::new(&walk.patch.net, &walk.ray).restricted(part);
    open.push(Piece { net, domain: *part, depth: 0 });
    while let Some(Piece { net, domain, depth }) = open.pop() {
        if walk.pieces_left == 0 || net.misses(walk.ray.z_min, walk.ray.z_max, ROUNDING) {
            continue;
        }
        walk.pieces_left -= 1;
        let outcome = match net.affine() {
            Some(affine) if affine.is_missed => Outcome::None,
            Some(affine) => match Knowledge::from_nonlinearity(affine.nonlinearity) {
                Some(known) => {
                    let [s, t] = [affine.start[0].clamp(-1.0, 1.0), affine.start[1].clamp(-1.0, 1.0)];
                    let start = (domain.x + s * domain.half_x, domain.y + t * domain.half_y);
                    solve(l, &walk.patch.power, &walk.ray, &domain, &known, start)
                }
                None => Outcome::Unknown,
            },
            None => Outcome::Unknown,
        };
        match outcome {
            Outcome::Root(root) => walk.accept(root),
            Outcome::None => {}
            Outcome::Unknown if depth == MAX_DEPTH => {}
            Outcome::Unknown => split(walk, &net.turned(), &domain, depth, &mut open),
        }
    }
}

/// Leaves the halves of a piece for later, the nearer one on top; takes a piece that has become a point for a hit.
#[inline(always)]
fn split(walk: &mut Walk, net: &RayNet, domain: &Domain, depth: usize, open: &mut ArrayVec<Piece, MAX_OPEN>) {
    if net.misses(walk.ray.z_min, walk.ray.z_max, ROUNDING) {
        return;
    }
    if net.is_within(TOUCHING) {
        return walk.accept(Root { x: domain.x, y: domain.y, z: net.middle_z() });
    }
    let (nets, domains) =
        if net.splits_across_u() { (net.split_u(), domain.halves_x()) } else { (net.split_v(), domain.halves_y()) };
    let nearer = usize::from(nets[1].middle_z() < nets[0].middle_z());
    for k in [1 - nearer, nearer] {
        open.push(Piece { net: nets[k], domain: domains[k], depth: depth + 1 });
    }
}
