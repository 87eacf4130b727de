use super::build::LEAF_SIZE;
use super::*;
use crate::math::lanes::{Portable, with_lanes};
use crate::math::{LANES, Lanes, Rgb, Sampler, Stream};
use crate::transport::photons::{CosineCorrection, Photon};
use crate::transport::points::Facet;
use glam::Vec3;

fn photons(count: u64, distribution: impl Fn(&mut Sampler) -> Vec3) -> Vec<Photon> {
    (0..count)
        .map(|k| {
            let mut s = Sampler::new(1, Stream::Camera, 77, k);
            let position = distribution(&mut s);
            let flux = Rgb::new(1.0, s.next_1d() as f32, 0.5);
            let wi = Vec3::new(s.next_1d() as f32 - 0.5, 1.0, 0.3).normalize();
            Photon { position, flux, wi, cos: wi.y, tag: (k % 3) as u32 }
        })
        .collect()
}

/// Sums of kernel times flux, without and with the cosine correction.
fn brute_force(photons: &[Photon], query: &Query, n_shade: Vec3) -> [Rgb; 2] {
    let mut sums = [Rgb::ZERO; 2];
    for photon in photons {
        let offset = photon.position - query.position;
        let weight = 1.0 - offset.length_squared() / (query.radius * query.radius);
        let near_plane = offset.dot(query.normal).abs() < Query::SLAB * query.radius;
        let tagged = photon.tag >= query.tag_start && photon.tag < query.tag_start + query.tag_span;
        if weight > 0.0 && near_plane && tagged {
            let weight = weight * (1.0 + query.slope.dot(offset));
            sums[0] += weight * photon.flux;
            sums[1] += weight * photon.flux * (photon.wi.dot(n_shade) / photon.wi.dot(query.normal)).clamp(0.0, 1.1);
        }
    }
    sums
}

fn check_sums<L: Lanes>(l: L) {
    let unit = |s: &mut Sampler| Vec3::new(s.next_1d() as f32, s.next_1d() as f32, s.next_1d() as f32);
    let plane = |s: &mut Sampler| Vec3::new(s.next_1d() as f32, 0.25, s.next_1d() as f32);
    let line = |s: &mut Sampler| Vec3::new(0.0, 1e-3 * s.next_1d() as f32, 0.0);
    let point = |_: &mut Sampler| Vec3::splat(0.5);
    // A far one puts all others into one cell of the grid.
    let far = |s: &mut Sampler| if s.next_1d() < 0.01 { 1e7 * unit(s) } else { unit(s) };
    let distributions: [&dyn Fn(&mut Sampler) -> Vec3; 5] = [&unit, &plane, &line, &point, &far];
    let mut stack = Stack::new();
    let n_shade = Vec3::new(0.5, 1.0, 0.0).normalize();
    for (distribution, count) in distributions.into_iter().flat_map(|p| [0, 1, 7, 16, 17, 4000].map(|n| (p, n))) {
        let photons = photons(count, distribution);
        let map = PhotonMap::build(&photons);
        assert_eq!(map.len(), photons.len());
        let most = map.nodes.iter().flat_map(|node| node.blocks).max().unwrap_or(0) as usize;
        let in_one_place = photons.iter().all(|p| p.position == photons[0].position);
        assert!(most <= LEAF_SIZE / LANES || in_one_place, "{most} blocks in a leaf");
        for k in 0..50 {
            let mut s = Sampler::new(2, Stream::Camera, 5, k);
            let position = distribution(&mut s);
            let radius = 0.3 * s.next_1d() as f32;
            for (tag_start, tag_span) in [(1, 2), (0, 3)] {
                let slope = [Vec3::ZERO, Vec3::new(3.0, 0.0, -2.0)][tag_start as usize % 2];
                let query = Query { position, normal: Vec3::Y, radius, slope, tag_start, tag_span };
                let [expected, corrected] = brute_force(&photons, &query, n_shade);
                // Sums of up to 4000 terms of size 1 in another order: 4000 roundings of 6e-8 of the sum at most.
                let near = |a: Rgb, b: Rgb| (a - b).abs().max_element() <= 3e-4 * (1.0 + b.max_element());
                let found = map.sum_flux(l, &query, &mut stack);
                assert!(near(found, expected), "{found} against {expected}");
                let mut by_visit = Rgb::ZERO;
                let flat = CosineCorrection { normal: Vec3::Y, limit: 1.1, curvature: 0.0 };
                map.for_each(l, &query, &flat, &mut stack, |weight, photon| by_visit += weight * photon.flux);
                assert!(near(by_visit, expected), "{by_visit} against {expected}");
                let mut squares = Rgb::ZERO;
                map.for_each(l, &query, &flat, &mut stack, |weight, photon| {
                    squares += (weight * photon.flux).powf(2.0)
                });
                let found = map.sum_squares(l, &query, &mut stack);
                assert!(near(found, squares), "{found} against {squares}");
                let found =
                    map.sum_corrected_flux(l, &query, &CosineCorrection { normal: n_shade, ..flat }, &mut stack);
                assert!(near(found, corrected), "{found} against {corrected}");
                let (red, blue) = (Rgb::new(0.5, 0.0, 0.0), Rgb::new(0.25, 0.0, 1.0));
                let facet = |normal, albedo| Facet { normal, albedo, tag: 0, position: Vec3::ZERO };
                let facets = [facet(Vec3::Y, red), facet(n_shade, blue)];
                let found = map.sum_faceted_flux(l, &query, &flat, &facets, &mut stack);
                assert!(near(found, expected * red + corrected * blue), "{found} of two facets");
            }
        }
    }
}

#[test]
fn sums_equal_the_sums_of_a_linear_scan() {
    check_sums(Portable);
    with_lanes!(widest => check_sums(widest));
}
