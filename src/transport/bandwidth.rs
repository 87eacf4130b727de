//! Radii of density estimates by what iterations measured: small where light changes within a disc, else large.
//!
//! A wider disc over the same photons tells the bias. With the Epanechnikov kernel, discs of the radii `r` and `w r`
//! give estimates that differ by `(w^2 - 1) b` in the mean, where `b ~ r^2` is the bias of the narrower one, and the
//! variance of this contrast is `(1 - 1 / w^2)^2 v`, where `v ~ 1 / r^2` is the variance of the narrower one. The squared
//! error of a mean of `N` iterations with the radius `x r` is `x^4 b^2 + v / (N x^2)`; it is least where
//! `x^6 = v / (2 N b^2)` (compare \[KD13\], who measure the Laplacian).

use super::maps::{MapKind, PerMap};
use super::schedule;

/// How much wider the other disc is.
pub(super) const WIDER: f64 = 1.5;
/// Pixels along a side of a cell. One of a cell's pixels is measured and stands for all, the same until radii are chosen
/// anew: what differs between pixels would count as noise, and hide what is sharp.
const CELL: u32 = 2;
/// The photons of all iterations are one sequence of low discrepancy: so much smaller than for independent ones is the
/// variance of their mean, as far as it matters for the best radius. Measured: with 0.25 and with 1 the error of
/// boxes with and without mirrors and glass is greater or takes more time.
const EVENNESS: f64 = 0.5;
/// The signal is the mean over a square of this many cells to each side: on single cells noise hides it.
const SIGNAL_REACH: usize = 2;
/// Radii are smoothed over a square of this many cells to each side.
const RADIUS_REACH: usize = 1;
/// Discs count as large only where they are so in this many cells to each side: beside something sharp they are not
/// trusted. Measured: else a mirror's and a glass ball's caustics have 1.2 to 2.6 times the error at their edges.
const TRUST_REACH: usize = 3;
/// The least and the greatest step: a wrong one is mended after the next measurement.
const STEP: std::ops::RangeInclusive<f64> = 0.5..=2.0;

/// By what factor discs of a map may grow beyond those of a full first iteration. What mirrors and glass focused begins with
/// small ones, because it may be sharp; most of it is not.
pub(super) fn most_growth(kind: MapKind) -> f64 {
    match kind {
        MapKind::Global | MapKind::Glossy => 1.0,
        MapKind::Caustic | MapKind::Focused => 3.0,
    }
}

/// How much brighter a pixel is in wider discs, summed over channels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Contrast {
    /// By the photons of each map.
    pub maps: PerMap<f32>,
    /// Variance of that by the map of caustics, as far as it is by chance how many photons there are. Where a caustic is
    /// sharp, contrasts differ more by the places in the pixel that they are measured at.
    pub caustic_noise: f32,
    /// By the photons of those maps that the picture shows here.
    pub picture: f32,
}

impl Contrast {
    /// Whether it is a number.
    pub(super) fn is_finite(&self) -> bool {
        let maps = MapKind::ALL.map(|kind| self.maps[kind]);
        maps.into_iter().chain([self.caustic_noise, self.picture]).all(f32::is_finite)
    }
}

impl std::ops::AddAssign for Contrast {
    fn add_assign(&mut self, other: Self) {
        MapKind::ALL.into_iter().for_each(|kind| self.maps[kind] += other.maps[kind]);
        self.caustic_noise += other.caustic_noise;
        self.picture += other.picture;
    }
}

/// The film in cells of a few pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Cells {
    width: u32,
    height: u32,
    columns: u32,
    rows: u32,
}

impl Cells {
    fn new(width: u32, height: u32) -> Self {
        Self { width, height, columns: width.div_ceil(CELL), rows: height.div_ceil(CELL) }
    }

    fn count(&self) -> usize {
        self.columns as usize * self.rows as usize
    }

    /// The cell of a pixel.
    fn at(&self, pixel: u32) -> usize {
        let (x, y) = (pixel % self.width / CELL, pixel / self.width / CELL);
        y as usize * self.columns as usize + x as usize
    }

    /// The pixel of a cell that is measured in an iteration.
    fn measured(&self, cell: usize, iteration: u64) -> u32 {
        let (x, y) = (CELL * (cell as u32 % self.columns), CELL * (cell as u32 / self.columns));
        // At the film's edge a cell may have fewer pixels.
        let (columns, rows) = (CELL.min(self.width - x), CELL.min(self.height - y));
        let turn = schedule::refinements_before(iteration) % (columns * rows);
        (y + turn / columns) * self.width + x + turn % columns
    }

    /// For each cell what the function makes of the values of a square of `2 reach + 1` cells a side, as far as they lie on the
    /// film: of those of each row, and of what it makes of the rows.
    fn of_squares<T: Copy>(
        &self,
        values: &[T],
        reach: usize,
        of: impl Fn(&mut dyn ExactSizeIterator<Item = T>) -> T,
    ) -> Vec<T> {
        let columns = self.columns as usize;
        let along = |values: &[T], stride: usize, len: usize, index: usize| {
            let at = index / stride % len;
            let near = at.saturating_sub(reach)..(at + reach + 1).min(len);
            let start = index - at * stride;
            of(&mut near.map(|k| values[start + k * stride]))
        };
        let rows: Vec<T> = (0..values.len()).map(|k| along(values, 1, columns, k)).collect();
        (0..rows.len()).map(|k| along(&rows, columns, self.rows as usize, k)).collect()
    }

    /// Their means.
    fn blurred(&self, values: &[f64], reach: usize) -> Vec<f64> {
        self.of_squares(values, reach, |near| {
            let count = near.len() as f64;
            near.sum::<f64>() / count
        })
    }

    /// The least of them.
    fn least(&self, values: &[f32], reach: usize) -> Vec<f32> {
        self.of_squares(values, reach, |near| near.fold(f32::INFINITY, f32::min))
    }
}

/// Sums over the contrasts of a cell.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    count: u32,
    contrast: f64,
    squares: f64,
    /// Of the part of their variances that a wider disc makes less, where that is known apart: for caustics.
    known_noise: Option<f64>,
}

impl Sums {
    fn add(&mut self, contrast: f32) {
        self.count += 1;
        self.contrast += f64::from(contrast);
        self.squares += f64::from(contrast).powi(2);
    }

    fn mean(&self) -> f64 {
        self.contrast / f64::from(self.count.max(1))
    }

    /// Of a single contrast; 0 where there are less than two.
    fn variance(&self) -> f64 {
        let squares = (self.squares - self.contrast * self.mean()).max(0.0);
        squares / f64::from(self.count.saturating_sub(1).max(1))
    }

    /// The part of this that a wider disc makes less.
    fn noise(&self) -> f64 {
        self.known_noise.map_or_else(|| self.variance(), |sum| sum / f64::from(self.count.max(1)))
    }

    /// The square of the expected contrast: that of the mean, less what noise adds to it; negative by chance.
    fn signal(&self) -> f64 {
        self.mean().powi(2) - self.noise() / f64::from(self.count.max(1))
    }
}

/// The contrasts that iterations with the same radii measured.
#[derive(Clone, Debug)]
pub(super) struct Contrasts {
    cells: Cells,
    maps: PerMap<Vec<Sums>>,
    picture: Vec<Sums>,
}

impl Contrasts {
    /// None yet, for a film of this size.
    pub(super) fn new(width: u32, height: u32) -> Self {
        let cells = Cells::new(width, height);
        let none = || vec![Sums::default(); cells.count()];
        Self { cells, maps: PerMap::from_fn(|_| none()), picture: none() }
    }

    /// Whether a pixel of a film of this size is the one that is measured in its cell in an iteration.
    pub(super) fn includes([width, height]: [u32; 2], pixel: u32, iteration: u64) -> bool {
        let cells = Cells::new(width, height);
        schedule::measures(iteration) && cells.measured(cells.at(pixel), iteration) == pixel
    }

    /// Adds what an iteration measured, a contrast for each pixel of the film.
    pub(super) fn add(&mut self, iteration: u64, contrasts: &[Contrast]) {
        if !schedule::measures(iteration) {
            return;
        }
        for cell in 0..self.cells.count() {
            let contrast = contrasts[self.cells.measured(cell, iteration) as usize];
            MapKind::ALL.into_iter().for_each(|kind| self.maps[kind][cell].add(contrast.maps[kind]));
            *self.maps[MapKind::Caustic][cell].known_noise.get_or_insert(0.0) += f64::from(contrast.caustic_noise);
            self.picture[cell].add(contrast.picture);
        }
    }

    /// The mean square of the bias, over pixels and channels, as far as it goes with the square of the radius and is the same for
    /// all channels; 0 where noise hides it.
    pub(super) fn squared_bias(&self) -> f64 {
        let measured = self.picture.iter().filter(|sums| sums.count > 1);
        let contrast = measured.map(Sums::signal).sum::<f64>() / self.cells.count() as f64;
        // A contrast is summed over channels.
        contrast.max(0.0) / (WIDER.powi(2) - 1.0).powi(2) / 9.0
    }
}

/// By what radii have shrunk in each part of the film.
#[derive(Clone, Debug)]
pub struct Bandwidth {
    cells: Cells,
    factors: PerMap<Vec<f32>>,
    /// The least factor of the map of caustics near each cell.
    least_caustic: Vec<f32>,
}

impl Bandwidth {
    /// The best one for a mean of `total` full iterations, by the contrasts that were measured when the factor of each
    /// cell for each map was what `measured_at` says.
    fn best(contrasts: &Contrasts, total: f64, measured_at: impl Fn(MapKind, usize) -> f64 + Sync) -> Self {
        let cells = contrasts.cells;
        let of = |kind| best_factors(cells, &contrasts.maps[kind], most_growth(kind), total, |c| measured_at(kind, c));
        let factors = PerMap::in_parallel(&of);
        let least_caustic = cells.least(&factors[MapKind::Caustic], TRUST_REACH);
        Self { cells, factors, least_caustic }
    }

    /// The first one, by iterations whose radii had shrunk by `shrink` everywhere.
    pub(super) fn first(contrasts: &Contrasts, total: f64, shrink: f64) -> Self {
        Self::best(contrasts, total, |_, _| shrink)
    }

    /// The next one, by iterations that had this one.
    pub(super) fn next(&self, contrasts: &Contrasts, total: f64) -> Self {
        Self::best(contrasts, total, |kind, cell| f64::from(self.factors[kind][cell]))
    }

    /// The factor of a pixel for a map.
    pub(super) fn at(&self, kind: MapKind, pixel: u32) -> f64 {
        f64::from(self.factors[kind][self.cells.at(pixel)])
    }

    /// The least factor of the map of caustics near a pixel.
    pub(super) fn least_caustic_near(&self, pixel: u32) -> f64 {
        f64::from(self.least_caustic[self.cells.at(pixel)])
    }

    /// The greatest of these.
    pub(super) fn greatest_least_caustic(&self) -> f64 {
        f64::from(self.least_caustic.iter().copied().fold(0.0, f32::max))
    }

    /// The mean of a map's factors.
    pub(super) fn mean(&self, kind: MapKind) -> f64 {
        let factors = &self.factors[kind];
        factors.iter().map(|&factor| f64::from(factor)).sum::<f64>() / factors.len() as f64
    }
}

/// The factor of each cell, at most `most`, for a mean of `total` full iterations.
fn best_factors(cells: Cells, sums: &[Sums], most: f64, total: f64, measured_at: impl Fn(usize) -> f64) -> Vec<f32> {
    let blurred = |of: fn(&Sums) -> f64| cells.blurred(&sums.iter().map(of).collect::<Vec<f64>>(), SIGNAL_REACH);
    let (signals, variances) = (blurred(Sums::signal), blurred(Sums::noise));
    // What differs more than photons do by chance differs by places in the pixel, and so is sharp. Twice their noise may still be
    // chance: one path may leave several photons.
    let differences = blurred(|sums| sums.variance() - 2.0 * sums.noise());
    // x^6 = v / (2 N b^2), with v and b^2 from the contrast's variance and signal.
    let scale = EVENNESS * WIDER.powi(4) / (2.0 * total);
    let step = |signal: f64, variance: f64| {
        // Without photons, or a map, nothing is known.
        if variance == 0.0 && signal == 0.0 {
            return 1.0;
        }
        let best = if signal > 0.0 { (scale * variance / signal).powf(1.0 / 6.0) } else { f64::INFINITY };
        best.clamp(*STEP.start(), *STEP.end())
    };
    let logarithms: Vec<f64> = (0..cells.count())
        .map(|cell| {
            (measured_at(cell) * step(signals[cell].max(0.0) + differences[cell].max(0.0), variances[cell]))
                .min(most)
                .ln()
        })
        .collect();
    cells.blurred(&logarithms, RADIUS_REACH).into_iter().map(|x| x.exp() as f32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Sampler, Stream};

    const SIZE: u32 = 40;
    const KIND: MapKind = MapKind::Global;

    /// Contrasts of `n` iterations with this mean and standard deviation.
    fn measured(n: u64, mean: f64, deviation: f64) -> Contrasts {
        let mut contrasts = Contrasts::new(SIZE, SIZE);
        for iteration in 8..8 + n {
            let noise = |pixel| Sampler::new(1, Stream::Test, pixel, iteration).next_1d() - 0.5;
            let contrast = |pixel| mean + deviation * 12f64.sqrt() * noise(pixel);
            let all: Vec<Contrast> = (0..u64::from(SIZE * SIZE))
                .map(|pixel| contrast(pixel) as f32)
                .map(|x| Contrast {
                    maps: PerMap::from_fn(|_| x),
                    picture: x,
                    caustic_noise: (deviation * deviation) as f32,
                })
                .collect();
            contrasts.add(iteration, &all);
        }
        contrasts
    }

    #[test]
    fn balances_bias_and_noise() {
        let (bias, noise, n) = (0.5, 2.0, 4096);
        let contrasts = measured(n, (WIDER.powi(2) - 1.0) * bias, (1.0 - WIDER.powi(-2)) * noise);
        for total in [4.0, 32.0] {
            let expected = 0.5 * (EVENNESS * noise * noise / (2.0 * total * bias * bias)).powf(1.0 / 6.0);
            let bandwidth = Bandwidth::first(&contrasts, total, 0.5);
            let pixels = 0..SIZE * SIZE;
            assert!(pixels.clone().all(|p| (bandwidth.at(KIND, p) / expected - 1.0).abs() < 0.05), "{expected}");
        }
    }

    #[test]
    fn contrasts_tell_the_bias_of_the_picture() {
        // A bias of 0.6, summed over channels: 0.2 in each of these.
        let bias = measured(64, 0.6 * (WIDER.powi(2) - 1.0), 0.5).squared_bias();
        assert!((bias / 0.04 - 1.0).abs() < 0.05, "{bias}");
        let noise = measured(64, 0.0, 0.5).squared_bias();
        assert!((0.0..1e-3).contains(&noise), "{noise}");
        assert_eq!(measured(1, 1.0, 0.0).squared_bias(), 0.0, "once is not enough to tell bias from noise");
    }

    #[test]
    fn steps_are_bounded() {
        let steady = Bandwidth::first(&measured(16, 1.0, 0.01), 16.0, 0.8);
        assert!((steady.at(KIND, 0) - 0.4).abs() < 1e-6, "{}", steady.at(KIND, 0));
        let next = steady.next(&measured(16, 1.0, 0.01), 32.0);
        assert!((next.at(KIND, 0) - 0.2).abs() < 1e-6, "{}", next.at(KIND, 0));
        let none = Bandwidth::first(&Contrasts::new(SIZE, SIZE), 16.0, 0.7);
        assert!((none.at(KIND, 99) - 0.7).abs() < 1e-6, "unmeasured");
    }

    /// Where there is no bias discs grow, on the whole, but never beyond those of the first iteration.
    #[test]
    fn noise_alone_does_not_shrink_discs() {
        let mut bandwidth = Bandwidth::first(&measured(16, 0.0, 1.0), 16.0, 0.8);
        for octave in 5..9 {
            bandwidth = bandwidth.next(&measured(1 << (octave - 1), 0.0, 1.0), f64::from(1 << octave));
        }
        assert!(bandwidth.mean(KIND) > 0.75, "{}", bandwidth.mean(KIND));
        assert!((0..SIZE * SIZE).all(|p| bandwidth.at(KIND, p) <= 1.0));
    }

    /// A bright line of one pixel: its neighbours are brighter in wider discs, it is darker.
    #[test]
    fn what_is_sharp_shrinks_discs_and_is_not_trusted_around() {
        let mut contrasts = Contrasts::new(SIZE, SIZE);
        let contrast = |pixel: u32| match pixel % SIZE {
            20 => -4.0,
            19 | 21 => 2.0,
            _ => 0.0,
        };
        for iteration in 9..=16 {
            let noise = |pixel| Sampler::new(1, Stream::Test, u64::from(pixel), iteration).next_1d() as f32 - 0.5;
            let all = (0..SIZE * SIZE).map(|pixel| {
                let x = contrast(pixel) + noise(pixel);
                Contrast { maps: PerMap::from_fn(|_| x), caustic_noise: 1.0 / 12.0, picture: x }
            });
            contrasts.add(iteration, &all.collect::<Vec<_>>());
        }
        let bandwidth = Bandwidth::first(&contrasts, 16.0, 0.8);
        let at = |x| bandwidth.at(MapKind::Caustic, 20 * SIZE + x);
        assert!(at(20) < 0.5 && at(4) > 0.8, "{} {}", at(20), at(4));
        let least = |x| bandwidth.least_caustic_near(20 * SIZE + x);
        assert!(least(13) < 0.6 && least(27) < 0.6 && least(4) > 0.8, "{} {} {}", least(13), least(27), least(4));
    }

    /// Places in the pixel that differ are no noise, which a wider disc would make less.
    #[test]
    fn what_differs_by_places_in_the_pixel_shrinks_discs_of_caustics() {
        let mut contrasts = measured(16, 0.0, 1.0);
        let quiet = Bandwidth::first(&contrasts, 16.0, 0.8).at(MapKind::Caustic, 0);
        for sums in &mut contrasts.maps[MapKind::Caustic] {
            sums.known_noise = sums.known_noise.map(|noise| 0.01 * noise);
        }
        let sharp = Bandwidth::first(&contrasts, 16.0, 0.8).at(MapKind::Caustic, 0);
        assert!(sharp < 0.6 * quiet, "{sharp} {quiet}");
    }

    #[test]
    fn one_pixel_of_each_cell_is_measured_until_radii_are_chosen_anew_then_the_next() {
        for (width, height) in [(1, 1), (5, 3), (4, 4), (64, 1)] {
            let cells = Cells::new(width, height);
            let mut turns = vec![0; (width * height) as usize];
            for octave in 1..=4 {
                let mut contrasts = Contrasts::new(width, height);
                let iterations = (1 << octave) + 1..=(2 << octave);
                let count = iterations.clone().count() as u32;
                iterations.for_each(|i| contrasts.add(i, &vec![Contrast::default(); turns.len()]));
                assert!(
                    contrasts.maps[KIND].iter().all(|sums| sums.count == count),
                    "octave {octave} of {width} x {height}"
                );
                for (pixel, turns) in (0..).zip(&mut turns) {
                    *turns += u32::from(Contrasts::includes([width, height], pixel, 2 << octave));
                }
            }
            // 1, 2 or 4 pixels share four octaves.
            assert!(turns.iter().all(|&n| [1, 2, 4].contains(&n)), "{turns:?}");
            assert_eq!(turns.iter().sum::<u32>() as usize, 4 * cells.count());
        }
    }
}
