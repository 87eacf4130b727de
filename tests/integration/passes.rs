//! Properties of the passes: energy, known positions of caustics, independence of threads.

use crate::support::{HEAD, lamp, mean, quad, session, world};
use glam::DVec3;
use patchlight::engine::{FilmSums, PassMeter, iterate};
use patchlight::geometry::Primitive;
use patchlight::math::Rgb;
use patchlight::transport::{
    Cancel, Component, DraftSize, PassInput, Photon, Plan, camera_pass, caustic_photon_pass, global_photon_pass,
};
use patchlight::world::World;
use std::sync::Arc;

/// The caustic photons of some iterations in which no sheets of light take their place.
fn caustic_photons(world: &World, iterations: u64) -> Vec<Photon> {
    let mut plan = Plan::new(world);
    plan.caustics.iter_mut().for_each(|caustics| caustics.sheets.fill(false));
    let batch = |i| caustic_photon_pass(&PassInput::uncancelled(world, &plan, 1, i)).expect("never cancelled");
    (1..=iterations).flat_map(|i| batch(i).photons).collect()
}

/// C5: a glass ball absorbs no light: all light that is aimed at the ball arrives on the walls around it.
#[test]
fn a_glass_ball_conserves_energy() {
    let text = format!(
        "{HEAD}[[material]]\nname = \"glass\"\ntype = \"glass\"\nior = 1.5
        [[object]]\nname = \"ball\"\ntype = \"sphere\"\ncenter = [0,0,0]\nradius = 1\nmaterial = \"glass\"
        [[object]]\nname = \"room\"\ntype = \"sphere\"\ncenter = [0,0,0]\nradius = 5\nmaterial = \"grey\"
        [[light]]\nname = \"l\"\ntype = \"point\"\nposition = [0, 2, 0]\nintensity = [1, 2, 3]\n"
    );
    let iterations = 4;
    let world = world(&text);
    let mut plan = Plan::new(&world);
    plan.caustics.iter_mut().for_each(|caustics| caustics.sheets.fill(true));
    let pass = |i| caustic_photon_pass(&PassInput::uncancelled(&world, &plan, 1, i)).expect("never cancelled");
    let with_sheets = (1..=iterations).map(pass).flat_map(|pass| {
        let of_sheets: Vec<Rgb> = pass.sheets.fluxes().map(|(_, flux)| flux).collect();
        pass.photons.into_iter().map(|photon| photon.flux).chain(of_sheets)
    });
    let alone = caustic_photons(&world, iterations).into_iter().map(|photon| photon.flux);
    let totals = [with_sheets.collect::<Vec<Rgb>>(), alone.collect()];
    let totals = totals.map(|fluxes| fluxes.into_iter().map(|flux| flux.as_dvec3()).sum::<DVec3>());
    // The ball fills 2 pi (1 - sqrt(1 - 1/4)) steradians.
    let expected = std::f64::consts::TAU * (1.0 - 0.75f64.sqrt());
    for (found, intensity) in totals.into_iter().flat_map(|total| total.to_array().into_iter().zip([1.0, 2.0, 3.0])) {
        let ratio = found / iterations as f64 / (expected * intensity);
        // Paths that were reflected 16 times inside are cut; Sobol points cover the rim of the ball to about 0.1 %.
        assert!((ratio - 1.0).abs() < 3e-3, "{ratio} of the light came out");
    }
}

/// The light of caustics in blocks of 8 x 8 pixels of a film of 64 x 64, mean of 96 iterations: by light sheets and the photons of what they
/// leave, or by photons alone.
fn caustics_of_blocks(world: &World, with_sheets: bool) -> Vec<f64> {
    let mut plan = Plan::new(world).only(Component::Caustics);
    plan.caustics.iter_mut().for_each(|caustics| caustics.sheets.fill(with_sheets));
    let mut blocks = vec![0.0; 64];
    for i in 4..100 {
        let input = PassInput::uncancelled(world, &plan, 1, i);
        let committed = iterate(&input, &PassMeter::default(), |contribution| {
            for (index, radiance) in contribution.photons.iter().enumerate() {
                blocks[index / 64 / 8 * 8 + index % 64 / 8] += f64::from(radiance.element_sum()) / (96.0 * 3.0 * 64.0);
            }
        });
        committed.expect("never cancelled");
    }
    blocks
}

/// A mirror beside a floor and a wall of bricks, with a texture and a normal map.
#[test]
fn sheets_light_textures_and_relief_as_photons_do() {
    let file = |name: &str| format!("{}/assets/textures/{name}", env!("CARGO_MANIFEST_DIR"));
    let textures = format!(
        "[[texture]]\nname = \"bricks\"\nfile = {:?}\n[[texture]]\nname = \"relief\"\nfile = {:?}\n",
        file("bricks.png"),
        file("bricks-normal.png")
    );
    let text = format!(
        "[camera]\nposition = [0, 1.5, 4]\ntarget = [0, -0.6, 0]\nfov_y = 45\n[film]\nwidth = 64\nheight = 64\n{textures}
        [[material]]\nname = \"wall\"\ntype = \"diffuse\"\nalbedo = {{ texture = \"bricks\", scale = [3, 3] }}
        normal_map = {{ texture = \"relief\", scale = [3, 3] }}
        [[material]]\nname = \"silver\"\ntype = \"mirror\"\nreflectance = [0.9, 0.9, 0.9]\n{}",
        [
            quad("floor", [[-4.0, -1.0, 4.0], [8.0, 0.0, 0.0], [0.0, 0.0, -6.0]], "wall"),
            quad("back", [[-4.0, -1.0, -2.0], [8.0, 0.0, 0.0], [0.0, 4.0, 0.0]], "wall"),
            quad("mirror", [[1.5, -1.0, 1.0], [0.0, 0.0, -1.5], [0.0, 1.5, 0.0]], "silver"),
            lamp([-0.5, 1.5, 0.8]),
        ]
        .concat()
    );
    let world = world(&text);
    let [found, expected] = [true, false].map(|with_sheets| caustics_of_blocks(&world, with_sheets));
    let brightest = expected.iter().copied().fold(0.0, f64::max);
    let (sum, expected_sum) = (found.iter().sum::<f64>(), expected.iter().sum::<f64>());
    assert!((sum / expected_sum - 1.0).abs() < 0.01, "{sum} instead of {expected_sum}");
    for (block, (found, expected)) in found.iter().zip(&expected).enumerate() {
        let most = 0.02 * expected + 0.005 * brightest;
        assert!((found - expected).abs() < most, "{found} instead of {expected} in block {block}");
    }
}

/// The tree of a patch is built when a ray first comes near: never for a patch outside the room.
#[test]
fn a_patch_out_of_reach_of_rays_is_not_prepared() {
    let patch = |name: &str, x: f64| {
        let row = |j: f64| (0..4).map(|i| format!("[{}, {}, 0]", x + 0.1 * f64::from(i), 0.1 * j)).collect::<Vec<_>>();
        let points = [0.0, 1.0, 2.0, 3.0].map(|j| format!("[{}]", row(j).join(", "))).join(", ");
        format!("[[object]]\nname = \"{name}\"\ntype = \"bezier\"\nmaterial = \"grey\"\npatches = [[{points}]]\n")
    };
    let text = format!(
        "{HEAD}[film]\nwidth = 128\nheight = 128
        [[object]]\nname = \"room\"\ntype = \"sphere\"\ncenter = [0, 0, 2]\nradius = 5\nmaterial = \"grey\"
        {}{}[[light]]\nname = \"l\"\ntype = \"point\"\nposition = [0, 2, 2]\nintensity = [1, 2, 3]\n",
        patch("outside", 10.0),
        patch("inside", 0.2),
    );
    let world = world(&text);
    let plan = Plan::new(&world);
    for i in 1..=4 {
        let rows = 0..world.camera.height;
        let input = PassInput::uncancelled(&world, &plan, 1, i);
        let seen = camera_pass(&input, &rows).expect("never cancelled");
        let photons = global_photon_pass(&input).expect("never cancelled");
        assert!(!seen.visible_points.is_empty() && photons.counters.global_paths > 0);
    }
    let patches = world.aggregate.primitives().iter().filter_map(|primitive| match primitive {
        Primitive::Patch(patch) => Some(patch.is_prepared()),
        _ => None,
    });
    assert_eq!(patches.collect::<Vec<_>>(), [false, true]);
}

/// C9: a light on the rim of a cylindrical mirror of radius R makes a cardioid whose cusp lies R / 3 beyond the centre.
#[test]
fn cardioid_cusp() {
    // Eight quadratic arcs of 22.5 degrees, raised to cubics: on the circle within 1e-5.
    let arc = |k: i32| -> Vec<Vec<[f64; 3]>> {
        let half = std::f64::consts::PI / 16.0;
        let middle = f64::from(2 * k + 1) * half + std::f64::consts::FRAC_PI_2;
        let on = |angle: f64, radius: f64| [radius * angle.cos(), radius * angle.sin()];
        let (a, c, control) = (on(middle - half, 1.0), on(middle + half, 1.0), on(middle, 1.0 / half.cos()));
        let third = |p: [f64; 2], t: f64| [p[0] + t * (control[0] - p[0]), p[1] + t * (control[1] - p[1])];
        let h = 4.0 / 3.0 * (half / 2.0).tan() / half.tan();
        [a, third(a, h), third(c, h), c]
            .map(|[x, z]| (0..4).map(|j| [x, f64::from(j) / 3.0 * 0.5, -z]).collect())
            .to_vec()
    };
    let patches: Vec<_> = (-4..4).map(arc).collect();
    let text = format!(
        "[camera]\nposition = [0, 3, 3]\ntarget = [0, 0, 0]\nfov_y = 40
        [[material]]\nname = \"mirror\"\ntype = \"mirror\"\nreflectance = [1, 1, 1]
        [[material]]\nname = \"paper\"\ntype = \"diffuse\"\nalbedo = [0.5, 0.5, 0.5]
        [[object]]\nname = \"wall\"\ntype = \"bezier\"\nmaterial = \"mirror\"\npatches = {patches:?}
        [[object]]\nname = \"paper\"\ntype = \"quad\"\nmaterial = \"paper\"\ncorner = [-1, 0, 1]\nedge_u = [2,0,0]\nedge_v = [0,0,-2]
        [[light]]\nname = \"l\"\ntype = \"point\"\nposition = [0, 0.4, 1]\nintensity = [1, 1, 1]\n"
    );
    let world = world(&text);
    let mut along_axis = [0.0f64; 200];
    for photon in caustic_photons(&world, 8) {
        let p = photon.position.as_dvec3() + world.view.origin;
        let from_light = DVec3::new(p.x, 0.0, p.z).z;
        if p.x.abs() < 0.01 && from_light.abs() < 1.0 {
            along_axis[((1.0 - from_light) * 100.0) as usize] += f64::from(photon.flux.x);
        }
    }
    let brightest = (0..200).max_by(|&a, &b| along_axis[a].total_cmp(&along_axis[b])).expect("200 bins");
    let beyond_center = (brightest as f64 + 0.5) / 100.0 - 1.0;
    // A bin is 0.01 wide; the density peaks within a bin or two of the cusp, on its lit side.
    assert!((beyond_center - 1.0 / 3.0).abs() < 0.025, "the cusp is at {beyond_center}");
}

/// Caustic light of iteration 4 that goes straight to the film, under a spherical lamp of this radius.
fn splats(lamp: f64, scattering: &str) -> usize {
    let world = world(&format!(
        "[camera]\nposition = [0, 2, 6]\ntarget = [0, 0, 0]\nfov_y = 40\n[film]\nwidth = 64\nheight = 64
        [[material]]\nname = \"glass\"\ntype = \"glass\"\nior = 1.5
        [[material]]\nname = \"w\"\ntype = \"diffuse\"\nalbedo = [0.5, 0.5, 0.5]
        [[object]]\nname = \"ball\"\ntype = \"sphere\"\ncenter = [0, 1, 0]\nradius = 0.5\nmaterial = \"glass\"
        [[light]]\nname = \"l\"\ntype = \"sphere\"\ncenter = [0, 3, 0]\nradius = {lamp}\nradiance = [1, 1, 1]\n{scattering}"
    ));
    let plan = Plan::new(&world);
    caustic_photon_pass(&PassInput::uncancelled(&world, &plan, 1, 4)).expect("never cancelled").splats.len()
}

#[test]
fn blurred_caustics_on_large_surfaces_begin_with_density_estimates() {
    let floor =
        "[[object]]\nname = \"f\"\ntype = \"plane\"\npoint = [0, -1, 0]\nnormal = [0, 1, 0]\nmaterial = \"w\"\n";
    let ball = |radius: f64| {
        format!(
            "[[object]]\nname = \"b\"\ntype = \"sphere\"\ncenter = [0, -0.5, 0]\nradius = {radius}\nmaterial = \"w\"\n"
        )
    };
    assert_eq!((splats(0.5, floor), splats(0.5, &ball(0.5))), (0, 0));
    assert!(splats(1e-3, floor) > 100, "as small as a point");
    assert!(splats(0.5, &ball(0.05)) > 10, "the ball is too small for a large disc");
}

/// A glass ball before a wall and a floor that are partly specular, under a point light and a spherical light.
fn mixed() -> String {
    HEAD.to_owned()
        + "[film]\nwidth = 40\nheight = 30
    [[material]]\nname = \"glass\"\ntype = \"glass\"\nior = 1.5\ntint = [0.9, 1, 0.9]
    [[material]]\nname = \"wall\"\ntype = \"polished\"\nalbedo = [0.5, 0.4, 0.3]\nreflectance = [0.2, 0.2, 0.2]
    [[material]]\nname = \"shiny\"\ntype = \"phong\"\nalbedo = [0.5, 0.4, 0.3]\nspecular = [0.3, 0.3, 0.3]\nexponent = 30
    [[object]]\nname = \"ball\"\ntype = \"sphere\"\ncenter = [0,0,0]\nradius = 0.5\nmaterial = \"glass\"
    [[object]]\nname = \"back\"\ntype = \"quad\"\ncorner = [-2,-1,-1]\nedge_u = [4,0,0]\nedge_v = [0,3,0]\nmaterial = \"wall\"
    [[object]]\nname = \"floor\"\ntype = \"plane\"\npoint = [0,-1,0]\nnormal = [0,1,0]\nmaterial = \"shiny\"
    [[light]]\nname = \"l\"\ntype = \"point\"\nposition = [1, 1.5, 1]\nintensity = [2, 2, 2]
    [[light]]\nname = \"disc\"\ntype = \"sphere\"\ncenter = [-1, 1.5, 1]\nradius = 0.2\nradiance = [5, 5, 5]\n"
}

/// Ten iterations: the last two with radii that the eight before asked for.
#[test]
fn one_thread_and_many_give_the_same_bits() {
    let with_threads = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| session(&mixed(), 10).film().image())
    };
    assert_eq!(with_threads(1), with_threads(3));
}

#[test]
fn a_cancelled_iteration_leaves_the_film_unchanged() {
    let mut session = session(&mixed(), 2);
    let before: FilmSums = session.film().clone();
    assert!(session.advance(Cancel::when(&|| true)).is_none(), "the iteration was cancelled");
    assert_eq!(*session.film(), before);
    session.advance(Cancel::NEVER).expect("never cancelled");
    assert_eq!(
        session.film().image(),
        self::session(&mixed(), 3).film().image(),
        "the next iteration has its usual bits"
    );
}

#[test]
fn a_draft_leaves_the_film_unchanged_and_resembles_the_picture() {
    let mut session = session(&mixed(), 32);
    let before = session.film().clone();
    let draft = session.draft(DraftSize { coarseness: 2, thinning: 4 }, None, Cancel::NEVER).expect("never cancelled");
    assert_eq!(*session.film(), before);
    assert_eq!((draft.image.width, draft.image.height), (20, 15));
    let ratio = mean(&draft.image) / mean(&session.film().image());
    // 300 pixels with one sample each, edges and noise included.
    assert!((ratio - 1.0).abs() < 0.2, "{ratio}");
}

#[test]
fn a_draft_of_some_pixels_has_their_direct_light_and_leaves_out_the_others() {
    let room = "[[object]]\nname = \"room\"\ntype = \"sphere\"\ncenter = [0,0,0]\nradius = 5\nmaterial = \"grey\"
        [[light]]\nname = \"l\"\ntype = \"point\"\nposition = [0, 2, 0]\nintensity = [1, 2, 3]\n";
    let mut session = session(&format!("{HEAD}{room}"), 0);
    let whole = session.draft(DraftSize::FULL, None, Cancel::NEVER).expect("never cancelled");
    let chosen: Arc<[bool]> = (0..whole.sharp.len()).map(|pixel| pixel % 7 < 3).collect();
    let some = session.draft(DraftSize::FULL, Some(chosen.clone()), Cancel::NEVER).expect("never cancelled");
    assert!(some.stats.rays < whole.stats.rays);
    for (index, is_chosen) in chosen.iter().enumerate() {
        let expected = if *is_chosen { whole.sharp[index] } else { Rgb::ZERO };
        assert!((some.sharp[index] - expected).length() <= 1e-4 * expected.length(), "{index}");
        assert_eq!(
            some.g_buffer.first_hits[index].depth,
            if *is_chosen { whole.g_buffer.first_hits[index].depth } else { f32::INFINITY }
        );
    }
}
