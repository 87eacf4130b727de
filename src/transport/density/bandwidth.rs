//! Bandwidth selection: radii of density estimates by the bias and variance that iterations measured.
//!
//! A wider disc over the same photons tells the bias. With the Epanechnikov kernel, discs of the radii `r` and `lambda r` give estimates
//! whose difference has the mean `(lambda^2 - 1) b` and the variance `(1 - 1 / lambda^2)^2 v`, where `b ~ r^2` is the bias and
//! `v ~ 1 / r^2` the variance of the estimate in the narrower disc. The squared error of a mean of `N` iterations with the radius
//! `gamma r` is `gamma^4 b^2 + v / (N gamma^2)`; it is least where `gamma^6 = v / (2 N b^2)` (compare \[KD13\], who measure the Laplacian).

use super::cells::Cells;
use super::schedule;
use crate::transport::photons::{MapKind, PerMap};
use serde::{Deserialize, Serialize};

/// Radius of the wider disc over that of the narrower one: lambda.
pub(in crate::transport) const WIDER: f64 = 1.5;
/// Variance of a mean over photons of one low-discrepancy sequence over the variance for independent photons, as the best radius needs it.
/// Measured: with 0.25 and with 1 the error of boxes with and without mirrors and glass is greater or takes more time.
const EVENNESS: f64 = 0.5;
/// The squared bias is averaged over a square of this many cells to each side: noise hides it on single cells.
const SIGNAL_CELLS: usize = 2;
/// Radii are smoothed over a square of this many cells to each side. Without it the noise of a cell shows in its radius; a larger square
/// widens discs at sharp edges.
const RADIUS_CELLS: usize = 1;
/// Discs count as large only where they are large in this many cells to each side: beside a sharp edge they are not trusted.
/// Measured: otherwise a mirror's and a glass ball's caustics have 1.2 to 2.6 times the error at their edges.
const TRUST_CELLS: usize = 3;
/// The least and the greatest factor of one refinement; the next refinement corrects a wrong one.
const STEP: std::ops::RangeInclusive<f64> = 0.5..=2.0;

/// Greatest growth of discs for caustics, to 6 pixel footprints, for indirect caustics to 18. Wider discs reach over more objects, whose
/// clearance and visibility polygons take rays; smaller ones leave noise in smooth caustics.
const MOST_CAUSTIC_GROWTH: f64 = 3.0;

/// Greatest radius of a map's discs over their radius after one full iteration. Caustics begin with small discs, because they may be
/// sharp; most of them are not. The other maps begin with discs as wide as the distances to other objects allow, so these do not grow.
pub(in crate::transport) fn most_growth(kind: MapKind) -> f64 {
    match kind {
        MapKind::Global | MapKind::Glossy => 1.0,
        MapKind::Caustic | MapKind::IndirectCaustic => MOST_CAUSTIC_GROWTH,
    }
}

/// Difference between the radiance of a pixel with wider discs and with its own discs, summed over channels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BandwidthDifference {
    /// The difference from the photons of each map.
    pub maps: PerMap<f32>,
    /// Shot noise of the difference from the caustic map: its variance for independent photons. At a sharp caustic the difference
    /// varies more, with the position in the pixel.
    pub caustic_noise: f32,
    /// The difference from the photons of all maps that the picture shows in the pixel.
    pub picture: f32,
}

impl BandwidthDifference {
    /// Whether all values are finite.
    pub(in crate::transport) fn is_finite(&self) -> bool {
        let maps = MapKind::ALL.map(|kind| self.maps[kind]);
        maps.into_iter().chain([self.caustic_noise, self.picture]).all(f32::is_finite)
    }
}

impl std::ops::AddAssign for BandwidthDifference {
    fn add_assign(&mut self, other: Self) {
        MapKind::ALL.into_iter().for_each(|kind| self.maps[kind] += other.maps[kind]);
        self.caustic_noise += other.caustic_noise;
        self.picture += other.picture;
    }
}

/// Sums over the measured differences of a cell.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct Sums {
    count: u32,
    difference: f64,
    squares: f64,
    /// Sum of the shot noise, where it is known by itself: for caustics.
    shot_noise: Option<f64>,
}

impl Sums {
    fn add(&mut self, difference: f32) {
        self.count += 1;
        self.difference += f64::from(difference);
        self.squares += f64::from(difference).powi(2);
    }

    fn mean(&self) -> f64 {
        self.difference / f64::from(self.count.max(1))
    }

    /// Variance of a single difference; 0 with less than two.
    fn variance(&self) -> f64 {
        let squares = (self.squares - self.difference * self.mean()).max(0.0);
        squares / f64::from(self.count.saturating_sub(1).max(1))
    }

    /// The shot-noise part of the variance, which wider discs reduce.
    fn noise(&self) -> f64 {
        self.shot_noise.map_or_else(|| self.variance(), |sum| sum / f64::from(self.count.max(1)))
    }

    /// Unbiased estimate of the squared expected difference: the squared mean less the variance of the mean. May be negative.
    fn squared_expectation(&self) -> f64 {
        self.mean().powi(2) - self.noise() / f64::from(self.count.max(1))
    }
}

/// Differences measured by iterations between two refinements.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(in crate::transport) struct BandwidthDifferences {
    cells: Cells,
    maps: PerMap<Vec<Sums>>,
    picture: Vec<Sums>,
}

impl BandwidthDifferences {
    /// No measurement yet, for a film of this size.
    pub(in crate::transport) fn new(width: u32, height: u32) -> Self {
        let cells = Cells::new(width, height);
        let none = || vec![Sums::default(); cells.count()];
        Self { cells, maps: PerMap::from_fn(|_| none()), picture: none() }
    }

    /// Whether a pixel of a film of this size is measured in an iteration.
    #[inline]
    pub(in crate::transport) fn includes([width, height]: [u32; 2], pixel: u32, iteration: u64) -> bool {
        let cells = Cells::new(width, height);
        schedule::measures(iteration) && cells.measured(cells.at(pixel), iteration) == pixel
    }

    /// Adds the measurements of an iteration, one value for each pixel of the film.
    pub(in crate::transport) fn add(&mut self, iteration: u64, differences: &[BandwidthDifference]) {
        if !schedule::measures(iteration) {
            return;
        }
        for cell in 0..self.cells.count() {
            let difference = differences[self.cells.measured(cell, iteration) as usize];
            MapKind::ALL.into_iter().for_each(|kind| self.maps[kind][cell].add(difference.maps[kind]));
            *self.maps[MapKind::Caustic][cell].shot_noise.get_or_insert(0.0) += f64::from(difference.caustic_noise);
            self.picture[cell].add(difference.picture);
        }
    }

    /// Whether the differences are known for a film of this size.
    pub(in crate::transport) fn fits(&self, width: u32, height: u32) -> bool {
        let count = self.cells.count();
        let fit = |sums: &Vec<Sums>| sums.len() == count;
        self.cells == Cells::new(width, height)
            && fit(&self.picture)
            && MapKind::ALL.into_iter().all(|kind| fit(&self.maps[kind]))
    }

    /// Whether the iterations suffice to tell the bias from the noise.
    pub(in crate::transport) fn tell_bias(&self) -> bool {
        self.picture.iter().any(|sums| sums.count > 1)
    }

    /// Mean square of the bias over pixels and channels, for a bias that is proportional to the squared radius and equal in all channels;
    /// 0 where noise hides it.
    pub(in crate::transport) fn squared_bias(&self) -> f64 {
        let measured = self.picture.iter().filter(|sums| sums.count > 1);
        let squared = measured.map(Sums::squared_expectation).sum::<f64>() / self.cells.count() as f64;
        // A difference is summed over channels.
        squared.max(0.0) / (WIDER.powi(2) - 1.0).powi(2) / 9.0
    }
}

/// Measured radii of density estimates, for each map and cell of 2 x 2 pixels, as factors of the radii after one full iteration.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Bandwidth {
    cells: Cells,
    factors: PerMap<Vec<f32>>,
    /// The least factor of the caustic map near each cell.
    least_caustic: Vec<f32>,
}

impl Bandwidth {
    /// The best bandwidth for a mean of `total` full iterations, by differences that were measured with the factors `measured_at` of each
    /// map and cell.
    fn best(
        differences: &BandwidthDifferences,
        total: f64,
        measured_at: impl Fn(MapKind, usize) -> f64 + Sync,
    ) -> Self {
        let cells = differences.cells;
        let of =
            |kind| best_factors(cells, &differences.maps[kind], most_growth(kind), total, |c| measured_at(kind, c));
        let factors = PerMap::in_parallel(&of);
        let least_caustic = cells.least(&factors[MapKind::Caustic], TRUST_CELLS);
        Self { cells, factors, least_caustic }
    }

    /// The first bandwidth, by iterations whose radii had the factor `shrink` everywhere.
    pub(in crate::transport) fn first(differences: &BandwidthDifferences, total: f64, shrink: f64) -> Self {
        Self::best(differences, total, |_, _| shrink)
    }

    /// The next bandwidth, by iterations that used this one.
    pub(in crate::transport) fn next(&self, differences: &BandwidthDifferences, total: f64) -> Self {
        Self::best(differences, total, |kind, cell| f64::from(self.factors[kind][cell]))
    }

    /// Whether the factors are for a film of this size.
    pub(in crate::transport) fn fits(&self, width: u32, height: u32) -> bool {
        let count = self.cells.count();
        self.cells == Cells::new(width, height)
            && self.least_caustic.len() == count
            && MapKind::ALL.into_iter().all(|kind| self.factors[kind].len() == count)
    }

    /// The factor of a map's radius in a pixel.
    pub(in crate::transport) fn at(&self, kind: MapKind, pixel: u32) -> f64 {
        f64::from(self.factors[kind][self.cells.at(pixel)])
    }

    /// The least factor of the caustic map near a pixel.
    #[inline]
    pub(in crate::transport) fn least_caustic_near(&self, pixel: u32) -> f64 {
        f64::from(self.least_caustic[self.cells.at(pixel)])
    }

    /// The greatest value of [`Self::least_caustic_near`] over the film.
    pub(in crate::transport) fn greatest_least_caustic(&self) -> f64 {
        f64::from(self.least_caustic.iter().copied().fold(0.0, f32::max))
    }

    /// The mean factor of a map over the film.
    pub(in crate::transport) fn mean(&self, kind: MapKind) -> f64 {
        let factors = &self.factors[kind];
        factors.iter().map(|&factor| f64::from(factor)).sum::<f64>() / factors.len() as f64
    }
}

/// The factor of each cell for a mean of `total` full iterations, at most `most`.
fn best_factors(cells: Cells, sums: &[Sums], most: f64, total: f64, measured_at: impl Fn(usize) -> f64) -> Vec<f32> {
    let blurred = |of: fn(&Sums) -> f64| cells.blurred(&sums.iter().map(of).collect::<Vec<f64>>(), SIGNAL_CELLS);
    let (signals, variances) = (blurred(Sums::squared_expectation), blurred(Sums::noise));
    // Differences that vary more than shot noise vary with the position in the pixel: the light is sharp there. Twice the shot noise may
    // still be chance, because one path may leave several photons.
    let sharpness = blurred(|sums| sums.variance() - 2.0 * sums.noise());
    // gamma^6 = v / (2 N b^2), with v and b^2 from the variance and the squared expectation of the difference.
    let scale = EVENNESS * WIDER.powi(4) / (2.0 * total);
    let step = |signal: f64, variance: f64| {
        // Without photons the factor stays.
        if variance == 0.0 && signal == 0.0 {
            return 1.0;
        }
        let best = if signal > 0.0 { (scale * variance / signal).powf(1.0 / 6.0) } else { f64::INFINITY };
        best.clamp(*STEP.start(), *STEP.end())
    };
    let logarithms: Vec<f64> = (0..cells.count())
        .map(|cell| {
            (measured_at(cell) * step(signals[cell].max(0.0) + sharpness[cell].max(0.0), variances[cell]))
                .min(most)
                .ln()
        })
        .collect();
    cells.blurred(&logarithms, RADIUS_CELLS).into_iter().map(|x| x.exp() as f32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Sampler, Stream};

    const SIZE: u32 = 40;
    const KIND: MapKind = MapKind::Global;

    /// Bandwidth differences that `n` iterations measured, with this mean and standard deviation in every cell.
    fn measured(n: u64, mean: f64, deviation: f64) -> BandwidthDifferences {
        let mut differences = BandwidthDifferences::new(SIZE, SIZE);
        for iteration in 8..8 + n {
            let noise = |pixel| Sampler::new(1, Stream::Camera, pixel, iteration).next_1d() - 0.5;
            let difference = |pixel| mean + deviation * 12f64.sqrt() * noise(pixel);
            let all: Vec<BandwidthDifference> = (0..u64::from(SIZE * SIZE))
                .map(|pixel| difference(pixel) as f32)
                .map(|x| BandwidthDifference {
                    maps: PerMap::from_fn(|_| x),
                    picture: x,
                    caustic_noise: (deviation * deviation) as f32,
                })
                .collect();
            differences.add(iteration, &all);
        }
        differences
    }

    #[test]
    fn balances_bias_and_noise() {
        let (bias, noise, n) = (0.5, 2.0, 4096);
        let differences = measured(n, (WIDER.powi(2) - 1.0) * bias, (1.0 - WIDER.powi(-2)) * noise);
        for total in [4.0, 32.0] {
            let expected = 0.5 * (EVENNESS * noise * noise / (2.0 * total * bias * bias)).powf(1.0 / 6.0);
            let bandwidth = Bandwidth::first(&differences, total, 0.5);
            let pixels = 0..SIZE * SIZE;
            assert!(pixels.clone().all(|p| (bandwidth.at(KIND, p) / expected - 1.0).abs() < 0.05), "{expected}");
        }
    }

    #[test]
    fn differences_tell_the_bias_of_the_picture() {
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
        let none = Bandwidth::first(&BandwidthDifferences::new(SIZE, SIZE), 16.0, 0.7);
        assert!((none.at(KIND, 99) - 0.7).abs() < 1e-6, "unmeasured");
    }

    /// Where there is no bias, discs grow on the whole, but never beyond the discs of the first iteration.
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
    fn sharp_light_shrinks_discs_and_the_trust_around_them() {
        let mut differences = BandwidthDifferences::new(SIZE, SIZE);
        let difference = |pixel: u32| match pixel % SIZE {
            20 => -4.0,
            19 | 21 => 2.0,
            _ => 0.0,
        };
        for iteration in 9..=16 {
            let noise = |pixel| Sampler::new(1, Stream::Camera, u64::from(pixel), iteration).next_1d() as f32 - 0.5;
            let all = (0..SIZE * SIZE).map(|pixel| {
                let x = difference(pixel) + noise(pixel);
                BandwidthDifference { maps: PerMap::from_fn(|_| x), caustic_noise: 1.0 / 12.0, picture: x }
            });
            differences.add(iteration, &all.collect::<Vec<_>>());
        }
        let bandwidth = Bandwidth::first(&differences, 16.0, 0.8);
        let at = |x| bandwidth.at(MapKind::Caustic, 20 * SIZE + x);
        assert!(at(20) < 0.5 && at(4) > 0.8, "{} {}", at(20), at(4));
        let least = |x| bandwidth.least_caustic_near(20 * SIZE + x);
        assert!(least(13) < 0.6 && least(27) < 0.6 && least(4) > 0.8, "{} {} {}", least(13), least(27), least(4));
    }

    /// Differences between positions in a pixel are not noise: a wider disc does not reduce them.
    #[test]
    fn light_that_varies_within_a_pixel_shrinks_discs_of_caustics() {
        let mut differences = measured(16, 0.0, 1.0);
        let quiet = Bandwidth::first(&differences, 16.0, 0.8).at(MapKind::Caustic, 0);
        for sums in &mut differences.maps[MapKind::Caustic] {
            sums.shot_noise = sums.shot_noise.map(|noise| 0.01 * noise);
        }
        let sharp = Bandwidth::first(&differences, 16.0, 0.8).at(MapKind::Caustic, 0);
        assert!(sharp < 0.6 * quiet, "{sharp} {quiet}");
    }

    #[test]
    fn one_pixel_of_each_cell_is_measured_until_radii_are_chosen_anew_then_the_next() {
        for (width, height) in [(1, 1), (5, 3), (4, 4), (64, 1)] {
            let cells = Cells::new(width, height);
            let mut turns = vec![0; (width * height) as usize];
            for octave in 1..=4 {
                let mut differences = BandwidthDifferences::new(width, height);
                let iterations = (1 << octave) + 1..=(2 << octave);
                let count = iterations.clone().count() as u32;
                iterations.for_each(|i| differences.add(i, &vec![BandwidthDifference::default(); turns.len()]));
                assert!(
                    differences.maps[KIND].iter().all(|sums| sums.count == count),
                    "octave {octave} of {width} x {height}"
                );
                for (pixel, turns) in (0..).zip(&mut turns) {
                    *turns += u32::from(BandwidthDifferences::includes([width, height], pixel, 2 << octave));
                }
            }
            // In four octaves a cell measures 1, 2 or 4 pixels.
            assert!(turns.iter().all(|&n| [1, 2, 4].contains(&n)), "{turns:?}");
            assert_eq!(turns.iter().sum::<u32>() as usize, 4 * cells.count());
        }
    }
}
