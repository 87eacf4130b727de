//! The unit normal of a patch everywhere, also where `dS/du x dS/dv` vanishes.

use super::{ControlNet, Derivatives};
use glam::DVec3;

/// How far to step towards the middle, in (u, v), to borrow the normal of a neighbour.
const NEIGHBOUR_STEPS: [f64; 4] = [1e-3, 1e-2, 0.1, 0.5];

/// The unit vector along `dS/du x dS/dv`, or its limit for a point that comes from the middle of the patch: along a
/// collapsed edge, on two equal rows, at a cusp. Where even that vanishes, the normal of a neighbour; of a patch
/// without area, any unit vector across its longest extent. Never NaN for a finite net.
///
/// `net` should lie near the origin: coordinates far larger than the patch cost digits.
pub(super) fn unit_normal(net: &ControlNet, u: f64, v: f64) -> DVec3 {
    let size = net.bounds().diagonal();
    let middle = (0.5 - u, 0.5 - v);
    limit_normal(&net.derivatives(u, v), middle, size)
        .or_else(|| {
            NEIGHBOUR_STEPS.into_iter().find_map(|step| {
                let at = (u + step * middle.0, v + step * middle.1);
                limit_normal(&net.derivatives(at.0, at.1), middle, size)
            })
        })
        .unwrap_or_else(|| normal_without_area(net))
}

/// The normal at a point by its derivatives, else its limit when coming from `point + direction`.
fn limit_normal(d: &Derivatives, direction: (f64, f64), size: f64) -> Option<DVec3> {
    // Rounding leaves an error of some 1e-15 size in each derivative, hence of `1e-15 size (|Su| + |Sv|)` in the cross
    // product; a vector 1e5 times as long has a direction good to 1e-10.
    let noise = 1e-10 * size * (d.dpdu.length() + d.dpdv.length());
    let normal = d.dpdu.cross(d.dpdv);
    if normal.length() > noise {
        return normal.try_normalize();
    }
    // The derivative of Su x Sv along `direction`.
    let dpdu_change = d.d2pdu2 * direction.0 + d.d2pdudv * direction.1;
    let dpdv_change = d.d2pdudv * direction.0 + d.d2pdv2 * direction.1;
    let change = dpdu_change.cross(d.dpdv) + d.dpdu.cross(dpdv_change);
    if change.length() > noise.max(1e-10 * size * size) { change.try_normalize() } else { None }
}

fn normal_without_area(net: &ControlNet) -> DVec3 {
    let [[a, .., b], _, _, [c, .., d]] = net.points;
    let diagonals = (d - a).cross(c - b);
    let longest = [d - a, c - b, net.bounds().size()].into_iter().max_by(|p, q| p.length().total_cmp(&q.length()));
    -diagonals
        .try_normalize()
        .or_else(|| longest.and_then(DVec3::try_normalize).map(|along| along.any_orthonormal_vector()))
        .unwrap_or(DVec3::NEG_Z)
}
