//! Properties of a primitive's surface that the planner and the passes need.

use crate::world::{Lobe, Material, Surface, World};
use glam::DVec2;

impl World {
    /// The primitives of objects, without the surfaces of lights.
    pub(in crate::transport) fn object_primitives(&self) -> impl Iterator<Item = u32> {
        (0..self.surfaces.len() as u32).filter(|&p| matches!(self.surfaces[p as usize], Surface::Object { .. }))
    }

    /// The material of a primitive; `None` on a light's surface.
    pub(in crate::transport) fn material_of(&self, primitive: u32) -> Option<&Material> {
        match self.surfaces[primitive as usize] {
            Surface::Object { material, .. } => Some(&self.materials[material as usize]),
            Surface::Light(_) => None,
        }
    }

    /// Whether a primitive mirrors or refracts.
    pub(in crate::transport) fn is_specular(&self, primitive: u32) -> bool {
        self.material_of(primitive).is_some_and(Material::is_specular)
    }

    /// Whether a primitive has a Phong lobe.
    pub(in crate::transport) fn is_glossy(&self, primitive: u32) -> bool {
        let scattering = self.material_of(primitive).map(|material| material.scattering(DVec2::ZERO));
        scattering.is_some_and(|scattering| matches!(scattering.lobe, Lobe::Phong { .. }))
    }

    /// Whether all points of a primitive have the same Phong lobe, so that neighbours may reuse each other's samples of it.
    pub(in crate::transport) fn has_uniform_lobe(&self, primitive: u32) -> bool {
        let uniform = self.material_of(primitive).and_then(Material::uniform);
        uniform.is_some_and(|scattering| matches!(scattering.lobe, Lobe::Phong { .. }))
    }

    /// An upper bound of the diffuse and glossy albedo of a primitive, over its surface and the channels.
    pub(in crate::transport) fn scattered_bound(&self, primitive: u32) -> f32 {
        self.material_of(primitive).map_or(0.0, Material::scattered_bound)
    }

    /// Whether a primitive may reach into the view pyramid. False positives are possible, false negatives are not.
    pub(in crate::transport) fn may_be_in_view(&self, primitive: u32) -> bool {
        let bounds = self.aggregate.primitives()[primitive as usize].bounds();
        bounds.is_empty() || self.camera.may_see(bounds.center(), 0.5 * bounds.diagonal())
    }
}
