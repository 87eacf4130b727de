use crate::math::Ray;
use crate::world::{Surface, World};
use glam::DVec3;

/// A surface nearer than this part of the distance to a point hides the point.
const IN_FRONT: f64 = 1.0 - 1e-4;
/// Most surfaces of glass through which a point is seen.
const MOST_GLASS: usize = 16;

/// A curve in the room.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polyline {
    /// Its points, in scene units.
    pub points: Vec<DVec3>,
    /// For each point, whether no opaque surface hides it from the camera. Glass hides nothing.
    pub seen: Vec<bool>,
}

impl Polyline {
    /// Adds a point, which the camera of the world sees or not; `n_side` is the unit normal on the lit side of the surface that it lies on.
    pub(super) fn push(&mut self, world: &World, point: DVec3, n_side: Option<DVec3>) {
        let eye = world.camera.position;
        let is_behind = n_side.is_some_and(|normal| normal.dot(eye - point) < 0.0);
        self.points.push(point);
        self.seen.push(!is_behind && is_clear(world, eye, point));
    }
}

/// Whether no opaque surface lies between two points.
fn is_clear(world: &World, eye: DVec3, point: DVec3) -> bool {
    let mut ray = Ray { t_max: IN_FRONT, ..Ray::between(eye, point) };
    if !world.aggregate.occluded(&ray) {
        return true;
    }
    for _ in 0..MOST_GLASS {
        let Some(hit) = world.aggregate.closest_hit(&ray) else { return true };
        if !matches!(world.surfaces[hit.primitive as usize], Surface::Object { body: Some(_), .. }) {
            return false;
        }
        ray.t_min = hit.t + (1.0 - IN_FRONT);
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::testing::{self, quad, sphere};

    /// The camera of the tests is at (0, 0, 4).
    #[test]
    fn opaque_surfaces_hide_points_and_glass_does_not() {
        let glass = "[[material]]\nname = \"glass\"\ntype = \"glass\"\nior = 1.5\n";
        let wall = quad("wall", [[-1.0, -1.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]], "grey");
        let ball = sphere("ball", [0.0, 0.0, 2.0], 0.5, "glass");
        let world = testing::world(&[glass, &wall, &ball].concat());
        let mut line = Polyline::default();
        for (point, normal) in [
            (DVec3::ZERO, Some(DVec3::Z)),
            (DVec3::ZERO, Some(DVec3::NEG_Z)),
            (DVec3::NEG_Z, None),
            (DVec3::new(0.1, 0.0, 2.0), None),
        ] {
            line.push(&world, point, normal);
        }
        assert_eq!(line.seen, [true, false, false, true], "through glass; behind the wall twice; inside of glass");
    }
}
