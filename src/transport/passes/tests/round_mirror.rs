//! A round mirror, half a cylinder of radius 1 about the z axis that opens to -x, on the floor z = 0.

use super::caustics::{Caustics, Rectangle};
use crate::transport::testing::{lamp, object, quad};
use glam::DVec2;
use std::f64::consts::PI;

const REFLECTANCE: f64 = 0.8;
const HEIGHT: f64 = 0.5;
/// Patches of the mirror: each deviates from the cylinder by 1e-9, and its curvature by some 1e-5.
const PATCHES: usize = 16;

fn bent_mirror() -> String {
    let angle = PI / PATCHES as f64;
    let reach = 4.0 / 3.0 * (0.25 * angle).tan();
    let patch = |k: usize| -> [[[f64; 3]; 4]; 4] {
        let [a, b] = [k, k + 1].map(|k| DVec2::from_angle(k as f64 * angle - 0.5 * PI));
        let arc = [a, a + reach * a.perp(), b - reach * b.perp(), b];
        std::array::from_fn(|i| std::array::from_fn(|j| [arc[i].x, arc[i].y, HEIGHT * j as f64 / 3.0]))
    };
    let patches: [_; PATCHES] = std::array::from_fn(patch);
    object("bent mirror", "bezier", "mirror", &format!("patches = {patches:?}"))
}

/// Light that shines into the mirror.
enum Source {
    /// A lamp of intensity 1 over this place of the floor, at this height.
    Lamp(DVec2, f64),
    /// Parallel rays of irradiance 1 towards +x, which fall by this much for a unit of x.
    Sun(f64),
}

impl Source {
    fn text(&self) -> String {
        match self {
            Self::Lamp(at, height) => lamp([at.x, at.y, *height]),
            Self::Sun(fall) => format!(
                "[[light]]\nname = \"sun\"\ntype = \"sun\"\ndirection = [1, 0, {}]\nirradiance = [1, 1, 1]\ndiameter = 0\n",
                -fall
            ),
        }
    }

    /// The mean irradiance of a square of the floor after one reflection. Seen from above, light that meets the mirror at the angle `phi` goes
    /// on along a straight line, as in the plane; how far says the height at which it met the mirror. So the flux of `dphi` between two
    /// distances has a closed form, and the mean over the square is an integral over `phi`.
    fn irradiance(&self, middle: DVec2, side: f64) -> f64 {
        let steps = 40_000;
        let step = PI / f64::from(steps);
        let of_step = |k: i32| {
            let p = DVec2::from_angle((f64::from(k) + 0.5) * step - 0.5 * PI);
            let (from_source, longest) = match self {
                Self::Lamp(place, height) => (p - place, p.distance(*place) * HEIGHT / (height - HEIGHT)),
                Self::Sun(fall) => (DVec2::X, HEIGHT / fall),
            };
            let incoming = from_source.normalize();
            let cos = incoming.dot(p);
            let reflected = incoming - 2.0 * cos * p;
            let [a, b] = [-0.5, 0.5].map(|half| (middle + half * side - p) / reflected);
            let (start, end) = (a.min(b).max_element().max(0.0), a.max(b).min_element().min(longest));
            if end <= start || cos <= 0.0 {
                return 0.0;
            }
            match self {
                Self::Lamp(_, height) => {
                    let distance = from_source.length();
                    let sine_of_elevation = |along: f64| height / (distance + along).hypot(*height);
                    (sine_of_elevation(start) - sine_of_elevation(end)) * cos / distance
                }
                Self::Sun(fall) => fall / fall.hypot(1.0) * cos * (end - start),
            }
        };
        REFLECTANCE * (0..steps).map(of_step).sum::<f64>() * step / (side * side)
    }
}

/// On a grid of squares within the mirror, on the caustic and beside it.
fn assert_lights_the_floor(source: &Source) {
    let floor = quad("floor", [[-2.0, -2.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]], "grey");
    let caustics = Caustics::new(&[floor, bent_mirror(), source.text()].concat(), 320, 8);
    let (mut all_found, mut all_expected, side) = (0.0, 0.0, 0.04);
    let grid = (0..100).map(|k| DVec2::new(0.09 * f64::from(k % 10) - 0.06, 0.12 * f64::from(k / 10) - 0.5));
    for middle in grid.filter(|middle| middle.length() < 0.93) {
        let expected = source.irradiance(middle, side);
        let found = caustics.irradiance(&Rectangle::on_floor(middle, side), 1);
        // The caustic's edge, where it cuts a square, is as sharp as a pixel.
        assert!((found - expected).abs() < 0.01 * expected + 0.004, "{found} instead of {expected} at {middle}");
        all_found += found;
        all_expected += expected;
    }
    assert!((all_found / all_expected - 1.0).abs() < 1e-3, "{all_found} instead of {all_expected} in all");
}

#[test]
fn a_lamp_over_the_rim_makes_a_cardioid() {
    assert_lights_the_floor(&Source::Lamp(DVec2::NEG_X, 0.8));
}

#[test]
fn parallel_rays_make_a_nephroid() {
    assert_lights_the_floor(&Source::Sun(0.5));
}
