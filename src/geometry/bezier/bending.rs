//! How far a part of a patch is from a paraboloid over evenly spaced parameters.

use super::paraboloid::mean_gradients;
use super::row::{Range, Rows};
use super::row_net::RowNet;
use crate::math::lanes::simd_dispatch;
use glam::DVec3;

/// Limit of how much the partial derivatives change along the tangent plane, in units of their means: Newton's method
/// starts from a root of the paraboloid, which is off by about half of that in a parameter.
const IN_PLANE: f64 = 0.1;

/// Limit of the turn of the tangents out of the plane, in radians: bounds the height of the boxes.
const TURN: f64 = 0.3;

/// Limit of how much the second derivatives out of the plane change, as a turn of the tangents: rays that are steeper
/// over the surface are decided by the paraboloid.
const CHANGE_OF_TURN: f64 = 0.02;

/// How much a part bends that cannot be told: its mean partial derivatives span no plane.
pub(super) const SHAPELESS: f64 = 10.0;

simd_dispatch! {
    /// How much a part bends along u, and along v, in units of what it may. Halving along u, or along v, tames it.
    pub(super) fn bending(net: &RowNet) -> [f64; 2] {
        let Some(gradients) = mean_gradients(net) else {
            let [uu, vv] = [net.x, net.y, net.z]
                .iter()
                .map(SecondDerivatives::new)
                .fold([0f64; 2], |[uu, vv], d| [uu.max(d.uu.greatest()), vv.max(d.vv.greatest())]);
            return if uu < vv { [1.0, SHAPELESS] } else { [SHAPELESS, 1.0] };
        };
        let RowNet { x, y, z } = net.in_coordinates(gradients, DVec3::ZERO);
        let [alpha, beta, gamma] = [SecondDerivatives::new(&x), SecondDerivatives::new(&y), SecondDerivatives::new(&z)];
        // Slopes of gamma by alpha and by beta grow as a part is narrow.
        let (steep_u, steep_v) = (gradients[0].length(), gradients[1].length());
        let bends =
            |in_plane: f64, turn: f64, change: f64| (in_plane / IN_PLANE).max(turn / TURN).max(change / CHANGE_OF_TURN);
        [
            bends(
                alpha.uu.greatest().max(beta.uu.greatest()).max(beta.uv.greatest()),
                gamma.uu.greatest() * steep_u,
                (gamma.uu.width() * steep_u).max(gamma.uv.width() * steep_v),
            ),
            bends(
                alpha.vv.greatest().max(beta.vv.greatest()).max(alpha.uv.greatest()),
                gamma.vv.greatest() * steep_v,
                (gamma.vv.width() * steep_v).max(gamma.uv.width() * steep_u),
            ),
        ]
    }
}

/// Ranges of the second derivatives of a coordinate, by the differences of its control points: three halves of them for
/// each derivative by a parameter from -1 to 1.
struct SecondDerivatives {
    uu: Range,
    uv: Range,
    vv: Range,
}

impl SecondDerivatives {
    #[inline(always)]
    fn new(rows: &Rows) -> Self {
        Self {
            uu: Range::of(&rows.bends()).scaled(1.5),
            uv: Range::of(&rows.twists()).scaled(2.25),
            vv: Range::of(&rows.transposed().bends()).scaled(1.5),
        }
    }
}
