//! Sums over iterations: the interreflection of pixels, and the irradiance of blocks in two halves of the iterations.

use super::blocks::Blocks;
use super::guide::Guide;
use super::halves::Halves;
use super::wavelet::Level;
use crate::math::Rgb;
use crate::transport::Contribution;
use rayon::prelude::*;

/// Least pixels for a thread.
const MIN_PIXELS: usize = 1 << 14;

/// The interreflection of the first iterations of a film.
#[derive(Debug)]
pub(in crate::engine) struct Interreflection {
    pub(super) blocks: Blocks,
    pub(super) levels: Vec<Level>,
    pub(super) pixels: Vec<PixelLight>,
    /// Weighted sums of the irradiance of each block over two halves of the iterations.
    halves: Vec<Halves>,
    /// The weights of the halves. The second one is 0 after the first iteration.
    pub(super) weights: [f32; 2],
}

/// Weighted sums over iterations for a pixel.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PixelLight {
    /// Radiance of interreflection.
    pub(super) light: Rgb,
    /// Radiance over irradiance.
    pub(super) reflectance: Rgb,
}

impl Interreflection {
    /// No iteration yet, for a film of this width and height whose pixels show what the first iteration tells.
    pub(in crate::engine) fn new(film: [u32; 2], first: &Contribution) -> Self {
        let blocks = Blocks::new(film, &first.guides.surfaces);
        let levels = Level::all(&blocks);
        let pixels = vec![PixelLight::default(); first.interreflection.len()];
        let halves = vec![Halves::default(); blocks.guides.len()];
        Self { blocks, levels, pixels, halves, weights: [0.0; 2] }
    }

    /// Adds an iteration of this weight: to the half that has less.
    pub(in crate::engine) fn commit(&mut self, weight: f32, contribution: &Contribution) {
        let Contribution { interreflection, guides, .. } = contribution;
        let pixels = self.pixels.par_iter_mut().zip(interreflection).zip(&guides.reflectances);
        pixels.with_min_len(MIN_PIXELS).for_each(|((sum, light), reflectance)| {
            sum.light += weight * *light;
            sum.reflectance += weight * *reflectance;
        });
        let half = usize::from(self.weights[0] > self.weights[1]);
        self.weights[half] += weight;
        let irradiances = self.blocks.each(|block| self.blocks.irradiance(block, contribution));
        for (sums, irradiance) in self.halves.iter_mut().zip(irradiances) {
            sums.0[half] += weight * irradiance;
        }
    }

    /// The mean irradiance of each block over each half of the iterations.
    pub(super) fn means(&self) -> Vec<Halves> {
        let [first, second] = self.weights.map(|weight| if weight > 0.0 { 1.0 / weight } else { 0.0 });
        self.halves.iter().map(|Halves([a, b])| Halves([first * *a, second * *b])).collect()
    }
}

impl Blocks {
    /// The mean irradiance of the pixels of a block that show the block's surface, in one iteration.
    fn irradiance(&self, block: [u32; 2], Contribution { interreflection, guides, .. }: &Contribution) -> Rgb {
        let surface = self.guides[self.index(block)].surface;
        if surface == Guide::NONE.surface {
            return Rgb::ZERO;
        }
        let (mut light, mut reflectance) = (Rgb::ZERO, Rgb::ZERO);
        for pixel in self.pixels_of(block).filter(|pixel| self.surfaces[*pixel] == surface) {
            light += interreflection[pixel];
            reflectance += guides.reflectances[pixel];
        }
        Rgb::select(reflectance.cmpgt(Rgb::ZERO), light / reflectance, Rgb::ZERO)
    }
}
