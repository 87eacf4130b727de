//! The points of a scene that can be dragged on the picture: which there are, where they lie, and how they move. Knows no widget.

use super::selection::{Item, PointIndex};
use crate::scene::{Bezier, Emitter, Object, Scene, Shape};
use glam::DVec3;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Control points nearer to each other than this part of their object's size are one point to the user.
const WELD_TOLERANCE: f64 = 1e-9;

/// A point of the scene that can be dragged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Handle {
    /// A control point of a Bezier object.
    Point {
        /// Its place in the list of objects.
        object: usize,
        /// Which point.
        point: PointIndex,
    },
    /// A whole object, by its middle.
    Object(usize),
    /// A light, by its middle.
    Light(usize),
}

impl Handle {
    /// What a click on it selects.
    pub(crate) fn item(self) -> Item {
        match self {
            Self::Point { object, .. } | Self::Object(object) => Item::Object(object),
            Self::Light(light) => Item::Light(light),
        }
    }

    /// What it is called, for the tooltip and for assistive technology.
    pub(crate) fn label(self, scene: &Scene) -> String {
        match self {
            Self::Point { object, point } => {
                let several = bezier(scene, object).is_some_and(|bezier| bezier.patches.len() > 1);
                let patch = if several { format!("patch {}, ", point.patch) } else { String::new() };
                format!("Control point {patch}P[{}][{}]", point.i, point.j)
            }
            Self::Object(object) => format!("Object {}", scene.objects.get(object).map_or("", |found| &found.name)),
            Self::Light(light) => format!("Light {}", scene.lights.get(light).map_or("", |found| &found.name)),
        }
    }

    /// Where it lies in the world.
    pub(crate) fn position(self, scene: &Scene) -> Option<DVec3> {
        match self {
            Self::Point { object, point } => {
                let bezier = bezier(scene, object)?;
                let local = bezier.patches.get(point.patch)?.points.get(point.i)?.get(point.j)?;
                Some(bezier.transform.world_from_object().transform_point3(*local))
            }
            Self::Object(object) => scene.objects.get(object).and_then(object_middle),
            Self::Light(light) => scene.lights.get(light).map(|light| light_middle(&light.emitter)),
        }
    }

    /// Moves it by a world vector. A point of an object that is scaled to nothing along some axis stays.
    pub(crate) fn translate(self, scene: &mut Scene, by: DVec3) {
        match self {
            Self::Point { object, point } => {
                if let Some(Object { shape: Shape::Bezier(bezier), .. }) = scene.objects.get_mut(object) {
                    translate_point(bezier, point, by);
                }
            }
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

/// The handles to draw: every light, the selected object, and its control points, of which those at one place count once.
pub(crate) fn visible(scene: &Scene, selected: Item) -> Vec<Handle> {
    let mut handles: Vec<Handle> = (0..scene.lights.len()).map(Handle::Light).collect();
    if let Item::Object(object) = selected {
        if object < scene.objects.len() {
            handles.push(Handle::Object(object));
        }
        if let Some(bezier) = bezier(scene, object) {
            let distinct = weld_groups(bezier).into_iter().filter_map(|group| group.into_iter().next());
            handles.extend(distinct.map(|point| Handle::Point { object, point }));
        }
    }
    handles
}

/// The control points that lie where `point` lies, itself among them: dragged together they keep a surface of several patches closed.
pub(crate) fn welded(bezier: &Bezier, point: PointIndex) -> BTreeSet<PointIndex> {
    let group = weld_groups(bezier).into_iter().find(|group| group.contains(&point));
    group.unwrap_or_else(|| BTreeSet::from([point]))
}

/// The index of every control point with its place before the transform.
pub(crate) fn control_points(bezier: &Bezier) -> impl Iterator<Item = (PointIndex, DVec3)> + '_ {
    bezier.patches.iter().enumerate().flat_map(|(patch, net)| {
        (0..16).map(move |k| (PointIndex { patch, i: k / 4, j: k % 4 }, net.points[k / 4][k % 4]))
    })
}

/// The control points in groups of one place, each place once.
fn weld_groups(bezier: &Bezier) -> Vec<BTreeSet<PointIndex>> {
    let size = control_points(bezier).map(|(_, at)| at.abs().max_element()).fold(0.0, f64::max);
    let tolerance = WELD_TOLERANCE * size;
    let mut sorted: Vec<_> = control_points(bezier).collect();
    sorted.sort_by(|(_, a), (_, b)| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z)));
    let mut groups: Vec<(DVec3, BTreeSet<PointIndex>)> = Vec::new();
    for (index, at) in sorted {
        // Sorted by x, so only the last groups can lie as near.
        let near = groups.iter_mut().rev().take_while(|(place, _)| at.x - place.x <= tolerance);
        match near.into_iter().find(|(place, _)| place.distance(at) <= tolerance) {
            Some((_, group)) => drop(group.insert(index)),
            None => groups.push((at, BTreeSet::from([index]))),
        }
    }
    groups.into_iter().map(|(_, group)| group).collect()
}

fn bezier(scene: &Scene, object: usize) -> Option<&Bezier> {
    match &scene.objects.get(object)?.shape {
        Shape::Bezier(bezier) => Some(bezier),
        _ => None,
    }
}

fn object_middle(object: &Object) -> Option<DVec3> {
    Some(match &object.shape {
        Shape::Quad { corner, edge_u, edge_v } => *corner + 0.5 * (*edge_u + *edge_v),
        Shape::Sphere { center, .. } => *center,
        Shape::Plane { point, .. } => *point,
        Shape::Bezier(bezier) => {
            let count = 16 * bezier.patches.len();
            let sum: DVec3 = control_points(bezier).map(|(_, at)| at).sum();
            return (count > 0).then(|| bezier.transform.world_from_object().transform_point3(sum / count as f64));
        }
    })
}

fn light_middle(emitter: &Emitter) -> DVec3 {
    match emitter {
        Emitter::Point { position, .. } => *position,
        Emitter::Sphere { center, .. } => *center,
        Emitter::Quad { corner, edge_u, edge_v, .. } => *corner + 0.5 * (*edge_u + *edge_v),
    }
}

fn translate_point(bezier: &mut Bezier, point: PointIndex, by: DVec3) {
    let object_from_world = bezier.transform.world_from_object().inverse();
    let by = object_from_world.transform_vector3(by);
    let net = Arc::make_mut(&mut bezier.patches).get_mut(point.patch);
    let place = net.and_then(|net| net.points.get_mut(point.i)?.get_mut(point.j));
    if let Some(place) = place.filter(|_| by.is_finite()) {
        *place += by;
        // The patches are no longer what the file holds.
        bezier.file = None;
    }
}

fn translate_shape(shape: &mut Shape, by: DVec3) {
    match shape {
        Shape::Quad { corner: place, .. } | Shape::Sphere { center: place, .. } | Shape::Plane { point: place, .. } => {
            *place += by;
        }
        Shape::Bezier(bezier) => bezier.transform.translate += by,
    }
}

fn translate_emitter(emitter: &mut Emitter, by: DVec3) {
    match emitter {
        Emitter::Point { position: place, .. }
        | Emitter::Sphere { center: place, .. }
        | Emitter::Quad { corner: place, .. } => *place += by,
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
        let bezier = Bezier { transform, patches: Arc::new(vec![net(0.0), net(3.0)]), file: Some("a.bpt".into()) };
        let shape = Shape::Bezier(bezier);
        Scene {
            objects: vec![Object { name: "sheet".into(), material: String::new(), shape }],
            lights: vec![],
            ..Scene::default()
        }
    }

    #[test]
    fn a_point_moves_by_the_world_vector_through_the_transform() {
        let mut scene = scene();
        let handle = Handle::Point { object: 0, point: PointIndex { patch: 0, i: 1, j: 2 } };
        let (before, by) = (handle.position(&scene).unwrap(), DVec3::new(0.3, -0.2, 0.1));
        handle.translate(&mut scene, by);
        let after = handle.position(&scene).unwrap();
        assert!(after.distance(before + by) < TOLERANCE, "{after} is not {}", before + by);
        assert_eq!(bezier(&scene, 0).unwrap().file, None, "the file holds other points now");
    }

    #[test]
    fn only_the_handle_moves() {
        let mut scene = scene();
        let others: Vec<_> = visible(&scene, Item::Object(0))
            .into_iter()
            .filter(|handle| matches!(handle, Handle::Point { point, .. } if *point != PointIndex::default()))
            .map(|handle| (handle, handle.position(&scene)))
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
        let (before, middle) = (point.position(&scene).unwrap(), Handle::Object(0).position(&scene).unwrap());
        Handle::Object(0).translate(&mut scene, DVec3::ONE);
        assert!(point.position(&scene).unwrap().distance(before + DVec3::ONE) < TOLERANCE, "the point follows");
        let moved = Handle::Object(0).position(&scene).unwrap();
        assert!(moved.distance(middle + DVec3::ONE) < TOLERANCE, "the middle follows");
    }

    #[test]
    fn the_seam_of_two_patches_is_one_row_of_handles() {
        let scene = scene();
        let points = visible(&scene, Item::Object(0)).len() - 1;
        assert_eq!(points, 2 * 16 - 4, "four places are shared");
        let seam = PointIndex { patch: 0, i: 3, j: 1 };
        let expected = BTreeSet::from([seam, PointIndex { patch: 1, i: 0, j: 1 }]);
        assert_eq!(welded(bezier(&scene, 0).unwrap(), seam), expected);
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
