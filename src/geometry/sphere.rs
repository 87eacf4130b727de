use crate::math::{Aabb, Ray};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// A sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Scene units.
    pub center: DVec3,
    /// Scene units.
    pub radius: f64,
}

impl Sphere {
    /// t of the nearest hit; `None` for a miss. The discriminant comes from the offset of the center across the ray, which
    /// stays accurate for distant and for huge spheres \[Haines19\].
    #[inline(always)]
    pub fn intersect(&self, ray: &Ray) -> Option<f64> {
        let f = ray.origin - self.center;
        let a = ray.direction.length_squared();
        let b = -f.dot(ray.direction);
        let across = f + (b / a) * ray.direction;
        let discriminant = self.radius * self.radius - across.length_squared();
        if discriminant < 0.0 || discriminant.is_nan() {
            return None;
        }
        let c = f.length_squared() - self.radius * self.radius;
        let q = b + (a * discriminant).sqrt().copysign(b);
        let (t0, t1) = (c / q, q / a);
        let (near, far) = if t0 < t1 { (t0, t1) } else { (t1, t0) };
        let counts = |t: f64| t > ray.t_min && t < ray.t_max;
        if counts(near) { Some(near) } else { counts(far).then_some(far) }
    }

    /// The distance of a point to the surface.
    pub fn distance(&self, p: DVec3) -> f64 {
        (p.distance(self.center) - self.radius).abs()
    }

    /// The outward unit normal at a point.
    pub fn normal(&self, p: DVec3) -> DVec3 {
        (p - self.center).normalize_or(DVec3::Y)
    }

    /// (u, v) of an outward normal: `u = 1/2 + atan2(x, z) / 2 pi`, `v = 1/2 + asin(y) / pi`.
    pub fn uv(normal: DVec3) -> DVec2 {
        DVec2::new(0.5 + normal.x.atan2(normal.z) / TAU, 0.5 + normal.y.clamp(-1.0, 1.0).asin() / PI)
    }

    /// The derivatives of the position by u and by v where the outward normal is `n`. The derivative by u is zero at a pole.
    pub fn derivatives(&self, n: DVec3) -> (DVec3, DVec3) {
        let cos = (n.x * n.x + n.z * n.z).sqrt();
        let (sin_u, cos_u) = if cos > 0.0 { (n.x / cos, n.z / cos) } else { (0.0, 1.0) };
        let dpdu = TAU * self.radius * DVec3::new(n.z, 0.0, -n.x);
        let dpdv = PI * self.radius * DVec3::new(-n.y * sin_u, cos, -n.y * cos_u);
        (dpdu, dpdv)
    }

    /// The box of the sphere.
    pub fn bounds(&self) -> Aabb {
        Aabb { min: self.center - self.radius, max: self.center + self.radius }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn far_tiny_and_huge_spheres_are_hit_accurately() {
        for (radius, distance) in [(1.0, 3.0), (1e-4, 1e3), (1e5, 1e5 + 1.0), (1.0, 1e7)] {
            let sphere = Sphere { center: DVec3::ZERO, radius };
            let ray = Ray::new(DVec3::new(0.0, 0.3 * radius, distance), DVec3::new(0.0, 0.0, -2.0));
            let z = radius * (1.0f64 - 0.09).sqrt();
            let t = sphere.intersect(&ray).expect("aimed at the sphere");
            // Rounding of the distance itself is 2^-53 of it; the square root of the radius adds as much of that.
            assert!((distance - 2.0 * t - z).abs() < 1e-15 * (4.0 * distance + 4.0 * radius), "radius {radius}");
        }
    }

    #[test]
    fn derivatives_match_differences() {
        let sphere = Sphere { center: DVec3::ONE, radius: 2.0 };
        let n = DVec3::new(0.3, -0.5, 0.8).normalize();
        let at = |uv: DVec2| {
            let (phi, theta) = (TAU * (uv.x - 0.5), PI * (uv.y - 0.5));
            sphere.center + sphere.radius * DVec3::new(theta.cos() * phi.sin(), theta.sin(), theta.cos() * phi.cos())
        };
        let (uv, h) = (Sphere::uv(n), 1e-6);
        assert!(at(uv).distance(sphere.center + 2.0 * n) < 1e-12, "(u, v) of the normal");
        let (dpdu, dpdv) = sphere.derivatives(n);
        // A central difference with step h errs by h^2/6 of the third derivative (about 250) and 1e-16/h.
        let difference = |step: DVec2| (at(uv + step) - at(uv - step)) / (2.0 * h);
        assert!(difference(DVec2::new(h, 0.0)).distance(dpdu) < 1e-8);
        assert!(difference(DVec2::new(0.0, h)).distance(dpdv) < 1e-8);
        assert!(dpdu.cross(dpdv).dot(n) > 0.0, "the parametrisation turns outwards");
    }
}
