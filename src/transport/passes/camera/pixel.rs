use crate::math::Rgb;
use crate::transport::density::sample_allocation::MOST_SAMPLES;
use crate::transport::points::{Facet, VisiblePoint, bsdf};
use arrayvec::ArrayVec;
use glam::Vec2;

/// The first vertices of the paths of one pixel.
pub(super) struct Pixel {
    /// Row by row from the top of the film.
    pub(super) index: u32,
    /// Where the present path crosses the pixel, from 0 to 1 each way.
    pub(super) position: Vec2,
    /// Whether any of the first vertices has a texture.
    pub(super) is_textured: bool,
    facets: ArrayVec<Facet, MOST_SAMPLES>,
    has_relief: bool,
}

impl Pixel {
    /// A pixel without paths.
    pub(super) fn new() -> Self {
        Self { index: 0, position: Vec2::ZERO, is_textured: false, facets: ArrayVec::new(), has_relief: false }
    }

    /// Begins another pixel.
    #[inline]
    pub(super) fn begin(&mut self, index: u32) {
        self.index = index;
        self.facets.clear();
        (self.has_relief, self.is_textured) = (false, false);
    }

    /// Adds the first vertex of a path.
    #[inline]
    pub(super) fn add(&mut self, facet: Facet, has_relief: bool) {
        self.facets.push(facet);
        self.has_relief |= has_relief;
    }

    /// The surface that the first path of the pixel met, if that was not a lamp.
    #[inline]
    pub(super) fn first_facet(&self) -> Option<Facet> {
        self.facets.first().copied()
    }

    /// Completes the visible points of the pixel, from `first` on, and adds their facets. Where all paths met one surface first, its albedo
    /// and relief at all of their first vertices count: albedo and relief at one point of the pixel would be noise.
    #[inline]
    pub(super) fn complete(
        &self,
        points: &mut Vec<VisiblePoint>,
        facets: &mut Vec<Facet>,
        first: usize,
        on_an_edge: bool,
    ) {
        for k in (first..points.len()).rev() {
            let point = &mut points[k];
            point.on_an_edge = on_an_edge;
            if point.seen_directly && !on_an_edge {
                self.add_facets(point, facets);
            }
            if point.mean_albedo == Rgb::ZERO && !bsdf::scatters(&point.scattering) {
                points.swap_remove(k);
            }
        }
    }

    fn add_facets(&self, point: &mut VisiblePoint, facets: &mut Vec<Facet>) {
        let same_surface = self.facets.iter().filter(|facet| facet.tag == point.tag);
        let (count, sum) = same_surface.clone().fold((0.0, Rgb::ZERO), |(n, sum), facet| (n + 1.0, sum + facet.albedo));
        point.mean_albedo = sum / f32::max(count, 1.0);
        let distances = same_surface.clone().map(|facet| facet.position.distance(point.position));
        point.spread = distances.fold(0.0, f32::max);
        if self.has_relief && sum != Rgb::ZERO {
            point.first_facet = facets.len() as u32;
            facets.extend(same_surface);
            point.facets = facets.len() as u32 - point.first_facet;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::testing::visible_point;
    use crate::world::{Lobe, Scattering};
    use glam::Vec3;

    fn facet(tag: u32, x: f32, albedo: f32) -> Facet {
        Facet { normal: Vec3::Y, albedo: Rgb::splat(albedo), tag, position: Vec3::new(x, 0.0, 0.0) }
    }

    fn completed(pixel: &Pixel, points: &[VisiblePoint], on_an_edge: bool) -> (Vec<VisiblePoint>, Vec<Facet>) {
        let (mut points, mut facets) = (points.to_vec(), vec![facet(99, 0.0, 0.0)]);
        pixel.complete(&mut points, &mut facets, 0, on_an_edge);
        (points, facets)
    }

    #[test]
    fn albedo_and_spread_count_all_paths_on_the_surface() {
        let mut pixel = Pixel::new();
        for facet in [facet(0, -0.2, 0.2), facet(0, 0.3, 0.6), facet(8, 5.0, 1.0)] {
            pixel.add(facet, false);
        }
        let (points, facets) = completed(&pixel, &[visible_point()], false);
        assert!((points[0].mean_albedo - Rgb::splat(0.4)).length() < 1e-6, "{}", points[0].mean_albedo);
        assert_eq!((points[0].spread, points[0].facets, facets.len()), (0.3, 0, 1), "no relief, no facets");
        let (points, _) = completed(&pixel, &[visible_point()], true);
        assert!(
            points[0].on_an_edge && points[0].mean_albedo == Rgb::ONE,
            "at an edge each point keeps its own albedo"
        );
        let in_a_mirror = VisiblePoint { seen_directly: false, ..visible_point() };
        assert_eq!(completed(&pixel, &[in_a_mirror], false).0[0].mean_albedo, Rgb::ONE);
    }

    #[test]
    fn relief_leaves_the_facets_of_the_surface() {
        let mut pixel = Pixel::new();
        pixel.add(facet(0, 0.0, 0.2), true);
        pixel.add(facet(8, 0.0, 0.4), false);
        pixel.add(facet(0, 0.0, 0.6), false);
        let (points, facets) = completed(&pixel, &[visible_point()], false);
        let own = &facets[points[0].first_facet as usize..][..points[0].facets as usize];
        assert_eq!(own.iter().map(|facet| facet.albedo.x).collect::<Vec<_>>(), [0.2, 0.6]);
        pixel.begin(1);
        pixel.add(facet(0, 0.0, 0.5), false);
        assert_eq!(completed(&pixel, &[visible_point()], false).0[0].facets, 0, "the next pixel begins afresh");
    }

    /// Of a texture that is black at the visible point the other paths may have seen a brighter texel.
    #[test]
    fn points_that_reflect_nothing_are_dropped() {
        let black = Scattering { albedo: Rgb::ZERO, lobe: Lobe::None };
        let point = |pixel| VisiblePoint { pixel, scattering: black, ..visible_point() };
        let mut pixel = Pixel::new();
        pixel.add(facet(0, 0.0, 0.0), false);
        assert!(completed(&pixel, &[point(0)], false).0.is_empty());
        pixel.add(facet(0, 0.0, 0.5), false);
        assert_eq!(completed(&pixel, &[point(0)], false).0[0].mean_albedo, Rgb::splat(0.25));
    }
}
