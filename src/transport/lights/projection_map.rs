//! The projection map: directions in which a light meets specular surfaces \[Jensen96\].

use super::emission::{self, Emission, Origin};
use super::light_sampler::MOST_SAMPLED;
use crate::geometry::Primitive;
use crate::math::{Sampler, Stream, octahedral};
use crate::world::{Light, World};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Cells along a side of the square of directions: a cell subtends about 3 degrees, narrower than most objects.
const SIDE: usize = 64;
/// Probe rays along a side of a cell; one in scenes where points sample only some of many lights.
const PROBES_ALONG_SIDE: u64 = 2;
/// Fraction of the paths that leave in all directions alike, in case the probes missed a specular surface (defensive sampling).
const DEFENSIVE_FRACTION: f64 = 0.03;
/// Diagonal of a primitive's bounding box over its distance from the light, below which all probe rays may miss the primitive. Two cells
/// subtend about as many radians; a larger primitive does not slip between their probe rays.
const SMALL_PRIMITIVE: f64 = 0.1;

/// A density over the sphere of directions, constant in each cell of the equal-area octahedral square \[Clarberg08\].
#[derive(Clone, Debug)]
pub struct ProjectionMap {
    /// Cumulative distribution of the rows, `SIDE + 1` values from 0 to 1.
    rows: Vec<f64>,
    /// Cumulative distribution of the cells of each row.
    cells: Vec<[f64; SIDE + 1]>,
    /// Fraction of the sphere in which the light meets specular surfaces.
    covered: f64,
}

impl ProjectionMap {
    /// The projection map of a light, from probe rays into every cell.
    pub(in crate::transport) fn build(world: &World, light: &Light, light_index: u64) -> Self {
        let along = if world.lights.len() > MOST_SAMPLED { 1 } else { PROBES_ALONG_SIDE };
        let seen: Vec<bool> = (0..SIDE * SIDE)
            .into_par_iter()
            .with_min_len(64)
            .map(|cell| {
                (0..along * along).any(|probe| probe_hits_specular(world, light, light_index, cell, probe, along))
            })
            .collect();
        let mut is_specular = dilated(&seen);
        for cell in cells_of_small_objects(world, light) {
            is_specular[cell] = true;
        }
        Self::from_cells(&is_specular)
    }

    fn from_cells(is_specular: &[bool]) -> Self {
        let count = is_specular.iter().filter(|&&is| is).count();
        let total = (SIDE * SIDE) as f64;
        let probability = |cell: usize| {
            let uniform = 1.0 / total;
            match (is_specular[cell], count) {
                (_, 0) => uniform,
                (true, _) => (1.0 - DEFENSIVE_FRACTION) / count as f64 + DEFENSIVE_FRACTION * uniform,
                (false, _) => DEFENSIVE_FRACTION * uniform,
            }
        };
        let mut rows = vec![0.0];
        let mut cells = Vec::with_capacity(SIDE);
        for row in 0..SIDE {
            let mut cumulative = [0.0; SIDE + 1];
            for column in 0..SIDE {
                cumulative[column + 1] = cumulative[column] + probability(row * SIDE + column);
            }
            let sum = cumulative[SIDE];
            cells.push(cumulative.map(|x| x / sum));
            rows.push(rows[row] + sum);
        }
        let all = rows[SIDE];
        rows.iter_mut().for_each(|x| *x /= all);
        Self { rows, cells, covered: count as f64 / total }
    }

    /// Samples a direction; returns it with its density per steradian. Monotonic in both numbers, so that stratified numbers give
    /// stratified directions.
    #[inline]
    fn sample(&self, u: DVec2) -> (DVec3, f64) {
        let (row, y, row_probability) = invert(&self.rows, u.y);
        let (column, x, cell_probability) = invert(&self.cells[row], u.x);
        let square = DVec2::new(column as f64 + x, row as f64 + y) / SIDE as f64;
        let pdf = row_probability * cell_probability * (SIDE * SIDE) as f64 / (4.0 * PI);
        (octahedral::direction_from_square(square), pdf)
    }

    /// Samples the first ray of a path towards specular surfaces; `None` where the light does not shine in the sampled direction.
    #[inline]
    pub(in crate::transport) fn emit(&self, light: &Light, sampler: &mut Sampler) -> Option<Emission> {
        let Origin { position, normal, strength } = emission::sample_origin(light, sampler);
        let (direction, pdf) = self.sample(sampler.next_2d());
        let cos = normal.map_or(1.0, |n| n.dot(direction));
        (cos > 0.0).then(|| Emission { origin: position, direction, flux: strength * (cos / pdf) as f32 })
    }

    /// Fraction of the sphere of directions in which the light meets specular surfaces, 0 to 1.
    pub fn covered(&self) -> f64 {
        self.covered
    }
}

/// Inverts a cumulative distribution: the index of the interval that holds `x`, the position of `x` in it (0 to 1), and its
/// probability.
#[inline]
fn invert(cumulative: &[f64], x: f64) -> (usize, f64, f64) {
    let index = cumulative.partition_point(|&c| c <= x).clamp(1, cumulative.len() - 1) - 1;
    let probability = cumulative[index + 1] - cumulative[index];
    (index, ((x - cumulative[index]) / probability).clamp(0.0, 1.0), probability)
}

/// Whether the probe ray into one of the `along` times `along` strata of a cell meets a specular surface first.
fn probe_hits_specular(world: &World, light: &Light, light_index: u64, cell: usize, probe: u64, along: u64) -> bool {
    let index = cell as u64 * along * along + probe;
    let mut sampler = Sampler::new(0, Stream::Probe, light_index, index);
    let origin = emission::sample_origin(light, &mut sampler);
    let stratum = DVec2::new((probe % along) as f64, (probe / along) as f64);
    let within = (stratum + sampler.next_2d()) / along as f64;
    let corner = DVec2::new((cell % SIDE) as f64, (cell / SIDE) as f64);
    let direction = octahedral::direction_from_square((corner + within) / SIDE as f64);
    if origin.normal.is_some_and(|normal| normal.dot(direction) <= 0.0) {
        return false;
    }
    let ray = emission::ray_from_light(world, origin.position, direction);
    world.aggregate.closest_hit(&ray).is_some_and(|hit| world.is_specular(hit.primitive))
}

/// The marked cells and their eight neighbours.
fn dilated(marked: &[bool]) -> Vec<bool> {
    let near = |row: usize, column: usize| {
        let range = |x: usize| x.saturating_sub(1)..(x + 2).min(SIDE);
        range(row).any(|r| range(column).any(|c| marked[r * SIDE + c]))
    };
    (0..SIDE * SIDE).map(|cell| near(cell / SIDE, cell % SIDE)).collect()
}

/// Cells towards specular primitives that appear smaller than [`SMALL_PRIMITIVE`].
fn cells_of_small_objects(world: &World, light: &Light) -> Vec<usize> {
    let center = light.center();
    let mut cells = Vec::new();
    for (index, primitive) in world.aggregate.primitives().iter().enumerate() {
        if matches!(primitive, Primitive::Plane(_)) || !world.is_specular(index as u32) {
            continue;
        }
        let bounds = primitive.bounds();
        let offset = bounds.center() - center;
        if bounds.diagonal() < SMALL_PRIMITIVE * offset.length() {
            let square = octahedral::square_from_direction(offset.normalize()) * SIDE as f64;
            let (column, row) = (square.x as usize, square.y as usize);
            let range = |x: usize| x.saturating_sub(1)..(x + 2).min(SIDE);
            cells.extend(range(row).flat_map(|r| range(column).map(move |c| r * SIDE + c)));
        }
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::chi_square::assert_has_density;

    /// Marked cells divide all probability but the defensive fraction, which is even over the sphere.
    #[test]
    fn samples_have_their_density() {
        let cells: Vec<bool> = (0..SIDE * SIDE).map(|cell| cell % 37 == 0 || cell / SIDE > 60).collect();
        let marked = cells.iter().filter(|&&is| is).count() as f64;
        let map = ProjectionMap::from_cells(&cells);
        assert_eq!(map.covered(), marked / 4096.0);
        // A third of a cell aside, so that bins also show where in the cells samples lie.
        let aside = DVec2::splat(1.0 / (3.0 * SIDE as f64));
        let density = |p: DVec2| {
            let cell = (p * SIDE as f64).as_ivec2();
            let is_marked = cells[cell.y as usize * SIDE + cell.x as usize];
            DEFENSIVE_FRACTION + if is_marked { (1.0 - DEFENSIVE_FRACTION) * 4096.0 / marked } else { 0.0 }
        };
        let sample = |sampler: &mut Sampler| {
            let (direction, pdf) = map.sample(sampler.next_2d());
            let square = octahedral::square_from_direction(direction);
            // Rounding may put a direction into the next cell.
            let near_edge = (square * SIDE as f64 - (square * SIDE as f64).round()).abs().min_element() < 1e-6;
            assert!(near_edge || (4.0 * PI * pdf / density(square) - 1.0).abs() < 1e-9, "pdf {pdf} at {square}");
            Some((square + aside).fract())
        };
        assert_has_density("projection map", sample, |p| density((p - aside + 1.0).fract()));
    }

    #[test]
    fn densities_integrate_to_one_and_cover_everything() {
        let cells: Vec<bool> = (0..SIDE * SIDE).map(|cell| cell % 37 == 0).collect();
        let map = ProjectionMap::from_cells(&cells);
        let n = 256;
        let mut reciprocal = 0.0;
        let mut mean = DVec3::ZERO;
        for k in 0..n * n {
            let u = DVec2::new(f64::from(k % n) + 0.5, f64::from(k / n) + 0.5) / f64::from(n);
            let (direction, pdf) = map.sample(u);
            reciprocal += 1.0 / pdf / f64::from(n * n);
            mean += direction / pdf / f64::from(n * n);
        }
        // The mean of 1 / pdf is the measure of the sphere; the midpoint rule sees most cells several times, the
        // defensive ones about twice.
        assert!((reciprocal - 4.0 * PI).abs() < 0.02 * 4.0 * PI, "{reciprocal}");
        assert!(mean.length() < 0.05 * 4.0 * PI, "{mean}");
    }
}
