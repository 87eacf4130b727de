//! The criterion by which patches are cut: the difference of a subpatch from a paraboloid over evenly spaced
//! parameters. The field measures flatness \[MCFS00\]; the limits here are ours.

use super::paraboloid::mean_gradients;
use crate::geometry::bezier::unit::{Interval, Ordinates, SoaNet};
use crate::math::lanes::simd_dispatch;
use glam::DVec3;

/// Limit of the change of the partial derivatives within the tangent plane, in units of their means. Newton's method starts
/// from a root of the paraboloid, whose parameters err by about half of that.
const IN_PLANE: f64 = 0.1;

/// Limit of the turn of the tangents out of the plane, in radians, which bounds the height of the boxes.
const TURN: f64 = 0.3;

/// Limit of the change of the second derivatives out of the plane, as a turn of the tangents in radians: the paraboloid
/// decides every ray that is steeper over the surface.
const CHANGE_OF_TURN: f64 = 0.02;

/// The bending of a subpatch whose mean partial derivatives span no plane.
pub(crate) const DEGENERATE: f64 = 10.0;

simd_dispatch! {
    /// The bending of a subpatch along u and along v, in units of the limits: halving along u lowers the first, halving
    /// along v the second.
    pub(crate) fn bending(net: &SoaNet) -> [f64; 2] {
        let Some(gradients) = mean_gradients(net) else {
            let [uu, vv] = [net.x, net.y, net.z]
                .iter()
                .map(SecondDerivatives::new)
                .fold([0f64; 2], |[uu, vv], d| [uu.max(d.uu.magnitude()), vv.max(d.vv.magnitude())]);
            return if uu < vv { [1.0, DEGENERATE] } else { [DEGENERATE, 1.0] };
        };
        let SoaNet { x, y, z } = net.in_coordinates(gradients, DVec3::ZERO);
        let [alpha, beta, gamma] = [SecondDerivatives::new(&x), SecondDerivatives::new(&y), SecondDerivatives::new(&z)];
        // The narrower a subpatch is, the larger are the slopes of gamma by alpha and by beta.
        let (steep_u, steep_v) = (gradients[0].length(), gradients[1].length());
        let bends =
            |in_plane: f64, turn: f64, change: f64| (in_plane / IN_PLANE).max(turn / TURN).max(change / CHANGE_OF_TURN);
        [
            bends(
                alpha.uu.magnitude().max(beta.uu.magnitude()).max(beta.uv.magnitude()),
                gamma.uu.magnitude() * steep_u,
                (gamma.uu.width() * steep_u).max(gamma.uv.width() * steep_v),
            ),
            bends(
                alpha.vv.magnitude().max(beta.vv.magnitude()).max(alpha.uv.magnitude()),
                gamma.vv.magnitude() * steep_v,
                (gamma.vv.width() * steep_v).max(gamma.uv.width() * steep_u),
            ),
        ]
    }
}

/// Intervals of the second derivatives of a coordinate, by the differences of its ordinates: a factor of 3/2 for each
/// derivative by a parameter from -1 to 1.
struct SecondDerivatives {
    uu: Interval,
    uv: Interval,
    vv: Interval,
}

impl SecondDerivatives {
    #[inline(always)]
    fn new(ordinates: &Ordinates) -> Self {
        Self {
            uu: Interval::of(&ordinates.second_differences()).scaled(1.5),
            uv: Interval::of(&ordinates.mixed_differences()).scaled(2.25),
            vv: Interval::of(&ordinates.transposed().second_differences()).scaled(1.5),
        }
    }
}
