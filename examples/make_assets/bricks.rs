//! A wall of bricks: four across, eight rows, every second row moved by half a brick.

use crate::{
    canvas::{hex, smoothstep},
    noise::{cell, fractal},
};
use glam::{DVec2, DVec3, IVec2};

const COLUMNS: f64 = 4.0;
const ROWS: f64 = 8.0;

/// Half the width of the joints, in texture widths.
const HALF_JOINT: f64 = 0.006;

pub(crate) fn color(p: DVec2) -> DVec3 {
    let Brick { id: brick, depth, .. } = brick_at(p);
    let fired = hex(0x7a2f22).lerp(hex(0xc06a4b), cell(brick, 1));
    let fired = fired.lerp(hex(0x5a2a24), 0.45 * fractal(p, IVec2::splat(16), 4, 2));
    let sooty = fired * (0.8 + 0.4 * fractal(p, IVec2::splat(48), 3, 3));
    let mortar = hex(0xb9b0a2) * (0.75 + 0.4 * fractal(p, IVec2::splat(64), 3, 4));
    mortar.lerp(sooty, smoothstep(0.0, 0.004, depth))
}

/// Height in texture widths: rounded bricks, each slightly askew, above rough joints.
pub(crate) fn height(p: DVec2) -> f64 {
    let Brick { id, local, depth } = brick_at(p);
    let lift = 0.0035 * cell(id, 5);
    let slope = 0.05 * (DVec2::new(cell(id, 6), cell(id, 7)) - 0.5);
    let body = smoothstep(-0.001, 0.014, depth);
    let grit = 0.0025 * fractal(p, IVec2::splat(40), 4, 8);
    body * (0.011 + lift + slope.dot(local)) + grit
}

struct Brick {
    id: IVec2,
    /// The point seen from the brick's lower left corner, in texture widths.
    local: DVec2,
    /// The distance of the point from the edge of the brick, in texture widths; below 0 in a joint.
    depth: f64,
}

fn brick_at(p: DVec2) -> Brick {
    let row = (p.y * ROWS).floor();
    let laid = DVec2::new(p.x * COLUMNS + 0.5 * row.rem_euclid(2.0), p.y * ROWS);
    let corner = laid.floor();
    let size = DVec2::new(1.0 / COLUMNS, 1.0 / ROWS);
    let to_edge = (laid - laid.round()).abs() * size;
    Brick {
        id: corner.as_ivec2().rem_euclid(IVec2::new(COLUMNS as i32, ROWS as i32)),
        local: (laid - corner) * size,
        depth: to_edge.min_element() - HALF_JOINT,
    }
}
