//! Lamps from which the scene appears small: photons of caustics and of interreflection aim at it.

use crate::support::{advanced, assert_near, mean, object, quad, scene, sphere};
use patchlight::engine::Session;
use patchlight::transport::Component;
use std::f64::consts::PI;

/// The mean of one component of the picture of two walls and a glass ball on the ground, lit from this distance with the same irradiance.
fn lit_from(distance: f64, ground: &str, component: Component) -> f64 {
    let direction = [0.36, 0.8, 0.48].map(|x: f64| x * distance);
    let intensity = [3.0 * distance * distance; 3];
    let lamp =
        format!("[[light]]\nname = \"l\"\ntype = \"point\"\nposition = {direction:?}\nintensity = {intensity:?}\n");
    lit_by(&lamp, ground, component)
}

/// The mean of one component of that picture, lit by this lamp.
fn lit_by(lamp: &str, ground: &str, component: Component) -> f64 {
    let head = "[camera]\nposition = [0, 1.6, 3.2]\ntarget = [0, 0, 0]\nfov_y = 40\n[film]\nwidth = 32\nheight = 32
        [[material]]\nname = \"white\"\ntype = \"diffuse\"\nalbedo = [0.8, 0.8, 0.8]
        [[material]]\nname = \"g\"\ntype = \"glass\"\nior = 1.5\n";
    let wall = quad("wall", [[-1.0, 0.0, -1.0], [2.0, 0.0, 0.0], [0.0, 1.5, 0.0]], "white");
    let text = [head, lamp, ground, &wall, &sphere("ball", [0.0, 0.4, 0.0], 0.3, "g")].concat();
    let session = Session::prepare(&scene(&text), 1, None).expect("the scene can be prepared");
    mean(&advanced(session.only(Some(component)), 24).film().image())
}

/// A lamp that appears equally wide from any distance: far lamps are wider than the scene, and of their rays one in millions goes there.
#[test]
fn the_distance_of_a_wide_lamp_does_not_matter() {
    let ground = quad("ground", [[-2.0, 0.0, 2.0], [4.0, 0.0, 0.0], [0.0, 0.0, -4.0]], "white");
    let sphere = |distance: f64, half_angle: f64| {
        let (center, sine) = ([0.36, 0.8, 0.48].map(|x: f64| x * distance), half_angle.to_radians().sin());
        let (radius, radiance) = (sine * distance, [1.0 / (sine * sine); 3]);
        format!(
            "[[light]]\nname = \"l\"\ntype = \"sphere\"\ncenter = {center:?}\nradius = {radius}\nradiance = {radiance:?}\n"
        )
    };
    let square = |distance: f64| {
        let (corner, u, v) = ([-0.5 * distance, distance, -0.5 * distance], [distance, 0.0, 0.0], [0.0, 0.0, distance]);
        format!(
            "[[light]]\nname = \"l\"\ntype = \"quad\"\ncorner = {corner:?}\nedge_u = {u:?}\nedge_v = {v:?}\nradiance = [4, 4, 4]\n"
        )
    };
    let lamps: [&dyn Fn(f64) -> String; 3] = [&|d| sphere(d, 0.05), &|d| sphere(d, 5.0), &square];
    for lamp in lamps {
        for component in [Component::Caustics, Component::Interreflection] {
            let near = lit_by(&lamp(400.0), &ground, component);
            assert!(near > 5e-3, "{component:?}: {near}");
            for distance in [1e4, 1e7] {
                let far = lit_by(&lamp(distance), &ground, component);
                assert_near(far, near, 0.08, &format!("{component:?}, {}", lamp(distance)));
            }
        }
    }
}

#[test]
fn the_distance_of_a_lamp_does_not_matter() {
    let square = quad("ground", [[-2.0, 0.0, 2.0], [4.0, 0.0, 0.0], [0.0, 0.0, -4.0]], "white");
    let plane = object("ground", "plane", "white", "point = [0, 0, 0]\nnormal = [0, 1, 0]");
    // Too large to get a share of the photons.
    let in_a_sphere = square.clone() + &sphere("around", [0.0; 3], 1e9, "white");
    let wide = quad("ground", [[-1e4, 0.0, 1e4], [2e4, 0.0, 0.0], [0.0, 0.0, -2e4]], "white");
    for ground in [square, plane, in_a_sphere, wide] {
        for component in [Component::Caustics, Component::Interreflection] {
            let near = lit_from(40.0, &ground, component);
            assert!(near > 1e-3, "{component:?}: {near}");
            for distance in [400.0, 5e3, 5e5] {
                // From 40 units the rays diverge by a degree or two, which moves light by a few hundredths.
                assert_near(lit_from(distance, &ground, component), near, 0.06, &format!("{component:?}, {ground}"));
            }
        }
    }
}

/// A lamp of radius 0.02 above a ball of 0.01: most rays from the lamp into the cone of both would miss the ball.
#[test]
fn a_ball_smaller_than_the_lamp_has_a_caustic() {
    let caustic = |lamp: &str| {
        let head =
            "[camera]\nposition = [0, 0.08, 0.12]\ntarget = [0, 0.01, 0]\nfov_y = 35\n[film]\nwidth = 32\nheight = 32
            [[material]]\nname = \"white\"\ntype = \"diffuse\"\nalbedo = [0.7, 0.7, 0.7]
            [[material]]\nname = \"g\"\ntype = \"glass\"\nior = 1.5\n";
        let ground = quad("ground", [[-2.0, 0.0, 2.0], [4.0, 0.0, 0.0], [0.0, 0.0, -4.0]], "white");
        let text = [head, lamp, &ground, &sphere("ball", [0.0, 0.02, 0.0], 0.01, "g")].concat();
        let session = Session::prepare(&scene(&text), 1, None).expect("the scene can be prepared");
        mean(&advanced(session.only(Some(Component::Caustics)), 48).film().image())
    };
    let point = caustic("[[light]]\nname = \"l\"\ntype = \"point\"\nposition = [0.3, 3, 0]\nintensity = [9, 9, 9]\n");
    for radius in [0.02, 0.05f64] {
        let radiance = 9.0 / (PI * radius * radius);
        let sphere = caustic(&format!(
            "[[light]]\nname = \"l\"\ntype = \"sphere\"\ncenter = [0.3, 3, 0]\nradius = {radius}
            radiance = [{radiance}, {radiance}, {radiance}]\n"
        ));
        // One path of ten to thirty meets the ball, which leaves a few hundredths of noise.
        assert_near(sphere, point, 0.1, &format!("a lamp of radius {radius}"));
    }
}

/// A ball of 0.003 beside a large pane has its caustic: it gets a share of the paths, although the pane fills most of the directions.
#[test]
fn a_tiny_ball_beside_a_pane_has_a_caustic() {
    let head =
        "[camera]\nposition = [0.05, 0.02, 0.05]\ntarget = [0, 0, 0]\nfov_y = 12\n[film]\nwidth = 32\nheight = 32
        [[material]]\nname = \"white\"\ntype = \"diffuse\"\nalbedo = [0.8, 0.8, 0.8]
        [[material]]\nname = \"g\"\ntype = \"glass\"\nior = 1.5
        [[light]]\nname = \"l\"\ntype = \"point\"\nposition = [0, 2, 0]\nintensity = [1, 1, 1]\n";
    let pane = quad("pane", [[0.3, 0.5, -2.0], [0.0, 0.0, 4.0], [2.0, 0.0, 0.0]], "g");
    let ground = quad("ground", [[-2.0, 0.0, 2.0], [4.0, 0.0, 0.0], [0.0, 0.0, -4.0]], "white");
    let text = [head, &pane, &ground, &sphere("ball", [0.0, 0.005, 0.0], 0.003, "g")].concat();
    let session = Session::prepare(&scene(&text), 1, None).expect("the scene can be prepared");
    let session = advanced(session.only(Some(Component::Caustics)), 8);
    assert!(session.stats().counters.splats > 100, "{} photons in view", session.stats().counters.splats);
    let image = session.film().image();
    let brightest = image.pixels.iter().map(|pixel| pixel.y).fold(0.0, f32::max);
    // The ball focuses the light of its cross-section; direct light is 0.8 / (4 pi).
    assert!(brightest > 0.15, "{brightest}");
}

/// The same under a sun, whose rays to a ball of 0.001 cross the plane before the scene in a disc that is ten times as wide as the ball.
#[test]
fn a_tiny_ball_beside_a_pane_has_a_caustic_under_a_sun() {
    let caustics = |pane: &str| {
        let head =
            "[camera]\nposition = [0, 0.008, 0.012]\ntarget = [0, 0.001, 0]\nfov_y = 35\n[film]\nwidth = 32\nheight = 32
            [[material]]\nname = \"white\"\ntype = \"diffuse\"\nalbedo = [0.7, 0.7, 0.7]
            [[material]]\nname = \"g\"\ntype = \"glass\"\nior = 1.5
            [[light]]\nname = \"s\"\ntype = \"sun\"\ndirection = [-0.1, -1, 0]\nirradiance = [3, 3, 3]\n";
        let ground = object("ground", "plane", "white", "point = [0, 0, 0]\nnormal = [0, 1, 0]");
        let text = [head, &ground, &sphere("ball", [0.0, 0.002, 0.0], 0.001, "g"), pane].concat();
        let session = Session::prepare(&scene(&text), 1, None).expect("the scene can be prepared");
        mean(&advanced(session.only(Some(Component::Caustics)), 24).film().image())
    };
    // Beside the light's way to the view, and edge-on to it, so that it mirrors nothing there.
    let pane = quad("pane", [[2.0, 0.1, -2.0], [0.0, 0.0, 4.0], [0.0, 3.9, 0.0]], "g");
    let alone = caustics("");
    assert!(alone > 5e-3, "{alone}");
    assert_near(caustics(&pane), alone, 0.05, "beside a pane");
}

/// Fresnel reflectance of unpolarized light between air and glass.
fn reflectance(cos: f64, ior: f64) -> f64 {
    let cos_inside = (1.0 - (1.0 - cos * cos) / (ior * ior)).sqrt();
    let across = (cos - ior * cos_inside) / (cos + ior * cos_inside);
    let along = (ior * cos - cos_inside) / (ior * cos + cos_inside);
    0.5 * (across * across + along * along)
}

/// A view of 0.07 under panes 1700 times as wide: of the light that meets the glass, hardly any comes into view. `m` sheets between `2 m` faces
/// transmit `(1 - R) / (1 + (2 m - 1) R)` with all reflections between the faces.
#[test]
fn sunlight_comes_through_windows_far_wider_than_the_view() {
    for cos in [1.0, 0.5f64.sqrt()] {
        let direction = [(1.0 - cos * cos).sqrt(), -cos, 0.0];
        let head = format!(
            "[camera]\nposition = [0, 0.2, 0.01]\ntarget = [0, 0, 0]\nfov_y = 20\n[film]\nwidth = 16\nheight = 16
            [render]\nmax_bounces = 64
            [[material]]\nname = \"grey\"\ntype = \"diffuse\"\nalbedo = [0.5, 0.5, 0.5]
            [[material]]\nname = \"g\"\ntype = \"glass\"\nior = 1.5
            [[light]]\nname = \"s\"\ntype = \"sun\"\ndirection = {direction:?}\nirradiance = [3, 3, 3]\n"
        );
        let face = |name: &str, y: f64, side: f64| {
            quad(name, [[-60.0, y, 60.0 * side], [120.0, 0.0, 0.0], [0.0, 0.0, -120.0 * side]], "g")
        };
        let pane = |name: &str, y: f64| {
            let faces = [face(&format!("{name} below"), y, -1.0), face(&format!("{name} above"), y + 0.05, 1.0)];
            faces.map(|face| format!("{face}body = \"{name}\"\n")).concat()
        };
        let floor = quad("floor", [[-3.0, 0.0, 3.0], [6.0, 0.0, 0.0], [0.0, 0.0, -6.0]], "grey");
        let text = [&head, &pane("near", 0.5), &pane("far", 0.7), &floor].map(String::as_str).concat();
        let session = Session::prepare(&scene(&text), 1, None).expect("the scene can be prepared");
        let found = mean(&advanced(session.only(Some(Component::Caustics)), 64).film().image());
        let lost = reflectance(cos, 1.5);
        let expected = 0.5 * 3.0 / PI * cos * (1.0 - lost) / (1.0 + 3.0 * lost);
        assert_near(found, expected, 0.03, &format!("light at a cosine of {cos}"));
    }
}

/// The same from below a surface of water that absorbs light.
#[test]
fn sunlight_comes_through_water_without_an_end() {
    let head = "[camera]\nposition = [0, -0.5, 0.01]\ntarget = [0, -1, 0]\nfov_y = 20\n[film]\nwidth = 16\nheight = 16
        [[material]]\nname = \"grey\"\ntype = \"diffuse\"\nalbedo = [0.5, 0.5, 0.5]
        [[material]]\nname = \"w\"\ntype = \"glass\"\nior = 1.33\nabsorption = [0.5, 0.5, 0.5]
        [[light]]\nname = \"s\"\ntype = \"sun\"\ndirection = [1, -1, 0]\nirradiance = [3, 3, 3]\n";
    let water = object("water", "plane", "w", "point = [0, 0, 0]\nnormal = [0, 1, 0]");
    let floor = quad("floor", [[-30.0, -1.0, 30.0], [60.0, 0.0, 0.0], [0.0, 0.0, -60.0]], "grey");
    let text = [head, &water, &floor].concat();
    let session = Session::prepare(&scene(&text), 1, None).expect("the scene can be prepared");
    let found = mean(&advanced(session.only(Some(Component::Caustics)), 64).film().image());
    let cos = 0.5f64.sqrt();
    let cos_inside = (1.0 - 0.5 / (1.33f64 * 1.33)).sqrt();
    // Down through the water, and half way up to the camera.
    let kept = (1.0 - reflectance(cos, 1.33)) * f64::exp(-0.5 * (1.0 / cos_inside + 0.5));
    assert_near(found, 0.5 * 3.0 / PI * cos * kept, 0.03, "light at 45 degrees");
}
