//! The kernel of the density estimate and its moments over the part of the disc that the surface fills.

use glam::{DMat2, DVec2};
use std::f64::consts::FRAC_PI_2;
use std::ops::{Add, Mul};

/// Integral of the Epanechnikov kernel `1 - d^2 / r^2` over the whole disc of radius r.
pub(in crate::transport) fn full_integral(radius: f64) -> f64 {
    FRAC_PI_2 * radius * radius
}

/// Least integral of the kernel over a clipped disc, relative to the whole disc: the integral in a corner of 7 degrees. A larger value would
/// darken corners that are wider; a smaller one would turn the rounding error of a point outside its surface into a bright pixel.
const LEAST_FRACTION: f64 = 0.02;

/// Least determinant of the second moments over their squared trace (1/4 on a whole disc) for a kernel with a slope. Below it the disc is a
/// sliver some 30 times as long as wide, whose few photons do not tell how irradiance changes across it.
const LEAST_DETERMINANT: f64 = 1e-3;

/// Greatest depth of a kernel with a slope, see [`Moments::depth_limited`]. It is 4.9 in the corner of a square, so that walls keep the whole
/// slope; in sharper corners and slivers it reaches 60, and single photons would dominate the picture, above and below 0. Measured in a scene
/// of skew quads and bent patches: from the whole slope to a depth of 5 the root mean square of the picture falls by a third at the same mean, and
/// negative pixels vanish; no slope lowers it by another tenth.
const MAX_DEPTH: f64 = 5.0;

/// Moments of the kernel over a clipped disc: integrals of the kernel, of the kernel times `d`, and of the kernel times the products
/// of the coordinates of `d`, the offset from the middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::transport) struct Moments {
    zeroth: f64,
    first: DVec2,
    second: DMat2,
}

impl Moments {
    const ZERO: Self = Self { zeroth: 0.0, first: DVec2::ZERO, second: DMat2::ZERO };

    /// Moments over the disc of this radius about the origin, clipped to a star-shaped polygon around the origin with counterclockwise
    /// corners. The zeroth moment is at least [`LEAST_FRACTION`] of the whole.
    pub(in crate::transport) fn of_polygon<const N: usize>(corners: [DVec2; N], radius: f64) -> Self {
        let sectors = (0..N).map(|k| sector_moments(corners[k], corners[(k + 1) % N], radius));
        sectors.fold(Self::ZERO, Add::add).at_least_a_corner(radius)
    }

    /// A query that lies outside the surface by a rounding error must not divide by 0.
    fn at_least_a_corner(self, radius: f64) -> Self {
        let least = LEAST_FRACTION * full_integral(radius);
        if self.zeroth < least { Self { zeroth: least, ..Self::ZERO } } else { self }
    }

    /// The slope and the integral of the kernel of this radius: by [`Self::linear`] if `linear`, else without a slope, which is less noisy.
    pub(in crate::transport) fn slope_and_integral(&self, linear: bool, radius: f64) -> (DVec2, f64) {
        if linear { self.linear(radius) } else { (DVec2::ZERO, self.zeroth) }
    }

    /// The slope `s` for which the kernel times `1 + s d` has no first moment, and the integral of the product. With it an estimate over
    /// a clipped disc is unbiased for irradiance that changes linearly (local linear regression, \[FanGijbels96\]). Less slope where the kernel
    /// would be deeper than [`MAX_DEPTH`].
    fn linear(&self, radius: f64) -> (DVec2, f64) {
        let trace = self.second.col(0).x + self.second.col(1).y;
        if self.second.determinant() <= LEAST_DETERMINANT * trace * trace {
            return (DVec2::ZERO, self.zeroth);
        }
        let slope = self.depth_limited(-(self.second.inverse() * self.first), radius);
        (slope, self.zeroth + slope.dot(self.first))
    }

    /// The slope, or the fraction of it with which the kernel is [`MAX_DEPTH`] deep.
    ///
    /// Let a be the slope's length times the radius, and b the part of the integral that the slope takes away. `1 + s d` is at least `1 - a`, and
    /// the estimate divides by `1 - b` of the integral, so it is at least `-(a - 1) / (1 - b)` times the estimate without a slope. That
    /// factor is the depth; with the fraction c of the slope it is `(c a - 1) / (1 - c b)`.
    fn depth_limited(&self, slope: DVec2, radius: f64) -> DVec2 {
        let (a, b) = (slope.length() * radius, -slope.dot(self.first) / self.zeroth);
        let fraction = (MAX_DEPTH + 1.0) / (a + MAX_DEPTH * b);
        if fraction < 1.0 { fraction * slope } else { slope }
    }
}

impl Add for Moments {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let second = self.second + other.second;
        Self { zeroth: self.zeroth + other.zeroth, first: self.first + other.first, second }
    }
}

impl Mul<Moments> for f64 {
    type Output = Moments;

    fn mul(self, moments: Moments) -> Moments {
        let Moments { zeroth, first, second } = moments;
        Moments { zeroth: self * zeroth, first: self * first, second: self * second }
    }
}

/// A disc about the origin, clipped to a parallelogram that contains the origin up to rounding errors; scene units.
#[derive(Clone, Copy, Debug)]
pub(in crate::transport) struct Clipped {
    /// Outward unit normals of the sides v = 0, u = 1, v = 1, u = 0.
    outward: [DVec2; 4],
    /// Signed distances of the sides from the origin; sides that do not clip the disc are moved out of it.
    distance: [f64; 4],
    is_counterclockwise: bool,
    radius: f64,
}

impl Clipped {
    /// The disc of this radius, clipped to the parallelogram with the corners `a, a + u, a + u + v, a + v`. Sides marked in `open` do not
    /// clip: the surface continues there. `None` if no side clips the disc.
    pub(in crate::transport) fn new(a: DVec2, u: DVec2, v: DVec2, open: [bool; 4], radius: f64) -> Option<Self> {
        let turn = u.perp_dot(v).signum();
        let starts = [a, a + u, a + u + v, a + v];
        let outward = [u, v, -u, -v].map(|along| -turn * along.perp().normalize_or_zero());
        let inner: [f64; 4] = std::array::from_fn(|side| outward[side].dot(starts[side]));
        let clips: [bool; 4] = std::array::from_fn(|side| !open[side] && inner[side] < radius);
        // Sides that do not clip move out, which keeps the sum over a closed polygon.
        let distance = std::array::from_fn(|side| if clips[side] { inner[side] } else { 2.0 * radius });
        let clipped = Self { outward, distance, is_counterclockwise: turn >= 0.0, radius };
        clips.into_iter().any(|clips| clips).then_some(clipped)
    }

    fn corners(&self) -> [DVec2; 4] {
        let corner = |first: usize, second: usize| {
            let [n0, n1] = [self.outward[first], self.outward[second]];
            intersection(n0, self.distance[first], n1, self.distance[second])
        };
        [corner(3, 0), corner(0, 1), corner(1, 2), corner(2, 3)]
    }

    /// Moments of `1 - d^2 / r^2`. An integral over a polygon is the sum over its sides of the signed integral over the
    /// triangle from the origin to the side.
    pub(in crate::transport) fn moments(&self) -> Moments {
        let [a, b, c, d] = self.corners();
        Moments::of_polygon(if self.is_counterclockwise { [a, b, c, d] } else { [d, c, b, a] }, self.radius)
    }

    /// The zeroth moment alone, which is cheaper.
    pub(in crate::transport) fn integral(&self) -> f64 {
        let r2 = self.radius * self.radius;
        let holds_corner = self.corners().iter().any(|corner| corner.length_squared() < r2);
        if holds_corner || self.distance.iter().any(|&h| h < 0.0) {
            return self.moments().zeroth;
        }
        // The sides cut segments off the disc: sectors without their triangles.
        let segment = |h: f64| {
            let half = (r2 - h * h).max(0.0).sqrt();
            let triangle = h * half / 2.0 - (h * h * h * half + h * half * half * half / 3.0) / (4.0 * r2);
            0.5 * r2 * (h / self.radius).min(1.0).acos() - 2.0 * triangle
        };
        let missing: f64 = self.distance.iter().filter(|&&h| h < self.radius).map(|&h| segment(h)).sum();
        (full_integral(self.radius) - missing).max(LEAST_FRACTION * full_integral(self.radius))
    }
}

/// The point at these distances from the origin along two unit vectors.
fn intersection(n0: DVec2, d0: f64, n1: DVec2, d1: f64) -> DVec2 {
    (d1 * n0.perp() - d0 * n1.perp()) / n0.perp_dot(n1)
}

/// Signed moments of the kernel over the triangle (origin, p, q), clipped to the disc.
///
/// In polar coordinates about the origin, the angle from the normal of the side at distance `h`: times `R^k`, the kernel
/// integrates to `R^(k+2) / (k + 2) - R^(k+4) / (k + 4) r^2` along a radius of length R, which is `h / cos` up to the side
/// and r up to the arc. Over the angle both have closed forms: in `s = h tan`, the coordinate along the side, and in
/// the angle.
fn sector_moments(p: DVec2, q: DVec2, radius: f64) -> Moments {
    let along = (q - p).normalize_or_zero();
    let h = p.perp_dot(along).abs();
    let (s0, s1) = (p.dot(along), q.dot(along));
    let sign = p.perp_dot(q).signum();
    let side = Side { normal: -sign * along.perp(), along, h, radius };
    // The side runs from s0 to s1; within +-half it lies in the disc, elsewhere the arc bounds the area.
    let half = (radius * radius - h * h).max(0.0).sqrt();
    let (c0, c1) = (s0.clamp(-half, half), s1.clamp(-half, half));
    let between = |from: f64, to: f64, of: fn(&Side, f64) -> Moments| {
        if from == to { Moments::ZERO } else { of(&side, to) + -1.0 * of(&side, from) }
    };
    let arcs =
        if half == 0.0 { between(s0, s1, Side::arc) } else { between(s0, c0, Side::arc) + between(c1, s1, Side::arc) };
    sign * (arcs + between(c0, c1, Side::chord))
}

/// A side of a polygon about the middle of the disc.
struct Side {
    /// Unit vector from the middle to the side.
    normal: DVec2,
    /// Unit vector along the side.
    along: DVec2,
    /// Distance of the side from the middle.
    h: f64,
    /// Radius of the disc.
    radius: f64,
}

impl Side {
    /// Moments by their coordinates along the normal (n) and along the side (t).
    #[inline]
    fn moments(&self, zeroth: f64, [n, t]: [f64; 2], [nn, nt, tt]: [f64; 3]) -> Moments {
        let axes = DMat2::from_cols(self.normal, self.along);
        let second = axes * DMat2::from_cols_array(&[nn, nt, nt, tt]) * axes.transpose();
        Moments { zeroth, first: n * self.normal + t * self.along, second }
    }

    /// Moments over the triangle between the middle and the side, from the foot of the normal up to `s`.
    fn chord(&self, s: f64) -> Moments {
        let (h, r2) = (self.h, self.radius * self.radius);
        let (h2, s2) = (h * h, s * s);
        let squares = (h2 + s2) * (h2 + s2) / 4.0;
        self.moments(
            h * s / 2.0 - (h2 * h * s + h * s2 * s / 3.0) / (4.0 * r2),
            [h2 * s / 3.0 - (h2 * h2 * s + h2 * s2 * s / 3.0) / (5.0 * r2), h * s2 / 6.0 - h * squares / (5.0 * r2)],
            [
                h2 * h * s / 4.0 - (h2 * h2 * h * s + h2 * h * s2 * s / 3.0) / (6.0 * r2),
                h2 * s2 / 8.0 - h2 * squares / (6.0 * r2),
                h * s2 * s / 12.0 - (h2 * h * s2 * s / 3.0 + h * s2 * s2 * s / 5.0) / (6.0 * r2),
            ],
        )
    }

    /// Moments over the sector of the disc from the normal to the direction of the side's point at `s`.
    fn arc(&self, s: f64) -> Moments {
        let (h, r2) = (self.h, self.radius * self.radius);
        let angle = s.atan2(h);
        // Without trigonometry, which would take as long as the rest.
        let length = (s * s + h * h).sqrt().max(f64::MIN_POSITIVE);
        let (sin, cos) = (s / length, h / length);
        let (third, fourth) = (2.0 / 15.0 * r2 * self.radius, r2 * r2 / 12.0);
        let (even, odd) = (0.5 * angle, 0.5 * sin * cos);
        self.moments(
            0.25 * r2 * angle,
            [third * sin, -third * cos],
            [fourth * (even + odd), fourth * 0.5 * sin * sin, fourth * (even - odd)],
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn by_summation(a: DVec2, u: DVec2, v: DVec2, radius: f64) -> Moments {
        let n = 1000;
        let cell = 2.0 * radius / f64::from(n);
        let mut sum = Moments::ZERO;
        for k in 0..n * n {
            let p = DVec2::new(f64::from(k % n) + 0.5, f64::from(k / n) + 0.5) * cell - radius;
            let (x, y) = ((p - a).perp_dot(v) / u.perp_dot(v), (p - a).perp_dot(u) / v.perp_dot(u));
            if (0.0..=1.0).contains(&x) && (0.0..=1.0).contains(&y) {
                let zeroth = (1.0 - p.length_squared() / (radius * radius)).max(0.0) * cell * cell;
                let second = zeroth * DMat2::from_cols(p.x * p, p.y * p);
                sum = sum + Moments { zeroth, first: zeroth * p, second };
            }
        }
        sum
    }

    fn clipped_moments(a: DVec2, u: DVec2, v: DVec2, open: [bool; 4]) -> Moments {
        Clipped::new(a, u, v, open, 1.0).expect("the disc is clipped").moments()
    }

    const CASES: [(DVec2, DVec2, DVec2); 6] = [
        (DVec2::new(-0.1, -5.0), DVec2::new(9.0, 0.0), DVec2::new(0.0, 9.0)),
        (DVec2::new(-0.1, -0.3), DVec2::new(9.0, 0.0), DVec2::new(0.0, 9.0)),
        (DVec2::new(-0.2, -0.3), DVec2::new(0.5, 0.1), DVec2::new(0.1, 0.6)),
        (DVec2::new(-0.2, -0.3), DVec2::new(0.1, 0.6), DVec2::new(0.5, 0.1)),
        (DVec2::new(-2.2, -0.3), DVec2::new(4.0, 0.5), DVec2::new(1.5, 4.0)),
        (DVec2::new(-2.2, 0.0), DVec2::new(4.0, 0.0), DVec2::new(0.0, 4.0)),
    ];

    #[test]
    fn match_summation_on_rims_and_corners() {
        for (a, u, v) in CASES {
            let exact = clipped_moments(a, u, v, [false; 4]);
            let summed = by_summation(a, u, v, 1.0);
            let difference = exact + -1.0 * summed;
            let largest = difference.first.abs().max_element().max(difference.zeroth.abs());
            let largest = difference.second.to_cols_array().into_iter().fold(largest, |a, b| a.max(b.abs()));
            // Cells of 2e-3 along a rim of length 2 with a kernel of at most 1: some 2e-3 * 2 * 0.5 at worst.
            assert!(largest < 2e-3, "{exact:?} against {summed:?} at {a}");
        }
    }

    #[test]
    fn the_integral_alone_is_the_same() {
        for (a, u, v) in CASES.into_iter().chain([(DVec2::new(-0.3, -5.0), DVec2::new(0.9, 0.0), DVec2::new(0.0, 9.0))])
        {
            let clipped = Clipped::new(a, u, v, [false; 4], 1.0).expect("the disc is clipped");
            let (alone, among_moments) = (clipped.integral(), clipped.moments().zeroth);
            assert!((alone - among_moments).abs() < 1e-13, "{alone} against {among_moments} at {a}");
        }
    }

    /// Weighted by the slope, the mean of a linear function is its value at the origin.
    #[test]
    fn linear_functions_are_found_exactly() {
        for (a, u, v) in CASES {
            let moments = clipped_moments(a, u, v, [false; 4]);
            let (slope, integral) = moments.linear(1.0);
            let gradient = DVec2::new(0.7, -1.3);
            let weighted = integral * 2.0 + gradient.dot(moments.first) + gradient.dot(moments.second * slope);
            assert!((weighted / integral - 2.0).abs() < 1e-9, "{} at {a}", weighted / integral);
        }
    }

    /// In the corner of a wide square the depth is 4.914 and the slope whole; in the corner of a square a fifth as wide as the disc's radius
    /// the slope is limited.
    #[test]
    fn kernels_on_small_surfaces_have_less_slope() {
        let depth = |slope: DVec2, integral: f64, moments: &Moments, radius: f64| {
            (slope.length() * radius - 1.0) * moments.zeroth / integral
        };
        let corner = |side: f64| clipped_moments(DVec2::ZERO, DVec2::new(side, 0.0), DVec2::new(0.0, side), [false; 4]);
        let wide = corner(9.0);
        let (slope, integral) = wide.linear(1.0);
        assert!((depth(slope, integral, &wide, 1.0) - 4.914).abs() < 1e-3, "{}", depth(slope, integral, &wide, 1.0));
        assert!((wide.first + wide.second * slope).length() < 1e-12, "the wide square's kernel has a first moment");
        let small = corner(0.2);
        let (slope, integral) = small.linear(1.0);
        assert!((depth(slope, integral, &small, 1.0) - MAX_DEPTH).abs() < 1e-9, "{slope}, {integral}");
        // Depth is a pure number: at half the size the slope is twice as large.
        let corners = [[0.0, 0.0], [0.1, 0.0], [0.1, 0.1], [0.0, 0.1]].map(DVec2::from_array);
        let half = Moments::of_polygon(corners, 0.5);
        assert!((half.linear(0.5).0 - 2.0 * slope).length() < 1e-9, "{}", half.linear(0.5).0);
    }

    #[test]
    fn open_sides_do_not_clip() {
        let (a, u, v) = (DVec2::new(-0.1, -5.0), DVec2::new(9.0, 0.0), DVec2::new(0.0, 9.0));
        assert!(Clipped::new(a, u, v, [false, false, false, true], 1.0).is_none());
        let clipped = clipped_moments(a, u, v, [true, true, true, false]);
        assert!(clipped.zeroth < 0.6 * full_integral(1.0));
    }

    #[test]
    fn outside_the_surface_nothing_is_divided_by_zero() {
        let (u, v) = (DVec2::new(9.0, 0.0), DVec2::new(0.0, 9.0));
        let moments = clipped_moments(DVec2::new(1.5, 1.5), u, v, [false; 4]);
        assert_eq!(moments.linear(1.0), (DVec2::ZERO, 0.02 * full_integral(1.0)));
    }
}
