//! Spatial reuse of Phong lobe samples. In each iteration one random camera path of each pixel samples the light in its lobe. The lobes of
//! neighbours show similar light, so each pixel takes the mean over its neighbours' samples. Neighbours have similar normals, and are
//! nearer than the distance over which the lobe blurs the nearest object. The greatest distance of a neighbour shrinks with the
//! iterations, so that the added blur vanishes.

use super::input::PassInput;
use super::lobe_sample::LobeSample;
use crate::math::Rgb;
use crate::transport::pass::Rows;
use crate::transport::points::{LEAST_COS_OF_NEIGHBOURS, VisiblePoint};
use crate::world::Lobe;
use rayon::prelude::*;

/// The lobe samples of some rows, row by row, without radiance yet. `None` at edges, on textured surfaces, on patches, whose own curves
/// are near, and where even adjacent pixels are too far; an empty list where no photons are gathered or no surface has a uniform lobe.
pub fn lobe_samples(input: &PassInput, points: &[VisiblePoint], rows: &Rows) -> Vec<Option<LobeSample>> {
    let plan = input.plan;
    if !(plan.reuses_lobes && plan.gathers()) {
        return Vec::new();
    }
    let width = plan.camera.width;
    let mut lobes = vec![None; rows.len() * width as usize];
    for point in points.iter().filter(|point| point.seen_directly && !point.on_an_edge) {
        lobes[(point.pixel - rows.start * width) as usize] = lobe_sample(input, point);
    }
    lobes
}

fn lobe_sample(input: &PassInput, point: &VisiblePoint) -> Option<LobeSample> {
    let Lobe::Phong { exponent, .. } = point.scattering.lobe else { return None };
    if !input.world.has_uniform_lobe(point.primitive) {
        return None;
    }
    let footprint = f64::from(point.footprint);
    let reuse_distance = input.plan.reuse_distance(footprint, point.clearance, exponent, input.iteration);
    let window = (reuse_distance / footprint) as u32;
    (window > 0).then_some(LobeSample {
        radiance: Rgb::ZERO,
        position: point.position,
        normal: point.n_side,
        tag: point.tag,
        reuse_distance: reuse_distance as f32,
        window,
    })
}

/// Adds to each pixel of a film of this width the mean over the lobe samples of the pixel and its neighbours. The samples come in bands of
/// whole rows.
pub(super) fn reuse_lobes<'a>(bands: impl Iterator<Item = &'a [Option<LobeSample>]>, width: u32, film: &mut [Rgb]) {
    let rows: Vec<_> = bands.flat_map(|lobes| lobes.chunks(width as usize)).collect();
    film.par_chunks_mut(width as usize).zip(0..rows.len()).for_each(|(film, row)| {
        for (column, lobe) in rows[row].iter().enumerate() {
            if let Some(lobe) = lobe {
                film[column] += lobe.mean_around(&rows, row, column);
            }
        }
    });
}

impl LobeSample {
    /// The mean radiance of this sample, at that row and column, and its neighbours.
    fn mean_around(&self, rows: &[&[Option<LobeSample>]], row: usize, column: usize) -> Rgb {
        let around = |middle: usize, end: usize| {
            middle.saturating_sub(self.window as usize)..(middle + self.window as usize + 1).min(end)
        };
        let (mut sum, mut count) = (Rgb::ZERO, 0.0);
        for row in &rows[around(row, rows.len())] {
            for other in row[around(column, row.len())].iter().flatten() {
                if self.is_neighbour(other) {
                    sum += other.radiance;
                    count += 1.0;
                }
            }
        }
        // A degenerate normal must not yield NaN: then not even the sample itself counts.
        sum / f32::max(count, 1.0)
    }

    fn is_neighbour(&self, other: &Self) -> bool {
        self.tag == other.tag
            && self.position.distance_squared(other.position) <= self.reuse_distance * self.reuse_distance
            && self.normal.dot(other.normal) >= LEAST_COS_OF_NEIGHBOURS
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    /// In a row of pixels, a unit from each other on a floor.
    fn lobe(x: f32, tag: u32, reuse_distance: f32, found: f32) -> Option<LobeSample> {
        let position = Vec3::new(x, 0.0, 0.0);
        Some(LobeSample {
            radiance: Rgb::splat(found),
            position,
            normal: Vec3::Y,
            tag,
            reuse_distance,
            window: reuse_distance as u32,
        })
    }

    fn reused<const N: usize>(lobes: [Option<LobeSample>; N], width: u32) -> [f32; N] {
        let mut film = [Rgb::ZERO; N];
        reuse_lobes([lobes.as_slice()].into_iter(), width, &mut film);
        film.map(|radiance| radiance.x)
    }

    #[test]
    fn neighbours_take_the_mean() {
        let row = [lobe(0.0, 0, 1.0, 3.0), lobe(1.0, 0, 1.0, 6.0), lobe(2.0, 0, 1.0, 0.0), lobe(3.0, 0, 0.0, 8.0)];
        assert_eq!(reused(row, 4), [4.5, 3.0, 14.0 / 3.0, 8.0], "each within its own distance");
    }

    #[test]
    fn neither_other_surfaces_nor_far_points_count() {
        let row = [lobe(0.0, 0, 1.0, 3.0), lobe(1.0, 8, 1.0, 6.0), None, lobe(3.0, 8, 1.0, 5.0)];
        assert_eq!(reused(row, 4), [3.0, 6.0, 0.0, 5.0]);
        let on_a_bend =
            lobe(1.0, 0, 1.0, 9.0).map(|lobe| LobeSample { normal: Vec3::new(0.1, 1.0, 0.0).normalize(), ..lobe });
        assert_eq!(reused([lobe(0.0, 0, 1.0, 3.0), on_a_bend], 2), [3.0, 9.0]);
        // A steep surface: the next pixel in the window shows a point beyond the distance.
        assert_eq!(reused([lobe(0.0, 0, 1.0, 3.0), lobe(1.5, 0, 1.0, 6.0)], 2), [3.0, 6.0]);
    }

    #[test]
    fn rows_above_and_below_are_neighbours_too() {
        let at = |x: f32, z: f32, found| {
            lobe(x, 0, 1.0, found).map(|lobe| LobeSample { position: Vec3::new(x, 0.0, z), ..lobe })
        };
        let film = [at(0.0, 0.0, 2.0), at(1.0, 0.0, 4.0), at(0.0, 1.0, 6.0), at(1.0, 1.0, 8.0)];
        assert_eq!(reused(film, 2), [4.0, 14.0 / 3.0, 16.0 / 3.0, 6.0], "two beside each, none at the diagonal");
    }
}
