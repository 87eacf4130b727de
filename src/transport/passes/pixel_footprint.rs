//! What part of a surface a pixel shows.

use crate::transport::points::VisiblePoint;
use crate::world::{Camera, World};
use glam::{DVec3, Vec2, Vec3};

/// Most of a plane that a pixel may show each way, over the pixel's footprint across the ray, to count as one piece of it.
const LARGEST: f64 = 32.0;
/// Greatest distance of a neighbour's point from where the others say, over the size of the piece: beyond, mirrors or glass bend too much.
const BENT: f32 = 0.5;

/// Columns and rows to the pixels around a pixel.
const AROUND: [[i32; 2]; 8] = [[-1, -1], [0, -1], [1, -1], [-1, 0], [1, 0], [-1, 1], [0, 1], [1, 1]];

/// The piece of a plane that a pixel shows: its middle, relative to the view's origin, and half its sides.
pub(super) struct PixelFootprint {
    pub(super) middle: Vec3,
    pub(super) sides: [Vec3; 2],
    /// Whether the pixel, as far as the points in it and around it tell, shows nothing else.
    pub(super) is_whole: bool,
}

impl PixelFootprint {
    /// The part of the piece, of this many along each side, that holds a point of the pixel (from 0 to 1 each way).
    #[inline]
    pub(super) fn part(&self, count: u32, in_pixel: Vec2) -> Self {
        let count = count as f32;
        let from_middle = 2.0 * (((in_pixel * count).floor() + 0.5) / count) - 1.0;
        Self {
            middle: self.middle + from_middle.x * self.sides[0] + from_middle.y * self.sides[1],
            sides: self.sides.map(|side| side / count),
            is_whole: self.is_whole,
        }
    }
}

/// The visible points of a band by pixel.
pub(super) struct PointsByPixel<'a> {
    points: &'a [VisiblePoint],
    camera: &'a Camera,
    first_pixel: u32,
    /// For each pixel, the range of its points.
    ranges: Vec<[u32; 2]>,
}

impl<'a> PointsByPixel<'a> {
    /// The points of a band, in which those of each pixel follow each other.
    pub(super) fn new(points: &'a [VisiblePoint], camera: &'a Camera) -> Self {
        let pixels = points.iter().map(|point| point.pixel);
        let first_pixel = pixels.clone().min().unwrap_or(0);
        let count = pixels.max().map_or(0, |last| last - first_pixel + 1);
        let mut ranges = vec![[0; 2]; count as usize];
        for (index, point) in (0..).zip(points) {
            let [start, end] = &mut ranges[(point.pixel - first_pixel) as usize];
            (*start, *end) = (if *end == 0 { index } else { *start }, index + 1);
        }
        Self { points, camera, first_pixel, ranges }
    }

    /// The piece of the surface at a point that its pixel shows; `None` where the surface is too oblique or what shows it too bent.
    #[inline]
    pub(super) fn footprint(&self, world: &World, point: &VisiblePoint) -> Option<PixelFootprint> {
        if point.seen_directly { self.directly(world, point) } else { self.through_mirrors(point) }
    }

    fn directly(&self, world: &World, point: &VisiblePoint) -> Option<PixelFootprint> {
        let is_same = |other: &VisiblePoint| other.seen_directly && !other.on_an_edge && other.tag == point.tag;
        let shows_same = |[x, y]: &[i32; 2]| {
            self.neighbours(point, [*x, *y]).is_none_or(|neighbours| neighbours.iter().any(is_same))
        };
        // The pixel's own paths seldom tell of an edge that cuts off a corner of it.
        let is_whole = !point.on_an_edge && AROUND.iter().all(shows_same);
        let origin = world.view.origin;
        let (position, normal) = (point.position.as_dvec3() + origin, point.n_side.as_dvec3());
        let [middle, right, below] = self.camera.pixel_on_plane(point.pixel, position, normal, LARGEST)?;
        Some(PixelFootprint {
            middle: (middle - origin).as_vec3(),
            sides: [right, below].map(|side: DVec3| side.as_vec3()),
            is_whole,
        })
    }

    /// From where the neighbours see the surface by the same mirrors and glass, as if the map from film to surface were linear.
    fn through_mirrors(&self, point: &VisiblePoint) -> Option<PixelFootprint> {
        let way = point.way?;
        let mut offsets = arrayvec::ArrayVec::<(Vec2, Vec3), 8>::new();
        for [x, y] in AROUND {
            let Some(neighbours) = self.neighbours(point, [x, y]) else { continue };
            let same = neighbours.iter().find(|other| other.way == Some(way) && other.tag == point.tag);
            match same {
                Some(other) => offsets.push((
                    other.in_pixel - point.in_pixel + Vec2::new(x as f32, y as f32),
                    other.position - point.position,
                )),
                None if x == 0 || y == 0 => return None,
                None => {}
            }
        }
        // Least squares: J minimizes the sum of |dp - J ds|^2.
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        let (mut px, mut py) = (Vec3::ZERO, Vec3::ZERO);
        for (s, p) in &offsets {
            (xx, xy, yy) = (xx + s.x * s.x, xy + s.x * s.y, yy + s.y * s.y);
            (px, py) = (px + *p * s.x, py + *p * s.y);
        }
        let determinant = xx * yy - xy * xy;
        if determinant <= 0.1 * (xx + yy).powi(2) {
            return None;
        }
        let [along_x, along_y] = [(px * yy - py * xy) / determinant, (py * xx - px * xy) / determinant];
        let across = |v: Vec3| v - point.n_side * v.dot(point.n_side);
        let size = along_x.length() + along_y.length();
        let is_bent = offsets.iter().any(|(s, p)| (*p - along_x * s.x - along_y * s.y).length() > BENT * size);
        if is_bent || size > LARGEST as f32 * point.footprint {
            return None;
        }
        let to_middle = Vec2::splat(0.5) - point.in_pixel;
        let [along_x, along_y] = [across(along_x), across(along_y)];
        let is_flat = along_x.cross(along_y).length() <= 1e-3 * along_x.length() * along_y.length();
        (!is_flat).then(|| PixelFootprint {
            middle: point.position + along_x * to_middle.x + along_y * to_middle.y,
            sides: [0.5 * along_x, 0.5 * along_y],
            is_whole: true,
        })
    }

    /// The points of the pixel at this offset; `None` outside of the band.
    fn neighbours(&self, point: &VisiblePoint, [x, y]: [i32; 2]) -> Option<&[VisiblePoint]> {
        let width = self.camera.width as i32;
        let (column, row) = (point.pixel as i32 % width + x, point.pixel as i32 / width + y);
        if column < 0 || column >= width {
            return None;
        }
        let index = usize::try_from(row * width + column - self.first_pixel as i32).ok()?;
        let [start, end] = *self.ranges.get(index)?;
        Some(&self.points[start as usize..end as usize])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::testing::{self, quad, visible_point};

    /// Points of a film of 3 x 3 pixels; the map from film to surface is linear but for the point in the last corner.
    fn points(last: Vec3) -> Vec<VisiblePoint> {
        let at = |pixel: u32| {
            let in_pixel = Vec2::new(0.2 + 0.05 * pixel as f32, 0.9 - 0.07 * pixel as f32);
            let film = Vec2::new((pixel % 3) as f32, (pixel / 3) as f32) + in_pixel;
            let position = Vec3::new(0.02 * film.x + 0.01 * film.y, 0.0, 0.03 * film.y);
            let aside = if pixel == 8 { last } else { Vec3::ZERO };
            VisiblePoint { pixel, in_pixel, position: position + aside, seen_directly: false, ..visible_point() }
        };
        (0..9).map(at).collect()
    }

    fn camera() -> Camera {
        Camera::new(&crate::scene::Camera::default(), 3, 3)
    }

    #[test]
    fn neighbours_tell_what_a_pixel_shows_in_a_mirror() {
        let (points, camera) = (points(Vec3::ZERO), camera());
        let by_pixel = PointsByPixel::new(&points, &camera);
        let PixelFootprint { middle, sides, .. } = by_pixel.through_mirrors(&points[4]).expect("it is linear");
        assert!((middle - Vec3::new(0.045, 0.0, 0.045)).length() < 1e-6, "{middle}");
        assert!(
            (sides[0] - Vec3::X * 0.01).length() < 1e-6 && (sides[1] - Vec3::new(0.005, 0.0, 0.015)).length() < 1e-6
        );
    }

    #[test]
    fn other_ways_and_bent_mirrors_leave_no_piece() {
        let camera = camera();
        let found = |points: &[VisiblePoint]| PointsByPixel::new(points, &camera).through_mirrors(&points[4]).is_some();
        assert!(found(&points(Vec3::ZERO)));
        assert!(!found(&points(Vec3::new(0.5, 0.0, 0.5))), "bent");
        let mut other_way = points(Vec3::ZERO);
        other_way[5].way = Some(7);
        assert!(!found(&other_way), "the next pixel shows another surface");
    }

    #[test]
    fn parts_divide_the_piece() {
        let whole = PixelFootprint { middle: Vec3::X, sides: [Vec3::X * 0.3, Vec3::Z * 0.6], is_whole: true };
        let mut sum = Vec3::ZERO;
        for k in 0..9 {
            let part = whole.part(3, (Vec2::new((k % 3) as f32, (k / 3) as f32) + 0.4) / 3.0);
            assert!((part.sides[0] - Vec3::X * 0.1).length() < 1e-6 && (part.sides[1] - Vec3::Z * 0.2).length() < 1e-6);
            sum += part.middle / 9.0;
            let expected = Vec3::new(0.8 + 0.2 * (k % 3) as f32, 0.0, 0.4 * (k / 3) as f32 - 0.4);
            assert!((part.middle - expected).length() < 1e-6, "{k}: {}", part.middle);
        }
        assert!((sum - Vec3::X).length() < 1e-6);
    }

    /// A pixel beside the edge of a surface may show the edge, although none of its paths met it.
    #[test]
    fn a_pixel_beside_an_edge_shows_no_whole_piece() {
        let world = testing::world(&quad("wall", [[-9.0, -9.0, 0.0], [18.0, 0.0, 0.0], [0.0, 18.0, 0.0]], "grey"));
        let camera = world.camera.resized(3, 3);
        let position = (-world.view.origin).as_vec3();
        let seen = |pixel: u32| VisiblePoint { pixel, position, n_side: Vec3::Z, ..visible_point() };
        let mut points: Vec<VisiblePoint> = (0..9).map(seen).collect();
        let is_whole = |points: &[VisiblePoint]| {
            let footprint = PointsByPixel::new(points, &camera).footprint(&world, &points[4]);
            footprint.expect("the wall is not oblique").is_whole
        };
        assert!(is_whole(&points));
        points[2].on_an_edge = true;
        assert!(!is_whole(&points));
    }
}
