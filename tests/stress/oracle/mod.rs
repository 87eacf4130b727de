//! A brute-force path tracer, as small as it can be: it shares the parser of scenes with the library, and no code of light transport or of
//! intersections. Slow, and right by inspection.
//!
//! | file | holds |
//! |---|---|
//! | `random` | random numbers |
//! | `ray` | rays and hits |
//! | `shape` | spheres, quads, planes and cells of patches, each with its intersections |
//! | `tree` | a tree of boxes over shapes |
//! | `surfaces` | the surfaces of a scene, and which bodies they bound |
//! | `media` | the bodies of glass around a point |
//! | `scattering` | reflection and refraction |
//! | `path` | paths from the camera |
//!
//! A path ends at a lamp, or outside of the scene. At diffuse vertices one point of each lamp is connected to the vertex (next event
//! estimation), and the path does not count a lamp that it meets right after. The bodies around the camera are found by a majority of rays;
//! from there on, every interface that a path crosses changes them. Caustics of point lights are out of reach.

mod media;
mod path;
mod random;
mod ray;
mod scattering;
mod shape;
mod surfaces;
mod tree;

use crate::suite::scene;
use glam::{DVec2, DVec3};
use path::Tracer;
use random::Random;
use ray::Ray;
use rayon::prelude::*;
pub(crate) use scattering::reflectance;

/// The means over channels of `side` x `side` blocks of the picture of a scene's text, with this many paths for each pixel. The round
/// seeds the paths.
pub(crate) fn blocks(text: &str, side: u32, paths: u32, round: u64) -> Vec<f64> {
    let scene = scene(text).scene;
    let tracer = Tracer::new(&scene);
    let (width, height) = (scene.film.width, scene.film.height);
    let forward = (scene.camera.target - scene.camera.position).normalize();
    let right = forward.cross(scene.camera.up).normalize();
    let half = (0.5 * scene.camera.fov_y.to_radians()).tan();
    let radiance = |pixel: u32| {
        let mut random = Random::new(round, u64::from(pixel));
        let path = |_| {
            let film = DVec2::new(f64::from(pixel % width) + random.next(), f64::from(pixel / width) + random.next());
            let at = (2.0 * film - DVec2::new(f64::from(width), f64::from(height))) / f64::from(height) * half;
            let direction = forward + at.x * right - at.y * right.cross(forward);
            tracer.radiance(Ray { origin: scene.camera.position, direction: direction.normalize() }, &mut random)
        };
        (0..paths).map(path).sum::<DVec3>().element_sum() / (3.0 * f64::from(paths))
    };
    let pixels: Vec<f64> = (0..width * height).into_par_iter().map(radiance).collect();
    let (columns, rows) = (width / side, height / side);
    let block = |k: u32| {
        let pixel = |n: u32| (k / side * rows + n / columns) * width + k % side * columns + n % columns;
        (0..columns * rows).map(|n| pixels[pixel(n) as usize]).sum::<f64>() / f64::from(columns * rows)
    };
    (0..side * side).map(block).collect()
}
