//! Symmetry across a plane.

use super::connectivity::Connectivity;
use crate::math::Aabb;
use crate::scene::Bezier;
use glam::DVec3;

/// Distance within which a control point is the mirror image of another, as a fraction of the object's size.
const TOLERANCE: f64 = 1e-4;

/// A plane of symmetry in object space, across the axis number `axis`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Mirror {
    /// 0 for x, 1 for y, 2 for z.
    pub(crate) axis: usize,
    /// The coordinate of the plane along the axis.
    pub(crate) at: f64,
}

impl Mirror {
    /// The plane through the centre of the box of an object's control points.
    pub(crate) fn through_center(bezier: &Bezier, axis: usize) -> Self {
        let bounds = bezier.patches.iter().fold(Aabb::EMPTY, |bounds, net| bounds.union(&net.bounds()));
        let at = if bounds.is_empty() { 0.0 } else { bounds.center()[axis] };
        Self { axis, at }
    }

    /// The mirror image of a position.
    pub(super) fn image(self, mut position: DVec3) -> DVec3 {
        position[self.axis] = 2.0 * self.at - position[self.axis];
        position
    }

    /// The node at the mirror image of each position; `None` where there is none. A node in the plane is its own partner.
    pub(super) fn partners(self, positions: &[DVec3]) -> Vec<Option<usize>> {
        let tolerance = TOLERANCE * Aabb::around(positions.iter().copied()).diagonal();
        let mut sorted: Vec<usize> = (0..positions.len()).collect();
        let along = |node: usize| positions[node][self.axis];
        sorted.sort_by(|a, b| along(*a).total_cmp(&along(*b)));
        let partner = |position: &DVec3| {
            let image = self.image(*position);
            let first = sorted.partition_point(|node| along(*node) < image[self.axis] - tolerance);
            let near = sorted[first..].iter().take_while(|node| along(**node) <= image[self.axis] + tolerance);
            let distance = |node: usize| positions[node].distance(image);
            let nearest = near.copied().min_by(|a, b| distance(*a).total_cmp(&distance(*b)))?;
            (distance(nearest) <= tolerance).then_some(nearest)
        };
        positions.iter().map(partner).collect()
    }

    /// How many of an object's control points have a mirror image, and how many control points it has.
    pub(crate) fn matched(self, bezier: &Bezier) -> (usize, usize) {
        let mesh = Connectivity::of(bezier);
        let partners = self.partners(&mesh.positions(bezier));
        (partners.iter().flatten().count(), partners.len())
    }

    /// Gives the partners of moved nodes the mirrored positions. Of two partners that both move, the one at the larger coordinate
    /// leads. A node in the plane stays in the plane.
    pub(super) fn follow(self, positions: &[DVec3], targets: &mut [Option<DVec3>]) {
        let partners = self.partners(positions);
        for node in 0..positions.len() {
            let (Some(target), Some(partner)) = (targets[node], partners[node]) else { continue };
            if partner == node {
                let mut projected = target;
                projected[self.axis] = self.at;
                targets[node] = Some(projected);
            } else if targets[partner].is_none() || positions[node][self.axis] > positions[partner][self.axis] {
                targets[partner] = Some(self.image(target));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::connectivity::tests::sheet;
    use super::*;

    #[test]
    fn every_point_of_a_symmetric_sheet_has_a_partner() {
        let bezier = sheet(2, 1, |x, _| (x - 3.0).powi(2));
        let mirror = Mirror::through_center(&bezier, 0);
        assert_eq!((mirror.at, mirror.matched(&bezier)), (3.0, (28, 28)));
        assert_eq!(
            Mirror::through_center(&bezier, 1).matched(&bezier).0,
            0,
            "a bowl is not symmetric across its height"
        );
    }

    #[test]
    fn a_partner_gets_the_mirrored_position() {
        let positions = [DVec3::new(-1.0, 2.0, 0.0), DVec3::new(1.0, 2.0, 0.0), DVec3::new(1e-7, 0.0, 0.0)];
        let mirror = Mirror { axis: 0, at: 0.0 };
        let followed = |mut targets: [Option<DVec3>; 3]| {
            mirror.follow(&positions, &mut targets);
            targets
        };
        let (right, left) = (DVec3::new(1.5, 2.5, 0.5), DVec3::new(-1.5, 2.5, 0.5));
        assert_eq!(followed([None, Some(right), None]), [Some(left), Some(right), None]);
        assert_eq!(followed([Some(left), None, None]), [Some(left), Some(right), None]);
        assert_eq!(
            followed([Some(DVec3::ZERO), Some(right), None]),
            [Some(left), Some(right), None],
            "the right leads"
        );
        assert_eq!(followed([None, None, Some(DVec3::ONE)]), [None, None, Some(DVec3::new(0.0, 1.0, 1.0))]);
    }
}
