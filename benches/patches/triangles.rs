use glam::DVec3;
use multiversion::multiversion;
use patchlight::geometry::Bvh;
use patchlight::geometry::bezier::QuadMesh;
use patchlight::math::{Aabb, Ray};

/// Triangles in the BVH that the renderer uses for patches.
pub(crate) struct Triangles {
    corners: Vec<[DVec3; 3]>,
    bvh: Bvh,
}

impl Triangles {
    pub(crate) fn new(mesh: &QuadMesh) -> Self {
        let corner = |k: usize| mesh.positions[k];
        let halves =
            mesh.faces.iter().flat_map(|face| (2..face.len()).map(|k| [face[0], face[k - 1], face[k]].map(corner)));
        let corners: Vec<_> = halves.collect();
        let boxes: Vec<Aabb> = corners.iter().map(|triangle| Aabb::around(*triangle)).collect();
        Self { bvh: Bvh::build(&boxes), corners }
    }
}

/// The nearest hit, compiled for the instruction sets of the patch intersector.
#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
pub(crate) fn closest_hit(mesh: &Triangles, ray: &Ray) -> Option<f64> {
    let mut closest = None;
    mesh.bvh.traverse(&mut ray.clone(), |k, ray| {
        if let Some(t) = intersect(&mesh.corners[k as usize], ray) {
            ray.t_max = t;
            closest = Some(t);
        }
        true
    });
    closest
}

/// The ray-triangle test of Möller and Trumbore.
#[inline(always)]
fn intersect([a, b, c]: &[DVec3; 3], ray: &Ray) -> Option<f64> {
    let (ab, ac) = (*b - *a, *c - *a);
    let p = ray.direction.cross(ac);
    let inverse = 1.0 / ab.dot(p);
    let s = ray.origin - *a;
    let u = s.dot(p) * inverse;
    let q = s.cross(ab);
    let v = ray.direction.dot(q) * inverse;
    let t = ac.dot(q) * inverse;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && ray.t_min < t && t < ray.t_max).then_some(t)
}
