//! The points of a scene that the user can drag: which exist, where they lie, and how they move.

use super::selection::{Item, PointIndex};
use crate::scene::{Bezier, Emitter, Object, Revolution, Scene, Shape};
use glam::{DVec2, DVec3};
use std::collections::BTreeSet;
use std::sync::Arc;

/// Control points nearer to each other than this fraction of their object's size are welded: they have one handle.
const WELD_TOLERANCE: f64 = 1e-9;

/// A point of the scene that the user can drag; an index is the item's position in its list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Handle {
    /// A control point of a Bezier object, or of the profile of a surface of revolution.
    Point {
        /// The object's index.
        object: usize,
        /// The control point within the object.
        point: PointIndex,
    },
    /// The centre of an object, which moves the whole object.
    Object(usize),
    /// The centre of a light; of a sun, the point from which a ray along its direction vector meets the origin.
    Light(usize),
}

impl Handle {
    /// The item that a click on the handle selects.
    pub(crate) fn item(self) -> Item {
        match self {
            Self::Point { object, .. } | Self::Object(object) => Item::Object(object),
            Self::Light(light) => Item::Light(light),
        }
    }

    /// The handle's name, for its tooltip and for assistive technology.
    pub(crate) fn label(self, scene: &Scene) -> String {
        match self {
            Self::Point { object, point } => {
                let shape = scene.objects.get(object).map(|object| &object.shape);
                if let (Some(Shape::Revolution(_)), Some(index)) = (shape, point.in_profile()) {
                    return format!("Profile point {index}");
                }
                let surface = shape.and_then(Shape::surface);
                let several = surface.is_some_and(|surface| surface.patches.len() > 1);
                let patch = if several { format!("patch {}, ", point.patch) } else { String::new() };
                format!("Control point {patch}P[{}][{}]", point.i, point.j)
            }
            Self::Object(object) => format!("Object {}", scene.objects.get(object).map_or("", |found| &found.name)),
            Self::Light(light) => format!("Light {}", scene.lights.get(light).map_or("", |found| &found.name)),
        }
    }

    /// The handle's position in world space; `None` where the scene lacks its item, or the object has no control points.
    pub(crate) fn position(self, scene: &Scene) -> Option<DVec3> {
        match self {
            Self::Point { object, point } => {
                let bezier = scene.objects.get(object)?.shape.surface()?;
                let local = bezier.patches.get(point.patch)?.points.get(point.i)?.get(point.j)?;
                Some(bezier.transform.world_from_object().transform_point3(*local))
            }
            Self::Object(object) => scene.objects.get(object).and_then(object_center),
            Self::Light(light) => scene.lights.get(light).map(|light| light_center(&light.emitter)),
        }
    }

    /// Moves the handle by a vector in world space. A control point stays where its object's transform cannot be inverted,
    /// because a scale is zero.
    pub(crate) fn translate(self, scene: &mut Scene, by: DVec3) {
        match self {
            Self::Point { object, point } => match scene.objects.get_mut(object).map(|object| &mut object.shape) {
                Some(Shape::Bezier(bezier)) => translate_point(bezier, point, by),
                Some(Shape::Revolution(revolution)) => translate_profile_point(revolution, point, by),
                _ => {}
            },
            Self::Object(object) => {
                if let Some(object) = scene.objects.get_mut(object) {
                    translate_shape(&mut object.shape, by);
                }
            }
            Self::Light(light) => {
                if let Some(light) = scene.lights.get_mut(light) {
                    translate_emitter(&mut light.emitter, by);
                }
            }
        }
    }
}

/// The handles to draw with their positions in world space: every light, the selected object and its control points. Each group
/// of welded control points has one handle, of its first point.
pub(crate) fn visible(scene: &Scene, selected: Item, welds: &[BTreeSet<PointIndex>]) -> Vec<(Handle, DVec3)> {
    let object = if let Item::Object(object) = selected { Some(Handle::Object(object)) } else { None };
    let items = (0..scene.lights.len()).map(Handle::Light).chain(object);
    let mut handles: Vec<_> = items.filter_map(|handle| Some((handle, handle.position(scene)?))).collect();
    if let Item::Object(object) = selected
        && let Some(bezier) = scene.objects.get(object).and_then(|object| object.shape.surface())
    {
        // Once for all points: it takes the sines of three angles.
        let world_from_object = bezier.transform.world_from_object();
        let distinct = welds.iter().filter_map(|group| group.first());
        handles.extend(distinct.filter_map(|&point| {
            let local = bezier.patches.get(point.patch)?.points.get(point.i)?.get(point.j)?;
            Some((Handle::Point { object, point }, world_from_object.transform_point3(*local)))
        }));
    }
    handles
}

/// Places control points at positions in object space.
pub(super) fn place(scene: &mut Scene, object: usize, points: &[(PointIndex, DVec3)]) {
    let Some(Object { shape: Shape::Bezier(bezier), .. }) = scene.objects.get_mut(object) else { return };
    for (point, to) in points {
        set_point(bezier, *point, |position| *position = *to);
    }
}

/// The index of every control point with its position in object space.
pub(crate) fn control_points(bezier: &Bezier) -> impl Iterator<Item = (PointIndex, DVec3)> + '_ {
    bezier.patches.iter().enumerate().flat_map(|(patch, net)| {
        (0..16).map(move |k| (PointIndex { patch, i: k / 4, j: k % 4 }, net.points[k / 4][k % 4]))
    })
}

/// The control points, grouped by position.
pub(super) fn weld_groups(bezier: &Bezier) -> Vec<BTreeSet<PointIndex>> {
    let size = control_points(bezier).map(|(_, at)| at.abs().max_element()).fold(0.0, f64::max);
    let tolerance = WELD_TOLERANCE * size;
    let mut sorted: Vec<_> = control_points(bezier).collect();
    sorted.sort_by(|(_, a), (_, b)| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z)));
    let mut groups: Vec<(DVec3, BTreeSet<PointIndex>)> = Vec::new();
    for (index, at) in sorted {
        // The points are sorted by x, so only the last groups can lie within the tolerance.
        let near = groups.iter_mut().rev().take_while(|(first, _)| at.x - first.x <= tolerance);
        match near.into_iter().find(|(first, _)| first.distance(at) <= tolerance) {
            Some((_, group)) => drop(group.insert(index)),
            None => groups.push((at, BTreeSet::from([index]))),
        }
    }
    groups.into_iter().map(|(_, group)| group).collect()
}

fn object_center(object: &Object) -> Option<DVec3> {
    Some(match &object.shape {
        Shape::Quad { corner, edge_u, edge_v } => *corner + 0.5 * (*edge_u + *edge_v),
        Shape::Sphere { center, .. } => *center,
        Shape::Plane { point, .. } => *point,
        Shape::Bezier(_) | Shape::Revolution(_) => {
            let bezier = object.shape.surface()?;
            let count = 16 * bezier.patches.len();
            let sum: DVec3 = control_points(bezier).map(|(_, at)| at).sum();
            return (count > 0).then(|| bezier.transform.world_from_object().transform_point3(sum / count as f64));
        }
    })
}

fn light_center(emitter: &Emitter) -> DVec3 {
    match emitter {
        Emitter::Point { position, .. } => *position,
        Emitter::Sphere { center, .. } => *center,
        Emitter::Quad { corner, edge_u, edge_v, .. } => *corner + 0.5 * (*edge_u + *edge_v),
        // The rays of a sun have a direction alone: the handle is where they would come from on their way to the origin.
        Emitter::Sun { direction, .. } => -*direction,
        Emitter::Beam { center, .. } => *center,
    }
}

fn translate_point(bezier: &mut Bezier, point: PointIndex, by: DVec3) {
    let object_from_world = bezier.transform.world_from_object().inverse();
    let by = object_from_world.transform_vector3(by);
    if by.is_finite() {
        set_point(bezier, point, |position| *position += by);
    }
}

/// Moves a point of the profile within the profile's plane, z = 0 in object space; not beyond the axis.
fn translate_profile_point(revolution: &mut Revolution, point: PointIndex, by: DVec3) {
    let by = revolution.transform().world_from_object().inverse().transform_vector3(by);
    let mut profile = revolution.profile().to_vec();
    if let Some(moved) = point.in_profile().and_then(|index| profile.get_mut(index))
        && by.is_finite()
    {
        *moved = (*moved + by.truncate()).max(DVec2::new(0.0, f64::NEG_INFINITY));
        *revolution = revolution.with_profile(profile);
    }
}

fn set_point(bezier: &mut Bezier, point: PointIndex, change: impl FnOnce(&mut DVec3)) {
    let net = Arc::make_mut(&mut bezier.patches).get_mut(point.patch);
    if let Some(position) = net.and_then(|net| net.points.get_mut(point.i)?.get_mut(point.j)) {
        change(position);
        // The patches now differ from the `.bpt` file.
        bezier.file = None;
    }
}

/// Moves a shape by a vector in world space.
pub(super) fn translate_shape(shape: &mut Shape, by: DVec3) {
    match shape {
        Shape::Quad { corner: position, .. }
        | Shape::Sphere { center: position, .. }
        | Shape::Plane { point: position, .. } => *position += by,
        Shape::Bezier(bezier) => bezier.transform.translate += by,
        Shape::Revolution(revolution) => revolution.transform_mut().translate += by,
    }
}

/// Moves a light by a vector in world space; turns a sun.
pub(super) fn translate_emitter(emitter: &mut Emitter, by: DVec3) {
    match emitter {
        Emitter::Point { position, .. }
        | Emitter::Sphere { center: position, .. }
        | Emitter::Quad { corner: position, .. }
        | Emitter::Beam { center: position, .. } => *position += by,
        Emitter::Sun { direction, .. } => *direction -= by,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::bezier::ControlNet;
    use crate::scene::Transform;

    // World and object space differ by a few roundings of numbers of size 1 to 10.
    const TOLERANCE: f64 = 1e-13;

    fn net(x: f64) -> ControlNet {
        ControlNet { points: std::array::from_fn(|i| std::array::from_fn(|j| DVec3::new(x + i as f64, 0.0, j as f64))) }
    }

    fn scene() -> Scene {
        let transform = Transform {
            translate: DVec3::new(1.0, 2.0, 3.0),
            rotate: DVec3::new(10.0, 20.0, 30.0),
            scale: DVec3::new(1.0, 2.0, 0.5),
        };
        let bezier =
            Bezier { transform, patches: Arc::new(vec![net(0.0), net(3.0)]), file: Some("a.bpt".into()), uv: None };
        let shape = Shape::Bezier(bezier);
        Scene {
            objects: vec![Object { name: "sheet".into(), material: String::new(), shape, body: None }],
            lights: vec![],
            ..Scene::default()
        }
    }

    fn surface(scene: &Scene) -> &Bezier {
        scene.objects[0].shape.surface().unwrap()
    }

    #[test]
    fn a_point_moves_by_the_world_vector_through_the_transform() {
        let mut scene = scene();
        let handle = Handle::Point { object: 0, point: PointIndex { patch: 0, i: 1, j: 2 } };
        let (before, by) = (handle.position(&scene).unwrap(), DVec3::new(0.3, -0.2, 0.1));
        handle.translate(&mut scene, by);
        let after = handle.position(&scene).unwrap();
        assert!(after.distance(before + by) < TOLERANCE, "{after} is not {}", before + by);
        assert_eq!(surface(&scene).file, None, "the points now differ from the file");
    }

    #[test]
    fn a_moved_control_point_leaves_its_neighbours_in_place() {
        let mut scene = scene();
        let groups = weld_groups(surface(&scene));
        let others: Vec<_> = visible(&scene, Item::Object(0), &groups)
            .into_iter()
            .filter(|(handle, _)| matches!(handle, Handle::Point { point, .. } if *point != PointIndex::default()))
            .map(|(handle, at)| (handle, Some(at)))
            .collect();
        Handle::Point { object: 0, point: PointIndex::default() }.translate(&mut scene, DVec3::ONE);
        for (handle, before) in others {
            assert_eq!(handle.position(&scene), before, "{handle:?}");
        }
    }

    #[test]
    fn an_object_and_its_points_move_together() {
        let mut scene = scene();
        let point = Handle::Point { object: 0, point: PointIndex::default() };
        let (before, center) = (point.position(&scene).unwrap(), Handle::Object(0).position(&scene).unwrap());
        Handle::Object(0).translate(&mut scene, DVec3::ONE);
        assert!(point.position(&scene).unwrap().distance(before + DVec3::ONE) < TOLERANCE, "the point follows");
        let moved = Handle::Object(0).position(&scene).unwrap();
        assert!(moved.distance(center + DVec3::ONE) < TOLERANCE, "the centre follows");
    }

    #[test]
    fn points_within_the_tolerance_are_one_group() {
        let mut scene = scene();
        let Shape::Bezier(bezier) = &mut scene.objects[0].shape else { panic!("patches") };
        let patches = Arc::make_mut(&mut bezier.patches);
        // The tolerance is at least 1e-9, because coordinates reach 1.
        patches[0].points[0][0] = DVec3::splat(-2e-10);
        patches[0].points[1][0] = DVec3::splat(2e-10);
        let groups = weld_groups(bezier);
        let of = |i: usize| groups.iter().position(|group| group.contains(&PointIndex { patch: 0, i, j: 0 }));
        assert_eq!(of(0), of(1));
    }

    #[test]
    fn a_sheet_of_many_patches_has_one_group_a_position() {
        let mut scene = scene();
        let Shape::Bezier(bezier) = &mut scene.objects[0].shape else { panic!("patches") };
        // Columns of points with one x each.
        let net = |k: usize| {
            let (column, row) = (3 * (k % 64), 3 * (k / 64));
            let at = |i: usize, j: usize| DVec3::new((column + i) as f64, 0.0, (row + j) as f64);
            ControlNet { points: std::array::from_fn(|i| std::array::from_fn(|j| at(i, j))) }
        };
        bezier.patches = Arc::new((0..64 * 64).map(net).collect());
        assert_eq!(weld_groups(bezier).len(), 193 * 193);
    }

    #[test]
    fn the_seam_of_two_patches_is_one_row_of_handles() {
        let scene = scene();
        let points = weld_groups(surface(&scene)).len();
        assert_eq!(points, 2 * 16 - 4, "the patches share four positions");
        let seam = PointIndex { patch: 0, i: 3, j: 1 };
        let expected = BTreeSet::from([seam, PointIndex { patch: 1, i: 0, j: 1 }]);
        assert!(weld_groups(surface(&scene)).contains(&expected));
    }

    #[test]
    fn a_flattened_object_keeps_its_points() {
        let mut scene = scene();
        if let Shape::Bezier(bezier) = &mut scene.objects[0].shape {
            bezier.transform.scale = DVec3::new(1.0, 0.0, 1.0);
        }
        let before = scene.clone();
        Handle::Point { object: 0, point: PointIndex::default() }.translate(&mut scene, DVec3::ONE);
        assert_eq!(scene, before);
    }
}
