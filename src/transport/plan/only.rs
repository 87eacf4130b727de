//! The plan for one component of the light alone.

use super::component::Component;
use super::notes::{PlanItem, PlanNote};
use super::render_plan::Plan;

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
