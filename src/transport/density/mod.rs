//! Density estimation, which turns photons near a point into radiance, and the measurements that improve it.
//!
//! | file | holds |
//! |---|---|
//! | `schedule` | sizes of iterations, and how radii shrink |
//! | `kernel` | the kernel and its moments over a clipped disc |
//! | `visibility_polygon` | the part of its plane that a point sees past standing objects |
//! | `disc` | the disc of a point: kernel, edges, visibility |
//! | `estimate` | sums over a disc: irradiance and reflected radiance |
//! | `cells` | the film in cells of a few pixels |
//! | `bandwidth` | radii over the film by measured bias and variance |
//! | `sample_allocation` | camera samples of each pixel by measured variance |
//! | `film_statistics` | measurements of iterations |

pub(in crate::transport) mod bandwidth;
mod cells;
pub(in crate::transport) mod disc;
pub(in crate::transport) mod estimate;
mod film_statistics;
mod kernel;
pub(in crate::transport) mod sample_allocation;
pub(in crate::transport) mod schedule;
pub(in crate::transport) mod visibility_polygon;

pub use bandwidth::{Bandwidth, BandwidthDifference};
pub use film_statistics::FilmStatistics;
pub use sample_allocation::PixelSamples;
