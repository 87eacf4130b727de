use glam::DVec2;

/// An image for materials.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// The name, unique among textures.
    pub name: String,
    /// The path of a PNG or JPEG file, relative to the scene file.
    pub file: String,
    /// The encoding of the file's values.
    pub encoding: Encoding,
}

/// The encoding of the values in an image file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Encoding {
    /// The sRGB transfer function.
    #[default]
    Srgb,
    /// Linear: values proportional to light, or data such as heights.
    Linear,
}

/// A reference from a material to a texture.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureUse {
    /// The name of the texture.
    pub texture: String,
    /// The factors of u and v.
    pub scale: DVec2,
}
