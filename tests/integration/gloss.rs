//! A small bright spot reflected by a glossy floor: light that camera paths hardly find. Its radiance is known by summation over the spot.

use crate::support::{photon_radiance, session_of_seed, spot_radiance, spot_scene, world};
use glam::DVec3;
use patchlight::transport::{PassInput, Plan, camera_pass, lobe_samples};
use std::f64::consts::TAU;

/// Half a side of the bright spot.
const HALF: f64 = 0.02;
const CAMERA: DVec3 = DVec3::new(-1.0, 1.2, 0.0);
const SIZE: u32 = 32;
const EXPONENT: f64 = 30.0;

/// A glossy floor seen by the camera; light reaches it from the lamp and once reflected from the spot.
fn scene(max_bounces: u32) -> String {
    format!(
        "[camera]\nposition = {camera:?}\ntarget = [0.5, 0, 0]\nfov_y = 20
        [film]\nwidth = {SIZE}\nheight = {SIZE}\n[render]\nmax_bounces = {max_bounces}
        [[material]]\nname = \"white\"\ntype = \"diffuse\"\nalbedo = [0.5, 0.5, 0.5]
        [[material]]\nname = \"gloss\"\ntype = \"phong\"
        albedo = [0, 0, 0]\nspecular = [0.5, 0.5, 0.5]\nexponent = {EXPONENT}
        [[object]]\nname = \"floor\"\ntype = \"quad\"\nmaterial = \"gloss\"
        corner = [-1, 0, 1]\nedge_u = [3, 0, 0]\nedge_v = [0, 0, -2]
        {spot}",
        camera = CAMERA.to_array(),
        spot = spot_scene(HALF, "white"),
    )
}

/// Radiance from the floor in the middle of a pixel towards the camera, by light that the spot reflected.
fn expected(column: u32, row: u32) -> f64 {
    let forward = (DVec3::new(0.5, 0.0, 0.0) - CAMERA).normalize();
    let right = forward.cross(DVec3::Y).normalize();
    let at = |k: u32| (2.0 * (f64::from(k) + 0.5) / f64::from(SIZE) - 1.0) * 10f64.to_radians().tan();
    let ray = forward + at(column) * right - at(row) * right.cross(forward);
    let floor = CAMERA - CAMERA.y / ray.y * ray;
    let mirrored = (ray * DVec3::new(1.0, -1.0, 1.0)).normalize();
    let lobe = |spot: DVec3| mirrored.dot((spot - floor).normalize()).max(0.0).powf(EXPONENT);
    spot_radiance(HALF, 24, floor, |spot| 0.5 * (EXPONENT + 2.0) / TAU * lobe(spot))
}

/// The mean of the pixels and their root mean square error, both over the expected mean.
fn errors(iterations: u64, seed: u64) -> [f64; 2] {
    let image = |max_bounces| session_of_seed(&scene(max_bounces), iterations, seed).film().image().pixels;
    let (mut mean, mut truth, mut squares) = (0.0, 0.0, 0.0);
    for (k, (all, direct)) in (0..).zip(image(2).iter().zip(image(1))) {
        let (found, expected) = (f64::from(all.y - direct.y), expected(k % SIZE, k / SIZE));
        mean += found;
        truth += expected;
        squares += (found - expected).powi(2);
    }
    let pixels = f64::from(SIZE * SIZE);
    [mean / truth, (squares / pixels).sqrt() / (truth / pixels)]
}

#[test]
fn gloss_shows_a_bright_spot_without_speckles() {
    let runs = [1, 2, 3, 4].map(|seed| errors(256, seed));
    let mean = |k: usize| runs.iter().map(|run| run[k]).sum::<f64>() / runs.len() as f64;
    let variance = runs.iter().map(|run| (run[0] - mean(0)).powi(2)).sum::<f64>() / (runs.len() - 1) as f64;
    let standard_error = (variance / runs.len() as f64).sqrt();
    // Discs blur the reflection, of which almost a hundredth leaves the picture.
    assert!((mean(0) - 1.0).abs() < 0.01 + 4.0 * standard_error && standard_error < 0.006, "{runs:?}");
    // 0.04; by the camera's paths alone it is 1.6.
    assert!(mean(1) < 0.1, "{runs:?}");
}

/// A room whose floor and back wall are glossy, seen from its open side.
const GLOSSY_ROOM: &str = "[camera]\nposition = [0, 0, 3.8]\ntarget = [0, 0, 0]\nfov_y = 40
    [film]\nwidth = 48\nheight = 48
    [[material]]\nname = \"white\"\ntype = \"diffuse\"\nalbedo = [0.7, 0.7, 0.7]
    [[material]]\nname = \"gloss\"\ntype = \"phong\"\nalbedo = [0.3, 0.3, 0.3]\nspecular = [0.5, 0.5, 0.5]\nexponent = 20
    [[object]]\nname = \"floor\"\ntype = \"quad\"\nmaterial = \"gloss\"\ncorner = [-1, -1, 1]\nedge_u = [2, 0, 0]\nedge_v = [0, 0, -2]
    [[object]]\nname = \"back\"\ntype = \"quad\"\nmaterial = \"gloss\"\ncorner = [-1, -1, -1]\nedge_u = [2, 0, 0]\nedge_v = [0, 2, 0]
    [[object]]\nname = \"top\"\ntype = \"quad\"\nmaterial = \"white\"\ncorner = [-1, 1, -1]\nedge_u = [2, 0, 0]\nedge_v = [0, 0, 2]
    [[object]]\nname = \"left\"\ntype = \"quad\"\nmaterial = \"white\"\ncorner = [-1, -1, 1]\nedge_u = [0, 0, -2]\nedge_v = [0, 2, 0]
    [[light]]\nname = \"l\"\ntype = \"point\"\nposition = [0.3, 0.5, 0]\nintensity = [1, 1, 1]\n";

/// Lobe reuse lowers the squared error of one iteration and keeps the mean. The truth is the mean of many iterations without lobe
/// reuse.
#[test]
fn lobe_reuse_lowers_the_variance_and_keeps_the_mean() {
    let world = world(GLOSSY_ROOM);
    let reusing = Plan::new(&world);
    let mut alone = reusing.clone();
    alone.reuses_lobes = false;
    let inner = |k: &usize| (18..30).contains(&(k % 48)) && (18..30).contains(&(k / 48));
    let image = |plan: &Plan, seed| {
        let radiance = photon_radiance(&world, plan, seed, 4);
        (0..48 * 48).filter(inner).map(|k| f64::from(radiance[k].y)).collect::<Vec<f64>>()
    };
    let runs: Vec<[Vec<f64>; 2]> = (0..64).map(|seed| [image(&alone, seed), image(&reusing, seed)]).collect();
    let truth: Vec<f64> = (0..144).map(|k| runs.iter().map(|run| run[0][k]).sum::<f64>() / 64.0).collect();
    let statistics = |of: &dyn Fn(&[Vec<f64>; 2]) -> f64| {
        let values: Vec<f64> = runs.iter().map(of).collect();
        let mean = values.iter().sum::<f64>() / 64.0;
        let variance = values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / 63.0;
        (mean, (variance / 64.0).sqrt())
    };
    let squares = |image: &[f64]| image.iter().zip(&truth).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
    // 0.36 with a standard error of 0.01. The truth is the mean of the runs without reuse, so these runs look 1/64 better than they are.
    let (ratio, error) = statistics(&|[alone, reusing]| squares(reusing) / squares(alone));
    assert!(ratio + 5.0 * error < 0.43, "{ratio}, standard error {error}");
    // The blur over some pixels, which shrinks with the discs, changes the mean by 0.009; its standard error is below 0.001.
    let (bias, error) = statistics(&|[alone, reusing]| reusing.iter().sum::<f64>() / alone.iter().sum::<f64>() - 1.0);
    assert!(bias.abs() + 5.0 * error < 0.02, "{bias}, standard error {error}");
}

/// A pixel at the floor's edge samples little of the floor's lobe: its neighbours do not reuse this sample, and the pixel
/// does not reuse its neighbours' samples.
#[test]
fn pixels_at_edges_neither_give_nor_take_lobe_samples() {
    let text = scene(2).replace("fov_y = 20", "fov_y = 60");
    let world = world(&text);
    let plan = Plan::new(&world);
    let rows = 0..SIZE;
    let input = PassInput::uncancelled(&world, &plan, 1, 4);
    let seen = camera_pass(&input, &rows).expect("never cancelled");
    let lobes = lobe_samples(&input, &seen.visible_points, &rows);
    let met =
        |pixel: usize| seen.visible_points.iter().filter(|p| p.pixel as usize == pixel && p.seen_directly).count();
    let edges: Vec<usize> = (0..lobes.len()).filter(|&k| seen.samples[k].is_heterogeneous).collect();
    assert!(edges.iter().any(|&k| met(k) == 1), "one of its paths met the floor, the other paths left the scene");
    assert!(edges.iter().all(|&k| lobes[k].is_none()), "edges have no lobe samples to reuse");
    assert!(lobes.iter().flatten().count() > lobes.len() / 8, "pixels inside the floor have lobe samples");
}
