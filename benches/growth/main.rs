//! Tables of how the cost of an iteration grows with threads, pixels, photons, patches, lights and bounces.
//!
//! A cost is the least time of the first iteration of full size and of later ones.

#![allow(clippy::expect_used, reason = "a measurement that cannot go on has failed")]
#![allow(clippy::print_stdout, reason = "the tables are its output")]

use glam::DVec3;
use patchlight::engine::Session;
use patchlight::math::{Sampler, Stream};
use patchlight::scene::{Emitter, Light, SceneFile, Shape};
use patchlight::transport::{
    CameraBatch, Cancel, LightSheets, Maps, PassInput, PhotonMap, Plan, camera_pass, gather, global_photon_pass,
};
use patchlight::world::prepare;
use rayon::prelude::*;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

/// The measured cost of a scene.
struct Cost {
    prepare: f64,
    iteration: f64,
    /// Peak memory of the program in megabytes; `None` where the system does not report it.
    megabytes: Option<u64>,
}

/// `balls.toml` of the suite: a box with a mirror ball and a glass ball.
fn balls() -> SceneFile {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/benches/suite/balls.toml"));
    SceneFile::open(path).expect("the scene is valid")
}

fn seconds<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let result = work();
    (start.elapsed().as_secs_f64(), result)
}

/// Resets the peak of the memory that the system reports.
fn forget_peak() {
    std::fs::write("/proc/self/clear_refs", "5").ok();
}

fn peak_megabytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(line.split_whitespace().nth(1)?.parse::<u64>().ok()? / 1024)
}

/// Iterations before the first one of full size.
const SMALL_ITERATIONS: u64 = 3;

fn cost(file: &SceneFile, whole_iterations: usize) -> Cost {
    forget_peak();
    let (prepare, session) = seconds(|| Session::prepare(file, 1, None));
    let mut session = session.expect("the scene can be prepared");
    while session.iterations() < SMALL_ITERATIONS {
        session.advance(Cancel::NEVER);
    }
    let times = (0..whole_iterations).map(|_| seconds(|| session.advance(Cancel::NEVER)).0);
    let iteration = times.fold(f64::INFINITY, f64::min);
    Cost { prepare, iteration, megabytes: peak_megabytes() }
}

fn head(quantity: &str) {
    println!("\n| {quantity} | prepared in | seconds for an iteration | memory |\n|--:|--:|--:|--:|");
}

fn row(value: impl std::fmt::Display, cost: &Cost) {
    let memory = cost.megabytes.map_or("unknown".to_owned(), |megabytes| format!("{megabytes} MB"));
    println!("| {value} | {:.3} s | {:.3} | {memory} |", cost.prepare, cost.iteration);
}

fn sized(mut file: SceneFile, side: u32) -> SceneFile {
    (file.scene.film.width, file.scene.film.height) = (side, side);
    file
}

fn threads() {
    head("threads");
    for count in [1, 2, 1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build().expect("there are threads");
        row(count, &pool.install(|| cost(&balls(), 6)));
    }
}

fn resolution() {
    head("pixels along a side");
    for side in [128, 256, 512, 1024, 2048] {
        row(side, &cost(&sized(balls(), side), if side > 512 { 1 } else { 3 }));
    }
}

/// The first patch of the teapot alone; then a grid of teapots, as large in total as one teapot.
fn patches() {
    head("patches");
    row(1, &cost(&one_patch(), 3));
    for side in [1, 6, 32] {
        let mut file = sized(SceneFile::built_in("teapot").expect("there is such a scene"), 256);
        let mut count = 0;
        for object in &mut file.scene.objects {
            let Shape::Bezier(bezier) = &mut object.shape else { continue };
            let corners = bezier.patches.iter().flat_map(|net| net.points.as_flattened()).copied();
            let (min, max) =
                corners.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(min, max), p| (min.min(p), max.max(p)));
            let scale = 1.0 / f64::from(side);
            let cells = (0..side * side).map(|k| DVec3::new(f64::from(k % side), f64::from(k / side), 0.0) * scale);
            let copies = cells.flat_map(|cell| {
                bezier.patches.iter().map(move |net| net.map(|p| min + scale * (p - min) + cell * (max - min)))
            });
            bezier.patches = Arc::new(copies.collect());
            bezier.file = None;
            count += bezier.patches.len();
        }
        row(count, &cost(&file, 3));
    }
}

fn one_patch() -> SceneFile {
    let mut file = sized(SceneFile::built_in("teapot").expect("there is such a scene"), 256);
    for object in &mut file.scene.objects {
        if let Shape::Bezier(bezier) = &mut object.shape {
            bezier.patches = Arc::new(vec![bezier.patches[0]]);
            bezier.file = None;
        }
    }
    file
}

/// The power of the lamp spread over many lamps in the upper half of the room.
fn lights() {
    head("lights");
    for count in [1, 8, 9, 100, 1000] {
        let mut file = balls();
        let lamp = file.scene.lights[0].clone();
        let Emitter::Point { intensity, .. } = lamp.emitter else { continue };
        file.scene.lights = (0..count)
            .map(|k| {
                let mut s = Sampler::new(1, Stream::Camera, 0, k);
                let position = DVec3::new(1.8 * s.next_1d() - 0.9, 0.9 * s.next_1d(), 1.8 * s.next_1d() - 0.9);
                let emitter = Emitter::Point { position, intensity: intensity / count as f32 };
                Light { name: format!("lamp {k}"), emitter }
            })
            .collect();
        row(count, &cost(&file, 3));
    }
}

fn bounces() {
    head("bounces");
    for bounces in [1, 2, 4, 8, 16, 32, 64] {
        let mut file = balls();
        file.scene.render.max_bounces = bounces;
        row(bounces, &cost(&file, 3));
    }
}

/// The passes of one iteration whose cost grows with the photons.
fn photons() {
    println!(
        "\n| paths for interreflection | photons | photon pass, s | map, s | gather, s | map's memory |\n|--:|--:|--:|--:|--:|--:|"
    );
    let file = balls();
    let world = prepare(&file.scene, &file.location, None).expect("the scene can be prepared");
    let mut plan = Plan::new(&world);
    const ITERATION: u64 = SMALL_ITERATIONS + 1;
    let bands = plan.bands(ITERATION).into_par_iter();
    let seen = bands.map(|rows| camera_pass(&PassInput::uncancelled(&world, &plan, 1, ITERATION), &rows));
    let seen: Vec<CameraBatch> = seen.collect::<Option<_>>().expect("never cancelled");
    for paths in [10_000, 100_000, 1_000_000, 10_000_000] {
        plan.global_paths = vec![paths];
        let input = PassInput::uncancelled(&world, &plan, 1, ITERATION);
        let (photon_pass, batch) = seconds(|| global_photon_pass(&input));
        let batch = batch.expect("never cancelled");
        let (build, global) = seconds(|| PhotonMap::build(&batch.photons));
        let maps = Maps { global, ..Maps::default() };
        let gather = |batch: &CameraBatch| {
            gather(&input, &maps, &LightSheets::default(), batch).expect("never cancelled").points
        };
        let (gather, _) = seconds(|| seen.par_iter().map(gather).collect::<Vec<_>>());
        let (count, megabytes) = (batch.photons.len(), maps.global.memory_bytes() as f64 / f64::from(1 << 20));
        println!("| {paths} | {count} | {photon_pass:.3} | {build:.3} | {gather:.3} | {megabytes:.1} MB |");
    }
}

fn main() {
    // The table that needs most memory comes last, since the program does not return all memory to the system.
    threads();
    bounces();
    lights();
    resolution();
    photons();
    patches();
}
