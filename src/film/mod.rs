//! Pictures: linear images, tone curves, PNG and OpenEXR files, and how far one picture is from another.

mod error;
mod exr;
#[cfg(feature = "flip")]
mod flip;
mod image;
mod metrics;
mod png;
mod tone;

pub use self::exr::{read_exr, write_exr};
pub use self::image::LinearImage;
pub use error::ImageError;
#[cfg(feature = "flip")]
pub use flip::{flip, mean_inside};
pub use metrics::{Errors, compare, compare_with_both};
pub use png::{Mask, write_png};
pub use tone::ToneMap;
