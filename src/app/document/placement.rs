//! The places and sizes of new items: inside of a free ball, and of copies: beside their originals.

use super::handles::Handle;
use crate::geometry::Sphere;
use crate::geometry::bezier::ControlNet;
use crate::scene::{Scene, Shape, Transform};
use glam::DVec3;

/// Planes nearer than this coincide, over the radius of the ball above them.
const SAME_PLANE: f64 = 0.25;

/// The least angle between a new patch or quad and the line from the eye to its centre, degrees.
const LEAST_SLANT: f64 = 35.0;

/// The rotation about x and y, degrees, by which a horizontal square with its centre at `center` is seen from `eye` from above and
/// not from the edge: none where it already is.
pub(super) fn facing(center: DVec3, eye: DVec3) -> DVec3 {
    let way = eye - center;
    let height = way.y.atan2(way.with_y(0.0).length()).to_degrees();
    // Without a direction the height is 0, and the square turns towards +z.
    if height >= LEAST_SLANT {
        DVec3::ZERO
    } else {
        // Whole degrees read better in the panel.
        DVec3::new((LEAST_SLANT - height).ceil(), way.x.atan2(way.z).to_degrees().round(), 0.0)
    }
}

/// The horizontal plane that touches the ball from below; deeper where that plane would coincide with another.
pub(super) fn plane_below(scene: &Scene, room: &Sphere) -> Shape {
    let heights = scene.objects.iter().filter_map(|object| match &object.shape {
        Shape::Plane { point, normal, .. } if normal.with_y(0.0).length() < 1e-3 * normal.y.abs() => Some(point.y),
        _ => None,
    });
    let taken: Vec<f64> = heights.collect();
    // Each plane takes at most one of these depths.
    let mut depths = (2..=taken.len() + 2).map(|k| 0.5 * k as f64 * room.radius);
    let is_free =
        |depth: &f64| taken.iter().all(|height| (room.center.y - depth - height).abs() >= SAME_PLANE * room.radius);
    let depth = depths.find(is_free).unwrap_or(room.radius);
    Shape::Plane { point: room.center - depth * DVec3::Y, normal: DVec3::Y, u_axis: None }
}

/// The way from an item at `from` to its copy: to the right in the picture, in steps of a tenth of the picture's height at
/// the camera's target, up to a place without another item.
pub(super) fn way_to_copy(scene: &Scene, from: DVec3) -> DVec3 {
    let (right, taken) = (right_in_picture(scene), centers(scene));
    let camera = &scene.camera;
    let step = 0.2 * camera.position.distance(camera.target) * (0.5 * camera.fov_y.to_radians()).tan();
    let is_free = |way: &DVec3| taken.iter().all(|center| center.distance(from + *way) >= 0.5 * step);
    // As many steps as there are items cannot all be taken.
    (1..=taken.len() + 1).map(|k| k as f64 * step * right).find(is_free).unwrap_or(step * right)
}

/// The transform that brings patches into a ball: their control points fill it, in their own orientation.
pub(super) fn fitted(patches: &[ControlNet], room: &Sphere) -> Transform {
    let points = || patches.iter().flat_map(|net| net.points.into_iter().flatten());
    let low = points().fold(DVec3::INFINITY, DVec3::min);
    let high = points().fold(DVec3::NEG_INFINITY, DVec3::max);
    let center = 0.5 * (low + high);
    let radius = points().map(|point| point.distance(center)).fold(0.0, f64::max);
    let scale = if radius > 0.0 { room.radius / radius } else { 1.0 };
    let translate = room.center - scale * center;
    // Points so large or so small that their size is no number stay as they are.
    if scale.is_normal() && translate.is_finite() {
        Transform { translate, scale: DVec3::splat(scale), ..Transform::default() }
    } else {
        Transform::default()
    }
}

/// The centres of all objects and lights, world space.
fn centers(scene: &Scene) -> Vec<DVec3> {
    let (objects, lights) = (0..scene.objects.len(), 0..scene.lights.len());
    let handles = objects.map(Handle::Object).chain(lights.map(Handle::Light));
    handles.filter_map(|handle| handle.position(scene)).collect()
}

/// The direction to the right in the picture; x for a camera without a direction.
fn right_in_picture(scene: &Scene) -> DVec3 {
    let camera = &scene.camera;
    (camera.target - camera.position).cross(camera.up).try_normalize().unwrap_or(DVec3::X)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::array;

    const ROOM: Sphere = Sphere { center: DVec3::new(3.0, -1.0, 2.0), radius: 0.5 };

    fn net(low: f64, high: f64) -> ControlNet {
        let at = |k: usize| low + (high - low) * k as f64 / 3.0;
        ControlNet { points: array::from_fn(|i| array::from_fn(|j| DVec3::new(at(i), at(j), low))) }
    }

    #[test]
    fn patches_of_any_size_fill_the_ball() {
        for (low, high) in [(-500.0, 700.0), (0.0, 1e-4), (90.0, 91.0)] {
            let net = net(low, high);
            let transform = fitted(&[net], &ROOM);
            assert_eq!(transform.rotate, DVec3::ZERO);
            let distances = net.transformed(&transform.world_from_object()).points.into_iter().flatten();
            let distances: Vec<_> = distances.map(|point| point.distance(ROOM.center)).collect();
            let largest = distances.iter().copied().fold(0.0, f64::max);
            // The centre cancels the translation: a few roundings of a hundred times the size.
            assert!((largest - ROOM.radius).abs() < 1e-12, "{low} to {high}: {distances:?}");
        }
    }

    #[test]
    fn a_point_and_points_beyond_numbers_get_a_usable_transform() {
        let far = net(-1e308, 1e308);
        for (net, expected) in [(net(2.0, 2.0), ROOM.center - 2.0), (far, DVec3::ZERO)] {
            let transform = fitted(&[net], &ROOM);
            assert_eq!((transform.translate, transform.scale), (expected, DVec3::ONE));
        }
    }
}
