//! The cost of a feature that a scene does not need: an iteration as planned, with the feature removed from the plan by hand, and
//! with the feature added.

#![allow(clippy::expect_used, reason = "a measurement that cannot go on has failed")]
#![allow(clippy::print_stdout, reason = "the benchmark prints a table")]

use patchlight::scene::{Location, SceneFile};
use patchlight::transport::{
    CameraBatch, CausticPlan, Maps, PassInput, PhotonMap, Plan, camera_pass, caustic_photon_pass, gather,
    global_photon_pass,
};
use patchlight::world::{World, prepare};
use rayon::prelude::*;
use std::time::Instant;

/// The first iteration of full size; the earlier ones are smaller.
const ITERATION: u64 = 4;
/// Measurements of each plan, in turn.
const ROUNDS: usize = 300;

/// An open box with a diffuse ball.
const DIFFUSE: &str = r#"version = 1
[camera]
position = [0, 0, 4]
target = [0, 0, 0]
fov_y = 40
[film]
width = 96
height = 96
[[material]]
name = "white"
type = "diffuse"
albedo = [0.7, 0.7, 0.7]
[[material]]
name = "mirror"
type = "mirror"
reflectance = [0.9, 0.9, 0.9]
[[light]]
name = "lamp"
type = "point"
position = [0.2, 0.8, 0.3]
intensity = [1, 1, 1]
[[object]]
name = "floor"
type = "quad"
material = "white"
corner = [-1, -1, 1]
edge_u = [2, 0, 0]
edge_v = [0, 0, -2]
"#;

const BACK_WALL_AND_BALL: &str = r#"
[[object]]
name = "back wall"
type = "quad"
material = "white"
corner = [-1, -1, -1]
edge_u = [2, 0, 0]
edge_v = [0, 2, 0]
[[object]]
name = "ball"
type = "sphere"
material = "white"
center = [0, -0.6, 0]
radius = 0.4
"#;

/// A mirror that reflects light to the floor, while the camera looks away from it.
const MIRROR_BEHIND_THE_CAMERA: &str = r#"
[[object]]
name = "mirror"
type = "quad"
material = "mirror"
corner = [-1, -1, 7]
edge_u = [0, 2, 0]
edge_v = [2, 0, 0]
"#;

/// A glossy floor, whose lobe gathers the light of bright spots from photons, and whose lobe samples neighbours reuse.
const GLOSSY_FLOOR: &str = r#"
[[material]]
name = "gloss"
type = "phong"
albedo = [0.4, 0.4, 0.4]
specular = [0.4, 0.4, 0.4]
exponent = 20
[[object]]
name = "glossy floor"
type = "quad"
material = "gloss"
corner = [-1, -0.99, 1]
edge_u = [2, 0, 0]
edge_v = [0, 0, -2]
"#;

fn world(text: &str) -> World {
    let file = SceneFile::parse(text, Location::Unsaved).expect("the scene is valid");
    prepare(&file.scene, &file.location, None).expect("the scene is whole")
}

/// The time of the passes of one iteration in seconds.
fn iteration(world: &World, plan: &Plan) -> f64 {
    let start = Instant::now();
    let input = PassInput::uncancelled(world, plan, 1, ITERATION);
    let caustic = caustic_photon_pass(&input).expect("never cancelled");
    let global = global_photon_pass(&input).expect("never cancelled");
    let maps = Maps {
        caustic: PhotonMap::build(&caustic.photons),
        global: PhotonMap::build(&global.photons),
        indirect_caustic: PhotonMap::build(&global.indirect_caustics),
        glossy: PhotonMap::build(&global.glossy),
    };
    let band = |rows| {
        let seen: CameraBatch = camera_pass(&input, &rows).expect("never cancelled");
        gather(&input, &maps, &caustic.sheets, &seen).expect("never cancelled").points.len()
    };
    let gathered: usize = plan.bands(ITERATION).into_par_iter().map(band).sum();
    std::hint::black_box(gathered);
    start.elapsed().as_secs_f64()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Prints a row: medians of ratios of neighbouring measurements. Plans take turns, because the machine's speed changes.
fn row(what: &str, world: &World, without: &Plan, with: &Plan) {
    let plans = [&Plan::new(world), without, with];
    let (mut taken_out, mut put_in) = (Vec::new(), Vec::new());
    for round in 0..ROUNDS {
        let mut seconds = [0.0; 3];
        for k in 0..3 {
            let plan = (k + round) % 3;
            seconds[plan] = iteration(world, plans[plan]);
        }
        taken_out.push(seconds[0] / seconds[1]);
        put_in.push(seconds[2] / seconds[0]);
    }
    println!("| {what} | {:.3} | {:.2} |", median(taken_out), median(put_in));
}

fn main() {
    // One thread, so that no thread waits for another.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("there is a thread");
    pool.install(table);
}

fn table() {
    println!("| not needed | as planned over removed by hand | added by hand over as planned |\n|---|--:|--:|");
    let room = [DIFFUSE, BACK_WALL_AND_BALL].concat();
    let (diffuse, mirrored) = (world(&room), world(&[&room, MIRROR_BEHIND_THE_CAMERA].concat()));
    let caustics = Plan::new(&mirrored).caustics.expect("a mirror makes caustics");
    let planned = |caustics: Option<CausticPlan>| {
        let mut plan = Plan::new(&diffuse);
        plan.caustics = caustics;
        plan
    };
    row("caustics", &diffuse, &planned(None), &planned(Some(caustics.clone())));

    let floor = world(DIFFUSE);
    let paths = Plan::new(&diffuse).global_paths;
    let planned = |global_paths: Vec<u64>| {
        let mut plan = Plan::new(&floor);
        plan.global_paths = global_paths;
        plan
    };
    row("interreflection", &floor, &planned(Vec::new()), &planned(paths));

    let glossy = Plan::new(&world(&[&room, GLOSSY_FLOOR].concat()));
    let planned = |from: &Plan| {
        let mut plan = Plan::new(&diffuse);
        plan.glossy_mis = from.glossy_mis.clone();
        plan.reuses_lobes = from.reuses_lobes;
        plan
    };
    row("light in gloss", &diffuse, &planned(&Plan::new(&diffuse)), &planned(&glossy));

    let planned = |seen_indirectly: bool| {
        let mut plan = Plan::new(&mirrored);
        plan.caustics = Some(CausticPlan { seen_indirectly, ..caustics.clone() });
        plan
    };
    row("caustics in mirrors", &mirrored, &planned(false), &planned(true));
}
