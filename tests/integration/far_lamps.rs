//! Lamps from which the scene appears small: photons of caustics and of interreflection aim at it.

use crate::support::{advanced, assert_near, mean, object, quad, scene, sphere};
use patchlight::engine::Session;
use patchlight::transport::Component;
use std::f64::consts::PI;

/// The mean of one component of the picture of two walls and a glass ball on the ground, lit from this distance with the same irradiance.
fn lit_from(distance: f64, ground: &str, component: Component) -> f64 {
    let direction = [0.36, 0.8, 0.48].map(|x: f64| x * distance);
    let intensity = [3.0 * distance * distance; 3];
    let head = "[camera]\nposition = [0, 1.6, 3.2]\ntarget = [0, 0, 0]\nfov_y = 40\n[film]\nwidth = 32\nheight = 32
        [[material]]\nname = \"white\"\ntype = \"diffuse\"\nalbedo = [0.8, 0.8, 0.8]
        [[material]]\nname = \"g\"\ntype = \"glass\"\nior = 1.5\n";
    let lamp =
        format!("[[light]]\nname = \"l\"\ntype = \"point\"\nposition = {direction:?}\nintensity = {intensity:?}\n");
    let wall = quad("wall", [[-1.0, 0.0, -1.0], [2.0, 0.0, 0.0], [0.0, 1.5, 0.0]], "white");
    let text = [head, &lamp, ground, &wall, &sphere("ball", [0.0, 0.4, 0.0], 0.3, "g")].concat();
    let session = Session::prepare(&scene(&text), 1, None).expect("the scene can be prepared");
    mean(&advanced(session.only(Some(component)), 24).film().image())
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
