use super::*;
use crate::geometry::bezier::{ControlNet, Patch};
use crate::geometry::{Plane, Quad, Sphere};
use crate::math::{Sampler, Stream};
use std::sync::Arc;

fn bent_net(offset: DVec3) -> ControlNet {
    let point = |i: usize, j: usize| {
        let (x, z) = (i as f64 / 3.0, j as f64 / 3.0);
        offset + DVec3::new(x, 0.8 * (4.0 * x * z).sin(), z)
    };
    ControlNet { points: std::array::from_fn(|i| std::array::from_fn(|j| point(i, j))) }
}

/// The distance to a primitive, or to the nearest of many points on it. Each point of the surface has one of these
/// points within 0.02.
fn by_sampling(primitive: &Primitive, from: DVec3) -> f64 {
    let grid = (0..=100).flat_map(|i| (0..=100).map(move |j| (f64::from(i) / 100.0, f64::from(j) / 100.0)));
    let nearest = |at: &dyn Fn(f64, f64) -> DVec3| {
        grid.clone().map(|(u, v)| from.distance(at(u, v))).fold(f64::INFINITY, f64::min)
    };
    match primitive {
        Primitive::Quad(quad) => nearest(&|u, v| quad.position(u, v)),
        Primitive::Patch(patch) => nearest(&|u, v| patch.net().eval(u, v)),
        Primitive::Sphere(sphere) => (from.distance(sphere.center) - sphere.radius).abs(),
        Primitive::Plane(plane) => (from - plane.position(0.0, 0.0)).dot(plane.normal()).abs(),
    }
}

#[test]
fn walls_are_beside_a_floor_and_objects_on_it_are_not() {
    let floor = Quad::new(DVec3::ZERO, DVec3::X, DVec3::NEG_Z);
    let wall_at = |x: f64| {
        let quad = Quad::new(DVec3::new(x, 0.0, 0.0), DVec3::NEG_Z, DVec3::Y);
        let sphere = Sphere { center: DVec3::new(x + 0.2, 0.2, -0.5), radius: 0.2 };
        let plane = Plane::new(DVec3::new(x, 0.0, 0.0), DVec3::X, None);
        let patch = Patch::new(bent_net(DVec3::new(x, 0.0, -1.0)));
        [Primitive::Quad(quad), Primitive::Sphere(sphere), Primitive::Plane(plane), Primitive::Patch(Arc::new(patch))]
    };
    assert!(wall_at(1.0).iter().all(|wall| wall.is_beside(&floor)));
    assert!(wall_at(0.5).iter().all(|wall| !wall.is_beside(&floor)));
}

/// A point of the unit cube.
fn unit(k: u64) -> DVec3 {
    let mut s = Sampler::new(4, Stream::Camera, 9, k);
    DVec3::new(s.next_1d(), s.next_1d(), s.next_1d())
}

/// An aggregate of `count` primitives of all kinds in a cube of side 6, over a plane.
fn scattered(count: u64) -> Aggregate {
    let mut primitives = vec![Primitive::Plane(Plane::new(-3.0 * DVec3::Y, DVec3::Y, None))];
    for k in 0..count {
        let position = 6.0 * unit(k);
        primitives.push(match k % 3 {
            0 => Primitive::Quad(Quad::new(position, unit(100 + k), DVec3::Y)),
            1 => Primitive::Sphere(Sphere { center: position, radius: 0.3 }),
            _ => Primitive::Patch(Arc::new(Patch::new(bent_net(position)))),
        });
    }
    Aggregate::new(primitives)
}

#[test]
fn the_nearest_of_few_and_of_many_is_found() {
    for count in [1, 2, 7, 12, 40] {
        let aggregate = scattered(count);
        let mut hits = 0;
        for k in 0..2000 {
            // Origins among the primitives, so that some rays begin in spheres.
            let mut ray = Ray::new(6.0 * unit(k), 6.0 * unit(10_000 + k) - 3.0);
            ray.t_min = if k % 5 == 0 { 0.2 } else { 0.0 };
            ray.t_max = if k % 7 == 0 { 1.5 } else { f64::INFINITY };
            ray.direction.y = if k % 41 == 0 { 0.0 } else { ray.direction.y };
            let all = aggregate.primitives().iter().zip(0..);
            let met = all.filter_map(|(primitive, index)| Some((primitive.intersect(&ray)?.0, index)));
            let nearest = met.min_by(|a, b| a.0.total_cmp(&b.0));
            let found = aggregate.closest_hit(&ray);
            assert_eq!(found.map(|hit| hit.primitive), nearest.map(|(_, index)| index), "{count}: {ray:?}");
            assert_eq!(aggregate.occluded(&ray), nearest.is_some(), "{count}: {ray:?}");
            if let (Some(found), Some((t, index))) = (found, nearest) {
                assert!((found.t - t).abs() < 1e-12 * (1.0 + t), "{count}: {ray:?}");
                let exact = aggregate.primitives()[index as usize].intersect(&ray).expect("it was met");
                assert!((found.u - exact.1).abs().max((found.v - exact.2).abs()) < 1e-11, "{count}: {ray:?}");
                hits += 1;
            }
        }
        assert!(hits > 600, "{count}: {hits} hits");
    }
}

#[test]
fn a_packet_finds_the_hits_of_its_rays() {
    let aggregate = scattered(40);
    let (mut hits, mut hits_on_patches) = (0, 0);
    for k in 0..2000 {
        // From nearly parallel rays to rays in unrelated directions.
        let spread = [0.003, 0.1, 2.0][k as usize % 3];
        let from = 14.0 * unit(k) - 4.0;
        let rays: [Ray; LANES] = std::array::from_fn(|lane| {
            let at = 6.0 * unit(10_000 + k) + spread * unit(100_000 + 8 * k + lane as u64);
            let mut ray = Ray::new(from, at - from);
            // Some rays end early, run along an axis, or have no direction.
            ray.t_max = if (k + lane as u64).is_multiple_of(11) { 0.7 } else { ray.t_max };
            ray.direction = match (k + lane as u64) % 37 {
                0 => DVec3::NAN,
                1 => DVec3::ZERO,
                2 => DVec3::NEG_Y,
                _ => ray.direction,
            };
            ray
        });
        for (ray, in_packet) in rays.iter().zip(aggregate.closest_hits(&rays)) {
            let alone = aggregate.closest_hit(ray);
            assert_eq!(alone.map(|hit| hit.primitive), in_packet.map(|hit| hit.primitive), "{ray:?}");
            if let (Some(a), Some(b)) = (alone, in_packet) {
                // Newton's method starts elsewhere.
                assert!((a.t - b.t).abs() < 1e-10 * a.t, "{ray:?}: {a:?} {b:?}");
                hits += 1;
                hits_on_patches += usize::from(a.primitive % 3 == 0 && a.primitive > 0);
            }
        }
    }
    assert!(hits > 8000 && hits_on_patches > 2000, "{hits} hits, {hits_on_patches} on patches");
}

#[test]
fn the_nearest_included_primitive_is_found() {
    let aggregate = scattered(40);
    let mut closer_than_boxes = 0;
    for k in 0..200 {
        let from = 8.0 * unit(1000 + k) - 1.0;
        let counts = |p: u32| u64::from(p) % 5 != k % 5;
        let least = |distance: &dyn Fn(&Primitive) -> f64| {
            let counting = (0..).zip(aggregate.primitives()).filter(|(p, _)| counts(*p));
            counting.map(|(_, primitive)| distance(primitive)).fold(f64::INFINITY, f64::min)
        };
        let to_surface = least(&|primitive| by_sampling(primitive, from));
        let to_box = least(&|primitive| match primitive {
            Primitive::Patch(patch) => patch.bounds().distance(from),
            other => by_sampling(other, from) - 0.02,
        });
        let found = aggregate.distance(from, f64::INFINITY, counts);
        assert!(to_box - 1e-6 < found && found < to_surface + 1e-6, "{found} is not in {to_box} to {to_surface}");
        closer_than_boxes += usize::from(found > to_box + 0.03);
        assert_eq!(aggregate.distance(from, 0.5 * found, counts), 0.5 * found, "the limit");
    }
    assert!(closer_than_boxes > 10, "a patch is held by more than one box");
}
