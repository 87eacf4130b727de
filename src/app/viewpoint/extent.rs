//! The extent of the selection and of all objects, as balls that enclose it. Infinite planes and suns have none.

use crate::app::document::{Handle, Item, Selection, handles};
use crate::geometry::Sphere;
use crate::math::Aabb;
use crate::scene::{Emitter, Scene, Shape};
use glam::DVec3;

/// The balls around the selected control points, or else around the selected object or light; empty for any other item.
pub(crate) fn of_selection(scene: &Scene, selection: &Selection) -> Vec<Sphere> {
    match selection.item {
        Item::Object(object) if !selection.points.is_empty() => {
            let points = selection.points.iter().map(|&point| Handle::Point { object, point });
            points.filter_map(|handle| handle.position(scene)).map(point_ball).collect()
        }
        Item::Object(object) => scene.objects.get(object).map_or(Vec::new(), |object| of_shape(&object.shape)),
        Item::Light(light) => scene.lights.get(light).map_or(Vec::new(), |light| of_emitter(&light.emitter)),
        _ => Vec::new(),
    }
}

/// The balls around all objects; around all lights where no object has an extent.
pub(crate) fn of_objects(scene: &Scene) -> Vec<Sphere> {
    let objects: Vec<_> = scene.objects.iter().flat_map(|object| of_shape(&object.shape)).collect();
    if objects.is_empty() {
        scene.lights.iter().flat_map(|light| of_emitter(&light.emitter)).collect()
    } else {
        objects
    }
}

/// The box around all balls; `None` without balls.
pub(super) fn bounds(balls: &[Sphere]) -> Option<Aabb> {
    let ends = balls.iter().flat_map(|ball| [ball.center - ball.radius, ball.center + ball.radius]);
    let bounds = Aabb::around(ends);
    (!bounds.is_empty()).then_some(bounds)
}

/// The centre of the box around all balls; `None` without balls.
pub(crate) fn center(balls: &[Sphere]) -> Option<DVec3> {
    bounds(balls).map(|bounds| bounds.center())
}

fn of_shape(shape: &Shape) -> Vec<Sphere> {
    match shape {
        Shape::Quad { corner, edge_u, edge_v } => corners(*corner, *edge_u, *edge_v),
        Shape::Sphere { center, radius } => vec![Sphere { center: *center, radius: *radius }],
        Shape::Plane { .. } => Vec::new(),
        // Of the control points, because the surface lies in their convex hull, and the user drags them.
        Shape::Bezier(_) | Shape::Revolution(_) => {
            let balls = shape.surface().map(|surface| {
                let world_from_object = surface.transform.world_from_object();
                let points = handles::control_points(surface);
                points.map(|(_, at)| point_ball(world_from_object.transform_point3(at))).collect()
            });
            balls.unwrap_or_default()
        }
    }
}

fn of_emitter(emitter: &Emitter) -> Vec<Sphere> {
    match emitter {
        Emitter::Point { position, .. } => vec![point_ball(*position)],
        Emitter::Sphere { center, radius, .. } | Emitter::Beam { center, radius, .. } => {
            vec![Sphere { center: *center, radius: *radius }]
        }
        Emitter::Quad { corner, edge_u, edge_v, .. } => corners(*corner, *edge_u, *edge_v),
        Emitter::Sun { .. } => Vec::new(),
    }
}

fn corners(corner: DVec3, edge_u: DVec3, edge_v: DVec3) -> Vec<Sphere> {
    [DVec3::ZERO, edge_u, edge_v, edge_u + edge_v].map(|to| point_ball(corner + to)).to_vec()
}

fn point_ball(center: DVec3) -> Sphere {
    Sphere { center, radius: 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::document::PointIndex;
    use crate::scene::{Object, SceneFile};

    #[test]
    fn control_points_come_before_their_object() {
        let scene = SceneFile::built_in("report").unwrap().scene;
        let mut selection = Selection::first_of(&scene);
        assert_eq!(of_selection(&scene, &selection).len(), 16, "the sheet's control points");
        let Item::Object(object) = selection.item else { panic!("the sheet is selected") };
        let point = PointIndex { patch: 0, i: 1, j: 2 };
        selection.points.insert(point);
        let expected = Handle::Point { object, point }.position(&scene).unwrap();
        assert_eq!(center(&of_selection(&scene, &selection)), Some(expected));
    }

    #[test]
    fn a_plane_has_no_extent_and_a_ball_its_radius() {
        let shapes = [
            Shape::Plane { point: DVec3::ZERO, normal: DVec3::Y, u_axis: None },
            Shape::Sphere { center: DVec3::X, radius: 2.0 },
        ];
        let object = |shape| Object { name: String::new(), material: String::new(), shape, body: None };
        let scene = Scene { objects: shapes.map(object).to_vec(), ..Scene::default() };
        assert_eq!(of_selection(&scene, &Selection::of(Item::Object(0))), []);
        let ball = of_selection(&scene, &Selection::of(Item::Object(1)));
        assert_eq!(ball, [Sphere { center: DVec3::X, radius: 2.0 }]);
        assert_eq!(center(&ball), Some(DVec3::X));
        assert_eq!(center(&[]), None);
        assert_eq!(of_objects(&scene), ball, "planes do not count");
    }
}
