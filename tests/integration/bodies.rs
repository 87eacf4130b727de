//! Bodies of glass: what is around the camera, the lights and every path.

use crate::support::{advanced, assert_near, box_of, mean, object, patches_of, quad, render, scene, sphere};
use patchlight::engine::Session;
use patchlight::film::LinearImage;
use patchlight::transport::Component;
use std::f64::consts::PI;

/// A camera, and a material of glass with this name for each index of refraction.
pub(crate) fn glass(position: [f64; 3], materials: &[(&str, f64, f64)]) -> String {
    let film = "[film]\nwidth = 24\nheight = 24\n";
    let camera = format!("[camera]\nposition = {position:?}\ntarget = [0, 0, 0]\nfov_y = 40\n{film}");
    materials.iter().fold(camera, |text, (name, ior, absorption)| {
        let absorption = [*absorption; 3];
        text + &format!("[[material]]\nname = \"{name}\"\ntype = \"glass\"\nior = {ior}\nabsorption = {absorption:?}\n")
    })
}

/// A background of radiance 1, and a limit of bounces at which no light is lost.
const FURNACE: &str = "[render]\nmax_bounces = 400\nbackground = [1, 1, 1]\n";

fn assert_furnace(name: &str, text: &str) {
    let image = render(text, 32);
    for pixel in &image.pixels {
        // Weak branches of camera paths end at random: 4 % of noise in a pixel that sees many of them.
        assert!((pixel.y - 1.0).abs() < 0.05, "{name}: a pixel of {}", pixel.y);
    }
    assert_near(mean(&image), 1.0, 1e-3, name);
}

/// In a uniform surrounding of radiance 1, lossless bodies are invisible.
#[test]
fn lossless_bodies_are_invisible_in_a_furnace() {
    let two = glass([0.3, 0.4, 5.0], &[("a", 1.33, 0.0), ("b", 1.7, 0.0)]);
    let ball = |name: &str, x: f64, radius: f64, material: &str| sphere(name, [x, 0.0, 0.0], radius, material);
    let both = |a: String, b: String| format!("{two}{FURNACE}{a}{b}");
    let overlap = both(ball("w", -0.4, 1.0, "a"), ball("i", 0.6, 1.0, "b"));
    assert_furnace("two that overlap", &overlap);
    assert_furnace("one in the other", &both(ball("w", 0.0, 1.0, "a"), ball("i", 0.2, 0.5, "b")));
    assert_furnace("one medium, overlapping", &both(ball("w", -0.4, 1.0, "a"), ball("i", 0.6, 1.0, "a")));
    let upper = |material: &'static str| box_of("upper", [[-1.0, 0.0, -1.0], [1.0, 0.8, 1.0]], move |_| material);
    let lower = box_of("lower", [[-0.7, -0.9, -1.0], [1.0, 0.0, 0.6]], |_| "a");
    assert_furnace("two that touch", &both(upper("b"), lower.clone()));
    assert_furnace("two of one medium that touch", &both(upper("a"), lower));
}

/// A box of quads under one of patches: apart by less than rounding of their size, wherever the origin is.
#[test]
fn quads_and_patches_in_contact_are_one_interface() {
    let two = glass([0.1, 9.0, -0.05], &[("a", 1.3, 0.0), ("b", 1.8, 0.0)]).replace("fov_y = 40", "fov_y = 2");
    for height in [0.0, 0.3, -7.7] {
        for gap in [0.0, 3e-15, 1e-12, -3e-15, -1e-12] {
            let lower = box_of("lower", [[-1.0, height - 0.5, -1.0], [1.0, height - gap, 1.0]], |_| "a");
            let upper = box_of("upper", [[-0.8, height, -0.9], [0.8, height + 0.5, 0.7]], |_| "b");
            let name = format!("{gap} apart at {height}");
            assert_furnace(&name, &format!("{two}{FURNACE}{lower}{}", patches_of(&upper, "b")));
            assert_furnace(&name, &format!("{two}{FURNACE}{}{upper}", patches_of(&lower, "a")));
        }
    }
}

/// Long bars that cross and plates that share a corner touch in a small part of their faces; cubes of one object in a whole face.
#[test]
fn contact_in_a_small_part_of_the_faces_is_found() {
    let head =
        glass([0.3, 4.0, 0.2], &[("g", 1.5, 0.0), ("h", 1.33, 0.0)]).replace("fov_y = 40", "fov_y = 6") + FURNACE;
    let along = |material: &'static str| box_of("along", [[-5.0, -0.4, -0.1], [5.0, 0.0, 0.1]], move |_| material);
    let across = |material: &'static str| box_of("across", [[-0.1, 0.0, -5.0], [0.1, 0.4, 5.0]], move |_| material);
    assert_furnace("bars of quads", &format!("{head}{}{}", along("g"), across("h")));
    assert_furnace(
        "bars of patches",
        &format!("{head}{}{}", patches_of(&along("g"), "g"), patches_of(&across("h"), "h")),
    );
    let bars = along("g") + &across("g");
    assert_furnace("bars of one object", &format!("{head}{}", patches_of(&bars, "g")));
    let plate = |name: &str, low: [f64; 3], material: &'static str| {
        box_of(name, [low, [0, 1, 2].map(|k| low[k] + [2.0, 0.5, 2.0][k])], move |_| material)
    };
    let plates = plate("lower", [-1.9, -0.5, -1.9], "g") + &plate("upper", [0.0, 0.0, 0.0], "h");
    assert_furnace("plates", &format!("{head}{plates}"));
}

/// A body may have several materials of one medium, named as a body or not.
#[test]
fn a_body_of_two_materials_is_one() {
    let head = glass([1.5, 1.6, 3.5], &[("water", 1.33, 0.0), ("ripples", 1.33, 0.0)]) + FURNACE;
    let top = |face: &str| if face == "top" { "ripples" } else { "water" };
    let unnamed = box_of("box", [[-1.0, -1.0, -1.0], [1.0, 0.4, 1.0]], top);
    assert_furnace("materials that close each other", &format!("{head}{unnamed}"));
    let named = unnamed.replace("material =", "body = \"pool\"\nmaterial =");
    assert_furnace("a named body", &format!("{head}{named}"));
}

/// The camera in the middle of an absorbing ball sees all around through normal incidence: `n^2 T a / (1 - R a^2)` of the background.
#[test]
fn the_camera_may_be_inside_of_a_body() {
    let camera = glass([0.0, 0.0, 0.0], &[("g", 1.5, 0.7)]).replace("target = [0, 0, 0]", "target = [0, 0, -1]");
    let image = render(&format!("{camera}{FURNACE}{}", sphere("ball", [0.0; 3], 1.0, "g")), 16);
    let (reflected, passed) = (0.04, (-0.7f64).exp());
    let expected = 2.25 * 0.96 * passed / (1.0 - reflected * passed * passed);
    assert_near(mean(&image), expected, 2e-3, "radiance in the ball");
}

/// The camera and a wall lit by a lamp, in the same water.
fn under_water(ior: f64, absorption: f64, surface: &str) -> String {
    let camera = glass([0.0, -0.5, 2.0], &[("water", ior, absorption)]);
    let white = "[[material]]\nname = \"white\"\ntype = \"diffuse\"\nalbedo = [1, 1, 1]\n";
    let wall = object("wall", "plane", "white", "point = [0, 0, -1]\nnormal = [0, 0, 1]");
    let lamp = "[[light]]\nname = \"l\"\ntype = \"point\"\nposition = [0, -0.5, 0.5]\nintensity = [1, 1, 1]\n";
    let narrow = camera.replace("fov_y = 40", "fov_y = 0.2").replace("target = [0, 0, 0]", "target = [0, -0.5, 0]");
    [&narrow, "[render]\nmax_bounces = 1\n", white, &wall, lamp, surface].concat()
}

/// Under an open sheet of water, as inside of a closed body, light is absorbed on its whole way: `I / (pi d^2) exp(-a (d + s))`.
#[test]
fn direct_light_in_a_body_is_absorbed() {
    let sheet = quad("surface", [[-50.0, 1.0, -50.0], [0.0, 0.0, 100.0], [100.0, 0.0, 0.0]], "water");
    let ball = sphere("ball", [0.0; 3], 30.0, "water");
    for surface in [sheet, ball] {
        let image = render(&under_water(1.33, 0.4, &surface), 4);
        assert_near(mean(&image), (-0.4f64 * 4.5).exp() / (PI * 1.5 * 1.5), 1e-3, &surface);
    }
}

/// The flux that leaves a ball with a lamp in its middle: `I T a / (1 - R a^2)` in each direction.
#[test]
fn lamps_may_be_inside_of_a_body() {
    let point = "[[light]]\nname = \"l\"\ntype = \"point\"\nposition = [0, 0, 0]\nintensity = [10, 10, 10]\n";
    // A small sphere has the intensity `pi r^2 L`.
    let radiance = 10.0 / (PI * 0.02 * 0.02);
    let area = format!(
        "[[light]]\nname = \"l\"\ntype = \"sphere\"\ncenter = [0, 0, 0]\nradius = 0.02\nradiance = {:?}\n",
        [radiance; 3]
    );
    for lamp in [point.to_owned(), area] {
        let camera = glass([0.0, -2.0, 4.0], &[("g", 1.5, 0.7)])
            .replace("target = [0, 0, 0]", "target = [0, -3, 0]")
            .replace("fov_y = 40", "fov_y = 3");
        let white = "[[material]]\nname = \"white\"\ntype = \"diffuse\"\nalbedo = [1, 1, 1]\n";
        let floor = object("floor", "plane", "white", "point = [0, -3, 0]\nnormal = [0, 1, 0]");
        let text = [&camera, white, &floor, &sphere("ball", [0.0; 3], 1.0, "g"), &lamp].concat();
        let found = mean(&caustics(&text, 128));
        let passed = (-0.7f64).exp();
        let intensity = 10.0 * 0.96 * passed / (1.0 - 0.04 * passed * passed);
        // The narrow view is 0.2 wide, in which the irradiance falls by up to 1 %; some 10,000 photons arrive in it.
        assert_near(found, intensity / (PI * 9.0), 0.02, &lamp);
    }
}

/// The picture of the caustics alone.
fn caustics(text: &str, iterations: u64) -> LinearImage {
    let session = Session::prepare(&scene(text), 1, None).expect("the scene can be prepared");
    advanced(session.only(Some(Component::Caustics)), iterations).film().image()
}

/// Light through glass on a floor.
fn lit_through(bodies: &str) -> String {
    let camera = glass([1.0, 0.8, 0.0], &[("g", 1.5, 0.1), ("h", 1.5, 0.1)]).replace("fov_y = 40", "fov_y = 20");
    let white = "[[material]]\nname = \"white\"\ntype = \"diffuse\"\nalbedo = [0.9, 0.9, 0.9]\n";
    let floor = quad("floor", [[-4.0, 0.0, 4.0], [8.0, 0.0, 0.0], [0.0, 0.0, -8.0]], "white");
    let lamp = "[[light]]\nname = \"l\"\ntype = \"point\"\nposition = [0.2, 3, 0.1]\nintensity = [9, 9, 9]\n";
    [&camera, white, &floor, lamp, bodies].concat()
}

#[test]
fn plates_that_touch_are_one_plate() {
    let plate = |name: &str, low: f64, high: f64, material: &'static str| {
        box_of(name, [[-20.0, low, -20.0], [20.0, high, 20.0]], move |_| material)
    };
    let one = mean(&caustics(&lit_through(&plate("p", 1.0, 2.0, "g")), 32));
    for other in ["g", "h"] {
        let two = plate("p", 1.0, 1.4, "g") + &plate("q", 1.4, 2.0, other);
        assert_near(mean(&caustics(&lit_through(&two), 32)), one, 0.005, other);
    }
    let apart = plate("p", 1.0, 1.4, "g") + &plate("q", 1.5, 2.1, "h");
    assert!(mean(&caustics(&lit_through(&apart), 32)) < 0.97 * one, "two more interfaces reflect light");
}

/// A block on the floor, seen from outside: its lower face and the floor are one surface.
#[test]
fn a_block_that_stands_on_the_floor_shows_it() {
    let block = |low: f64| box_of("block", [[-0.4, low, -0.4], [0.4, 0.5, 0.4]], |_| "g");
    let standing = mean(&render(&lit_through(&block(0.0)), 32));
    // Sunk into the floor, the same block has no lower face above it.
    let sunk = mean(&render(&lit_through(&block(-0.1)), 32));
    assert_near(standing, sunk, 0.01, "the lower face");
}

/// A lens of two patches, moved by a transform.
fn lens(transform: &str) -> String {
    let patch = |height: f64| {
        let row = |i: usize| {
            let point = |j: usize| {
                // From above counter-clockwise on the upper side, clockwise on the lower one.
                let (x, z) = if height > 0.0 { (j, i) } else { (i, j) };
                let y = if (1..3).contains(&i) && (1..3).contains(&j) { height } else { 0.0 };
                format!("[{:?}, {y:?}, {:?}]", x as f64 / 1.5 - 1.0, z as f64 / 1.5 - 1.0)
            };
            format!("[{}]", (0..4).map(point).collect::<Vec<_>>().join(", "))
        };
        format!("[{}]", (0..4).map(row).collect::<Vec<_>>().join(", "))
    };
    object("lens", "bezier", "g", &format!("{transform}patches = [{}, {}]", patch(1.2), patch(-1.2)))
}

#[test]
fn a_mirroring_transform_keeps_the_outside_outside() {
    let head = glass([1.0, 3.0, 3.0], &[("g", 1.5, 1.0)]) + FURNACE;
    let mirrored = lens("transform = { scale = [-1, 1, 1] }\n");
    let plain = mean(&render(&format!("{head}{}", lens("")), 8));
    assert!(plain < 0.9, "it absorbs light: {plain}");
    assert_near(mean(&render(&format!("{head}{mirrored}"), 8)), plain, 1e-3, "mirrored");
}
