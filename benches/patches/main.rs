//! Rays against Bezier patches: our intersector, a Newton iteration from random starts, and triangles in a tree of the same type.
//!
//! Incoherent rays come from all directions and aim at points of the surface; a camera casts coherent rays.

#![allow(clippy::expect_used, reason = "a measurement that cannot go on has failed")]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::{DVec2, DVec3};
use patchlight::geometry::bezier::{ControlNet, Patch, QuadMesh, read_bpt};
use patchlight::geometry::{Aggregate, Primitive};
use patchlight::math::{Aabb, LANES, Ray, Sampler, Stream, warp};
use rayon::prelude::*;
use std::hint::black_box;
use std::sync::Arc;
use std::time::Duration;

mod newton;
mod triangles;

use newton::NewtonPatch;
use triangles::Triangles;

const RAYS: usize = 4096;

fn teapot() -> Vec<ControlNet> {
    read_bpt(include_str!("../../scenes/teapot.bpt")).expect("the teapot is valid")
}

fn hill() -> Vec<ControlNet> {
    let height = [[0.0, 0.05, 0.04, 0.0], [0.03, 0.45, 0.4, 0.05], [0.02, 0.38, 0.5, 0.06], [0.0, 0.04, 0.07, 0.02]];
    let point = |i: usize, j: usize| DVec3::new(i as f64 / 3.0, j as f64 / 3.0, height[i][j]);
    vec![ControlNet { points: std::array::from_fn(|i| std::array::from_fn(|j| point(i, j))) }]
}

fn bounds(nets: &[ControlNet]) -> Aabb {
    nets.iter().fold(Aabb::EMPTY, |bounds, net| bounds.union(&net.bounds()))
}

fn aggregate(nets: &[ControlNet]) -> Aggregate {
    Aggregate::new(nets.iter().map(|net| Primitive::Patch(Arc::new(Patch::new(*net)))).collect())
}

/// Rays from a surrounding sphere towards random points of random patches; every ray hits.
fn incoherent(nets: &[ControlNet]) -> Vec<Ray> {
    let bounds = bounds(nets);
    (0..RAYS as u64)
        .map(|index| {
            let mut sampler = Sampler::new(3, Stream::Camera, 0, index);
            let net = &nets[(sampler.next_1d() * nets.len() as f64) as usize];
            let DVec2 { x: u, y: v } = sampler.next_2d();
            let from = bounds.center() + bounds.diagonal() * warp::uniform_sphere(sampler.next_2d());
            Ray::new(from, net.eval(u, v) - from)
        })
        .collect()
}

/// Rays of a camera with 1024 x 1024 pixels through the middle of the film, row by row, which see the surface.
fn coherent(nets: &[ControlNet], aggregate: &Aggregate) -> Vec<Ray> {
    let bounds = bounds(nets);
    let origin = bounds.center() + bounds.diagonal() * DVec3::new(0.5, -1.1, 0.8);
    let right = (bounds.center() - origin).cross(DVec3::Z).normalize();
    let up = right.cross(bounds.center() - origin).normalize();
    let side = 1024;
    let rays = (0..side * side).map(|k| {
        let film = DVec2::new((k % side) as f64, (k / side) as f64) / side as f64 - 0.5;
        Ray::new(origin, bounds.center() + bounds.diagonal() * (film.x * right + film.y * up) - origin)
    });
    let seen: Vec<Ray> = rays.filter(|ray| aggregate.closest_hit(ray).is_some()).collect();
    let count = 16 * RAYS;
    let skip = (seen.len() - count.min(seen.len())) / 2;
    seen.into_iter().skip(skip).take(count).collect()
}

fn count<T>(rays: &[Ray], hit: impl Fn(&Ray) -> Option<T>) -> usize {
    rays.iter().filter(|ray| hit(black_box(ray)).is_some()).count()
}

fn count_packets(rays: &[Ray], patches: &Aggregate) -> usize {
    let hits = |bundle: &[Ray; LANES]| patches.closest_hits(black_box(bundle)).into_iter().flatten().count();
    rays.as_chunks::<LANES>().0.iter().map(hits).sum()
}

fn speed(c: &mut Criterion) {
    for (name, nets) in [("hill", hill()), ("teapot", teapot())] {
        let patches = aggregate(&nets);
        let newton: Vec<NewtonPatch> = nets.iter().map(|net| NewtonPatch::new(*net)).collect();
        let meshes = [64, 256].map(|steps| {
            (steps, Triangles::new(&QuadMesh::new(&nets.iter().map(|net| Patch::new(*net)).collect::<Vec<_>>(), steps)))
        });
        for (kind, rays) in [("incoherent", incoherent(&nets)), ("coherent", coherent(&nets, &patches))] {
            let mut group = c.benchmark_group(format!("{name}/{kind}"));
            group.throughput(Throughput::Elements(rays.len() as u64));
            group.sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(2));
            group.bench_function("patches", |b| b.iter(|| count(&rays, |ray| patches.closest_hit(ray))));
            group.bench_function("patches, all threads", |b| {
                b.iter(|| rays.par_iter().filter(|ray| patches.closest_hit(black_box(ray)).is_some()).count())
            });
            if kind == "coherent" {
                group.bench_function("patches, packets of eight rays", |b| b.iter(|| count_packets(&rays, &patches)));
            }
            for (steps, mesh) in &meshes {
                let id = BenchmarkId::new("triangles", steps);
                group.bench_function(id, |b| b.iter(|| count(&rays, |ray| triangles::closest_hit(mesh, ray))));
            }
            let few = &rays[..RAYS / 16];
            group.throughput(Throughput::Elements(few.len() as u64));
            group.bench_function("newton", |b| b.iter(|| count(few, |ray| newton::closest_hit(&newton, ray))));
            group.bench_function("newton behind boxes", |b| {
                b.iter(|| count(few, |ray| newton::closest_hit_behind_boxes(&newton, ray)))
            });
            group.finish();
        }
    }
}

/// The time to prepare a patch, to move a control point and to trace a ray, by the number of patches.
fn scaling(c: &mut Criterion) {
    let mut group = c.benchmark_group("build");
    for (name, net) in [("hill", hill()[0]), ("teapot handle", teapot()[12])] {
        group.bench_function(name, |b| b.iter(|| ready(black_box(net))));
    }
    group.finish();
    for copies in [0, 1, 32, 1000] {
        let nets = if copies == 0 { hill() } else { scattered(&teapot(), copies) };
        let (patches, rays) = (aggregate(&nets), incoherent(&nets));
        let mut group = c.benchmark_group("ray by number of patches");
        group.sample_size(10).throughput(Throughput::Elements(RAYS as u64));
        let id = BenchmarkId::from_parameter(nets.len());
        group.bench_function(id.clone(), |b| b.iter(|| count(&rays, |r| patches.closest_hit(r))));
        group.finish();
        c.benchmark_group("edit by number of patches").bench_function(id, |b| b.iter(|| edited(&patches, &nets[0])));
    }
}

/// The tree after a control point of the first patch has moved.
fn edited(patches: &Aggregate, net: &ControlNet) -> Aggregate {
    let mut net = *net;
    net.points[1][1].z += 0.1;
    let mut primitives = patches.primitives().to_vec();
    primitives[0] = Primitive::Patch(Arc::new(ready(net)));
    patches.refitted(primitives)
}

/// A patch with the tree that the first ray would prepare.
fn ready(net: ControlNet) -> Patch {
    let patch = Patch::new(net);
    patch.prepare();
    patch
}

/// The patches, copied `copies` times in a square grid.
fn scattered(nets: &[ControlNet], copies: usize) -> Vec<ControlNet> {
    let side = (copies as f64).sqrt().ceil() as usize;
    let pitch = bounds(nets).diagonal();
    let at = |k: usize| pitch * DVec3::new((k % side) as f64, (k / side) as f64, 0.0);
    (0..copies).flat_map(|k| nets.iter().map(move |net| net.map(|p| p + at(k)))).collect()
}

criterion_group!(benches, speed, scaling);
criterion_main!(benches);
