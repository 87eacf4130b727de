//! The projection map: directions in which a light meets the surfaces that its photons are to reach \[Jensen96\].

use super::cone::{Aim, Cone, cones_of_objects};
use super::emission::{self, Emission, Origin};
use super::light_sampler::MOST_SAMPLED;
use super::small_targets::{Cell, CellTree, Target, covered_areas};
use crate::geometry::Primitive;
use crate::math::{OrthonormalBasis, Sampler, Stream, octahedral, warp};
use crate::world::{Light, World};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Cells along a side of the square of directions: a cell subtends about 3 degrees, narrower than most objects.
const SIDE: usize = 64;
/// Depth of the cells in a quadtree over the square.
const DEPTH: u32 = SIDE.ilog2();
/// Probe rays along a side of a cell; one in scenes where points sample only some of many lights. Three would take 37 000 instead of 16 000
/// rays for each light after an edit; with one, more mirrors are found by the defensive paths alone, which leaves their caustics noisy.
const PROBES_ALONG_SIDE: u64 = 2;
/// Least cells that a thread probes at a time, some ten microseconds of work: with fewer, sharing the work costs more than the work; with
/// more, a thread may wait for the last one.
const CELLS_PER_TASK: usize = SIDE;
/// Fraction of the paths that leave in all directions alike, in case the probes missed a specular surface (defensive sampling).
const DEFENSIVE_FRACTION: f64 = 0.03;
/// Diagonal of a primitive's bounding box over its distance from the light, below which all probe rays may miss the primitive. Two cells
/// subtend about as many radians; a larger primitive does not slip between their probe rays.
const SMALL_PRIMITIVE: f64 = 0.1;
/// Half the angle, radians, under which an object appears, below which the cells around it are refined: it fills less than a cell.
const SMALL_OBJECT: f64 = 0.02;
/// Least share of the paths for a small object beside larger ones: in proportion to its solid angle it might get none.
const LEAST_SHARE: f64 = 1.0 / 64.0;
/// Most that the least shares of all small objects take.
const LEAST_SHARES: f64 = 0.25;
/// Rays to a small object that tell whether the light meets it.
const RAYS_TO_SMALL_OBJECT: u64 = 32;

/// A density over the sphere of directions, constant in each cell of the equal-area octahedral square \[Clarberg08\].
#[derive(Clone, Debug)]
pub struct ProjectionMap {
    /// Cumulative distribution of the rows, `SIDE + 1` values from 0 to 1.
    rows: Vec<f64>,
    /// Cumulative distribution of the cells of each row.
    cells: Vec<[f64; SIDE + 1]>,
    /// The cells that small objects refine, by their index.
    trees: BTreeMap<usize, CellTree>,
    /// Fraction of the sphere in which the light meets the surfaces.
    covered: f64,
}

impl ProjectionMap {
    /// The projection map of a light for mirrors and glass.
    pub(in crate::transport) fn of_specular(world: &World, light: &Light, light_index: u64) -> Self {
        Self::build(world, light, light_index, None, &|p| world.is_specular(p))
    }

    /// The projection map of a light, from probe rays into every cell and to each object that appears small, and of a cone of directions.
    pub(super) fn build(world: &World, light: &Light, light_index: u64, cone: Option<Cone>, aim: &impl Aim) -> Self {
        let is_small_cone = |cone: &Cone| cone.radius < SMALL_OBJECT;
        let small: BTreeMap<u32, Cone> = cones_of_objects(world, light, aim)
            .into_iter()
            .filter_map(|(object, cone)| Some((object, cone.filter(is_small_cone)?)))
            .collect();
        let is_small = |p: u32| world.object_of(p).is_some_and(|object| small.contains_key(&object));
        let marks = |p: u32| aim(p) && !is_small(p);
        let along = if world.lights.len() > MOST_SAMPLED { 1 } else { PROBES_ALONG_SIDE };
        let probes = Probes { world, light, light_index };
        let seen: Vec<bool> = (0..SIDE * SIDE)
            .into_par_iter()
            .with_min_len(CELLS_PER_TASK)
            .map(|cell| (0..along * along).any(|probe| probes.meet_in_cell(cell, probe, along, &marks)))
            .collect();
        let mut is_marked = dilated(&seen);
        for cell in cells_of_small_primitives(world, light, &marks) {
            is_marked[cell] = true;
        }
        if let Some(wide) = cone.filter(|cone| !is_small_cone(cone)) {
            (0..SIDE * SIDE)
                .filter(|&cell| cell_at(cell).may_meet(&wide.target()))
                .for_each(|cell| is_marked[cell] = true);
        }
        let mut cones: Vec<Cone> = (0..)
            .zip(small)
            .filter_map(|(k, (object, cone))| {
                let of_object = |p: u32| aim(p) && world.object_of(p) == Some(object);
                probes.meet_in_cone(k, cone, &of_object).then_some(cone)
            })
            .collect();
        cones.extend(cone.filter(is_small_cone));
        Self::from_cells(&is_marked, &cones)
    }

    fn from_cells(is_marked: &[bool], cones: &[Cone]) -> Self {
        let count = is_marked.iter().filter(|&&is| is).count();
        let total = (SIDE * SIDE) as f64;
        let marked_area = count as f64 / total;
        let (targets, areas) = targets(cones, marked_area);
        let small_share: f64 = targets.iter().map(|target| target.share).sum();
        let rest = 1.0 - DEFENSIVE_FRACTION - small_share;
        let probability = |cell: usize| {
            let uniform = 1.0 / total;
            match (is_marked[cell], count) {
                (_, 0) => (1.0 - small_share) * uniform,
                (true, _) => rest / count as f64 + DEFENSIVE_FRACTION * uniform,
                (false, _) => DEFENSIVE_FRACTION * uniform,
            }
        };
        let mut trees = BTreeMap::new();
        let mut rows = vec![0.0];
        let mut cells = Vec::with_capacity(SIDE);
        for row in 0..SIDE {
            let mut cumulative = [0.0; SIDE + 1];
            for column in 0..SIDE {
                let index = row * SIDE + column;
                let mut mass = probability(index);
                if let Some((tree, with_targets)) = CellTree::new(cell_at(index), &targets, &areas, mass * total) {
                    mass = with_targets;
                    trees.insert(index, tree);
                }
                cumulative[column + 1] = cumulative[column] + mass;
            }
            let sum = cumulative[SIDE];
            cells.push(cumulative.map(|x| x / sum));
            rows.push(rows[row] + sum);
        }
        let all = rows[SIDE];
        rows.iter_mut().for_each(|x| *x /= all);
        Self { rows, cells, trees, covered: marked_area + areas.iter().sum::<f64>() }
    }

    /// Samples a direction; returns it with its density per steradian. Monotonic in both numbers, so that stratified numbers give
    /// stratified directions.
    #[inline]
    fn sample(&self, u: DVec2) -> (DVec3, f64) {
        let (row, y, row_probability) = invert(&self.rows, u.y);
        let (column, x, cell_probability) = invert(&self.cells[row], u.x);
        let pdf = row_probability * cell_probability * (SIDE * SIDE) as f64 / (4.0 * PI);
        let (within, density) = self
            .trees
            .get(&(row * SIDE + column))
            .map_or((DVec2::new(x, y), 1.0), |tree| tree.sample(DVec2::new(x, y)));
        let square = (DVec2::new(column as f64, row as f64) + within) / SIDE as f64;
        (octahedral::direction_from_square(square), pdf * density)
    }

    /// The density of [`ProjectionMap::emit`] in a direction, per steradian.
    pub(super) fn pdf(&self, direction: DVec3) -> f64 {
        let square = octahedral::square_from_direction(direction) * SIDE as f64;
        let cell = square.floor().clamp(DVec2::ZERO, DVec2::splat((SIDE - 1) as f64));
        let (row, column) = (cell.y as usize, cell.x as usize);
        let probability =
            (self.rows[row + 1] - self.rows[row]) * (self.cells[row][column + 1] - self.cells[row][column]);
        let density = self.trees.get(&(row * SIDE + column)).map_or(1.0, |tree| tree.density(square - cell));
        probability * density * (SIDE * SIDE) as f64 / (4.0 * PI)
    }

    /// Samples the first ray of a path towards the surfaces; `None` where the light does not shine in the sampled direction.
    #[inline]
    pub(in crate::transport) fn emit(&self, light: &Light, sampler: &mut Sampler) -> Option<Emission> {
        let Origin { position, normal, strength } = emission::sample_origin(light, sampler);
        let (direction, pdf) = self.sample(sampler.next_2d());
        let cos = normal.map_or(1.0, |n| n.dot(direction));
        (cos > 0.0).then(|| Emission { origin: position, direction, flux: strength * (cos / pdf) as f32 })
    }

    /// Fraction of the sphere of directions that the aimed paths share: everywhere, if the light meets none of the surfaces.
    pub(in crate::transport) fn aimed_fraction(&self) -> f64 {
        if self.covered > 0.0 { self.covered } else { 1.0 }
    }

    /// Fraction of the sphere of directions in which the light meets the surfaces, 0 to 1.
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

/// The cell of this index.
fn cell_at(index: usize) -> Cell {
    Cell { depth: DEPTH, x: (index % SIDE) as u64, y: (index / SIDE) as u64 }
}

/// Probe rays from a light.
struct Probes<'a> {
    world: &'a World,
    light: &'a Light,
    light_index: u64,
}

impl Probes<'_> {
    /// Whether the probe ray into one of the `along` times `along` strata of a cell meets such a surface first.
    fn meet_in_cell(&self, cell: usize, probe: u64, along: u64, is_aim: &impl Aim) -> bool {
        let index = cell as u64 * along * along + probe;
        let mut sampler = Sampler::new(0, Stream::Probe, self.light_index, index);
        let origin = emission::sample_origin(self.light, &mut sampler);
        let stratum = DVec2::new((probe % along) as f64, (probe / along) as f64);
        let within = (stratum + sampler.next_2d()) / along as f64;
        let corner = DVec2::new((cell % SIDE) as f64, (cell / SIDE) as f64);
        let direction = octahedral::direction_from_square((corner + within) / SIDE as f64);
        self.meet(&origin, direction, is_aim)
    }

    /// Whether any of some rays in a cone of directions meets such a surface first.
    fn meet_in_cone(&self, cone_index: u64, cone: Cone, is_aim: &impl Aim) -> bool {
        let basis = OrthonormalBasis::from_normal(cone.direction);
        // 1 - cos of the angle.
        let height = 2.0 * (0.5 * cone.radius).sin().powi(2);
        (0..RAYS_TO_SMALL_OBJECT).any(|k| {
            let index =
                (SIDE * SIDE) as u64 * PROBES_ALONG_SIDE * PROBES_ALONG_SIDE + cone_index * RAYS_TO_SMALL_OBJECT + k;
            let mut sampler = Sampler::new(0, Stream::Probe, self.light_index, index);
            let origin = emission::sample_origin(self.light, &mut sampler);
            self.meet(&origin, basis.world_from_local(warp::uniform_cone(sampler.next_2d(), height)), is_aim)
        })
    }

    fn meet(&self, origin: &Origin, direction: DVec3, is_aim: &impl Aim) -> bool {
        if origin.normal.is_some_and(|normal| normal.dot(direction) <= 0.0) {
            return false;
        }
        let ray = emission::ray_from_light(self.light, origin.position, direction);
        self.world.aggregate.closest_hit(&ray).is_some_and(|hit| is_aim(hit.primitive))
    }
}

/// The marked cells and their eight neighbours.
fn dilated(marked: &[bool]) -> Vec<bool> {
    let near = |row: usize, column: usize| {
        let range = |x: usize| x.saturating_sub(1)..(x + 2).min(SIDE);
        range(row).any(|r| range(column).any(|c| marked[r * SIDE + c]))
    };
    (0..SIDE * SIDE).map(|cell| near(cell / SIDE, cell % SIDE)).collect()
}

/// Cells towards primitives that appear smaller than [`SMALL_PRIMITIVE`].
fn cells_of_small_primitives(world: &World, light: &Light, is_aim: &impl Aim) -> Vec<usize> {
    let center = light.center();
    let mut cells = Vec::new();
    for (index, primitive) in world.aggregate.primitives().iter().enumerate() {
        if matches!(primitive, Primitive::Plane(_)) || !is_aim(index as u32) {
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

/// The targets of the cones beside cells that cover this area of the unit square, and the areas that the targets cover. Each gets a share
/// of the paths in proportion to its area, but not less than [`LEAST_SHARE`].
fn targets(cones: &[Cone], marked_area: f64) -> (Vec<Target>, Vec<f64>) {
    let mut targets: Vec<Target> = cones.iter().map(Cone::target).collect();
    let areas = covered_areas(&targets);
    let least = LEAST_SHARE.min(LEAST_SHARES / cones.len() as f64);
    let total = marked_area + areas.iter().sum::<f64>();
    let weights: Vec<f64> = areas.iter().map(|area| (area / total).max(least)).collect();
    let sum = marked_area / total + weights.iter().sum::<f64>();
    for (target, weight) in targets.iter_mut().zip(weights) {
        target.share = (1.0 - DEFENSIVE_FRACTION) * weight / sum;
    }
    (targets, areas)
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
        let map = ProjectionMap::from_cells(&cells, &[]);
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
        let map = ProjectionMap::from_cells(&cells, &[]);
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
