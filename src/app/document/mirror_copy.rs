//! Mirror images of objects and lights, across a plane of the world's axes.

use super::edit::Edit;
use super::names::free_name;
use super::selection::Item;
use crate::scene::{Emitter, Revolution, Scene, Shape, Transform};
use glam::DVec3;

/// The edit that adds the mirror image of an object or a light across the plane where coordinate number `axis` is 0, under a free
/// name; `None` for other items. Outsides stay outside.
pub(crate) fn mirror_copy(scene: &Scene, item: Item, axis: usize) -> Option<Edit> {
    Some(match item {
        Item::Object(index) => {
            let mut copy = scene.objects.get(index)?.clone();
            copy.name = free_name(scene, Item::Object(scene.objects.len()), &copy.name);
            copy.shape = mirrored_shape(&copy.shape, axis);
            Edit::AddObject(copy)
        }
        Item::Light(index) => {
            let mut copy = scene.lights.get(index)?.clone();
            copy.name = free_name(scene, Item::Light(scene.lights.len()), &copy.name);
            copy.emitter = mirrored_emitter(&copy.emitter, axis);
            Edit::AddLight(copy)
        }
        Item::Nothing | Item::Camera | Item::Settings | Item::Material(_) | Item::Texture(_) => return None,
    })
}

fn mirrored(mut vector: DVec3, axis: usize) -> DVec3 {
    vector[axis] = -vector[axis];
    vector
}

/// The mirror image of a transform `T R S`: with the mirror M it is `M T R S = (M T) (M R M) (S M)`, and `M R M` turns about the
/// two other axes the other way round.
fn mirrored_transform(transform: &Transform, axis: usize) -> Transform {
    let Transform { translate, rotate, scale } = *transform;
    Transform { translate: mirrored(translate, axis), rotate: -mirrored(rotate, axis), scale: mirrored(scale, axis) }
}

fn mirrored_shape(shape: &Shape, axis: usize) -> Shape {
    let image = |vector: DVec3| mirrored(vector, axis);
    match shape {
        Shape::Quad { corner, edge_u, edge_v } => {
            let (corner, edge_u, edge_v) = mirrored_quad([*corner, *edge_u, *edge_v], axis);
            Shape::Quad { corner, edge_u, edge_v }
        }
        Shape::Sphere { center, radius } => Shape::Sphere { center: image(*center), radius: *radius },
        Shape::Plane { point, normal, u_axis } => {
            Shape::Plane { point: image(*point), normal: image(*normal), u_axis: u_axis.map(image) }
        }
        Shape::Bezier(bezier) => {
            let mut copy = bezier.clone();
            copy.transform = mirrored_transform(&bezier.transform, axis);
            Shape::Bezier(copy)
        }
        Shape::Revolution(revolution) => {
            let mut copy: Revolution = revolution.clone();
            *copy.transform_mut() = mirrored_transform(revolution.transform(), axis);
            Shape::Revolution(copy)
        }
    }
}

fn mirrored_emitter(emitter: &Emitter, axis: usize) -> Emitter {
    let mut copy = emitter.clone();
    match &mut copy {
        Emitter::Point { position, .. } => *position = mirrored(*position, axis),
        Emitter::Sphere { center, .. } => *center = mirrored(*center, axis),
        Emitter::Quad { corner, edge_u, edge_v, .. } => {
            (*corner, *edge_u, *edge_v) = mirrored_quad([*corner, *edge_u, *edge_v], axis);
        }
        Emitter::Sun { direction, .. } => *direction = mirrored(*direction, axis),
        Emitter::Beam { center, direction, .. } => {
            (*center, *direction) = (mirrored(*center, axis), mirrored(*direction, axis));
        }
    }
    copy
}

/// Corner and edges of the mirror image. It begins at the other end of the edge along u: a mirror turns a cross product around.
fn mirrored_quad([corner, edge_u, edge_v]: [DVec3; 3], axis: usize) -> (DVec3, DVec3, DVec3) {
    (mirrored(corner + edge_u, axis), -mirrored(edge_u, axis), mirrored(edge_v, axis))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::bezier::{ControlNet, Patch};
    use crate::math::Rgb;
    use crate::scene::{Bezier, Light, Object};
    use glam::DVec2;
    use std::array::from_fn;
    use std::sync::Arc;

    fn copied(shape: Shape, axis: usize) -> Object {
        let object = Object { name: "a".into(), material: "white".into(), shape, body: Some("b".into()) };
        let scene = Scene { objects: vec![object], ..Scene::default() };
        let Some(Edit::AddObject(copy)) = mirror_copy(&scene, Item::Object(0), axis) else { panic!("a copy") };
        assert_ne!(copy.name, "a");
        assert_eq!((copy.material.as_str(), copy.body.as_deref()), ("white", Some("b")));
        copy
    }

    fn transform() -> Transform {
        Transform {
            translate: DVec3::new(1.0, 2.0, 3.0),
            rotate: DVec3::new(20.0, 50.0, -110.0),
            scale: DVec3::new(1.0, -2.0, 0.5),
        }
    }

    #[test]
    fn patches_are_mirrored_point_by_point_with_their_outside() {
        let height = |i: usize, j: usize| 0.3 * (i * j) as f64;
        let points = from_fn(|i| from_fn(|j| DVec3::new(i as f64, height(i, j), j as f64)));
        let bezier =
            Bezier { transform: transform(), patches: Arc::new(vec![ControlNet { points }]), file: None, uv: None };
        let vase = [(1.0, 0.0), (1.0, 0.5), (0.6, 0.8), (0.4, 1.0)].map(DVec2::from).to_vec();
        for shape in [Shape::Bezier(bezier), Shape::Revolution(Revolution::new(transform(), vase, 100.0, true))] {
            for axis in 0..3 {
                let copy = copied(shape.clone(), axis).shape;
                let patches = |shape: &Shape| shape.surface().unwrap().placed_patches().collect::<Vec<Patch>>();
                for (before, after) in patches(&shape).iter().zip(patches(&copy)) {
                    for (u, v) in [(0.2, 0.7), (0.9, 0.4)] {
                        let expected = mirrored(before.net().eval(u, v), axis);
                        // Coordinates below 10 through some ten roundings.
                        assert!(after.net().eval(u, v).distance(expected) < 1e-13, "axis {axis}");
                        let normal = mirrored(before.normal(u, v), axis);
                        assert!(after.normal(u, v).distance(normal) < 1e-9, "axis {axis}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_normal_of_a_quad_is_mirrored() {
        let [corner, edge_u, edge_v] =
            [DVec3::new(1.0, 2.0, 3.0), DVec3::new(1.0, 0.5, 0.0), DVec3::new(0.0, 1.0, 2.0)];
        for axis in 0..3 {
            let Shape::Quad { corner: c, edge_u: u, edge_v: v } =
                copied(Shape::Quad { corner, edge_u, edge_v }, axis).shape
            else {
                panic!("a quad")
            };
            assert_eq!(u.cross(v), mirrored(edge_u.cross(edge_v), axis));
            assert_eq!(c + 0.5 * (u + v), mirrored(corner + 0.5 * (edge_u + edge_v), axis));
        }
    }

    #[test]
    fn lights_are_mirrored_and_materials_are_not() {
        let emitter = Emitter::Sun { direction: DVec3::new(1.0, -2.0, 0.5), irradiance: Rgb::ONE, diameter: 0.5 };
        let scene = Scene { lights: vec![Light { name: "sun".into(), emitter }], ..Scene::default() };
        let Some(Edit::AddLight(copy)) = mirror_copy(&scene, Item::Light(0), 0) else { panic!("a copy") };
        assert!(matches!(copy.emitter, Emitter::Sun { direction, .. } if direction == DVec3::new(-1.0, -2.0, 0.5)));
        for item in [Item::Material(0), Item::Camera, Item::Object(0)] {
            assert_eq!(mirror_copy(&scene, item, 0), None);
        }
    }
}
