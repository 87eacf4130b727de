//! How far a part of a patch is from a paraboloid over evenly spaced parameters.

use super::ControlNet;
use super::paraboloid::mean_gradients;
use crate::math::Aabb;
use glam::{DMat3, DVec3};
use std::array::from_fn;

/// Limit of how much the partial derivatives change along the tangent plane, in units of their means: Newton's method
/// starts from a root of the paraboloid, which is off by about half of that in a parameter.
const IN_PLANE: f64 = 0.2;

/// Limit of the turn of the tangents out of the plane, in radians: bounds the height of the boxes.
const TURN: f64 = 0.3;

/// Limit of how much the second derivatives out of the plane change, as a turn of the tangents: rays that are steeper
/// over the surface are decided by the paraboloid.
const CHANGE_OF_TURN: f64 = 0.02;

/// How much a part bends that cannot be told: its mean partial derivatives span no plane.
pub(super) const SHAPELESS: f64 = 10.0;

/// How much a part bends along u, and along v, in units of what it may. Halving along u, or along v, tames it.
pub(super) fn bending(net: &ControlNet) -> [f64; 2] {
    let p = &net.points;
    // Derivatives by parameters from -1 to 1 are 3/2 of differences of control points.
    let duu: [DVec3; 8] = from_fn(|k| 1.5 * second_difference(from_fn(|i| p[i + k / 4][k % 4])));
    let dvv: [DVec3; 8] = from_fn(|k| 1.5 * second_difference(from_fn(|i| p[k % 4][i + k / 4])));
    let Some([alpha, beta, normal]) = mean_gradients(net) else {
        let [u, v] = [duu, dvv].map(|d| d.iter().map(|d| d.length()).fold(0.0, f64::max));
        return if u < v { [1.0, SHAPELESS] } else { [SHAPELESS, 1.0] };
    };
    let duv: [DVec3; 9] = from_fn(|k| {
        let (i, j) = (k / 3, k % 3);
        2.25 * (p[i + 1][j + 1] - p[i + 1][j] - p[i][j + 1] + p[i][j])
    });
    let frame = DMat3::from_cols(alpha, beta, normal).transpose();
    let range = |derivatives: &[DVec3]| Aabb::around(derivatives.iter().map(|d| frame * *d));
    let largest = |range: &Aabb| range.min.abs().max(range.max.abs());
    let (uu, vv, uv) = (range(&duu), range(&dvv), range(&duv));
    let (steep_u, steep_v) = (alpha.length(), beta.length());
    let twist = largest(&uv);
    let bends = |along: &Aabb, twist: f64, steep: f64, steep_across: f64| {
        let most = largest(along);
        let in_plane = most.x.max(most.y).max(twist) / IN_PLANE;
        let change = (along.size().z * steep).max(uv.size().z * steep_across);
        in_plane.max(most.z * steep / TURN).max(change / CHANGE_OF_TURN)
    };
    [bends(&uu, twist.y, steep_u, steep_v), bends(&vv, twist.x, steep_v, steep_u)]
}

fn second_difference([a, b, c]: [DVec3; 3]) -> DVec3 {
    a - 2.0 * b + c
}
