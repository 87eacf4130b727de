//! Roots by subdivision, where a ray grazes a part or a part is not flat: halve until a piece is missed for certain or
//! holds at most one root for certain.

use super::newton::{Domain, Knowledge, Outcome, Root, solve};
use super::ray_net::RayNet;
use super::traverse::Walk;
use multiversion::multiversion;

/// A piece within a box of this size around the ray is a hit even where no single root can be told apart: at a point
/// where the ray touches the surface. In unit space.
const TOUCHING: f64 = 1e-9;

/// Rounding of coordinates in unit space is below this.
const ROUNDING: f64 = 1e-14;

/// Halvings after which what is left is a miss.
const MAX_DEPTH: usize = 80;

/// Finds the nearest root in a part of the patch.
#[cold]
#[multiversion(targets("x86_64+avx+avx2+fma"))]
pub(super) fn subdivide(walk: &mut Walk, part: &Domain) {
    let net = RayNet::new(&walk.patch.net, &walk.ray).restricted(part);
    visit_piece(walk, &net, part, 0);
}

#[multiversion(targets("x86_64+avx+avx2+fma"))]
fn visit_piece(walk: &mut Walk, piece: &RayNet, domain: &Domain, depth: usize) {
    if walk.pieces_left == 0 || piece.misses(walk.ray.z_min, walk.ray.z_max, ROUNDING) {
        return;
    }
    walk.pieces_left -= 1;
    let outcome = match piece.affine() {
        Some(affine) if affine.is_missed => Outcome::None,
        Some(affine) => Knowledge::from_nonlinearity(affine.nonlinearity).map_or(Outcome::Unknown, |known| {
            let [s, t] = affine.start.map(|x| x.clamp(-1.0, 1.0));
            let start = (domain.x + s * domain.half_x, domain.y + t * domain.half_y);
            solve(&walk.patch.power, &walk.ray, domain, &known, start)
        }),
        None => Outcome::Unknown,
    };
    match outcome {
        Outcome::Root(root) => walk.accept(root),
        Outcome::None => {}
        Outcome::Unknown => split_piece(walk, piece, domain, depth),
    }
}

/// Visits the halves, the nearer one first; takes a piece that has become a point for a hit.
#[inline(always)]
fn split_piece(walk: &mut Walk, piece: &RayNet, domain: &Domain, depth: usize) {
    let piece = piece.turned();
    let [x, y, z] = piece.ranges();
    if depth == MAX_DEPTH || piece.misses(walk.ray.z_min, walk.ray.z_max, ROUNDING) {
        return;
    }
    if [x, y, z].iter().all(|(low, high)| high - low <= TOUCHING) {
        return walk.accept(Root { x: domain.x, y: domain.y, z: 0.5 * (z.0 + z.1) });
    }
    let (nets, domains) = if piece.splits_across_u() {
        (piece.split_u(), domain.halves_x())
    } else {
        (piece.split_v(), domain.halves_y())
    };
    let nearer = usize::from(nets[1].middle_z() < nets[0].middle_z());
    for k in [nearer, 1 - nearer] {
        visit_piece(walk, &nets[k], &domains[k], depth + 1);
    }
}
