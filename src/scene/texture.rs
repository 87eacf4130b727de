use glam::DVec2;

/// An image that materials use.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// Unique among textures.
    pub name: String,
    /// Path of a PNG or JPEG file, relative to the scene file.
    pub file: String,
    /// How the file's numbers encode colour.
    pub encoding: Encoding,
}

/// How the numbers in an image file encode colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Encoding {
    /// The sRGB curve.
    #[default]
    Srgb,
    /// Proportional to light, or no colour at all.
    Linear,
}

/// A texture as a material uses it.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureUse {
    /// Name of the texture.
    pub texture: String,
    /// Multiplies (u, v).
    pub scale: DVec2,
}
