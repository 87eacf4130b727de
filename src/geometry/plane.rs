use crate::math::Ray;
use glam::DVec3;

/// An unbounded plane with coordinates in scene units along two axes in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    point: DVec3,
    normal: DVec3,
    u_axis: DVec3,
    v_axis: DVec3,
}

impl Plane {
    /// The plane through `point`. `u_axis` is laid into the plane; without one it is the x axis, or z where the
    /// normal is along x. A zero normal makes a plane that meets no ray.
    pub fn new(point: DVec3, normal: DVec3, u_axis: Option<DVec3>) -> Self {
        let normal = normal.try_normalize().unwrap_or(DVec3::ZERO);
        let laid = |axis: DVec3| {
            let in_plane = axis - normal * normal.dot(axis);
            (in_plane.length_squared() > 1e-12 * axis.length_squared()).then(|| in_plane.normalize_or_zero())
        };
        let u_axis = u_axis.and_then(laid).or_else(|| laid(DVec3::X)).unwrap_or(DVec3::Z);
        Self { point, normal, u_axis, v_axis: normal.cross(u_axis) }
    }

    /// The hit as (t, u, v).
    #[inline(always)]
    pub fn intersect(&self, ray: &Ray) -> Option<(f64, f64, f64)> {
        let t = self.normal.dot(self.point - ray.origin) / self.normal.dot(ray.direction);
        if !(t > ray.t_min && t < ray.t_max) {
            return None;
        }
        let p = ray.at(t) - self.point;
        Some((t, p.dot(self.u_axis), p.dot(self.v_axis)))
    }

    /// How far a point is from the plane.
    pub fn distance(&self, point: DVec3) -> f64 {
        (point - self.point).dot(self.normal).abs()
    }

    /// The point at (u, v).
    pub fn position(&self, u: f64, v: f64) -> DVec3 {
        self.point + u * self.u_axis + v * self.v_axis
    }

    /// Unit length; zero if none was given.
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// Unit vectors along u and v.
    pub fn axes(&self) -> (DVec3, DVec3) {
        (self.u_axis, self.v_axis)
    }
}
