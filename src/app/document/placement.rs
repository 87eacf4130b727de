//! Where new items go: in the picture, and beside the items that are there.

use super::handles::Handle;
use crate::geometry::bezier::ControlNet;
use crate::scene::{Scene, Transform};
use glam::DVec3;

/// Distance of neighbouring places over the radius of a new item: neighbours do not touch.
const STEP: f64 = 2.2;
/// Places around the wanted place, in steps to the right and upwards in the picture.
const PLACES: [(f64, f64); 9] =
    [(0.0, 0.0), (1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)];
/// Extents of patches in the picture, over the size of a new item: smaller patches are hard to see, larger ones may enclose
/// the camera.
const VISIBLE: std::ops::RangeInclusive<f64> = 0.25..=8.0;

/// A length for new items, scene units: a fifth of the picture's height at the camera's target.
pub(super) fn size(scene: &Scene) -> f64 {
    let camera = &scene.camera;
    0.4 * camera.position.distance(camera.target) * (0.5 * camera.fov_y.to_radians()).tan()
}

/// The place nearest to `wanted` where no item has its centre within the size of a new item; `wanted` where every place
/// nearby is taken.
pub(super) fn free_place(scene: &Scene, wanted: DVec3) -> DVec3 {
    let (size, taken) = (size(scene), centers(scene));
    let (right, up) = picture_axes(scene);
    let mut places = PLACES.into_iter().map(|(x, y)| wanted + STEP * size * (x * right + y * up));
    let is_free = |place: &DVec3| taken.iter().all(|center| center.distance(*place) >= size);
    places.find(is_free).unwrap_or(wanted)
}

/// The way from an item at `from` to its copy: to the right, in steps of half the size of a new item, up to a place without
/// another item.
pub(super) fn way_to_copy(scene: &Scene, from: DVec3) -> DVec3 {
    let (right, taken) = (picture_axes(scene).0, centers(scene));
    let step = 0.5 * size(scene);
    let is_free = |way: &DVec3| taken.iter().all(|center| center.distance(from + *way) >= 0.5 * step);
    // As many steps as there are items cannot all be taken.
    (1..=taken.len() + 1).map(|k| k as f64 * step * right).find(is_free).unwrap_or(step * right)
}

/// The transform that brings patches into the picture: none where they already lie there in a visible size.
pub(super) fn fitted(scene: &Scene, patches: &[ControlNet]) -> Transform {
    let points = || patches.iter().flat_map(|net| net.points.into_iter().flatten());
    let low = points().fold(DVec3::INFINITY, DVec3::min);
    let high = points().fold(DVec3::NEG_INFINITY, DVec3::max);
    let (center, extent, size) = (0.5 * (low + high), (high - low).max_element(), size(scene));
    let is_near = center.distance(scene.camera.target) <= 3.0 * size;
    if !(extent > 0.0 && size > 0.0) || (is_near && VISIBLE.contains(&(extent / size))) {
        return Transform::default();
    }
    let scale = (2.0 * size / extent).clamp(1e-6, 1e6);
    let translate = free_place(scene, scene.camera.target) - scale * center;
    Transform { translate, scale: DVec3::splat(scale), ..Transform::default() }
}

/// The centres of all objects and lights, world space.
fn centers(scene: &Scene) -> Vec<DVec3> {
    let (objects, lights) = (0..scene.objects.len(), 0..scene.lights.len());
    let handles = objects.map(Handle::Object).chain(lights.map(Handle::Light));
    handles.filter_map(|handle| handle.position(scene)).collect()
}

/// The directions to the right and upwards in the picture; x and y for a camera without a direction.
fn picture_axes(scene: &Scene) -> (DVec3, DVec3) {
    let camera = &scene.camera;
    let forward = (camera.target - camera.position).normalize_or_zero();
    match forward.cross(camera.up).try_normalize() {
        Some(right) => (right, right.cross(forward)),
        None => (DVec3::X, DVec3::Y),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::array;

    fn net(low: f64, high: f64) -> ControlNet {
        let at = |k: usize| low + (high - low) * k as f64 / 3.0;
        ControlNet { points: array::from_fn(|i| array::from_fn(|j| DVec3::new(at(i), at(j), low))) }
    }

    #[test]
    fn patches_out_of_sight_are_brought_into_the_picture() {
        let scene = Scene::default();
        for (low, high) in [(-500.0, 700.0), (0.0, 1e-4), (90.0, 91.0)] {
            let world = fitted(&scene, &[net(low, high)]).world_from_object();
            let ends = [low, high].map(|at| world.transform_point3(DVec3::new(at, at, low)));
            let extent = (ends[1] - ends[0]).max_element();
            assert!((extent - 2.0 * size(&scene)).abs() < 1e-9, "{low} to {high}: {extent}");
            assert!(
                (0.5 * (ends[0] + ends[1])).distance(scene.camera.target) < size(&scene),
                "{low} to {high}: {ends:?}"
            );
        }
    }

    #[test]
    fn patches_in_sight_keep_their_place() {
        let (scene, half) = (Scene::default(), size(&Scene::default()));
        assert_eq!(fitted(&scene, &[net(-half, half)]), Transform::default());
    }
}
