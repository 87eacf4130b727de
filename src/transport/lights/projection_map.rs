//! The projection map: paths on which a light meets the surfaces that its photons are to reach \[Jensen96\].

use super::chart::{Aim, Chart, cones_of_objects, crossing_at};
use super::cone::Cone;
use super::emission::{self, Emission, Origin};
use super::light_sampler::MOST_SAMPLED;
use super::small_targets::{Cell, CellTree, Place, PlaceFromSquare, Target, Targets};
use crate::geometry::Primitive;
use crate::math::{Aabb, OrthonormalBasis, Ray, Sampler, Stream, warp};
use crate::world::{Light, World};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Cells along a side of the chart: of directions, a cell subtends about 3 degrees, narrower than most objects.
const SIDE: usize = 64;
/// Depth of the cells in a quadtree over the square.
const DEPTH: u32 = SIDE.ilog2();
/// Probe rays along a side of a cell; one in scenes where points sample only some of many lights. Three would take 37 000 instead of 16 000
/// rays for each light after an edit; with one, more mirrors are found by the defensive paths alone, which leaves their caustics noisy.
const PROBES_ALONG_SIDE: u64 = 2;
/// Least cells that a thread probes at a time, some ten microseconds of work: with fewer, sharing the work costs more than the work; with
/// more, a thread may wait for the last one.
const CELLS_PER_TASK: usize = SIDE;
/// Fraction of the paths that are even over the chart, in case the probes missed a specular surface (defensive sampling).
const DEFENSIVE_FRACTION: f64 = 0.03;
/// Diameter of a primitive in the chart (radians where the chart is of directions) below which all probe rays may miss the primitive. Two
/// cells are about as wide; a larger primitive does not slip between their probe rays.
const SMALL_PRIMITIVE: f64 = 0.1;
/// Radius of an object in the chart (radians where the chart is of directions) below which the cells around it are refined: it fills less than a cell.
const SMALL_OBJECT: f64 = 0.02;
/// Least fraction of the paths for a small object beside larger ones: in proportion to its solid angle it might get none. A larger fraction
/// would take paths from the caustics of larger objects; a smaller one would leave the caustic of a small object noisy.
const LEAST_FRACTION: f64 = 1.0 / 64.0;
/// Most that the least fractions of all small objects take together. More would leave few paths for larger objects beside hundreds of small
/// ones; less would make their caustics noisy.
const LEAST_FRACTIONS: f64 = 0.25;
/// Rays to a small object that tell whether the light meets it. Fewer may all miss an object of which others hide all but a tenth, whose
/// light is then left to the defensive paths; more would take time for each object and light after an edit.
const RAYS_TO_SMALL_OBJECT: u64 = 32;

/// A density of the first rays of paths over the chart of a light, constant in each cell.
#[derive(Clone, Debug)]
pub struct ProjectionMap {
    chart: Chart,
    /// Cumulative distribution of the rows, `SIDE + 1` values from 0 to 1.
    rows: Vec<f64>,
    /// Cumulative distribution of the cells of each row.
    cells: Vec<[f64; SIDE + 1]>,
    /// The cells that small objects refine, by their index.
    trees: BTreeMap<usize, CellTree>,
    /// Fraction of the chart in which the light meets the surfaces.
    covered: f64,
}

impl ProjectionMap {
    /// The projection map of a light for mirrors and glass.
    pub(in crate::transport) fn of_specular(world: &World, light: &Light, light_index: u64) -> Self {
        Self::build(world, light, light_index, None, &|p| world.is_specular(p))
    }

    /// The projection map of a light, from probe rays into every cell and to each object that appears small, and of the cone of the
    /// view.
    pub(super) fn build(world: &World, light: &Light, light_index: u64, view: Option<Cone>, aim: &impl Aim) -> Self {
        let chart = Chart::new(light);
        let is_small_cone = |cone: &Cone| cone.radius < SMALL_OBJECT;
        let small: BTreeMap<u32, (Aabb, Cone)> = cones_of_objects(world, &chart, aim)
            .into_iter()
            .filter_map(|(object, (bounds, cone))| Some((object, (bounds, cone.filter(is_small_cone)?))))
            .collect();
        let is_small = |p: u32| world.object_of(p).is_some_and(|object| small.contains_key(&object));
        let marks = |p: u32| aim(p) && !is_small(p);
        let along = if world.lights.len() > MOST_SAMPLED { 1 } else { PROBES_ALONG_SIDE };
        let place = chart.place_from_square();
        let probes = Probes { world, light, light_index, chart };
        let seen: Vec<bool> = (0..SIDE * SIDE)
            .into_par_iter()
            .with_min_len(CELLS_PER_TASK)
            .map(|cell| (0..along * along).any(|probe| probes.meet_in_cell(cell, probe, along, &marks)))
            .collect();
        let mut is_marked = dilated(&seen);
        for cell in cells_of_small_primitives(world, &chart, &marks) {
            is_marked[cell] = true;
        }
        if let Some(wide) = view.filter(|cone| !is_small_cone(cone)) {
            (0..SIDE * SIDE)
                .filter(|&cell| cell_at(cell).may_meet(&wide.target(), place))
                .for_each(|cell| is_marked[cell] = true);
        }
        let cones: Vec<Cone> = (0..)
            .zip(small)
            .filter_map(|(k, (object, (bounds, cone)))| {
                let of_object = |p: u32| aim(p) && world.object_of(p) == Some(object);
                probes.meet_small(k, &bounds, cone, &of_object).then_some(cone)
            })
            .collect();
        Self::from_cells(chart, &is_marked, &cones, view.filter(is_small_cone))
    }

    fn from_cells(chart: Chart, is_marked: &[bool], cones: &[Cone], view: Option<Cone>) -> Self {
        let count = is_marked.iter().filter(|&&is| is).count();
        let total = (SIDE * SIDE) as f64;
        let marked_area = count as f64 / total;
        let (targets, areas) = targets(cones, view, marked_area, chart.place_from_square());
        let of_targets: f64 = targets.list.iter().map(|target| target.path_fraction).sum();
        let rest = 1.0 - DEFENSIVE_FRACTION - of_targets;
        let probability = |cell: usize| {
            let uniform = 1.0 / total;
            match (is_marked[cell], count) {
                (_, 0) => (1.0 - of_targets) * uniform,
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
        let covered = match (view, targets.list.last(), areas.last()) {
            // As if all paths went to the view: the others bring little light there.
            (Some(_), Some(target), Some(area)) => area / target.path_fraction,
            _ => marked_area + areas.iter().sum::<f64>(),
        };
        Self { chart, rows, cells, trees, covered }
    }

    /// Samples a point of the unit square; returns it with its density. Monotonic in both numbers, so that stratified numbers give
    /// stratified paths.
    #[inline]
    fn sample(&self, u: DVec2) -> (DVec2, f64) {
        let (row, y, row_probability) = invert(&self.rows, u.y);
        let (column, x, cell_probability) = invert(&self.cells[row], u.x);
        let density = row_probability * cell_probability * (SIDE * SIDE) as f64;
        let (within, in_tree) = self
            .trees
            .get(&(row * SIDE + column))
            .map_or((DVec2::new(x, y), 1.0), |tree| tree.sample(DVec2::new(x, y)));
        ((DVec2::new(column as f64, row as f64) + within) / SIDE as f64, density * in_tree)
    }

    /// The density of [`ProjectionMap::sample`] at a point of the unit square.
    fn density(&self, square: DVec2) -> f64 {
        let square = square * SIDE as f64;
        let cell = square.floor().clamp(DVec2::ZERO, DVec2::splat((SIDE - 1) as f64));
        let (row, column) = (cell.y as usize, cell.x as usize);
        let probability =
            (self.rows[row + 1] - self.rows[row]) * (self.cells[row][column + 1] - self.cells[row][column]);
        let in_tree = self.trees.get(&(row * SIDE + column)).map_or(1.0, |tree| tree.density(square - cell));
        probability * (SIDE * SIDE) as f64 * in_tree
    }

    /// Density of the paths that leave this point of the light, per area across them at `point`, scene units.
    pub(super) fn path_density(&self, light_point: DVec3, point: DVec3) -> f64 {
        let offset = point - light_point;
        let direction = offset.normalize_or(DVec3::Z);
        match &self.chart {
            Chart::Directions { .. } => {
                self.density(self.chart.square_from_place(direction)) / (4.0 * PI * offset.length_squared())
            }
            Chart::Disc(rays) => {
                let at = rays.crossing(point, direction);
                let square = 0.5 * at + 0.5;
                let is_in = at.abs().max_element() <= 1.0 && (rays.from_outside || at.length_squared() <= 1.0);
                let per_area = self.density(square) / (2.0 * rays.radius).powi(2);
                if is_in { per_area / direction.dot(rays.direction) } else { 0.0 }
            }
        }
    }

    /// Samples the first ray of a path towards the surfaces; `None` where the light does not shine there.
    #[inline]
    pub(in crate::transport) fn emit(&self, light: &Light, sampler: &mut Sampler) -> Option<Emission> {
        if let Chart::Disc(rays) = &self.chart {
            let (square, density) = self.sample(sampler.next_2d());
            let (at, per_area) = (2.0 * square - 1.0, density / (2.0 * rays.radius).powi(2));
            let shines = rays.from_outside || at.length_squared() <= 1.0;
            return shines.then(|| emission::emit_parallel(rays, at, per_area, sampler));
        }
        let Origin { position, normal, strength } = emission::sample_origin(light, sampler);
        let (square, density) = self.sample(sampler.next_2d());
        let direction = self.chart.place_from_square()(square);
        let cos = normal.map_or(1.0, |n| n.dot(direction));
        let flux = strength * (cos / (density / (4.0 * PI))) as f32;
        (cos > 0.0).then_some(Emission { origin: position, direction, flux })
    }

    /// Fraction of the chart that the aimed paths cover: all of it, if the light meets none of the surfaces.
    pub(in crate::transport) fn aimed_fraction(&self) -> f64 {
        if self.covered > 0.0 { self.covered } else { 1.0 }
    }

    /// Fraction of the chart in which the light meets the surfaces, 0 to 1.
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
    chart: Chart,
}

/// The part of a probe ray that its place in the chart leaves open.
enum Start {
    Origin(Origin),
    /// The direction of a ray through a disc.
    Direction(DVec3),
}

impl Probes<'_> {
    /// Whether the probe ray into one of the `along` times `along` strata of a cell meets such a surface first.
    fn meet_in_cell(&self, cell: usize, probe: u64, along: u64, is_aim: &impl Aim) -> bool {
        let index = cell as u64 * along * along + probe;
        let mut sampler = Sampler::new(0, Stream::Probe, self.light_index, index);
        let start = self.start(&mut sampler);
        let stratum = DVec2::new((probe % along) as f64, (probe / along) as f64);
        let within = (stratum + sampler.next_2d()) / along as f64;
        let corner = DVec2::new((cell % SIDE) as f64, (cell / SIDE) as f64);
        self.meet(&start, self.chart.place_from_square()((corner + within) / SIDE as f64), is_aim)
    }

    /// Whether any of some rays to a box, which appears in a cone, meets such a surface first. From each point of a lamp the rays aim at the
    /// box as seen from there: a lamp larger than the box would miss it with most rays of the cone.
    fn meet_small(&self, box_index: u64, bounds: &Aabb, cone: Cone, is_aim: &impl Aim) -> bool {
        (0..RAYS_TO_SMALL_OBJECT).any(|k| {
            let index =
                (SIDE * SIDE) as u64 * PROBES_ALONG_SIDE * PROBES_ALONG_SIDE + box_index * RAYS_TO_SMALL_OBJECT + k;
            let mut sampler = Sampler::new(0, Stream::Probe, self.light_index, index);
            let start = self.start(&mut sampler);
            let u = sampler.next_2d();
            let place = match &start {
                Start::Origin(origin) => {
                    let seen = Cone::around(bounds.center() - origin.position, 0.5 * bounds.diagonal()).unwrap_or(cone);
                    // 1 - cos of the angle.
                    let height = 2.0 * (0.5 * seen.radius).sin().powi(2);
                    OrthonormalBasis::from_normal(seen.middle).world_from_local(warp::uniform_cone(u, height))
                }
                Start::Direction(_) => cone.middle + (cone.radius * warp::concentric_disc(u)).extend(0.0),
            };
            self.meet(&start, place, is_aim)
        })
    }

    fn start(&self, sampler: &mut Sampler) -> Start {
        match &self.chart {
            Chart::Directions { .. } => Start::Origin(emission::sample_origin(self.light, sampler)),
            Chart::Disc(rays) => Start::Direction(rays.sample_direction(sampler).0),
        }
    }

    fn meet(&self, start: &Start, place: Place, is_aim: &impl Aim) -> bool {
        let ray = match (&self.chart, start) {
            (Chart::Disc(rays), Start::Direction(direction)) => self.ray(rays.point(crossing_at(place)), *direction),
            (_, Start::Origin(origin)) if origin.normal.is_none_or(|normal| normal.dot(place) > 0.0) => {
                self.ray(origin.position, place)
            }
            _ => return false,
        };
        self.world.aggregate.closest_hit(&ray).is_some_and(|hit| is_aim(hit.primitive))
    }

    fn ray(&self, origin: DVec3, direction: DVec3) -> Ray {
        emission::ray_from_light(self.world, self.light, origin, direction)
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
fn cells_of_small_primitives(world: &World, chart: &Chart, is_aim: &impl Aim) -> Vec<usize> {
    let mut cells = Vec::new();
    for (index, primitive) in world.aggregate.primitives().iter().enumerate() {
        if matches!(primitive, Primitive::Plane(_)) || !is_aim(index as u32) {
            continue;
        }
        let bounds = primitive.bounds();
        let Some(cone) = chart.cone_of_light_center(bounds.center(), 0.5 * bounds.diagonal()) else { continue };
        let square = chart.square_from_place(cone.middle) * SIDE as f64;
        if 2.0 * cone.radius < SMALL_PRIMITIVE && square.cmpge(DVec2::ZERO).all() {
            let (column, row) = (square.x as usize, square.y as usize);
            let range = |x: usize| x.saturating_sub(1)..(x + 2).min(SIDE);
            cells.extend(range(row).flat_map(|r| range(column).map(move |c| r * SIDE + c)));
        }
    }
    cells
}

/// The targets of the cones, and of the view as the last one, beside cells that cover this area of the unit square, and the areas that the
/// targets cover. Each gets a fraction of the paths in proportion to its area, but not less than [`LEAST_FRACTION`], the view as much as
/// all cells and cones together.
fn targets(
    cones: &[Cone],
    view: Option<Cone>,
    marked_area: f64,
    place_from_square: PlaceFromSquare,
) -> (Targets, Vec<f64>) {
    let list: Vec<Target> = cones.iter().chain(&view).map(Cone::target).collect();
    let mut targets = Targets { list, place_from_square };
    let areas = targets.covered_areas();
    let least = LEAST_FRACTION.min(LEAST_FRACTIONS / cones.len() as f64);
    let of_cones = &areas[..cones.len()];
    let total = marked_area + of_cones.iter().sum::<f64>();
    let mut weights: Vec<f64> = of_cones.iter().map(|area| (area / total).max(least)).collect();
    let sum = weights.iter().sum::<f64>() + if marked_area > 0.0 { marked_area / total } else { 0.0 };
    weights.extend(view.map(|_| if sum > 0.0 { sum } else { 1.0 }));
    let sum = sum + view.and(weights.last()).copied().unwrap_or(0.0);
    for (target, weight) in targets.list.iter_mut().zip(weights) {
        target.path_fraction = (1.0 - DEFENSIVE_FRACTION) * weight / sum;
    }
    (targets, areas)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Rgb;
    use crate::math::chi_square::assert_has_density;
    use crate::world::ParallelRays;

    /// A point light at the origin.
    fn lamp() -> Light {
        Light::Point { position: DVec3::ZERO, intensity: Rgb::ONE }
    }

    /// A beam of radius 2.
    fn beam() -> ParallelRays {
        ParallelRays {
            direction: DVec3::new(0.6, 0.0, 0.8),
            half_angle: 0.0,
            irradiance: Rgb::ONE,
            center: DVec3::new(1.0, 2.0, 3.0),
            radius: 2.0,
            from_outside: false,
        }
    }

    fn some_cells() -> Vec<bool> {
        (0..SIDE * SIDE).map(|cell| cell % 37 == 0 || cell / SIDE > 60).collect()
    }

    /// Marked cells divide all probability but the defensive fraction, which is even over the chart.
    #[test]
    fn samples_have_their_density() {
        let cells = some_cells();
        let marked = cells.iter().filter(|&&is| is).count() as f64;
        let map = ProjectionMap::from_cells(Chart::new(&lamp()), &cells, &[], None);
        assert_eq!(map.covered(), marked / 4096.0);
        // A third of a cell aside, so that bins also show where in the cells samples lie.
        let aside = DVec2::splat(1.0 / (3.0 * SIDE as f64));
        let density = |p: DVec2| {
            let cell = (p * SIDE as f64).as_ivec2();
            let is_marked = cells[cell.y as usize * SIDE + cell.x as usize];
            DEFENSIVE_FRACTION + if is_marked { (1.0 - DEFENSIVE_FRACTION) * 4096.0 / marked } else { 0.0 }
        };
        let sample = |sampler: &mut Sampler| {
            let (square, sampled) = map.sample(sampler.next_2d());
            // Rounding may put a point into the next cell.
            let near_edge = (square * SIDE as f64 - (square * SIDE as f64).round()).abs().min_element() < 1e-6;
            assert!(near_edge || (sampled / density(square) - 1.0).abs() < 1e-9, "density {sampled} at {square}");
            Some((square + aside).fract())
        };
        assert_has_density("projection map", sample, |p| density((p - aside + 1.0).fract()));
    }

    /// With a wide and a narrow cone over marked cells.
    #[test]
    fn paths_from_a_lamp_have_the_density_that_mis_weights_take() {
        let chart = Chart::new(&lamp());
        let cone = |x: f64, y: f64, radius| Cone { middle: chart.place_from_square()(DVec2::new(x, y)), radius };
        let map = ProjectionMap::from_cells(chart, &some_cells(), &[cone(0.3, 0.6, 0.3)], Some(cone(0.71, 0.24, 0.02)));
        let sample = |sampler: &mut Sampler| {
            let Emission { origin, direction, flux } = map.emit(&lamp(), sampler)?;
            let expected = 1.0 / map.path_density(origin, origin + direction);
            assert!((f64::from(flux.x) / expected - 1.0).abs() < 1e-4, "the flux is 1 over the density: {flux}");
            Some(chart.square_from_place(direction))
        };
        let density = |p| 4.0 * PI * map.path_density(DVec3::ZERO, 2.0 * chart.place_from_square()(p)) * 4.0;
        assert_has_density("lamp", sample, density);
    }

    #[test]
    fn paths_of_a_beam_have_the_density_that_mis_weights_take_within_its_disc() {
        let (rays, light) = (beam(), Light::Parallel(beam()));
        let chart = Chart::new(&light);
        let cone = Cone { middle: chart.place_from_square()(DVec2::new(0.4, 0.6)), radius: 0.2 };
        let map = ProjectionMap::from_cells(chart, &some_cells(), &[cone], None);
        let sample = |sampler: &mut Sampler| {
            let Emission { origin, direction, .. } = map.emit(&light, sampler)?;
            assert!(origin.distance(rays.center) <= 2.0 + 1e-9 && direction == rays.direction);
            Some(0.5 * rays.crossing(origin, direction) + 0.5)
        };
        let density = |p: DVec2| {
            let point = rays.point(2.0 * p - 1.0);
            16.0 * map.path_density(point, point + 5.0 * rays.direction)
        };
        assert_has_density("beam", sample, density);
    }

    #[test]
    fn densities_integrate_to_one_and_cover_everything() {
        let cells: Vec<bool> = (0..SIDE * SIDE).map(|cell| cell % 37 == 0).collect();
        let map = ProjectionMap::from_cells(Chart::new(&lamp()), &cells, &[], None);
        let n = 256;
        let mut reciprocal = 0.0;
        let mut mean = DVec3::ZERO;
        for k in 0..n * n {
            let u = DVec2::new(f64::from(k % n) + 0.5, f64::from(k / n) + 0.5) / f64::from(n);
            let (square, density) = map.sample(u);
            let weight = 1.0 / density / f64::from(n * n);
            reciprocal += weight;
            mean += map.chart.place_from_square()(square) * weight;
        }
        // The mean of 1 / density is the area of the square; the midpoint rule sees most cells several times, the
        // defensive ones about twice.
        assert!((reciprocal - 1.0).abs() < 0.02, "{reciprocal}");
        assert!(mean.length() < 0.05, "{mean}");
    }
}
