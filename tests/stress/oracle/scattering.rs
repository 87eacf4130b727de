use super::random::Random;
use glam::DVec3;
use std::f64::consts::TAU;

/// A unit vector about an axis with density proportional to `cos^exponent`.
pub(super) fn lobe(axis: DVec3, exponent: f64, random: &mut Random) -> DVec3 {
    let cos = (1.0 - random.next()).powf(1.0 / (exponent + 1.0));
    let (sin_turn, cos_turn) = (TAU * random.next()).sin_cos();
    let across = axis.any_orthonormal_vector();
    let ring = (1.0 - cos * cos).sqrt();
    (cos * axis + ring * (cos_turn * across + sin_turn * axis.cross(across))).normalize()
}

/// The mirror image of a ray's direction.
pub(super) fn reflect(direction: DVec3, normal: DVec3) -> DVec3 {
    (direction - 2.0 * direction.dot(normal) * normal).normalize()
}

/// The refracted direction of a ray that meets an interface with this normal, from an index of refraction to another one; and the reflected
/// fraction of unpolarised light. `None` at total reflection.
pub(super) fn refract(direction: DVec3, normal: DVec3, from: f64, to: f64) -> Option<(DVec3, f64)> {
    let normal = if direction.dot(normal) < 0.0 { normal } else { -normal };
    let cos = -direction.dot(normal);
    let along = (direction + cos * normal) * (from / to);
    let squared = 1.0 - along.length_squared();
    (squared > 0.0).then(|| ((along - squared.sqrt() * normal).normalize(), reflectance(cos, from, to)))
}

/// Fresnel's equations: the reflected fraction of unpolarised light that arrives at the angle with this cosine, from an index of refraction to
/// another one.
pub(crate) fn reflectance(cos: f64, from: f64, to: f64) -> f64 {
    // Rounding may bring a cosine above 1.
    let sin_behind = (1.0 - cos * cos).max(0.0).sqrt() * from / to;
    if sin_behind >= 1.0 {
        return 1.0;
    }
    let cos_behind = (1.0 - sin_behind * sin_behind).sqrt();
    let across = (from * cos - to * cos_behind) / (from * cos + to * cos_behind);
    let parallel = (from * cos_behind - to * cos) / (from * cos_behind + to * cos);
    0.5 * (across * across + parallel * parallel)
}
