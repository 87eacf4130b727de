//! Lossless bodies before a uniform background of radiance 1 show 1; diffuse and glossy walls never return more light than they get.

use crate::suite::{
    Case, Expected, Tolerance, blocks, box_of, camera, diffuse, glass, improper, light, material, mean, patch_ball,
    picture, point_light, render_limits, sphere,
};
use std::f64::consts::PI;
use std::path::Path;

const IMAGE: (u64, &str) = (16, "iterations");

pub(crate) fn cases() -> Vec<Case> {
    [bodies(), relief(), gloss()].into_iter().flatten().collect()
}

/// A camera and two media before a background of radiance 1.
fn furnace() -> String {
    camera([0.3, 0.4, 5.0], [0.0; 3], 40.0, 16)
        + &render_limits(1000, 1.0)
        + &glass("a", 1.33, 0.0)
        + &glass("b", 1.7, 0.0)
}

/// A case of blocks of 4 x 4 pixels that all are to be 1.
fn even(name: &str, source: &'static str, bodies: &str) -> Case {
    let text = furnace() + bodies;
    let name = format!("furnace: {name}");
    Case::values(name, source, Expected::Value(1.0), Tolerance::Absolute(1e-3), IMAGE, move |round| {
        blocks(&picture(&text, 16, round), 4)
    })
}

/// O3: spheres, boxes and patches, alone, overlapping, in contact, nested.
fn bodies() -> Vec<Case> {
    let ball = |name: &str, x: f64, radius: f64, material: &str| sphere(name, [x, 0.0, 0.0], radius, material);
    let upper = |material: &'static str| box_of("upper", [[-1.0, 0.0, -1.0], [1.0, 0.8, 1.0]], move |_| material);
    let lower = box_of("lower", [[-0.7, -0.9, -1.0], [1.0, 0.0, 0.6]], |_| "a");
    let open_top = |face: &str| if face == "top" { "ripples" } else { "a" };
    let priority = material("first", "glass", "ior = 2\nabsorption = [0, 0, 0]\npriority = 3");
    let air = material("air", "glass", "ior = 1\nabsorption = [0, 0, 0]\npriority = 1");
    let bars = box_of("along", [[-5.0, -0.4, -0.1], [5.0, 0.0, 0.1]], |_| "a")
        + &box_of("across", [[-0.1, 0.0, -5.0], [0.1, 0.4, 4.0]], |_| "b");
    let two_materials = glass("ripples", 1.33, 0.0) + &box_of("box", [[-1.0, -1.0, -1.0], [1.0, 0.4, 1.0]], open_top);
    let named = two_materials.replace("material =", "body = \"pool\"\nmaterial =");
    vec![
        even("sphere", "C5", &ball("ball", 0.0, 1.0, "b")),
        even("box", "O4", &box_of("box", [[-0.8; 3], [0.8; 3]], |_| "b")),
        even("ball of patches", "G4", &patch_ball("ball", [0.0; 3], 1.0, "b", "")),
        even(
            "mirrored ball of patches",
            "O3, field 5",
            &patch_ball("ball", [0.0; 3], 1.0, "b", "transform = { scale = [-1, 1, 1] }\n"),
        ),
        even(
            "flattened, turned ball of patches",
            "O3",
            &patch_ball("ball", [0.0; 3], 1.0, "b", "transform = { scale = [1, -0.3, 1], rotate = [20, 30, 40] }\n"),
        ),
        even("two spheres that overlap", "O3, field 3", &(ball("w", -0.4, 1.0, "a") + &ball("i", 0.6, 1.0, "b"))),
        even("sphere in a sphere", "O3", &(ball("w", 0.0, 1.0, "a") + &ball("i", 0.2, 0.5, "b"))),
        even("equal spheres at one place", "G7", &(ball("w", 0.0, 1.0, "a") + &ball("i", 0.0, 1.0, "b"))),
        even("spheres of one medium that overlap", "O3", &(ball("w", -0.4, 1.0, "a") + &ball("i", 0.6, 1.0, "a"))),
        even(
            "sphere of higher priority around a sphere",
            "O3",
            &(priority + &ball("w", 0.0, 1.2, "first") + &ball("i", 0.1, 0.6, "b")),
        ),
        even("bubble of air", "O3", &(air + &ball("w", 0.0, 1.2, "b") + &ball("i", 0.3, 0.6, "air"))),
        even("boxes that touch", "G7, field 4", &(upper("b") + &lower)),
        even("boxes of one medium that touch", "G7, field 4", &(upper("a") + &lower)),
        even("bars that cross and touch", "G7", &bars),
        even("box whose top has another material", "O3, field 6", &two_materials),
        even("box of several objects of one body", "O3, field 6", &named),
    ]
}

/// A texture of the tests by its absolute path, as a scene names it.
fn texture(name: &str, file: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    format!("[[texture]]\nname = \"{name}\"\nfile = {:?}\nencoding = \"linear\"\n", path.display().to_string())
}

/// E3: relief on glass loses at most 1 % and gains nothing; a lit wall with relief returns no more than a smooth one gets.
fn relief() -> Vec<Case> {
    let bumps = texture("bumps", "tests/data/field/normal.png");
    let map = "normal_map = { texture = \"bumps\", scale = [8, 8], strength = 1 }";
    let glass = material("glass", "glass", &format!("ior = 1.5\nabsorption = [0, 0, 0]\n{map}"));
    let view = camera([0.0, 0.0, 2.8], [0.0; 3], 40.0, 32) + &render_limits(200, 1.0);
    let text = view + &bumps + &glass + &sphere("ball", [0.0; 3], 0.9, "glass");
    let bright = text.clone();
    let walls = material("wall", "diffuse", &format!("albedo = [0.8, 0.8, 0.8]\n{map}"));
    let room = [
        camera([0.1, 0.0, 0.2], [1.0, 0.3, 0.0], 90.0, 16),
        render_limits(400, 0.0),
        bumps,
        walls,
        sphere("room", [0.0; 3], 1.0, "wall"),
        point_light([0.0; 3], 1.0),
    ]
    .concat();
    // A smooth wall shows 0.8 / pi / (1 - 0.8); bumps of up to 35 degrees lose light at each bounce, and may gain none.
    let smooth = 0.8 / PI / 0.2;
    vec![
        Case::noisy(
            "mean of glass with relief, from 0.99 to 1",
            "E3, field 7",
            0.995,
            Tolerance::Absolute(5e-3),
            IMAGE,
            move |round| mean(&picture(&text, 16, round)),
        ),
        Case::faults("pixels of glass with relief above 1", "E3, field 7", (1024, "pixels"), move |round| {
            let image = picture(&bright, 64, round);
            // Weak branches of paths end at random, which leaves noise of some hundredths.
            image.pixels.iter().filter(|pixel| pixel.max_element() > 1.05).count() as u64
        }),
        Case::noisy(
            "wall with relief, from half to all of a smooth one",
            "E3",
            0.75 * smooth,
            Tolerance::Absolute(0.25 * smooth),
            IMAGE,
            move |round| mean(&picture(&room, 16, round)),
        ),
    ]
}

/// E1: a closed room whose walls are glossy absorbs at least what a diffuse room of the same reflectance absorbs.
fn gloss() -> Vec<Case> {
    let mut cases = Vec::new();
    for exponent in [0.0, 5.0, 50.0, 500.0] {
        let phong = format!("albedo = [0.3, 0.3, 0.3]\nspecular = [0.5, 0.5, 0.5]\nexponent = {exponent:?}");
        let room = |wall: &str| {
            [
                &camera([0.1, 0.0, 0.2], [1.0, 0.3, 0.0], 90.0, 16),
                &render_limits(100, 0.0),
                wall,
                &sphere("room", [0.0; 3], 1.0, "wall"),
                &light("lamp", "sphere", "center = [0, -0.4, 0]\nradius = 0.2\nradiance = [1, 1, 1]"),
            ]
            .concat()
        };
        let text = room(&material("wall", "phong", &phong));
        // Lambert's wall of albedo 0.8 is the bound: `rho k / (1 - rho (1 - k))`, k = 0.04.
        let bound = 0.8 * 0.04 / (1.0 - 0.8 * 0.96);
        let name = format!("room of Phong gloss, exponent {exponent}: below the bound of albedo 0.8");
        cases.push(Case::noisy(name, "E1", 0.5 * bound, Tolerance::Absolute(0.5 * bound), IMAGE, move |round| {
            mean(&picture(&text, 16, round))
        }));
    }
    let dim = camera([0.1, 0.0, 0.2], [1.0, 0.3, 0.0], 90.0, 16)
        + &diffuse("wall", 0.5)
        + &sphere("room", [0.0; 3], 1.0, "wall")
        + &point_light([0.5, 0.2, 0.3], 1.0);
    cases.push(Case::faults("improper pixels: integrating sphere", "E5", (256, "pixels"), move |round| {
        improper(&picture(&dim, 16, round))
    }));
    cases
}
