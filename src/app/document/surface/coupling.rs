//! Which control points follow moved ones: the one place for all ways of moving control points.

use super::connectivity::Connectivity;
use super::mirror::Mirror;
use super::tangents;
use crate::app::document::handles::control_points;
use crate::scene::{Bezier, Scene, Shape};
use glam::DVec3;
use std::sync::Arc;

/// The control points that follow moved ones. Control points at one position always stay together, so seams stay closed.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub(crate) struct Coupling {
    /// Whether smooth seams stay smooth (G1).
    pub(crate) tangents: bool,
    /// The plane across which control points move in pairs; `None` without symmetry.
    pub(crate) mirror: Option<Mirror>,
}

impl Coupling {
    /// Moves the control points in `after` that follow the control points which moved between `before` and `after`. An object with
    /// another number of patches, and a scene with another number of objects, keeps its control points.
    pub(in crate::app::document) fn follow(&self, before: &Scene, after: &mut Scene) {
        if before.objects.len() != after.objects.len() {
            return;
        }
        for (before, after) in before.objects.iter().zip(&mut after.objects) {
            if let (Shape::Bezier(before), Shape::Bezier(after)) = (&before.shape, &mut after.shape)
                && before.patches.len() == after.patches.len()
                && !Arc::ptr_eq(&before.patches, &after.patches)
            {
                self.follow_in(before, after);
            }
        }
    }

    fn follow_in(&self, before: &Bezier, after: &mut Bezier) {
        let mesh = Connectivity::of(before);
        let positions = mesh.positions(before);
        let mut targets: Vec<Option<DVec3>> = vec![None; positions.len()];
        for ((point, old), (_, new)) in control_points(before).zip(control_points(after)) {
            if old != new {
                targets[mesh.node(point)].get_or_insert(new);
            }
        }
        if let Some(mirror) = self.mirror {
            mirror.follow(&positions, &mut targets);
        }
        if self.tangents {
            tangents::follow(&mesh, &positions, &mut targets);
        }
        let patches = Arc::make_mut(&mut after.patches);
        for (points, target) in mesh.nodes().iter().zip(targets) {
            let Some(target) = target.filter(|target| target.is_finite()) else { continue };
            points.iter().for_each(|point| patches[point.patch].points[point.i][point.j] = target);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::connectivity::tests::sheet;
    use super::*;
    use crate::app::document::{Edit, Handle, PointIndex};
    use crate::scene::Object;

    fn scene() -> Scene {
        let shape = Shape::Bezier(sheet(2, 1, |x, _| ((x - 3.0).abs() - 1.0).max(0.0)));
        let object = Object { name: "sheet".into(), material: String::new(), shape, body: None };
        Scene { objects: vec![object], ..Scene::default() }
    }

    fn point(scene: &Scene, patch: usize, i: usize, j: usize) -> DVec3 {
        Handle::Point { object: 0, point: PointIndex { patch, i, j } }.position(scene).unwrap()
    }

    fn after(coupling: Coupling, edit: Edit) -> Scene {
        let (before, mut after) = (scene(), scene());
        edit.apply(&mut after);
        coupling.follow(&before, &mut after);
        after
    }

    fn place(patch: usize, i: usize, j: usize, to: DVec3) -> Edit {
        Edit::Place(0, vec![(PointIndex { patch, i, j }, to)], "move control point")
    }

    #[test]
    fn a_seam_stays_closed_however_its_points_move() {
        let to = DVec3::new(3.5, 1.0, 0.5);
        let handle = Handle::Point { object: 0, point: PointIndex { patch: 1, i: 0, j: 1 } };
        for edit in [place(0, 3, 1, to), Edit::Move(vec![handle], DVec3::new(0.5, 1.0, -0.5))] {
            let after = after(Coupling::default(), edit);
            assert_eq!((point(&after, 0, 3, 1), point(&after, 1, 0, 1)), (to, to));
        }
    }

    #[test]
    fn tangents_and_mirror_images_follow_only_where_wanted() {
        let to = DVec3::new(4.5, 2.0, 1.5);
        let mirror = Some(Mirror { axis: 0, at: 3.0 });
        let cases = [(false, None), (true, None), (false, mirror), (true, mirror)];
        for (tangents, mirror) in cases {
            let moved = after(Coupling { tangents, mirror }, place(1, 2, 1, to));
            let image = DVec3::new(1.5, 2.0, 1.5);
            assert_eq!(point(&moved, 1, 2, 1), to);
            assert_eq!(point(&moved, 0, 1, 1) == image, mirror.is_some());
            let next = after(Coupling { tangents, mirror }, place(1, 1, 1, to));
            let [left, seam] = [point(&next, 0, 2, 1), point(&next, 0, 3, 1)];
            let straight = (left - seam).normalize().dot((to - seam).normalize());
            assert_eq!(straight < -0.999, tangents, "{left} {seam}");
        }
    }

    #[test]
    fn other_edits_move_no_point() {
        let coupling = Coupling { tangents: true, mirror: Some(Mirror { axis: 0, at: 3.0 }) };
        assert_eq!(after(coupling, Edit::Move(vec![Handle::Object(0)], DVec3::X)).objects[0].shape, {
            let mut moved = scene();
            Edit::Move(vec![Handle::Object(0)], DVec3::X).apply(&mut moved);
            moved.objects[0].shape.clone()
        });
        assert!(after(coupling, Edit::Remove(crate::app::document::Item::Object(0))).objects.is_empty());
    }
}
