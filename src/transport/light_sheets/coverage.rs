//! How much of a triangle lies in a square.

use arrayvec::ArrayVec;
use glam::Vec2;

/// A corner of the part of a triangle that lies in a square.
#[derive(Clone, Copy)]
struct Corner {
    /// Coordinates over two edges of the triangle.
    of_triangle: Vec2,
    position: Vec2,
}

/// Three corners, and one more for each side of the square.
type Polygon = ArrayVec<Corner, 7>;

/// Area of a triangle, over its extent squared, below which rounding spoils the difference of areas.
const THIN: f32 = 0.01;

/// The fraction of a triangle that lies in the square from -1 to 1. Defined for triangles without area, too, as the limit of thin ones.
#[inline(always)]
pub(super) fn fraction_in_square(triangle: [Vec2; 3]) -> f32 {
    let [a, b, c] = triangle;
    let (min, max) = (a.min(b).min(c), a.max(b).max(c));
    if min.max_element() > 1.0 || max.min_element() < -1.0 {
        return 0.0;
    }
    if min.min_element() >= -1.0 && max.max_element() <= 1.0 {
        return 1.0;
    }
    let twice_area = (b - a).perp_dot(c - a);
    if twice_area.abs() < THIN * (max - min).max_element().max(1.0).powi(2) {
        return fraction_by_clipping(triangle);
    }
    let in_square = area_beside(a, b) + area_beside(b, c) + area_beside(c, a);
    (2.0 * in_square / twice_area).clamp(0.0, 1.0)
}

/// The signed area of the square from -1 to 1 to the left of an edge, that is, with less x, at the heights of the edge. The sum over the edges
/// of a polygon is the area of its part in the square, by Green's theorem.
#[inline(always)]
fn area_beside(from: Vec2, to: Vec2) -> f32 {
    let slope = (to.x - from.x) / (to.y - from.y);
    let [bottom, top] = [from.y, to.y].map(|y| y.clamp(-1.0, 1.0));
    if bottom == top {
        return 0.0;
    }
    let at = |y: f32| from.x + (y - from.y) * slope;
    let (start, end) = (at(bottom), at(top));
    let run = end - start;
    if run.abs() < 1e-3 {
        return (0.5 * (start + end)).clamp(-1.0, 1.0) * (top - bottom) + (top - bottom);
    }
    // The integral of the clamped x + 1 over x.
    let integral = |x: f32| {
        let inside = x.clamp(-1.0, 1.0) + 1.0;
        0.5 * inside * inside + 2.0 * (x - 1.0).max(0.0)
    };
    (integral(end) - integral(start)) * (top - bottom) / run
}

#[inline(never)]
fn fraction_by_clipping(triangle: [Vec2; 3]) -> f32 {
    let of_triangle = [Vec2::ZERO, Vec2::X, Vec2::Y];
    let corners = of_triangle.into_iter().zip(triangle);
    let mut polygon: Polygon = corners.map(|(of_triangle, position)| Corner { of_triangle, position }).collect();
    for axis in [Vec2::X, Vec2::Y, Vec2::NEG_X, Vec2::NEG_Y] {
        polygon = clip(&polygon, |corner| 1.0 - axis.dot(corner.position));
    }
    twice_area(&polygon).clamp(0.0, 1.0)
}

/// The part of a polygon where a linear function is at least 0 \[SutherlandHodgman74\].
fn clip(polygon: &Polygon, inside: impl Fn(&Corner) -> f32) -> Polygon {
    let mut clipped = Polygon::new();
    let Some(mut from) = polygon.last() else { return clipped };
    for to in polygon {
        let (a, b) = (inside(from), inside(to));
        if (a >= 0.0) != (b >= 0.0) && !clipped.is_full() {
            let t = a / (a - b);
            clipped.push(Corner {
                of_triangle: from.of_triangle.lerp(to.of_triangle, t),
                position: from.position.lerp(to.position, t),
            });
        }
        if b >= 0.0 && !clipped.is_full() {
            clipped.push(*to);
        }
        from = to;
    }
    clipped
}

fn twice_area(polygon: &Polygon) -> f32 {
    let Some(first) = polygon.first() else { return 0.0 };
    let edges = polygon.windows(2).map(|pair| [pair[0].of_triangle, pair[1].of_triangle]);
    edges.map(|[a, b]| (a - first.of_triangle).perp_dot(b - first.of_triangle)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: [Vec2; 3] = [Vec2::new(-1.0, -2.0), Vec2::new(5.0, 0.0), Vec2::new(0.5, 4.0)];

    #[test]
    fn a_triangle_over_the_square_has_the_square_of_it() {
        let area = 0.5 * (TRIANGLE[1] - TRIANGLE[0]).perp_dot(TRIANGLE[2] - TRIANGLE[0]);
        let around = TRIANGLE.map(|corner| 4.0 * (corner - Vec2::new(1.0, 0.5)));
        let expected = 4.0 / (16.0 * area);
        assert!((fraction_in_square(around) / expected - 1.0).abs() < 1e-6);
        assert!((fraction_by_clipping(around) / expected - 1.0).abs() < 1e-5);
        let reversed = [around[0], around[2], around[1]];
        assert!((fraction_in_square(reversed) / expected - 1.0).abs() < 1e-6, "either way round");
    }

    #[test]
    fn both_ways_find_the_same_fraction() {
        for k in 0..2000u32 {
            let at = |j: u32| (((k * 7919 + j * 104_729) % 1013) as f32 / 1013.0 - 0.5) * 8.0;
            let triangle = [Vec2::new(at(1), at(2)), Vec2::new(at(3), at(4)), Vec2::new(at(5), at(6))];
            let [found, expected] = [fraction_in_square(triangle), fraction_by_clipping(triangle)];
            assert!((found - expected).abs() < 1e-3, "{found} {expected} {triangle:?}");
        }
    }

    /// Squares without gaps and overlaps hold the whole triangle.
    #[test]
    fn squares_side_by_side_divide_the_triangle() {
        let flat = [TRIANGLE[0], TRIANGLE[1], TRIANGLE[0].lerp(TRIANGLE[1], 0.3)];
        for triangle in [TRIANGLE, flat, [Vec2::splat(0.05); 3]] {
            let of_square = |k: i32| {
                let center = Vec2::new((k % 80 - 40) as f32, (k / 80 - 40) as f32) * 0.3;
                fraction_in_square(triangle.map(|corner| (corner - center) / 0.15))
            };
            let sum: f32 = (0..6400).map(of_square).sum();
            assert!((sum - 1.0).abs() < 1e-4, "{sum} {triangle:?}");
        }
    }

    #[test]
    fn a_triangle_beside_the_square_leaves_nothing_in_it() {
        assert_eq!(fraction_in_square(TRIANGLE.map(|corner| 2.0 * corner + Vec2::new(4.0, 0.0))), 0.0);
        // Its box meets the square.
        assert_eq!(fraction_in_square([Vec2::new(-4.0, 0.0), Vec2::new(0.0, -4.0), Vec2::splat(-4.0)]), 0.0);
    }
}
