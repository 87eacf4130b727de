//! The surface normal at the selection. Knows no widget.

use crate::app::document::{Item, PointIndex, Selection};
use crate::geometry::bezier::Patch;
use crate::scene::{Bezier, Emitter, Scene, Shape};
use glam::DVec3;
use std::collections::BTreeSet;

/// The unit normal at the selection: at control points the mean normal of their patches at the nearest parameters, (i / 3, j / 3)
/// for `P[i][j]`; of a quad, a plane or a square light its own, of a beam its direction. `None` for every other selection.
pub(crate) fn at_selection(scene: &Scene, selection: &Selection) -> Option<DVec3> {
    let normal = match selection.item {
        Item::Object(index) => match &scene.objects.get(index)?.shape {
            Shape::Bezier(bezier) => mean_normal(bezier, &selection.points),
            Shape::Revolution(revolution) => mean_normal(revolution.surface(), &selection.points),
            Shape::Quad { edge_u, edge_v, .. } => edge_u.cross(*edge_v),
            Shape::Plane { normal, .. } => *normal,
            Shape::Sphere { .. } => return None,
        },
        Item::Light(index) => match &scene.lights.get(index)?.emitter {
            Emitter::Quad { edge_u, edge_v, .. } => edge_u.cross(*edge_v),
            Emitter::Beam { direction, .. } => *direction,
            Emitter::Point { .. } | Emitter::Sphere { .. } | Emitter::Sun { .. } => return None,
        },
        Item::Nothing | Item::Camera | Item::Settings | Item::Material(_) | Item::Texture(_) => return None,
    };
    normal.try_normalize()
}

fn mean_normal(bezier: &Bezier, points: &BTreeSet<PointIndex>) -> DVec3 {
    let world_from_object = bezier.transform.world_from_object();
    let patches: BTreeSet<usize> = points.iter().map(|point| point.patch).collect();
    let of_patch = |patch: usize| {
        let net = bezier.patches.get(patch)?.transformed(&world_from_object);
        let patch_normal = Patch::new(net).mirrored(bezier.transform.is_mirroring());
        let own = points.iter().filter(move |point| point.patch == patch);
        Some(own.map(|point| patch_normal.normal(point.i as f64 / 3.0, point.j as f64 / 3.0)).sum::<DVec3>())
    };
    patches.into_iter().filter_map(of_patch).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::bezier::ControlNet;
    use crate::scene::{Object, Transform};
    use std::array;
    use std::sync::Arc;

    fn scene(scale: DVec3) -> Scene {
        // A roof: the slopes at u = 0 and u = 1 are opposite.
        let height = [0.0, 1.0, 1.0, 0.0];
        let points = array::from_fn(|i| array::from_fn(|j| DVec3::new(i as f64, j as f64, height[i])));
        let transform = Transform { scale, ..Transform::default() };
        let shape =
            Shape::Bezier(Bezier { transform, patches: Arc::new(vec![ControlNet { points }]), file: None, uv: None });
        let object = Object { name: String::new(), material: String::new(), shape, body: None };
        Scene { objects: vec![object], ..Scene::default() }
    }

    fn normal(scale: DVec3, points: &[(usize, usize)]) -> Option<DVec3> {
        let points = points.iter().map(|&(i, j)| PointIndex { patch: 0, i, j }).collect();
        at_selection(&scene(scale), &Selection { points, ..Selection::of(Item::Object(0)) })
    }

    #[test]
    fn the_normal_of_control_points_is_the_mean_of_their_patches() {
        let (slope, third) = (DVec3::new(-1.0, 0.0, 1.0).normalize(), 1.0 / 3.0);
        assert!(normal(DVec3::ONE, &[(0, 1)]).unwrap().distance(slope) < 1e-12, "at u = 0");
        assert!(normal(DVec3::ONE, &[(0, 1), (3, 2)]).unwrap().distance(DVec3::Z) < 1e-12, "the mean of both slopes");
        // dz/du at u = 1/3 is 3 (1 - 2 u) = 1, and dx/du is 3.
        let inner = DVec3::new(-third, 0.0, 1.0).normalize();
        assert!(normal(DVec3::ONE, &[(1, 0)]).unwrap().distance(inner) < 1e-12, "P[1][0] is nearest to u = 1/3");
        let mirrored = normal(DVec3::new(1.0, 1.0, -1.0), &[(0, 1), (3, 2)]).unwrap();
        assert!(mirrored.distance(DVec3::NEG_Z) < 1e-12, "the outside of a mirrored surface: {mirrored}");
        assert_eq!(normal(DVec3::ONE, &[]), None, "no control point");
    }
}
