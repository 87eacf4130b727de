//! Positions between the middles of pixels.

use crate::film::LinearImage;
use crate::math::Rgb;
use rayon::prelude::*;

/// The four pixels between whose middles a position lies, and the weights of the second column and row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Between {
    indices: [usize; 4],
    x: f32,
    y: f32,
}

impl Between {
    /// The pixels of an image of this width and height around a position in pixels.
    #[inline]
    pub(super) fn new([width, height]: [u32; 2], x: f32, y: f32) -> Self {
        let (left, right, x) = neighbours(x, width);
        let (top, bottom, y) = neighbours(y, height);
        let index = |row: usize, column: usize| row * width as usize + column;
        Self { indices: [index(top, left), index(top, right), index(bottom, left), index(bottom, right)], x, y }
    }

    /// The bilinear mean of a value of the pixels.
    #[inline]
    pub(super) fn mean(&self, value: impl Fn(usize) -> f32) -> f32 {
        let [a, b, c, d] = self.indices.map(value);
        let (top, bottom) = (a + self.x * (b - a), c + self.x * (d - c));
        top + self.y * (bottom - top)
    }

    /// The four pixels with their weights in the bilinear mean.
    #[inline]
    pub(super) fn weights(&self) -> [(usize, f32); 4] {
        let ([a, b, c, d], x, y) = (self.indices, self.x, self.y);
        [(a, (1.0 - x) * (1.0 - y)), (b, x * (1.0 - y)), (c, (1.0 - x) * y), (d, x * y)]
    }

    /// The bilinear mean of colours of the pixels.
    #[inline]
    pub(super) fn color(&self, value: impl Fn(usize) -> Rgb) -> Rgb {
        let [a, b, c, d] = self.indices.map(value);
        a.lerp(b, self.x).lerp(c.lerp(d, self.x), self.y)
    }
}

/// The two pixels between whose middles a position lies, and the weight of the second.
#[inline]
fn neighbours(position: f32, count: u32) -> (usize, usize, f32) {
    let from_first = (position - 0.5).clamp(0.0, (count - 1) as f32);
    let first = from_first as usize;
    (first, (first + 1).min(count as usize - 1), from_first - first as f32)
}

/// The bilinear mean of an image at a position in pixels.
#[inline]
pub(super) fn sample(image: &LinearImage, x: f32, y: f32) -> Rgb {
    Between::new([image.width, image.height], x, y).color(|index| image.pixels[index])
}

/// Enlarges a grid of values row by row: bilinear means between the middles of its cells.
pub(super) struct Enlarged<'a, T, F> {
    values: &'a [T],
    size: [u32; 2],
    /// For each column of the enlarged grid, the first of the two columns between whose middles it lies, and the weight of the second.
    columns: Vec<(usize, f32)>,
    height: u32,
    mix: F,
}

impl<'a, T: Copy, F: Fn(T, T, f32) -> T> Enlarged<'a, T, F> {
    /// The values of a grid of this width and height for a grid of the width and height `to`; `mix` returns the mean of two values, given
    /// the weight of the second.
    pub(super) fn new(values: &'a [T], size: [u32; 2], to: [u32; 2], mix: F) -> Self {
        let column = |x: u32| {
            let (first, _, weight) = neighbours(middle(x, to[0], size[0]), size[0]);
            (first, weight)
        };
        Self { values, size, columns: (0..to[0]).map(column).collect(), height: to[1], mix }
    }

    /// The values of a row of the enlarged grid.
    pub(super) fn row(&self, y: u32) -> impl Iterator<Item = T> + '_ {
        let width = self.size[0] as usize;
        let (top, bottom, weight) = neighbours(middle(y, self.height, self.size[1]), self.size[1]);
        let between = |x: usize| (self.mix)(self.values[top * width + x], self.values[bottom * width + x], weight);
        // The last column again, for the columns beyond its middle.
        let row: Vec<T> = (0..width).chain([width - 1]).map(between).collect();
        self.columns.iter().map(move |&(first, weight)| (self.mix)(row[first], row[first + 1], weight))
    }
}

/// The position of the middle of cell `k` of `count` cells on a grid of `to` cells of the same size together.
#[inline]
pub(super) fn middle(k: u32, count: u32, to: u32) -> f32 {
    (k as f32 + 0.5) * to as f32 / count as f32
}

/// The values of a grid of this width and height, of which `row` returns those of one row.
pub(super) fn filled<T: Copy + Default + Send, I: Iterator<Item = T>>(
    [width, height]: [u32; 2],
    row: impl Fn(u32) -> I + Sync,
) -> Vec<T> {
    let mut values = vec![T::default(); width as usize * height as usize];
    values.par_chunks_mut(width as usize).zip(0..height).for_each(|(values, y)| {
        for (value, new) in values.iter_mut().zip(row(y)) {
            *value = new;
        }
    });
    values
}

/// The indices of a pixel and its neighbours in an image of this width and height.
pub(super) fn around([width, height]: [u32; 2], index: usize) -> impl Iterator<Item = usize> {
    let (x, y) = (index as u32 % width, index as u32 / width);
    let near = |at: u32, count: u32| at.saturating_sub(1)..(at + 2).min(count);
    near(y, height).flat_map(move |row| near(x, width).map(move |column| (row * width + column) as usize))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_are_linear_between_the_middles_of_pixels_and_constant_beyond() {
        let size = [4, 3];
        let value = |index: usize| (index % 4) as f32 + 10.0 * (index / 4) as f32;
        let mean = |x, y| Between::new(size, x, y).mean(value);
        assert_eq!(mean(0.5, 0.5), 0.0);
        assert_eq!(mean(2.25, 1.0), 1.75 + 5.0);
        assert_eq!([mean(0.0, 0.0), mean(4.0, 3.0)], [0.0, 23.0], "at the corners of the image");
        let color = Between::new(size, 2.25, 1.0).color(|index| Rgb::splat(value(index)));
        assert!((color - Rgb::splat(6.75)).length() < 1e-6, "{color}");
    }

    #[test]
    fn an_enlarged_grid_has_the_means_between_its_middles() {
        let values = [0.0, 1.0, 2.0, 10.0, 11.0, 12.0_f32];
        let enlarged = Enlarged::new(&values, [3, 2], [9, 8], |a, b, t| a + t * (b - a));
        let rows: Vec<Vec<f32>> = (0..8).map(|y| enlarged.row(y).collect()).collect();
        for (y, row) in rows.iter().enumerate() {
            for (x, value) in row.iter().enumerate() {
                let between = Between::new([3, 2], middle(x as u32, 9, 3), middle(y as u32, 8, 2));
                assert!((value - between.mean(|index| values[index])).abs() < 1e-5, "{x} {y}");
            }
        }
        assert_eq!([rows[0][0], rows[7][8]], [0.0, 12.0]);
    }

    #[test]
    fn neighbours_end_at_the_border() {
        let indices = |index| around([4, 3], index).collect::<Vec<_>>();
        assert_eq!(indices(0), [0, 1, 4, 5]);
        assert_eq!(indices(6), [1, 2, 3, 5, 6, 7, 9, 10, 11]);
        assert_eq!(indices(11), [6, 7, 10, 11]);
    }
}
