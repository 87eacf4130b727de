use crate::math::{Aabb, Ray};
use glam::{DVec2, DVec3};

/// The distance outside of its edges up to which a quad is hit, in units of (u, v): above the rounding of a hit, so
/// that no ray slips between two quads that share an edge.
pub(super) const EDGE_TOLERANCE: f64 = 1e-12;

/// A parallelogram, prepared for intersection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quad {
    corner: DVec3,
    edge_u: DVec3,
    edge_v: DVec3,
    normal: DVec3,
    /// `(p - corner) . dual_u` is the coordinate u of a point in the plane.
    dual_u: DVec3,
    dual_v: DVec3,
}

impl Quad {
    /// The parallelogram `corner + u edge_u + v edge_v` for u and v from 0 to 1. No ray hits a quad without area.
    pub fn new(corner: DVec3, edge_u: DVec3, edge_v: DVec3) -> Self {
        let cross = edge_u.cross(edge_v);
        let normal = cross.try_normalize().unwrap_or(DVec3::ZERO);
        let inverse_area = 1.0 / cross.length_squared();
        let (dual_u, dual_v) = (edge_v.cross(cross) * inverse_area, cross.cross(edge_u) * inverse_area);
        let valid = normal != DVec3::ZERO && dual_u.is_finite() && dual_v.is_finite();
        Self { corner, edge_u, edge_v, normal: if valid { normal } else { DVec3::ZERO }, dual_u, dual_v }
    }

    /// The hit as (t, u, v); `None` for a miss.
    #[inline(always)]
    pub fn intersect(&self, ray: &Ray) -> Option<(f64, f64, f64)> {
        let t = self.normal.dot(self.corner - ray.origin) / self.normal.dot(ray.direction);
        // The comparisons are false for NaN, from a ray in the plane or a quad without area.
        if !(t > ray.t_min && t < ray.t_max) {
            return None;
        }
        let p = ray.at(t) - self.corner;
        let (u, v) = (p.dot(self.dual_u), p.dot(self.dual_v));
        let inside = |x: f64| (-EDGE_TOLERANCE..=1.0 + EDGE_TOLERANCE).contains(&x);
        (inside(u) && inside(v)).then_some((t, u, v))
    }

    /// The point at (u, v).
    pub fn position(&self, u: f64, v: f64) -> DVec3 {
        self.corner + u * self.edge_u + v * self.edge_v
    }

    /// Unit vector along `edge_u x edge_v`; zero if the area is zero.
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// The distance along a unit direction from a point to the plane of the quad, scene units.
    pub fn distance_along(&self, from: DVec3, direction: DVec3) -> f64 {
        self.normal.dot(self.corner - from) / self.normal.dot(direction)
    }

    /// The edges along u and v, which are the derivatives of the position.
    pub fn edges(&self) -> (DVec3, DVec3) {
        (self.edge_u, self.edge_v)
    }

    /// The dual basis: its dot products with a point in the plane, relative to the corner, are u and v.
    pub fn duals(&self) -> (DVec3, DVec3) {
        (self.dual_u, self.dual_v)
    }

    /// The area, in square scene units.
    pub fn area(&self) -> f64 {
        self.edge_u.cross(self.edge_v).length()
    }

    /// The distance from the point at (u, v) to the edges along a direction in the plane, in units of the direction.
    pub fn distance_to_edge(&self, uv: DVec2, direction: DVec3) -> f64 {
        let along = DVec2::new(direction.dot(self.dual_u), direction.dot(self.dual_v));
        let to_side = |x: f64, speed: f64| match speed {
            s if s > 0.0 => (1.0 - x) / s,
            s if s < 0.0 => -x / s,
            _ => f64::INFINITY,
        };
        to_side(uv.x, along.x).min(to_side(uv.y, along.y)).max(0.0)
    }

    /// Whether all points lie beyond one of the edges, or in the plane through it that is perpendicular to the quad.
    pub fn is_beside(&self, points: &[DVec3]) -> bool {
        let beyond = |coordinate: fn(DVec2) -> f64| {
            points.iter().all(|point| {
                let offset = *point - self.corner;
                coordinate(DVec2::new(offset.dot(self.dual_u), offset.dot(self.dual_v))) <= EDGE_TOLERANCE
            })
        };
        beyond(|uv| uv.x) || beyond(|uv| 1.0 - uv.x) || beyond(|uv| uv.y) || beyond(|uv| 1.0 - uv.y)
    }

    /// The corners in the order of their (u, v): 00, 10, 11, 01.
    pub fn corners(&self) -> [DVec3; 4] {
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(u, v)| self.position(u, v))
    }

    /// The distance of a point to the quad.
    pub fn distance(&self, point: DVec3) -> f64 {
        let offset = point - self.corner;
        let (u, v) = (offset.dot(self.dual_u), offset.dot(self.dual_v));
        if (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v) {
            return offset.dot(self.normal).abs();
        }
        let to_edge = |start: DVec3, along: DVec3| {
            let fraction = ((point - start).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            point.distance(start + fraction * along)
        };
        let (near, far) = (self.corner, self.corner + self.edge_u + self.edge_v);
        let edges = [(near, self.edge_u), (near, self.edge_v), (far, -self.edge_u), (far, -self.edge_v)];
        edges.into_iter().map(|(start, along)| to_edge(start, along)).fold(f64::INFINITY, f64::min)
    }

    /// The box of the quad.
    pub fn bounds(&self) -> Aabb {
        Aabb::around([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)].map(|(u, v)| self.position(u, v)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn oblique_quads_know_their_coordinates() {
        let quad = Quad::new(DVec3::new(1.0, 2.0, 3.0), DVec3::new(2.0, 0.1, 0.0), DVec3::new(0.7, 1.0, 0.3));
        let eye = DVec3::new(4.0, -3.0, 9.0);
        for (u, v, inside) in [(0.25, 0.75, true), (1.0, 0.0, true), (1.01, 0.5, false), (0.5, -0.01, false)] {
            let hit = quad.intersect(&Ray::new(eye, 0.5 * (quad.position(u, v) - eye)));
            assert_eq!(hit.is_some(), inside, "({u}, {v})");
            if let Some((t, hit_u, hit_v)) = hit {
                assert!((t - 2.0).abs() < 1e-12 && (hit_u - u).abs() < 1e-12 && (hit_v - v).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn distances_match_sampled_points() {
        let quad = Quad::new(DVec3::new(1.0, 2.0, 3.0), DVec3::new(2.0, 0.1, 0.0), DVec3::new(0.7, 1.0, 0.3));
        let grid = || (0..=200).flat_map(|i| (0..=200).map(move |j| (f64::from(i) / 200.0, f64::from(j) / 200.0)));
        for point in [DVec3::ZERO, DVec3::new(2.0, 2.5, 4.0), DVec3::new(9.0, 3.0, 3.0), DVec3::new(2.0, 1.0, 3.1)] {
            let nearest = grid().map(|(u, v)| point.distance(quad.position(u, v))).fold(f64::INFINITY, f64::min);
            // The grid's points are 0.01 apart.
            assert!((quad.distance(point) - nearest).abs() < 0.01, "{} against {nearest}", quad.distance(point));
        }
    }

    #[test]
    fn distances_to_edges_and_points_beside() {
        let quad = Quad::new(DVec3::ZERO, DVec3::new(2.0, 0.0, 0.0), DVec3::new(1.0, 0.0, 4.0));
        let to_edge = |direction| quad.distance_to_edge(DVec2::new(0.25, 0.5), direction);
        assert_eq!([to_edge(DVec3::X), to_edge(DVec3::NEG_X), to_edge(DVec3::Z)], [1.5, 0.5, 2.0]);
        assert!(quad.is_beside(&[DVec3::new(-1.0, 3.0, 0.0), DVec3::new(9.0, -1.0, -0.5)]));
        assert!(quad.is_beside(&quad.corners().map(|corner| corner + quad.edges().0)));
        assert!(!quad.is_beside(&[DVec3::new(-1.0, 3.0, 0.0), DVec3::new(1.5, 3.0, 1.0)]));
    }

    #[test]
    fn no_area_no_hit() {
        let quad = Quad::new(DVec3::ZERO, DVec3::X, DVec3::X);
        assert_eq!(quad.intersect(&Ray::new(DVec3::Z, DVec3::NEG_Z)), None);
        let flat = Quad::new(DVec3::ZERO, DVec3::X, DVec3::Y);
        assert_eq!(flat.intersect(&Ray::new(DVec3::NEG_X, DVec3::X)), None, "a ray in the plane");
    }
}
