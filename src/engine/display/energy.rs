//! How much of the details of a level is noise.

use super::blocks::{Blocks, between};
use super::guide::Guide;
use super::halves::Halves;
use rayon::prelude::*;

/// Blocks along a side of a cell, in which squares are summed.
const CELL: u32 = 4;
/// The mean square of noise over the median square: few photons bring much of the light. Chosen by measurement, as is the following.
const MEAN_TO_MEDIAN: f32 = 8.0;
/// The widest details, by the steps of their level, that may be noise after a single iteration: wider ones are mostly light.
const WIDEST_OF_ONE: u32 = 16;

/// Sums of squares of details.
#[derive(Clone, Copy, Debug, Default)]
struct Energy {
    /// Of what both halves have in common.
    signal: f32,
    /// Of the noise of their mean.
    noise: f32,
}

/// For each block, the fraction of the noise in the details of a level there, from 0 to 1: noise over signal and noise, as in a Wiener filter.
/// `means` are the means of the irradiance around each block, `weights` the weights of the halves, with the sum 1.
pub(super) fn noise_fractions(
    blocks: &Blocks,
    step: u32,
    details: &[Halves],
    means: &[Halves],
    weights: [f32; 2],
) -> Vec<f32> {
    let size = blocks.size.map(|count| count.div_ceil(CELL));
    let mut cells = if weights[1] > 0.0 {
        cells(blocks, size, |block| Energy::of_two(details[block], weights))
    } else {
        let relative = if step <= WIDEST_OF_ONE { median_noise(blocks, details, means) } else { 0.0 };
        cells(blocks, size, |block| Energy::of_one(details[block], relative * means[block].0[0].length()))
    };
    let first = (step / CELL).max(1);
    for step in [first, 2 * first] {
        cells = blurred(size, &cells, step);
    }
    let fractions: Vec<f32> = cells.iter().map(|energy| energy.noise_fraction()).collect();
    blocks.each(|block| bilinear(size, block.map(|at| (at as f32 + 0.5) / CELL as f32), &fractions))
}

impl Energy {
    /// What two halves of the iterations have in common is signal, what they differ in is noise.
    fn of_two(Halves([a, b]): Halves, weights: [f32; 2]) -> Self {
        Self { signal: a.dot(b), noise: weights[0] * weights[1] * (a - b).length_squared() }
    }

    /// A single half, with noise that is known otherwise.
    fn of_one(Halves([detail, _]): Halves, noise: f32) -> Self {
        Self { signal: detail.length_squared() - noise, noise }
    }

    fn noise_fraction(&self) -> f32 {
        if self.noise > 0.0 { self.noise / (self.signal.max(0.0) + self.noise) } else { 0.0 }
    }
}

/// The sums over the blocks of each cell.
fn cells(blocks: &Blocks, size: [u32; 2], energy: impl Fn(usize) -> Energy + Sync) -> Vec<Energy> {
    let cell = |k: u32| {
        let [column, row] = [k % size[0], k / size[0]];
        let range = |at: u32, end: u32| CELL * at..(CELL * (at + 1)).min(end);
        let mut sum = Energy::default();
        for y in range(row, blocks.size[1]) {
            for x in range(column, blocks.size[0]) {
                let Energy { signal, noise } = energy(blocks.index([x, y]));
                sum.signal += signal;
                sum.noise += noise;
            }
        }
        sum
    };
    (0..size[0] * size[1]).into_par_iter().with_min_len(size[0] as usize).map(cell).collect()
}

/// The binomial mean over 3 x 3 cells that are `step` cells apart.
fn blurred(size: [u32; 2], cells: &[Energy], step: u32) -> Vec<Energy> {
    let near = |at: u32, count: u32| [(at.saturating_sub(step), 0.25), (at, 0.5), ((at + step).min(count - 1), 0.25)];
    let cell = |k: u32| {
        let mut sum = Energy::default();
        for (y, by_row) in near(k / size[0], size[1]) {
            for (x, by_column) in near(k % size[0], size[0]) {
                let Energy { signal, noise } = cells[(y * size[0] + x) as usize];
                sum.signal += by_row * by_column * signal;
                sum.noise += by_row * by_column * noise;
            }
        }
        sum
    };
    (0..size[0] * size[1]).map(cell).collect()
}

/// The value between the middles of the nearest cells, at a position in cells.
fn bilinear(size: [u32; 2], [x, y]: [f32; 2], values: &[f32]) -> f32 {
    let columns = between(x, size[0]);
    let in_row =
        |row: u32| columns.iter().map(|(x, weight)| weight * values[(row * size[0] + x) as usize]).sum::<f32>();
    between(y, size[1]).iter().map(|(row, weight)| weight * in_row(*row)).sum()
}

/// An estimate of the mean square of the details over the irradiance, where they are noise: like the variance of a number of photons, it is
/// in proportion to the irradiance. It comes from the median over the picture, which a few edges of light do not change.
fn median_noise(blocks: &Blocks, details: &[Halves], means: &[Halves]) -> f32 {
    let is_shown = blocks.guides.iter().map(|guide| guide.surface != Guide::NONE.surface);
    let blocks = details.iter().zip(means).zip(is_shown).filter(|(_, is_shown)| *is_shown);
    let ratios = blocks.map(|((detail, mean), _)| detail.0[0].length_squared() / mean.0[0].length());
    let mut ratios: Vec<f32> = ratios.filter(|ratio| ratio.is_finite()).collect();
    if ratios.is_empty() {
        return 0.0;
    }
    let middle = ratios.len() / 2;
    MEAN_TO_MEDIAN * *ratios.select_nth_unstable_by(middle, f32::total_cmp).1
}
