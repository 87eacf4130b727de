//! What a plan asks of the surfaces.

use crate::world::{Lobe, Material, Surface, World};
use glam::DVec2;

/// Whether this is so of any object.
pub(super) fn shows(world: &World, is_so: impl Fn(&World, u32) -> bool) -> bool {
    (0..world.surfaces.len() as u32).any(|p| shows_at(world, p) && is_so(world, p))
}

/// Whether a primitive is an object's and not a light's.
pub(super) fn shows_at(world: &World, primitive: u32) -> bool {
    matches!(world.surfaces[primitive as usize], Surface::Object { .. })
}

impl World {
    pub(in crate::transport) fn material_of(&self, primitive: u32) -> Option<&Material> {
        match self.surfaces[primitive as usize] {
            Surface::Object { material, .. } => Some(&self.materials[material as usize]),
            Surface::Light(_) => None,
        }
    }

    pub(super) fn scattered_bound(&self, primitive: u32) -> f32 {
        self.material_of(primitive).map_or(0.0, Material::scattered_bound)
    }

    pub(in crate::transport) fn is_glossy(&self, primitive: u32) -> bool {
        let scattering = self.material_of(primitive).map(|m| m.scattering(DVec2::ZERO));
        scattering.is_some_and(|s| matches!(s.lobe, Lobe::Phong { .. }))
    }

    /// Whether any part of a primitive may be inside the view pyramid.
    pub(in crate::transport) fn may_be_in_view(&self, primitive: u32) -> bool {
        let bounds = self.aggregate.primitives()[primitive as usize].bounds();
        bounds.is_empty() || self.camera.may_see(bounds.center(), 0.5 * bounds.diagonal())
    }
}
