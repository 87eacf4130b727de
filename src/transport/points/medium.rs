//! The glass that a path is inside of.

use crate::math::Rgb;
use crate::world::World;
use arrayvec::ArrayVec;

/// Glass bodies that may contain one point; deeper nested ones do not refract.
const MAX_NESTED: usize = 6;

/// The materials of the glass bodies around a path, the innermost last.
///
/// Bodies may be open and may overlap: a path may leave a body that it never entered.
#[derive(Clone, Debug, Default)]
pub(in crate::transport) struct Media {
    inside: ArrayVec<u32, MAX_NESTED>,
}

impl Media {
    /// Index of refraction inside the innermost of these bodies; 1 outside all.
    fn ior(world: &World, inside: &[u32]) -> f64 {
        inside.last().map_or(1.0, |&material| world.materials[material as usize].ior())
    }

    /// Index of refraction behind an interface of this glass over the index in front of it; `entering` where the path comes from
    /// the outside.
    #[inline]
    pub(in crate::transport) fn eta(&self, world: &World, material: u32, entering: bool) -> f64 {
        let glass = world.materials[material as usize].ior();
        let without = self.without(material);
        if entering { glass / Self::ior(world, &self.inside) } else { Self::ior(world, &without.inside) / glass }
    }

    /// The media behind an interface of this glass.
    #[inline]
    pub(in crate::transport) fn crossed(&self, material: u32, entering: bool) -> Self {
        if !entering {
            return self.without(material);
        }
        let mut media = self.clone();
        // A full stack only loses the refraction of the seventh nested body.
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

    /// Transmittance of the innermost body over this distance (scene units), by the Beer-Lambert law.
    #[inline]
    pub(in crate::transport) fn transmittance(&self, world: &World, distance: f64) -> Rgb {
        let absorption = self.inside.last().and_then(|&m| world.materials[m as usize].absorption());
        absorption.map_or(Rgb::ONE, |a| (-a * distance as f32).exp())
    }
}
