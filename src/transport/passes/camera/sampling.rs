//! All camera samples of a pixel in an iteration, pixel by pixel.

use super::batch::CameraBatch;
use super::first_hit::FirstHit;
use super::pixel::Pixel;
use super::tracer::CameraTracer;
use crate::geometry::Hit;
use crate::math::{LANES, Ray, Sampler, Stream};
use crate::transport::density::PixelSamples;
use crate::transport::pass::Rows;
use crate::transport::passes::input::PassInput;
use glam::{DVec2, Vec2};
use std::ops::Range;

/// Samples of a pixel that gather photons where the pixel shows different surfaces: one would leave jagged edges, and density
/// estimates are most of a pixel's work.
const SAMPLES_OF_EDGE: usize = 4;
/// Columns of a tile; it has all rows of the pass. In a wider tile the photons near one row have left the cache at the next row; a narrower
/// tile leaves more first rays over from packets, whose rays are of one row of a tile.
const TILE: u32 = 16;

/// The camera samples of an iteration for every pixel of some rows, and the visible points that they leave; `None` when
/// cancelled. The pass goes tile by tile: successive visible points are near each other, and so are their photons in memory.
pub fn camera_pass(input: &PassInput, rows: &Rows) -> Option<CameraBatch> {
    let PassInput { world, plan, iteration, .. } = *input;
    let width = plan.camera.width;
    let pixels = rows.len() * width as usize;
    let samples = vec![PixelSamples::default(); pixels];
    let first_hits = if input.wants_first_hits() { vec![FirstHit::NONE; pixels] } else { Vec::new() };
    let batch = CameraBatch { samples, first_hits, ..CameraBatch::default() };
    let mut tracer = CameraTracer::new(world, plan, batch);
    let mut pixel = Pixel::new();
    for left in (0..width).step_by(TILE as usize) {
        if input.cancel.is_cancelled() {
            return None;
        }
        for row in rows.clone() {
            let columns = left..(left + TILE).min(width);
            let mut first_rays = trace_first_rays(input, row, columns.clone());
            tracer.batch.counters.rays += first_rays.len() as u64;
            let mut rest = first_rays.as_mut_slice();
            for column in columns {
                pixel.begin(row * width + column);
                let count = plan.camera_samples(pixel.index, iteration).count();
                let own = rest.split_off_mut(..count).unwrap_or_default();
                let index = ((row - rows.start) * width + column) as usize;
                let Some(first) = own.first() else { continue };
                let hit = first.hit;
                tracer.batch.samples[index] = sample_pixel(input, &mut tracer, &mut pixel, own);
                if let (Some(first_hit), Some(hit)) = (tracer.batch.first_hits.get_mut(index), hit) {
                    *first_hit = FirstHit { facet: pixel.first_facet(), ..FirstHit::new(world, hit) };
                }
            }
        }
    }
    Some(tracer.batch)
}

/// The first ray of a camera path and its nearest hit.
pub(super) struct FirstRay {
    sampler: Sampler,
    /// Where the ray crosses the pixel, from 0 to 1 each way.
    within_pixel: Vec2,
    pub(super) ray: Ray,
    pub(super) hit: Option<Hit>,
}

/// The first rays of all samples of an iteration for some pixels of a row, pixel by pixel, traced in packets.
pub(super) fn trace_first_rays(input: &PassInput, row: u32, columns: Range<u32>) -> Vec<FirstRay> {
    let PassInput { world, plan, iteration, .. } = *input;
    let camera = &plan.camera;
    let samples = |column| plan.camera_samples(row * camera.width + column, iteration);
    let mut first_rays: Vec<FirstRay> = columns
        .flat_map(|column| samples(column).map(move |index| (column, index)))
        .map(|(column, index)| {
            let pixel = u64::from(row * camera.width + column);
            let mut sampler = input.sampler(Stream::Camera, pixel, index);
            let within_pixel = sampler.next_2d();
            // The one sample of a draft stands for the whole pixel.
            let within_pixel = if plan.is_draft() { DVec2::splat(0.5) } else { within_pixel };
            let ray = camera.ray(DVec2::new(f64::from(column), f64::from(row)) + within_pixel);
            FirstRay { hit: None, sampler, ray, within_pixel: within_pixel.as_vec2() }
        })
        .collect();
    let mut packets = first_rays.chunks_exact_mut(LANES);
    for packet in &mut packets {
        let hits = world.aggregate.closest_hits(&std::array::from_fn(|k| packet[k].ray));
        for (first, hit) in packet.iter_mut().zip(hits) {
            first.hit = hit;
        }
    }
    for first in packets.into_remainder() {
        first.hit = world.aggregate.closest_hit(&first.ray);
    }
    first_rays
}

/// All samples of an iteration for one pixel. Where all samples meet one surface, one sample leaves visible points; at an edge several
/// samples do. Density estimates at visible points are most of the work.
fn sample_pixel(
    input: &PassInput,
    tracer: &mut CameraTracer,
    pixel: &mut Pixel,
    first_rays: &mut [FirstRay],
) -> PixelSamples {
    let PassInput { plan, iteration, .. } = *input;
    let count = first_rays.len();
    let surface = |first: &FirstRay| first.hit.map_or(0, |hit| hit.primitive + 1);
    let on_an_edge = first_rays.iter().any(|first| surface(first) != surface(&first_rays[0]));
    let weight = plan.samples_weight(pixel.index, iteration);
    let mut samples = PixelSamples { surface: surface(&first_rays[0]), weight, ..PixelSamples::default() };
    let gathering = match (plan.gathers(), on_an_edge) {
        (false, _) => 0,
        (true, true) => count.min(SAMPLES_OF_EDGE),
        (true, false) => 1,
    };
    let groups = count / gathering.max(1);
    let first = if gathering > 0 { gathering_group(input, pixel.index, groups) * gathering } else { 0 };
    let first_point = tracer.batch.visible_points.len();
    for (index, FirstRay { sampler, within_pixel, ray, hit }) in first_rays.iter_mut().enumerate() {
        let gathers = (first..first + gathering).contains(&index);
        let gather_weight = if gathers { 1.0 / gathering as f32 } else { 0.0 };
        pixel.position = *within_pixel;
        samples.include(tracer.trace(pixel, *ray, *hit, gather_weight, sampler));
    }
    samples.is_heterogeneous = on_an_edge || pixel.is_textured;
    let CameraBatch { visible_points, facets, counters, .. } = &mut tracer.batch;
    pixel.complete(visible_points, facets, first_point, on_an_edge);
    if !plan.finds_direct_light {
        PixelSamples::default()
    } else if samples.is_finite() {
        samples
    } else {
        counters.dropped_samples += 1;
        PixelSamples::default()
    }
}

/// The index of the group of a pixel's samples that gathers photons, of `groups` groups. It is random, because a fixed choice would keep
/// to one region of the pixel: every n-th point of the samples' sequence does.
fn gathering_group(input: &PassInput, pixel: u32, groups: usize) -> usize {
    if groups < 2 {
        return 0;
    }
    let mut sampler = input.sampler(Stream::GatheringSample, u64::from(pixel), input.iteration);
    (sampler.next_1d() * groups as f64) as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Rgb;
    use crate::transport::pass::Cancel;
    use crate::transport::plan::Plan;
    use crate::transport::testing::{self, lamp, sphere};
    use crate::world::World;

    /// A grey ball in a closed grey room: every camera path meets a diffuse surface.
    fn room() -> World {
        let film = "[film]\nwidth = 24\nheight = 20\n";
        let ball = sphere("ball", [0.0; 3], 0.7, "grey");
        testing::world(&[&sphere("room", [0.0; 3], 5.0, "grey"), &ball, &lamp([1.0, 3.0, 2.0]), film].concat())
    }

    /// The visible points of a pixel have the weights of a mean: one point where all paths meet one surface, several at an edge.
    #[test]
    fn gather_weights_of_a_pixel_add_up_to_one() {
        let world = room();
        let plan = Plan::new(&world);
        for iteration in [1, 3, 4, 5] {
            let seen =
                camera_pass(&PassInput::uncancelled(&world, &plan, 1, iteration), &(4..16)).expect("never cancelled");
            let mut sums = vec![Rgb::ZERO; 24 * 12];
            let mut edges = 0;
            for point in &seen.visible_points {
                sums[point.pixel as usize - 4 * 24] += point.throughput;
                edges += usize::from(point.on_an_edge);
            }
            assert!(sums.iter().all(|sum| (*sum - Rgb::ONE).length() < 1e-6), "iteration {iteration}");
            let points = seen.visible_points.len();
            // At an edge the four samples of a full iteration gather.
            let extra = edges - edges / SAMPLES_OF_EDGE;
            assert!(iteration < 4 || (edges > 0 && points == 24 * 12 + extra), "{points} points, {edges} at edges");
        }
    }

    #[test]
    fn every_pixel_takes_the_samples_that_the_plan_allots() {
        let world = room();
        let plan = Plan::new(&world);
        for iteration in 1..=5 {
            let seen =
                camera_pass(&PassInput::uncancelled(&world, &plan, 1, iteration), &(0..20)).expect("never cancelled");
            let wanted = |pixel| plan.camera_samples(pixel, iteration).count() as u32;
            assert!((0..).zip(&seen.samples).all(|(pixel, samples)| samples.count == wanted(pixel)));
            let is_lit = |samples: &&PixelSamples| samples.sum.min_element() > 0.0;
            assert!(seen.samples.iter().filter(is_lit).count() > 24 * 20 / 2, "most pixels see light");
        }
    }

    /// A pixel gets the same samples, wherever its band begins.
    #[test]
    fn rows_do_not_depend_on_the_band() {
        let world = room();
        let plan = Plan::new(&world);
        let samples = |rows: Range<u32>| {
            let seen = camera_pass(&PassInput::uncancelled(&world, &plan, 1, 4), &rows).expect("never cancelled");
            seen.samples.iter().map(|samples| samples.sum).collect::<Vec<_>>()
        };
        assert_eq!(samples(0..20), [samples(0..7), samples(7..20)].concat());
        let cancelled = PassInput { cancel: Cancel::when(&|| true), ..PassInput::uncancelled(&world, &plan, 1, 4) };
        assert!(camera_pass(&cancelled, &(0..20)).is_none());
    }
}
