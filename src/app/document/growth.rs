//! Sets of control points to select: all, and the rows and columns through selected ones.

use super::selection::{PointIndex, Selection};
use super::welds::Welds;
use crate::scene::{Bezier, Revolution};
use std::collections::BTreeSet;

/// A direction in the nets of patches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Direction {
    /// `P[i][0]` to `P[i][3]`.
    Row,
    /// `P[0][j]` to `P[3][j]`.
    Column,
}

/// Four control points in a line of a patch's net.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Line {
    patch: usize,
    direction: Direction,
    /// i of a row, j of a column.
    index: usize,
}

/// The control points of the patch in the side panel; where they are selected already, all of the object.
pub(crate) fn all_points(bezier: &Bezier, selection: &Selection) -> BTreeSet<PointIndex> {
    let of_patch = |patch: usize| (0..16).map(move |k| PointIndex { patch, i: k / 4, j: k % 4 });
    let patch: BTreeSet<PointIndex> = of_patch(selection.patch).collect();
    if patch.is_subset(&selection.points) { (0..bezier.patches.len()).flat_map(of_patch).collect() } else { patch }
}

/// All points of the profile of a surface of revolution.
pub(crate) fn profile_points(revolution: &Revolution) -> BTreeSet<PointIndex> {
    let count = revolution.profile().len();
    (0..count).map(|index| PointIndex::of_profile(index, count)).collect()
}

/// The selected control points with the rows or columns through them, within their patches; where those are selected already,
/// with the rows or columns that continue them across seams.
pub(crate) fn with_lines(welds: &Welds, points: &BTreeSet<PointIndex>, direction: Direction) -> BTreeSet<PointIndex> {
    let lines: BTreeSet<Line> = points.iter().map(|point| Line::through(*point, direction)).collect();
    let within: BTreeSet<PointIndex> = lines.iter().flat_map(|line| line.points()).collect();
    if within.is_subset(points) {
        let strips = lines.iter().flat_map(|line| strip(welds, *line));
        points.iter().copied().chain(strips.flat_map(Line::points)).collect()
    } else {
        points.union(&within).copied().collect()
    }
}

impl Line {
    fn through(point: PointIndex, direction: Direction) -> Self {
        let index = if direction == Direction::Row { point.i } else { point.j };
        Self { patch: point.patch, direction, index }
    }

    /// The control point at place `at`, from 0 to 3, along the line.
    fn point(self, at: usize) -> PointIndex {
        let (i, j) = if self.direction == Direction::Row { (self.index, at) } else { (at, self.index) };
        PointIndex { patch: self.patch, i, j }
    }

    fn points(self) -> [PointIndex; 4] {
        [0, 1, 2, 3].map(|at| self.point(at))
    }

    /// The line that continues this one beyond its end `at`, 0 or 3, with the place where it begins; `None` without a
    /// neighbouring patch there, and at an edge that is one point.
    fn next(self, welds: &Welds, at: usize) -> Option<(Self, usize)> {
        let beside = Self { index: if self.index < 3 { self.index + 1 } else { self.index - 1 }, ..self };
        let (end, along_edge) = (self.point(at), beside.point(at));
        if welds.with(end).any(|welded| welded == along_edge) {
            return None;
        }
        let others = || welds.with(end).filter(|welded| welded.patch != self.patch);
        let pairs = others().flat_map(|first| welds.with(along_edge).map(move |second| (first, second)));
        pairs.into_iter().find_map(|(first, second)| continued(first, second))
    }
}

/// The line from `first` away from the edge that runs from `first` to its neighbour `second`; `None` where they are no
/// neighbours on an edge.
fn continued(first: PointIndex, second: PointIndex) -> Option<(Line, usize)> {
    let is_end = |at: usize| at == 0 || at == 3;
    let line = |direction| Line::through(first, direction);
    if first.patch != second.patch {
        None
    } else if first.j == second.j && first.i.abs_diff(second.i) == 1 && is_end(first.j) {
        Some((line(Direction::Row), first.j))
    } else if first.i == second.i && first.j.abs_diff(second.j) == 1 && is_end(first.i) {
        Some((line(Direction::Column), first.i))
    } else {
        None
    }
}

/// The line and all lines that continue it, at both ends.
fn strip(welds: &Welds, line: Line) -> BTreeSet<Line> {
    let mut strip = BTreeSet::from([line]);
    for end in [0, 3] {
        let mut next = line.next(welds, end);
        while let Some((line, begin)) = next {
            // A closed strip ends where it began.
            next = if strip.insert(line) { line.next(welds, 3 - begin) } else { None };
        }
    }
    strip
}

#[cfg(test)]
mod tests {
    use super::super::selection::Item;
    use super::*;
    use crate::geometry::bezier::ControlNet;
    use crate::scene::Transform;
    use glam::DVec3;
    use std::array;
    use std::sync::Arc;

    fn net(place: impl Fn(f64, f64) -> DVec3) -> ControlNet {
        ControlNet { points: array::from_fn(|i| array::from_fn(|j| place(i as f64, j as f64))) }
    }

    /// Three patches in a row along v; the second has u and v exchanged, the third runs backwards.
    fn bezier() -> Bezier {
        let nets = vec![
            net(|i, j| DVec3::new(i, j, 0.0)),
            net(|i, j| DVec3::new(j, 3.0 + i, 0.0)),
            net(|i, j| DVec3::new(i, 9.0 - j, 0.0)),
        ];
        Bezier { transform: Transform::default(), patches: Arc::new(nets), file: None, uv: None }
    }

    fn point(patch: usize, i: usize, j: usize) -> PointIndex {
        PointIndex { patch, i, j }
    }

    #[test]
    fn a_row_grows_within_its_patch_then_across_seams() {
        let welds = Welds::of(&bezier());
        let one = with_lines(&welds, &BTreeSet::from([point(0, 1, 2)]), Direction::Row);
        assert_eq!(one, (0..4).map(|j| point(0, 1, j)).collect());
        let strip = with_lines(&welds, &one, Direction::Row);
        let exchanged = (0..4).map(|i| point(1, i, 1));
        let expected: BTreeSet<_> =
            one.iter().copied().chain(exchanged).chain((0..4).map(|j| point(2, 1, j))).collect();
        assert_eq!(strip, expected);
    }

    #[test]
    fn a_column_ends_at_the_border() {
        let welds = Welds::of(&bezier());
        let column = with_lines(&welds, &BTreeSet::from([point(0, 1, 2)]), Direction::Column);
        assert_eq!(column, (0..4).map(|i| point(0, i, 2)).collect());
        assert_eq!(with_lines(&welds, &column, Direction::Column), column, "no patch continues it");
    }

    #[test]
    fn a_closed_strip_ends_where_it_began() {
        // Two half rings of one circle.
        let half = |start: f64| {
            net(move |i, j| {
                let angle = std::f64::consts::PI * (start + j / 3.0);
                // The ends meet up to rounding, which welding allows for.
                DVec3::new(angle.cos(), angle.sin(), i)
            })
        };
        let patches = Arc::new(vec![half(0.0), half(1.0)]);
        let welds = Welds::of(&Bezier { transform: Transform::default(), patches, file: None, uv: None });
        let row: BTreeSet<_> = (0..4).map(|j| point(0, 2, j)).collect();
        let ring = with_lines(&welds, &row, Direction::Row);
        assert_eq!(ring, [0, 1].into_iter().flat_map(|patch| (0..4).map(move |j| point(patch, 2, j))).collect());
    }

    #[test]
    fn all_points_are_first_those_of_the_patch() {
        let (bezier, mut selection) = (bezier(), Selection { patch: 1, ..Selection::of(Item::Object(0)) });
        selection.points = all_points(&bezier, &selection);
        assert_eq!(selection.points.len(), 16);
        assert!(selection.points.iter().all(|point| point.patch == 1));
        assert_eq!(all_points(&bezier, &selection).len(), 48);
    }
}
