//! The views that the user asks for by name.

/// A view that the user asks for by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum NamedView {
    /// The selection fills the picture.
    Selection,
    /// All objects fill the picture.
    All,
    /// The target from this side.
    From(Side),
    /// The camera of the scene as it was opened or saved last.
    Own,
    /// The view before this one.
    Previous,
    /// The view after this one, once the user went back.
    Next,
}

impl NamedView {
    /// The name of the change of the camera, in the history.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Selection => "frame selection",
            Self::All => "frame all",
            Self::From(Side::Front) => "front view",
            Self::From(Side::Right) => "right view",
            Self::From(Side::Top) => "top view",
            Self::From(Side::Opposite) => "opposite view",
            Self::Own => "scene's own view",
            Self::Previous => "previous view",
            Self::Next => "next view",
        }
    }
}

/// A side from which the camera looks at its target.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Side {
    /// From the front: along -z where y is up, along y where z is up.
    Front,
    /// From the right of the front.
    Right,
    /// From above, with the front at the bottom of the picture.
    Top,
    /// From the other side of the target.
    Opposite,
}
