use crate::transport::counters::Counters;
use crate::transport::density::PixelSamples;
use crate::transport::points::{Facet, VisiblePoint};

/// What the camera pass finds in some rows of the film.
#[derive(Clone, Debug, Default)]
pub struct CameraBatch {
    /// Points where photons are to be gathered, tile by tile.
    pub visible_points: Vec<VisiblePoint>,
    /// The facets of visible points on surfaces with relief: one density estimate serves all facets of a point.
    pub facets: Vec<Facet>,
    /// Samples of emitted and direct light, for each pixel of the rows.
    pub samples: Vec<PixelSamples>,
    /// Work done.
    pub counters: Counters,
}
