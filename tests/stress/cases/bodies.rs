//! Bodies of glass and area lights against the oracle, block by block.

use crate::oracle;
use crate::suite::{
    Case, Expected, Tolerance, blocks, box_of, camera, diffuse, glass, material, mirror, patch_ball, picture,
    point_light, quad, quad_light, render_limits, sphere, sphere_light,
};

/// Blocks along a side of the film.
const SIDE: u32 = 4;
/// Iterations of a picture.
const ITERATIONS: u64 = 16;

pub(crate) fn cases() -> Vec<Case> {
    [clear_or_absorbing(), lit()].into_iter().flatten().collect()
}

/// A case of the blocks of a scene. A body before a background has no density estimates, whose bias in a room is below 1 %.
fn compared(name: &str, source: &'static str, bias: f64, text: String) -> Case {
    // The oracle takes ten times as long for patches.
    let paths = if text.contains("bezier") { 48 } else { 256 };
    let by_oracle = text.clone();
    let expected = Expected::Sampled(Box::new(move |round| oracle::blocks(&by_oracle, SIDE, paths, round)));
    let got = move |round| blocks(&picture(&text, ITERATIONS, round), SIDE);
    Case::values(
        format!("oracle: {name}"),
        source,
        expected,
        Tolerance::Relative(bias),
        (ITERATIONS, "iterations"),
        got,
    )
}

/// Bodies before a background of radiance 1, with absorption: nothing but paths through interfaces.
fn clear_or_absorbing() -> Vec<Case> {
    let head = |position| {
        camera(position, [0.0; 3], 40.0, 16)
            + &render_limits(200, 1.0)
            + &glass("a", 1.33, 0.4)
            + &glass("b", 1.7, 0.1)
            + &glass("c", 1.5, 1.0)
    };
    let outside = [1.3, 1.6, 4.0];
    let ball = |name: &str, x: f64, radius: f64, material: &str| sphere(name, [x, 0.0, 0.0], radius, material);
    let upper = |material: &'static str| box_of("upper", [[-1.0, 0.0, -1.0], [1.0, 0.8, 1.0]], move |_| material);
    let lower = box_of("lower", [[-0.7, -0.9, -1.0], [1.0, 0.0, 0.6]], |_| "a");
    let top_of_its_own = glass("top", 1.33, 0.4)
        + &box_of("box", [[-1.0, -1.0, -1.0], [1.0, 0.4, 1.0]], |face| if face == "top" { "top" } else { "a" })
            .replace("material =", "body = \"box\"\nmaterial =");
    let air = material("air", "glass", "ior = 1\nabsorption = [0, 0, 0]");
    let first = material("first", "glass", "ior = 1.2\nabsorption = [0.2, 0.2, 0.2]\npriority = 2");
    let reversed = reversed_box("a");
    let scenes = [
        ("absorbing ball", outside, ball("ball", 0.0, 1.0, "c")),
        ("two balls that overlap", outside, ball("w", -0.4, 1.0, "a") + &ball("i", 0.6, 0.8, "b")),
        (
            "three balls that overlap",
            outside,
            ball("w", -0.4, 1.0, "a") + &ball("i", 0.6, 0.8, "b") + &ball("j", 0.2, 0.6, "c"),
        ),
        (
            "ball of higher priority around a ball",
            outside,
            first + &ball("w", 0.0, 1.1, "first") + &ball("i", 0.3, 0.9, "c"),
        ),
        ("nested balls", outside, ball("w", 0.0, 1.2, "a") + &ball("i", 0.2, 0.8, "b") + &ball("j", 0.3, 0.4, "c")),
        ("bubble of air", outside, air + &ball("w", 0.0, 1.2, "c") + &ball("i", 0.2, 0.8, "air")),
        (
            "hollow box with a reversed inner surface",
            outside,
            box_of("box", [[-1.0; 3], [1.0; 3]], |_| "a") + &reversed,
        ),
        ("boxes that touch", outside, upper("c") + &lower),
        ("boxes of one medium that touch", outside, upper("a") + &lower),
        ("box of two materials in one body", outside, top_of_its_own),
        ("ball of patches", outside, patch_ball("ball", [0.0; 3], 1.0, "c", "")),
        (
            "mirrored ellipsoid of patches",
            outside,
            patch_ball(
                "ball",
                [0.2, 0.0, 0.0],
                1.0,
                "c",
                "transform = { scale = [-1, 0.6, 1], rotate = [20, 30, 40] }\n",
            ),
        ),
        ("camera in a ball", [0.2, 0.1, 0.3], ball("ball", 0.0, 1.0, "c")),
        ("camera in the overlap of two balls", [0.1, 0.1, 0.3], ball("w", -0.4, 1.0, "a") + &ball("i", 0.6, 0.8, "b")),
        ("camera in a ball of patches", [0.2, 0.1, 0.3], patch_ball("ball", [0.0; 3], 1.0, "c", "")),
    ];
    scenes.into_iter().map(|(name, position, bodies)| compared(name, "O3", 1e-3, head(position) + &bodies)).collect()
}

/// The faces of a smaller box with normals to its inside.
fn reversed_box(material: &'static str) -> String {
    box_of("inner", [[-0.7; 3], [0.7; 3]], move |_| material)
        .replace("edge_u", "edge_w")
        .replace("edge_v", "edge_u")
        .replace("edge_w", "edge_v")
}

/// A room open to the camera, with walls of albedo 0.6, and the materials of its contents.
fn room(position: [f64; 3], max_bounces: u32) -> String {
    [
        camera(position, [0.0, -0.2, 0.0], 40.0, 16),
        render_limits(max_bounces, 0.0),
        diffuse("wall", 0.6),
        diffuse("dark", 0.2),
        glass("a", 1.33, 0.3),
        glass("b", 1.5, 0.0),
        mirror("mirror", 0.9),
        material("gloss", "phong", "albedo = [0.3, 0.3, 0.3]\nspecular = [0.4, 0.4, 0.4]\nexponent = 20"),
        material("polish", "polished", "albedo = [0.3, 0.3, 0.3]\nreflectance = [0.3, 0.3, 0.3]"),
        quad("floor", [[-1.0, -1.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]], "wall"),
        quad("ceiling", [[-1.0, 1.0, -1.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0]], "wall"),
        quad("back", [[-1.0, -1.0, -1.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]], "wall"),
        quad("left", [[-1.0, -1.0, 1.0], [0.0, 0.0, -2.0], [0.0, 2.0, 0.0]], "dark"),
        quad("right", [[1.0, -1.0, -1.0], [0.0, 0.0, 2.0], [0.0, 2.0, 0.0]], "wall"),
    ]
    .concat()
}

/// Rooms with area lights: direct light, caustics and interreflection together.
fn lit() -> Vec<Case> {
    let above = quad_light([[-0.5, 0.99, -0.5], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]], 2.0);
    let bulb = |center, radius| sphere_light(center, radius, 2.0);
    let position = [0.0, 0.0, 3.8];
    let surface = |y: f64| quad("water", [[-1.0, y, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]], "a");
    let basin_front = quad("front", [[-1.0, -1.0, 1.0], [0.0, 0.7, 0.0], [2.0, 0.0, 0.0]], "wall");
    let ball = |center, radius, material: &str| sphere("ball", center, radius, material);
    let scenes = [
        ("diffuse room under a square lamp", position, 16, above.clone()),
        ("diffuse room, two bounces", position, 2, above.clone()),
        ("diffuse room under a point light", position, 16, point_light([0.1, 0.6, 0.2], 0.5)),
        (
            "diffuse ball in a room with a bulb",
            position,
            16,
            bulb([0.3, 0.5, 0.2], 0.3) + &ball([-0.3, -0.6, 0.0], 0.4, "wall"),
        ),
        ("mirror ball", position, 16, above.clone() + &ball([0.3, -0.5, 0.0], 0.5, "mirror")),
        ("glass ball", position, 16, above.clone() + &ball([0.3, -0.5, 0.0], 0.5, "b")),
        (
            "absorbing glass ball of patches",
            position,
            16,
            above.clone() + &patch_ball("ball", [0.3, -0.45, 0.0], 0.5, "a", ""),
        ),
        ("glossy ball", position, 16, above.clone() + &ball([0.3, -0.5, 0.0], 0.5, "gloss")),
        ("polished ball", position, 16, above.clone() + &ball([0.3, -0.5, 0.0], 0.5, "polish")),
        (
            "box of glass on the floor",
            position,
            16,
            above.clone() + &box_of("box", [[-0.4, -1.0, -0.4], [0.4, -0.4, 0.4]], |_| "a"),
        ),
        ("bulb inside of glass", position, 16, bulb([0.0, 0.0, 0.0], 0.3) + &ball([0.0; 3], 0.6, "a")),
        (
            "bulb in a hollow glass",
            position,
            16,
            bulb([0.0, 0.0, 0.0], 0.2)
                + &material("air", "glass", "ior = 1\nabsorption = [0, 0, 0]")
                + &ball([0.0; 3], 0.6, "a")
                + &sphere("hollow", [0.0; 3], 0.4, "air"),
        ),
        ("water in a basin", [0.0, 0.3, 3.8], 16, above.clone() + &surface(-0.3) + &basin_front),
        ("bulb under water", [0.0, 0.3, 3.8], 16, bulb([0.0, -0.65, 0.0], 0.25) + &surface(-0.3) + &basin_front),
        ("camera under water", [0.0, -0.4, 0.9], 16, above.clone() + &surface(-0.1) + &basin_front),
        (
            "glass ball half under water",
            [0.0, 0.3, 3.8],
            16,
            above.clone() + &surface(-0.3) + &basin_front + &ball([0.2, -0.3, 0.0], 0.4, "b"),
        ),
        ("camera in a glass ball", [0.2, -0.1, 0.5], 16, above + &ball([0.2, -0.1, 0.5], 0.3, "a")),
    ];
    scenes
        .into_iter()
        .map(|(name, position, max_bounces, contents)| {
            compared(name, "C12", 1e-2, room(position, max_bounces) + &contents)
        })
        .collect()
}
