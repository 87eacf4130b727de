//! The surfaces of all objects, prepared for rays and kept from frame to frame. Knows no widget.

use crate::geometry::bezier::Patch;
use crate::geometry::{Aggregate, Plane, Primitive, Quad, Sphere};
use crate::math::Ray;
use crate::scene::{Bezier, SceneFile, Shape};
use std::sync::Arc;

/// The surfaces of a scene's objects. An update prepares only the surfaces that changed.
#[derive(Debug, Default)]
pub(crate) struct Surfaces {
    /// The scene of the last update.
    file: Option<Arc<SceneFile>>,
    objects: Vec<Prepared>,
    /// The object and the patch of each primitive of the aggregate.
    owners: Vec<(usize, usize)>,
    aggregate: Aggregate,
    revision: u64,
}

/// An object's shape with its primitives, each with the index of its patch; 0 for other shapes.
#[derive(Debug)]
struct Prepared {
    shape: Shape,
    primitives: Vec<(usize, Primitive)>,
}

/// The nearest surface along a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pick {
    /// The object's index.
    pub(crate) object: usize,
    /// The patch of a Bezier object; 0 for other shapes.
    pub(crate) patch: usize,
    /// Distance along a ray of unit direction, scene units.
    pub(crate) distance: f64,
}

impl Surfaces {
    /// Prepares the surfaces that changed since the last update.
    pub(crate) fn update(&mut self, file: &Arc<SceneFile>) {
        if self.file.as_ref().is_some_and(|kept| Arc::ptr_eq(kept, file)) {
            return;
        }
        self.file = Some(Arc::clone(file));
        let mut before = std::mem::take(&mut self.objects).into_iter();
        let mut changed = false;
        for object in &file.scene.objects {
            let kept = before.next();
            let same = kept.as_ref().is_some_and(|kept| kept.shape == object.shape);
            changed |= !same;
            self.objects.extend(if same { kept } else { Some(Prepared::new(&object.shape, kept.as_ref())) });
        }
        if changed || before.next().is_some() {
            self.revision += 1;
            self.rebuild();
        }
    }

    fn rebuild(&mut self) {
        let all = self.objects.iter().enumerate();
        let owned = all.flat_map(|(object, kept)| kept.primitives.iter().map(move |(patch, p)| ((object, *patch), p)));
        let (owners, primitives): (Vec<_>, Vec<_>) = owned.map(|(owner, primitive)| (owner, primitive.clone())).unzip();
        self.owners = owners;
        self.aggregate = Aggregate::new(primitives);
    }

    /// A number that differs after each change of a surface.
    pub(crate) fn revision(&self) -> u64 {
        self.revision
    }

    /// The nearest surface that the ray meets; `None` where it meets no object.
    pub(crate) fn nearest(&self, ray: &Ray) -> Option<Pick> {
        let hit = self.aggregate.closest_hit(ray)?;
        let (object, patch) = *self.owners.get(hit.primitive as usize)?;
        Some(Pick { object, patch, distance: hit.t })
    }

    /// Whether the ray meets an object other than `except`.
    pub(crate) fn occlude(&self, ray: &Ray, except: Option<usize>) -> bool {
        match except {
            None => self.aggregate.occluded(ray),
            Some(except) => {
                let others = self.objects.iter().enumerate().filter(|(object, _)| *object != except);
                others.flat_map(|(_, object)| &object.primitives).any(|(_, other)| other.intersect(ray).is_some())
            }
        }
    }
}

impl Prepared {
    /// The primitives of a shape, with the patches of `before` that it keeps. A shape that cannot be rendered has none.
    fn new(shape: &Shape, before: Option<&Self>) -> Self {
        let primitives = match shape.surface() {
            Some(surface) => patches(surface, before.map_or(&[], |before| &before.primitives)),
            None => simple_primitive(shape).map(|primitive| (0, primitive)).into_iter().collect(),
        };
        Self { shape: shape.clone(), primitives }
    }
}

/// The primitive of a shape without patches; `None` for patches, and for a shape that cannot be rendered.
pub(super) fn simple_primitive(shape: &Shape) -> Option<Primitive> {
    match shape {
        Shape::Quad { corner, edge_u, edge_v } => Some(Primitive::Quad(Quad::new(*corner, *edge_u, *edge_v))),
        Shape::Sphere { center, radius } if *radius > 0.0 => {
            Some(Primitive::Sphere(Sphere { center: *center, radius: *radius }))
        }
        Shape::Plane { point, normal, u_axis } => Some(Primitive::Plane(Plane::new(*point, *normal, *u_axis))),
        Shape::Sphere { .. } | Shape::Bezier(_) | Shape::Revolution(_) => None,
    }
}

fn patches(bezier: &Bezier, before: &[(usize, Primitive)]) -> Vec<(usize, Primitive)> {
    let nets = bezier.placed_nets().into_iter().enumerate().filter(|(_, net)| net.is_finite());
    let prepared = nets.map(|(index, net)| {
        let kept = before.get(index).and_then(|(_, primitive)| match primitive {
            Primitive::Patch(patch) if *patch.net() == net => Some(Arc::clone(patch)),
            _ => None,
        });
        (index, Primitive::Patch(kept.unwrap_or_else(|| Arc::new(Patch::new(net)))))
    });
    prepared.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::bezier::ControlNet;
    use crate::scene::{Location, Object, Scene, Transform};
    use glam::DVec3;
    use std::array;

    // Distances of size 10 in a few operations.
    const TOLERANCE: f64 = 1e-13;

    fn file(shapes: Vec<Shape>) -> Arc<SceneFile> {
        let object = |shape| Object { name: String::new(), material: String::new(), shape, body: None };
        let scene = Scene { objects: shapes.into_iter().map(object).collect(), ..Scene::default() };
        Arc::new(SceneFile { scene, location: Location::Unsaved })
    }

    fn surfaces(shapes: Vec<Shape>) -> Surfaces {
        let mut surfaces = Surfaces::default();
        surfaces.update(&file(shapes));
        surfaces
    }

    fn ray(x: f64, y: f64) -> Ray {
        Ray::new(DVec3::new(x, y, 10.0), DVec3::NEG_Z)
    }

    fn flat_sheet() -> Shape {
        let points = array::from_fn(|i| array::from_fn(|j| DVec3::new(i as f64 / 3.0, j as f64 / 3.0, 0.0)));
        let transform = Transform { translate: DVec3::new(0.0, 0.0, 2.0), ..Transform::default() };
        let beside = ControlNet { points }.map(|point| point + 2.0 * DVec3::X);
        Shape::Bezier(Bezier {
            transform,
            patches: Arc::new(vec![ControlNet { points }, beside]),
            file: None,
            uv: None,
        })
    }

    fn ball(z: f64) -> Shape {
        Shape::Sphere { center: DVec3::new(0.0, 0.0, z), radius: 1.0 }
    }

    #[test]
    fn distances_of_simple_shapes() {
        let quad = Shape::Quad { corner: DVec3::ZERO, edge_u: DVec3::X, edge_v: DVec3::new(0.5, 1.0, 0.0) };
        let ball = Shape::Sphere { center: DVec3::ZERO, radius: 2.0 };
        let ground = Shape::Plane { point: DVec3::NEG_Z, normal: DVec3::Z, u_axis: None };
        let cases = [(quad, 10.0), (ball, 10.0 - 3.75_f64.sqrt()), (ground, 11.0), (flat_sheet(), 8.0)];
        for (shape, expected) in cases {
            let found = surfaces(vec![shape.clone()]).nearest(&ray(0.5, 0.0)).unwrap().distance;
            assert!((found - expected).abs() < TOLERANCE, "{found} for {shape:?}");
        }
    }

    #[test]
    fn a_ray_beside_or_beyond_a_shape_misses_it() {
        let quad = Shape::Quad { corner: DVec3::ZERO, edge_u: DVec3::X, edge_v: DVec3::Y };
        for shape in [quad, ball(0.0), flat_sheet(), ball(20.0)] {
            assert_eq!(surfaces(vec![shape.clone()]).nearest(&ray(1.5, 0.5)), None, "{shape:?}");
        }
        assert_eq!(surfaces(vec![ball(20.0)]).nearest(&ray(0.0, 0.0)), None, "behind the ray");
    }

    #[test]
    fn the_nearest_object_and_its_patch_are_picked() {
        let surfaces = surfaces(vec![ball(0.0), ball(5.0), flat_sheet()]);
        let found = |x| surfaces.nearest(&ray(x, 0.1)).map(|pick| (pick.object, pick.patch));
        assert_eq!([found(0.1), found(2.1), found(4.0)], [Some((1, 0)), Some((2, 1)), None]);
    }

    #[test]
    fn an_object_without_size_is_never_picked() {
        let sphere = Shape::Sphere { center: DVec3::ZERO, radius: 0.0 };
        let quad = Shape::Quad { corner: DVec3::ZERO, edge_u: DVec3::ZERO, edge_v: DVec3::Y };
        let plane = Shape::Plane { point: DVec3::ZERO, normal: DVec3::ZERO, u_axis: None };
        assert_eq!(surfaces(vec![sphere, quad, plane]).nearest(&ray(0.0, 0.0)), None);
    }

    #[test]
    fn an_update_prepares_only_what_changed() {
        let mut surfaces = surfaces(vec![flat_sheet(), ball(0.0)]);
        let patch = |surfaces: &Surfaces, index: usize| match &surfaces.objects[0].primitives[index].1 {
            Primitive::Patch(patch) => Arc::clone(patch),
            other => panic!("{other:?} is no patch"),
        };
        let (before, revision) = ([0, 1].map(|index| patch(&surfaces, index)), surfaces.revision());
        surfaces.update(&file(vec![flat_sheet(), ball(0.0)]));
        assert_eq!(surfaces.revision(), revision, "equal surfaces are kept");
        let mut moved = flat_sheet();
        if let Shape::Bezier(bezier) = &mut moved {
            Arc::make_mut(&mut bezier.patches)[1].points[1][1].z += 0.1;
        }
        surfaces.update(&file(vec![moved, ball(0.0)]));
        assert_ne!(surfaces.revision(), revision);
        assert!(Arc::ptr_eq(&patch(&surfaces, 0), &before[0]), "the other patch is kept");
        assert!(!Arc::ptr_eq(&patch(&surfaces, 1), &before[1]), "the changed patch is new");
    }
}
