//! Rasterization of tessellated patches with a depth test.

use crate::geometry::bezier::ControlNet;
use glam::{DVec2, DVec3, Vec2};

/// Side of a quad of the tessellation, pixels.
const QUAD: f64 = 6.0;
/// The range of quads along a side of a patch.
const QUADS: std::ops::RangeInclusive<f64> = 4.0..=64.0;
/// Barycentric coordinates down to this count as inside, so that no pixel on a common edge of triangles is lost.
const INSIDE: f64 = -1e-9;

/// The point of a patch that a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Fragment {
    pub(super) patch: u32,
    pub(super) uv: Vec2,
    /// The change of u and of v by one pixel to the right, and by one pixel down.
    pub(super) gradients: [Vec2; 2],
}

/// A pixel: the inverse of the depth there, 0 where nothing is, and the fragment if the analysed surface is in front.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
struct Pixel {
    inverse_depth: f32,
    fragment: Option<Fragment>,
}

/// A corner of a triangle: its place in pixels, the inverse of its depth, its parameters.
#[derive(Clone, Copy, Debug)]
struct Corner {
    at: DVec2,
    inverse_depth: f64,
    uv: DVec2,
}

/// The pixels of an image of patches.
#[derive(Debug)]
pub(super) struct Raster {
    pub(super) width: usize,
    pub(super) height: usize,
    pixels: Vec<Pixel>,
}

impl Raster {
    /// A raster without patches.
    pub(super) fn new(width: usize, height: usize) -> Self {
        Self { width, height, pixels: vec![Pixel::default(); width * height] }
    }

    /// The fragment at a pixel, in rows from the top; `None` where the analysed surface is not in front.
    pub(super) fn fragment(&self, index: usize) -> Option<Fragment> {
        self.pixels[index].fragment
    }

    /// Draws a patch in world space: the patch number `patch` of the analysed surface, or with `None` a patch that hides it. `project`
    /// gives the place of a point in pixels and its depth; `None` behind the camera.
    pub(super) fn draw(
        &mut self,
        net: &ControlNet,
        patch: Option<u32>,
        project: impl Fn(DVec3) -> Option<(DVec2, f64)>,
    ) {
        let quads = quads(net, &project);
        let corner = |k: usize| {
            let uv = DVec2::new((k / (quads + 1)) as f64, (k % (quads + 1)) as f64) / quads as f64;
            let (at, depth) = project(net.eval(uv.x, uv.y))?;
            Some(Corner { at, inverse_depth: 1.0 / depth, uv })
        };
        let corners: Vec<Option<Corner>> = (0..(quads + 1) * (quads + 1)).map(corner).collect();
        for k in (0..quads * quads).map(|quad| quad / quads * (quads + 1) + quad % quads) {
            for triangle in [[k, k + 1, k + quads + 1], [k + 1, k + quads + 2, k + quads + 1]] {
                if let [Some(a), Some(b), Some(c)] = triangle.map(|corner| corners[corner]) {
                    self.triangle([a, b, c], patch);
                }
            }
        }
    }

    fn triangle(&mut self, [a, b, c]: [Corner; 3], patch: Option<u32>) {
        let (ab, ac) = (b.at - a.at, c.at - a.at);
        let area = ab.perp_dot(ac);
        if !(area.abs() > 0.0 && area.is_finite()) {
            return;
        }
        // The gradients of the barycentric coordinates of b and c.
        let (to_b, to_c) = (DVec2::new(ac.y, -ac.x) / area, DVec2::new(-ab.y, ab.x) / area);
        let (across_b, across_c) = (b.uv - a.uv, c.uv - a.uv);
        let gradients = [to_b.x * across_b + to_c.x * across_c, to_b.y * across_b + to_c.y * across_c];
        let gradients = gradients.map(|gradient| gradient.as_vec2());
        let (low, high) = (a.at.min(b.at).min(c.at), a.at.max(b.at).max(c.at));
        let range = |low: f64, high: f64, end: usize| {
            (low - 0.5).ceil().clamp(0.0, end as f64) as usize..(high + 0.5).floor().clamp(0.0, end as f64) as usize
        };
        for y in range(low.y, high.y, self.height) {
            for x in range(low.x, high.x, self.width) {
                let offset = DVec2::new(x as f64 + 0.5, y as f64 + 0.5) - a.at;
                let (of_b, of_c) = (to_b.dot(offset), to_c.dot(offset));
                if of_b.min(of_c).min(1.0 - of_b - of_c) < INSIDE {
                    continue;
                }
                let inverse_depth = a.inverse_depth
                    + of_b * (b.inverse_depth - a.inverse_depth)
                    + of_c * (c.inverse_depth - a.inverse_depth);
                let pixel = &mut self.pixels[y * self.width + x];
                let inverse_depth = inverse_depth as f32;
                if inverse_depth > pixel.inverse_depth {
                    let uv = (a.uv + of_b * across_b + of_c * across_c).clamp(DVec2::ZERO, DVec2::ONE).as_vec2();
                    let fragment = patch.map(|patch| Fragment { patch, uv, gradients });
                    *pixel = Pixel { inverse_depth, fragment };
                }
            }
        }
    }
}

/// How many quads along each side a patch needs, by the size of its control net in pixels.
fn quads(net: &ControlNet, project: impl Fn(DVec3) -> Option<(DVec2, f64)>) -> usize {
    let points = || net.points.iter().flatten().filter_map(|point| project(*point)).map(|(at, _)| at);
    let size = points().fold(DVec2::NEG_INFINITY, DVec2::max) - points().fold(DVec2::INFINITY, DVec2::min);
    (size.max_element() / QUAD).clamp(*QUADS.start(), *QUADS.end()) as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::array::from_fn;

    /// A square of side 20 pixels in the plane z, over a film of 32 x 32 pixels, seen without perspective.
    fn square(z: f64) -> ControlNet {
        let at = |k: usize| 6.0 + 20.0 * k as f64 / 3.0;
        ControlNet { points: from_fn(|i| from_fn(|j| DVec3::new(at(i), at(j), z))) }
    }

    fn flat(point: DVec3) -> Option<(DVec2, f64)> {
        Some((point.truncate(), point.z))
    }

    #[test]
    fn each_pixel_shows_its_point_of_the_patch() {
        let mut raster = Raster::new(32, 32);
        raster.draw(&square(5.0), Some(3), flat);
        for index in 0..32 * 32 {
            let at = DVec2::new((index % 32) as f64 + 0.5, (index / 32) as f64 + 0.5);
            let uv = (at - 6.0) / 20.0;
            let inside = uv.min_element() > 0.0 && uv.max_element() < 1.0;
            let found = raster.fragment(index);
            assert_eq!(found.is_some(), inside, "{at}");
            if let Some(Fragment { patch, uv: there, gradients }) = found {
                // Parameters are rounded to f32.
                assert!(patch == 3 && there.distance(uv.as_vec2()) < 1e-6, "{there} at {at}");
                assert!(gradients[0].distance(Vec2::new(0.05, 0.0)) < 1e-6, "u grows to the right");
                assert!(gradients[1].distance(Vec2::new(0.0, 0.05)) < 1e-6, "v grows downwards");
            }
        }
    }

    #[test]
    fn the_nearer_patch_hides_the_farther_one_in_any_order() {
        let center = 16 * 32 + 16;
        for (first, second) in [((5.0, Some(0)), (4.0, None)), ((4.0, None), (5.0, Some(0)))] {
            let mut raster = Raster::new(32, 32);
            for (z, patch) in [first, second] {
                raster.draw(&square(z), patch, flat);
            }
            assert_eq!(raster.fragment(center), None);
        }
        let mut raster = Raster::new(32, 32);
        raster.draw(&square(4.0), Some(1), flat);
        raster.draw(&square(5.0), Some(0), flat);
        assert_eq!(raster.fragment(center).map(|fragment| fragment.patch), Some(1));
    }

    #[test]
    fn points_behind_the_camera_and_points_far_off_the_film_draw_nothing() {
        let mut raster = Raster::new(32, 32);
        raster.draw(&square(5.0), Some(0), |_| None);
        raster.draw(&square(5.0), Some(0), |p| Some((1e12 * p.truncate(), 1.0)));
        raster.draw(&square(5.0), Some(0), |_| Some((DVec2::NAN, f64::NAN)));
        assert!((0..32 * 32).all(|index| raster.fragment(index).is_none()));
    }
}
