use crate::math::Rgb;
use crate::world::World;
use arrayvec::ArrayVec;

/// Deeper nesting of glass in glass is ignored.
const MAX_NESTED: usize = 6;

/// The glass bodies that a path is inside of, by material, the innermost last.
///
/// Bodies need not be closed, nor nested cleanly: leaving one that was never entered is no error.
#[derive(Clone, Debug, Default)]
pub(super) struct Media {
    inside: ArrayVec<u32, MAX_NESTED>,
}

impl Media {
    /// Index of refraction where the path is.
    fn ior(world: &World, inside: &[u32]) -> f64 {
        inside.last().map_or(1.0, |&material| world.materials[material as usize].ior())
    }

    /// Index behind over index in front at an interface of this glass, hit from its outside (`entering`) or inside.
    pub(super) fn eta(&self, world: &World, material: u32, entering: bool) -> f64 {
        let glass = world.materials[material as usize].ior();
        let without = self.without(material);
        if entering { glass / Self::ior(world, &self.inside) } else { Self::ior(world, &without.inside) / glass }
    }

    /// The media after the interface is crossed.
    pub(super) fn crossed(&self, material: u32, entering: bool) -> Self {
        if !entering {
            return self.without(material);
        }
        let mut media = self.clone();
        // A full stack only loses the refraction of bodies nested seven deep.
        let _full = media.inside.try_push(material);
        media
    }

    fn without(&self, material: u32) -> Self {
        let mut media = self.clone();
        if let Some(last) = media.inside.iter().rposition(|&m| m == material) {
            media.inside.remove(last);
        }
        media
    }

    /// What is left of the light after this length of path inside the innermost body: Beer and Lambert's law.
    pub(super) fn transmittance(&self, world: &World, distance: f64) -> Rgb {
        let absorption = self.inside.last().and_then(|&m| world.materials[m as usize].absorption());
        absorption.map_or(Rgb::ONE, |a| (-a * distance as f32).exp())
    }
}
