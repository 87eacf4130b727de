//! The speed of the stages of an iteration: rays in a room, the photon map, photon passes and the camera pass.

#![allow(clippy::expect_used, reason = "a measurement that cannot go on has failed")]

use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main, measurement::WallTime};
use glam::DVec3;
use patchlight::geometry::{Aggregate, Primitive, Quad, Sphere};
use patchlight::math::{Ray, Sampler, Stream, warp};
use patchlight::scene::SceneFile;
use patchlight::transport::{
    PassInput, Photon, PhotonMap, Plan, Query, camera_pass, caustic_photon_pass, global_photon_pass,
};
use patchlight::world::{World, prepare};
use rayon::prelude::*;
use std::hint::black_box;
use std::path::Path;
use std::time::Duration;

const RAYS: usize = 4096;

/// Five walls of a box with corners at -1 and 1, open to the camera, and two balls.
fn room() -> Aggregate {
    let wall = |corner: [f64; 3], u: [f64; 3], v: [f64; 3]| {
        Primitive::Quad(Quad::new(DVec3::from(corner), DVec3::from(u), DVec3::from(v)))
    };
    let ball = |x: f64, z: f64| Primitive::Sphere(Sphere { center: DVec3::new(x, -0.6, z), radius: 0.4 });
    Aggregate::new(vec![
        wall([-1.0, -1.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]),
        wall([-1.0, 1.0, -1.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0]),
        wall([-1.0, -1.0, -1.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]),
        wall([-1.0, -1.0, 1.0], [0.0, 0.0, -2.0], [0.0, 2.0, 0.0]),
        wall([1.0, -1.0, -1.0], [0.0, 0.0, 2.0], [0.0, 2.0, 0.0]),
        ball(-0.45, -0.4),
        ball(0.45, 0.3),
    ])
}

/// Rays from random points in the room in random directions.
fn incoherent() -> Vec<Ray> {
    (0..RAYS as u64)
        .map(|index| {
            let mut s = Sampler::new(3, Stream::Camera, 0, index);
            let origin = DVec3::new(s.next_1d(), s.next_1d(), s.next_1d()) * 1.9 - 0.95;
            Ray::new(origin, warp::uniform_sphere(s.next_2d()))
        })
        .collect()
}

fn rays(c: &mut Criterion) {
    let (room, rays) = (room(), incoherent());
    let mut group = c.benchmark_group("five walls and two balls");
    group.throughput(Throughput::Elements(RAYS as u64));
    group.bench_function("closest hit", |b| {
        b.iter(|| rays.iter().filter(|ray| room.closest_hit(black_box(ray)).is_some()).count())
    });
    let to_light: Vec<Ray> = rays.iter().map(|ray| Ray::between(ray.origin, DVec3::new(0.1, 0.75, 0.1))).collect();
    group.bench_function("shadow", |b| b.iter(|| to_light.iter().filter(|ray| room.occluded(black_box(ray))).count()));
    group.finish();
}

/// `balls.toml` of the suite: a box with a mirror ball and a glass ball.
fn balls() -> (World, Plan) {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/benches/suite/balls.toml"));
    let file = SceneFile::open(path).expect("the scene is valid");
    let world = prepare(&file.scene, &file.location, None).expect("the scene is whole");
    let plan = Plan::new(&world);
    (world, plan)
}

/// The first iteration of full size; the earlier ones are smaller.
const ITERATION: u64 = 4;

fn few_samples<'a>(c: &'a mut Criterion, name: &str) -> BenchmarkGroup<'a, WallTime> {
    let mut group = c.benchmark_group(name);
    group.sample_size(10).warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(4));
    group
}

fn passes(c: &mut Criterion) {
    let (world, plan) = balls();
    let mut group = few_samples(c, "paths, all threads");
    let input = PassInput::uncancelled(&world, &plan, 1, ITERATION);
    let global = global_photon_pass(&input).expect("never cancelled");
    group.throughput(Throughput::Elements(global.counters.global_paths));
    group.bench_function("interreflection", |b| b.iter(|| global_photon_pass(&input)));
    let caustic = caustic_photon_pass(&input).expect("never cancelled");
    group.throughput(Throughput::Elements(caustic.counters.caustic_paths));
    group.bench_function("caustics", |b| b.iter(|| caustic_photon_pass(&input)));
    group.throughput(Throughput::Elements(4 * plan.camera.pixel_count() as u64));
    let seen = |rows| camera_pass(&input, &rows).expect("never cancelled");
    group.bench_function("camera", |b| b.iter(|| plan.bands(ITERATION).into_par_iter().map(seen).collect::<Vec<_>>()));
    group.finish();

    let mut group = few_samples(c, "photon map");
    group.throughput(Throughput::Elements(global.photons.len() as u64));
    group.bench_function("build, all threads", |b| b.iter(|| PhotonMap::build(black_box(&global.photons))));
    let map = PhotonMap::build(&global.photons);
    // With a slightly tilted normal, which forbids to sum whole nodes at once; and without tilt, as in most estimates.
    for (name, slope) in [("gather", 1e-6), ("gather, whole nodes at once", 0.0)] {
        let queries = queries(&global.photons, slope);
        group.throughput(Throughput::Elements(count_found(&global.photons, &queries)));
        group.bench_function(name, |b| b.iter(|| map.sums(black_box(&queries))));
    }
    group.finish();
}

/// Discs around some photons on the floor, as large as the discs of visible points.
fn queries(photons: &[Photon], slope: f32) -> Vec<Query> {
    // The front of the first object.
    let floor: Vec<&Photon> = photons.iter().filter(|photon| photon.tag >> 8 == 1).collect();
    let step = floor.len() / 1000;
    let around = |photon: &&Photon| Query {
        position: photon.position,
        normal: glam::Vec3::Y,
        radius: 0.12,
        slope: glam::Vec3::splat(slope),
        tag_start: photon.tag & !0xff,
        tag_span: 0xff,
    };
    let mut queries: Vec<Query> = floor.iter().step_by(step.max(1)).map(around).collect();
    // In the order of tiles, like visible points.
    queries.sort_by_key(|q| ((q.position.x * 16.0).floor() as i32, (q.position.z * 16.0).floor() as i32));
    queries
}

fn count_found(photons: &[Photon], queries: &[Query]) -> u64 {
    let is_found = |query: &Query, photon: &Photon| {
        photon.tag >> 8 == query.tag_start >> 8 && photon.position.distance(query.position) < query.radius
    };
    queries.iter().map(|query| photons.iter().filter(|photon| is_found(query, photon)).count() as u64).sum()
}

criterion_group!(benches, rays, passes);
criterion_main!(benches);
