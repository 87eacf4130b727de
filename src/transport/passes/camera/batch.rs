use super::first_hit::FirstHit;
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
    /// Where the first ray of each pixel ended, if the input asks for it. Otherwise empty.
    pub first_hits: Vec<FirstHit>,
    /// Work done.
    pub counters: Counters,
}

impl Counted for CameraBatch {
    fn counters(&self) -> Counters {
        self.counters
    }
}
