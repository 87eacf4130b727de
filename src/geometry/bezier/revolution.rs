//! Surfaces of revolution as bicubic patches.

use super::ControlNet;
use glam::{DVec2, DVec3};
use std::array::from_fn;

/// The longest arc of one patch, degrees.
///
/// The cubic that meets an arc of angle `a` with its tangents at both ends and in its middle leaves the circle by at most
/// `2/27 sin^6(a/4) / cos^2(a/4)` of the radius \[Goldapp91\]: 3.8e-7 for 30 degrees, where 35 degrees are the most for
/// 1e-6. Thirty divides a quarter, so that a whole turn meets the axes of the object's space exactly.
const LONGEST_ARC: f64 = 30.0;

/// A patch of a surface of revolution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RevolvedPatch {
    /// The control points: u runs around the axis, v along the profile.
    pub net: ControlNet,
    /// The texture coordinates at (u, v) = (0, 0) and at (1, 1): u from 0 to 1 over the angle, v from 0 to 1 along the profile,
    /// each segment with an equal part.
    pub uv: [DVec2; 2],
}

/// The surface that a profile sweeps around the y axis, by an angle of up to 360 degrees, from the x axis towards -z.
///
/// The profile is a list of cubic Bezier segments in the half plane of (r, y), each beginning at the end of the one before: 3 n + 1
/// control points, r at least 0. The normal `dS/du x dS/dv` points to the right of the profile's direction: outwards where the
/// profile goes up. The first n patches hold the profile itself, in the plane z = 0: `net.points[0]` of patch k is its segment k.
///
/// With `caps` the surface is closed: by flat discs from the axis to the ends of the profile and, below 360 degrees, by flat walls
/// from the axis to the profile. The walls overlap where the profile turns back in y. Patches that share an edge
/// have equal control points there.
///
/// The radius is exact to 4e-7 of itself. Returns no patch for another number of points, and for an angle that is not above 0 and
/// at most 360.
pub fn revolved(profile: &[DVec2], angle: f64, caps: bool) -> Vec<RevolvedPatch> {
    if profile.len() < 4 || profile.len() % 3 != 1 || !(angle > 0.0 && angle <= 360.0) {
        return Vec::new();
    }
    let turn = Turn::new(angle);
    let segments: Vec<[DVec2; 4]> = (0..profile.len() / 3).map(|k| from_fn(|j| profile[3 * k + j])).collect();
    let share = |k: usize| k as f64 / segments.len() as f64;
    let along = |k: usize| (share(k), share(k + 1));
    let mut patches = Vec::new();
    for arc in 0..turn.arcs.len() {
        patches.extend(segments.iter().enumerate().map(|(k, segment)| turn.patch(arc, segment, along(k))));
    }
    if caps {
        let (first, last) = (profile[0], profile[profile.len() - 1]);
        let radius = |end: DVec2| -> [DVec2; 4] { from_fn(|j| DVec2::new(end.x * (j as f64 / 3.0), end.y)) };
        let mut inwards = radius(last);
        inwards.reverse();
        let discs = [(first, radius(first)), (last, inwards)];
        for (_, disc) in discs.iter().filter(|(end, _)| end.x > 0.0) {
            patches.extend((0..turn.arcs.len()).map(|arc| turn.patch(arc, disc, (0.0, 1.0))));
        }
        if angle < 360.0 {
            patches.extend(segments.iter().enumerate().flat_map(|(k, segment)| turn.walls(segment, along(k))));
        }
    }
    patches
}

/// The arcs of a turn around the y axis.
struct Turn {
    /// For each arc the control points of a cubic near the unit circle, in the plane y = 0.
    arcs: Vec<[DVec3; 4]>,
}

impl Turn {
    fn new(angle: f64) -> Self {
        let count = (angle / LONGEST_ARC).ceil().max(1.0);
        let step = angle / count;
        // Length of the tangents that brings the middle of the cubic onto the circle.
        let reach = 4.0 / 3.0 * (0.25 * step.to_radians()).tan();
        let arc = |k: usize| {
            // Patches that share an edge compute its direction from the same number.
            let at = |k: usize| if k as f64 == count && angle == 360.0 { 0.0 } else { step * k as f64 };
            let ([from, leaving], [to, arriving]) = (frame(at(k)), frame(at(k + 1)));
            [from, from + reach * leaving, to - reach * arriving, to]
        };
        Self { arcs: (0..count as usize).map(arc).collect() }
    }

    /// The patch of one arc and one segment of the profile, which takes this range of v.
    fn patch(&self, arc: usize, segment: &[DVec2; 4], v: (f64, f64)) -> RevolvedPatch {
        let share = |k: usize| k as f64 / self.arcs.len() as f64;
        let points = self.arcs[arc].map(|direction| segment.map(|point| placed(point, direction)));
        RevolvedPatch { net: ControlNet { points }, uv: [DVec2::new(share(arc), v.0), DVec2::new(share(arc + 1), v.1)] }
    }

    /// The flat walls from the axis to a segment of the profile, at the start and at the end of the turn, facing away from the
    /// surface.
    fn walls(&self, segment: &[DVec2; 4], v: (f64, f64)) -> impl Iterator<Item = RevolvedPatch> {
        let ends = self.arcs.first().zip(self.arcs.last());
        let wall = move |direction: DVec3, is_end: bool| {
            let part = |i: usize| (if is_end { 3 - i } else { i }) as f64 / 3.0;
            let at = |i: usize, point: DVec2| placed(DVec2::new(point.x * part(i), point.y), direction);
            let points = from_fn(|i| segment.map(|point| at(i, point)));
            RevolvedPatch { net: ControlNet { points }, uv: [DVec2::new(0.0, v.0), DVec2::new(1.0, v.1)] }
        };
        ends.into_iter().flat_map(move |(first, last)| [wall(first[0], false), wall(last[3], true)])
    }
}

/// The point of the profile, turned into this direction from the axis. Zeros are positive, so that equal points have equal bits.
fn placed(point: DVec2, direction: DVec3) -> DVec3 {
    DVec3::new(point.x * direction.x + 0.0, point.y + 0.0, point.x * direction.z + 0.0)
}

/// The unit vectors away from the axis and along the turn, after an angle in degrees. They are exact at multiples of 90.
fn frame(angle: f64) -> [DVec3; 2] {
    let quarters = (angle / 90.0).round();
    let (sin, cos) = (angle - 90.0 * quarters).to_radians().sin_cos();
    let (sin, cos) = match quarters as i32 % 4 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    };
    [DVec3::new(cos, 0.0, -sin), DVec3::new(-sin, 0.0, -cos)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::bezier::Patch;
    use std::collections::HashMap;

    /// A straight line as a cubic.
    fn line(from: DVec2, to: DVec2) -> Vec<DVec2> {
        (0..4).map(|k| from.lerp(to, f64::from(k) / 3.0)).collect()
    }

    /// A cylinder of radius 1 from y = 0 to y = 2, going up.
    fn cylinder() -> Vec<DVec2> {
        line(DVec2::new(1.0, 0.0), DVec2::new(1.0, 2.0))
    }

    /// A bowl with a thick wall from the axis to the axis: up outside, down inside.
    fn bowl() -> Vec<DVec2> {
        let points = [
            (0.0, 0.0),
            (0.8, 0.0),
            (1.0, 0.4),
            (1.2, 1.0),
            (1.3, 1.1),
            (1.1, 1.1),
            (1.0, 1.0),
            (0.8, 0.5),
            (0.6, 0.2),
            (0.0, 0.2),
        ];
        points.map(DVec2::from).to_vec()
    }

    fn samples() -> impl Iterator<Item = (f64, f64)> {
        (0..=16).flat_map(|i| (0..=4).map(move |j| (f64::from(i) / 16.0, f64::from(j) / 4.0)))
    }

    #[test]
    fn the_radius_is_exact_to_less_than_a_millionth() {
        for angle in [360.0, 359.0, 90.0, 30.5, 1.0] {
            let patches = revolved(&cylinder(), angle, false);
            let worst = patches.iter().flat_map(|patch| {
                samples().map(|(u, v)| {
                    let DVec3 { x, z, .. } = patch.net.eval(u, v);
                    (x.hypot(z) - 1.0).abs()
                })
            });
            let worst = worst.fold(0.0, f64::max);
            assert!(worst < 4e-7, "{worst} at {angle} degrees");
        }
        assert_eq!(revolved(&cylinder(), 360.0, false).len(), 12);
    }

    #[test]
    fn normals_of_a_cylinder_point_away_from_the_axis() {
        for patch in revolved(&cylinder(), 360.0, false) {
            let net = Patch::new(patch.net);
            for (u, v) in samples() {
                let outwards = patch.net.eval(u, v).with_y(0.0).normalize();
                // The error of the radius, 4e-7, has three waves in an arc of half a unit: slopes of 3 pi / 0.5 times it.
                assert!(net.normal(u, v).distance(outwards) < 1e-5, "at {u} {v}");
            }
        }
    }

    #[test]
    fn the_turn_begins_at_x_and_goes_towards_minus_z() {
        let patches = revolved(&cylinder(), 90.0, false);
        assert_eq!(patches[0].net.points[0][0], DVec3::X);
        assert_eq!(patches[2].net.points[3][0], DVec3::NEG_Z);
    }

    #[test]
    fn the_first_patches_hold_the_profile() {
        let (profile, patches) = (bowl(), revolved(&bowl(), 200.0, true));
        for (k, point) in profile.iter().enumerate() {
            let segment = (k / 3).min(2);
            assert_eq!(patches[segment].net.points[0][k - 3 * segment], point.extend(0.0));
        }
    }

    /// The control points of an edge as bits, and the edge traversed backwards.
    fn edges(net: &ControlNet) -> [[[u64; 3]; 4]; 4] {
        let p = |i: usize, j: usize| net.points[i][j].to_array().map(f64::to_bits);
        [from_fn(|k| p(k, 0)), from_fn(|k| p(3, k)), from_fn(|k| p(3 - k, 3)), from_fn(|k| p(0, 3 - k))]
    }

    #[test]
    fn bodies_are_closed_and_their_seams_equal_bit_by_bit() {
        let cone = line(DVec2::new(0.5, 0.0), DVec2::new(0.2, 1.0));
        for (profile, angle, caps) in [
            (bowl(), 360.0, false),
            (bowl(), 360.0, true),
            (cylinder(), 360.0, true),
            (cone.clone(), 100.0, true),
            (cone, 300.5, true),
        ] {
            let mut seen: HashMap<[[u64; 3]; 4], i32> = HashMap::new();
            for patch in revolved(&profile, angle, caps) {
                for edge in edges(&patch.net).into_iter().filter(|edge| edge.iter().any(|p| *p != edge[0])) {
                    *seen.entry(edge).or_default() += 1;
                    let mut back = edge;
                    back.reverse();
                    *seen.entry(back).or_default() -= 1;
                }
            }
            // Each edge is traversed as often in one direction as in the other: the body is closed, with one outside.
            let open = seen.values().filter(|count| **count != 0).count();
            assert_eq!(open, 0, "{} points, {angle} degrees, caps {caps}", profile.len());
        }
    }

    /// Volume of the body that patches enclose, by the divergence theorem, with the midpoint rule.
    fn volume(patches: &[RevolvedPatch]) -> f64 {
        const STEPS: u32 = 24;
        let part = |net: &ControlNet| {
            let at = |k: u32| (f64::from(k) + 0.5) / f64::from(STEPS);
            let cells = (0..STEPS).flat_map(|i| (0..STEPS).map(move |j| (at(i), at(j))));
            let flux = cells.map(|(u, v)| {
                let d = net.derivatives(u, v);
                d.position.dot(d.dpdu.cross(d.dpdv)) / 3.0
            });
            flux.sum::<f64>() / f64::from(STEPS * STEPS)
        };
        patches.iter().map(|patch| part(&patch.net)).sum()
    }

    #[test]
    fn closed_bodies_have_their_volume_inside() {
        let pi = std::f64::consts::PI;
        for (angle, expected) in [(360.0, 2.0 * pi), (90.0, 0.5 * pi), (250.0, 2.0 * pi * 250.0 / 360.0)] {
            let found = volume(&revolved(&cylinder(), angle, true));
            // A negative volume would have its outside inside; the midpoint rule is good to a thousandth.
            assert!((found / expected - 1.0).abs() < 1e-3, "{found} is not {expected} at {angle} degrees");
        }
        assert!(volume(&revolved(&bowl(), 360.0, false)) > 0.0, "the wall of the bowl");
    }

    #[test]
    fn texture_coordinates_go_once_around_and_along() {
        let patches = revolved(&bowl(), 360.0, false);
        assert_eq!(patches[0].uv[0], DVec2::ZERO);
        assert_eq!(patches[patches.len() - 1].uv[1], DVec2::ONE);
        let area: f64 = patches.iter().map(|patch| (patch.uv[1] - patch.uv[0]).element_product()).sum();
        // 36 sums of numbers up to 1.
        assert!((area - 1.0).abs() < 1e-14, "{area}");
    }

    #[test]
    fn no_patch_without_a_profile_or_an_angle() {
        let five = [cylinder(), vec![DVec2::ONE]].concat();
        for (profile, angle) in [
            (&cylinder()[..3], 360.0),
            (&five[..], 360.0),
            (&cylinder()[..], 0.0),
            (&cylinder()[..], 360.5),
            (&cylinder()[..], f64::NAN),
        ] {
            assert!(revolved(profile, angle, true).is_empty(), "{} points, {angle} degrees", profile.len());
        }
    }
}
