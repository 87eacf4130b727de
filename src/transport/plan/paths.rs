//! How many paths leave each light.

use crate::transport::schedule::SMALLEST;
use crate::world::Light;

const LEAST_PATHS: f64 = 16_384.0;
/// More would make an iteration last longer than a user waits for the next frame.
const MOST_PATHS: f64 = 524_288.0;

/// The paths of a full iteration, so many for each pixel as far as that is neither too few nor too many.
pub(super) fn of_pixels(pixels: usize, paths_per_pixel: f64) -> f64 {
    (pixels as f64 * paths_per_pixel).clamp(LEAST_PATHS, MOST_PATHS)
}

/// What a light emits, of its strongest channel.
pub(super) fn power(light: &Light) -> f64 {
    f64::from(light.power().max_element())
}

/// Numbers of paths in proportion to the weights, not 0 where the weight is not 0, about `total` together; multiples of
/// what the schedule divides them by.
pub(super) fn share(weights: Vec<f64>, total: f64) -> Vec<u64> {
    let sum: f64 = weights.iter().sum();
    let paths = |w: f64| ((w / sum * total) as u64).next_multiple_of(SMALLEST).max(SMALLEST);
    weights.into_iter().map(|w| if w > 0.0 { paths(w) } else { 0 }).collect()
}
