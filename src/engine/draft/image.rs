//! A draft: a picture of few pixels, made at bounded cost.

use crate::engine::frame::Stats;
use crate::engine::g_buffer::GBuffer;
use crate::film::LinearImage;
use crate::math::Rgb;
use crate::transport::DraftSize;
#[cfg(test)]
use crate::transport::FirstHit;
use std::sync::Arc;

/// A picture with every n-th pixel each way.
#[derive(Clone, Debug)]
pub struct Draft {
    /// How much it leaves out.
    pub size: DraftSize,
    /// Linear radiance; black in pixels that were left out.
    pub image: Arc<LinearImage>,
    /// The picture with less noise in its interreflection, if that was asked for.
    pub smoothed: Option<Arc<LinearImage>>,
    /// The part of each pixel that is no interreflection: its edges are sharp.
    pub sharp: Vec<Rgb>,
    /// What the pixels show.
    pub g_buffer: GBuffer,
    /// Work done.
    pub stats: Stats,
}

impl Draft {
    /// The picture for a screen.
    pub(in crate::engine) fn shown(&self) -> &Arc<LinearImage> {
        self.smoothed.as_ref().unwrap_or(&self.image)
    }
}

#[cfg(test)]
impl Draft {
    /// A draft of these pixels, row by row, of which the fraction `sharp` is no interreflection, at this depth.
    pub(super) fn of_pixels(width: u32, pixels: Vec<Rgb>, sharp: f32, depth: f32) -> Self {
        let sharp = pixels.iter().map(|pixel| sharp * *pixel).collect();
        let first_hits = vec![FirstHit { depth, is_matte: true, object: None, facet: None }; pixels.len()];
        let image = LinearImage { width, height: pixels.len() as u32 / width, pixels };
        Self {
            size: DraftSize::FULL,
            smoothed: None,
            sharp,
            g_buffer: GBuffer::of_first_hits([image.width, image.height], first_hits),
            stats: Stats::default(),
            image: Arc::new(image),
        }
    }
}
