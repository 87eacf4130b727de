//! Interreflection changes little from a pixel to the next. So in each iteration one pixel of four gathers it, and its
//! neighbours take what it found, also where they see the same surface in a mirror or through glass. Which one that is and
//! which neighbours take it changes from iteration to iteration, evenly to all sides: in the mean this blurs by less than a
//! pixel, and shifts nothing. In a draft it is one of sixteen, and normal maps do not matter.

use super::Rows;
use super::bandwidth::WIDER;
use super::camera_pass::VisiblePoint;

/// A point is shared with others that are nearer than this part of the radius of its disc: the blur that this adds is small
/// beside that of the disc.
const PART_OF_RADIUS: f64 = 0.25;
/// The least cosine between normals of points that share: 2.5 degrees.
const LEAST_COS: f32 = 0.999;
/// Pixels along a side of a square with one pixel that gathers: in iterations, and in drafts.
const SIDE: u32 = 2;
const DRAFT_SIDE: u32 = 4;
/// Rows of a band, where the film has enough of them for all threads.
const ROWS_OF_BAND: u32 = 16;
/// Bands of a film, so that threads end at about the same time.
const BANDS: u32 = 32;

/// Which points gather for others.
#[derive(Debug, Default)]
pub(super) struct Sharing {
    /// The points that gather for themselves and for others, by their places among all, in their order.
    pub(super) leading: Vec<u32>,
    /// For each point the place in `leading` of the one that gathers for it, or `None` where it gathers for itself
    /// alone.
    pub(super) leader: Vec<Option<u32>>,
}

/// Which pixels gather, and for which neighbours: the film in squares, with one that gathers in each.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lattice {
    width: u32,
    side: u32,
    /// By how many columns and rows the first squares stand out of the film.
    shift: [u32; 2],
    /// Column and row in each square of the one that gathers.
    place: [u32; 2],
    is_draft: bool,
}

impl Lattice {
    /// All combinations within 16 iterations.
    pub(super) fn new(width: u32, iteration: u64) -> Self {
        let bit = |k: u32| (iteration >> k & 1) as u32;
        Self { width, side: SIDE, shift: [bit(0), bit(1)], place: [bit(2), bit(3)], is_draft: false }
    }

    /// That of a draft.
    pub(super) fn draft(width: u32) -> Self {
        Self { width, side: DRAFT_SIDE, shift: [0; 2], place: [DRAFT_SIDE / 2; 2], is_draft: true }
    }

    /// The pixel that gathers for this one, perhaps itself; `None` where it lies beyond the film.
    fn leader(&self, pixel: u32) -> Option<u32> {
        let along = |x: u32, axis: usize| {
            let start = (x + self.shift[axis]) / self.side * self.side;
            (start + self.place[axis]).checked_sub(self.shift[axis])
        };
        let (column, row) = (along(pixel % self.width, 0)?, along(pixel / self.width, 1)?);
        (column < self.width).then_some(row * self.width + column)
    }

    /// The film in bands of whole rows, which can be rendered apart: none parts a square.
    pub(super) fn bands(&self, height: u32) -> Vec<Rows> {
        let rows = height.div_ceil(BANDS).next_multiple_of(self.side).min(ROWS_OF_BAND);
        let first = (self.side - self.shift[1]) % self.side;
        let ends = (1..).map(|k| first + k * rows).take_while(|&end| end < height).chain([height]);
        ends.scan(0, |start, end| Some(std::mem::replace(start, end)..end)).collect()
    }

    /// Whether what a point gathers depends on its place alone.
    fn may_share(&self, point: &VisiblePoint) -> bool {
        self.is_draft || (point.n_shade == point.n_side && point.facets == 0)
    }
}

impl Sharing {
    /// Every point gathers for itself alone.
    pub(super) fn none(points: usize) -> Self {
        Self { leading: Vec::new(), leader: vec![None; points] }
    }

    /// For some visible points, those of a pixel one after the other; `radius` tells that of a point's disc.
    pub(super) fn new(lattice: Lattice, points: &[VisiblePoint], radius: impl Fn(&VisiblePoint) -> f64) -> Self {
        let first = points.iter().map(|point| point.pixel).min().unwrap_or(0);
        let last = points.iter().map(|point| point.pixel).max().unwrap_or(0);
        let mut leading = Vec::new();
        // Of each pixel, in `leading`.
        let mut places = vec![0..0; (last - first) as usize + 1];
        for (index, point) in (0..).zip(points) {
            let leads = lattice.may_share(point) && lattice.leader(point.pixel) == Some(point.pixel);
            // What stands nearer would hide some of the disc.
            if leads && point.clearance.standing >= WIDER * radius(point) {
                let places = &mut places[(point.pixel - first) as usize];
                if places.start == places.end {
                    *places = leading.len()..leading.len();
                }
                leading.push(index);
                places.end = leading.len();
            }
        }
        let leader_of = |(index, point): (u32, &VisiblePoint)| {
            let pixel = lattice.leader(point.pixel).filter(|_| lattice.may_share(point))?;
            let mut places = places.get(pixel.checked_sub(first)? as usize)?.clone();
            if pixel == point.pixel {
                return places.find(|&place| leading[place] == index);
            }
            let leader = |place: usize| &points[leading[place] as usize];
            let distance = |place| leader(place).position.distance(point.position);
            let nearest = places
                .filter(|&place| leader(place).is_alike(point))
                .min_by(|&a, &b| distance(a).total_cmp(&distance(b)))?;
            (f64::from(distance(nearest)) <= PART_OF_RADIUS * radius(leader(nearest))).then_some(nearest)
        };
        let leader = (0..).zip(points).map(leader_of).map(|place| place.map(|place| place as u32)).collect();
        Self { leading, leader }
    }
}

impl VisiblePoint {
    /// Whether the same photons count here, and their light falls in alike.
    fn is_alike(&self, other: &Self) -> bool {
        (self.tag, self.photon_bounces) == (other.tag, other.photon_bounces)
            && self.n_side.dot(other.n_side) >= LEAST_COS
    }
}

#[cfg(test)]
mod tests {
    use super::super::camera_pass::Clearance;
    use super::*;
    use crate::math::Rgb;
    use crate::world::{Lobe, Scattering};
    use glam::{DVec2, Vec3};

    #[test]
    fn in_the_mean_pixels_take_from_all_sides_alike() {
        let width = 10;
        let (column, row) = (5, 4);
        let mut sums = [0; 5];
        for iteration in 0..16 {
            let lattice = Lattice::new(width, iteration);
            let leader = lattice.leader(row * width + column).unwrap();
            assert_eq!(lattice.leader(leader), Some(leader), "who gathers for others does so for itself");
            let (x, y) = (leader % width, leader / width);
            let (x, y) = (x as i32 - column as i32, y as i32 - row as i32);
            for (sum, term) in sums.iter_mut().zip([x, y, x * x, y * y, x * y]) {
                *sum += term;
            }
        }
        // A tent: itself half of the time, each neighbour a quarter of it.
        assert_eq!(sums, [0, 0, 8, 8, 0]);
    }

    #[test]
    fn bands_cover_the_film_and_part_no_pixels_that_share() {
        let width = 3;
        let lattices: Vec<Lattice> = (0..16).map(|i| Lattice::new(width, i)).chain([Lattice::draft(width)]).collect();
        for (height, lattice) in
            [1, 2, 7, 64, 255, 300, 2048].into_iter().flat_map(|h| lattices.iter().map(move |l| (h, l)))
        {
            let bands = lattice.bands(height);
            assert!(
                bands.iter().all(|rows| rows.end <= height && (1..=ROWS_OF_BAND + 1).contains(&(rows.len() as u32)))
            );
            assert_eq!((bands[0].start, bands[bands.len() - 1].end), (0, height));
            assert!(bands.windows(2).all(|pair| pair[0].end == pair[1].start));
            for rows in &bands {
                let leaders = rows.clone().filter_map(|row| lattice.leader(row * width + 1));
                for leader in leaders.map(|leader| leader / width) {
                    assert!(rows.contains(&leader) || leader >= height, "{rows:?} {leader}, {lattice:?}");
                }
            }
        }
    }

    fn point(pixel: u32, tag: u32, x: f32) -> VisiblePoint {
        VisiblePoint {
            pixel,
            position: Vec3::new(x, 0.0, 0.0),
            n_side: Vec3::Y,
            n_shade: Vec3::Y,
            wo: Vec3::Y,
            throughput: Rgb::ONE,
            scattering: Scattering { albedo: Rgb::ONE, lobe: Lobe::None },
            footprint: 0.1,
            clearance: Clearance { any: f64::INFINITY, standing: f64::INFINITY },
            primitive: 0,
            uv: DVec2::ZERO,
            tag,
            photon_bounces: 3,
            mean_albedo: Rgb::ONE,
            spread: 0.0,
            first_facet: 0,
            facets: 0,
            seen_directly: true,
            on_an_edge: false,
            blur: 0.0,
        }
    }

    /// Pixel 0 gathers for pixel 1. Each sees a floor (0), and a wall (8) in a mirror.
    #[test]
    fn pixels_share_each_surface_that_both_see() {
        let (floor, wall) = (0, 8);
        let points = [point(0, floor, 0.0), point(0, wall, 5.0), point(1, wall, 5.1), point(1, floor, 0.1)];
        let shared = |points: &[VisiblePoint]| Sharing::new(Lattice::new(2, 0), points, |_| 1.0).leader;
        assert_eq!(shared(&points), [Some(0), Some(1), Some(1), Some(0)]);
        let far = [points[0], points[1], point(1, wall, 5.4), point(1, floor, 0.1)];
        assert_eq!(shared(&far)[2], None, "a fourth of the radius is the limit");
        let later = [points[0], points[1], VisiblePoint { photon_bounces: 2, ..points[2] }, points[3]];
        assert_eq!(shared(&later)[2], None, "other photons count there");
        let near = [points[0], point(0, floor, 0.2), point(1, floor, 0.15)];
        assert_eq!(shared(&near), [Some(0), Some(1), Some(1)], "the nearest of a pixel's points");
    }

    #[test]
    fn beyond_the_film_nobody_gathers() {
        // Bits: columns and rows of the shift, then of the place.
        let lattice = |iteration| Lattice::new(4, iteration);
        assert_eq!(lattice(0b0001).leader(0), None, "before the first column");
        assert_eq!(lattice(0b0101).leader(3), None, "after the last column");
        assert_eq!(lattice(0b0001).leader(4), None);
        assert_eq!(lattice(0b0001).leader(5), Some(1), "in the row before");
    }
}
