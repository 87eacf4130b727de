//! Results of the camera pass and the gather pass by pixel: of one band of rows, and of the whole film.

use super::camera::{CameraBatch, FirstHit};
use super::gathered::Gathered;
use super::guides::Guides;
use super::input::PassInput;
use super::lobe_reuse::{lobe_samples, reuse_lobes};
use super::lobe_sample::LobeSample;
use crate::math::Rgb;
use crate::transport::density::{BandwidthDifference, PixelSamples};
use crate::transport::energy::Energy;
use crate::transport::pass::Rows;
use crate::transport::photons::Splat;
use crate::transport::photons::path_blocks::concat;
use crate::transport::points::VisiblePoint;

/// One band's result, before neighbours reuse lobe samples.
#[derive(Clone, Debug)]
pub struct Band {
    /// Radiance from photons, for each pixel.
    photons: Vec<Rgb>,
    /// The part of it that is interreflection, for each pixel.
    interreflection: Vec<Rgb>,
    /// Camera samples, for each pixel.
    samples: Vec<PixelSamples>,
    /// Bandwidth differences, for each pixel.
    differences: Vec<BandwidthDifference>,
    /// Samples of Phong lobes, for each pixel; empty where no pixel reuses any.
    lobes: Vec<Option<LobeSample>>,
    /// Where the first ray of each pixel ended, if the input asks for it.
    first_hits: Vec<FirstHit>,
    /// What the pixels show, if the input asks for it.
    guides: Guides,
}

/// One iteration's contribution to the film.
#[derive(Clone, Debug)]
pub struct Contribution {
    /// Radiance from photons, for each pixel of the film, row by row.
    pub photons: Vec<Rgb>,
    /// The part of it that is interreflection, without the light in Phong lobes.
    pub interreflection: Vec<Rgb>,
    /// Samples of emission and direct light, for each pixel of the film.
    pub samples: Vec<PixelSamples>,
    /// Bandwidth differences, for each pixel of the film; 0 where not measured.
    pub differences: Vec<BandwidthDifference>,
    /// Where the first ray of each pixel ended, if the input asks for it. Otherwise empty.
    pub first_hits: Vec<FirstHit>,
    /// What the pixels show, if the input asks for it. Otherwise empty.
    pub guides: Guides,
    /// What became of the flux of the photon paths.
    pub energy: Energy,
}

impl Band {
    /// Adds up the light of each pixel of some rows; `gathered` holds the light at each visible point of `seen`, in the order of the
    /// points. Light that a directly seen Phong lobe shows goes to the lobe's sample where neighbours reuse it.
    pub fn new(input: &PassInput, rows: &Rows, seen: CameraBatch, gathered: &[Gathered]) -> Self {
        let (pixels, first) = (seen.samples.len(), rows.start * input.plan.camera.width);
        let (mut photons, mut interreflection) = (vec![Rgb::ZERO; pixels], vec![Rgb::ZERO; pixels]);
        let mut differences = vec![BandwidthDifference::default(); pixels];
        let mut lobes = lobe_samples(input, &seen.visible_points, rows);
        let own = |point: &VisiblePoint| {
            point.seen_directly || !matches!(lobes.get((point.pixel - first) as usize), Some(Some(_)))
        };
        let guides = Guides::new(input, rows, seen.visible_points.iter().map(|point| (point, own(point))));
        for (point, found) in seen.visible_points.iter().zip(gathered) {
            let index = (point.pixel - first) as usize;
            differences[index] += found.difference;
            match lobes.get_mut(index) {
                Some(Some(lobe)) if !point.seen_directly => lobe.radiance += found.radiance,
                _ => {
                    photons[index] += found.radiance;
                    interreflection[index] += found.interreflection;
                }
            }
        }
        let CameraBatch { samples, first_hits, .. } = seen;
        Self { photons, interreflection, samples, differences, lobes, first_hits, guides }
    }
}

impl Contribution {
    /// Joins the bands of an iteration, from the top of the film down, for a film of this width (pixels), reuses their lobe samples among
    /// neighbours, and adds the splats.
    pub fn new(bands: &[Band], splats: &[Splat], width: u32, energy: Energy) -> Self {
        let ((mut photons, samples), (differences, interreflection)) = rayon::join(
            || {
                let mut photons = concat(bands, |band| &band.photons);
                for splat in splats {
                    photons[splat.pixel as usize] += splat.radiance;
                }
                (photons, concat(bands, |band| &band.samples))
            },
            || (concat(bands, |band| &band.differences), concat(bands, |band| &band.interreflection)),
        );
        reuse_lobes(bands.iter().map(|band| band.lobes.as_slice()), width, &mut photons);
        let first_hits = concat(bands, |band| &band.first_hits);
        let guides = Guides::joined(bands, |band| &band.guides);
        Self { photons, interreflection, samples, differences, first_hits, guides, energy }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::plan::Plan;
    use crate::transport::testing::{self, lamp, quad, visible_point};
    use crate::world::{Lobe, Scattering, World};
    use glam::Vec3;

    /// A glossy floor with a wall, on a film of 2 x 2 pixels.
    fn world() -> World {
        let gloss =
            "[[material]]\nname = \"gloss\"\ntype = \"phong\"\nalbedo = [0.5, 0.5, 0.5]\nspecular = [0.5, 0.5, 0.5]
            exponent = 10\n[film]\nwidth = 2\nheight = 2\n";
        let floor = quad("floor", [[-1.0, 0.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]], "gloss");
        let wall = quad("wall", [[-1.0, 0.0, -1.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]], "grey");
        testing::world(&[gloss, &floor, &wall, &lamp([0.0, 1.0, 0.0])].concat())
    }

    fn band(world: &World, rows: &Rows, found: &[(VisiblePoint, f32)]) -> Band {
        let pixels = rows.len() * 2;
        let seen = CameraBatch {
            visible_points: found.iter().map(|(point, _)| *point).collect(),
            samples: vec![PixelSamples { count: rows.start + 1, ..PixelSamples::default() }; pixels],
            ..CameraBatch::default()
        };
        let gathered =
            |&(_, radiance): &(VisiblePoint, f32)| Gathered { radiance: Rgb::splat(radiance), ..Gathered::default() };
        let gathered: Vec<Gathered> = found.iter().map(gathered).collect();
        Band::new(&PassInput::uncancelled(world, &Plan::new(world), 1, 4), rows, seen, &gathered)
    }

    fn at(pixel: u32) -> VisiblePoint {
        VisiblePoint { pixel, ..visible_point() }
    }

    #[test]
    fn points_bands_and_splats_add_up_in_their_pixels() {
        let world = world();
        let bands = [band(&world, &(0..1), &[(at(1), 1.0), (at(1), 2.0)]), band(&world, &(1..2), &[(at(2), 4.0)])];
        let splats = [(3, 8.0), (1, 16.0), (3, 32.0)];
        let splats = splats.map(|(pixel, radiance)| Splat { pixel, radiance: Rgb::splat(radiance) });
        let Contribution { photons, samples, differences, .. } =
            Contribution::new(&bands, &splats, 2, Energy::default());
        assert_eq!(photons.iter().map(|radiance| radiance.x).collect::<Vec<_>>(), [0.0, 19.0, 4.0, 40.0]);
        assert_eq!(samples.iter().map(|samples| samples.count).collect::<Vec<_>>(), [1, 1, 2, 2], "row by row");
        assert_eq!(differences.len(), 4);
    }

    /// Two neighbours on the floor: they reuse the light that one sees in its lobe, not its own light.
    #[test]
    fn light_in_a_lobe_goes_to_the_neighbours() {
        let world = world();
        let lobe = Lobe::Phong { specular: Rgb::splat(0.5), exponent: 10.0 };
        let on_the_floor = |pixel, x| VisiblePoint {
            scattering: Scattering { albedo: Rgb::splat(0.5), lobe },
            position: Vec3::new(x, 0.0, 0.0),
            ..at(pixel)
        };
        let in_the_lobe = VisiblePoint { seen_directly: false, primitive: 1, ..at(0) };
        let found = [(on_the_floor(0, 0.0), 1.0), (in_the_lobe, 8.0), (on_the_floor(1, 0.1), 2.0)];
        let bands = [band(&world, &(0..1), &found), band(&world, &(1..2), &[])];
        let photons = Contribution::new(&bands, &[], 2, Energy::default()).photons;
        assert_eq!([photons[0].x, photons[1].x], [1.0 + 4.0, 2.0 + 4.0]);
    }
}
