//! Pictures whose radiance is known from a formula.

use crate::support::{assert_near, mean, render};
use std::f64::consts::{PI, TAU};

/// A camera so narrow that its whole film sees one point.
fn narrow_camera(position: [f64; 3], target: [f64; 3]) -> String {
    format!(
        "[camera]\nposition = {position:?}\ntarget = {target:?}\nup = [0.3, 0.9, 0.1]\nfov_y = 0.2\n[film]\nwidth = 8\nheight = 8\n"
    )
}

/// C1: in a closed sphere the indirect irradiance is `Phi rho / (4 pi R^2 (1 - rho))` everywhere, wherever the light is.
#[test]
fn radiance_in_an_integrating_sphere() {
    for light in [[0.0, 0.0, 0.0], [0.5, -0.3, 0.2]] {
        let text = format!(
            "[camera]\nposition = [0.1, 0.0, 0.2]\ntarget = [1.0, 0.3, 0.0]\nfov_y = 90.0\n[film]\nwidth = 24\nheight = 24
            [render]\nmax_bounces = 100
            [[material]]\nname = \"m\"\ntype = \"diffuse\"\nalbedo = [0.5, 0.5, 0.5]
            [[object]]\nname = \"s\"\ntype = \"sphere\"\ncenter = [0,0,0]\nradius = 1.0\nmaterial = \"m\"
            [[light]]\nname = \"l\"\ntype = \"point\"\nposition = {light:?}\nintensity = [1, 1, 1]\n"
        );
        let indirect_only = mean(&render(&text, 16)) - mean(&render(&text.replace("= 100", "= 1"), 16));
        // E = 4 pi / (4 pi) 0.5 / 0.5 = 1, so L = 0.5 / pi. 16 iterations of 16,384 paths, a disc that covers a
        // thousandth of the sphere or more: a standard error of about 0.2 % over the picture.
        assert_near(indirect_only, 0.5 / PI, 0.01, "indirect radiance");
    }
}

/// C3: a point light's irradiance is `I cos / d^2`.
#[test]
fn irradiance_of_a_point_light() {
    for height in [0.5f64, 2.0, 8.0] {
        let text = format!(
            "{}[render]\nmax_bounces = 1
            [[material]]\nname = \"m\"\ntype = \"diffuse\"\nalbedo = [1.0, 0.5, 0.25]
            [[object]]\nname = \"p\"\ntype = \"plane\"\npoint = [0,0,0]\nnormal = [0,1,0]\nmaterial = \"m\"
            [[light]]\nname = \"l\"\ntype = \"point\"\nposition = [0, {height}, 0]\nintensity = [3, 3, 3]\n",
            narrow_camera([4.0, 3.0, 0.0], [1.0, 0.0, 0.0])
        );
        let d2 = 1.0 + height * height;
        let image = render(&text, 4);
        // The film covers 0.005 units of the plane, over which the irradiance changes by up to 2 %, evenly.
        assert_near(mean(&image), 1.75 / 3.0 / PI * 3.0 * (height / d2.sqrt()) / d2, 2e-3, "radiance");
        assert_near(f64::from(image.pixels[20].x / image.pixels[20].z), 4.0, 1e-5, "the albedo's colour");
    }
}

/// The irradiance of a sphere in full view is `pi L (R / d)^2`, that of a rectangle a sum of four angles.
#[test]
fn irradiance_of_area_lights() {
    let under = |light: &str| {
        format!(
            "{}[render]\nmax_bounces = 1
            [[material]]\nname = \"m\"\ntype = \"diffuse\"\nalbedo = [1, 1, 1]
            [[object]]\nname = \"p\"\ntype = \"plane\"\npoint = [0,0,0]\nnormal = [0,1,0]\nmaterial = \"m\"
            [[light]]\nname = \"l\"\nradiance = [2, 2, 2]\n{light}\n",
            narrow_camera([4.0, 3.0, -0.1], [0.0, 0.0, 0.0])
        )
    };
    let sphere = under("type = \"sphere\"\ncenter = [0, 1.5, 0]\nradius = 0.75");
    // 64 samples of 64 pixels, each pixel a scrambled Sobol sequence: well below a percent.
    assert_near(mean(&render(&sphere, 64)), 2.0 * 0.25, 5e-3, "a sphere");
    // edge_u x edge_v points down.
    let quad = under("type = \"quad\"\ncorner = [0, 1, 0]\nedge_u = [1, 0, 0]\nedge_v = [0, 0, 2]");
    let (a, b) = (1.0f64, 2.0f64);
    let (ra, rb) = ((1.0 + a * a).sqrt(), (1.0 + b * b).sqrt());
    let form_factor = (a / ra * (b / ra).atan() + b / rb * (a / rb).atan()) / TAU;
    assert_near(mean(&render(&quad, 64)), 2.0 * form_factor, 5e-3, "a rectangle's corner");
}

/// A narrow view of the ground under the middle of a square lamp of radiance 1, 2 above it, with this half side.
fn under_a_square_lamp(half: f64) -> String {
    let (corner, side) = ([-half, 2.0, -half], 2.0 * half);
    format!(
        "{}[render]\nmax_bounces = 1
        [[material]]\nname = \"m\"\ntype = \"diffuse\"\nalbedo = [0.5, 0.5, 0.5]
        [[object]]\nname = \"p\"\ntype = \"plane\"\npoint = [0,0,0]\nnormal = [0,1,0]\nmaterial = \"m\"
        [[light]]\nname = \"l\"\ntype = \"quad\"\ncorner = {corner:?}\nedge_u = [{side}, 0, 0]\nedge_v = [0, 0, {side}]\nradiance = [1, 1, 1]\n",
        narrow_camera([0.4, 0.3, 0.0], [0.0; 3])
    )
}

/// Under a square lamp, however wide, each pixel is near `albedo L F` with the form factor of the square, and the noise is as small.
#[test]
fn lamps_wider_than_their_distance() {
    for half in [1.0, 50.0, 1e3, 1e6] {
        let slope = half / f64::hypot(half, 2.0);
        let expected = 0.5 * 4.0 / PI * slope * slope.atan();
        let image = render(&under_a_square_lamp(half), 16);
        assert_near(mean(&image), expected, 0.01, &format!("half a side of {half}"));
        for pixel in &image.pixels {
            assert_near(f64::from(pixel.x), expected, 0.15, &format!("a pixel, half a side of {half}"));
        }
    }
}

/// A black square 0.001 below a lamp hides it, however wide the lamp is: what is left comes from beside the square.
#[test]
fn wide_lamps_do_not_shine_through_what_is_near_them() {
    for half in [1e3, 1e6, 1e8] {
        let square = "[[material]]\nname = \"black\"\ntype = \"diffuse\"\nalbedo = [0, 0, 0]
            [[object]]\nname = \"square\"\ntype = \"quad\"\ncorner = [-4, 1.999, -4]\nedge_u = [8, 0, 0]\nedge_v = [0, 0, 8]\nmaterial = \"black\"\n";
        let slope = 4.0 / f64::hypot(4.0, 1.999);
        let hidden = 4.0 / PI * slope * slope.atan();
        assert_near(
            mean(&render(&(under_a_square_lamp(half) + square), 64)),
            0.5 * (1.0 - hidden),
            0.03,
            &format!("half a side of {half}"),
        );
    }
}

/// A lamp in the plane of a ceiling is a part of the ceiling: seen in gloss and by light sampling alike.
#[test]
fn a_lamp_in_a_ceiling_is_seen() {
    let lamp = "[[light]]\nname = \"l\"\ntype = \"quad\"\ncorner = [-1, 2, -1]\nedge_u = [2, 0, 0]\nedge_v = [0, 0, 2]\nradiance = [1, 1, 1]\n";
    let ceiling = "[[material]]\nname = \"white\"\ntype = \"diffuse\"\nalbedo = [0.8, 0.8, 0.8]
        [[object]]\nname = \"ceiling\"\ntype = \"quad\"\ncorner = [-3, 2, -3]\nedge_u = [6, 0, 0]\nedge_v = [0, 0, 6]\nmaterial = \"white\"\n";
    let up = format!("{}{ceiling}{lamp}", narrow_camera([0.1, 0.0, 0.2], [0.0, 2.0, 0.0]));
    assert_near(mean(&render(&up, 4)), 1.0, 1e-6, "the lamp itself");
    let floor = "[[material]]\nname = \"gloss\"\ntype = \"phong\"\nalbedo = [0, 0, 0]\nspecular = [0.9, 0.9, 0.9]\nexponent = 5000
        [[object]]\nname = \"floor\"\ntype = \"quad\"\ncorner = [-3, 0, 3]\nedge_u = [6, 0, 0]\nedge_v = [0, 0, -6]\nmaterial = \"gloss\"\n";
    let text = format!("{}[render]\nmax_bounces = 1\n{floor}{ceiling}{lamp}", narrow_camera([0.0, 1.0, 0.1], [0.0; 3]));
    assert_near(mean(&render(&text, 64)), 0.9, 0.01, "its reflection");
}

/// A mirror-like Phong lobe sees a lamp with the lamp's own radiance, found by direct light and by the lobe's own paths with
/// MIS weights.
#[test]
fn glossy_reflection_of_a_lamp() {
    for exponent in [20.0, 2_000.0, 200_000.0] {
        let text = format!(
            "{}[render]\nmax_bounces = 1
            [[material]]\nname = \"m\"\ntype = \"phong\"\nalbedo = [0, 0, 0]\nspecular = [1, 1, 1]\nexponent = {exponent}
            [[object]]\nname = \"p\"\ntype = \"plane\"\npoint = [0,0,0]\nnormal = [0,1,0]\nmaterial = \"m\"
            [[light]]\nname = \"l\"\nradiance = [2, 2, 2]\ntype = \"sphere\"\ncenter = [0, 10, 0]\nradius = 6\n",
            narrow_camera([0.0, 0.5, 0.0], [0.0, 0.0, 0.0])
        );
        // The lobe about the axis holds 1 - cos^(n+2) of its light within the lamp's half angle, whose sine is 0.6.
        let expected = 2.0 * (1.0 - 0.8f64.powf(exponent + 2.0));
        assert_near(mean(&render(&text, 256)), expected, 0.01, &format!("exponent {exponent}"));
    }
}

fn pool(index: f64, camera: &str, max_bounces: u32) -> String {
    let x = |i: i32| f64::from(i) * 20.0 / 3.0 - 10.0;
    let rows: Vec<_> = (0..4).map(|i| (0..4).map(|j| [x(i), 0.0, x(3 - j)]).collect::<Vec<_>>()).collect();
    format!(
        "{camera}[render]\nmax_bounces = {max_bounces}
        [[material]]\nname = \"water\"\ntype = \"glass\"\nior = {index}
        [[material]]\nname = \"floor\"\ntype = \"diffuse\"\nalbedo = [0.5, 0.5, 0.5]
        [[object]]\nname = \"surface\"\ntype = \"bezier\"\nmaterial = \"water\"\npatches = [{rows:?}]
        [[object]]\nname = \"ground\"\ntype = \"quad\"\nmaterial = \"floor\"\ncorner = [-1.5, -1, 1.5]\nedge_u = [3, 0, 0]\nedge_v = [0, 0, -3]
        [[light]]\nname = \"l\"\ntype = \"point\"\nposition = [0, 1, 0]\nintensity = [1, 1, 1]\n"
    )
}

/// C7: below flat water, a height h under the lamp and a depth d, the irradiance is `T I / (h + d / n)^2`; seen from
/// above at normal incidence the radiance is squeezed by `T / n^2`.
#[test]
fn irradiance_and_radiance_through_flat_water() {
    let n = 1.33f64;
    let transmittance = 4.0 * n / (n + 1.0).powi(2);
    let irradiance = transmittance / (1.0 + 1.0 / n).powi(2);
    let from_above = pool(n, &narrow_camera([0.0, 6.0, 0.0], [0.0, -1.0, 0.0]), 3);
    // Some 3000 of 64 iterations' photons fall on the 0.2 units that the picture covers, over which the irradiance
    // changes by half a percent: well distributed, they leave an error of about 1 %.
    assert_near(
        mean(&render(&wide(&from_above, 2.0), 64)),
        0.5 / PI * irradiance * transmittance / (n * n),
        0.03,
        "from above",
    );
    let from_below = pool(n, &narrow_camera([0.8, -0.2, 0.0], [0.0, -1.0, 0.0]), 2);
    assert_near(mean(&render(&wide(&from_below, 10.0), 64)), 0.5 / PI * irradiance, 0.03, "from below");
}

/// A wider angle of view, for photons to fall in.
fn wide(text: &str, degrees: f64) -> String {
    text.replace("fov_y = 0.2", &format!("fov_y = {degrees}")).replace("up = [0.3, 0.9, 0.1]", "up = [0.3, 0.2, 0.9]")
}

/// O2: glass with the index of air is invisible.
#[test]
fn glass_of_index_one_is_invisible() {
    let camera = narrow_camera([0.0, 6.0, 0.0], [0.2, -1.0, 0.0]);
    let text = wide(&pool(1.0, &camera, 3), 2.0);
    let expected = 0.5 / PI * 2.0 / (4.0f64 + 0.04).powf(1.5);
    assert_near(mean(&render(&text, 64)), expected, 0.03, "through glass of index 1");
}
