use crate::geometry::bezier::ControlNet;
use glam::{DVec2, DVec3};

/// Distance of two edges, in widths of the narrower patch, within which they are the same edge for light.
const JOINED: f64 = 0.02;
/// Distance of two edges, in widths of the narrower patch, within which their control points become equal. Coordinates that are each
/// off by up to a thousandth of the width leave up to `2 sqrt(3)` thousandths between edges; a wider gap may be meant.
const WELDED: f64 = 4e-3;
/// Distance of two edges in units of their length above which they are different edges, however wide the patches are.
const OF_LENGTH: f64 = 0.1;
/// An edge shorter than this, in widths of the patch, is a point.
const POINT: f64 = 2e-3;

/// The control points of the edges at u = 0, u = 1, v = 0 and v = 1, as indices into the rows of a net one after the other.
pub(super) const SIDES: [[usize; 4]; 4] = [[0, 1, 2, 3], [12, 13, 14, 15], [0, 4, 8, 12], [3, 7, 11, 15]];

/// An edge of a patch.
#[derive(Clone, Debug)]
pub(super) struct Edge {
    /// Index of the patch.
    pub(super) patch: usize,
    /// Which of [`SIDES`] it is.
    pub(super) side: usize,
    /// Its control points.
    pub(super) points: [DVec3; 4],
    /// The middle of the patch.
    pub(super) center: DVec3,
    /// The length of the longer side that leads away from the edge, along its control points; of the middle lines where both sides
    /// are points.
    width: f64,
    /// The length of the edge, along its control points.
    length: f64,
}

/// The length of the longer one of the two inner lines of control points that run like this side.
fn middle_length(net: &ControlNet, side: usize) -> f64 {
    let point = |line: usize, k: usize| if side < 2 { net.points[line][k] } else { net.points[k][line] };
    let length = |line: usize| (0..3).map(|k| point(line, k).distance(point(line, k + 1))).sum::<f64>();
    length(1).max(length(2))
}

impl Edge {
    /// The four edges of a patch, in the order of [`SIDES`].
    pub(super) fn of(patch: usize, net: &ControlNet) -> [Self; 4] {
        let points = SIDES.map(|indices| indices.map(|k| net.points[k / 4][k % 4]));
        let lengths = points.map(|p| (0..3).map(|k| p[k].distance(p[k + 1])).sum::<f64>());
        let center = net.eval(0.5, 0.5);
        [0, 1, 2, 3].map(|side| {
            let beside = if side < 2 { 2 } else { 0 };
            let outer = lengths[beside].max(lengths[beside + 1]);
            // Between two poles the patch is as wide as it is in the middle.
            let width = if outer <= POINT * lengths[side] { middle_length(net, beside) } else { outer };
            Self { patch, side, points: points[side], center, width, length: lengths[side] }
        })
    }

    /// Whether it runs along the boundary of the patch as the patch's normal `dS/du x dS/dv` turns: the patch lies on its left.
    pub(super) fn is_counterclockwise(&self) -> bool {
        [false, true, true, false][self.side]
    }

    /// Whether it is a point, as at the pole of a ball.
    pub(super) fn is_point(&self) -> bool {
        self.length <= POINT * self.width
    }

    /// The greatest distance of an edge that is the same for light, scene units.
    pub(super) fn tolerance(&self) -> f64 {
        let of_width = JOINED * self.width;
        if self.is_point() { of_width } else { of_width.min(OF_LENGTH * self.length) }
    }

    /// The greatest distance of an edge with which its control points become equal, scene units.
    pub(super) fn weld_tolerance(&self) -> f64 {
        self.tolerance().min(WELDED * self.width)
    }

    /// Its point at 1/2.
    pub(super) fn middle(&self) -> DVec3 {
        let [a, b, c, d] = self.points;
        0.125 * (a + d) + 0.375 * (b + c)
    }

    /// The parameters (u, v) of its point at t.
    pub(super) fn at(&self, t: f64) -> DVec2 {
        let end = (self.side % 2) as f64;
        if self.side < 2 { DVec2::new(end, t) } else { DVec2::new(t, end) }
    }

    /// The distance of its control points from another edge's, the greatest of the four, and whether the edges run in opposite
    /// directions.
    pub(super) fn gap(&self, other: &Self) -> (f64, bool) {
        let [a, b, c, d] = other.points;
        let gap = |to: [DVec3; 4]| (0..4).map(|k| self.points[k].distance(to[k])).fold(0.0, f64::max);
        let (along, against) = (gap([a, b, c, d]), gap([d, c, b, a]));
        (along.min(against), against < along)
    }
}
