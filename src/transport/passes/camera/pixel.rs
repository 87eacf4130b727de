use crate::math::Rgb;
use crate::transport::density::sample_allocation::MOST_SAMPLES;
use crate::transport::points::{Facet, VisiblePoint, bsdf};
use arrayvec::ArrayVec;

/// The first vertices of the paths of one pixel.
pub(super) struct Pixel {
    /// Row by row from the top of the film.
    pub(super) index: u32,
    /// Weight in the pixel of the visible points that the present path leaves; 0 for a path that leaves none.
    pub(super) gather_weight: f32,
    /// Whether any of the first vertices has a texture.
    pub(super) is_textured: bool,
    facets: ArrayVec<Facet, MOST_SAMPLES>,
    has_relief: bool,
}

impl Pixel {
    /// A pixel without paths.
    pub(super) fn new() -> Self {
        Self { index: 0, gather_weight: 0.0, is_textured: false, facets: ArrayVec::new(), has_relief: false }
    }

    /// Begins another pixel.
    #[inline]
    pub(super) fn begin(&mut self, index: u32) {
        self.index = index;
        self.facets.clear();
        (self.has_relief, self.is_textured) = (false, false);
    }

    /// Adds the first vertex of a path.
    #[inline]
    pub(super) fn add(&mut self, facet: Facet, has_relief: bool) {
        self.facets.push(facet);
        self.has_relief |= has_relief;
    }

    /// Completes the visible points of the pixel, from `first` on, and adds their facets. Where all paths met one surface first, its albedo
    /// and relief at all of their first vertices count: albedo and relief at one point of the pixel would be noise.
    #[inline]
    pub(super) fn complete(
        &self,
        points: &mut Vec<VisiblePoint>,
        facets: &mut Vec<Facet>,
        first: usize,
        on_an_edge: bool,
    ) {
        for k in (first..points.len()).rev() {
            let point = &mut points[k];
            point.on_an_edge = on_an_edge;
            if point.seen_directly && !on_an_edge {
                self.add_facets(point, facets);
            }
            if point.mean_albedo == Rgb::ZERO && !bsdf::scatters(&point.scattering) {
                points.swap_remove(k);
            }
        }
    }

    fn add_facets(&self, point: &mut VisiblePoint, facets: &mut Vec<Facet>) {
        let same_surface = self.facets.iter().filter(|facet| facet.tag == point.tag);
        let (count, sum) = same_surface.clone().fold((0.0, Rgb::ZERO), |(n, sum), facet| (n + 1.0, sum + facet.albedo));
        point.mean_albedo = sum / f32::max(count, 1.0);
        let distances = same_surface.clone().map(|facet| facet.position.distance(point.position));
        point.spread = distances.fold(0.0, f32::max);
        if self.has_relief && sum != Rgb::ZERO {
            point.first_facet = facets.len() as u32;
            facets.extend(same_surface);
            point.facets = facets.len() as u32 - point.first_facet;
        }
    }
}
