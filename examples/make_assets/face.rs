//! A smiling face on a sunny wall, for the back of a room.

use crate::canvas::{hex, smoothstep};
use glam::{DVec2, DVec3};

const CENTER: DVec2 = DVec2::new(0.31, 0.62);
const RADIUS: f64 = 0.25;

pub(crate) fn color(p: DVec2) -> DVec3 {
    let q = (p - CENTER) / RADIUS;
    let mut paint = background(q);
    let mut cover = |shade: DVec3, distance: f64| paint = paint.lerp(shade, 1.0 - smoothstep(-0.004, 0.004, distance));
    let outline = hex(0x3a2a1c);
    cover(outline, q.length() - 1.0);
    cover(
        hex(0xffcf33).lerp(hex(0xf6a81c), smoothstep(0.2, 1.2, (q - DVec2::new(-0.3, 0.35)).length())),
        q.length() - 0.955,
    );
    for side in [-1.0, 1.0] {
        let mirrored = DVec2::new(side * q.x, q.y);
        cover(hex(0xf58f5a), ellipse(mirrored, DVec2::new(0.62, -0.16), DVec2::new(0.17, 0.11)));
        cover(outline, ellipse(mirrored, DVec2::new(0.33, 0.3), DVec2::new(0.115, 0.19)));
        cover(hex(0xffffff), ellipse(q, DVec2::new(side * 0.33 - 0.035, 0.38), DVec2::new(0.04, 0.055)));
    }
    let (mouth, teeth) = mouth(q);
    cover(outline, mouth);
    cover(hex(0xb5382f), mouth + 0.05);
    cover(hex(0xfff7ea), teeth.max(mouth + 0.05));
    paint
}

/// Soft rays around the face.
fn background(q: DVec2) -> DVec3 {
    let rays = (14.0 * q.y.atan2(q.x)).sin();
    let shade = hex(0x6fb7d9).lerp(hex(0x8cc8e3), smoothstep(-0.12, 0.12, rays));
    shade.lerp(hex(0xd8ecf2), 1.0 - smoothstep(0.9, 2.4, q.length()))
}

/// The approximate signed distance from an ellipse, negative inside.
fn ellipse(q: DVec2, center: DVec2, radii: DVec2) -> f64 {
    (((q - center) / radii).length() - 1.0) * radii.min_element()
}

/// The approximate signed distances from an open, laughing mouth and from its upper teeth.
fn mouth(q: DVec2) -> (f64, f64) {
    let below = (q - DVec2::new(0.0, -0.02)).length() - 0.68;
    let lip = q.y + 0.2 - 0.18 * q.x * q.x;
    (below.max(lip), -0.15 - lip)
}
