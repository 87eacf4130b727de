//! Interleaved gathering: interreflection changes little from a pixel to the next, so in each iteration one pixel of four gathers
//! irradiance for its neighbours, also where they see the same surface in a mirror or through glass. In a draft it is one pixel of
//! sixteen, and neighbours with other shading normals take the same irradiance.

use crate::transport::density::bandwidth::WIDER;
use crate::transport::plan::InterleavedGrid;
use crate::transport::points::{LEAST_COS_OF_NEIGHBOURS, VisiblePoint};

/// Greatest distance between a point and a neighbour that takes its irradiance, in radii of the point's disc: the blur that this adds
/// is small beside that of the disc.
const MAX_DISTANCE: f64 = 0.25;

/// The points that gather irradiance, and the points that take it from them.
#[derive(Debug, Default)]
pub(super) struct Interleaving {
    /// Indices of the points that gather for themselves and for others, in rising order.
    pub(super) gathering: Vec<u32>,
    /// For each point the index in `gathering` of the point whose irradiance it takes; `None` where it gathers for itself alone.
    pub(super) source: Vec<Option<u32>>,
}

impl Interleaving {
    /// Every point gathers for itself alone.
    pub(super) fn none(points: usize) -> Self {
        Self { gathering: Vec::new(), source: vec![None; points] }
    }

    /// The assignment for visible points, of which the points of a pixel are adjacent; `radius` returns the radius of a point's disc, scene
    /// units.
    pub(super) fn new(grid: InterleavedGrid, points: &[VisiblePoint], radius: impl Fn(&VisiblePoint) -> f64) -> Self {
        let first = points.iter().map(|point| point.pixel).min().unwrap_or(0);
        let last = points.iter().map(|point| point.pixel).max().unwrap_or(0);
        let mut gathering = Vec::new();
        // The range of each pixel's points in `gathering`.
        let mut ranges = vec![0..0; (last - first) as usize + 1];
        for (index, point) in (0..).zip(points) {
            let gathers = grid.may_interleave(point) && grid.gathering_pixel(point.pixel) == Some(point.pixel);
            // An object that stands nearer would hide some of the disc.
            if gathers && point.clearance.standing >= WIDER * radius(point) {
                let range = &mut ranges[(point.pixel - first) as usize];
                if range.start == range.end {
                    *range = gathering.len()..gathering.len();
                }
                gathering.push(index);
                range.end = gathering.len();
            }
        }
        let source_of = |(index, point): (u32, &VisiblePoint)| {
            let pixel = grid.gathering_pixel(point.pixel).filter(|_| grid.may_interleave(point))?;
            let mut range = ranges.get(pixel.checked_sub(first)? as usize)?.clone();
            if pixel == point.pixel {
                return range.find(|&k| gathering[k] == index);
            }
            let source = |k: usize| &points[gathering[k] as usize];
            let distance = |k| source(k).position.distance(point.position);
            let nearest =
                range.filter(|&k| source(k).is_similar(point)).min_by(|&a, &b| distance(a).total_cmp(&distance(b)))?;
            (f64::from(distance(nearest)) <= MAX_DISTANCE * radius(source(nearest))).then_some(nearest)
        };
        let source = (0..).zip(points).map(source_of).map(|k| k.map(|k| k as u32)).collect();
        Self { gathering, source }
    }
}

impl VisiblePoint {
    /// Whether the same photons count at both points, under about the same normal.
    fn is_similar(&self, other: &Self) -> bool {
        (self.tag, self.photon_bounces) == (other.tag, other.photon_bounces)
            && self.n_side.dot(other.n_side) >= LEAST_COS_OF_NEIGHBOURS
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::testing::visible_point;
    use glam::Vec3;

    fn point(pixel: u32, tag: u32, x: f32) -> VisiblePoint {
        VisiblePoint { pixel, tag, position: Vec3::new(x, 0.0, 0.0), ..visible_point() }
    }

    /// Pixel 0 gathers for pixel 1. Each sees a floor (0), and a wall (8) in a mirror.
    #[test]
    fn pixels_reuse_the_irradiance_of_each_surface_that_both_see() {
        let (floor, wall) = (0, 8);
        let points = [point(0, floor, 0.0), point(0, wall, 5.0), point(1, wall, 5.1), point(1, floor, 0.1)];
        let sources = |points: &[VisiblePoint]| Interleaving::new(InterleavedGrid::new(2, 0), points, |_| 1.0).source;
        assert_eq!(sources(&points), [Some(0), Some(1), Some(1), Some(0)]);
        let far = [points[0], points[1], point(1, wall, 5.4), point(1, floor, 0.1)];
        assert_eq!(sources(&far)[2], None, "a fourth of the radius is the limit");
        let later = [points[0], points[1], VisiblePoint { photon_bounces: 2, ..points[2] }, points[3]];
        assert_eq!(sources(&later)[2], None, "other photons count there");
        let near = [points[0], point(0, floor, 0.2), point(1, floor, 0.15)];
        assert_eq!(sources(&near), [Some(0), Some(1), Some(1)], "the nearest of a pixel's points");
    }
}
