//! Directions in which a light meets specular surfaces: the projection map \[Jensen96\].

use super::emission;
use super::light_choice::CHOSEN;
use crate::geometry::Primitive;
use crate::math::{Ray, Sampler, Stream, octahedral};
use crate::world::{Light, Surface, World};
use glam::DVec2;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Cells along a side of the square of directions.
const SIDE: usize = 64;
/// Rays along a side of a cell that look into it; one alone where there are so many lights that not all are asked.
const PROBES_ALONG_SIDE: u64 = 2;
/// Part of the paths that go where no specular surface was seen, in case the probes missed one.
const DEFENSIVE_PART: f64 = 0.03;

/// A density over directions, constant in each cell of the equal-area square.
#[derive(Clone, Debug)]
pub struct Guide {
    /// Cumulated probability of the rows, `SIDE + 1` values from 0 to 1.
    rows: Vec<f64>,
    /// For each row the cumulated probability of its cells.
    cells: Vec<[f64; SIDE + 1]>,
    /// Part of the sphere in which specular surfaces were seen.
    covered: f64,
}

impl Guide {
    /// The guide for a light, from rays that look for specular surfaces in every cell.
    pub(super) fn build(world: &World, light: &Light, light_index: u64) -> Self {
        let along = if world.lights.len() > CHOSEN { 1 } else { PROBES_ALONG_SIDE };
        let seen: Vec<bool> = (0..SIDE * SIDE)
            .into_par_iter()
            .with_min_len(64)
            .map(|cell| {
                (0..along * along).any(|probe| probe_hits_specular(world, light, light_index, cell, probe, along))
            })
            .collect();
        let mut wanted = dilated(&seen);
        for cell in cells_of_small_objects(world, light) {
            wanted[cell] = true;
        }
        Self::from_wanted(&wanted)
    }

    fn from_wanted(wanted: &[bool]) -> Self {
        let count = wanted.iter().filter(|&&w| w).count();
        let total = (SIDE * SIDE) as f64;
        let probability = |cell: usize| {
            let uniform = 1.0 / total;
            match (wanted[cell], count) {
                (_, 0) => uniform,
                (true, _) => (1.0 - DEFENSIVE_PART) / count as f64 + DEFENSIVE_PART * uniform,
                (false, _) => DEFENSIVE_PART * uniform,
            }
        };
        let mut rows = vec![0.0];
        let mut cells = Vec::with_capacity(SIDE);
        for row in 0..SIDE {
            let mut cumulated = [0.0; SIDE + 1];
            for column in 0..SIDE {
                cumulated[column + 1] = cumulated[column] + probability(row * SIDE + column);
            }
            let sum = cumulated[SIDE];
            cells.push(cumulated.map(|x| x / sum));
            rows.push(rows[row] + sum);
        }
        let all = rows[SIDE];
        rows.iter_mut().for_each(|x| *x /= all);
        Self { rows, cells, covered: count as f64 / total }
    }

    /// A direction and its density per steradian. Monotonous in both numbers, which keeps them well distributed.
    pub(super) fn sample(&self, u: DVec2) -> (glam::DVec3, f64) {
        let (row, y, row_probability) = invert(&self.rows, u.y);
        let (column, x, cell_probability) = invert(&self.cells[row], u.x);
        let square = DVec2::new(column as f64 + x, row as f64 + y) / SIDE as f64;
        let pdf = row_probability * cell_probability * (SIDE * SIDE) as f64 / (4.0 * PI);
        (octahedral::direction_from_square(square), pdf)
    }

    /// Part of the sphere in which specular surfaces were seen, 0 to 1.
    pub fn covered(&self) -> f64 {
        self.covered
    }
}

/// The interval of a cumulated distribution that holds x, where in it, and its probability.
fn invert(cumulated: &[f64], x: f64) -> (usize, f64, f64) {
    let index = cumulated.partition_point(|&c| c <= x).clamp(1, cumulated.len() - 1) - 1;
    let probability = cumulated[index + 1] - cumulated[index];
    (index, ((x - cumulated[index]) / probability).clamp(0.0, 1.0), probability)
}

/// Whether a ray into one of the `along` times `along` parts of a cell meets a specular surface first.
fn probe_hits_specular(world: &World, light: &Light, light_index: u64, cell: usize, probe: u64, along: u64) -> bool {
    let index = cell as u64 * along * along + probe;
    let mut sampler = Sampler::new(0, Stream::Probe, light_index, index);
    let origin = emission::origin(light, &mut sampler);
    let part = DVec2::new((probe % along) as f64, (probe / along) as f64);
    let within = (part + sampler.next_2d()) / along as f64;
    let corner = DVec2::new((cell % SIDE) as f64, (cell / SIDE) as f64);
    let direction = octahedral::direction_from_square((corner + within) / SIDE as f64);
    if origin.normal.is_some_and(|normal| normal.dot(direction) <= 0.0) {
        return false;
    }
    let ray = Ray { t_min: 1e-9 * world.radius, ..Ray::new(origin.position, direction) };
    world.aggregate.closest_hit(&ray).is_some_and(|hit| world.is_specular(hit.primitive))
}

/// Each marked cell with its eight neighbours.
fn dilated(marked: &[bool]) -> Vec<bool> {
    let near = |row: usize, column: usize| {
        let range = |x: usize| x.saturating_sub(1)..(x + 2).min(SIDE);
        range(row).any(|r| range(column).any(|c| marked[r * SIDE + c]))
    };
    (0..SIDE * SIDE).map(|cell| near(cell / SIDE, cell % SIDE)).collect()
}

/// Cells that point at specular primitives so small or so far that probes may miss them.
fn cells_of_small_objects(world: &World, light: &Light) -> Vec<usize> {
    let eye = light.center();
    let mut cells = Vec::new();
    for (index, primitive) in world.aggregate.primitives().iter().enumerate() {
        if matches!(primitive, Primitive::Plane(_)) || !world.is_specular(index as u32) {
            continue;
        }
        let bounds = primitive.bounds();
        let offset = bounds.center() - eye;
        // Two cells are seen at some 0.1 radians; larger things do not slip between 8 x 8 probes.
        if bounds.diagonal() < 0.1 * offset.length() {
            let square = octahedral::square_from_direction(offset.normalize()) * SIDE as f64;
            let (column, row) = (square.x as usize, square.y as usize);
            let range = |x: usize| x.saturating_sub(1)..(x + 2).min(SIDE);
            cells.extend(range(row).flat_map(|r| range(column).map(move |c| r * SIDE + c)));
        }
    }
    cells
}

impl World {
    /// Whether a primitive mirrors or refracts.
    pub(super) fn is_specular(&self, primitive: u32) -> bool {
        match self.surfaces[primitive as usize] {
            Surface::Object { material, .. } => self.materials[material as usize].is_specular(),
            Surface::Light(_) => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn densities_integrate_to_one_and_cover_everything() {
        let wanted: Vec<bool> = (0..SIDE * SIDE).map(|cell| cell % 37 == 0).collect();
        let guide = Guide::from_wanted(&wanted);
        let n = 256;
        let mut reciprocal = 0.0;
        let mut mean = DVec3::ZERO;
        for k in 0..n * n {
            let u = DVec2::new(f64::from(k % n) + 0.5, f64::from(k / n) + 0.5) / f64::from(n);
            let (direction, pdf) = guide.sample(u);
            reciprocal += 1.0 / pdf / f64::from(n * n);
            mean += direction / pdf / f64::from(n * n);
        }
        // The mean of 1 / pdf is the measure of the sphere; the midpoint rule sees most cells several times, the
        // defensive ones about twice.
        assert!((reciprocal - 4.0 * PI).abs() < 0.02 * 4.0 * PI, "{reciprocal}");
        assert!(mean.length() < 0.05 * 4.0 * PI, "{mean}");
    }
}
