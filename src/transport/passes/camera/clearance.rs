use crate::geometry::Primitive;
use crate::transport::points::{Clearance, Vertex};
use crate::world::{Surface, World};

/// Distances from a vertex to other objects, up to these limits.
pub(super) fn clearance(world: &World, vertex: &Vertex, limits: Clearance) -> Clearance {
    let primitives = world.aggregate.primitives();
    let primitive = &primitives[vertex.point.hit.primitive as usize];
    if matches!(primitive, Primitive::Patch(_)) {
        return Clearance { any: 0.0, standing: f64::INFINITY };
    }
    let Surface::Object { object: own, .. } = world.surfaces[vertex.point.hit.primitive as usize] else {
        return Clearance::FREE;
    };
    let is_own = |p: u32| matches!(world.surfaces[p as usize], Surface::Object { object, .. } if object == own);
    let position = vertex.point.position;
    let any = world.aggregate.distance(position, limits.any, |p| !is_own(p));
    let stands = |p: u32| match primitive {
        Primitive::Quad(quad) => !is_own(p) && !primitives[p as usize].is_beside(quad),
        Primitive::Plane(_) => !is_own(p),
        Primitive::Sphere(_) | Primitive::Patch(_) => false,
    };
    let standing = (any < limits.standing)
        .then(|| world.aggregate.distance(position, limits.standing, stands))
        .filter(|standing| *standing < limits.standing);
    Clearance { any, standing: standing.unwrap_or(f64::INFINITY) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Ray;
    use crate::transport::testing::{self, quad, sphere};
    use glam::DVec3;

    const FAR: Clearance = Clearance { any: 10.0, standing: 10.0 };

    fn floor() -> String {
        quad("floor", [[-1.0, 0.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]], "grey")
    }

    /// From the floor's point (x, 0, 0), found by a short ray from above.
    fn on_the_floor(objects: &str, x: f64, limits: Clearance) -> [f64; 2] {
        let world = testing::world(&(floor() + objects));
        let vertex = testing::vertex(&world, &Ray::new(DVec3::new(x, 0.01, 0.0), DVec3::NEG_Y));
        let Clearance { any, standing } = clearance(&world, &vertex, limits);
        [any, standing]
    }

    fn assert_near([any, standing]: [f64; 2], [expected_any, expected_standing]: [f64; 2]) {
        let near = |a: f64, b: f64| a == b || (a - b).abs() < 1e-9;
        assert!(near(any, expected_any), "any: {any} instead of {expected_any}");
        assert!(near(standing, expected_standing), "standing: {standing} instead of {expected_standing}");
    }

    #[test]
    fn objects_above_a_floor_stand_on_it_and_walls_along_its_edges_do_not() {
        let ball = sphere("ball", [0.5, 0.5, 0.0], 0.3, "grey");
        let wall = quad("wall", [[1.0, 0.0, -1.0], [0.0, 0.0, 2.0], [0.0, 1.0, 0.0]], "grey");
        let to_ball = 0.5f64.sqrt() - 0.3;
        assert_near(on_the_floor(&ball, 0.0, FAR), [to_ball; 2]);
        assert_near(on_the_floor(&wall, 0.25, FAR), [0.75, f64::INFINITY]);
        assert_near(on_the_floor(&(wall + &ball), 0.9, FAR), [0.1, 0.41f64.sqrt() - 0.3]);
    }

    #[test]
    fn distances_beyond_the_limits_are_not_looked_for() {
        let ball = sphere("ball", [0.5, 0.5, 0.0], 0.3, "grey");
        assert_near(on_the_floor(&ball, 0.0, Clearance { any: 0.2, standing: 0.2 }), [0.2, f64::INFINITY]);
        assert_near(on_the_floor(&ball, 0.0, Clearance { any: 0.2, standing: 5.0 }), [0.2, 0.5f64.sqrt() - 0.3]);
        assert_near(on_the_floor("", 0.0, FAR), [10.0, f64::INFINITY]);
    }

    #[test]
    fn nothing_stands_on_curved_surfaces() {
        let world = testing::world(&(floor() + &sphere("ball", [0.0, 0.75, 0.0], 0.5, "grey")));
        let vertex = testing::vertex(&world, &Ray::new(DVec3::new(0.0, 0.1, 0.0), DVec3::Y));
        let Clearance { any, standing } = clearance(&world, &vertex, FAR);
        assert_near([any, standing], [0.25, f64::INFINITY]);
        let row = |i: i32| (0..4).map(|j| [f64::from(i) - 1.5, 0.5, 1.5 - f64::from(j)]).collect::<Vec<_>>();
        let rows: Vec<_> = (0..4).map(row).collect();
        let sheet =
            format!("[[object]]\nname = \"sheet\"\ntype = \"bezier\"\nmaterial = \"grey\"\npatches = [{rows:?}]\n");
        let world = testing::world(&(floor() + &sheet));
        let vertex = testing::vertex(&world, &Ray::new(DVec3::new(0.1, 2.0, 0.1), DVec3::NEG_Y));
        assert_eq!(clearance(&world, &vertex, FAR).any, 0.0, "its own curves may be near");
    }
}
