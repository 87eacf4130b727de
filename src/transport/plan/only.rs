//! The plan for one component of the light alone.

use super::notes::{PlanItem, PlanNote};
use super::render_plan::Plan;

/// Component of the light in a picture. The components add up to the picture; the table in [`transport`](super::super) tells which
/// paths belong to each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// Emission, the background and direct light: all light that camera paths find. Most light in Phong lobes belongs to it;
    /// [`GlossyMis`](super::super::GlossyMis) gives the rest to interreflection, more of it for more photons per pixel.
    Direct,
    /// Caustics, also caustics that the camera sees in mirrors, through glass or in Phong lobes.
    Caustics,
    /// Light that diffuse or glossy surfaces scattered at least twice, without the light in Phong lobes that belongs to `Direct`.
    Interreflection,
}

impl Plan {
    /// The plan for one component alone, without work for the other components.
    pub fn only(mut self, component: Component) -> Self {
        self.finds_direct_light = component == Component::Direct;
        self.caustics = self.caustics.filter(|_| component == Component::Caustics);
        self.global_paths.retain(|_| component == Component::Interreflection);
        self.notes = self.notes.into_iter().map(|note| of_component(note, component)).collect();
        self
    }
}

/// The note in a plan for one component.
fn of_component(note: PlanNote, component: Component) -> PlanNote {
    use PlanItem::*;
    let (items, reason): (&[PlanItem], _) = match component {
        Component::Direct => (&[DirectLight, Background], "only direct light is asked for"),
        Component::Caustics => (&[Caustics, IndirectlySeenCaustics], "only caustics are asked for"),
        Component::Interreflection => (&[Interreflection, GlossyPhotons], "only interreflection is asked for"),
    };
    if !note.rendered || note.item == Textures || items.contains(&note.item) {
        return note;
    }
    PlanNote { rendered: false, reason: reason.to_owned(), ..note }
}
