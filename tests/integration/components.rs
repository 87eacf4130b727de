//! The components of light add up to the picture, and each needs only its own passes.

use crate::support::{advanced, ball, head, quad, scene};
use patchlight::engine::Session;
use patchlight::math::Rgb;
use patchlight::scene::SceneFile;
use patchlight::transport::Component;
use std::path::Path;

fn rendered(only: Option<Component>) -> Session {
    let mut file = SceneFile::open(Path::new("benches/suite/balls.toml")).expect("the scene is valid");
    (file.scene.film.width, file.scene.film.height) = (48, 48);
    advanced(Session::prepare(&file, 5, None).expect("the scene can be prepared").only(only), 4)
}

#[test]
fn components_add_up_to_the_picture() {
    let whole = rendered(None).film().image();
    let components = [Component::Direct, Component::Caustics, Component::Interreflection];
    let components = components.map(|component| rendered(Some(component)).film().image());
    let (mut difference, mut total) = (0.0, 0.0);
    for (k, pixel) in whole.pixels.iter().enumerate() {
        let sum = components.iter().map(|image| image.pixels[k]).sum::<Rgb>();
        difference += (sum - *pixel).abs().element_sum();
        total += pixel.element_sum();
    }
    // Both trace the same paths before the plan is refined. At the feet of objects a few pixels differ a little, because the
    // radius of a visibility polygon is that of the largest disc.
    assert!(difference < 1e-4 * total, "{difference} of {total}");
    for image in &components {
        assert!(image.pixels.iter().any(|pixel| pixel.max_element() > 0.0), "no component is black");
    }
}

#[test]
fn a_single_component_skips_the_passes_of_the_rest() {
    let counters = |only| rendered(Some(only)).stats().counters;
    let direct = counters(Component::Direct);
    assert_eq!((direct.caustic_paths, direct.global_paths, direct.map_builds), (0, 0, 0));
    let caustics = counters(Component::Caustics);
    assert_eq!((caustics.global_paths, caustics.global_gathers), (0, 0));
    let interreflection = counters(Component::Interreflection);
    assert_eq!((interreflection.shadow_rays, interreflection.caustic_paths, interreflection.splats), (0, 0, 0));
}

/// A wall, a shard with corners of 6 degrees and a mirror ball over a floor; at edges, where kernels have a slope, estimates may be negative.
/// The farther the lamp, the fewer photons are there to balance that.
#[test]
fn no_component_shows_negative_radiance() {
    let objects = [
        quad("floor", [[-1.0, -1.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]], "grey"),
        quad("wall", [[-1.0, -1.0, -1.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]], "grey"),
        quad("shard", [[-0.9, -0.5, 0.5], [0.8, 0.0, 0.0], [0.8, 0.0, -0.08]], "grey"),
        ball("ball", 0.4, 0.4, "mirror"),
        "[film]\nwidth = 16\nheight = 16\n".to_owned(),
    ];
    for lamp in ["[0, 3, 0]", "[0, 9, 6]", "[0, 30, 20]"] {
        let file = scene(&(head() + &objects.concat()).replace("[0.0, 3.0, 0.0]", lamp));
        for (seed, only) in [(1, Component::Caustics), (1, Component::Interreflection), (2, Component::Interreflection)]
        {
            let mut session = Session::prepare(&file, seed, None).expect("the scene can be prepared").only(Some(only));
            for iteration in [1, 4, 5, 8, 16] {
                session = advanced(session, iteration);
                let image = session.film().image();
                let least = image.pixels.iter().map(|pixel| pixel.min_element()).fold(f32::INFINITY, f32::min);
                let name = format!("{only:?} after iteration {iteration}, lamp at {lamp}, seed {seed}");
                assert!(least >= 0.0, "{least} in {name}");
                // The sums keep their sign, so that nothing adds up: the means differ by negative pixels alone.
                let shown =
                    image.pixels.iter().map(|pixel| f64::from(pixel.element_sum())).sum::<f64>() / (3.0 * 256.0);
                let mean = session.film().mean();
                assert!((shown - mean).abs() <= 0.02 * mean, "{shown} instead of {mean} in {name}");
            }
        }
    }
}
