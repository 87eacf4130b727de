//! The components of light add up to the picture, and each needs only its own passes.

use crate::support::advanced;
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
