//! An edge-avoiding wavelet transform of values of blocks \[Dammertz10\].

use super::blocks::{Blocks, SIDE};
use super::guide::Guide;
use rayon::prelude::*;
use std::ops::{Add, Mul};

/// Levels of the transform; the details of each are twice as wide as those of the level before. The widest span 128 pixels.
const LEVELS: u32 = 6;
/// Weights of neighbours in a row or column: the means of a few levels together weight blocks by about a Gaussian.
const KERNEL: [f32; 3] = [0.5, 1.0, 0.5];

/// A level of the transform: for each block the weights of the 3 x 3 blocks that are `step` blocks apart around it. Their sum is 1.
#[derive(Debug)]
pub(super) struct Level {
    pub(super) step: u32,
    weights: Vec<[f32; 9]>,
}

impl Level {
    /// All levels, from the finest on.
    pub(super) fn all(blocks: &Blocks) -> Vec<Self> {
        let level = |step| Self { step, weights: blocks.each(|block| weights(blocks, block, step)) };
        (0..LEVELS).map(|level| 1 << level).map(level).collect()
    }

    /// The weighted mean of values around each block.
    pub(super) fn means<T: Copy + Add<Output = T> + Mul<f32, Output = T> + Send + Sync>(
        &self,
        columns: u32,
        values: &[T],
    ) -> Vec<T> {
        let [to_right, down] = [self.step as usize, self.step as usize * columns as usize];
        let mean = |(own, weights): (usize, &[f32; 9])| {
            let mut sum = values[own] * weights[4];
            for (k, weight) in weights.iter().enumerate() {
                if *weight > 0.0 && k != 4 {
                    // Blocks beyond the border have no weight.
                    sum = sum + values[own + k % 3 * to_right + k / 3 * down - to_right - down] * *weight;
                }
            }
            sum
        };
        self.weights.par_iter().enumerate().with_min_len(columns as usize).map(mean).collect()
    }
}

fn weights(blocks: &Blocks, [column, row]: [u32; 2], step: u32) -> [f32; 9] {
    let [width, height] = blocks.size;
    let own = blocks.index([column, row]);
    let guide = &blocks.guides[own];
    let mut weights = [0.0; 9];
    weights[4] = 1.0;
    if guide.surface == Guide::NONE.surface {
        return weights;
    }
    let flatness = guide.flatness((step * SIDE) as f32);
    let mut sum = 0.0;
    for (dy, by_row) in (0..3).zip(KERNEL) {
        // Wraps around above the first row.
        let y = (row + dy * step).wrapping_sub(step);
        for (dx, by_column) in (0..3).zip(KERNEL) {
            let x = (column + dx * step).wrapping_sub(step);
            let weight = &mut weights[(3 * dy + dx) as usize];
            if (dx, dy) != (1, 1) && x < width && y < height {
                *weight = by_row * by_column * guide.likeness(&blocks.guides[blocks.index([x, y])], flatness);
            }
            sum += *weight;
        }
    }
    weights.map(|weight| weight / sum)
}
