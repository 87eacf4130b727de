//! The pictures of the built-in scenes, against stored references and by their lamps, colours and caustics.

use glam::{DVec3, Vec3};
use patchlight::film::LinearImage;
use patchlight::scene::built_in_scenes;
use patchlight::transport::Component;
use patchlight::world::Camera;

#[path = "../shared/block_means.rs"]
mod block_means;

use block_means::{SIDE, block_means, rendered, small};

/// A line for each scene: its name, and the three channels of each block, row by row from the top. The example
/// `make_references` writes the file.
const REFERENCES: &str = include_str!("../data/built-in.txt");

/// Greatest error of a block over its radiance plus a tenth of the picture's mean. The worst of the 336 numbers is off by 0.024, about
/// three standard errors; the tolerance is six.
const TOLERANCE: f32 = 0.05;

/// Blocks of 256 pixels after 16 iterations, of which each has 16,384 paths or more.
#[test]
fn pictures_agree_with_the_references() {
    assert_eq!(REFERENCES.lines().count(), built_in_scenes().len());
    let mut worst = Vec::new();
    for (line, scene) in REFERENCES.lines().zip(built_in_scenes()) {
        let (name, numbers) = line.split_once(' ').expect("a name and numbers");
        assert_eq!(name, scene.name);
        let numbers: Vec<f32> = numbers.split(' ').map(|word| word.parse().expect("a number")).collect();
        let image = rendered(&small(name), None, 16, 1);
        assert!(image.pixels.iter().all(|pixel| pixel.is_finite() && pixel.min_element() >= 0.0), "{name}");
        let mean = numbers.iter().sum::<f32>() / numbers.len() as f32;
        let found: Vec<f32> = block_means(&image).iter().flat_map(|mean| mean.to_array()).collect();
        assert_eq!(found.len(), numbers.len());
        let error = |(a, b): (&f32, &f32)| (a - b).abs() / (b + 0.1 * mean);
        let error = found.iter().zip(&numbers).map(error).fold(0.0, f32::max);
        worst.push((name, error));
    }
    assert!(worst.iter().all(|(_, error)| *error < TOLERANCE), "{worst:?}");
}

/// A picture and its camera.
fn seen(name: &str, only: Option<Component>, iterations: u64) -> (LinearImage, Camera) {
    let file = small(name);
    (rendered(&file, only, iterations, 1), Camera::new(&file.scene.camera, SIDE, SIDE))
}

fn pixel(image: &LinearImage, camera: &Camera, point: DVec3) -> Vec3 {
    image.pixels[camera.project(point).expect("in view").pixel as usize]
}

/// Mean of the pixels around a point.
fn around(image: &LinearImage, camera: &Camera, point: DVec3) -> f32 {
    let middle = camera.project(point).expect("in view").pixel as usize;
    let rows = [middle - SIDE as usize, middle, middle + SIDE as usize];
    rows.into_iter().flat_map(|k| [k - 1, k, k + 1]).map(|k| image.pixels[k].element_sum()).sum::<f32>() / 27.0
}

#[test]
fn the_cornell_box_shows_its_lamp_and_colour_bleeding() {
    let (image, camera) = seen("cornell", None, 8);
    let lamp = pixel(&image, &camera, DVec3::new(0.0, 0.998, 0.0));
    assert!((lamp - Vec3::new(15.0, 13.0, 10.0)).length() < 1e-3, "the lamp's own radiance: {lamp}");
    // Grey walls beside coloured ones: the floor's left is redder than its right.
    let redness = |x: f64| {
        let color = pixel(&image, &camera, DVec3::new(x, -1.0, 0.9));
        color.x / color.y
    };
    assert!(redness(-0.9) > 1.2 * redness(0.9), "{} {}", redness(-0.9), redness(0.9));
}

/// The cusp of the cardioid lies a third of the radius beyond the middle of the mirror's circle, which has the radius 0.8.
#[test]
fn caustics_are_brighter_than_their_surroundings() {
    let (image, camera) = seen("cardioid", Some(Component::Caustics), 16);
    let at = |x, z| around(&image, &camera, DVec3::new(x, 0.001, z));
    let cusp = at(0.0, -0.8 / 3.0);
    let (inside, before) = (at(0.0, -0.6), at(0.0, 0.3));
    assert!(cusp > 2.0 * inside && cusp > 5.0 * before, "cusp {cusp}, beyond it {inside}, before it {before}");
    for name in ["lens", "water", "report"] {
        let image = rendered(&small(name), Some(Component::Caustics), 16, 1);
        let mut values: Vec<f32> = image.pixels.iter().map(|pixel| pixel.element_sum()).collect();
        values.sort_by(f32::total_cmp);
        let (median, bright) = (values[values.len() / 2], values[values.len() * 49 / 50]);
        let mean = values.iter().sum::<f32>() / values.len() as f32;
        assert!(bright > 3.0 * mean && bright > 5.0 * median, "{name}: {bright} among {median}, mean {mean}");
    }
}
