//! A display filter: takes the noise of low frequency out of the interreflection that the screen shows.
//!
//! Photons that many pixels share make the interreflection of the first seconds blotchy: its noise is as wide as the discs of the density
//! estimate. It is filtered on blocks of 2 x 2 pixels, as irradiance, so textures play no part. Only the difference that the filter makes
//! goes back to the pixels, times their reflectance: what is finer than a block stays as it is. The film never contains it.
//!
//! | file | holds |
//! |---|---|
//! | `guide` | what a pixel or a block shows, and how alike two of them are |
//! | `blocks` | blocks of pixels that show one surface |
//! | `halves` | values of two halves of the iterations |
//! | `interreflection` | sums over iterations: the irradiance of blocks, and its noise |
//! | `wavelet` | the edge-avoiding wavelet transform |
//! | `energy` | how much of the details of a level is noise |
//! | `smoothing` | the picture with the filtered interreflection |

mod blocks;
mod energy;
mod guide;
mod halves;
mod interreflection;
mod smoothing;
mod wavelet;

pub(super) use interreflection::Interreflection;
