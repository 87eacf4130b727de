//! Parts of the light add up to the picture, and cost only their own passes.

use crate::support::advanced;
use patchlight::engine::Session;
use patchlight::scene::SceneFile;
use patchlight::transport::Component;
use std::path::Path;

fn rendered(only: Option<Component>) -> Session {
    let mut file = SceneFile::open(Path::new("benches/suite/balls.toml")).expect("the scene is valid");
    (file.scene.film.width, file.scene.film.height) = (48, 48);
    advanced(Session::prepare(&file, 5, None).expect("the scene can be prepared").only(only), 4)
}

#[test]
fn parts_add_up_to_the_picture() {
    let whole = rendered(None).film().image();
    let parts = [Component::Direct, Component::Caustics, Component::Interreflection];
    let parts = parts.map(|part| rendered(Some(part)).film().image());
    let (mut difference, mut total) = (0.0, 0.0);
    for (k, pixel) in whole.pixels.iter().enumerate() {
        let sum = parts[0].pixels[k] + parts[1].pixels[k] + parts[2].pixels[k];
        difference += (sum - *pixel).abs().element_sum();
        total += pixel.element_sum();
    }
    // The same paths, as long as nothing was measured. But at the feet of objects the polygons that tell what is in view reach
    // as far as the largest disc, and so they differ a little on some pixels.
    assert!(difference < 1e-4 * total, "{difference} of {total}");
    for part in &parts {
        assert!(part.pixels.iter().any(|pixel| pixel.max_element() > 0.0), "every part is there");
    }
}

#[test]
fn what_is_not_asked_for_is_not_looked_for() {
    let counters = |only| rendered(Some(only)).stats().counters;
    let direct = counters(Component::Direct);
    assert_eq!((direct.caustic_paths, direct.global_paths, direct.map_builds), (0, 0, 0));
    let caustics = counters(Component::Caustics);
    assert_eq!((caustics.global_paths, caustics.global_gathers), (0, 0));
    let interreflection = counters(Component::Interreflection);
    assert_eq!((interreflection.shadow_rays, interreflection.caustic_paths, interreflection.splats), (0, 0, 0));
}
