//! Small pool tiles in four blues.

use crate::{
    canvas::{hex, smoothstep},
    noise::{cell, smooth},
};
use glam::{DVec2, DVec3, IVec2};

const ACROSS: f64 = 8.0;

pub(crate) fn color(p: DVec2) -> DVec3 {
    let scaled = p * ACROSS;
    let tile = scaled.floor().as_ivec2().rem_euclid(IVec2::splat(ACROSS as i32));
    let shades = [0x8fd3e0, 0xa9e0e6, 0x78c2d6, 0xc4ecec];
    let glaze = hex(shades[(cell(tile, 1) * 4.0) as usize]) * (0.92 + 0.16 * smooth(p, IVec2::splat(32), 2));
    let edge = (scaled - scaled.round()).abs().min_element();
    hex(0xe9ece6).lerp(glaze, smoothstep(0.035, 0.055, edge))
}
