//! Objects, lamps and cameras far away: the right values do not know of the distance.

use crate::oracle;
use crate::suite::{
    Case, Expected, Tolerance, blocks, camera, diffuse, glass, lamp, light, mean, object, picture, point_light, quad,
    quad_light, render_limits, sphere, sphere_light,
};
use std::f64::consts::PI;

const IMAGE: (u64, &str) = (16, "iterations");

pub(crate) fn cases() -> Vec<Case> {
    [wide_grounds(), wide_lamps(), far_objects(), far_lamps(), far_cameras(), suns()].into_iter().flatten().collect()
}

/// A lamp 1 above a floor lights a point 0.4 beside its foot with `1 / (1 + 0.4^2)^(3/2)`, however wide the floor is.
fn wide_grounds() -> Vec<Case> {
    let case = |half: f64| {
        let floor = quad("floor", [[-half, 0.0, half], [2.0 * half, 0.0, 0.0], [0.0, 0.0, -2.0 * half]], "grey");
        let text = camera([0.4, 2.0, 0.0], [0.4, 0.0, 0.001], 0.02, 8)
            + &diffuse("grey", 0.5)
            + &lamp([0.0, 1.0, 0.0])
            + &floor;
        let expected = 0.5 / PI * 1.16f64.powf(-1.5);
        let name = format!("lamp 1 above a floor of half width {half:e}");
        Case::noisy(name, "field 13", expected, Tolerance::Relative(1e-3), (4, "iterations"), move |round| {
            mean(&picture(&text, 4, round))
        })
    };
    [5.0, 50.0, 1.5e4, 5e8].into_iter().map(case).collect()
}

/// C3: the ground under the middle of a square lamp receives `pi L F`, and beside a black square just below the lamp the rest.
fn wide_lamps() -> Vec<Case> {
    // Of a square with this half side at this height, seen from below its middle.
    let form_factor = |half: f64, height: f64| {
        let slope = half / half.hypot(height);
        4.0 / PI * slope * slope.atan()
    };
    let case = |(half, square): (f64, bool)| {
        let black = quad("square", [[-4.0, 1.999, -4.0], [8.0, 0.0, 0.0], [0.0, 0.0, 8.0]], "black");
        let floor = quad("floor", [[-1.0, 0.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]], "grey");
        let text = camera([0.4, 0.3, 0.0], [0.0; 3], 0.02, 8)
            + &diffuse("grey", 0.5)
            + &diffuse("black", 0.0)
            + &quad_light([[-half, 2.0, -half], [2.0 * half, 0.0, 0.0], [0.0, 0.0, 2.0 * half]], 1.0)
            + &floor
            + if square { &black } else { "" };
        let hidden = if square { form_factor(4.0, 1.999) } else { 0.0 };
        let name = format!("{}lamp of half width {half:e}", if square { "black square before a " } else { "" });
        let expected = 0.5 * (form_factor(half, 2.0) - hidden);
        Case::noisy(name, "C3", expected, Tolerance::Relative(1e-3), (16, "iterations"), move |round| {
            mean(&picture(&text, 16, round))
        })
    };
    let open = [1.0, 1e3, 1e6, 1e8].map(|half| (half, false));
    let hidden = [1e3, 1e6, 1e8].map(|half| (half, true));
    open.into_iter().chain(hidden).map(case).collect()
}

/// A diffuse room under a point light, open to the camera.
fn room() -> String {
    [
        camera([0.0, 0.0, 3.8], [0.0, -0.2, 0.0], 40.0, 16),
        render_limits(8, 0.0),
        diffuse("grey", 0.5),
        diffuse("black", 0.0),
        glass("glass", 1.5, 0.0),
        quad("floor", [[-1.0, -1.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]], "grey"),
        quad("back", [[-1.0, -1.0, -1.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]], "grey"),
        quad("left", [[-1.0, -1.0, 1.0], [0.0, 0.0, -2.0], [0.0, 2.0, 0.0]], "grey"),
        sphere("ball", [0.3, -0.6, 0.0], 0.4, "grey"),
        point_light([0.1, 0.7, 0.2], 1.0),
    ]
    .concat()
}

/// Far objects that neither light, shade nor show: the oracle renders the room alone.
fn far_objects() -> Vec<Case> {
    let plane = object("far", "plane", "black", "point = [0, -1e9, 0]\nnormal = [0, 1, 0]");
    let objects = [
        ("no far object", String::new()),
        ("a black ball at 1e5", sphere("far", [0.0, 1e5, 0.0], 0.1, "black")),
        ("a grey ball at 1e9", sphere("far", [0.0, 1e9, 0.0], 10.0, "grey")),
        ("a glass ball at 1e7", sphere("far", [1e7, 0.0, 0.0], 10.0, "glass")),
        ("a black sphere of radius 1e3 around", sphere("far", [0.0; 3], 1e3, "black")),
        ("a grey sphere of radius 1e9 around", sphere("far", [0.0; 3], 1e9, "grey")),
        ("a plane at -1e9", plane),
    ];
    let case = |(name, far): (&str, String)| {
        let text = room() + &far;
        let expected = Expected::Sampled(Box::new(|round| oracle::blocks(&room(), 4, 128, round)));
        let got = move |round| blocks(&picture(&text, 16, round), 4);
        Case::values(format!("room with {name}"), "field 13", expected, Tolerance::Relative(1e-2), IMAGE, got)
    };
    objects.into_iter().map(case).collect()
}

/// A lamp that always appears 11 degrees wide.
fn far_lamps() -> Vec<Case> {
    let case = |distance: f64| {
        let center = [0.3, 0.8, 0.52].map(|x: f64| x * distance);
        let text = [
            camera([0.0, 1.6, 3.2], [0.0; 3], 40.0, 16),
            render_limits(8, 0.0),
            diffuse("white", 0.8),
            glass("glass", 1.5, 0.0),
            quad("ground", [[-2.0, 0.0, 2.0], [4.0, 0.0, 0.0], [0.0, 0.0, -4.0]], "white"),
            quad("wall", [[-1.0, 0.0, -1.0], [2.0, 0.0, 0.0], [0.0, 1.5, 0.0]], "white"),
            sphere("ball", [0.0, 0.5, 0.0], 0.4, "glass"),
            sphere_light(center, 0.1 * distance, 30.0),
        ]
        .concat();
        let by_oracle = text.clone();
        let expected = Expected::Sampled(Box::new(move |round| oracle::blocks(&by_oracle, 4, 256, round)));
        let got = move |round| blocks(&picture(&text, 16, round), 4);
        Case::values(format!("lamp {distance:e} away"), "field 8, 14", expected, Tolerance::Relative(1e-2), IMAGE, got)
    };
    [30.0, 5e3, 5e5].into_iter().map(case).collect()
}

/// The foot of a lamp 2 above the ground, seen from far away through a narrow film.
fn far_cameras() -> Vec<Case> {
    let case = |distance: f64| {
        let text = [
            camera([0.6 * distance, 0.8 * distance, 0.0], [0.0; 3], (0.01 / distance).to_degrees(), 8),
            diffuse("white", 1.0),
            object("ground", "plane", "white", "point = [0, 0, 0]\nnormal = [0, 1, 0]"),
            point_light([0.0, 2.0, 0.0], 3.0),
        ]
        .concat();
        let name = format!("camera {distance:e} away");
        Case::noisy(name, "C3", 3.0 / PI / 4.0, Tolerance::Relative(1e-3), (4, "iterations"), move |round| {
            mean(&picture(&text, 4, round))
        })
    };
    [1e1, 1e3, 1e6].into_iter().map(case).collect()
}

/// A sun's irradiance by the cosine, on the ground and through a plate of glass above everything.
fn suns() -> Vec<Case> {
    let scene = |diameter: f64, above: &str| {
        let sun = format!("direction = [3, -4, 0]\nirradiance = [2, 2, 2]\ndiameter = {diameter:?}");
        [
            &camera([0.0, 1.0, 0.0], [0.1, 0.0, 0.0], 60.0, 8),
            &diffuse("grey", 0.5),
            &glass("glass", 1.5, 0.0),
            &object("ground", "plane", "grey", "point = [0, 0, 0]\nnormal = [0, 1, 0]"),
            &light("sun", "sun", &sun),
            above,
        ]
        .concat()
    };
    let pane = object("top", "plane", "glass", "point = [0, 1e4, 0]\nnormal = [0, 1, 0]")
        + &object("bottom", "plane", "glass", "point = [0, 9999, 0]\nnormal = [0, -1, 0]");
    let once = oracle::reflectance(0.8, 1.0, 1.5);
    let through = (1.0 - once) / (1.0 + once);
    [(0.0, "", 1.0), (0.53, "", 1.0), (0.0, &pane, through)]
        .into_iter()
        .map(|(diameter, above, transmitted)| {
            let text = scene(diameter, above);
            let what = if above.is_empty() { "on the ground" } else { "through a pane at 1e4" };
            let name = format!("sun of {diameter} degrees {what}");
            let expected = 2.0 * 0.8 * 0.5 / PI * transmitted;
            Case::noisy(name, "field 8", expected, Tolerance::Relative(2e-3), IMAGE, move |round| {
                mean(&picture(&text, 16, round))
            })
        })
        .collect()
}
