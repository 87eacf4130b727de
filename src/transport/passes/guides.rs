//! What pixels show, for a filter of the interreflection in the picture.

use super::input::PassInput;
use crate::math::Rgb;
use crate::transport::pass::Rows;
use crate::transport::photons::path_blocks::concat;
use crate::transport::points::{VisiblePoint, bsdf};
use crate::world::Scattering;
use glam::Vec3;

/// What the pixels of some rows show.
#[derive(Clone, Debug, Default)]
pub struct Guides {
    /// The radiance of each pixel over the irradiance of what it shows, without Phong lobes, in one iteration.
    pub reflectances: Vec<Rgb>,
    /// In the first iteration, the surface of which each pixel shows the most; `None` where a pixel shows no diffuse surface. Otherwise
    /// empty.
    pub surfaces: Vec<Option<SeenSurface>>,
}

/// A point of a surface that a pixel shows, directly, in mirrors or through glass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenSurface {
    /// Position relative to [`View::origin`](crate::world::View::origin).
    pub position: Vec3,
    /// Shading unit normal on the seen side.
    pub normal: Vec3,
    /// Side of the pixel's footprint, scene units.
    pub footprint: f32,
    /// Equal for points of the same side of one surface.
    pub tag: u32,
    /// Whether the camera sees it neither in a mirror nor through glass.
    pub seen_directly: bool,
}

impl Guides {
    /// The guides of some rows for these visible points, each of which comes with whether its light belongs to its own pixel alone; empty if
    /// the input asks for none.
    pub(super) fn new<'a>(
        input: &PassInput,
        rows: &Rows,
        points: impl Iterator<Item = (&'a VisiblePoint, bool)>,
    ) -> Self {
        if !input.guides {
            return Self::default();
        }
        let width = input.plan.camera.width;
        let pixels = rows.len() * width as usize;
        let mut reflectances = vec![Rgb::ZERO; pixels];
        let mut surfaces = vec![None; if input.iteration == 1 { pixels } else { 0 }];
        // The reflectance of the surface that a pixel shows, summed over the channels.
        let mut most = vec![0.0; surfaces.len()];
        for (point, _) in points.filter(|(_, is_own)| *is_own) {
            let index = (point.pixel - rows.start * width) as usize;
            let scattering = Scattering { albedo: point.mean_albedo, ..point.scattering };
            let reflectance = point.throughput * bsdf::eval_diffuse(&scattering);
            reflectances[index] += reflectance;
            if let Some(most) = most.get_mut(index)
                && reflectance.element_sum() > *most
            {
                *most = reflectance.element_sum();
                surfaces[index] = Some(SeenSurface::of(point));
            }
        }
        Self { reflectances, surfaces }
    }

    /// Joins the guides of the bands of an iteration, from the top of the film down.
    pub(super) fn joined<B>(bands: &[B], guides: impl Fn(&B) -> &Self) -> Self {
        Self {
            reflectances: concat(bands, |band| &guides(band).reflectances),
            surfaces: concat(bands, |band| &guides(band).surfaces),
        }
    }
}

impl SeenSurface {
    fn of(point: &VisiblePoint) -> Self {
        let VisiblePoint { position, n_shade, footprint, tag, seen_directly, .. } = *point;
        Self { position, normal: n_shade, footprint, tag, seen_directly }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::plan::Plan;
    use crate::transport::testing::{self, lamp, quad, visible_point};
    use std::f32::consts::PI;

    fn guides(iteration: u64, wanted: bool, points: &[(VisiblePoint, bool)]) -> Guides {
        let floor = quad("floor", [[-1.0, 0.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]], "grey");
        let world = testing::world(&["[film]\nwidth = 2\nheight = 2\n", &floor, &lamp([0.0, 1.0, 0.0])].concat());
        let plan = Plan::new(&world);
        let input = PassInput { guides: wanted, ..PassInput::uncancelled(&world, &plan, 1, iteration) };
        Guides::new(&input, &(1..2), points.iter().map(|(point, is_own)| (point, *is_own)))
    }

    /// Two points in pixel 2: a grey one, directly, and a white one, in a mirror of reflectance 0.2. A third one lies in a lobe that
    /// neighbours reuse.
    fn points() -> [(VisiblePoint, bool); 3] {
        let grey = VisiblePoint { pixel: 2, mean_albedo: Rgb::splat(0.5), tag: 256, ..visible_point() };
        let white = VisiblePoint { pixel: 2, throughput: Rgb::splat(0.2), seen_directly: false, ..visible_point() };
        [(white, true), (grey, true), (VisiblePoint { pixel: 3, ..white }, false)]
    }

    #[test]
    fn a_pixel_has_the_reflectance_of_all_its_points_and_the_surface_of_the_brightest() {
        let Guides { reflectances, surfaces } = guides(1, true, &points());
        assert!((reflectances[0] - Rgb::splat(0.7 / PI)).length() < 1e-6, "{}", reflectances[0]);
        let surface = surfaces[0].unwrap();
        assert_eq!((surface.tag, surface.seen_directly), (256, true));
        assert_eq!((reflectances[1], surfaces[1]), (Rgb::ZERO, None), "light in the lobe is no light of the pixel");
    }

    #[test]
    fn surfaces_come_once_and_guides_only_where_they_are_wanted() {
        let later = guides(2, true, &points());
        assert_eq!((later.reflectances.len(), later.surfaces.len()), (2, 0));
        let unwanted = guides(1, false, &points());
        assert!(unwanted.reflectances.is_empty() && unwanted.surfaces.is_empty());
    }
}
