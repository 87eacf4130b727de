use crate::geometry::Quad;
use glam::{DVec2, DVec3};

/// The solid angle of a quad, seen from a point before it.
#[derive(Clone, Copy, Debug)]
pub(super) struct SphericalQuad {
    /// Two triangles on either side of a diagonal.
    triangles: [SphericalTriangle; 2],
}

/// A triangle on the unit sphere.
#[derive(Clone, Copy, Debug)]
struct SphericalTriangle {
    /// The unit vectors to the vertices.
    a: DVec3,
    b: DVec3,
    c: DVec3,
    /// The triple product of the vertices, which is positive.
    volume: f64,
}

impl SphericalQuad {
    /// The quad as it is seen from a point; `None` from its plane or from behind.
    pub(super) fn new(quad: &Quad, from: DVec3) -> Option<Self> {
        let corners = quad.corners().map(|corner| corner - from);
        let height = -quad.normal().dot(corners[0]);
        // Also false for NaN.
        let is_before = height > 0.0;
        let triangle = |[a, b, c]: [usize; 3]| {
            let [a, b, c] = [a, b, c].map(|k| corners[k]);
            // Of the vectors themselves, three nearly parallel ones would leave rounding only.
            let volume = height * quad.area() / (a.length() * b.length() * c.length());
            SphericalTriangle { a: a.normalize(), b: b.normalize(), c: c.normalize(), volume }
        };
        let seen = is_before.then(|| Self { triangles: [triangle([0, 1, 2]), triangle([0, 2, 3])] })?;
        (seen.solid_angle() > 0.0).then_some(seen)
    }

    /// The solid angle, steradian.
    pub(super) fn solid_angle(&self) -> f64 {
        self.triangles.iter().map(SphericalTriangle::solid_angle).sum()
    }

    /// A unit direction, uniform by solid angle.
    pub(super) fn sample(&self, u: DVec2) -> DVec3 {
        let [first, second] = &self.triangles;
        let along = u.x * self.solid_angle();
        let of_first = first.solid_angle();
        if along < of_first { first.sample(along, u.y) } else { second.sample(along - of_first, u.y) }
    }
}

impl SphericalTriangle {
    /// The solid angle, steradian \[VanOosterom83\].
    fn solid_angle(&self) -> f64 {
        let Self { a, b, c, volume } = *self;
        2.0 * volume.atan2(1.0 + a.dot(b) + b.dot(c) + c.dot(a))
    }

    /// A unit direction, uniform by solid angle: `u` from 0 to 1 and a part of the solid angle \[Arvo95\].
    ///
    /// The part is cut off by a great circle through `b`, which meets the side from `a` to `c` in a point. For the angle alpha at `a`, and half
    /// tangents of a part and of two sides at `a`, `tan(part / 2) = s t sin(alpha) / (1 + s t cos(alpha))`.
    /// Solved for a side, it has no difference of nearly equal numbers in small or thin triangles.
    fn sample(&self, part: f64, u: f64) -> DVec3 {
        let Self { a, b, c, volume } = *self;
        let (ab, ac) = (a.cross(b), a.cross(c));
        // Sine and cosine of alpha, both times the sines of the sides.
        let (sin, cos) = (volume, ab.dot(ac));
        let tan = (0.5 * part).tan();
        let half_tangent_ab = a.distance(b) / (a + b).length();
        let half_tangent = tan * ab.length() * ac.length() / (half_tangent_ab * (sin - tan * cos));
        let square = half_tangent * half_tangent;
        let towards_c = ac.cross(a) / ac.length();
        let cut = ((1.0 - square) * a + 2.0 * half_tangent * towards_c) / (1.0 + square);
        // Uniform along the great circle from `b`, by its distance from `b` along the axis of `b`.
        let rise = 0.5 * u * cut.distance_squared(b);
        let side = (cut - b).reject_from_normalized(b).normalize_or_zero();
        ((1.0 - rise) * b + (rise * (2.0 - rise)).max(0.0).sqrt() * side).normalize()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Each quarter of the quad gets its share of the directions, and the quarters fill the solid angle of the whole.
    fn assert_uniform(name: &str, quad: &Quad, from: DVec3) {
        const SIDE: usize = 64;
        let seen = SphericalQuad::new(quad, from).expect("the quad is seen");
        let grid = (0..SIDE * SIDE).map(|k| (DVec2::new((k % SIDE) as f64, (k / SIDE) as f64) + 0.5) / SIDE as f64);
        let (u, v) = quad.edges();
        let solid_angle = |corner: DVec3, u: DVec3, v: DVec3| {
            SphericalQuad::new(&Quad::new(corner, u, v), from).map_or(0.0, |part| part.solid_angle())
        };
        let quarters = [[0.0, 0.0], [0.5, 0.0], [0.0, 0.5], [0.5, 0.5]];
        let whole: f64 = quarters.iter().map(|[x, y]| solid_angle(quad.position(*x, *y), 0.5 * u, 0.5 * v)).sum();
        assert!((whole / seen.solid_angle() - 1.0).abs() < 1e-6, "{name}: the parts make {whole}");
        for [x, y] in quarters {
            let (du, dv) = quad.duals();
            let is_in = |wi: DVec3| {
                let offset = from + quad.distance_along(from, wi) * wi - quad.position(0.0, 0.0);
                let (s, t) = (offset.dot(du) - x, offset.dot(dv) - y);
                (0.0..0.5).contains(&s) && (0.0..0.5).contains(&t)
            };
            let drawn = grid.clone().filter(|sample| is_in(seen.sample(*sample))).count() as f64 / (SIDE * SIDE) as f64;
            let exact = solid_angle(quad.position(x, y), 0.5 * u, 0.5 * v) / seen.solid_angle();
            assert!((drawn - exact).abs() < 0.02, "{name}, part {x} {y}: {drawn} of the directions for {exact}");
        }
    }

    #[test]
    fn directions_are_uniform_by_solid_angle() {
        // edge_u x edge_v points down.
        let square = |half: f64| Quad::new(DVec3::new(-half, 2.0, -half), 2.0 * half * DVec3::X, 2.0 * half * DVec3::Z);
        for half in [1e-4, 1.0, 1e3, 1e6, 1e9] {
            assert_uniform(&format!("above, {half}"), &square(half), DVec3::ZERO);
            assert_uniform(&format!("aside, {half}"), &square(half), DVec3::new(0.3 * half, 0.0, -0.8 * half));
        }
        for height in [1e-1, 1e-4, 1e-8] {
            let below = |x: f64| DVec3::new(x, 2.0 - height, 0.1);
            assert_uniform(&format!("close, {height}"), &square(1.0), below(0.2));
            assert_uniform(&format!("beside, {height}"), &square(1.0), below(1.3));
        }
        let oblique = Quad::new(DVec3::new(0.0, 1.0, 0.0), DVec3::new(5.0, 0.3, 0.0), DVec3::new(4.8, 0.0, 0.2));
        assert_uniform("oblique", &oblique, DVec3::new(4.0, 0.5, 0.1));
    }

    #[test]
    fn a_wide_quad_fills_half_the_view() {
        let wide = Quad::new(DVec3::new(-1e7, 2.0, -1e7), 2e7 * DVec3::X, 2e7 * DVec3::Z);
        let solid_angle = |from| SphericalQuad::new(&wide, from).map(|seen| seen.solid_angle());
        assert!((solid_angle(DVec3::ZERO).expect("seen") / (2.0 * PI) - 1.0).abs() < 1e-5);
        assert_eq!([solid_angle(DVec3::new(0.0, 2.0, 0.0)), solid_angle(DVec3::new(0.0, 3.0, 0.0))], [None; 2]);
    }
}
