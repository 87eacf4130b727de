use crate::geometry::Primitive;
use crate::transport::points::{Clearance, Vertex};
use crate::world::{Surface, World};

/// Distances from a vertex to other objects, up to these limits.
pub(super) fn clearance(world: &World, vertex: &Vertex, limits: Clearance) -> Clearance {
    let primitives = world.aggregate.primitives();
    let primitive = &primitives[vertex.point.hit.primitive as usize];
    if matches!(primitive, Primitive::Patch(_)) {
        return Clearance { any: 0.0, standing: f64::INFINITY };
    }
    let is_own =
        |p: u32| matches!(world.surfaces[p as usize], Surface::Object { object, .. } if object == vertex.object);
    let position = vertex.point.position;
    let any = world.aggregate.distance(position, limits.any, |p| !is_own(p));
    let stands = |p: u32| match primitive {
        Primitive::Quad(quad) => !is_own(p) && !primitives[p as usize].is_beside(quad),
        Primitive::Plane(_) => !is_own(p),
        Primitive::Sphere(_) | Primitive::Patch(_) => false,
    };
    let standing = (any < limits.standing)
        .then(|| world.aggregate.distance(position, limits.standing, stands))
        .filter(|standing| *standing < limits.standing);
    Clearance { any, standing: standing.unwrap_or(f64::INFINITY) }
}
