//! The nearest object along a camera ray. Knows no widget.

use crate::geometry::bezier::Patch;
use crate::math::Ray;
use crate::scene::{Bezier, Object, Scene, Shape};
use glam::DVec3;

/// The index of the nearest object that the ray meets; `None` where the ray meets no object.
pub(crate) fn nearest_object(scene: &Scene, ray: &Ray) -> Option<usize> {
    nearest_hit(scene, ray).map(|(index, _)| index)
}

/// The nearest point in which the ray meets an object; `None` where the ray meets no object.
pub(crate) fn nearest_point(scene: &Scene, ray: &Ray) -> Option<DVec3> {
    nearest_hit(scene, ray).map(|(_, distance)| ray.at(distance))
}

fn nearest_hit(scene: &Scene, ray: &Ray) -> Option<(usize, f64)> {
    let hits = scene.objects.iter().enumerate().filter_map(|(index, object)| Some((index, distance(object, ray)?)));
    hits.min_by(|(_, a), (_, b)| a.total_cmp(b))
}

/// Distance along the ray to the object, scene units; `None` where the ray misses.
fn distance(object: &Object, ray: &Ray) -> Option<f64> {
    match &object.shape {
        Shape::Quad { corner, edge_u, edge_v } => parallelogram(ray, *corner, *edge_u, *edge_v),
        Shape::Sphere { center, radius } => sphere(ray, *center, *radius),
        Shape::Plane { point, normal, .. } => plane(ray, *point, *normal),
        Shape::Bezier(bezier) => surface(ray, bezier),
    }
}

fn in_front(distance: f64) -> Option<f64> {
    (distance > 0.0 && distance.is_finite()).then_some(distance)
}

fn plane(ray: &Ray, point: DVec3, normal: DVec3) -> Option<f64> {
    in_front((point - ray.origin).dot(normal) / ray.direction.dot(normal))
}

fn parallelogram(ray: &Ray, corner: DVec3, edge_u: DVec3, edge_v: DVec3) -> Option<f64> {
    let (t, u, v) = solve(ray, corner, edge_u, edge_v)?;
    (u.clamp(0.0, 1.0) == u && v.clamp(0.0, 1.0) == v).then_some(t)
}

/// Distance `t` along the ray to the plane `corner + u edge_u + v edge_v`, with `u` and `v` of the hit.
fn solve(ray: &Ray, corner: DVec3, edge_u: DVec3, edge_v: DVec3) -> Option<(f64, f64, f64)> {
    let normal = edge_u.cross(edge_v);
    let t = plane(ray, corner, normal)?;
    let local = ray.origin + t * ray.direction - corner;
    let area_sq = normal.length_squared();
    Some((t, local.cross(edge_v).dot(normal) / area_sq, edge_u.cross(local).dot(normal) / area_sq))
}

fn sphere(ray: &Ray, center: DVec3, radius: f64) -> Option<f64> {
    let to_center = center - ray.origin;
    let along = to_center.dot(ray.direction);
    let off_sq = (to_center - along * ray.direction).length_squared();
    let half_chord = (radius * radius - off_sq).sqrt();
    in_front(along - half_chord).or_else(|| in_front(along + half_chord))
}

fn surface(ray: &Ray, bezier: &Bezier) -> Option<f64> {
    let world_from_object = bezier.transform.world_from_object();
    let patches = bezier.patches.iter().map(|net| Patch::new(net.transformed(&world_from_object)));
    patches.filter_map(|patch| patch.intersect(ray)).map(|hit| hit.t).min_by(f64::total_cmp)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::bezier::ControlNet;
    use crate::scene::Transform;
    use std::array;
    use std::sync::Arc;

    // Distances of size 10 in a few operations.
    const TOLERANCE: f64 = 1e-13;

    fn object(shape: Shape) -> Object {
        Object { name: String::new(), material: String::new(), shape, body: None }
    }

    fn ray(x: f64, y: f64) -> Ray {
        Ray::new(DVec3::new(x, y, 10.0), DVec3::NEG_Z)
    }

    fn flat_sheet() -> Shape {
        let points = array::from_fn(|i| array::from_fn(|j| DVec3::new(i as f64 / 3.0, j as f64 / 3.0, 0.0)));
        let transform = Transform { translate: DVec3::new(0.0, 0.0, 2.0), ..Transform::default() };
        Shape::Bezier(Bezier { transform, patches: Arc::new(vec![ControlNet { points }]), file: None })
    }

    #[test]
    fn distances_of_simple_shapes() {
        let quad = Shape::Quad { corner: DVec3::ZERO, edge_u: DVec3::X, edge_v: DVec3::new(0.5, 1.0, 0.0) };
        let ball = Shape::Sphere { center: DVec3::ZERO, radius: 2.0 };
        let ground = Shape::Plane { point: DVec3::NEG_Z, normal: DVec3::Z, u_axis: None };
        let cases = [(quad, 10.0), (ball, 10.0 - 3.75_f64.sqrt()), (ground, 11.0), (flat_sheet(), 8.0)];
        for (shape, expected) in cases {
            let found = distance(&object(shape.clone()), &ray(0.5, 0.0)).unwrap();
            assert!((found - expected).abs() < TOLERANCE, "{found} for {shape:?}");
        }
    }

    #[test]
    fn a_ray_beside_a_shape_misses_it() {
        let quad = Shape::Quad { corner: DVec3::ZERO, edge_u: DVec3::X, edge_v: DVec3::Y };
        let ball = Shape::Sphere { center: DVec3::ZERO, radius: 1.0 };
        for shape in [quad, ball, flat_sheet()] {
            assert_eq!(distance(&object(shape.clone()), &ray(1.5, 0.5)), None, "{shape:?}");
        }
    }

    #[test]
    fn an_object_behind_the_ray_is_missed() {
        let ball = object(Shape::Sphere { center: DVec3::new(0.0, 0.0, 20.0), radius: 1.0 });
        assert_eq!(distance(&ball, &ray(0.0, 0.0)), None);
    }

    #[test]
    fn the_nearest_object_is_picked() {
        let ball = |z| object(Shape::Sphere { center: DVec3::new(0.0, 0.0, z), radius: 1.0 });
        let scene = Scene { objects: vec![ball(0.0), ball(5.0), ball(-5.0)], ..Scene::default() };
        assert_eq!(nearest_object(&scene, &ray(0.1, 0.1)), Some(1));
        assert_eq!(nearest_object(&scene, &ray(3.0, 0.0)), None);
        assert_eq!(nearest_point(&scene, &ray(0.0, 0.0)), Some(DVec3::new(0.0, 0.0, 6.0)));
    }
}
