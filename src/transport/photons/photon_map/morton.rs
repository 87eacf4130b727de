//! Morton order: photons along a space-filling curve, so that neighbours in space are neighbours in memory.

use crate::transport::photons::Photon;
use glam::Vec3;
use rayon::prelude::*;

/// Bits of a code: 11 for x, 11 for y, 10 for z.
const DIGIT_BITS: u32 = 11;
const CELLS: f32 = (1 << DIGIT_BITS) as f32;
/// Least number of photons for a task of its own.
const GRAIN: usize = 1 << 14;

/// A photon's position on the curve.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Coded {
    pub(super) code: u32,
    /// Index of the photon.
    pub(super) index: u32,
}

/// All photons sorted by their Morton codes on a grid over their bounds; stable within a cell.
pub(super) fn order(photons: &[Photon]) -> Vec<Coded> {
    let nothing = || (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let bounds = photons
        .par_iter()
        .with_min_len(GRAIN)
        .fold(nothing, |(min, max), p| (min.min(p.position), max.max(p.position)))
        .reduce(nothing, |a, b| (a.0.min(b.0), a.1.max(b.1)));
    let grid = Grid::over(bounds);
    let coded = |(i, photon): (usize, &Photon)| Coded { code: grid.code(photon.position), index: i as u32 };
    let mut order: Vec<Coded> = photons.par_iter().with_min_len(GRAIN).enumerate().map(coded).collect();
    radix_sort(&mut order);
    order
}

/// Sorts a range of photons again, by codes on a finer grid over their own bounds.
pub(super) fn refine(photons: &[Photon], order: &mut [Coded]) {
    let position = |item: &Coded| photons[item.index as usize].position;
    let nothing = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let grid = Grid::over(order.iter().map(position).fold(nothing, |(min, max), p| (min.min(p), max.max(p))));
    for item in order.iter_mut() {
        item.code = grid.code(position(item));
    }
    order.sort_unstable_by_key(|item| (item.code, item.index));
}

/// A grid of cubic cells.
struct Grid {
    min: Vec3,
    /// Cells per scene unit; the longest axis of the bounds sets it.
    scale: f32,
}

impl Grid {
    fn over((min, max): (Vec3, Vec3)) -> Self {
        Self { min, scale: (CELLS - 1.0) / (max - min).max_element().max(f32::MIN_POSITIVE) }
    }

    fn code(&self, position: Vec3) -> u32 {
        let cell = ((position - self.min) * self.scale).min(Vec3::splat(CELLS - 1.0));
        let code = interleave(cell.x as u32) << 2 | interleave(cell.y as u32) << 1 | interleave(cell.z as u32);
        (code >> 1) as u32
    }
}

/// Spreads the bits of an 11-bit number to every third bit.
fn interleave(x: u32) -> u64 {
    let x = (x | x << 16) & 0x0700_00ff;
    let x = (x | x << 8) & 0x0700_f00f;
    let x = (x | x << 4) & 0x430c_30c3;
    u64::from((x | x << 2) & 0x4924_9249)
}

/// Radix sort by code, least significant digit first; stable.
fn radix_sort(items: &mut Vec<Coded>) {
    let mut other = vec![Coded::default(); items.len()];
    for shift in [0, DIGIT_BITS, 2 * DIGIT_BITS] {
        let digit = |code: u32| (code >> shift) as usize & ((1 << DIGIT_BITS) - 1);
        let mut starts = [0u32; 1 << DIGIT_BITS];
        for item in items.iter() {
            starts[digit(item.code)] += 1;
        }
        let mut sum = 0;
        for start in &mut starts {
            sum += std::mem::replace(start, sum);
        }
        for &item in items.iter() {
            let next = &mut starts[digit(item.code)];
            other[*next as usize] = item;
            *next += 1;
        }
        std::mem::swap(items, &mut other);
    }
}
