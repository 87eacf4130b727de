//! Parts of the light in a picture, to look at or to measure one of them.

use super::plan::{Plan, PlanNote};

/// Part of a picture: the parts' sum is the picture. The table in [`transport`](super) tells which paths belong to which.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// Emission, the background and direct light: all that paths from the camera find.
    Direct,
    /// Caustics, those in mirrors and glass too.
    Caustics,
    /// Light that was scattered in many directions at least once before the last time.
    Interreflection,
}

impl Plan {
    /// The plan for one component alone: nothing is done for the others.
    pub fn only(mut self, component: Component) -> Self {
        self.finds_direct_light = component == Component::Direct;
        self.caustics = self.caustics.filter(|_| component == Component::Caustics);
        self.global_paths.retain(|_| component == Component::Interreflection);
        self.notes = self.notes.into_iter().map(|note| of_component(note, component)).collect();
        self
    }
}

/// The note as it is where this component alone is wanted.
fn of_component(note: PlanNote, component: Component) -> PlanNote {
    let (what, reason) = (
        note.what.as_str(),
        match component {
            Component::Direct => "only direct light is asked for",
            Component::Caustics => "only caustics are asked for",
            Component::Interreflection => "only interreflection is asked for",
        },
    );
    let belongs = match component {
        Component::Direct => what == "direct light" || what == "background",
        Component::Caustics => what.starts_with("caustics"),
        Component::Interreflection => what == "interreflection",
    };
    if belongs || !note.rendered || what == "textures" {
        return note;
    }
    PlanNote { rendered: false, reason: reason.to_owned(), ..note }
}
