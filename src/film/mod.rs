//! Images: linear images, tone curves, PNG and OpenEXR files, and error metrics.
//!
//! | file | holds |
//! |---|---|
//! | `image` | [`LinearImage`] |
//! | `error` | [`ImageError`] |
//! | `tone` | [`ToneMap`]: exposure and tone curve, to 8 or 16 bits |
//! | `provenance` | [`Provenance`]: how a picture came about |
//! | `png` | [`write_png`]; [`Mask`]: the pixels that a comparison includes |
//! | `exr` | [`read_exr`], [`write_exr`], [`read_exr_with_provenance`] |
//! | `metrics` | [`Errors`]: RMSE, relMSE and bias against a reference |
//! | `difference` | [`difference_image`]: false colours |
//! | `flip` | the FLIP metric, with the feature `flip` |

mod difference;
mod error;
mod exr;
#[cfg(feature = "flip")]
mod flip;
mod image;
mod metrics;
mod png;
mod provenance;
mod tone;

pub use self::exr::{read_exr, read_exr_with_provenance, write_exr};
pub use self::image::LinearImage;
pub use difference::{FULL_DIFFERENCE, difference_color, difference_image};
pub use error::ImageError;
#[cfg(feature = "flip")]
pub use flip::{flip, mean_inside};
pub use metrics::{Errors, compare, compare_with_both};
pub use png::{Mask, PngDepth, write_png};
pub use provenance::Provenance;
pub use tone::ToneMap;
