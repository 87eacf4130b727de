//! Glass bodies: photons in a closed body of Bezier patches stay on their side, and nested bodies keep all light.

use crate::support::{assert_near, ball, dented_cube, mean, render, sphere};
use glam::DVec3;
use patchlight::geometry::bezier::Patch;
use patchlight::geometry::{Aggregate, Primitive};
use patchlight::math::float::SELF_HIT_OFFSET;
use patchlight::math::{Ray, Sampler, Stream, warp};
use rayon::prelude::*;
use std::sync::Arc;

/// The most surface hits that a photon may have.
const MAX_DEPTH: usize = 32;

/// The surfaces of the cube.
fn body() -> Aggregate {
    Aggregate::new(dented_cube().into_iter().map(|net| Primitive::Patch(Arc::new(Patch::new(net)))).collect())
}

/// Surface hits of photons, and photons that met a surface from the wrong side or left the closed body through no surface.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    met: u64,
    wrong: u64,
}

/// Follows one photon from outside. It is reflected or refracted with equal probability, meets every surface from the side that it
/// is on, and leaves the scene on the outside.
fn follow(body: &Aggregate, index: u64) -> Tally {
    let mut sampler = Sampler::new(5, Stream::Camera, 0, index);
    let from = 4.0 * warp::uniform_sphere(sampler.next_2d());
    let to = warp::uniform_sphere(sampler.next_2d()) * 1.2;
    let mut ray = Ray::new(from, to - from);
    let mut inside = false;
    let mut tally = Tally::default();
    for _ in 0..MAX_DEPTH {
        let Some(hit) = body.closest_hit(&ray) else {
            tally.wrong += u64::from(inside);
            return tally;
        };
        tally.met += 1;
        let (position, normal) = body.primitives()[hit.primitive as usize].surface(&ray, &hit);
        let direction = ray.direction.normalize();
        if (direction.dot(normal) > 0.0) != inside {
            tally.wrong += 1;
            return tally;
        }
        let side = if inside { -normal } else { normal };
        let eta = if inside { 1.0 / 1.5 } else { 1.5 };
        let refracted = refract(direction, side, eta).filter(|_| sampler.next_1d() < 0.5);
        let onward = refracted.unwrap_or_else(|| direction - 2.0 * direction.dot(side) * side);
        inside ^= refracted.is_some();
        let outward = if onward.dot(normal) > 0.0 { normal } else { -normal };
        ray = Ray::new(position + SELF_HIT_OFFSET * position.abs().max_element() * outward, onward);
    }
    tally
}

/// Snell's law with the index of refraction beyond the surface relative to that before it; none for total reflection.
fn refract(direction: DVec3, side: DVec3, eta: f64) -> Option<DVec3> {
    let cos = -direction.dot(side);
    let sin_squared = (1.0 - cos * cos) / (eta * eta);
    (sin_squared < 1.0).then(|| direction / eta + (cos / eta - (1.0 - sin_squared).sqrt()) * side)
}

/// Nested glass without absorption under a uniform background of radiance 1: every path of light arrives with radiance 1.
#[test]
fn nested_glass_before_a_uniform_background_is_invisible() {
    let body = |name: &str, radius: f64, material: &str| ball(name, 0.0, radius, material);
    let text = format!(
        "[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 0]\nfov_y = 40\n[film]\nwidth = 24\nheight = 24
        [render]\nbackground = [1, 1, 1]\nmax_bounces = 60
        [[material]]\nname = \"water\"\ntype = \"glass\"\nior = 1.33
        [[material]]\nname = \"glass\"\ntype = \"glass\"\nior = 1.7
        [[material]]\nname = \"air\"\ntype = \"glass\"\nior = 1\n{}{}{}",
        body("pond", 1.2, "water"),
        body("marble", 0.8, "glass"),
        body("bubble", 0.4, "air"),
    );
    let image = render(&text, 32);
    let inside = |k: &usize| (8..16).contains(&(k % 24)) && (8..16).contains(&(k / 24));
    let inside: Vec<f64> = (0..24 * 24).filter(inside).map(|k| f64::from(image.pixels[k].x)).collect();
    let mean = inside.iter().sum::<f64>() / inside.len() as f64;
    let variance = inside.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / inside.len() as f64;
    let standard_error = (variance / inside.len() as f64).sqrt();
    // Roulette makes noise, no bias; 60 events lose less than 1e-4 of the light.
    assert!((mean - 1.0).abs() < 4.0 * standard_error + 1e-4, "{mean}, standard error {standard_error}");
    assert!(standard_error < 0.01, "{standard_error}");
}

#[test]
fn photons_stay_on_their_side_of_a_closed_body() {
    let photons = 10_000_000;
    let body = body();
    let tally = (0..photons)
        .into_par_iter()
        .map(|index| follow(&body, index))
        .reduce(Tally::default, |a, b| Tally { met: a.met + b.met, wrong: a.wrong + b.wrong });
    assert!(tally.met > 2 * photons, "most photons meet the body several times: {tally:?}");
    assert_eq!(tally.wrong, 0, "{tally:?}");
}

/// A shading normal at the same angle everywhere would turn light in a ball from each reflection to the next, until it goes round the ball
/// for ever.
#[test]
fn even_relief_on_a_ball_swallows_no_light() {
    let folder = tempfile::tempdir().unwrap();
    for degrees in [2.0f64, 5.0, 20.0] {
        let normal = folder.path().join(format!("tilted-{degrees}.png"));
        let (sin, cos) = degrees.to_radians().sin_cos();
        let byte = |x: f64| (127.5 * (x + 1.0)).round() as u8;
        image::RgbImage::from_pixel(4, 4, image::Rgb([byte(sin), 128, byte(cos)])).save(&normal).unwrap();
        let text = format!(
            "[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 0]\nfov_y = 35\n[film]\nwidth = 24\nheight = 24
            [render]\nmax_bounces = 64\nbackground = [1, 1, 1]
            [[texture]]\nname = \"tilt\"\nfile = {normal:?}
            [[material]]\nname = \"g\"\ntype = \"glass\"\nior = 1.5\nabsorption = [0, 0, 0]\nnormal_map = {{ texture = \"tilt\" }}\n{}",
            sphere("ball", [0.0; 3], 1.0, "g")
        );
        let image = render(&text, 32);
        for pixel in &image.pixels {
            assert!((pixel.y - 1.0).abs() < 0.02, "{degrees} degrees: a pixel of {}", pixel.y);
        }
        assert_near(mean(&image), 1.0, 1e-3, &format!("{degrees} degrees"));
    }
}
