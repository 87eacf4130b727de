//! The name of the unit of lengths.

use serde::{Deserialize, Serialize};

/// The name that the window shows for the unit of lengths. No number changes with it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum LengthUnit {
    #[default]
    SceneUnits,
    Millimetres,
    Centimetres,
    Metres,
}

impl LengthUnit {
    /// All units, in the order of the menu.
    pub(crate) const ALL: [Self; 4] = [Self::SceneUnits, Self::Millimetres, Self::Centimetres, Self::Metres];

    /// The name in menus.
    pub(crate) fn label(self) -> &'static str {
        match self {
            Self::SceneUnits => "scene units",
            other => other.suffix(),
        }
    }

    /// The unit after a length; empty for scene units, which have no sign.
    pub(crate) fn suffix(self) -> &'static str {
        match self {
            Self::SceneUnits => "",
            Self::Millimetres => "mm",
            Self::Centimetres => "cm",
            Self::Metres => "m",
        }
    }

    /// The unit of absorption.
    pub(crate) fn reciprocal(self) -> &'static str {
        match self {
            Self::SceneUnits => "1/scene unit",
            Self::Millimetres => "1/mm",
            Self::Centimetres => "1/cm",
            Self::Metres => "1/m",
        }
    }
}
