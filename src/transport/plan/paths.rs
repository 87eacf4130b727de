//! How many paths leave each light.

use crate::transport::density::schedule::SMALLEST;
use crate::world::Light;

/// Least paths of a full iteration: fewer leave too few photons in a disc.
const LEAST_PATHS: f64 = 16_384.0;
/// Most paths of a full iteration: more would make an iteration last longer than a user waits for the next frame.
const MOST_PATHS: f64 = 524_288.0;

/// Paths of a full iteration for a film of `pixels` pixels, within [`LEAST_PATHS`] and [`MOST_PATHS`].
pub(super) fn of_pixels(pixels: usize, paths_per_pixel: f64) -> f64 {
    (pixels as f64 * paths_per_pixel).clamp(LEAST_PATHS, MOST_PATHS)
}

/// Power of a light in its strongest channel, W.
pub(super) fn power(light: &Light) -> f64 {
    f64::from(light.power().max_element())
}

/// Allocates about `total` paths in proportion to the weights; not 0 for a positive weight. All numbers are multiples of
/// [`SMALLEST`], by which the schedule divides them.
pub(super) fn allocate(weights: Vec<f64>, total: f64) -> Vec<u64> {
    let sum: f64 = weights.iter().sum();
    let paths = |w: f64| ((w / sum * total) as u64).next_multiple_of(SMALLEST).max(SMALLEST);
    weights.into_iter().map(|w| if w > 0.0 { paths(w) } else { 0 }).collect()
}
