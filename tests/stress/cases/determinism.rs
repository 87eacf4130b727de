//! The same bits for any number of threads, at every repeat, in any order of iterations, at odd sizes of the film.

use crate::suite::{
    Case, camera, diffuse, glass, material, object, patch_ball, point_light, quad, session, sphere_light, world,
};
use patchlight::engine::{PassMeter, iterate};
use patchlight::film::LinearImage;
use patchlight::transport::{PassInput, Plan};

pub(crate) fn cases() -> Vec<Case> {
    let threads = |round| {
        let [one, two, three] = [1, 2, 3].map(|threads| picture_with_threads(&mixed(40, 30), threads, 10, round));
        differing(&one, &two) + differing(&one, &three)
    };
    let repeats = |round| {
        let [first, second] = [0; 2].map(|_| session(&mixed(40, 30), None, 10, round).film().image());
        differing(&first, &second)
    };
    let mut cases = vec![
        Case::faults("pixels that differ between 1, 2 and 3 threads", "design, rule 1", (1200, "pixels"), threads),
        Case::faults("pixels that differ between repeats", "design, rule 1", (1200, "pixels"), repeats),
        Case::faults("pixels that depend on earlier iterations", "design, rule 2", (1200, "pixels"), out_of_order),
    ];
    for (width, height) in [(1, 1), (1, 7), (13, 1), (3, 2), (17, 31)] {
        let pixels = u64::from(width * height);
        let wrong = move |round| {
            let [one, three] = [1, 3].map(|threads| picture_with_threads(&mixed(width, height), threads, 6, round));
            crate::suite::improper(&one) + differing(&one, &three)
        };
        cases.push(Case::faults(
            format!("wrong pixels of a film of {width} x {height}"),
            "design, rule 1",
            (pixels, "pixels"),
            wrong,
        ));
    }
    cases
}

/// A scene with every kind of light transport.
fn mixed(width: u32, height: u32) -> String {
    let square = camera([0.0, 0.3, 4.0], [0.0; 3], 40.0, 16);
    let view = square.replace("width = 16\nheight = 16", &format!("width = {width}\nheight = {height}"));
    [
        view,
        diffuse("white", 0.7),
        glass("glass", 1.5, 0.1),
        material("gloss", "phong", "albedo = [0.5, 0.4, 0.3]\nspecular = [0.3, 0.3, 0.3]\nexponent = 30"),
        material("polish", "polished", "albedo = [0.5, 0.4, 0.3]\nreflectance = [0.2, 0.2, 0.2]"),
        patch_ball("ball", [0.0; 3], 0.5, "glass", ""),
        quad("back", [[-2.0, -1.0, -1.0], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]], "polish"),
        object("floor", "plane", "gloss", "point = [0, -1, 0]\nnormal = [0, 1, 0]"),
        point_light([1.0, 1.5, 1.0], 2.0),
        sphere_light([-1.0, 1.5, 1.0], 0.2, 5.0).replace("\"lamp\"", "\"bulb\""),
    ]
    .concat()
}

fn picture_with_threads(text: &str, threads: usize, iterations: u64, round: u64) -> LinearImage {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    pool.install(|| session(text, None, iterations, round).film().image())
}

/// The number of pixels with other bits.
fn differing(a: &LinearImage, b: &LinearImage) -> u64 {
    let bits = |pixel: &glam::Vec3| pixel.to_array().map(f32::to_bits);
    a.pixels.iter().zip(&b.pixels).filter(|(a, b)| bits(a) != bits(b)).count() as u64
}

/// Iterations 3, 1, 2, and then 3 again.
fn out_of_order(round: u64) -> u64 {
    let world = world(&mixed(40, 30));
    let plan = Plan::new(&world);
    let [first, _, _, again] = [3, 1, 2, 3].map(|iteration| {
        let input = PassInput::uncancelled(&world, &plan, 1 + round, iteration);
        iterate(&input, &PassMeter::default(), |c| c.photons.clone()).expect("never cancelled")
    });
    let picture = |pixels| LinearImage { width: 40, height: 30, pixels };
    differing(&picture(first), &picture(again))
}
