use crate::geometry::{Hit, Primitive};
use crate::math::{Ray, warp};
use glam::{DVec2, DVec3};

/// Crossings of one line with one surface that are found at most: a bicubic patch has 18.
const MAX_CROSSINGS: usize = 18;
/// The next crossing is sought this far behind the last one, relative to the distance: above the rounding of a hit.
const STEP: f64 = 1e-11;

/// The crossings of a ray with a primitive, in order: the distance along the ray, and whether it comes from the front.
pub(super) fn crossings(ray: &Ray, primitive: &Primitive) -> impl Iterator<Item = (f64, bool)> {
    let mut rest = *ray;
    std::iter::from_fn(move || {
        let (t, u, v) = primitive.intersect(&rest)?;
        rest.t_min = t + STEP * (t.abs() + ray.origin.abs().max_element() / ray.direction.length());
        let (_, normal) = primitive.surface(ray, &Hit { t, primitive: 0, u, v });
        Some((t, ray.direction.dot(normal) < 0.0))
    })
    .take(MAX_CROSSINGS)
}

/// The point of a primitive for a point of the unit square, and the unit normal there; `None` on a plane, which has no bounds.
pub(in crate::world) fn point_of(primitive: &Primitive, uv: DVec2) -> Option<(DVec3, DVec3)> {
    match primitive {
        Primitive::Quad(quad) => Some((quad.position(uv.x, uv.y), quad.normal())),
        Primitive::Sphere(sphere) => {
            let normal = warp::uniform_sphere(uv);
            Some((sphere.center + sphere.radius * normal, normal))
        }
        Primitive::Patch(patch) => Some((patch.net().eval(uv.x, uv.y), patch.normal(uv.x, uv.y))),
        Primitive::Plane(_) => None,
    }
}

/// The k-th point of a sequence that covers the unit square evenly: Kronecker's, with powers of the plastic number.
pub(in crate::world) fn spread(k: usize) -> DVec2 {
    const PLASTIC: f64 = 1.324_717_957_244_746;
    (0.5 + k as f64 * DVec2::new(1.0 / PLASTIC, 1.0 / (PLASTIC * PLASTIC))).fract()
}
