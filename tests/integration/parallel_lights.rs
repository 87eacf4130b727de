//! Suns and beams: parallel rays, from far away or from a disc.

use crate::support::{advanced, assert_near, box_of, mean, object, quad, render, scene, session, sphere};
use patchlight::engine::Session;
use patchlight::film::LinearImage;
use patchlight::transport::{Cancel, Component};
use patchlight::world::{prepare, warnings};
use std::f64::consts::PI;

/// The text of a camera that looks down at the origin from this height, with some materials.
fn above(height: f64, fov_y: f64) -> String {
    format!(
        "[camera]\nposition = [0, {height}, 0]\ntarget = [0, 0, 0]\nup = [0, 0, -1]\nfov_y = {fov_y}
        [film]\nwidth = 32\nheight = 32
        [[material]]\nname = \"grey\"\ntype = \"diffuse\"\nalbedo = [0.5, 0.5, 0.5]
        [[material]]\nname = \"glass\"\ntype = \"glass\"\nior = 1.5
        [[material]]\nname = \"mirror\"\ntype = \"mirror\"\nreflectance = [1, 1, 1]\n"
    )
}

fn ground() -> String {
    object("ground", "plane", "grey", "point = [0, 0, 0]\nnormal = [0, 1, 0]")
}

fn sun(direction: [f64; 3], irradiance: f64, diameter: f64) -> String {
    format!(
        "[[light]]\nname = \"sun\"\ntype = \"sun\"\ndirection = {direction:?}
        irradiance = [{irradiance}, {irradiance}, {irradiance}]\ndiameter = {diameter}\n"
    )
}

fn beam(center: [f64; 3], direction: [f64; 3], radius: f64, power: f64) -> String {
    format!(
        "[[light]]\nname = \"beam\"\ntype = \"beam\"\ncenter = {center:?}\ndirection = {direction:?}
        radius = {radius}\npower = [{power}, {power}, {power}]\n"
    )
}

/// The picture of one component.
fn only(text: &str, component: Component, iterations: u64) -> LinearImage {
    let session = Session::prepare(&scene(text), 1, None).expect("the scene can be prepared");
    let mut session = session.only(Some(component));
    while session.iterations() < iterations {
        session.advance(Cancel::NEVER).expect("never cancelled");
    }
    session.film().image()
}

/// Fraction of light that goes straight through a plate with two surfaces of glass: Fresnel at normal incidence, all internal reflections.
fn through_a_plate() -> f64 {
    let reflected = (0.5f64 / 2.5).powi(2);
    (1.0 - reflected) / (1.0 + reflected)
}

#[test]
fn a_sun_lights_the_ground_by_the_cosine_everywhere() {
    for (diameter, tolerance) in [(0.0, 1e-5), (0.53, 1e-4), (40.0, 0.01)] {
        let image = render(&[above(1000.0, 60.0), ground(), sun([3.0, -4.0, 0.0], 2.0, diameter)].concat(), 8);
        let expected = 2.0 * 0.8 * 0.5 / PI;
        assert_near(mean(&image), expected, tolerance, "ground");
        let extremes = image
            .pixels
            .iter()
            .map(|p| f64::from(p.y))
            .fold((f64::MAX, 0.0), |(a, b): (f64, f64), x| (a.min(x), b.max(x)));
        assert!(extremes.0 > 0.9 * expected && extremes.1 < 1.1 * expected, "{extremes:?}");
    }
}

/// A ball's shadow takes the disc of the ball away from the light on the ground, penumbra and all.
#[test]
fn the_shadow_of_a_ball_is_as_large_as_its_disc() {
    let black = "[[material]]\nname = \"black\"\ntype = \"diffuse\"\nalbedo = [0, 0, 0]\n";
    let ball = sphere("ball", [3.0, 5.0, 0.0], 1.0, "black");
    for diameter in [0.0, 5.0] {
        let light = sun([-3.0, -5.0, 0.0], PI, diameter);
        let lit = render(&[above(4.0, 90.0), ground(), light.clone()].concat(), 16);
        let shaded = render(&[above(4.0, 90.0), black.to_owned(), ground(), ball.clone(), light].concat(), 16);
        // 64 square units in view; the shadow is as long as the sine of the sun's height says.
        let shadow = PI * 34f64.sqrt() / 5.0;
        assert_near(64.0 * (1.0 - mean(&shaded) / mean(&lit)), shadow, 0.02, "area of the shadow");
    }
}

#[test]
fn a_sun_shines_through_glass_above_everything() {
    let pane = |y: f64, up: f64| {
        object(&format!("pane {y}"), "plane", "glass", &format!("point = [0, {y}, 0]\nnormal = [0, {up}, 0]"))
    };
    let text =
        [above(1.0, 60.0), ground(), pane(50.0, 1.0), pane(49.0, -1.0), sun([0.0, -1.0, 0.0], 2.0, 0.0)].concat();
    let image = only(&text, Component::Caustics, 16);
    assert_near(mean(&image), 2.0 * 0.5 / PI * through_a_plate(), 0.02, "under the pane");
    assert_eq!(mean(&only(&text, Component::Direct, 4)), 0.0, "light through glass is a caustic");
}

/// A sun is in no body, wherever the bodies are.
#[test]
fn no_warning_names_a_sun() {
    let ball = sphere("ball", [0.0; 3], 2.0, "glass");
    let file = scene(&[above(5.0, 40.0), ball, sun([0.2, -1.0, 0.1], 1.0, 0.53)].concat());
    assert_eq!(warnings(&file.scene, &prepare(&file.scene, &file.location, None).unwrap()), []);
}

#[test]
fn a_roof_keeps_a_sun_out() {
    let roof = object("roof", "plane", "grey", "point = [0, 50, 0]\nnormal = [0, -1, 0]");
    let ball = sphere("ball", [0.0, 0.3, 0.0], 0.3, "glass");
    let text = [above(1.0, 60.0), ground(), roof, ball, sun([0.2, -1.0, 0.0], 2.0, 0.53)].concat();
    assert_eq!(mean(&render(&text, 8)), 0.0);
}

/// A sun is the limit of a far lamp: caustics of a ball of glass and interreflection between ball, ground and wall.
/// A beam of radius 0.3 down through a box of glass that the camera sees before the floor. All powers of the reflectance of two faces add up.
#[test]
fn a_narrow_beam_comes_through_glass_in_view() {
    let head = "[camera]\nposition = [0, 3, 14]\ntarget = [0, -4, 0]\nfov_y = 60\n[film]\nwidth = 32\nheight = 32
        [render]\nmax_bounces = 12
        [[material]]\nname = \"white\"\ntype = \"diffuse\"\nalbedo = [0.5, 0.5, 0.5]
        [[material]]\nname = \"g\"\ntype = \"glass\"\nior = 1.5
        [[light]]\nname = \"b\"\ntype = \"beam\"\ncenter = [0, 3, 0]\ndirection = [0, -1, 0]\nradius = 0.3\npower = [1, 1, 1]\n";
    let floor = quad("floor", [[-8.0, -10.0, 8.0], [16.0, 0.0, 0.0], [0.0, 0.0, -16.0]], "white");
    let light = |glass: &str, component| {
        let text = [head, &floor, glass].concat();
        let session = Session::prepare(&scene(&text), 1, None).expect("the scene can be prepared");
        mean(&advanced(session.only(Some(component)), 32).film().image())
    };
    let glass = box_of("box", [[-1.0, 0.0, -1.0], [1.0, 0.5, 1.0]], |_| "g");
    let (free, through) = (light("", Component::Direct), light(&glass, Component::Caustics));
    assert!(free > 0.0, "the beam is in view");
    assert_near(through, free * 0.96 / 1.04, 0.08, "light through the box");
}

#[test]
fn a_sun_is_a_far_lamp() {
    let things = [
        quad("floor", [[-1.0, 0.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]], "grey"),
        quad("wall", [[-1.0, 0.0, -1.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]], "grey"),
        sphere("ball", [0.3, 0.5, 0.2], 0.3, "glass"),
    ];
    let distance = 1e4;
    let intensity = 2.0 * distance * distance;
    let lamp = format!(
        "[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = [{}, {}, 0]\nintensity = [{intensity}, {intensity}, {intensity}]\n",
        0.6 * distance,
        0.8 * distance
    );
    let text = |light: &str| [&above(4.0, 40.0), &things.concat(), light].concat();
    for component in [Component::Direct, Component::Caustics, Component::Interreflection] {
        let near = mean(&only(&text(&sun([-0.6, -0.8, 0.0], 2.0, 0.0)), component, 24));
        let far = mean(&only(&text(&lamp), component, 24));
        assert_near(near, far, 0.02, &format!("{component:?}"));
        assert!(far > 1e-4, "{component:?} has light: {far}");
    }
}

#[test]
fn far_objects_take_no_light_of_a_sun_away() {
    let things = [
        quad("floor", [[-2.0, 0.0, 2.0], [4.0, 0.0, 0.0], [0.0, 0.0, -4.0]], "grey"),
        quad("wall", [[-2.0, 0.0, -1.0], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]], "grey"),
    ];
    let light = sun([-0.3, -1.0, -0.4], PI, 0.0);
    let lit = |far: &str| {
        mean(&only(&[&above(4.0, 40.0), &things.concat(), &light, far].concat(), Component::Interreflection, 16))
    };
    let alone = lit("");
    assert!(alone > 0.01, "{alone}");
    for (distance, material) in [(1e3, "grey"), (1e6, "glass"), (1e6, "mirror")] {
        let far = sphere("far", [distance, 0.0, distance], 0.3 * distance, material);
        assert_near(lit(&far), alone, 0.03, &format!("beside {material} at {distance}"));
    }
}

/// No sample meets the beam: the picture is black, but not known to be.
#[test]
fn a_beam_narrower_than_a_pixel_is_not_converged() {
    let text = [above(4.0, 90.0), ground(), beam([0.003, 3.0, 0.002], [0.0, -1.0, 0.0], 1e-4, 2.0)].concat();
    let session = session(&text, 8);
    assert!(!session.reaches(0.05));
    let missing = session.stats().missing_light.expect("light is missing").to_string();
    assert!(missing.contains("camera samples for direct light"), "{missing}");
}

#[test]
fn a_beam_lights_its_disc_alone() {
    let text = [above(4.0, 90.0), ground(), beam([-1.0, 3.0, 0.0], [0.0, -1.0, 0.0], 0.5, 2.0)].concat();
    let image = render(&text, 16);
    // The picture shows 8 x 8 units.
    assert_near(64.0 * mean(&image), 2.0 * 0.5 / PI, 0.02, "all of its power");
    let at = |x: f64, z: f64| {
        let pixel = |along: f64| ((along / 8.0 + 0.5) * 32.0) as usize;
        f64::from(image.pixels[pixel(z) * 32 + pixel(x)].y)
    };
    assert_near(at(-1.01, 0.01), 2.0 / (PI * 0.25) * 0.5 / PI, 1e-3, "in the disc");
    assert_eq!(at(1.0, 0.0), 0.0, "beside it");
}

/// A beam onto a mirror aslant: all of its power arrives on the wall, as a caustic.
#[test]
fn a_mirror_turns_a_beam() {
    let mirror = quad("mirror", [[-2.0, 0.5, 0.5], [0.0, 0.0, -1.0], [1.0, 1.0, 0.0]], "mirror");
    let text = [above(4.0, 90.0), ground(), mirror, beam([0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], 0.1, 2.0)].concat();
    // The four pixels that show the spot are beside the mirror's edge.
    let image = only(&text, Component::Caustics, 16);
    let down = only(
        &[above(4.0, 90.0), ground(), beam([-1.5, 1.0, 0.0], [0.0, -1.0, 0.0], 0.1, 2.0)].concat(),
        Component::Direct,
        64,
    );
    assert!(mean(&image) > 0.0);
    assert_near(mean(&image), mean(&down), 0.05, "the beam turned down");
}

#[test]
fn a_beam_under_water_loses_light_on_its_way() {
    let water = "[[material]]\nname = \"water\"\ntype = \"glass\"\nior = 1.33\nabsorption = [0.5, 0.5, 0.5]\n";
    let surface = object("water", "plane", "water", "point = [0, 3, 0]\nnormal = [0, 1, 0]");
    let text = |with: &str| {
        [&above(1.0, 20.0), water, &ground(), with, &beam([0.0, 2.0, 0.0], [0.0, -1.0, 0.0], 3.0, 1.0)].concat()
    };
    let direct = |text: &str| mean(&session(text, 8).film().image());
    let (dry, wet) = (direct(&text("")), direct(&text(&surface)));
    // Two units from the beam to the ground, one to the camera.
    assert_near(wet / dry, (-0.5f64 * 3.0).exp(), 0.02, "absorbed");
}
