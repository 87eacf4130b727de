//! Interreflection changes little from a pixel to the next. So in each iteration one pixel of four gathers it, and its
//! neighbours take what it found. Which one that is and which neighbours take it changes from iteration to iteration, evenly
//! to all sides: in the mean this blurs by less than a pixel, and shifts nothing.

use super::Rows;
use super::bandwidth::WIDER;
use super::camera_pass::VisiblePoint;

/// A point is shared with others that are nearer than this part of the radius of its disc: the blur that this adds is small
/// beside that of the disc.
const PART_OF_RADIUS: f64 = 0.25;
/// The least cosine between normals of points that share: 2.5 degrees.
const LEAST_COS: f32 = 0.999;
/// Pixels along a side of a square with one pixel that gathers.
const SIDE: u32 = 2;

/// Which points gather for others.
#[derive(Debug, Default)]
pub(super) struct Sharing {
    /// The points that gather for themselves and for others, by their places among all, in their order.
    pub(super) leading: Vec<u32>,
    /// For each point the place in `leading` of the one that gathers for it, or `None` where it gathers for itself
    /// alone.
    pub(super) leader: Vec<Option<u32>>,
}

/// A pixel by its column and row.
type Pixel = (u32, u32);

/// Which pixels gather in an iteration, and for which neighbours.
struct Lattice {
    width: u32,
    /// Columns and rows that gather are those with these remainders.
    remainder: [u32; 2],
    /// Whether others look for one in the next column and row, or in the one before.
    forward: [bool; 2],
}

impl Lattice {
    /// All combinations within 16 iterations.
    fn new(width: u32, iteration: u64) -> Self {
        let bit = |k: u32| (iteration >> k & 1) as u32;
        Self { width, remainder: [bit(0), bit(1)], forward: [bit(2) == 1, bit(3) == 1] }
    }

    /// The remainder of the first row of each square of pixels that share.
    fn first_row(&self) -> u32 {
        // Rows that do not gather look for one in the next row, or in the one before.
        self.remainder[1] ^ u32::from(self.forward[1])
    }

    fn pixel(&self, index: u32) -> Pixel {
        (index % self.width, index / self.width)
    }

    /// The pixel that gathers for this one, perhaps itself; `None` where it lies beyond the film.
    fn leader(&self, index: u32) -> Option<u32> {
        let (column, row) = self.pixel(index);
        let along = |x: u32, axis: usize| match (x % SIDE == self.remainder[axis], self.forward[axis]) {
            (true, _) => Some(x),
            (false, true) => Some(x + 1),
            (false, false) => x.checked_sub(1),
        };
        let (column, row) = (along(column, 0)?, along(row, 1)?);
        (column < self.width).then_some(row * self.width + column)
    }
}

/// Rows of a band, where the film has enough of them for all threads.
const ROWS_OF_BAND: u32 = 16;
/// Bands of a film, so that threads end at about the same time.
const BANDS: u32 = 32;

/// The film in bands of whole rows, which can be rendered apart: none parts pixels that share.
pub(super) fn bands(width: u32, height: u32, iteration: u64) -> Vec<Rows> {
    let rows = height.div_ceil(BANDS).next_multiple_of(SIDE).min(ROWS_OF_BAND);
    let first = Lattice::new(width, iteration).first_row();
    let ends = (1..).map(|k| first + k * rows).take_while(|&end| end < height).chain([height]);
    ends.scan(0, |start, end| Some(std::mem::replace(start, end)..end)).collect()
}

impl Sharing {
    /// Every point gathers for itself alone.
    pub(super) fn none(points: usize) -> Self {
        Self { leading: Vec::new(), leader: vec![None; points] }
    }

    /// For some visible points of a film of this width; `radius` tells that of a point's disc.
    pub(super) fn new(
        width: u32,
        points: &[VisiblePoint],
        iteration: u64,
        radius: impl Fn(&VisiblePoint) -> f64,
    ) -> Self {
        let lattice = Lattice::new(width, iteration);
        let first = points.iter().map(|point| point.pixel).min().unwrap_or(0);
        let last = points.iter().map(|point| point.pixel).max().unwrap_or(0);
        let mut leading = Vec::new();
        let mut place = vec![None; (last - first) as usize + 1];
        for (index, point) in (0..).zip(points) {
            let leads = may_share(point) && lattice.leader(point.pixel) == Some(point.pixel);
            // What stands nearer would hide some of the disc.
            if leads && point.clearance.standing >= WIDER * radius(point) {
                place[(point.pixel - first) as usize] = Some(leading.len() as u32);
                leading.push(index);
            }
        }
        let leader_of = |point: &VisiblePoint| {
            let pixel = lattice.leader(point.pixel).filter(|_| may_share(point))?;
            let place = (*place.get(pixel.checked_sub(first)? as usize)?)?;
            let leader = &points[leading[place as usize] as usize];
            let near = f64::from(leader.position.distance(point.position)) <= PART_OF_RADIUS * radius(leader);
            let alike = leader.tag == point.tag && leader.n_side.dot(point.n_side) >= LEAST_COS;
            (pixel == point.pixel || (near && alike)).then_some(place)
        };
        let leader = points.iter().map(leader_of).collect();
        Self { leading, leader }
    }
}

/// Whether what a point gathers depends on its place alone, not on a normal map.
fn may_share(point: &VisiblePoint) -> bool {
    point.fills_pixel && point.n_shade == point.n_side
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn in_the_mean_pixels_take_from_all_sides_alike() {
        let width = 10;
        let (column, row) = (5, 4);
        let mut sums = [0; 5];
        for iteration in 0..16 {
            let lattice = Lattice::new(width, iteration);
            let leader = lattice.leader(row * width + column).unwrap();
            assert_eq!(lattice.leader(leader), Some(leader), "who gathers for others does so for itself");
            let (x, y) = lattice.pixel(leader);
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
        for (height, iteration) in [1, 2, 7, 64, 255, 300, 2048].into_iter().flat_map(|h| (0..16).map(move |i| (h, i)))
        {
            let (width, lattice) = (3, Lattice::new(3, iteration));
            let bands = bands(width, height, iteration);
            assert!(bands.iter().all(|rows| rows.end <= height && (1..=17).contains(&rows.len())));
            assert_eq!((bands[0].start, bands[bands.len() - 1].end), (0, height));
            assert!(bands.windows(2).all(|pair| pair[0].end == pair[1].start));
            for rows in &bands {
                let leaders = rows.clone().filter_map(|row| lattice.leader(row * width + 1));
                for leader in leaders.map(|leader| leader / width) {
                    assert!(rows.contains(&leader) || leader == height, "{rows:?} {leader}, iteration {iteration}");
                }
            }
        }
    }

    #[test]
    fn beyond_the_film_nobody_gathers() {
        let lattice = |iteration| Lattice::new(4, iteration);
        assert_eq!(lattice(0b0001).leader(0), None, "before the first column");
        assert_eq!(lattice(0b0100).leader(3), None, "after the last column");
        assert_eq!(lattice(0b0001).leader(4), None);
        assert_eq!(lattice(0b0101).leader(4), Some(1), "in the row before");
    }
}
