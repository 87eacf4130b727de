//! The energy balance of photon paths of the built-in scenes: emitted flux is absorbed, escapes, is cut off or is left to the camera.

use crate::suite::{Case, Expected, Tolerance};
use patchlight::scene::SceneFile;
use patchlight::transport::{PassInput, PathEnergy, Plan, caustic_photon_pass, global_photon_pass};
use patchlight::world::{World, prepare};

/// Sum of the first iterations of one round.
const ITERATIONS: u64 = 2;

pub(crate) fn cases() -> Vec<Case> {
    let scenes = ["report", "report-flipped", "water", "cardioid", "lens", "teapot", "cornell"];
    scenes.into_iter().map(balances).collect()
}

/// The balances of the paths and of the stored photons, of both photon passes, relative to their flux.
fn balances(name: &'static str) -> Case {
    let world = built_in(name);
    let name = format!("flux that photon paths lose: {name}");
    let work = (ITERATIONS, "iterations");
    Case::values(name, "E2, E4", Expected::Value(0.0), Tolerance::Absolute(1e-6), work, move |round| {
        let plan = Plan::new(&world);
        let of = |iteration| {
            let input = PassInput::uncancelled(&world, &plan, round, iteration);
            let caustics = caustic_photon_pass(&input).expect("never cancelled").energy;
            [caustics, global_photon_pass(&input).expect("never cancelled").energy]
        };
        let balances = |energy: PathEnergy| [energy.path_balance(), energy.photon_balance()];
        (1..=ITERATIONS).flat_map(of).flat_map(balances).collect()
    })
}

fn built_in(name: &str) -> World {
    let mut file = SceneFile::built_in(name).expect("a built-in scene");
    (file.scene.film.width, file.scene.film.height) = (64, 64);
    prepare(&file.scene, &file.location, None).expect("the scene can be prepared")
}
