//! Flattening, smoothing and resetting of control points. Each function returns new positions; which other control points follow
//! is the matter of the coupling.

use super::connectivity::Connectivity;
use super::plane_fit::nearest_plane;
use crate::app::document::selection::PointIndex;
use crate::scene::Bezier;
use glam::DVec3;
use std::collections::BTreeSet;

/// Control points with their new positions.
type Placed = Vec<(PointIndex, DVec3)>;

/// The share of the way to the mean of its neighbours that smoothing moves a control point.
const SMOOTHING: f64 = 0.5;

fn position(bezier: &Bezier, point: &PointIndex) -> Option<DVec3> {
    bezier.patches.get(point.patch)?.points.get(point.i)?.get(point.j).copied()
}

/// The control points moved into the plane nearest to them in world space; `None` for less than four different positions, which
/// lie in a plane already, and for a transform that cannot be inverted.
pub(crate) fn flattened(bezier: &Bezier, points: &BTreeSet<PointIndex>) -> Option<Placed> {
    let world_from_object = bezier.transform.world_from_object();
    let object_from_world = world_from_object.inverse();
    if !object_from_world.is_finite() {
        return None;
    }
    // Welded control points count once.
    let mut worlds: Vec<DVec3> = Vec::new();
    for at in points.iter().filter_map(|point| position(bezier, point)) {
        let world = world_from_object.transform_point3(at);
        if !worlds.contains(&world) {
            worlds.push(world);
        }
    }
    let (center, normal) = nearest_plane(&worlds).filter(|_| worlds.len() > 3)?;
    let flat = |at: DVec3| {
        let world = world_from_object.transform_point3(at);
        object_from_world.transform_point3(world - (world - center).dot(normal) * normal)
    };
    Some(points.iter().filter_map(|point| Some((*point, flat(position(bezier, point)?)))).collect())
}

/// The control points moved half the way to the mean of their neighbours. On the border of the surface only neighbours on the
/// border count, and its corners stay, so the surface does not shrink inwards.
pub(crate) fn smoothed(bezier: &Bezier, points: &BTreeSet<PointIndex>) -> Placed {
    let mesh = Connectivity::of(bezier);
    let (positions, mut neighbours) = (mesh.positions(bezier), mesh.neighbours());
    let mut on_border: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); positions.len()];
    for side in mesh.borders() {
        let nodes = [0, 1, 2, 3].map(|k| mesh.node(side.point(k, 0)));
        for pair in nodes.windows(2) {
            on_border[pair[0]].insert(pair[1]);
            on_border[pair[1]].insert(pair[0]);
        }
    }
    for (node, border) in on_border.into_iter().enumerate().filter(|(_, border)| !border.is_empty()) {
        let is_corner = mesh.nodes()[node].len() == 1 && mesh.nodes()[node].iter().all(is_corner_of_patch);
        neighbours[node] = if is_corner { BTreeSet::new() } else { border };
    }
    let smooth = |point: &PointIndex| {
        let node = mesh.node(*point);
        let mean = neighbours[node].iter().map(|next| positions[*next]).sum::<DVec3>() / neighbours[node].len() as f64;
        (!neighbours[node].is_empty()).then(|| (*point, positions[node].lerp(mean, SMOOTHING)))
    };
    points.iter().filter(|point| position(bezier, point).is_some()).filter_map(smooth).collect()
}

fn is_corner_of_patch(point: &PointIndex) -> bool {
    [0, 3].contains(&point.i) && [0, 3].contains(&point.j)
}

/// The control points moved onto the bilinear surface of their patch's corners, evenly spaced. The corners stay.
pub(crate) fn reset(bezier: &Bezier, points: &BTreeSet<PointIndex>) -> Placed {
    let bilinear = |point: &PointIndex| {
        let [[a, .., b], _, _, [c, .., d]] = bezier.patches.get(point.patch)?.points;
        let (u, v) = (point.i as f64 / 3.0, point.j as f64 / 3.0);
        Some((*point, (1.0 - u) * ((1.0 - v) * a + v * b) + u * ((1.0 - v) * c + v * d)))
    };
    points.iter().filter_map(bilinear).collect()
}

#[cfg(test)]
mod tests {
    use super::super::connectivity::tests::sheet;
    use super::*;
    use crate::scene::Transform;

    fn all(patch: usize) -> BTreeSet<PointIndex> {
        (0..16).map(|k| PointIndex { patch, i: k / 4, j: k % 4 }).collect()
    }

    #[test]
    fn flattened_points_lie_in_a_plane_of_the_world() {
        let mut bezier = sheet(1, 1, |x, z| x * z - 0.3 * x * x);
        bezier.transform = Transform {
            translate: DVec3::new(5.0, -2.0, 1.0),
            rotate: DVec3::new(20.0, 40.0, 60.0),
            scale: DVec3::new(1.0, 3.0, -0.5),
        };
        let to_world = bezier.transform.world_from_object();
        let flat = flattened(&bezier, &all(0)).unwrap();
        let worlds: Vec<DVec3> = flat.iter().map(|(_, at)| to_world.transform_point3(*at)).collect();
        let (center, normal) = nearest_plane(&worlds).unwrap();
        let off = worlds.iter().map(|at| (*at - center).dot(normal).abs()).fold(0.0, f64::max);
        // Coordinates of size 20 through two maps.
        assert!(off < 1e-13, "{off}");
        let three: BTreeSet<_> = all(0).into_iter().take(3).collect();
        assert_eq!(flattened(&bezier, &three), None, "three points lie in a plane");
        bezier.transform.scale.y = 0.0;
        assert_eq!(flattened(&bezier, &all(0)), None, "no way back from the world");
    }

    #[test]
    fn smoothing_moves_a_bump_down_and_keeps_the_corners_and_flat_points() {
        let bezier = sheet(2, 1, |x, z| if (x, z) == (3.0, 1.0) { 1.0 } else { 0.0 });
        let placed = smoothed(&bezier, &all(0));
        let at = |i, j| placed.iter().find(|(point, _)| (point.i, point.j) == (i, j)).map(|(_, at)| *at);
        assert_eq!(at(3, 1), Some(DVec3::new(3.0, 0.5, 1.0)), "half the way to four neighbours on the ground");
        assert_eq!(at(2, 1), Some(DVec3::new(2.0, 0.125, 1.0)), "an eighth of the bump");
        assert_eq!((at(0, 0), at(0, 3)), (None, None), "corners of the surface stay");
        assert_eq!(at(3, 0), Some(DVec3::new(3.0, 0.0, 0.0)), "a border follows its own neighbours");
    }

    #[test]
    fn a_reset_net_is_bilinear_and_keeps_its_corners() {
        let bezier = sheet(1, 1, |x, z| x * z + (3.0 * x).sin() * (x - 3.0) * z);
        let placed = reset(&bezier, &all(0));
        for (point, at) in placed {
            let before = bezier.patches[0].points[point.i][point.j];
            // The corners span y = x z exactly, up to rounding of numbers below 10.
            assert!((at - DVec3::new(before.x, before.x * before.z, before.z)).length() < 1e-14, "{point:?}: {at}");
        }
    }
}
