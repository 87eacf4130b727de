//! Rough plaster, as thrown on with a trowel.

use crate::{
    canvas::smoothstep,
    noise::{fractal, smooth},
};
use glam::{DVec2, IVec2};

/// Height in texture widths.
pub(crate) fn height(p: DVec2) -> f64 {
    let bent = p + 0.03 * DVec2::new(smooth(p, IVec2::splat(9), 1), smooth(p, IVec2::splat(9), 2));
    let lumps = smoothstep(0.38, 0.62, fractal(bent, IVec2::splat(14), 2, 3));
    let grain = fractal(p, IVec2::splat(40), 3, 7);
    0.014 * lumps + 0.008 * grain
}
