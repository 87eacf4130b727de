//! A floor of oak planks, eight across, their ends at random heights.

use crate::{
    canvas::{hex, smoothstep},
    noise::{cell, fractal, smooth},
};
use glam::{DVec2, DVec3, IVec2};

const ACROSS: i32 = 8;

pub(crate) fn color(p: DVec2) -> DVec3 {
    let across = p.x * f64::from(ACROSS);
    let column = across.floor() as i32;
    // Two planks a column; the first begins at a random height.
    let along = 2.0 * (p.y + cell(IVec2::new(column, 0), 1));
    let plank = IVec2::new(column, (along.floor() as i32).rem_euclid(2));
    let tone = cell(plank, 2);
    let base = hex(0x7d4f2c).lerp(hex(0xc99a62), 0.15 + 0.7 * tone);
    let wood = base.lerp(base * DVec3::new(0.42, 0.34, 0.28), 0.75 * grain(p, plank));
    wood * (1.0 - 0.85 * gap(across, along))
}

/// Dark streaks along the plank, in `[0, 1]`, different on each plank.
fn grain(p: DVec2, plank: IVec2) -> f64 {
    let moved = p + DVec2::new(cell(plank, 3), cell(plank, 4));
    let bend = 0.05 * fractal(moved, IVec2::new(8, 3), 3, 10);
    let bent = moved + DVec2::new(bend, 0.0);
    let rings = (bent.x * 260.0 + 9.0 * fractal(moved, IVec2::new(16, 2), 2, 20)).sin();
    let fibres = smooth(bent, IVec2::new(300, 6), 30);
    let patches = fractal(moved, IVec2::new(24, 4), 2, 40);
    (0.25 + 0.2 * rings) * patches * 1.6 + 0.35 * fibres * patches
}

/// The weight of the dark gap between planks at a point, in `[0, 1]`.
fn gap(across: f64, along: f64) -> f64 {
    let edge = |x: f64| (x - x.round()).abs();
    let sides = 1.0 - smoothstep(0.012, 0.03, edge(across));
    let ends = 1.0 - smoothstep(0.003, 0.008, edge(along));
    sides.max(ends)
}
