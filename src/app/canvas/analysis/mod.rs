//! Analysis of the selected surface, drawn over the picture: isolines, curvature, reflection lines. Restarts no rendering.
//!
//! | file | holds |
//! |---|---|
//! | `choice` | [`Analysis`]: what is drawn |
//! | `raster` | the point of a patch that each pixel shows, with a depth test |
//! | `isolines` | the coverage of pixels by lines of constant u and v |
//! | `stripes` | reflection lines |
//! | `curvature` | curvature as a colour, with the scale of the legend |
//! | `image` | the analysis as an image, by pixel |
//! | `legend` | the colours of the curvature with their numbers |
//! | `layer` | [`AnalysisLayer`]: the image over the picture, made off the UI thread |

mod choice;
mod curvature;
mod image;
mod isolines;
mod layer;
mod legend;
mod raster;
mod stripes;

pub(crate) use choice::{Analysis, Shading};
pub(crate) use layer::AnalysisLayer;
