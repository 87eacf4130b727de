//! Camera samples, photon paths and bands of rows of an iteration.

use super::interleaved_grid::InterleavedGrid;
use super::render_plan::Plan;
use crate::math::Stream;
use crate::transport::density::bandwidth::BandwidthDifferences;
use crate::transport::density::schedule;
use crate::transport::pass::Rows;
use std::ops::Range;

/// Samples of a pixel in a full iteration before the first refinement. All samples find direct light, whose edges need them. One sample
/// gathers photons, which is most of the work.
const CAMERA_SAMPLES: f64 = 4.0;

/// Side of the square over which sheets of light are averaged after one full iteration, pixels, where a pixel shows much of an oblique surface
/// or, in a draft, an edge.
const OBLIQUE_FILTER: f64 = 0.5;
/// The same where mirrors or glass bend what a pixel shows: a smaller one would seldom meet the bright spots of a lens.
const BENT_FILTER: f64 = 2.0;

/// Parts along the side of a pixel beside an edge, less 1, in the first iterations.
const PARTS_OF_EDGE: u32 = 3;

/// Iterations that average sheets of light over whole pixels: while noise is greater than the bias of that.
const WHOLE_PIXEL_ITERATIONS: f64 = 8.0;

impl Plan {
    /// The film in bands of rows that can be rendered independently.
    pub fn bands(&self, iteration: u64) -> Vec<Rows> {
        self.interleaved_grid(iteration).bands(self.camera.height)
    }

    /// The pixels of an iteration that gather interreflection for their neighbours.
    pub(in crate::transport) fn interleaved_grid(&self, iteration: u64) -> InterleavedGrid {
        let width = self.camera.width;
        if self.is_draft { InterleavedGrid::draft(width) } else { InterleavedGrid::new(width, iteration) }
    }

    /// The weight of an iteration in the mean of photons: its number of paths over that of a full iteration.
    pub fn weight(&self, iteration: u64) -> f64 {
        if self.is_draft { 1.0 } else { schedule::size(iteration) }
    }

    /// Indices of the paths of an iteration in a light's sequence, for `count` paths in a full iteration.
    pub(in crate::transport) fn paths(&self, count: u64, iteration: u64) -> Range<u64> {
        let start = (count as f64 * schedule::size_before(iteration)) as u64;
        start..start + (count as f64 * self.weight(iteration)) as u64
    }

    /// Indices of the samples of an iteration in a pixel's sequence; none in a pixel that a draft leaves out, otherwise at least one.
    #[inline]
    pub(in crate::transport) fn camera_samples(&self, pixel: u32, iteration: u64) -> Range<u64> {
        if self.is_draft {
            return 0..u64::from(self.draft_pixels.as_ref().is_none_or(|chosen| chosen[pixel as usize]));
        }
        if let Some(samples) = &self.samples {
            return samples.at(pixel, iteration);
        }
        let before = |i| (CAMERA_SAMPLES * schedule::size_before(i)).ceil() as u64;
        before(iteration)..before(iteration + 1)
    }

    /// The weight of an iteration in the mean over a pixel's camera samples of all iterations.
    #[inline]
    pub(in crate::transport) fn samples_weight(&self, pixel: u32, iteration: u64) -> f32 {
        match &self.samples {
            Some(samples) => samples.weight(pixel),
            None => self.camera_samples(pixel, iteration).count() as f32,
        }
    }

    /// Whether an iteration measures the bandwidth difference in a pixel.
    #[inline]
    pub(in crate::transport) fn compares_bandwidths(&self, pixel: u32, iteration: u64) -> bool {
        !self.is_draft && BandwidthDifferences::includes([self.camera.width, self.camera.height], pixel, iteration)
    }

    /// Number of parts along a pixel's side over each of which sheets of light are averaged. Later iterations average over smaller parts: where
    /// a texture changes together with the light, or mirrors and glass bend the view, the average over the whole pixel has a bias.
    pub(in crate::transport) fn parts_of_pixel(&self, iteration: u64) -> u32 {
        if self.is_draft { 1 } else { (iteration as f64 / WHOLE_PIXEL_ITERATIONS).cbrt().round().max(1.0) as u32 }
    }

    /// Number of parts along the side of a pixel beside the edge of a surface, of each of which one ray tells whether it shows the surface.
    pub(in crate::transport) fn parts_of_edge(&self, iteration: u64) -> u32 {
        PARTS_OF_EDGE + self.parts_of_pixel(iteration)
    }

    /// Side of the square over which sheets of light are averaged where a pixel shows no single piece of a surface, pixels. In a picture that
    /// converges it shrinks, so that its blur goes.
    pub(in crate::transport) fn sheet_filter(&self, seen_directly: bool, iteration: u64) -> f64 {
        let side = if seen_directly { OBLIQUE_FILTER } else { BENT_FILTER };
        if self.is_draft { side.max(1.0) } else { side * schedule::shrink(iteration).min(1.0) }
    }

    /// The stream of random numbers of a pass; drafts draw from streams of their own.
    pub(in crate::transport) fn stream(&self, stream: Stream) -> Stream {
        if self.is_draft { Stream::Draft(stream.number()) } else { stream }
    }
}
