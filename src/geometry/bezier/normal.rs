//! The unit normal of a patch, also where `dS/du x dS/dv` vanishes: there its limit, by second derivatives.

use super::{ControlNet, Derivatives};
use glam::DVec3;

/// Distances in (u, v) of the neighbours whose normals stand in for a normal without a limit.
const NEIGHBOUR_STEPS: [f64; 4] = [1e-3, 1e-2, 0.1, 0.5];

/// The unit vector along `dS/du x dS/dv`. Where that vanishes (a collapsed edge, equal rows, a cusp), its limit along the
/// line to the center of the patch, else along u or v; without a limit, the normal of a neighbour; for a patch without area,
/// a unit vector across its longest extent. Never NaN for a finite net.
///
/// `net` should lie near the origin: coordinates far larger than the patch cost digits.
pub(super) fn unit_normal(net: &ControlNet, u: f64, v: f64) -> DVec3 {
    let size = net.bounds().diagonal();
    let inward = |x: f64| if x < 0.5 { 0.5 } else { -0.5 };
    // On a middle line the way to the center leads along the line; at the center no way is left.
    let directions = [(0.5 - u, 0.5 - v), (inward(u), 0.0), (0.0, inward(v))];
    let here = net.derivatives(u, v);
    let limits = directions.iter().find_map(|&direction| limit_normal(&here, direction, size));
    let neighbours = || {
        NEIGHBOUR_STEPS.iter().flat_map(|&step| directions.map(|direction| (step, direction))).find_map(
            |(step, direction)| {
                let at = net.derivatives(u + step * direction.0, v + step * direction.1);
                limit_normal(&at, direction, size)
            },
        )
    };
    limits.or_else(neighbours).unwrap_or_else(|| normal_without_area(net))
}

/// The normal by the derivatives at a point, else its limit from `point + direction`; `None` if both vanish.
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::array::from_fn;

    #[test]
    fn where_a_derivative_vanishes_along_a_middle_line_the_normal_is_the_limit() {
        // x = (2 u - 1)^3, y = v, z = 3/2 v^2: dS/du vanishes where u is a half. With u and v exchanged it is the line
        // v = 1/2.
        let (cube, square) = ([-1.0, 1.0, -1.0, 1.0], [0.0, 0.0, 0.5, 1.5]);
        let net = ControlNet { points: from_fn(|i| from_fn(|j| DVec3::new(cube[i], j as f64 / 3.0, square[j]))) };
        for v in [0.0, 0.25, 0.5, 0.75, 1.0] {
            let limit = DVec3::new(0.0, -3.0 * v, 1.0).normalize();
            // A neighbour at a distance of a thousandth has an equal normal here.
            assert!(unit_normal(&net, 0.5, v).distance(limit) < 1e-9, "at {v}: {}", unit_normal(&net, 0.5, v));
            assert!(unit_normal(&net.transposed(), v, 0.5).distance(-limit) < 1e-9);
        }
    }

    #[test]
    fn at_a_cusp_the_normal_is_one_of_its_sides() {
        // x = (2 u - 1)^2, z = (2 u - 1)^3: the normals turn around where u is a half, along z on both sides.
        let (square, cube) = ([1.0, -1.0 / 3.0, -1.0 / 3.0, 1.0], [-1.0, 1.0, -1.0, 1.0]);
        let net = ControlNet { points: from_fn(|i| from_fn(|j| DVec3::new(square[i], j as f64 / 3.0, cube[i]))) };
        for v in [0.0, 0.3, 0.5, 1.0] {
            assert!(unit_normal(&net, 0.5, v).z.abs() > 1.0 - 1e-9, "at {v}: {}", unit_normal(&net, 0.5, v));
        }
    }
}
