//! How well quadrilaterals follow the map from direction to landing place.

use super::landing::Landing;
use crate::world::Camera;
use glam::DVec3;

/// Greatest distance of a landing place from where the corners of its block say, pixels. The four cells of the block are four times as near.
const TOLERANCE: f64 = 1.0;
/// The same for blocks that cannot be divided: light is blurred by less than that much, which photons would show as noise.
const LAST_TOLERANCE: f64 = 6.0;
/// Greatest ratio between the areas of the four cells of a block: within each the irradiance counts as even.
const AREA_RATIO: f64 = 1.12;
/// The same distance and ratio for blocks of which one cell takes the place of four.
const FLAT_TOLERANCE: f64 = 0.25;
const FLAT_AREA_RATIO: f64 = 1.03;
/// Extent of a block, pixels, up to which the areas of its cells do not matter if its landing places deviate so much less. At a fold the light
/// ends where it is brightest, beyond the corners of the cells: the deviation shifts that edge.
const SMALL_BLOCK: f64 = 2.0;
const SMALL_TOLERANCE: f64 = 0.0625;

/// Nine landings of one sheet, row by row over a block of four cells.
pub(super) type Nine<'a> = [&'a Landing; 9];

/// How far a block is smooth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Smoothness {
    /// Cells would show where the light is not.
    Rough,
    /// As smooth as cells of the least size have to be.
    Fair,
    /// Four cells follow the light.
    Smooth,
    /// One cell follows the light.
    Flat,
}

/// How far a block is smooth, as the camera would see it.
pub(super) fn of_block(camera: &Camera, nine: &Nine) -> Smoothness {
    let p = nine.map(|landing| landing.position);
    let pixel = pixel_at(camera, p[4]);
    let mean = |points: &[usize]| points.iter().map(|&k| p[k]).sum::<DVec3>() / points.len() as f64;
    let straight =
        [(1, mean(&[0, 2])), (3, mean(&[0, 6])), (5, mean(&[2, 8])), (7, mean(&[6, 8])), (4, mean(&[0, 2, 6, 8]))];
    let deviation = straight.map(|(k, expected)| p[k].distance(expected)).into_iter().fold(0.0, f64::max);
    if !(deviation <= LAST_TOLERANCE * pixel) {
        return Smoothness::Rough;
    }
    let extent = [0, 2, 6, 8].map(|k| p[k].distance(p[4])).into_iter().fold(0.0, f64::max);
    let ratio = area_ratio(&p);
    let is_small = |tolerance| extent <= SMALL_BLOCK * pixel && deviation <= SMALL_TOLERANCE * tolerance * pixel;
    if deviation <= FLAT_TOLERANCE * pixel && (ratio <= FLAT_AREA_RATIO || is_small(FLAT_TOLERANCE)) {
        Smoothness::Flat
    } else if deviation <= TOLERANCE * pixel && (ratio <= AREA_RATIO || is_small(TOLERANCE)) {
        Smoothness::Smooth
    } else {
        Smoothness::Fair
    }
}

/// Whether a cell of the least size, whose block is not of one sheet, is a parallelogram as far as a pixel tells.
pub(super) fn is_fair_cell(camera: &Camera, corners: &[&Landing; 4]) -> bool {
    let [a, b, c, d] = corners.map(|landing| landing.position);
    let extent = a.distance(c).max(b.distance(d));
    let twist = (a - b + c - d).length();
    // The twist of a whole block is four times that of a cell, its deviation a quarter of its twist.
    twist <= LAST_TOLERANCE * pixel_at(camera, a) && twist <= 0.5 * extent
}

fn pixel_at(camera: &Camera, position: DVec3) -> f64 {
    camera.footprint(camera.position.distance(position))
}

/// The greatest ratio between the areas of the four cells of a block; infinite where they differ in orientation: a fold has light on one side
/// only.
fn area_ratio(p: &[DVec3; 9]) -> f64 {
    let whole = (p[8] - p[0]).cross(p[6] - p[2]);
    let area = |k: usize| (p[k + 4] - p[k]).cross(p[k + 3] - p[k + 1]).dot(whole);
    let areas = [0, 1, 3, 4].map(area);
    let (least, most) =
        areas.iter().fold((f64::INFINITY, 0.0f64), |(least, most), &area| (least.min(area), most.max(area)));
    if least > 0.0 { most / least } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Rgb;
    use crate::scene;
    use crate::transport::photons::Signature;
    use glam::{DVec2, Vec3};

    /// A camera at distance 10, of which a pixel shows 0.01.
    fn camera() -> Camera {
        let camera = scene::Camera { position: DVec3::Z * 10.0, target: DVec3::ZERO, ..Default::default() };
        let wide = Camera::new(&camera, 100, 100);
        let pixels = (100.0 * wide.footprint(10.0) / 0.01).round() as u32;
        wide.resized(pixels, pixels)
    }

    /// The smoothness of a block of this size for a map from 0 to 1 each way.
    fn smoothness(size: f64, map: impl Fn(DVec2) -> DVec2) -> Smoothness {
        let landings: [Landing; 9] = std::array::from_fn(|k| Landing {
            signature: Signature::default(),
            position: (size * map(DVec2::new((k % 3) as f64, (k / 3) as f64) / 2.0)).extend(0.0),
            wi: Vec3::Z,
            flux: Rgb::ONE,
            share: 1.0,
            tag: 0,
            primitive: 0,
        });
        of_block(&camera(), &landings.each_ref())
    }

    #[test]
    fn one_cell_follows_a_linear_map_and_four_a_slightly_bent_one() {
        assert_eq!(smoothness(0.5, |p| p + 0.3 * DVec2::new(p.y, p.x)), Smoothness::Flat);
        let bent = |amount: f64| move |p: DVec2| p + amount * p * p;
        assert_eq!(smoothness(0.2, bent(0.05)), Smoothness::Smooth);
        assert_eq!(smoothness(0.2, bent(0.5)), Smoothness::Fair);
        assert_eq!(smoothness(2.0, bent(0.5)), Smoothness::Rough);
        assert_eq!(smoothness(0.01, bent(0.5)), Smoothness::Fair, "the size of a pixel");
        assert_eq!(smoothness(0.0005, bent(0.5)), Smoothness::Flat, "much smaller than a pixel");
    }

    #[test]
    fn a_fold_is_not_smooth_and_a_jump_is_rough() {
        let fold = |p: DVec2| DVec2::new(p.x, (p.y - 0.4).powi(2));
        assert_eq!(smoothness(0.1, fold), Smoothness::Fair);
        assert_eq!(smoothness(0.2, |p| if p.x > 0.6 { p + 5.0 } else { p }), Smoothness::Rough);
        assert_eq!(smoothness(0.2, |_| DVec2::NAN), Smoothness::Rough);
    }
}
