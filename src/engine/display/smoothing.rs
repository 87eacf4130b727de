//! The picture with the filtered interreflection.

use super::blocks::{Blocks, SIDE, between};
use super::energy::noise_fractions;
use super::guide::Guide;
use super::halves::Halves;
use super::interreflection::Interreflection;
use crate::film::LinearImage;
use crate::math::Rgb;
use rayon::prelude::*;

/// Iterations, as full ones, from which on the filter fades, and after which the picture is shown as it is.
const FADING_WEIGHTS: [f32; 2] = [32.0, 64.0];

impl Interreflection {
    /// How strong the filter is, from 0 to 1, after iterations of this weight.
    pub(in crate::engine) fn strength(weight: f64) -> f32 {
        let [from, to] = FADING_WEIGHTS;
        ((to - weight as f32) / (to - from)).clamp(0.0, 1.0)
    }

    /// A picture of the same iterations with less noise in its interreflection.
    pub(in crate::engine) fn smoothed(&self, image: &LinearImage) -> LinearImage {
        let differences = self.differences();
        let weight = self.weights[0] + self.weights[1];
        let factor = Self::strength(weight.into()) / weight;
        let width = image.width as usize;
        let mut pixels = image.pixels.clone();
        let smooth_row = |(y, row): (usize, &mut [Rgb])| {
            for (x, (pixel, sums)) in row.iter_mut().zip(&self.pixels[y * width..]).enumerate() {
                let difference = self.blocks.enlarged(&differences, [x as u32, y as u32]);
                // The interreflection of a pixel does not become negative.
                let change = (sums.reflectance * difference).max(-sums.light.max(Rgb::ZERO));
                *pixel = (*pixel + factor * change).max(Rgb::ZERO);
            }
        };
        pixels.par_chunks_mut(width).enumerate().for_each(smooth_row);
        LinearImage { pixels, ..*image }
    }

    /// The difference that the filter makes to the irradiance of each block: the noise that it takes out of the details of each level.
    fn differences(&self) -> Vec<Rgb> {
        let columns = self.blocks.size[0];
        let total = self.weights[0] + self.weights[1];
        let weights = self.weights.map(|weight| weight / total);
        let mut irradiances = self.means();
        let mut differences = vec![Rgb::ZERO; irradiances.len()];
        for level in &self.levels {
            let means = level.means(columns, &irradiances);
            let details: Vec<Halves> =
                irradiances.par_iter().zip(&means).map(|(fine, coarse)| *fine - *coarse).collect();
            let noise = noise_fractions(&self.blocks, level.step, &details, &means, weights);
            let of_level = details.par_iter().zip(noise).map(|(detail, noise)| noise * detail.mean(weights));
            differences.par_iter_mut().zip(of_level).for_each(|(difference, noise)| *difference -= noise);
            irradiances = means;
        }
        differences
    }
}

impl Blocks {
    /// The value at a pixel: the mean of the nearest blocks by their distance, and by their likeness to the pixel's block, unless that shows
    /// another surface. 0 where no block near shows the surface of the pixel.
    fn enlarged(&self, values: &[Rgb], [x, y]: [u32; 2]) -> Rgb {
        let surface = self.surfaces[(y * self.film[0] + x) as usize];
        if surface == Guide::NONE.surface {
            return Rgb::ZERO;
        }
        let own = &self.guides[self.index([x / SIDE, y / SIDE])];
        let flatness = own.flatness(SIDE as f32);
        let likeness = |guide: &Guide| {
            if own.surface == surface { own.likeness(guide, flatness) } else { f32::from(guide.surface == surface) }
        };
        let on_blocks = |at: u32| (at as f32 + 0.5) / SIDE as f32;
        let (mut sum, mut weights) = (Rgb::ZERO, 0.0);
        for (row, by_row) in between(on_blocks(y), self.size[1]) {
            for (column, by_column) in between(on_blocks(x), self.size[0]) {
                let block = self.index([column, row]);
                let weight = by_row * by_column * likeness(&self.guides[block]);
                sum += weight * values[block];
                weights += weight;
            }
        }
        if weights > 0.0 { sum / weights } else { Rgb::ZERO }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::{Contribution, Energy, Guides, SeenSurface};
    use glam::Vec3;

    const SIDE: u32 = 96;

    /// A picture of the interreflection after some iterations, as large as full ones.
    struct Scene<'a> {
        /// What is seen in a column, and its position.
        surface: &'a dyn Fn(u32) -> (u32, Vec3, Vec3),
        reflectance: &'a dyn Fn(u32, u32) -> f32,
        /// In a column and row and an iteration.
        irradiance: &'a dyn Fn(u32, u32, u64) -> f32,
    }

    /// A wall that faces the camera.
    fn wall(x: u32) -> (u32, Vec3, Vec3) {
        (0, Vec3::new(x as f32, 0.0, 0.0), Vec3::Z)
    }

    const PLAIN: Scene = Scene { surface: &wall, reflectance: &|_, _| 0.5, irradiance: &|_, _, _| 1.0 };

    /// Noise in squares of 6 x 6 pixels, with a mean of 0 and a variance of 1.
    fn blotch(x: u32, y: u32, iteration: u64) -> f32 {
        let mut hash = (u64::from(x / 6) << 32 | u64::from(y / 6) << 8 | iteration).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        hash = (hash ^ hash >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        (3.0f32).sqrt() * ((hash >> 40) as f32 / (1 << 23) as f32 - 1.0)
    }

    impl Scene<'_> {
        fn contribution(&self, iteration: u64) -> Contribution {
            let pixels = || (0..SIDE * SIDE).map(|k| (k % SIDE, k / SIDE));
            let reflectances: Vec<Rgb> = pixels().map(|(x, y)| Rgb::splat((self.reflectance)(x, y))).collect();
            let light = |((x, y), reflectance): ((u32, u32), &Rgb)| *reflectance * (self.irradiance)(x, y, iteration);
            let seen = |(x, y): (u32, u32)| {
                let (tag, position, normal) = (self.surface)(x);
                let position = position + Vec3::new(0.0, y as f32, 0.0);
                Some(SeenSurface { position, normal, footprint: 1.0, tag: tag << 8, seen_directly: true })
            };
            let interreflection: Vec<Rgb> = pixels().zip(&reflectances).map(light).collect();
            Contribution {
                photons: interreflection.clone(),
                interreflection,
                samples: Vec::new(),
                differences: Vec::new(),
                first_hits: Vec::new(),
                guides: Guides { reflectances, surfaces: pixels().map(seen).collect() },
                energy: Energy::default(),
            }
        }

        /// The picture after this many iterations, and with less noise.
        fn pictures(&self, iterations: u64) -> [LinearImage; 2] {
            let mut sums = Interreflection::new([SIDE; 2], &self.contribution(1));
            let mut pixels = vec![Rgb::ZERO; (SIDE * SIDE) as usize];
            for iteration in 1..=iterations {
                let contribution = self.contribution(iteration);
                sums.commit(1.0, &contribution);
                for (pixel, light) in pixels.iter_mut().zip(&contribution.interreflection) {
                    *pixel += *light / iterations as f32;
                }
            }
            let image = LinearImage { width: SIDE, height: SIDE, pixels };
            let smoothed = sums.smoothed(&image);
            [image, smoothed]
        }
    }

    /// The root mean square of the differences between the irradiance in a range of columns and `truth`.
    fn error(scene: &Scene, image: &LinearImage, columns: std::ops::Range<u32>, truth: impl Fn(u32) -> f32) -> f32 {
        let square = |k: u32| {
            let [x, y] = [k % SIDE, k / SIDE];
            let irradiance = image.pixels[k as usize].x / (scene.reflectance)(x, y);
            columns.contains(&x).then(|| (irradiance - truth(x)).powi(2))
        };
        let squares: Vec<f32> = (0..SIDE * SIDE).filter_map(square).collect();
        (squares.iter().sum::<f32>() / squares.len() as f32).sqrt()
    }

    #[test]
    fn constant_irradiance_on_a_texture_stays() {
        let scene = Scene { reflectance: &|x, y| if (x + y) % 3 == 0 { 0.7 } else { 0.1 }, ..PLAIN };
        let [image, smoothed] = scene.pictures(3);
        assert!(image.pixels.iter().zip(&smoothed.pixels).all(|(a, b)| (*a - *b).length() < 1e-6));
    }

    #[test]
    fn blotches_vanish_from_a_wall() {
        let scene = Scene { irradiance: &|x, y, i| 1.0 + 0.2 * blotch(x, y, i), ..PLAIN };
        for (iterations, left) in [(1, 0.7), (2, 0.45), (4, 0.4)] {
            let errors = scene.pictures(iterations).map(|image| error(&scene, &image, 0..SIDE, |_| 1.0));
            assert!(errors[1] < left * errors[0], "{errors:?} after {iterations} iterations");
        }
    }

    /// The filter sees irradiance alone: with a texture it takes the same noise away as without.
    #[test]
    fn a_texture_keeps_every_detail() {
        let plain = Scene { irradiance: &|x, y, i| 1.0 + 0.2 * blotch(x, y, i), ..PLAIN };
        // Blocks have equal reflectances, so their irradiance is the same.
        let texture = Scene { reflectance: &|x, y| if (x / 2 + y / 2) % 3 == 0 { 0.9 } else { 0.05 }, ..plain };
        let [[_, plain_image], [_, image]] = [plain.pictures(2), texture.pictures(2)];
        for (k, (a, b)) in (0..).zip(plain_image.pixels.iter().zip(&image.pixels)) {
            let reflectance = (texture.reflectance)(k % SIDE, k / SIDE);
            assert!((a.x / 0.5 - b.x / reflectance).abs() < 1e-4, "{k}");
        }
    }

    /// A dark left half and a bright right half, which another surface, normal or depth divides: neither gets light of the other.
    #[test]
    fn no_light_leaks_over_an_edge() {
        let half = SIDE / 2;
        let surfaces: [&dyn Fn(u32) -> (u32, Vec3, Vec3); 3] = [
            &|x| (u32::from(x < half), wall(x).1, Vec3::Z),
            &|x| (0, wall(x).1, if x < half { Vec3::X } else { Vec3::Z }),
            &|x| (0, wall(x).1 + if x < half { 1e4 * Vec3::Z } else { Vec3::ZERO }, Vec3::Z),
        ];
        let truth = |x: u32| if x < half { 0.1 } else { 1.0 };
        let irradiance = |x, y, i| if x < half { 0.1 } else { 1.0 + 0.2 * blotch(x, y, i) };
        for surface in surfaces {
            let scene = Scene { surface, irradiance: &irradiance, ..PLAIN };
            let [image, smoothed] = scene.pictures(2);
            let dark = error(&scene, &smoothed, 0..half, truth);
            assert!(dark < 1e-3, "{dark}");
            let bright = [image, smoothed].map(|image| error(&scene, &image, half..SIDE, truth));
            assert!(bright[1] < 0.6 * bright[0], "{bright:?}");
        }
    }

    /// The edge of an indirect shadow on one wall, which no guide shows.
    #[test]
    fn light_that_all_iterations_show_stays() {
        let truth = |x: u32| if x < SIDE / 2 { 0.3 } else { 1.0 };
        let scene = Scene { irradiance: &|x, y, i| truth(x) * (1.0 + 0.05 * blotch(x, y, i)), ..PLAIN };
        let [image, smoothed] = scene.pictures(4).map(|image| error(&scene, &image, 40..56, truth));
        assert!(smoothed < 1.1 * image, "{smoothed} after {image}");
    }

    #[test]
    fn the_filter_fades_as_the_noise_falls() {
        let change = |noise: f32, iterations| {
            let scene = Scene { irradiance: &|x, y, i| 1.0 + noise * blotch(x, y, i), ..PLAIN };
            let [image, smoothed] = scene.pictures(iterations);
            let changes = image.pixels.iter().zip(&smoothed.pixels).map(|(a, b)| (*a - *b).length());
            changes.fold(0.0, f32::max)
        };
        assert!(change(0.2, 8) < change(0.2, 2));
        assert_eq!(change(0.2, 64), 0.0, "faded");
        assert_eq!([16.0, 32.0, 48.0, 64.0, 1e6].map(Interreflection::strength), [1.0, 1.0, 0.5, 0.0, 0.0]);
    }
}
