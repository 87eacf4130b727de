//! The components of light in a picture.

use serde::{Deserialize, Serialize};

/// Component of the light in a picture. The components add up to the picture; the table in [`transport`](super::super) tells which
/// paths belong to each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Component {
    /// Emission, the background and direct light: all light that camera paths find. Most light in Phong lobes belongs to it;
    /// [`GlossyMis`](super::super::GlossyMis) gives the rest to interreflection, more of it for more photons per pixel.
    Direct,
    /// Caustics, also caustics that the camera sees in mirrors, through glass or in Phong lobes.
    Caustics,
    /// Light that diffuse or glossy surfaces scattered at least twice, without the light in Phong lobes that belongs to `Direct`.
    Interreflection,
}
