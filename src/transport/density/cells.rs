//! The film in cells of a few pixels, for which bandwidths are measured.

use super::schedule;
use serde::{Deserialize, Serialize};

/// Pixels along a side of a cell. One pixel of each cell is measured, the same pixel until the next refinement: differences between
/// pixels would count as noise, and sharp light would look smooth.
const CELL: u32 = 2;

/// The film in cells of a few pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Cells {
    width: u32,
    height: u32,
    columns: u32,
    rows: u32,
}

impl Cells {
    /// The cells of a film of this width and height, pixels.
    pub(super) fn new(width: u32, height: u32) -> Self {
        Self { width, height, columns: width.div_ceil(CELL), rows: height.div_ceil(CELL) }
    }

    /// The number of cells.
    pub(super) fn count(&self) -> usize {
        self.columns as usize * self.rows as usize
    }

    /// The cell of a pixel.
    #[inline]
    pub(super) fn at(&self, pixel: u32) -> usize {
        let (x, y) = (pixel % self.width / CELL, pixel / self.width / CELL);
        y as usize * self.columns as usize + x as usize
    }

    /// The pixel that stands for a cell in an iteration.
    pub(super) fn measured(&self, cell: usize, iteration: u64) -> u32 {
        let (x, y) = (CELL * (cell as u32 % self.columns), CELL * (cell as u32 / self.columns));
        // At the film's edge a cell may have fewer pixels.
        let (columns, rows) = (CELL.min(self.width - x), CELL.min(self.height - y));
        let turn = schedule::refinements_before(iteration) % (columns * rows);
        (y + turn / columns) * self.width + x + turn % columns
    }

    /// Filters the values of all cells with a square window of `2 half_width + 1` cells a side, clipped to the film: `of` reduces each row of
    /// the window, then the results of the rows.
    fn filtered<T: Copy>(
        &self,
        values: &[T],
        half_width: usize,
        of: impl Fn(&mut dyn ExactSizeIterator<Item = T>) -> T,
    ) -> Vec<T> {
        let columns = self.columns as usize;
        let along = |values: &[T], stride: usize, len: usize, index: usize| {
            let at = index / stride % len;
            let near = at.saturating_sub(half_width)..(at + half_width + 1).min(len);
            let start = index - at * stride;
            of(&mut near.map(|k| values[start + k * stride]))
        };
        let rows: Vec<T> = (0..values.len()).map(|k| along(values, 1, columns, k)).collect();
        (0..rows.len()).map(|k| along(&rows, columns, self.rows as usize, k)).collect()
    }

    /// The mean over the window around each cell.
    pub(super) fn blurred(&self, values: &[f64], half_width: usize) -> Vec<f64> {
        self.filtered(values, half_width, |near| {
            let count = near.len() as f64;
            near.sum::<f64>() / count
        })
    }

    /// The least value in the window around each cell.
    pub(super) fn least(&self, values: &[f32], half_width: usize) -> Vec<f32> {
        self.filtered(values, half_width, |near| near.fold(f32::INFINITY, f32::min))
    }
}
