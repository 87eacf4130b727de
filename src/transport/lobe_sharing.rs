//! What a Phong lobe shows is found along one path from each pixel in each iteration, and chance says where that goes. Neighbours
//! see much the same in their lobes: so each takes the mean of what all of them found. They are nearer than the lobe blurs even
//! the nearest object, and their normals differ little. How near they are shrinks from iteration to iteration as the discs of
//! density estimates do, so that the blur that this adds vanishes.

use super::Rows;
use super::camera_pass::VisiblePoint;
use super::plan::Plan;
use crate::math::Rgb;
use crate::world::{Lobe, Material, World};
use glam::Vec3;
use rayon::prelude::*;

/// The least cosine between normals of neighbours that share: 2.5 degrees.
const LEAST_COS: f32 = 0.999;

/// What a pixel sees in the lobe of the only surface that it shows.
#[derive(Clone, Copy, Debug)]
pub struct SeenLobe {
    /// Radiance that photons bring to places that are seen in the lobe, as the pixel shows it.
    pub found: Rgb,
    /// Of the point with the lobe, relative to the middle of the world.
    position: Vec3,
    /// Unit normal there.
    normal: Vec3,
    /// First tag of the photons on the same surface and side.
    tag: u32,
    /// How far from there neighbours share, scene units.
    reach: f32,
    /// The same in pixels, where the surface faces the camera.
    window: u32,
}

/// The lobes that pixels of some rows share, row by row, nothing found in them yet. None at edges, where a surface has textures,
/// on patches, whose own curves are near, and where neighbours are too far; an empty list if nothing is gathered or no surface
/// has a lobe that could be shared.
pub fn seen_lobes(
    world: &World,
    plan: &Plan,
    points: &[VisiblePoint],
    rows: &Rows,
    iteration: u64,
) -> Vec<Option<SeenLobe>> {
    if !(plan.shares_lobes && plan.gathers()) {
        return Vec::new();
    }
    let width = plan.camera.width;
    let mut lobes = vec![None; rows.len() * width as usize];
    for point in points.iter().filter(|point| point.seen_directly && !point.on_an_edge) {
        lobes[(point.pixel - rows.start * width) as usize] = seen_lobe(world, plan, point, iteration);
    }
    lobes
}

fn seen_lobe(world: &World, plan: &Plan, point: &VisiblePoint, iteration: u64) -> Option<SeenLobe> {
    let Lobe::Phong { exponent, .. } = point.scattering.lobe else { return None };
    if !world.may_share_lobes(point.primitive) {
        return None;
    }
    let footprint = f64::from(point.footprint);
    let reach = plan.lobe_reach(footprint, point.clearance, exponent, iteration);
    let window = (reach / footprint) as u32;
    (window > 0).then_some(SeenLobe {
        found: Rgb::ZERO,
        position: point.position,
        normal: point.n_side,
        tag: point.tag,
        reach: reach as f32,
        window,
    })
}

/// Adds to each pixel of a film of this width the mean of what was found in its lobe and in those of its neighbours. The lobes
/// are those of bands of whole rows.
pub fn share_lobes<'a>(bands: impl Iterator<Item = &'a [Option<SeenLobe>]>, width: u32, film: &mut [Rgb]) {
    let rows: Vec<_> = bands.flat_map(|lobes| lobes.chunks(width as usize)).collect();
    film.par_chunks_mut(width as usize).zip(0..rows.len()).for_each(|(film, row)| {
        for (column, lobe) in rows[row].iter().enumerate() {
            if let Some(lobe) = lobe {
                film[column] += lobe.mean_around(&rows, row, column);
            }
        }
    });
}

impl SeenLobe {
    /// The mean of what was found in this lobe, in that row and column, and in the others within its reach.
    fn mean_around(&self, rows: &[&[Option<SeenLobe>]], row: usize, column: usize) -> Rgb {
        let around = |middle: usize, end: usize| {
            middle.saturating_sub(self.window as usize)..(middle + self.window as usize + 1).min(end)
        };
        let (mut sum, mut count) = (Rgb::ZERO, 0.0);
        for row in &rows[around(row, rows.len())] {
            for other in row[around(column, row.len())].iter().flatten() {
                if self.is_alike(other) {
                    sum += other.found;
                    count += 1.0;
                }
            }
        }
        // Even a normal that is none makes no number that is none.
        sum / f32::max(count, 1.0)
    }

    fn is_alike(&self, other: &Self) -> bool {
        self.tag == other.tag
            && self.position.distance_squared(other.position) <= self.reach * self.reach
            && self.normal.dot(other.normal) >= LEAST_COS
    }
}

impl World {
    /// Whether all points of a primitive have the same lobe, which neighbours may share.
    pub(super) fn may_share_lobes(&self, primitive: u32) -> bool {
        let uniform = self.material_of(primitive).and_then(Material::uniform);
        uniform.is_some_and(|scattering| matches!(scattering.lobe, Lobe::Phong { .. }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In a row of pixels, a unit from each other on a floor.
    fn lobe(x: f32, tag: u32, reach: f32, found: f32) -> Option<SeenLobe> {
        let position = Vec3::new(x, 0.0, 0.0);
        Some(SeenLobe { found: Rgb::splat(found), position, normal: Vec3::Y, tag, reach, window: reach as u32 })
    }

    fn shared<const N: usize>(lobes: [Option<SeenLobe>; N], width: u32) -> [f32; N] {
        let mut film = [Rgb::ZERO; N];
        share_lobes([lobes.as_slice()].into_iter(), width, &mut film);
        film.map(|radiance| radiance.x)
    }

    #[test]
    fn neighbours_take_the_mean() {
        let row = [lobe(0.0, 0, 1.0, 3.0), lobe(1.0, 0, 1.0, 6.0), lobe(2.0, 0, 1.0, 0.0), lobe(3.0, 0, 0.0, 8.0)];
        assert_eq!(shared(row, 4), [4.5, 3.0, 14.0 / 3.0, 8.0], "each as far as its own reach");
    }

    #[test]
    fn neither_other_surfaces_nor_far_places_count() {
        let row = [lobe(0.0, 0, 1.0, 3.0), lobe(1.0, 8, 1.0, 6.0), None, lobe(3.0, 8, 1.0, 5.0)];
        assert_eq!(shared(row, 4), [3.0, 6.0, 0.0, 5.0]);
        let on_a_bend =
            lobe(1.0, 0, 1.0, 9.0).map(|lobe| SeenLobe { normal: Vec3::new(0.1, 1.0, 0.0).normalize(), ..lobe });
        assert_eq!(shared([lobe(0.0, 0, 1.0, 3.0), on_a_bend], 2), [3.0, 9.0]);
        // A steep surface: the next pixel in the window shows a place beyond the reach.
        assert_eq!(shared([lobe(0.0, 0, 1.0, 3.0), lobe(1.5, 0, 1.0, 6.0)], 2), [3.0, 6.0]);
    }

    #[test]
    fn rows_above_and_below_are_neighbours_too() {
        let at = |x: f32, z: f32, found| {
            lobe(x, 0, 1.0, found).map(|lobe| SeenLobe { position: Vec3::new(x, 0.0, z), ..lobe })
        };
        let film = [at(0.0, 0.0, 2.0), at(1.0, 0.0, 4.0), at(0.0, 1.0, 6.0), at(1.0, 1.0, 8.0)];
        assert_eq!(shared(film, 2), [4.0, 14.0 / 3.0, 16.0 / 3.0, 6.0], "two beside each, none at the diagonal");
    }
}
