//! Nothing depends on the size of the box around the world.

use crate::support::{lamp, mean, object, quad, render, session_of_seed, sphere};
use patchlight::film::LinearImage;
use std::f64::consts::PI;

const MATERIALS: &str = "[[material]]\nname = \"grey\"\ntype = \"diffuse\"\nalbedo = [0.5, 0.5, 0.5]
    [[material]]\nname = \"black\"\ntype = \"diffuse\"\nalbedo = [0, 0, 0]
    [[material]]\nname = \"glass\"\ntype = \"glass\"\nior = 1.5
    [[material]]\nname = \"mirror\"\ntype = \"mirror\"\nreflectance = [1, 1, 1]\n";

/// A camera of this field of view, with a film of 32 x 32 pixels.
fn camera(position: [f64; 3], target: [f64; 3], fov: f64) -> String {
    format!(
        "{MATERIALS}[camera]\nposition = {position:?}\ntarget = {target:?}\nup = [0.01, 1, 0.02]\nfov_y = {fov:?}
        [film]\nwidth = 32\nheight = 32\n"
    )
}

/// The floor y = 0, from -half to half.
fn floor(half: f64) -> String {
    quad("floor", [[-half, 0.0, half], [2.0 * half, 0.0, 0.0], [0.0, 0.0, -2.0 * half]], "grey")
}

/// A lamp 1 above a floor lights a point 0.4 beside its foot with `1 / (1 + 0.4^2)^(3/2)`, however wide the floor is.
#[test]
fn a_lamp_lights_a_floor_of_any_size_alike() {
    let right = 0.5 / PI * 1.16f64.powf(-1.5);
    for half in [5.0, 50.0, 1.5e4, 5e8] {
        let text = camera([0.4, 2.0, 0.0], [0.4, 0.0, 0.0], 1.0) + &lamp([0.0, 1.0, 0.0]) + &floor(half);
        let found = mean(&render(&text, 4));
        // The film shows 0.03 units, over which the irradiance changes by 3 %, evenly.
        assert!((found / right - 1.0).abs() < 5e-3, "{found} instead of {right} on a floor of {half:e}");
    }
}

/// A room with a ball of glass, a mirror and a lamp, from -1 to 1 times the scale, around the middle.
fn room(middle: [f64; 3], scale: f64) -> String {
    let at = |p: [f64; 3]| [0, 1, 2].map(|k| middle[k] + scale * p[k]);
    let wall = |name: &str, corner: [f64; 3], u: [f64; 3], v: [f64; 3]| {
        quad(name, [at(corner), u.map(|x| scale * x), v.map(|x| scale * x)], "grey")
    };
    let walls = [
        wall("floor", [-1.0, -1.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]),
        wall("ceiling", [-1.0, 1.0, -1.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0]),
        wall("back", [-1.0, -1.0, -1.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]),
        wall("left", [-1.0, -1.0, 1.0], [0.0, 0.0, -2.0], [0.0, 2.0, 0.0]),
        wall("right", [1.0, -1.0, -1.0], [0.0, 0.0, 2.0], [0.0, 2.0, 0.0]),
    ];
    let balls = [
        sphere("glass", at([0.4, -0.65, 0.25]), 0.35 * scale, "glass"),
        sphere("mirror", at([-0.4, -0.65, -0.3]), 0.35 * scale, "mirror"),
    ];
    let intensity = scale * scale;
    let light =
        lamp(at([0.1, 0.8, 0.0])).replace("[1, 1, 1]", &format!("[{intensity:?}, {intensity:?}, {intensity:?}]"));
    [camera(at([0.0, 0.0, 3.8]), middle, 40.0), walls.concat(), balls.concat(), light].concat()
}

fn picture(text: &str, seed: u64) -> LinearImage {
    session_of_seed(text, 8, seed).film().image()
}

/// The root mean square of the difference, over the mean.
fn difference(a: &LinearImage, b: &LinearImage) -> f64 {
    let squares = a.pixels.iter().zip(&b.pixels).map(|(a, b)| f64::from((*a - *b).length_squared()) / 3.0);
    (squares.sum::<f64>() / a.pixels.len() as f64).sqrt() / mean(a)
}

/// Objects far away that neither light, shade nor show, one by one.
#[test]
fn far_objects_change_a_room_by_less_than_its_noise() {
    let alone = room([0.0; 3], 1.0);
    let (image, noise) = (picture(&alone, 1), difference(&picture(&alone, 1), &picture(&alone, 2)));
    let plane =
        |height: f64| object("far", "plane", "black", &format!("point = [0, {height:?}, 0]\nnormal = [0, 1, 0]"));
    let far_lamp =
        "[[light]]\nname = \"far\"\ntype = \"sphere\"\ncenter = [0, 1e9, 0]\nradius = 1\nradiance = [1, 1, 1]\n";
    let hidden = quad("lid", [[-3.0, 2.0, -3.0], [6.0, 0.0, 0.0], [0.0, 0.0, 6.0]], "black");
    for (far, case) in [
        (sphere("far", [0.0, 1e5, 0.0], 0.1, "black"), "a black ball at 1e5"),
        (sphere("far", [0.0, 1e9, 0.0], 10.0, "grey"), "a grey ball at 1e9"),
        (sphere("far", [1e9, 1e9, 0.0], 10.0, "mirror"), "a mirror at 1e9"),
        (sphere("far", [0.0; 3], 1e3, "black"), "a black sphere around the room"),
        (sphere("far", [0.0; 3], 1e9, "black"), "a large black sphere around the room"),
        (sphere("far", [0.0; 3], 1e9, "grey"), "a large grey sphere around the room"),
        (plane(-1e9), "a plane at -1e9"),
        (hidden + far_lamp, "a lamp at 1e9 that a lid hides"),
    ] {
        let changed = difference(&image, &picture(&(alone.clone() + &far), 1));
        assert!(changed < noise, "{case}: {changed}, with a noise of {noise}");
    }
}

/// The same room in other units, and off the origin.
#[test]
fn a_room_looks_the_same_in_any_unit_and_place() {
    let alone = room([0.0; 3], 1.0);
    let (image, noise) = (picture(&alone, 1), difference(&picture(&alone, 1), &picture(&alone, 2)));
    for (middle, scale) in [([0.0; 3], 1e-6), ([0.0; 3], 1e-4), ([0.0; 3], 1e4), ([1e5, -1e5, 1e5], 1.0)] {
        let changed = difference(&image, &picture(&room(middle, scale), 1));
        assert!(changed < noise, "{scale:e} at {middle:?}: {changed}, with a noise of {noise}");
    }
}

/// A camera far from the room that shows it as large as a near one.
#[test]
fn a_telephoto_picture_has_the_light_of_a_near_one() {
    let seen_from = |distance: f64, fov: f64| {
        let near = room([0.0; 3], 1.0);
        let (_, objects) = near.split_once("[[object]]").expect("the room has objects");
        camera([0.0, 0.0, distance], [0.0; 3], fov) + "[[object]]" + objects
    };
    // Half of the back wall: as far from the camera as the room is deep, the perspective hardly differs.
    let fov = |distance: f64| 2.0 * (0.5f64 / distance).atan().to_degrees();
    let (near, far) = (1e3, 1e6);
    let [a, b] = [near, far].map(|distance| picture(&seen_from(distance, fov(distance)), 1));
    let noise = difference(&a, &picture(&seen_from(near, fov(near)), 2));
    let changed = difference(&a, &b);
    assert!(changed < noise, "{changed}, with a noise of {noise}");
}

/// A box of glass that stands on a floor touches it, and nothing else, however wide the floor is.
#[test]
fn glass_stands_on_a_floor_of_any_size_alike() {
    let face = |name: &str, corner: [f64; 3], u: [f64; 3], v: [f64; 3]| quad(name, [corner, u, v], "glass");
    let (x, y, z) = ([0.8, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 0.8]);
    let cube = [
        face("bottom", [-0.4, 0.1, -0.4], x, z),
        face("top", [-0.4, 0.6, -0.4], z, x),
        face("left", [-0.4, 0.1, -0.4], z, y),
        face("right", [0.4, 0.1, -0.4], y, z),
        face("back", [-0.4, 0.1, -0.4], y, x),
        face("front", [-0.4, 0.1, 0.4], x, y),
    ]
    .concat();
    let on_floor = |half: f64, seed: u64| {
        let floor = quad("floor", [[-half, 0.1, half], [2.0 * half, 0.0, 0.0], [0.0, 0.0, -2.0 * half]], "grey");
        let head = camera([0.3, 2.0, 3.0], [0.0, 0.3, 0.0], 25.0) + &lamp([0.5, 3.0, 0.5]);
        picture(&[head, cube.clone(), floor].concat(), seed)
    };
    let image = on_floor(20.0, 1);
    let noise = difference(&image, &on_floor(20.0, 2));
    for half in [1e5, 5e8] {
        let changed = difference(&image, &on_floor(half, 1));
        assert!(changed < noise, "{half:e}: {changed}, with a noise of {noise}");
    }
}
