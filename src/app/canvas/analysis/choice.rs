//! What the analysis draws.

use crate::app::commands::Action;

/// The colours of the analysed surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shading {
    /// The mean of the principal curvatures.
    MeanCurvature,
    /// The product of the principal curvatures.
    GaussianCurvature,
    /// Black and white stripes that the surface reflects.
    Zebra,
}

impl Shading {
    /// The shading that an action toggles.
    fn of(action: Action) -> Option<Self> {
        match action {
            Action::ToggleMeanCurvature => Some(Self::MeanCurvature),
            Action::ToggleGaussianCurvature => Some(Self::GaussianCurvature),
            Action::ToggleZebra => Some(Self::Zebra),
            _ => None,
        }
    }
}

/// What the analysis draws over the selected surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub(crate) struct Analysis {
    /// Lines of constant u and v.
    pub(crate) isolines: bool,
    pub(crate) shading: Option<Shading>,
}

impl Analysis {
    /// Whether the action's part is drawn.
    pub(crate) fn shows(self, action: Action) -> bool {
        match Shading::of(action) {
            None => self.isolines,
            shading => self.shading == shading,
        }
    }

    /// Draws the action's part, or draws it no longer. One shading at a time is drawn.
    pub(crate) fn toggle(&mut self, action: Action) {
        match Shading::of(action) {
            None => self.isolines = !self.isolines,
            shading => self.shading = if self.shading == shading { None } else { shading },
        }
    }
}
