//! Results of the camera pass and the gather pass by pixel: of one band of rows, and of the whole film.

use super::camera::CameraBatch;
use super::caustic_photons::Splat;
use super::gather::Gathered;
use super::lobe_reuse::{LobeSample, lobe_samples, reuse_lobes};
use crate::math::Rgb;
use crate::transport::density::{BandwidthDifference, PixelSamples};
use crate::transport::pass::Rows;
use crate::transport::photons::path_blocks::concat;
use crate::transport::plan::Plan;
use crate::world::World;

/// One band's result, before neighbours reuse lobe samples.
#[derive(Clone, Debug)]
pub struct Band {
    /// Radiance from photons, for each pixel.
    photons: Vec<Rgb>,
    /// Camera samples, for each pixel.
    samples: Vec<PixelSamples>,
    /// Bandwidth differences, for each pixel.
    differences: Vec<BandwidthDifference>,
    /// Samples of Phong lobes, for each pixel; empty where no pixel reuses any.
    lobes: Vec<Option<LobeSample>>,
}

/// One iteration's contribution to the film.
#[derive(Clone, Debug)]
pub struct Contribution {
    /// Radiance from photons, for each pixel of the film, row by row.
    pub photons: Vec<Rgb>,
    /// Samples of emission and direct light, for each pixel of the film.
    pub samples: Vec<PixelSamples>,
    /// Bandwidth differences, for each pixel of the film; 0 where not measured.
    pub differences: Vec<BandwidthDifference>,
}

impl Band {
    /// Adds up the light of each pixel of some rows; `gathered` holds the light at each visible point of `seen`, in the order of the points.
    /// Light that a directly seen Phong lobe shows goes to the lobe's sample where neighbours reuse it.
    pub fn new(
        world: &World,
        plan: &Plan,
        rows: &Rows,
        seen: CameraBatch,
        gathered: &[Gathered],
        iteration: u64,
    ) -> Self {
        let (pixels, first) = (seen.samples.len(), rows.start * plan.camera.width);
        let mut photons = vec![Rgb::ZERO; pixels];
        let mut differences = vec![BandwidthDifference::default(); pixels];
        let mut lobes = lobe_samples(world, plan, &seen.visible_points, rows, iteration);
        for (point, found) in seen.visible_points.iter().zip(gathered) {
            let index = (point.pixel - first) as usize;
            differences[index] += found.difference;
            match lobes.get_mut(index) {
                Some(Some(lobe)) if !point.seen_directly => lobe.radiance += found.radiance,
                _ => photons[index] += found.radiance,
            }
        }
        Self { photons, samples: seen.samples, differences, lobes }
    }
}

impl Contribution {
    /// Joins the bands of an iteration, from the top of the film down, for a film of this width (pixels), reuses their lobe samples among
    /// neighbours, and adds the splats.
    pub fn new(bands: &[Band], splats: &[Splat], width: u32) -> Self {
        let ((mut photons, samples), differences) = rayon::join(
            || {
                let mut photons = concat(bands, |band| &band.photons);
                for splat in splats {
                    photons[splat.pixel as usize] += splat.radiance;
                }
                (photons, concat(bands, |band| &band.samples))
            },
            || concat(bands, |band| &band.differences),
        );
        reuse_lobes(bands.iter().map(|band| band.lobes.as_slice()), width, &mut photons);
        Self { photons, samples, differences }
    }
}
