//! The projection map: paths on which a light meets the surfaces that its photons are to reach \[Jensen96\].

use super::bundle::Bundle;
use super::chart::Chart;
use super::cone::Cone;
use super::emission::{self, Emission, Origin};
use super::light_sampler::MOST_SAMPLED;
use super::probe_rays::{PROBES_ALONG_SIDE, Probes, SIDE};
use super::rays_to_ball::{Aim, RaysToBall, ball_around, balls_of_objects, fraction_of_objects, rays_to_view};
use super::small_targets::{Cell, CellTree, Target, Targets};
use crate::geometry::{Primitive, Sphere};
use crate::math::Sampler;
use crate::world::{Light, World};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::iter;

/// Depth of the cells in a quadtree over the square.
const DEPTH: u32 = SIDE.ilog2();
/// Least cells that a thread probes at a time, some ten microseconds of work: with fewer, sharing the work costs more than the work; with
/// more, a thread may wait for the last one.
const CELLS_PER_TASK: usize = SIDE;
/// Fraction of the paths that are even over the chart, in case the probes missed a specular surface (defensive sampling).
const DEFENSIVE_FRACTION: f64 = 0.03;
/// Diameter of a primitive in the chart (radians where the chart is of directions) below which all probe rays may miss the primitive. Two
/// cells are about as wide; a larger primitive does not slip between their probe rays.
const SMALL_PRIMITIVE: f64 = 0.1;
/// Least fraction of the paths for a small object beside larger ones: in proportion to its solid angle it might get none. A larger fraction
/// would take paths from the caustics of larger objects; a smaller one would leave the caustic of a small object noisy.
const LEAST_FRACTION: f64 = 1.0 / 64.0;
/// Most that the least fractions of all small objects take together. More would leave few paths for larger objects beside hundreds of small
/// ones; less would make their caustics noisy.
const LEAST_FRACTIONS: f64 = 0.25;
/// Most small objects that a wide light aims at one by one, because the density of a path is a sum over them. Beyond, cells aim at them as at
/// large ones, which wastes more paths.
const MOST_BUNDLES: usize = 64;

/// Radius of a ball around what the camera sees, over that of what the film shows: light through flat glass goes straight on, and is at most a
/// little aside.
const AROUND_VIEW: f64 = 2.0;
/// Rays to mirrors and glass over rays to the view from which on half of the photons aim at the view. With a much smaller value other
/// caustics would lose more by that half than the view gains.
const SPREAD: f64 = 16.0;
/// Least fraction of the rays to the view that meet mirrors and glass first, for photons of caustics to aim there. At a smaller one hardly
/// more of them would matter than of those that aim at all mirrors and glass.
const LEAST_MET: f64 = 1.0 / 16.0;

/// A density of the first rays of paths: over the chart of a light, constant in each cell, and in bundles.
#[derive(Clone, Debug)]
pub struct ProjectionMap {
    /// Bundles with their fractions of the paths.
    bundles: Vec<(Bundle, f64)>,
    /// Fraction of the paths over the chart.
    chart_fraction: f64,
    chart: Chart,
    /// Cumulative distribution of the rows, `SIDE + 1` values from 0 to 1.
    rows: Vec<f64>,
    /// Cumulative distribution of the cells of each row.
    cells: Vec<[f64; SIDE + 1]>,
    /// Whether the light meets the surfaces in each cell.
    is_marked: Vec<bool>,
    /// The cells that small objects refine, by their index.
    trees: BTreeMap<usize, CellTree>,
    /// Fraction of the chart in which the light meets the surfaces.
    covered: f64,
}

impl ProjectionMap {
    /// The projection map of a light for mirrors and glass.
    pub(in crate::transport) fn of_specular(world: &World, light: &Light, light_index: u64) -> Self {
        let aim = |p| world.is_specular(p);
        let chart = Chart::new(light);
        let by_objects = fraction_of_objects(world, light, &chart, &aim);
        let probes = Probes { world, light, light_index, chart };
        let seen = Sphere { center: world.view.center, radius: AROUND_VIEW * world.view.radius() };
        let views: Vec<RaysToBall> = [Some(seen), world.view.specular]
            .into_iter()
            .flatten()
            .filter_map(|ball| {
                let rays = rays_to_view(light, &chart, ball, by_objects, SPREAD)?;
                let (met, all) = probes.count_met(0, ball, rays, &aim);
                (met as f64 > LEAST_MET * all as f64).then_some(rays)
            })
            .collect();
        Self::build(world, light, light_index, &views, &aim)
    }

    /// The projection map of a light, from probe rays into every cell and to each object that appears small, and of the rays to the view.
    pub(super) fn build(world: &World, light: &Light, light_index: u64, views: &[RaysToBall], aim: &impl Aim) -> Self {
        let chart = Chart::new(light);
        let small = small_objects(world, light, &chart, aim);
        let is_small = |p: u32| world.object_of(p).is_some_and(|object| small.contains_key(&object));
        let marks = |p: u32| aim(p) && !is_small(p);
        let along = if world.lights.len() > MOST_SAMPLED { 1 } else { PROBES_ALONG_SIDE };
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
        let met: Vec<RaysToBall> = (0..)
            .zip(small)
            .filter_map(|(k, (object, (ball, rays)))| {
                let of_object = |p: u32| aim(p) && world.object_of(p) == Some(object);
                (probes.count_met(k, ball, rays, &of_object).0 > 0).then_some(rays)
            })
            .collect();
        Self::from_cells(light, chart, &is_marked, &met, views)
    }

    fn from_cells(
        light: &Light,
        chart: Chart,
        is_marked: &[bool],
        objects: &[RaysToBall],
        views: &[RaysToBall],
    ) -> Self {
        let count = is_marked.iter().filter(|&&is| is).count();
        let marked_area = count as f64 / (SIDE * SIDE) as f64;
        let all_rays: Vec<RaysToBall> = objects.iter().chain(views).copied().collect();
        let list: Vec<Target> = all_rays.iter().filter_map(RaysToBall::cone).map(Cone::target).collect();
        let mut targets = Targets { list, place_from_square: chart.place_from_square() };
        let areas_in_chart = targets.covered_areas();
        let mut in_chart = areas_in_chart.iter();
        let areas: Vec<f64> = all_rays
            .iter()
            .filter_map(
                |rays| if rays.cone().is_some() { in_chart.next().copied() } else { Some(rays.fraction_of(light)) },
            )
            .collect();
        let fractions = path_fractions(&areas, views.len(), marked_area);
        let mut cones = targets.list.iter_mut();
        let mut bundles = Vec::new();
        for (rays, &fraction) in all_rays.iter().zip(&fractions) {
            match rays {
                RaysToBall::Cone(_) => cones.next().into_iter().for_each(|target| target.path_fraction = fraction),
                RaysToBall::Bundle(bundle) => bundles.push((*bundle, fraction)),
            }
        }
        let of_targets: f64 = fractions.iter().sum();
        let rest = 1.0 - DEFENSIVE_FRACTION - of_targets;
        let even = |cell: usize| match (is_marked[cell], count) {
            (_, 0) => 1.0 - of_targets,
            (true, _) => rest / marked_area + DEFENSIVE_FRACTION,
            (false, _) => DEFENSIVE_FRACTION,
        };
        let (rows, cells, trees) = distribution(even, &targets, &areas_in_chart);
        // As if all paths went to the view: the others bring little light there.
        let of_views = areas.iter().zip(&fractions).skip(objects.len()).map(|(area, fraction)| area / fraction);
        let covered = of_views.reduce(f64::max).unwrap_or(marked_area + areas.iter().sum::<f64>());
        let chart_fraction = 1.0 - bundles.iter().map(|(_, fraction)| fraction).sum::<f64>();
        Self { bundles, chart_fraction, chart, rows, cells, is_marked: is_marked.to_vec(), trees, covered }
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
    pub(super) fn path_density(&self, light: &Light, light_point: DVec3, point: DVec3) -> f64 {
        let offset = point - light_point;
        let direction = offset.normalize_or(DVec3::Z);
        let density = self.ray_density(light, light_point, direction, None);
        match &self.chart {
            Chart::Directions { .. } => density / offset.length_squared(),
            Chart::Disc(_) => density,
        }
    }

    /// Density of the rays in this direction, from a point of an area light per steradian, of parallel rays per area across them. A ray that
    /// was sampled in a bundle counts as one of it, whatever rounding does at the bundle's edge.
    fn ray_density(&self, light: &Light, light_point: DVec3, direction: DVec3, sampled: Option<usize>) -> f64 {
        let in_chart = match &self.chart {
            Chart::Directions { .. } => self.density(self.chart.square_from_place(direction)) / (4.0 * PI),
            Chart::Disc(rays) => {
                let at = rays.crossing(light_point, direction);
                let square = 0.5 * at + 0.5;
                let is_in = at.abs().max_element() <= 1.0 && (rays.from_outside || at.length_squared() <= 1.0);
                let per_area = self.density(square) / (2.0 * rays.radius).powi(2);
                if is_in { per_area / direction.dot(rays.direction) } else { 0.0 }
            }
        };
        if self.bundles.is_empty() {
            return in_chart;
        }
        let of_bundle = |(k, (bundle, fraction)): (usize, &(Bundle, f64))| {
            let is_in = sampled == Some(k) || bundle.contains(light_point, direction);
            if is_in { fraction * bundle.density() } else { 0.0 }
        };
        let in_bundles: f64 = self.bundles.iter().enumerate().map(of_bundle).sum();
        self.chart_fraction * in_chart + in_bundles * emission::etendue_ratio(light, light_point, direction)
    }

    /// Samples the first ray of a path towards the surfaces; `None` where the light does not shine there.
    #[inline]
    pub(in crate::transport) fn emit(&self, light: &Light, sampler: &mut Sampler) -> Option<Emission> {
        if self.bundles.is_empty() { self.emit_in_chart(light, sampler) } else { self.emit_in_mixture(light, sampler) }
    }

    fn emit_in_chart(&self, light: &Light, sampler: &mut Sampler) -> Option<Emission> {
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

    /// Samples a ray over the chart or in one of the bundles, with the density of all together.
    fn emit_in_mixture(&self, light: &Light, sampler: &mut Sampler) -> Option<Emission> {
        let mut u = sampler.next_1d() - self.chart_fraction;
        let mut sampled = None;
        let (origin, direction) = if u < 0.0 {
            let Emission { origin, direction, .. } = self.emit_in_chart(light, sampler)?;
            (origin, direction)
        } else {
            let last = self.bundles.len() - 1;
            let chosen = self.bundles.iter().position(|(_, fraction)| {
                u -= fraction;
                u < 0.0
            });
            let k = chosen.unwrap_or(last);
            sampled = Some(k);
            self.bundles[k].0.sample(light, sampler)?
        };
        let ratio = emission::etendue_ratio(light, origin, direction);
        let density = self.ray_density(light, origin, direction, sampled) / ratio;
        Some(Emission { origin, direction, flux: emission::radiance(light) / density as f32 })
    }

    /// Fraction of the chart that the aimed paths cover: all of it, if the light meets none of the surfaces.
    pub(in crate::transport) fn aimed_fraction(&self) -> f64 {
        if self.covered > 0.0 { self.covered } else { 1.0 }
    }

    /// Whether cells alone tell where the paths go: no small object needs more of them.
    pub(in crate::transport) fn is_by_cells(&self) -> bool {
        self.trees.is_empty() && self.bundles.is_empty()
    }

    /// Whether the light may meet the surfaces in the rectangle of the unit square between two corners.
    pub(in crate::transport) fn aims_between(&self, min: DVec2, max: DVec2) -> bool {
        let cell = |at: DVec2| (at * SIDE as f64).floor().clamp(DVec2::ZERO, DVec2::splat((SIDE - 1) as f64));
        let (first, last) = (cell(min), cell(max));
        let mut rows = first.y as usize..=last.y as usize;
        rows.any(|row| (first.x as usize..=last.x as usize).any(|column| self.is_marked[row * SIDE + column]))
    }

    /// Number of cells in which the light may meet the surfaces.
    pub(in crate::transport) fn aimed_cells(&self) -> u64 {
        self.is_marked.iter().filter(|&&is_marked| is_marked).count() as u64
    }

    /// Fraction of the chart in which the light meets the surfaces, 0 to 1.
    pub fn covered(&self) -> f64 {
        self.covered
    }
}

/// The cumulative distributions of the rows and of the cells of each row, and the trees of the cells that targets refine, for targets that
/// cover these areas over an even density in each cell, per area of the unit square.
fn distribution(
    even: impl Fn(usize) -> f64,
    targets: &Targets,
    areas: &[f64],
) -> (Vec<f64>, Vec<[f64; SIDE + 1]>, BTreeMap<usize, CellTree>) {
    let mut trees = BTreeMap::new();
    let mut rows = vec![0.0];
    let mut cells = Vec::with_capacity(SIDE);
    for row in 0..SIDE {
        let mut cumulative = [0.0; SIDE + 1];
        for column in 0..SIDE {
            let index = row * SIDE + column;
            let (tree, mass) = CellTree::new(cell_at(index), targets, areas, even(index));
            trees.extend(tree.map(|tree| (index, tree)));
            cumulative[column + 1] = cumulative[column] + mass;
        }
        let sum = cumulative[SIDE];
        cells.push(cumulative.map(|x| x / sum));
        rows.push(rows[row] + sum);
    }
    let all = rows[SIDE];
    rows.iter_mut().for_each(|x| *x /= all);
    (rows, cells, trees)
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
        let Some(cone) = chart.cone_of_light_center(ball_around(&primitive.bounds())) else { continue };
        let square = chart.square_from_place(cone.middle) * SIDE as f64;
        if 2.0 * cone.radius < SMALL_PRIMITIVE && square.cmpge(DVec2::ZERO).all() {
            let (column, row) = (square.x as usize, square.y as usize);
            let range = |x: usize| x.saturating_sub(1)..(x + 2).min(SIDE);
            cells.extend(range(row).flat_map(|r| range(column).map(move |c| r * SIDE + c)));
        }
    }
    cells
}

/// The objects that photons are to reach to which few rays of the light go: a ball around each, and those rays.
fn small_objects(world: &World, light: &Light, chart: &Chart, aim: &impl Aim) -> BTreeMap<u32, (Sphere, RaysToBall)> {
    let mut small: BTreeMap<u32, (Sphere, RaysToBall)> = balls_of_objects(world, aim)
        .into_iter()
        .filter_map(|(object, ball)| {
            let rays = RaysToBall::new(light, chart, ball)?;
            rays.are_few().then_some((object, (ball, rays)))
        })
        .collect();
    if small.values().filter(|(_, rays)| rays.cone().is_none()).count() > MOST_BUNDLES {
        small.retain(|_, (_, rays)| rays.cone().is_some());
    }
    small
}

/// The fraction of the paths for rays of these areas in the chart (etendue over the light's) beside cells that cover `marked_area`: in
/// proportion to the area, but not less than [`LEAST_FRACTION`] for an object. The last areas are of views, which get as much as all
/// cells and objects together.
fn path_fractions(areas: &[f64], views: usize, marked_area: f64) -> Vec<f64> {
    let of_objects = &areas[..areas.len() - views];
    let least = LEAST_FRACTION.min(LEAST_FRACTIONS / of_objects.len() as f64);
    let total = marked_area + of_objects.iter().sum::<f64>();
    let mut weights: Vec<f64> = of_objects.iter().map(|area| (area / total).max(least)).collect();
    let mut sum = weights.iter().sum::<f64>() + if marked_area > 0.0 { marked_area / total } else { 0.0 };
    if views > 0 {
        let of_views = if sum > 0.0 { sum } else { 1.0 };
        weights.extend(iter::repeat_n(of_views / views as f64, views));
        sum += of_views;
    }
    weights.iter().map(|weight| (1.0 - DEFENSIVE_FRACTION) * weight / sum).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Quad;
    use crate::math::chi_square::assert_has_density;
    use crate::math::{Rgb, Stream};
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
        let map = ProjectionMap::from_cells(&lamp(), Chart::new(&lamp()), &cells, &[], &[]);
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
        let (object, view) = (RaysToBall::Cone(cone(0.3, 0.6, 0.3)), RaysToBall::Cone(cone(0.71, 0.24, 0.02)));
        let map = ProjectionMap::from_cells(&lamp(), chart, &some_cells(), &[object], &[view]);
        let sample = |sampler: &mut Sampler| {
            let Emission { origin, direction, flux } = map.emit(&lamp(), sampler)?;
            let expected = 1.0 / map.path_density(&lamp(), origin, origin + direction);
            assert!((f64::from(flux.x) / expected - 1.0).abs() < 1e-4, "the flux is 1 over the density: {flux}");
            Some(chart.square_from_place(direction))
        };
        let density = |p| 4.0 * PI * map.path_density(&lamp(), DVec3::ZERO, 2.0 * chart.place_from_square()(p)) * 4.0;
        assert_has_density("lamp", sample, density);
    }

    #[test]
    fn paths_of_a_beam_have_the_density_that_mis_weights_take_within_its_disc() {
        let (rays, light) = (beam(), Light::Parallel(beam()));
        let chart = Chart::new(&light);
        let cone = Cone { middle: chart.place_from_square()(DVec2::new(0.4, 0.6)), radius: 0.2 };
        let map = ProjectionMap::from_cells(&light, chart, &some_cells(), &[RaysToBall::Cone(cone)], &[]);
        let sample = |sampler: &mut Sampler| {
            let Emission { origin, direction, .. } = map.emit(&light, sampler)?;
            assert!(origin.distance(rays.center) <= 2.0 + 1e-9 && direction == rays.direction);
            Some(0.5 * rays.crossing(origin, direction) + 0.5)
        };
        let density = |p: DVec2| {
            let point = rays.point(2.0 * p - 1.0);
            16.0 * map.path_density(&light, point, point + 5.0 * rays.direction)
        };
        assert_has_density("beam", sample, density);
    }

    /// A sphere, a quad and a sun, all brighter than 0 in one colour only.
    fn wide_lights() -> [Light; 3] {
        let radiance = Rgb::new(2.0, 0.0, 0.0);
        let sphere = Sphere { center: DVec3::new(0.5, 3.0, 0.0), radius: 1.0 };
        // Its normal is -y.
        let quad = Quad::new(DVec3::new(-1.0, 3.0, -1.0), 2.0 * DVec3::X, 2.0 * DVec3::Z);
        let sun = ParallelRays { half_angle: 0.2, from_outside: true, irradiance: radiance, ..beam() };
        [Light::Sphere { sphere, radiance }, Light::Quad { quad, radiance }, Light::Parallel(sun)]
    }

    fn small_ball(light: &Light) -> Sphere {
        let offset = match light {
            Light::Parallel(rays) => 5.0 * rays.direction,
            _ => DVec3::new(0.1, -3.0, 0.4),
        };
        Sphere { center: light.center() + offset, radius: 0.4 }
    }

    /// The flux that paths carry to a ball, as a fraction of the light's power, is that of paths in proportion to the light's emission, of
    /// which a part of a percent reach the ball. Part of the ball is beside the bundle.
    #[test]
    fn bundles_and_cells_bring_the_flux_of_the_light() {
        for light in wide_lights() {
            let aim = small_ball(&light);
            let target = Sphere { center: aim.center + 0.15 * DVec3::X, radius: 0.4 };
            let bundle = Bundle::new(&light, aim).expect("the light is wider");
            let map = ProjectionMap::from_cells(
                &light,
                Chart::new(&light),
                &[true; SIDE * SIDE],
                &[],
                &[RaysToBall::Bundle(bundle)],
            );
            let to_target = |emission: &Emission| {
                let offset = target.center - emission.origin;
                let is_before = matches!(light, Light::Parallel(_)) || offset.dot(emission.direction) > 0.0;
                is_before && offset.cross(emission.direction).length() < target.radius
            };
            let count = 1 << 21;
            let mean = |emit: &dyn Fn(&mut Sampler) -> Option<Emission>| {
                let flux = |index| emit(&mut Sampler::new(3, Stream::GlobalPhoton, 0, index)).filter(to_target);
                (0..count).filter_map(flux).map(|emission| f64::from(emission.flux.x)).sum::<f64>() / count as f64
            };
            let expected = mean(&|sampler| Some(emission::emit(&light, sampler)));
            let aimed = mean(&|sampler| map.emit(&light, sampler));
            assert!((aimed / expected - 1.0).abs() < 0.03, "{aimed} instead of {expected}: {light:?}");
        }
    }

    #[test]
    fn paths_in_bundles_have_the_density_that_mis_weights_take() {
        for light in wide_lights() {
            let aim = small_ball(&light);
            let view = RaysToBall::Bundle(Bundle::new(&light, aim).expect("the light is wider"));
            let map = ProjectionMap::from_cells(&light, Chart::new(&light), &some_cells(), &[], &[view]);
            for index in 0..1000 {
                let Some(path) = map.emit(&light, &mut Sampler::new(3, Stream::GlobalPhoton, 0, index)) else {
                    continue;
                };
                let Emission { origin, direction, flux } = path;
                let distance = if matches!(light, Light::Parallel(_)) { 1.0 } else { 2.0 };
                let density = map.path_density(&light, origin, origin + distance * direction) * distance * distance;
                let expected =
                    f64::from(emission::radiance(&light).x) * emission::etendue_ratio(&light, origin, direction);
                assert!((f64::from(flux.x) * density / expected - 1.0).abs() < 1e-4, "{flux} at {origin}");
            }
        }
    }

    #[test]
    fn densities_integrate_to_one_and_cover_everything() {
        let cells: Vec<bool> = (0..SIDE * SIDE).map(|cell| cell % 37 == 0).collect();
        let map = ProjectionMap::from_cells(&lamp(), Chart::new(&lamp()), &cells, &[], &[]);
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
