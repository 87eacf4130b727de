//! A G-buffer \[SaitoTakahashi90\]: what the pixels of a picture show, without its light.

use crate::math::Rgb;
use crate::scene::{Emitter, Scene, SceneFile};
use crate::transport::{Contribution, FirstHit, Guides, SeenSurface};

/// What the pixels of a picture show.
#[derive(Clone, Debug)]
pub struct GBuffer {
    /// Pixels per row, and rows.
    pub size: [u32; 2],
    /// Where the first ray of each pixel ended, row by row.
    pub first_hits: Vec<FirstHit>,
    /// What the pixels show, also in mirrors and through glass; empty where the first rays alone were traced.
    pub guides: Guides,
}

/// What a pixel shows in a mirror or through glass.
#[derive(Clone, Copy, Debug)]
pub(in crate::engine) struct Reflected {
    pub(in crate::engine) surface: SeenSurface,
    /// The radiance of the pixel over the irradiance of what it shows.
    pub(in crate::engine) reflectance: Rgb,
}

impl GBuffer {
    /// The first hits alone.
    pub(in crate::engine) fn of_first_hits(size: [u32; 2], first_hits: Vec<FirstHit>) -> Self {
        Self { size, first_hits, guides: Guides::default() }
    }

    /// What a pass with guides tells; `None` where it told nothing.
    pub(in crate::engine) fn of_pass(size: [u32; 2], contribution: &Contribution) -> Option<Self> {
        let Contribution { first_hits, guides, .. } = contribution;
        (!first_hits.is_empty()).then(|| Self { size, first_hits: first_hits.clone(), guides: guides.clone() })
    }

    /// Whether anything is known of what pixels show in mirrors and through glass.
    pub(in crate::engine) fn knows_reflections(&self) -> bool {
        !self.guides.surfaces.is_empty()
    }

    /// What a pixel shows in a mirror or through glass; `None` where it shows nothing there, or that is not known.
    pub(in crate::engine) fn reflected(&self, pixel: usize) -> Option<Reflected> {
        let surface = (*self.guides.surfaces.get(pixel)?)?;
        (!surface.seen_directly).then(|| Reflected { surface, reflectance: self.guides.reflectances[pixel] })
    }
}

/// Whether all pixels show the same in both scenes, in other light: no surface, no material and not the camera is different.
pub(in crate::engine) fn shows_the_same(before: &SceneFile, after: &SceneFile) -> bool {
    // Textures of one name may be other files elsewhere.
    before.location == after.location && shows_alike(&before.scene, &after.scene)
}

fn shows_alike<'a>(before: &'a Scene, after: &'a Scene) -> bool {
    let shapes = |scene: &Scene| -> Vec<Emitter> {
        // No ray meets the other lamps.
        let shape = |emitter: &Emitter| match *emitter {
            Emitter::Sphere { center, radius, .. } => Some(Emitter::Sphere { center, radius, radiance: Rgb::ZERO }),
            Emitter::Quad { corner, edge_u, edge_v, .. } => {
                Some(Emitter::Quad { corner, edge_u, edge_v, radiance: Rgb::ZERO })
            }
            Emitter::Point { .. } | Emitter::Sun { .. } | Emitter::Beam { .. } => None,
        };
        scene.lights.iter().filter_map(|light| shape(&light.emitter)).collect()
    };
    let rest = |scene: &'a Scene| {
        let Scene { camera, film, render, textures, materials, objects, name: _, lights: _ } = scene;
        (camera, film, render, textures, materials, objects)
    };
    shapes(before) == shapes(after) && rest(before) == rest(after)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Light;
    use glam::DVec3;

    fn scene(emitter: Emitter) -> Scene {
        Scene { lights: vec![Light { name: "l".into(), emitter }], ..Scene::default() }
    }

    #[test]
    fn other_light_shows_the_same_unless_a_lamp_is_seen_elsewhere() {
        let point = |x: f64| scene(Emitter::Point { position: DVec3::new(x, 0.0, 0.0), intensity: Rgb::ONE });
        assert!(shows_alike(&point(0.0), &point(1.0)));
        let ball = |radius: f64, radiance: f32| {
            scene(Emitter::Sphere { center: DVec3::ZERO, radius, radiance: Rgb::splat(radiance) })
        };
        assert!(shows_alike(&ball(1.0, 1.0), &ball(1.0, 2.0)));
        assert!(!shows_alike(&ball(1.0, 1.0), &ball(1.1, 1.0)));
        assert!(!shows_alike(&point(0.0), &ball(1.0, 1.0)), "the ball is seen");
    }

    #[test]
    fn another_camera_or_material_shows_something_else() {
        let before = Scene::default();
        let mut moved = before.clone();
        moved.camera.position.x += 1.0;
        let painted = SceneFile::built_in("water").expect("a built-in scene").scene;
        let mut renamed = painted.clone();
        renamed.name = "other".into();
        assert!(shows_alike(&painted, &renamed));
        renamed.materials.pop();
        assert!(!shows_alike(&before, &moved) && !shows_alike(&painted, &renamed));
    }
}
