//! The edges of the caustic: where the map `P` from (u, v) to the landing place folds, `det J = n . (dP/du x dP/dv) = 0`, with the
//! normal `n` of the surface where the light lands. There the irradiance, which is proportional to `1 / |det J|`, is infinite.
//!
//! Marching squares \[LorensenCline87\] find the curve in a lattice over the patch; roots along the edges of the lattice, and between them,
//! place it.

use super::images::is_straight;
use super::polyline::Polyline;
use super::source::{Landing, Source};
use glam::DVec2;
use rayon::prelude::*;
use std::collections::HashMap;

/// Step in u and v of the differences that give `det J`: rounding of landing places, and curvature, are small against it.
const STEP: f64 = 1e-4;
/// Most steps of a root search.
const MOST_STEPS: usize = 8;
/// `det J` at a root over that at the ends of its search.
const ROOT: f64 = 1e-3;
/// A place counts as a root while `det J` is less than this part of its values at the ends: else it leaps there.
const LEAP: f64 = 0.05;
/// `det J` over the greatest product of the derivatives in the lattice, below which its sign is rounding.
const ROUNDING: f64 = 1e-7;
/// How often a chord of the curve is halved.
const HALVINGS: u32 = 4;

/// A landing with the determinant of the map.
#[derive(Clone, Copy)]
struct Sample {
    uv: DVec2,
    landing: Landing,
    /// `det J`, square scene units.
    determinant: f64,
    /// The product of the lengths of the derivatives.
    product: f64,
}

/// A place of the curve: where it meets an edge of the lattice. A number names the edge.
type Edge = usize;

/// The edges of the caustic of a patch, found in a lattice of `side` x `side` cells.
pub(super) fn edges(source: &Source<'_>, side: usize) -> Vec<Polyline> {
    let at = |k: usize| DVec2::new((k % (side + 1)) as f64, (k / (side + 1)) as f64) / side as f64;
    let corners: Vec<Option<Sample>> =
        (0..(side + 1) * (side + 1)).into_par_iter().map(|k| sample(source, at(k))).collect();
    let least = ROUNDING * corners.iter().flatten().map(|corner| corner.product).fold(0.0, f64::max);
    let mut search = Search { source, roots: HashMap::new() };
    let mut segments = Vec::new();
    for k in (0..side * side).map(|cell| cell / side * (side + 1) + cell % side) {
        // Around the cell, each corner with the number of the edge that leads to the next.
        let around = [(k, 2 * k), (k + 1, 2 * k + 3), (k + side + 2, 2 * (k + side + 1)), (k + side + 1, 2 * k + 1)];
        let of_cell = around.map(|(corner, _)| corners[corner]);
        let [Some(a), Some(b), Some(c), Some(d)] = of_cell else { continue };
        let cell = [a, b, c, d];
        let is_one = cell.iter().all(|corner| corner.landing.signature == a.landing.signature);
        if is_one && cell.iter().any(|corner| corner.determinant.abs() > least) {
            segments.extend(search.segments(cell, around.map(|(_, edge)| edge)));
        }
    }
    let chains = chains(&segments);
    chains.iter().map(|chain| search.curve(chain)).filter(|curve| curve.points.len() > 1).collect()
}

/// The landing at a place of the patch with the determinant of the map, by differences towards the middle of the patch; `None` where light
/// does not land in one way.
fn sample(source: &Source<'_>, uv: DVec2) -> Option<Sample> {
    let landing = source.landing(uv)?;
    let derivative = |axis: DVec2| {
        let step = if uv.dot(axis) < 0.5 { STEP } else { -STEP };
        let beside = source.landing(uv + step * axis)?;
        (beside.signature == landing.signature).then(|| (beside.position - landing.position) / step)
    };
    let (dpdu, dpdv) = (derivative(DVec2::X)?, derivative(DVec2::Y)?);
    let determinant = landing.n_side.dot(dpdu.cross(dpdv));
    let product = dpdu.length() * dpdv.length();
    (determinant.is_finite() && product.is_finite()).then_some(Sample { uv, landing, determinant, product })
}

struct Search<'a> {
    source: &'a Source<'a>,
    /// The place of the curve on each edge of the lattice that was searched.
    roots: HashMap<Edge, Option<Sample>>,
}

impl Search<'_> {
    /// The pairs of edges of a cell that the curve joins.
    fn segments(&mut self, cell: [Sample; 4], edges: [Edge; 4]) -> Vec<[Edge; 2]> {
        let crossed = (0..4).filter(|&k| is_crossed([cell[k], cell[(k + 1) % 4]]));
        let mut crossed: Vec<Edge> =
            crossed.filter_map(|k| self.root(edges[k], [cell[k], cell[(k + 1) % 4]])).collect();
        if crossed.len() == 4 {
            // The middle decides which two corners the curve cuts off: those of the other sign.
            let middle: f64 = cell.iter().map(|corner| corner.determinant).sum();
            crossed.rotate_left(usize::from((middle >= 0.0) != (cell[0].determinant >= 0.0)));
        }
        crossed.as_chunks().0.to_vec()
    }

    /// The edge, if the curve crosses it between its ends.
    fn root(&mut self, edge: Edge, ends: [Sample; 2]) -> Option<Edge> {
        let source = self.source;
        self.roots.entry(edge).or_insert_with(|| root(source, ends)).map(|_| edge)
    }

    /// A chain of edges as a curve on the surface where the light lands.
    fn curve(&self, chain: &[Edge]) -> Polyline {
        let places: Vec<Sample> = chain.iter().filter_map(|edge| *self.roots.get(edge)?).collect();
        let mut all: Vec<Sample> = places.first().copied().into_iter().collect();
        for ends in places.windows(2) {
            self.halve([ends[0], ends[1]], HALVINGS, &mut all);
        }
        let mut curve = Polyline::default();
        for Sample { landing, .. } in all {
            curve.push(self.source.world, landing.position, Some(landing.n_side));
        }
        curve
    }

    /// Appends the curve between two places of it, without the first.
    fn halve(&self, [a, b]: [Sample; 2], halvings: u32, curve: &mut Vec<Sample>) {
        match between(self.source, [a, b]).filter(|_| halvings > 0) {
            Some(m) if !is_straight(self.source.world, [a.landing, m.landing, b.landing]) => {
                self.halve([a, m], halvings - 1, curve);
                self.halve([m, b], halvings - 1, curve);
            }
            m => curve.extend(m.into_iter().chain([b])),
        }
    }
}

fn is_crossed(ends: [Sample; 2]) -> bool {
    (ends[0].determinant >= 0.0) != (ends[1].determinant >= 0.0)
}

/// Where the determinant vanishes between two places with different signs of it, by the Illinois variant of false position
/// \[DowellJarratt71\]; `None` where it leaps.
fn root(source: &Source<'_>, [a, b]: [Sample; 2]) -> Option<Sample> {
    let most = a.determinant.abs().max(b.determinant.abs());
    let (mut a, mut b) = ((a.uv, a.determinant), (b.uv, b.determinant));
    let mut last = None;
    for _ in 0..MOST_STEPS {
        let share = a.1 / (a.1 - b.1);
        let found = sample(source, a.0.lerp(b.0, share))?;
        last = Some(found);
        if found.determinant.abs() <= ROOT * most {
            break;
        }
        if (found.determinant >= 0.0) == (b.1 >= 0.0) {
            a.1 *= 0.5;
        } else {
            a = b;
        }
        b = (found.uv, found.determinant);
    }
    last.filter(|found| found.determinant.abs() <= LEAP * most)
}

/// The place of the curve about halfway between two others, by a step of the secant method across their chord; `None` where light lands in
/// another way there.
fn between(source: &Source<'_>, [a, b]: [Sample; 2]) -> Option<Sample> {
    let (chord, middle) = (b.uv - a.uv, 0.5 * (a.uv + b.uv));
    let across = 0.1 * chord.perp();
    let on_chord = sample(source, middle)?;
    let inward = if (middle + across - 0.5).abs().max_element() < 0.5 { across } else { -across };
    let beside = sample(source, middle + inward)?;
    let steps = -on_chord.determinant / (beside.determinant - on_chord.determinant);
    let place = middle + steps.clamp(-5.0, 5.0) * inward;
    let found = sample(source, place).filter(|found| found.landing.signature == a.landing.signature)?;
    (found.determinant.abs() <= on_chord.determinant.abs()).then_some(found)
}

/// The segments joined to chains, open or closed.
fn chains(segments: &[[Edge; 2]]) -> Vec<Vec<Edge>> {
    let mut at: HashMap<Edge, Vec<usize>> = HashMap::new();
    for (index, ends) in segments.iter().enumerate() {
        ends.iter().for_each(|end| at.entry(*end).or_default().push(index));
    }
    let mut used = vec![false; segments.len()];
    let mut walk = |from: Edge| {
        let mut chain = vec![from];
        let mut here = from;
        while let Some(next) = at[&here].iter().copied().find(|&segment| !used[segment]) {
            used[next] = true;
            let [a, b] = segments[next];
            here = if a == here { b } else { a };
            chain.push(here);
        }
        chain
    };
    // Open chains from their ends, then rings.
    let is_end = |edge: &&Edge| at[edge].len() == 1;
    let ends = segments.iter().flatten().filter(is_end).chain(segments.iter().flatten());
    ends.map(|edge| walk(*edge)).filter(|chain| chain.len() > 1).collect()
}
