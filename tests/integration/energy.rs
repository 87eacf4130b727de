//! The energy balance of the photon passes: emitted flux is absorbed, escapes, is cut off or is left to the camera.

use crate::support::{HEAD, lamp, quad, sphere, world};
use patchlight::engine::Session;
use patchlight::scene::{SceneFile, built_in_scenes};
use patchlight::transport::{Cancel, Energy, PassInput, PathEnergy, Plan, caustic_photon_pass, global_photon_pass};
use patchlight::world::{World, prepare};
use std::fs;
use std::path::{Path, PathBuf};

const TOLERANCE: f64 = 1e-6;

/// The energy of each of the first iterations of a world.
fn energies(world: &World, iterations: u64) -> Vec<Energy> {
    let plan = Plan::new(world);
    let of = |iteration| {
        let input = PassInput::uncancelled(world, &plan, 1, iteration);
        let caustics = caustic_photon_pass(&input).expect("never cancelled").energy;
        let interreflection = global_photon_pass(&input).expect("never cancelled").energy;
        Energy { caustics, interreflection, ..Energy::default() }
    };
    (1..=iterations).map(of).collect()
}

/// Asserts that all flux is accounted for, and that roulette has no bias: `noise` is the greatest sum of roulette over the emitted
/// flux.
fn assert_balanced(energy: &PathEnergy, noise: f64, case: &str) {
    let (paths, photons) = (energy.path_balance(), energy.photon_balance());
    assert!(paths.abs() < TOLERANCE, "{case}: {paths:e} of the flux is lost in {energy:#?}");
    assert!(photons.abs() < TOLERANCE, "{case}: {photons:e} of the photons is lost in {energy:#?}");
    let roulette = energy.roulette.abs();
    assert!(roulette <= noise * energy.emitted, "{case}: roulette is biased in {energy:#?}");
}

fn assert_each_balanced(world: &World, noise: f64, case: &str) {
    for (k, energy) in (1..).zip(energies(world, 2)) {
        assert_balanced(&energy.caustics, noise, &format!("{case}, iteration {k}, caustics"));
        assert_balanced(&energy.interreflection, noise, &format!("{case}, iteration {k}, interreflection"));
    }
}

/// The scenes in a folder and the folders in it.
fn scenes(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let of = |path: PathBuf| if path.is_dir() { scenes(&path) } else { vec![path] };
    let is_scene = |path: &PathBuf| {
        path.extension().is_some_and(|e| e == "toml") && fs::read_to_string(path).is_ok_and(|t| t.contains("[camera]"))
    };
    entries.flat_map(of).filter(is_scene).collect()
}

#[test]
fn every_scene_is_balanced() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let files = [root.join("scenes"), root.join("benches/suite")].iter().flat_map(|folder| scenes(folder)).collect();
    let files: Vec<PathBuf> = files;
    assert!(files.len() > 30, "{files:?}");
    for path in files {
        let mut file = SceneFile::open(&path).expect("a valid scene");
        (file.scene.film.width, file.scene.film.height) = (32, 32);
        let world = prepare(&file.scene, &file.location, None).expect("the scene can be prepared");
        assert_each_balanced(&world, 0.02, &path.display().to_string());
    }
}

/// Nine iterations, of which the last ones have plans that measurements refined twice.
#[test]
fn refined_plans_are_balanced() {
    let suite = scenes(&Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/suite"));
    assert!(suite.len() > 10, "{suite:?}");
    let built_in = built_in_scenes().iter().map(|scene| SceneFile::built_in(scene.name).expect("a built-in scene"));
    for mut file in built_in.chain(suite.iter().map(|path| SceneFile::open(path).expect("a valid scene"))) {
        (file.scene.film.width, file.scene.film.height) = (24, 24);
        let mut session = Session::prepare(&file, 1, None).expect("the scene can be prepared");
        for _ in 0..9 {
            session.advance(Cancel::NEVER).expect("never cancelled");
        }
        let Energy { worst_of_caustics, worst_of_interreflection, .. } = session.stats().energy;
        for worst in [worst_of_caustics, worst_of_interreflection] {
            assert!(worst.balance < TOLERANCE, "{}: {worst:?}", file.location.label());
            assert!((1..=9).contains(&worst.iteration), "{}: {worst:?}", file.location.label());
        }
    }
}

/// Coloured glass that absorbs, in water; gloss, polish and a mirror of different colours; a normal map; a lamp with an area, which paths meet.
fn world_of_all_materials(max_bounces: u32) -> World {
    let normals = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/textures/bricks-normal.png");
    let materials = format!(
        "[[texture]]\nname = \"bricks\"\nfile = \"{normals}\"\n
        [[material]]\nname = \"rough\"\ntype = \"diffuse\"\nalbedo = [0.9, 0.5, 0.2]\nnormal_map = {{ texture = \"bricks\" }}
        [[material]]\nname = \"gloss\"\ntype = \"phong\"\nalbedo = [0.2, 0.4, 0.1]\nspecular = [0.4, 0.3, 0.5]\nexponent = 20
        normal_map = {{ texture = \"bricks\" }}
        [[material]]\nname = \"polished\"\ntype = \"polished\"\nalbedo = [0.1, 0.4, 0.5]\nreflectance = [0.6, 0.5, 0.4]
        [[material]]\nname = \"silver\"\ntype = \"mirror\"\nreflectance = [0.9, 0.8, 0.6]
        [[material]]\nname = \"water\"\ntype = \"glass\"\nior = 1.33\nabsorption = [0.5, 0.2, 0.1]\ntint = [0.9, 1, 1]
        [[material]]\nname = \"green\"\ntype = \"glass\"\nior = 1.5\nabsorption = [2, 0.1, 3]\ntint = [0.5, 0.9, 0.6]\n"
    );
    let wall = |name: &str, corner, u, v, material: &str| quad(name, [corner, u, v], material);
    let objects = [
        wall("floor", [-2.0, -2.0, 2.0], [4.0, 0.0, 0.0], [0.0, 0.0, -4.0], "rough"),
        wall("back", [-2.0, -2.0, -2.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], "gloss"),
        wall("left", [-2.0, -2.0, 2.0], [0.0, 0.0, -4.0], [0.0, 4.0, 0.0], "polished"),
        wall("right", [2.0, -2.0, -2.0], [0.0, 0.0, 4.0], [0.0, 4.0, 0.0], "silver"),
        sphere("pond", [0.0, -1.0, 0.0], 0.9, "water"),
        sphere("marble", [0.2, -1.0, 0.0], 0.4, "green"),
        sphere("ball", [1.2, 0.0, -1.0], 0.5, "gloss"),
    ];
    let lamp =
        "[[light]]\nname = \"disc\"\ntype = \"sphere\"\ncenter = [0, 1.2, 0]\nradius = 0.3\nradiance = [9, 8, 7]\n";
    world(&format!("{HEAD}{materials}{}{lamp}[render]\nmax_bounces = {max_bounces}\n", objects.concat()))
}

#[test]
fn all_materials_are_balanced_and_every_entry_is_used() {
    for max_bounces in [1, 2, 5, 16] {
        let world = world_of_all_materials(max_bounces);
        assert_each_balanced(&world, 0.02, &format!("{max_bounces} bounces"));
    }
    let Energy { caustics, interreflection, .. } = energies(&world_of_all_materials(5), 1)[0];
    for PathEnergy { absorbed, absorbed_in_media, escaped, met_light, cut_off, stored, .. } in
        [caustics, interreflection]
    {
        for (k, entry) in [absorbed, absorbed_in_media, escaped, met_light, cut_off, stored].into_iter().enumerate() {
            assert!(entry > 0.0, "entry {k}");
        }
    }
    assert!(caustics.scattered > 0.0 && caustics.other_components > 0.0);
    assert!(interreflection.phong_lobes != 0.0 && interreflection.shading_normals != 0.0);
    assert!(interreflection.camera_paths > 0.0);
}

/// A closed white room absorbs nothing: every path arrives four times, the first time as direct light, and is cut off.
#[test]
fn a_white_room_keeps_all_light() {
    let room =
        [&sphere("room", [0.0; 3], 5.0, "white"), &lamp([0.0, 1.0, 0.0]), "[render]\nmax_bounces = 4\n"].concat();
    for energy in energies(&world(&format!("{HEAD}{room}")), 3) {
        let PathEnergy { emitted, cut_off, arrived, camera_paths, stored, .. } = energy.interreflection;
        let power = 3.0 * 4.0 * std::f64::consts::PI;
        for (name, found, expected) in [
            ("emitted", emitted, 1.0),
            ("cut off", cut_off, 1.0),
            ("arrived", arrived, 4.0),
            ("direct light", camera_paths, 1.0),
            ("stored", stored, 3.0),
        ] {
            assert!((found / power - expected).abs() < TOLERANCE, "{name}: {found} W of {power} W");
        }
    }
}

#[test]
fn the_energy_is_the_same_for_any_number_of_threads() {
    let world = world_of_all_materials(16);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| energies(&world, 3))
    };
    assert_eq!(with(1), with(3));
}
