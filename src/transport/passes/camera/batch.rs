use crate::transport::counters::{Counted, Counters};
use crate::transport::density::PixelSamples;
use crate::transport::points::{Facet, VisiblePoint};

/// Camera samples and visible points of some rows of the film.
#[derive(Clone, Debug, Default)]
pub struct CameraBatch {
    /// Points where photons are to be gathered, tile by tile. The points of a pixel are adjacent.
    pub visible_points: Vec<VisiblePoint>,
    /// Facets of visible points on surfaces with relief, which [`VisiblePoint::first_facet`] and [`VisiblePoint::facets`] index. One
    /// density estimate serves all facets of a point.
    pub facets: Vec<Facet>,
    /// Samples of emission and direct light: one value for each pixel of the rows, row by row.
    pub samples: Vec<PixelSamples>,
    /// In a draft, where the first ray of each pixel ended. Otherwise empty.
    pub first_hits: Vec<FirstHit>,
    /// Work done.
    pub counters: Counters,
}

/// Where the first ray of a pixel ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstHit {
    /// The length of the ray, scene units; infinite where it met nothing.
    pub depth: f32,
    /// Whether the surface looks the same from everywhere: it neither mirrors nor refracts, and has no Phong lobe.
    pub is_matte: bool,
}

impl FirstHit {
    /// Nothing was met.
    pub(super) const NONE: Self = Self { depth: f32::INFINITY, is_matte: false };
}

impl Counted for CameraBatch {
    fn counters(&self) -> Counters {
        self.counters
    }
}
