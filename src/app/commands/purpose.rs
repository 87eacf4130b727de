//! The purposes of a file, with the formats that each allows.

use crate::geometry::bezier::PatchFormat;
use crate::scene::SurfaceFormat;
use std::path::Path;

/// The purpose of a file that the user chooses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    OpenScene,
    SaveScene,
    ExportPicture,
    /// Of the picture as the screen shows it, with less noise where the display filter is on.
    ExportShown,
    /// As a PNG file of 16 bits per channel.
    ExportDeep,
    ExportSurface,
    ExportProfile,
    AddSurface,
    AddTexture,
    /// A picture to compare with.
    OpenReference,
}

impl Purpose {
    /// The title of the dialog that asks for the file.
    pub(crate) fn title(self) -> &'static str {
        match self {
            Self::OpenScene => "Open scene",
            Self::SaveScene => "Save scene",
            Self::ExportPicture => "Export picture",
            Self::ExportShown => "Export picture as shown",
            Self::ExportDeep => "Export 16-bit picture",
            Self::ExportSurface => "Export surface",
            Self::ExportProfile => "Export profile",
            Self::AddSurface => "Add patches",
            Self::AddTexture => "Add texture",
            Self::OpenReference => "Open reference picture",
        }
    }

    /// The purpose's name in the file of the preferences.
    pub(crate) fn key(self) -> &'static str {
        match self {
            Self::OpenScene => "open-scene",
            Self::SaveScene => "save-scene",
            Self::ExportPicture => "export-picture",
            Self::ExportShown => "export-shown",
            Self::ExportDeep => "export-deep",
            Self::ExportSurface => "export-surface",
            Self::ExportProfile => "export-profile",
            Self::AddSurface => "add-surface",
            Self::AddTexture => "add-texture",
            Self::OpenReference => "open-reference",
        }
    }

    /// The purpose of a file that is dropped onto the window, by its extension; `None` for an extension that the window
    /// cannot read.
    pub(crate) fn of_dropped(path: &Path) -> Option<Self> {
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
        let allows = |purpose: &Self| purpose.extensions().iter().any(|known| extension.as_deref() == Some(known));
        [Self::OpenScene, Self::AddSurface, Self::AddTexture, Self::OpenReference].into_iter().find(allows)
    }

    /// Whether the file is written, not read.
    pub(crate) fn writes(self) -> bool {
        matches!(
            self,
            Self::SaveScene
                | Self::ExportPicture
                | Self::ExportShown
                | Self::ExportDeep
                | Self::ExportSurface
                | Self::ExportProfile
        )
    }

    /// The allowed extensions, in lower case; the first is the default.
    pub(crate) fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::OpenScene | Self::SaveScene => &["toml"],
            Self::ExportPicture => &["png", "exr"],
            Self::ExportShown | Self::ExportDeep => &["png"],
            Self::ExportSurface => &SurfaceFormat::EXTENSIONS,
            Self::ExportProfile => &["csv"],
            Self::AddSurface => &PatchFormat::EXTENSIONS,
            Self::AddTexture => &["png", "jpg", "jpeg"],
            Self::OpenReference => &["exr"],
        }
    }

    /// The allowed formats, for the user.
    pub(crate) fn formats(self) -> &'static str {
        match self {
            Self::OpenScene | Self::SaveScene => ".toml (scene)",
            Self::ExportPicture => ".png (tone-mapped) or .exr (linear, 32-bit float)",
            Self::ExportShown => ".png (with the display filter, where it is on)",
            Self::ExportDeep => ".png (tone-mapped, 16 bits per channel)",
            Self::ExportSurface => ".obj or .stl (mesh), .bpt (control points), .step (surfaces)",
            Self::ExportProfile => ".csv (table)",
            Self::AddSurface => ".bpt, .obj, .pov, .rib (bicubic Bezier patches)",
            Self::AddTexture => ".png or .jpg (image)",
            Self::OpenReference => ".exr (linear picture)",
        }
    }
}
