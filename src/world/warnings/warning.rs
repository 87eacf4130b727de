/// A fault of a scene that can be rendered, but is likely not meant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// The object, the light or the camera, with its name.
    pub subject: String,
    /// The fault, and its effect on the picture.
    pub fault: String,
    /// How to mend it.
    pub remedy: String,
}

impl Warning {
    /// The warning, with how to mend its fault.
    pub(super) fn new(subject: impl Into<String>, fault: String, remedy: &str) -> Self {
        Self { subject: subject.into(), fault, remedy: remedy.to_owned() }
    }
}
