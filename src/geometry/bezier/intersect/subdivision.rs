//! Roots by subdivision, for rays that graze a subpatch and for subpatches that are not flat: halve until the ray certainly
//! misses a subpatch or certainly has at most one root in it. Instead of clipping \[NSK90\], which converges to one root at a
//! time, the halves go to Newton's method as soon as a root is unique, as in \[Toth85\].

use super::newton::{Outcome, Root, Uniqueness, solve};
use super::query::RayQuery;
use super::ray_aligned_net::{ROUNDING, RayAlignedNet};
use crate::geometry::bezier::tree::Branch;
use crate::geometry::bezier::unit::{Domain, rounded_z_max};
use crate::math::lanes::{Lanes, simd_dispatch};
use arrayvec::ArrayVec;

/// A subpatch that the ray may hit and whose box is at most this large, in unit space, is a hit, although no root in it is
/// proved unique: the ray touches the surface there.
const TOUCHING: f64 = 1e-9;

/// Halvings after which a subpatch is a miss.
const MAX_DEPTH: usize = 80;

/// Each halving leaves one half on the stack.
const MAX_OPEN: usize = MAX_DEPTH + 1;

/// A subpatch to be searched.
struct Piece {
    net: RayAlignedNet,
    domain: Domain,
    depth: usize,
}

simd_dispatch! {
    /// Finds the nearest root of the ray in a subpatch.
    #[cold]
    pub(crate) fn subdivide(l: impl Lanes, query: &mut RayQuery, domain: &Domain) {
        search(l, query, domain)
    }
}

/// Looks for the root on one branch of a subpatch by Newton's method from a start (x, y), and by subdivision where
/// Newton's method does not decide. The branch has at most one root in the domain enlarged by the given factor.
#[inline(always)]
pub(crate) fn solve_or_subdivide(
    l: impl Lanes,
    query: &mut RayQuery,
    (domain, enlargement): (Domain, f64),
    branch: &Branch,
    start: (f64, f64),
) {
    if branch.near > rounded_z_max(&query.ray) {
        return;
    }
    let uniqueness = Uniqueness { enlargement, slope: branch.slope, reach: f64::INFINITY };
    match solve(l, &query.patch.power, &query.ray, &domain, &uniqueness, start) {
        Outcome::Root(root) => query.accept(root),
        Outcome::NoRoot => {}
        Outcome::Unknown => subdivide(query, &domain),
    }
}

#[inline(always)]
fn search(l: impl Lanes, query: &mut RayQuery, domain: &Domain) {
    let mut open: ArrayVec<Piece, MAX_OPEN> = ArrayVec::new();
    let net = RayAlignedNet::new(&query.patch.net, &query.ray).restricted(domain);
    open.push(Piece { net, domain: *domain, depth: 0 });
    while let Some(Piece { net, domain, depth }) = open.pop() {
        if query.subdivisions_left == 0 || net.misses(query.ray.z_min, query.ray.z_max, ROUNDING) {
            continue;
        }
        query.subdivisions_left -= 1;
        let outcome = match net.affine() {
            Some(affine) if affine.is_missed => Outcome::NoRoot,
            Some(affine) => match Uniqueness::from_nonlinearity(affine.nonlinearity) {
                Some(uniqueness) => {
                    let [s, t] = [affine.start[0].clamp(-1.0, 1.0), affine.start[1].clamp(-1.0, 1.0)];
                    let start = (domain.x + s * domain.half_x, domain.y + t * domain.half_y);
                    solve(l, &query.patch.power, &query.ray, &domain, &uniqueness, start)
                }
                None => Outcome::Unknown,
            },
            None => Outcome::Unknown,
        };
        match outcome {
            Outcome::Root(root) => query.accept(root),
            Outcome::NoRoot => {}
            Outcome::Unknown if depth == MAX_DEPTH => {}
            Outcome::Unknown => split(query, &net.rotated(), &domain, depth, &mut open),
        }
    }
}

/// Pushes the halves of a subpatch, the nearer one on top; a subpatch that has shrunk to a point is a hit.
#[inline(always)]
fn split(
    query: &mut RayQuery,
    net: &RayAlignedNet,
    domain: &Domain,
    depth: usize,
    open: &mut ArrayVec<Piece, MAX_OPEN>,
) {
    if net.misses(query.ray.z_min, query.ray.z_max, ROUNDING) {
        return;
    }
    if net.fits_in(TOUCHING) {
        return query.accept(Root { x: domain.x, y: domain.y, z: net.mean_z() });
    }
    let (nets, domains) =
        if net.splits_in_u() { (net.split_u(), domain.halves_x()) } else { (net.split_v(), domain.halves_y()) };
    let nearer = usize::from(nets[1].mean_z() < nets[0].mean_z());
    for k in [1 - nearer, nearer] {
        open.push(Piece { net: nets[k], domain: domains[k], depth: depth + 1 });
    }
}
