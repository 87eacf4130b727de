use super::ray::{Hit, NEAR, Ray};
use super::shape::{Net, Shape};
use super::tree::Tree;
use glam::DVec3;
use patchlight::scene::{Emitter, MaterialModel, Scene};

/// The surface of an object or of a lamp.
pub(super) struct Surface {
    pub(super) shape: Shape,
    pub(super) kind: Kind,
}

/// What a surface belongs to.
pub(super) enum Kind {
    /// An object, by the index of its material, and the index of the body that it bounds.
    Object { material: usize, body: Option<usize> },
    /// A lamp with this radiance.
    Lamp(DVec3),
}

/// All surfaces of a scene.
pub(super) struct Surfaces {
    pub(super) list: Vec<Surface>,
    tree: Tree,
    /// Planes, which have no box.
    unbounded: Vec<usize>,
}

impl Surfaces {
    /// The surfaces; `body` returns the index of the body of an object.
    pub(super) fn new(scene: &Scene, body: impl Fn(usize) -> Option<usize>) -> Self {
        let materials = scene.materials_by_name();
        let mut list = Vec::new();
        for (index, object) in scene.objects.iter().enumerate() {
            let material = materials[object.material.as_str()];
            for shape in shapes(&object.shape) {
                list.push(Surface { shape, kind: Kind::Object { material, body: body(index) } });
            }
        }
        for light in &scene.lights {
            match light.emitter {
                Emitter::Sphere { center, radius, radiance } => {
                    list.push(Surface {
                        shape: Shape::Sphere { center, radius },
                        kind: Kind::Lamp(radiance.as_dvec3()),
                    });
                }
                Emitter::Quad { corner, edge_u, edge_v, radiance } => {
                    let shape = Shape::Quad { corner, edge_u, edge_v };
                    list.push(Surface { shape, kind: Kind::Lamp(radiance.as_dvec3()) });
                }
                Emitter::Point { .. } | Emitter::Sun { .. } | Emitter::Beam { .. } => {}
            }
        }
        let items = list.iter().enumerate();
        let bounded = items.filter_map(|(k, surface)| Some((k, surface.shape.bounds()?))).collect();
        let unbounded = (0..list.len()).filter(|&k| list[k].shape.bounds().is_none()).collect();
        Self { tree: Tree::new(bounded), unbounded, list }
    }

    /// The nearest hit beyond [`NEAR`], and all hits that are as near: together they are one interface. Empty where the ray leaves the
    /// scene.
    pub(super) fn interface(&self, ray: &Ray) -> Vec<Hit> {
        let mut hits: Vec<Hit> = Vec::new();
        let mut nearest = f64::INFINITY;
        let mut visit = |surface: usize, nearest: &mut f64| {
            self.list[surface].shape.intersect(ray, |distance, normal| {
                if distance > NEAR && distance < *nearest + NEAR {
                    *nearest = nearest.min(distance);
                    hits.push(Hit { distance, normal, surface });
                }
            });
        };
        self.unbounded.iter().for_each(|&surface| visit(surface, &mut nearest));
        self.tree.visit(ray, &mut nearest, &mut visit);
        hits.retain(|hit| hit.distance < nearest + NEAR);
        hits
    }

    /// The nearest hit with one body; `None` where the ray does not meet it.
    pub(super) fn nearest_of_body(&self, ray: &Ray, wanted: usize) -> Option<Hit> {
        let mut nearest: Option<Hit> = None;
        for (surface, Surface { shape, kind }) in self.list.iter().enumerate() {
            if matches!(kind, Kind::Object { body: Some(body), .. } if *body == wanted) {
                shape.intersect(ray, |distance, normal| {
                    if distance > 0.0 && nearest.is_none_or(|hit| distance < hit.distance) {
                        nearest = Some(Hit { distance, normal, surface });
                    }
                });
            }
        }
        nearest
    }
}

/// The simple shapes of an object.
pub(super) fn shapes(shape: &patchlight::scene::Shape) -> Vec<Shape> {
    use patchlight::scene::Shape as Described;
    match shape {
        Described::Sphere { center, radius } => vec![Shape::Sphere { center: *center, radius: *radius }],
        Described::Quad { corner, edge_u, edge_v } => {
            vec![Shape::Quad { corner: *corner, edge_u: *edge_u, edge_v: *edge_v }]
        }
        Described::Plane { point, normal, .. } => vec![Shape::Plane { point: *point, normal: normal.normalize() }],
        Described::Bezier(_) | Described::Revolution(_) => {
            let Some(bezier) = shape.surface() else { return Vec::new() };
            let to_world = bezier.transform.world_from_object();
            let is_mirrored = to_world.matrix3.determinant() < 0.0;
            let nets = bezier.patches.iter();
            let placed =
                nets.map(|net| -> Net { net.points.map(|row| row.map(|point| to_world.transform_point3(point))) });
            placed.flat_map(|net| Shape::cells(net, is_mirrored)).collect()
        }
    }
}

/// The index, relative to air, and the absorption of an object's glass; `None` for other materials.
pub(super) fn glass(scene: &Scene, object: usize) -> Option<(f64, DVec3, i32)> {
    let material = scene.materials_by_name()[scene.objects[object].material.as_str()];
    match scene.materials[material].model {
        MaterialModel::Glass { ior, absorption, priority, .. } => Some((ior, absorption.as_dvec3(), priority)),
        _ => None,
    }
}
