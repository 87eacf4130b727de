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
    /// The plane through `point`. u runs along `u_axis` projected into the plane; without it along the x axis, or along z if
    /// the normal is along x. No ray hits a plane with a zero normal.
    pub fn new(point: DVec3, normal: DVec3, u_axis: Option<DVec3>) -> Self {
        let normal = normal.try_normalize().unwrap_or(DVec3::ZERO);
        let projected = |axis: DVec3| {
            let in_plane = axis - normal * normal.dot(axis);
            (in_plane.length_squared() > 1e-12 * axis.length_squared()).then(|| in_plane.normalize_or_zero())
        };
        let u_axis = u_axis.and_then(projected).or_else(|| projected(DVec3::X)).unwrap_or(DVec3::Z);
        Self { point, normal, u_axis, v_axis: normal.cross(u_axis) }
    }

    /// The hit as (t, u, v), with u and v in scene units; `None` for a miss.
    #[inline(always)]
    pub fn intersect(&self, ray: &Ray) -> Option<(f64, f64, f64)> {
        let t = self.normal.dot(self.point - ray.origin) / self.normal.dot(ray.direction);
        if !(t > ray.t_min && t < ray.t_max) {
            return None;
        }
        let p = ray.at(t) - self.point;
        Some((t, p.dot(self.u_axis), p.dot(self.v_axis)))
    }

    /// The distance of a point to the plane.
    pub fn distance(&self, point: DVec3) -> f64 {
        (point - self.point).dot(self.normal).abs()
    }

    /// The point at (u, v).
    pub fn position(&self, u: f64, v: f64) -> DVec3 {
        self.point + u * self.u_axis + v * self.v_axis
    }

    /// The unit normal; zero for a plane given a zero normal.
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// Unit vectors along u and v.
    pub fn axes(&self) -> (DVec3, DVec3) {
        (self.u_axis, self.v_axis)
    }
}
