//! Blocks of pixels that show one surface.

use super::guide::Guide;
use crate::transport::SeenSurface;
use glam::Vec3;
use rayon::prelude::*;

/// Pixels along a side of a block. With 4, noise on surfaces seen at a flat angle was finer than a block; with 1, four times the time lowers
/// FLIP by some 3 %.
pub(super) const SIDE: u32 = 2;

/// The film divided into blocks.
#[derive(Debug)]
pub(super) struct Blocks {
    /// Width and height of the film, pixels.
    pub(super) film: [u32; 2],
    /// Blocks in a row, and rows of blocks.
    pub(super) size: [u32; 2],
    /// The surface that each pixel shows.
    pub(super) surfaces: Vec<u32>,
    /// What each block shows: the surface that most of its pixels show.
    pub(super) guides: Vec<Guide>,
}

impl Blocks {
    /// The blocks of a film of this width and height whose pixels show these surfaces.
    pub(super) fn new(film: [u32; 2], seen: &[Option<SeenSurface>]) -> Self {
        let surfaces = seen.par_iter().map(|seen| Guide::new(*seen).surface).collect();
        let size = film.map(|pixels| pixels.div_ceil(SIDE));
        let mut blocks = Self { film, size, surfaces, guides: Vec::new() };
        blocks.guides = blocks.each(|block| blocks.guide(block, seen));
        blocks
    }

    /// A value for each block, given its column and row.
    pub(super) fn each<T: Send>(&self, value: impl Fn([u32; 2]) -> T + Sync) -> Vec<T> {
        let [columns, rows] = self.size;
        let indices = (0..columns * rows).into_par_iter().with_min_len(columns as usize);
        indices.map(|k| value([k % columns, k / columns])).collect()
    }

    /// The index of the block in this column and row.
    pub(super) fn index(&self, [column, row]: [u32; 2]) -> usize {
        (row * self.size[0] + column) as usize
    }

    /// The indices of the pixels of a block.
    pub(super) fn pixels_of(&self, [column, row]: [u32; 2]) -> impl Iterator<Item = usize> + Clone {
        let [width, height] = self.film;
        let range = |at: u32, end: u32| SIDE * at..(SIDE * (at + 1)).min(end);
        range(row, height).flat_map(move |y| range(column, width).map(move |x| (y * width + x) as usize))
    }

    fn guide(&self, block: [u32; 2], seen: &[Option<SeenSurface>]) -> Guide {
        let surfaces = || self.pixels_of(block).map(|pixel| self.surfaces[pixel]);
        let count = |surface: u32| surfaces().filter(|other| *other == surface).count();
        let Some(surface) = surfaces().filter(|surface| *surface != Guide::NONE.surface).max_by_key(|k| count(*k))
        else {
            return Guide::NONE;
        };
        let (mut normal, mut position, mut footprint) = (Vec3::ZERO, Vec3::ZERO, 0.0);
        for pixel in self.pixels_of(block).filter(|pixel| self.surfaces[*pixel] == surface) {
            let guide = Guide::new(seen[pixel]);
            normal += guide.normal;
            position += guide.position;
            footprint += guide.footprint;
        }
        let count = count(surface) as f32;
        let normal = normal.normalize_or_zero();
        Guide { position: position / count, normal, footprint: footprint / count, surface }
    }
}

/// The two of `count` cells between whose middles a position lies, and their weights.
pub(super) fn between(position: f32, count: u32) -> [(u32, f32); 2] {
    let from_first = (position - 0.5).clamp(0.0, (count - 1) as f32);
    let first = from_first as u32;
    let second = from_first - first as f32;
    [(first, 1.0 - second), ((first + 1).min(count - 1), second)]
}
