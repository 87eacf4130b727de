//! Closed bodies from open sheets.

use super::connectivity::{Connectivity, Side};
use crate::app::document::handles::control_points;
use crate::app::document::selection::PointIndex;
use crate::geometry::bezier::{ControlNet, Patch};
use crate::math::Aabb;
use crate::scene::{Bezier, UvRect};
use glam::DVec3;
use std::array::from_fn;
use std::sync::Arc;

/// The thickness of a thickened sheet over the largest extent of its control points along an axis of the world.
const THICKNESS: f64 = 0.05;

/// The thickness that suits the size of a surface, scene units.
pub(crate) fn usual_thickness(bezier: &Bezier) -> f64 {
    let bounds = bezier.placed_nets().iter().fold(Aabb::EMPTY, |bounds, net| bounds.union(&net.bounds()));
    if bounds.is_empty() { 0.0 } else { THICKNESS * bounds.size().max_element() }
}

/// The closed body between a sheet and its copy at a distance of `thickness`, scene units, on its inside. The sheet stays as it is; the
/// patches of the copy and ruled patches along the border follow in the list. Normals point out of the body. Control points that were
/// welded are equal, and so are those along all new seams.
///
/// The copy has the control points of the sheet, moved along the mean normal of the patches that meet there, at the nearest
/// parameters. It is exact for a flat sheet; a curved one differs in its thickness, little where the thickness is
/// small against the radii of curvature. A sheet bent more closely than its thickness makes a body that overlaps itself.
///
/// # Errors
/// Why the surface bounds no body, and what to do.
pub(crate) fn thickened(bezier: &Bezier, thickness: f64) -> Result<Bezier, &'static str> {
    let mesh = Connectivity::of(bezier);
    let borders: Vec<Side> = mesh.borders().collect();
    if borders.is_empty() {
        return Err("The surface has no border: it is closed already");
    }
    if !is_sheet(&mesh, bezier.patches.len()) {
        return Err(
            "Three patches meet at an edge, or the outsides of two neighbours are opposite: such a surface has no inside",
        );
    }
    let outer = mesh.positions(bezier);
    let ways =
        ways(bezier, &mesh, thickness).ok_or("The normals of the surface vanish or cancel at a control point")?;
    let inner: Vec<DVec3> = outer.iter().zip(ways).map(|(at, way)| *at - way).collect();
    let placed = |positions: &[DVec3], patch: usize, reversed: bool| {
        let at = |i: usize, j: usize| PointIndex { patch, i: if reversed { 3 - i } else { i }, j };
        ControlNet { points: from_fn(|i| from_fn(|j| positions[mesh.node(at(i, j))])) }
    };
    let count = bezier.patches.len();
    let sheet = (0..count).map(|patch| placed(&outer, patch, false));
    // With u reversed the outside of the copy is on the other side.
    let copy = (0..count).map(|patch| placed(&inner, patch, true));
    let walls = borders.iter().map(|side| {
        let nodes = around(&mesh, *side);
        ControlNet { points: nodes.map(|node| from_fn(|j| inner[node].lerp(outer[node], j as f64 / 3.0))) }
    });
    let uv = bezier.uv.as_ref().map(|uv| {
        let reversed =
            uv.iter().map(|rect| UvRect { start: rect.start.with_x(rect.end.x), end: rect.end.with_x(rect.start.x) });
        Arc::new(uv.iter().copied().chain(reversed).chain(borders.iter().map(|_| UvRect::default())).collect())
    });
    let patches = Arc::new(sheet.chain(copy).chain(walls).collect());
    Ok(Bezier { patches, uv, file: None, transform: bezier.transform })
}

/// The nodes along a side, in the direction that has the patch on its left, seen from outside.
fn around(mesh: &Connectivity, side: Side) -> [usize; 4] {
    let mut nodes = [0, 1, 2, 3].map(|k| mesh.node(side.point(k, 0)));
    // The sides u = 0 and v = 1 run the other way round.
    if matches!(side.side, 0 | 3) {
        nodes.reverse();
    }
    nodes
}

/// Whether at most two patches meet at each edge, with their outsides on one side.
fn is_sheet(mesh: &Connectivity, patches: usize) -> bool {
    (0..patches).flat_map(Side::of).all(|side| {
        let along = mesh.along(side);
        along.len() <= 2
            && along.iter().filter(|other| **other != side).all(|other| around(mesh, *other) != around(mesh, side))
    })
}

/// For each node the way of `thickness` along the outward normal, object space; `None` where a node has no normal, or a scale is
/// zero.
fn ways(bezier: &Bezier, mesh: &Connectivity, thickness: f64) -> Option<Vec<DVec3>> {
    let patches: Vec<Patch> = bezier.placed_patches().collect();
    let mut normals = vec![DVec3::ZERO; mesh.nodes().len()];
    for (point, _) in control_points(bezier) {
        normals[mesh.node(point)] += patches[point.patch].normal(point.i as f64 / 3.0, point.j as f64 / 3.0);
    }
    let object_from_world = bezier.transform.world_from_object().inverse();
    let way = |normal: DVec3| {
        let way = object_from_world.transform_vector3(thickness * normal.try_normalize()?);
        way.is_finite().then_some(way)
    };
    normals.into_iter().map(way).collect()
}

#[cfg(test)]
mod tests {
    use super::super::connectivity::tests::sheet;
    use super::*;
    use crate::scene::Transform;

    /// Volume of the body that patches enclose, object space, by the divergence theorem with the midpoint rule.
    fn volume(bezier: &Bezier) -> f64 {
        const STEPS: u32 = 16;
        let at = |k: u32| (f64::from(k) + 0.5) / f64::from(STEPS);
        let cells = || (0..STEPS).flat_map(move |i| (0..STEPS).map(move |j| (at(i), at(j))));
        let flux = |net: &ControlNet| {
            let of_cell = |(u, v): (f64, f64)| {
                let d = net.derivatives(u, v);
                d.position.dot(d.dpdu.cross(d.dpdv)) / 3.0
            };
            cells().map(of_cell).sum::<f64>() / f64::from(STEPS * STEPS)
        };
        bezier.patches.iter().map(flux).sum()
    }

    /// Every edge of a closed body has two patches, with equal control points.
    fn is_closed(bezier: &Bezier) -> bool {
        let mesh = Connectivity::of(bezier);
        let positions = mesh.positions(bezier);
        let are_equal = control_points(bezier).all(|(point, at)| positions[mesh.node(point)] == at);
        are_equal && mesh.borders().count() == 0 && is_sheet(&mesh, bezier.patches.len())
    }

    #[test]
    fn a_flat_sheet_becomes_a_box_of_its_thickness() {
        let flat = sheet(2, 2, |_, _| 0.0);
        let body = thickened(&flat, 0.5).unwrap();
        assert_eq!(body.patches.len(), 4 + 4 + 8);
        assert!(is_closed(&body));
        // 6 x 6 x 1/2; the midpoint rule is exact for flat sides up to rounding.
        assert!((volume(&body) - 18.0).abs() < 1e-10, "{}", volume(&body));
        assert_eq!(body.patches[..4], flat.patches[..], "the sheet stays");
    }

    #[test]
    fn a_curved_sheet_becomes_a_closed_body_with_its_outside_outside() {
        let curved = sheet(3, 2, |x, z| 0.3 * (x * 0.7).sin() + 0.1 * z * z);
        let body = thickened(&curved, 0.2).unwrap();
        assert!(is_closed(&body));
        let area: f64 =
            curved.patches.iter().map(|net| net.derivatives(0.5, 0.5)).map(|d| d.dpdu.cross(d.dpdv).length()).sum();
        // Curvature and one sample of the area for each patch: a fifth.
        assert!((volume(&body) / (0.2 * area) - 1.0).abs() < 0.2, "{} of {}", volume(&body), 0.2 * area);
    }

    #[test]
    fn thickness_is_in_the_world_and_mirrored_sheets_keep_their_outside() {
        let mut scaled = sheet(1, 1, |_, _| 0.0);
        scaled.transform = Transform { scale: DVec3::new(2.0, -4.0, 1.0), ..Transform::default() };
        let body = thickened(&scaled, 1.0).unwrap();
        assert!(is_closed(&body));
        // A scale of 4 across the sheet.
        let expected = 9.0 / 4.0;
        assert!((volume(&body) - expected).abs() < 1e-10, "{}", volume(&body));
        assert_eq!(usual_thickness(&scaled), 0.05 * 6.0);
    }

    #[test]
    fn the_reason_is_told_where_a_surface_bounds_no_body() {
        let body = thickened(&sheet(1, 1, |_, _| 0.0), 0.1).unwrap();
        assert!(thickened(&body, 0.1).unwrap_err().contains("closed already"));
        let mut twisted = sheet(2, 1, |_, _| 0.0);
        let net = twisted.patches[1].transposed();
        Arc::make_mut(&mut twisted.patches)[1] = net;
        assert!(thickened(&twisted, 0.1).unwrap_err().contains("opposite"));
        let mut flattened = sheet(1, 1, |_, _| 0.0);
        flattened.transform.scale.y = 0.0;
        assert!(thickened(&flattened, 0.1).is_err(), "a scale of zero");
    }

    #[test]
    fn every_patch_of_the_body_has_its_place_in_the_texture() {
        let mut mapped = sheet(2, 1, |_, _| 0.0);
        mapped.uv = Some(Arc::new(vec![UvRect::default(); 2]));
        let body = thickened(&mapped, 0.1).unwrap();
        assert_eq!(body.uv.map(|uv| uv.len()), Some(body.patches.len()));
    }
}
