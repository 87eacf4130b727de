use super::edge::Edge;
use crate::geometry::bezier::ControlNet;
use std::collections::{BTreeSet, HashMap};

/// Distance of two edges in units of the distance between the middles of their patches above which they are different edges: a thin
/// pane is as thin at its rim as in its middle.
const OF_CENTERS: f64 = 0.1;
/// A pair of edges this many times as far apart as either is from its nearest partner is no seam.
const RIVAL: f64 = 16.0;
/// Distance, in tolerances of the edges, within which several edges meet in one.
const SAME: f64 = 1e-5;
/// Points of a seam, as parameters along it, at which the normals on both sides are compared.
const TESTED: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 0.9];

/// Two edges at the same place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seam {
    /// Indices of the edges.
    pub(super) edges: [usize; 2],
    /// Whether they run in opposite directions.
    pub(super) reversed: bool,
    /// Whether the normals `dS/du x dS/dv` of the two patches point to opposite sides of the surface that they make.
    pub(super) flips: bool,
    /// Their distance, scene units.
    pub(super) gap: f64,
}

impl Seam {
    /// The least cosine of the angle between the normals of its two patches on one side of the surface; 1 where the normals vanish, as
    /// at a pole.
    pub(super) fn least_cosine(&self, edges: &[Edge], nets: &[ControlNet]) -> f64 {
        let [a, b] = self.edges.map(|k| &edges[k]);
        let normal = |edge: &Edge, t: f64| {
            let uv = edge.at(t);
            let d = nets[edge.patch].derivatives(uv.x, uv.y);
            d.dpdu.normalize_or_zero().cross(d.dpdv.normalize_or_zero()).try_normalize()
        };
        let sign = if self.flips { -1.0 } else { 1.0 };
        let cosine = |t: f64| Some(sign * normal(a, t)?.dot(normal(b, if self.reversed { 1.0 - t } else { t })?));
        TESTED.into_iter().filter_map(cosine).fold(1.0, f64::min)
    }
}

/// The seams between edges, by their distance.
pub(super) fn seams(edges: &[Edge]) -> Vec<Seam> {
    let mut pairs = pairs(edges);
    pairs.sort_by(|p, q| p.gap.total_cmp(&q.gap).then(p.edges.cmp(&q.edges)));
    let mut nearest = vec![f64::INFINITY; edges.len()];
    for pair in &pairs {
        pair.edges.into_iter().for_each(|k| nearest[k] = nearest[k].min(pair.gap));
    }
    pairs.retain(|pair| {
        let [a, b] = pair.edges;
        let same = SAME * edges[a].tolerance().min(edges[b].tolerance());
        pair.gap <= same.max(RIVAL * nearest[a].min(nearest[b]))
    });
    pairs
}

/// All pairs of edges that are as near as their tolerances. The edges lie in grids of cells twice as large as the tolerances, one grid
/// for each power of two; an edge looks for partners with a tolerance as large as its own.
fn pairs(edges: &[Edge]) -> Vec<Seam> {
    let levels: BTreeSet<i32> = edges.iter().filter_map(level).collect();
    let mut cells: HashMap<(i32, [i64; 3]), Vec<usize>> = HashMap::new();
    for (k, edge) in edges.iter().enumerate() {
        let Some(own) = level(edge) else { continue };
        for &level in levels.range(..=own) {
            cells.entry((level, cell(edge.middle().to_array(), level))).or_default().push(k);
        }
    }
    let mut pairs = Vec::new();
    for (a, edge) in edges.iter().enumerate() {
        let Some(own) = level(edge) else { continue };
        let [low, high] = [-1.0, 1.0].map(|sign| cell((edge.middle() + sign * edge.tolerance()).to_array(), own));
        for corner in 0..8 {
            let at: [i64; 3] = [0, 1, 2].map(|axis| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] });
            let is_repeated = (0..3).any(|axis| corner >> axis & 1 == 1 && low[axis] == high[axis]);
            let found = cells.get(&(own, at)).filter(|_| !is_repeated);
            let partners = found.into_iter().flatten().filter(|&&b| a < b || level(&edges[b]) != Some(own));
            pairs.extend(partners.filter_map(|&b| pair(edges, a, b)));
        }
    }
    pairs
}

/// The power of two of an edge's tolerance; `None` for an edge of a patch without size.
fn level(edge: &Edge) -> Option<i32> {
    let tolerance = edge.tolerance();
    (tolerance > 0.0 && tolerance.is_finite()).then(|| tolerance.log2().floor() as i32)
}

/// The cell of a point in the grid of a level; cells are more than two tolerances of that level wide, so
/// that the neighbourhood of a point lies in at most two cells along each axis.
fn cell(point: [f64; 3], level: i32) -> [i64; 3] {
    point.map(|x| (x * 2f64.powi(-level - 2)).floor() as i64)
}

/// The pair of two edges, if they are at the same place. The edges of one patch may meet if they are opposite, as on a tube.
fn pair(edges: &[Edge], a: usize, b: usize) -> Option<Seam> {
    let (p, q) = (&edges[a], &edges[b]);
    let (gap, reversed) = p.gap(q);
    let most = if p.patch == q.patch {
        if p.side / 2 == q.side / 2 { f64::INFINITY } else { -1.0 }
    } else {
        OF_CENTERS * p.center.distance(q.center)
    };
    (a != b && gap <= most.min(p.tolerance()).min(q.tolerance())).then_some(Seam {
        edges: [a.min(b), a.max(b)],
        reversed,
        // Neighbours with like normals run along their common edge in opposite directions.
        flips: (p.is_counterclockwise() == q.is_counterclockwise()) != reversed,
        gap,
    })
}
