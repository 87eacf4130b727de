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
/// Pixels along a side of a cell. In each iteration one of a cell's pixels is measured, which stands for all.
const CELL: u32 = 2;
/// The photons of all iterations are one sequence of low discrepancy: so much smaller than for independent ones is the
/// variance of their mean, as far as it matters for the best radius. Measured: with 0.25 and with 1 the error of
/// boxes with and without mirrors and glass is greater or takes more time.
const EVENNESS: f64 = 0.5;
/// The signal is the mean over a square of this many cells to each side: on single cells noise hides it.
const SIGNAL_REACH: usize = 2;
/// Radii are smoothed over a square of this many cells to each side.
const RADIUS_REACH: usize = 1;
/// The least and the greatest step: a wrong one is mended after the next measurement.
const STEP: std::ops::RangeInclusive<f64> = 0.5..=2.0;

/// By what factor discs of a map may grow beyond those of a full first iteration. What mirrors and glass focused begins with
/// small ones, because it may be sharp; most of it is not.
pub(super) fn most_growth(kind: MapKind) -> f64 {
    match kind {
        MapKind::Caustic | MapKind::Global => 1.0,
        MapKind::Focused => 3.0,
    }
}

/// The film in cells of a few pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Cells {
    width: u32,
    columns: u32,
    rows: u32,
}

impl Cells {
    fn new(width: u32, height: u32) -> Self {
        Self { width, columns: width.div_ceil(CELL), rows: height.div_ceil(CELL) }
    }

    fn count(&self) -> usize {
        self.columns as usize * self.rows as usize
    }

    /// The cell of a pixel.
    fn at(&self, pixel: u32) -> usize {
        let (x, y) = (pixel % self.width / CELL, pixel / self.width / CELL);
        y as usize * self.columns as usize + x as usize
    }

    /// Means over squares of `2 reach + 1` cells a side, as far as they lie on the film.
    fn blurred(&self, values: &[f64], reach: usize) -> Vec<f64> {
        let columns = self.columns as usize;
        let along = |values: &[f64], stride: usize, len: usize, index: usize| {
            let at = index / stride % len;
            let (first, last) = (at.saturating_sub(reach), (at + reach).min(len - 1));
            let start = index - at * stride;
            (first..=last).map(|k| values[start + k * stride]).sum::<f64>() / (last - first + 1) as f64
        };
        let rows: Vec<f64> = (0..values.len()).map(|k| along(values, 1, columns, k)).collect();
        (0..rows.len()).map(|k| along(&rows, columns, self.rows as usize, k)).collect()
    }
}

/// Sums over the contrasts of a cell.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    count: u32,
    contrast: f64,
    squares: f64,
}

impl Sums {
    fn mean(&self) -> f64 {
        self.contrast / f64::from(self.count.max(1))
    }

    /// Of a single contrast; 0 where there are less than two.
    fn variance(&self) -> f64 {
        let squares = (self.squares - self.contrast * self.mean()).max(0.0);
        squares / f64::from(self.count.saturating_sub(1).max(1))
    }

    /// The square of the expected contrast: that of the mean, less what noise adds to it; negative by chance.
    fn signal(&self) -> f64 {
        self.mean().powi(2) - self.variance() / f64::from(self.count.max(1))
    }
}

/// The contrasts that some iterations measured: how much brighter pixels are in wider discs.
#[derive(Clone, Debug)]
pub(super) struct Contrasts {
    cells: Cells,
    sums: PerMap<Vec<Sums>>,
}

impl Contrasts {
    /// None yet, for a film of this size.
    pub(super) fn new(width: u32, height: u32) -> Self {
        let cells = Cells::new(width, height);
        Self { cells, sums: PerMap::from_fn(|_| vec![Sums::default(); cells.count()]) }
    }

    /// Whether a pixel of a film of this width is the one that is measured in its cell in an iteration.
    pub(super) fn includes(width: u32, pixel: u32, iteration: u64) -> bool {
        let (x, y) = (pixel % width % CELL, pixel / width % CELL);
        schedule::measures(iteration) && u64::from(y * CELL + x) == iteration % u64::from(CELL * CELL)
    }

    /// Adds what an iteration measured, a contrast for each pixel of the film.
    pub(super) fn add(&mut self, iteration: u64, contrasts: &[PerMap<f32>]) {
        for (pixel, contrast) in (0..).zip(contrasts) {
            if Self::includes(self.cells.width, pixel, iteration) {
                for kind in MapKind::ALL {
                    let sums = &mut self.sums[kind][self.cells.at(pixel)];
                    sums.count += 1;
                    sums.contrast += f64::from(contrast[kind]);
                    sums.squares += f64::from(contrast[kind]).powi(2);
                }
            }
        }
    }

    /// The mean square of the bias, over pixels and channels, as far as it goes with the square of the radius and is the same for
    /// all channels; 0 where noise hides it.
    pub(super) fn squared_bias(&self) -> f64 {
        let measured = MapKind::ALL.iter().flat_map(|&kind| &self.sums[kind]).filter(|sums| sums.count > 1);
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
}

impl Bandwidth {
    /// The best one for a mean of `total` full iterations, by the contrasts that were measured when the factor of each
    /// cell for each map was what `measured_at` says.
    fn best(contrasts: &Contrasts, total: f64, measured_at: impl Fn(MapKind, usize) -> f64) -> Self {
        let cells = contrasts.cells;
        let factors = PerMap::from_fn(|kind| {
            best_factors(cells, &contrasts.sums[kind], most_growth(kind), total, |c| measured_at(kind, c))
        });
        Self { cells, factors }
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

    /// The mean of a map's factors.
    pub(super) fn mean(&self, kind: MapKind) -> f64 {
        let factors = &self.factors[kind];
        factors.iter().map(|&factor| f64::from(factor)).sum::<f64>() / factors.len() as f64
    }
}

/// The factor of each cell, at most `most`, for a mean of `total` full iterations.
fn best_factors(cells: Cells, sums: &[Sums], most: f64, total: f64, measured_at: impl Fn(usize) -> f64) -> Vec<f32> {
    let blurred = |of: fn(&Sums) -> f64| cells.blurred(&sums.iter().map(of).collect::<Vec<f64>>(), SIGNAL_REACH);
    let (signals, variances) = (blurred(Sums::signal), blurred(Sums::variance));
    // x^6 = v / (2 N b^2), with v and b^2 from the contrast's variance and signal.
    let scale = EVENNESS * WIDER.powi(4) / (2.0 * total);
    let step = |signal: f64, variance: f64| {
        if variance == 0.0 {
            return 1.0;
        }
        let best = if signal > 0.0 { (scale * variance / signal).powf(1.0 / 6.0) } else { f64::INFINITY };
        best.clamp(*STEP.start(), *STEP.end())
    };
    let logarithms: Vec<f64> = (0..cells.count())
        .map(|cell| (measured_at(cell) * step(signals[cell], variances[cell])).min(most).ln())
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
            let all: Vec<PerMap<f32>> =
                (0..u64::from(SIZE * SIZE)).map(|pixel| PerMap::from_fn(|_| contrast(pixel) as f32)).collect();
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
        // In each of three maps a bias of 0.6, summed over channels: 0.2 in each of these.
        let bias = measured(64, 0.6 * (WIDER.powi(2) - 1.0), 0.5).squared_bias();
        assert!((bias / (3.0 * 0.04) - 1.0).abs() < 0.05, "{bias}");
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

    #[test]
    fn each_pixel_is_measured_in_turn_on_films_of_any_size() {
        for (width, height) in [(1, 1), (5, 3), (4, 4)] {
            let mut contrasts = Contrasts::new(width, height);
            let pixels = (width * height) as usize;
            (8..12).for_each(|iteration| contrasts.add(iteration, &vec![PerMap::from_fn(|_| 1.0); pixels]));
            assert_eq!(contrasts.sums[KIND].iter().map(|s| s.count).sum::<u32>(), width * height);
            assert!((0..width * height).all(|p| Bandwidth::first(&contrasts, 8.0, 1.0).at(KIND, p) <= 1.0));
        }
    }
}
