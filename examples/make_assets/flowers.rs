//! Flowers and leaves on blue cloth.

use crate::{
    canvas::{hex, smoothstep},
    noise::{cell, smooth},
};
use glam::{DVec2, DVec3, IVec2};
use std::f64::consts::TAU;

/// Cells along each side, each with one large flower.
const CELLS: i32 = 4;

/// Petals and heart.
const COLORS: [(u32, u32); 4] =
    [(0xf9f4ea, 0xf2b632), (0xf0567a, 0xfbe08a), (0xffc53d, 0x9b4a1c), (0xf58a4b, 0x5c2a4d)];

pub(crate) fn color(p: DVec2) -> DVec3 {
    let weave = smooth(p, IVec2::new(192, 192), 9);
    let mut paint = hex(0x1d3f72) * (0.85 + 0.3 * weave);
    let scaled = p * f64::from(CELLS);
    let here = scaled.floor().as_ivec2();
    for layer in [leaf, bud, flower] {
        for neighbour in 0..9 {
            let cell = here + IVec2::new(neighbour % 3 - 1, neighbour / 3 - 1);
            let id = cell.rem_euclid(IVec2::splat(CELLS));
            layer(scaled - cell.as_dvec2(), id, &mut paint);
        }
    }
    paint
}

/// Paints over the colour where `inside` is above 0.
fn cover(paint: &mut DVec3, shade: DVec3, inside: f64) {
    *paint = paint.lerp(shade, smoothstep(-0.006, 0.006, inside));
}

fn center(id: IVec2) -> DVec2 {
    DVec2::new(0.5, 0.5) + 0.3 * (DVec2::new(cell(id, 1), cell(id, 2)) - 0.5)
}

fn flower(q: DVec2, id: IVec2, paint: &mut DVec3) {
    let d = q - center(id);
    let (r, angle) = (d.length(), d.y.atan2(d.x) + TAU * cell(id, 3));
    let size = 0.34 + 0.09 * cell(id, 4);
    let petals = 5.0 + (2.0 * cell(id, 5)).floor();
    let (petal, heart) = COLORS[((id.x + 2 * id.y + id.y / 2).rem_euclid(4)) as usize];
    let wave = (0.5 * petals * angle).cos().abs();
    let edge = size * (0.52 + 0.48 * wave.powf(0.6));
    let shade = hex(petal) * (0.62 + 0.38 * smoothstep(0.0, 0.9, wave) * smoothstep(0.0, 1.2, r / size + 0.35));
    cover(paint, hex(petal) * 0.3, edge + 0.012 - r);
    cover(paint, shade, edge - r);
    cover(paint, hex(heart) * 0.6, 0.30 * size - r);
    cover(paint, hex(heart), 0.25 * size - r);
}

/// Two leaves that look out from under a flower.
fn leaf(q: DVec2, id: IVec2, paint: &mut DVec3) {
    for side in [0.0, 0.42] {
        let angle = TAU * (cell(id, 6) + side);
        let along = DVec2::from_angle(angle);
        let d = q - center(id) - 0.36 * along;
        let (x, y) = (d.dot(along) / 0.2, d.dot(along.perp()) / 0.085);
        let inside = 0.085 * (1.0 - x * x - y.abs());
        cover(paint, hex(0x2c7a4b), inside);
        cover(paint, hex(0x8fc98b), (0.006 - d.dot(along.perp()).abs()).min(inside - 0.01));
    }
}

/// A small bud between the flowers.
fn bud(q: DVec2, id: IVec2, paint: &mut DVec3) {
    let d = q - DVec2::new(0.02, 0.0) - 0.12 * (DVec2::new(cell(id, 7), cell(id, 8)) - 0.5);
    let angle = d.y.atan2(d.x) + TAU * cell(id, 9);
    let edge = 0.095 * (0.7 + 0.3 * (2.0 * angle).cos().abs());
    cover(paint, hex(0x9ed3ea), edge - d.length());
    cover(paint, hex(0xfdf6d8), 0.035 - d.length());
}
