//! Small objects in a chart: a quadtree that refines the cells of a projection map where an object appears smaller than a cell.

use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// Leaf cells are at most this wide, in radii of the cone of the target: some 60 % of the marked area is in the cone.
const CELL_PER_RADIUS: f64 = 0.5;
/// Depth of the tree below the sphere at which cells are a billionth of a radian wide.
const MAX_DEPTH: u32 = 32;
/// Greatest angle (radians) between the center of a cell and a point in it, in roots of the cell's solid angle. A square has 0.71; the map
/// stretches it to 1.21 at most.
const CELL_REACH: f64 = 1.25;

/// A cone in which an object appears, and the probability with which it is to be sampled.
#[derive(Clone, Copy, Debug)]
pub(super) struct Target {
    /// Middle of the cone.
    pub(super) middle: Place,
    /// Half the angle of the cone, radians.
    pub(super) radius: f64,
    /// Fraction of the paths, 0 to 1.
    pub(super) path_fraction: f64,
}

/// A point of a chart: of the unit sphere, or of a square in the plane z = 0 with the same area as the sphere.
pub(super) type Place = DVec3;

/// The map from the unit square to places.
pub(super) type PlaceFromSquare = fn(DVec2) -> Place;

/// A square of a chart: at depth `d` the chart has `2^d` of them along a side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    pub(super) depth: u32,
    pub(super) x: u64,
    pub(super) y: u64,
}

/// A cell with four children in the order of [`Cell::children`].
#[derive(Clone, Debug)]
struct Node {
    /// Probability of each child.
    mass: [f64; 4],
    /// Index of the node of each child; 0 for a leaf.
    children: [u32; 4],
}

/// The densities in one cell that targets refine.
#[derive(Clone, Debug)]
pub(super) struct CellTree {
    /// The cell itself is the first one.
    nodes: Vec<Node>,
}

impl Cell {
    fn center(self, place: PlaceFromSquare) -> Place {
        let side = self.side();
        place(DVec2::new((self.x as f64 + 0.5) * side, (self.y as f64 + 0.5) * side))
    }

    /// Side in the unit square.
    fn side(self) -> f64 {
        0.5f64.powi(self.depth as i32)
    }

    /// Root of the solid angle or area, units of the chart.
    fn width(self) -> f64 {
        (4.0 * PI).sqrt() * self.side()
    }

    /// Whether a point of the cell may be in the cone of the target; true also a little beside it.
    pub(super) fn may_meet(self, target: &Target, place: PlaceFromSquare) -> bool {
        // The chord is shorter than the arc.
        self.center(place).distance(target.middle) <= target.radius + CELL_REACH * self.width()
    }

    /// Whether the cell is as small as the target asks for.
    fn is_fine_for(self, target: &Target) -> bool {
        self.depth >= MAX_DEPTH || self.width() <= CELL_PER_RADIUS * target.radius
    }

    /// The quarters: x varies fastest.
    fn children(self) -> [Self; 4] {
        std::array::from_fn(|k| Self {
            depth: self.depth + 1,
            x: 2 * self.x + (k as u64 & 1),
            y: 2 * self.y + (k as u64 >> 1),
        })
    }
}

/// Targets in a chart.
#[derive(Debug)]
pub(super) struct Targets {
    pub(super) list: Vec<Target>,
    pub(super) place_from_square: PlaceFromSquare,
}

impl Targets {
    /// The indices of all targets.
    fn all(&self) -> Vec<usize> {
        (0..self.list.len()).collect()
    }

    /// The targets that a cell meets, of the targets with the indices `among`.
    fn met(&self, cell: Cell, among: &[usize]) -> Vec<usize> {
        among.iter().copied().filter(|&t| cell.may_meet(&self.list[t], self.place_from_square)).collect()
    }

    /// Whether the cell is as small as each of these targets asks for.
    fn are_resolved(&self, cell: Cell, met: &[usize]) -> bool {
        met.iter().all(|&t| cell.is_fine_for(&self.list[t]))
    }

    /// Calls `visit` with each leaf of the tree under `cell` and the indices of the targets that it meets.
    fn for_each_leaf(&self, cell: Cell, among: &[usize], visit: &mut impl FnMut(Cell, &[usize])) {
        let met = self.met(cell, among);
        if self.are_resolved(cell, &met) {
            return visit(cell, &met);
        }
        cell.children().into_iter().for_each(|child| self.for_each_leaf(child, &met, visit));
    }

    /// The area in the unit square that the leaves of each target cover.
    pub(super) fn covered_areas(&self) -> Vec<f64> {
        let mut areas = vec![0.0; self.list.len()];
        self.for_each_leaf(Cell { depth: 0, x: 0, y: 0 }, &self.all(), &mut |leaf, met| {
            met.iter().for_each(|&t| areas[t] += leaf.side() * leaf.side());
        });
        areas
    }
}

impl CellTree {
    /// The tree of a cell, and the cell's probability, for targets that cover these areas over an even density of probability per area of
    /// the unit square; `None` for a cell whose density is even.
    pub(super) fn new(cell: Cell, targets: &Targets, areas: &[f64], even: f64) -> (Option<Self>, f64) {
        let all = targets.met(cell, &targets.all());
        let mut tree = Self { nodes: Vec::new() };
        let density = |met: &[usize]| even + met.iter().map(|&t| targets.list[t].path_fraction / areas[t]).sum::<f64>();
        let (_, mass) = tree.add(cell, targets, &all, &density);
        (Some(tree).filter(|tree| !tree.nodes.is_empty()), mass)
    }

    /// Adds the nodes of a cell; returns the index of its node (0 for a leaf) and its probability.
    fn add(
        &mut self,
        cell: Cell,
        targets: &Targets,
        among: &[usize],
        density: &impl Fn(&[usize]) -> f64,
    ) -> (u32, f64) {
        let met = targets.met(cell, among);
        if targets.are_resolved(cell, &met) {
            return (0, density(&met) * cell.side() * cell.side());
        }
        let index = self.nodes.len();
        self.nodes.push(Node { mass: [0.0; 4], children: [0; 4] });
        for (k, child) in cell.children().into_iter().enumerate() {
            let (node, mass) = self.add(child, targets, &met, density);
            self.nodes[index].children[k] = node;
            self.nodes[index].mass[k] = mass;
        }
        (index as u32, self.nodes[index].mass.iter().sum())
    }

    /// The point in the cell (0 to 1 along each side) for two numbers from 0 to 1, and its density over the mean density of the cell.
    pub(super) fn sample(&self, mut u: DVec2) -> (DVec2, f64) {
        let (mut corner, mut side, mut density) = (DVec2::ZERO, 1.0, 1.0);
        let mut node = &self.nodes[0];
        loop {
            let [a, b, c, d] = node.mass;
            let right = split(&mut u.x, a + c, b + d);
            let (lower, upper) = if right { (b, d) } else { (a, c) };
            let up = split(&mut u.y, lower, upper);
            let child = usize::from(right) + 2 * usize::from(up);
            side *= 0.5;
            corner += side * DVec2::new(f64::from(u8::from(right)), f64::from(u8::from(up)));
            density *= 4.0 * node.mass[child] / (a + b + c + d);
            match node.children[child] {
                0 => return (corner + side * u, density),
                next => node = &self.nodes[next as usize],
            }
        }
    }

    /// The density at a point in the cell over the mean density of the cell.
    pub(super) fn density(&self, mut point: DVec2) -> f64 {
        let mut density = 1.0;
        let mut node = &self.nodes[0];
        loop {
            point *= 2.0;
            let child = usize::from(point.x >= 1.0) + 2 * usize::from(point.y >= 1.0);
            density *= 4.0 * node.mass[child] / node.mass.iter().sum::<f64>();
            match node.children[child] {
                0 => return density,
                next => node = &self.nodes[next as usize],
            }
            point -= point.floor().min(DVec2::ONE);
        }
    }
}

/// Whether `u` falls to the second of two masses; rescales it to 0 to 1 within the chosen mass.
fn split(u: &mut f64, first: f64, second: f64) -> bool {
    let threshold = first / (first + second);
    let is_second = *u >= threshold;
    let within = if is_second { (*u - threshold) / (1.0 - threshold) } else { *u / threshold };
    *u = within.clamp(0.0, 1.0 - f64::EPSILON);
    is_second
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::octahedral;

    const DIRECTIONS: PlaceFromSquare = octahedral::direction_from_square;

    #[test]
    fn no_point_of_a_cell_is_farther_from_its_center_than_its_reach() {
        for depth in [1, 3, 6, 12] {
            for k in 0..1000u64 {
                let along = 1u64 << depth;
                let cell = Cell { depth, x: (k * 7919) % along, y: (k * 104_729 + k / 3) % along };
                for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (0.5, 0.0), (0.0, 0.5)] {
                    let corner = DVec2::new(cell.x as f64 + x, cell.y as f64 + y) * cell.side();
                    let distance = DIRECTIONS(corner).distance(cell.center(DIRECTIONS));
                    assert!(distance <= CELL_REACH * cell.width(), "{cell:?}: {}", distance / cell.width());
                }
            }
        }
    }

    /// Samples of a cell with targets of very different sizes arrive in their cones, with the density that [`CellTree::density`] tells.
    #[test]
    fn samples_arrive_in_the_cones() {
        let cell = Cell { depth: 6, x: 20, y: 37 };
        let at = |x: f64, y: f64| {
            octahedral::direction_from_square(DVec2::new(cell.x as f64 + x, cell.y as f64 + y) * cell.side())
        };
        let targets = [(0.3, 0.4, 1e-3, 0.4), (0.8, 0.7, 1e-6, 0.2)];
        let targets = targets.map(|(x, y, radius, path_fraction)| Target { middle: at(x, y), radius, path_fraction });
        let targets = Targets { list: targets.to_vec(), place_from_square: DIRECTIONS };
        let areas = targets.covered_areas();
        let (tree, mass) = CellTree::new(cell, &targets, &areas, 1.0);
        let tree = tree.expect("the cell holds both");
        let area = cell.side() * cell.side();
        assert!((mass - area - 0.6).abs() < 1e-12, "the even density and both fractions: {mass}");
        let n = 128;
        let mut in_cone = [0; 2];
        for k in 0..n * n {
            let u = DVec2::new(f64::from(k % n) + 0.5, f64::from(k / n) + 0.5) / f64::from(n);
            let (point, density) = tree.sample(u);
            let direction = at(point.x, point.y);
            for (count, target) in in_cone.iter_mut().zip(&targets.list) {
                *count += i32::from(direction.distance(target.middle) < target.radius);
            }
            assert!((tree.density(point) / density - 1.0).abs() < 1e-9, "at {point}");
        }
        for (k, target) in targets.list.iter().enumerate() {
            let cone = PI * target.radius * target.radius / (4.0 * PI) / areas[k];
            let expected = cone * target.path_fraction / mass * f64::from(n * n);
            assert!(cone > 0.4, "the leaves fit the cone: {cone}");
            assert!((f64::from(in_cone[k]) / expected - 1.0).abs() < 0.05, "{} instead of {expected}", in_cone[k]);
        }
    }
}
