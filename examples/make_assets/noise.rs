use glam::{DVec2, IVec2};

/// A hashed number in `[0, 1)` for a cell of an integer grid (the finaliser of MurmurHash3).
pub(crate) fn cell(at: IVec2, seed: u32) -> f64 {
    let mut h = (at.x as u32).wrapping_mul(0x9e37_79b1)
        ^ (at.y as u32).wrapping_mul(0x85eb_ca77)
        ^ seed.wrapping_mul(0xc2b2_ae3d);
    h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    f64::from(h ^ (h >> 16)) / 4_294_967_296.0
}

/// Smooth, periodic noise in `[0, 1]` over the unit square, with `cells` cells along u and v.
pub(crate) fn smooth(p: DVec2, cells: IVec2, seed: u32) -> f64 {
    let scaled = p * cells.as_dvec2();
    let corner = scaled.floor();
    let t = scaled - corner;
    let t = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let value = |dx, dy| cell((corner.as_ivec2() + IVec2::new(dx, dy)).rem_euclid(cells), seed);
    let bottom = value(0, 0) + (value(1, 0) - value(0, 0)) * t.x;
    let top = value(0, 1) + (value(1, 1) - value(0, 1)) * t.x;
    bottom + (top - bottom) * t.y
}

/// A sum of octaves of smooth noise, each twice as fine and half as strong as the previous; in `[0, 1]`, mostly near 1/2.
pub(crate) fn fractal(p: DVec2, cells: IVec2, octaves: u32, seed: u32) -> f64 {
    let sum: f64 = (0..octaves).map(|k| 0.5f64.powi(k as i32) * smooth(p, cells * (1 << k), seed + k)).sum();
    sum / (2.0 - 0.5f64.powi(octaves as i32 - 1))
}
