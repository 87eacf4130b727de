//! Work that a scene does not need is skipped: the work counters of whole iterations.

use crate::support::{ball, floor, head, session_of_seed};
use patchlight::engine::Counters;

const ITERATIONS: u64 = 6;

/// The work counters after `ITERATIONS` iterations of a scene with these objects.
fn counters(max_bounces: u32, objects: &[String]) -> Counters {
    let film = "[film]\nwidth = 32\nheight = 32\n";
    let text = format!("{}{film}{}[render]\nmax_bounces = {max_bounces}\n", head(), objects.concat());
    session_of_seed(&text, ITERATIONS, 3).stats().counters
}

/// A floor with a picture on it.
fn textured_floor() -> String {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/textures/planks.png");
    format!(
        "[[texture]]\nname = \"wood\"\nfile = \"{file}\"\n[[material]]\nname = \"wooden\"\ntype = \"diffuse\"\n\
         albedo = {{ texture = \"wood\" }}\n{}",
        floor("wooden")
    )
}

#[test]
fn mirrors_and_textures_need_every_kind_of_work() {
    let counters = counters(16, &[textured_floor(), ball("a", -0.7, 0.5, "grey"), ball("b", 0.7, 0.5, "mirror")]);
    let Counters { rays, shadow_rays, caustic_paths, global_paths, photons_stored, .. } = counters;
    let Counters { splats, caustic_gathers, global_gathers, map_builds, texture_lookups, dropped_samples, .. } =
        counters;
    for (k, count) in [rays, shadow_rays, caustic_paths, global_paths, photons_stored, splats].into_iter().enumerate() {
        assert!(count > 0, "{k} of {counters:?}");
    }
    for (k, count) in [caustic_gathers, global_gathers, map_builds, texture_lookups].into_iter().enumerate() {
        assert!(count > 0, "{k} of {counters:?}");
    }
    assert_eq!(dropped_samples, 0);
}

#[test]
fn diffuse_scenes_need_one_photon_map_and_no_texture_lookups() {
    let counters = counters(16, &[floor("grey"), ball("a", 0.0, 0.5, "grey")]);
    let Counters { caustic_paths, splats, caustic_gathers, texture_lookups, map_builds, .. } = counters;
    assert_eq!([caustic_paths, splats, caustic_gathers, texture_lookups], [0; 4]);
    assert_eq!(map_builds, ITERATIONS);
}

#[test]
fn direct_light_alone_needs_no_photons() {
    let mirrored = [floor("grey"), ball("a", 0.0, 0.5, "grey"), ball("b", 1.5, 0.5, "mirror")];
    let convex = [ball("a", 0.0, 0.5, "grey")];
    for (max_bounces, objects) in [(1, mirrored.as_slice()), (16, &convex)] {
        let counters = counters(max_bounces, objects);
        let Counters { rays, shadow_rays, .. } = counters;
        assert!(rays > 0 && shadow_rays > 0);
        assert_eq!(counters, Counters { rays, shadow_rays, ..Counters::default() }, "rays and shadow rays alone");
    }
}

#[test]
fn black_and_mirror_surfaces_need_camera_rays_alone() {
    let counters = counters(16, &[floor("black"), ball("b", 0.0, 0.5, "mirror")]);
    assert!(counters.rays > 0);
    assert_eq!(counters, Counters { rays: counters.rays, ..Counters::default() });
}
