//! Parts of the light in a picture, to look at or to measure one of them.

use super::plan::{Plan, PlanNote};

/// Part of a picture: the parts' sum is the picture. The table in [`transport`](super) tells which paths belong to which.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// Emission, the background and direct light: all that paths from the camera find, and so most of what Phong lobes show,
    /// but for what [`LobeLight`](super::LobeLight) leaves to interreflection: more of it the more photons there are a pixel.
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
    let what = note.what.as_str();
    let (belongs, reason) = match component {
        Component::Direct => (["direct light", "background"].contains(&what), "only direct light is asked for"),
        Component::Caustics => (what.starts_with("caustics"), "only caustics are asked for"),
        Component::Interreflection => {
            (["interreflection", "photons for gloss"].contains(&what), "only interreflection is asked for")
        }
    };
    if belongs || !note.rendered || what == "textures" {
        return note;
    }
    PlanNote { rendered: false, reason: reason.to_owned(), ..note }
}
