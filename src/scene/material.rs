use super::TextureUse;
use crate::math::Rgb;

/// How a surface scatters light.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Unique among materials.
    pub name: String,
    /// The scattering.
    pub model: MaterialModel,
    /// Bumps that tilt the normal, if any.
    pub relief: Option<Relief>,
}

/// The kinds of scattering.
#[derive(Clone, Debug, PartialEq)]
pub enum MaterialModel {
    /// Lambert's law.
    Diffuse {
        /// Part of the light that is reflected.
        albedo: Color,
    },
    /// Energy-normalised modified Phong model.
    Phong {
        /// Part reflected diffusely.
        albedo: Color,
        /// Part reflected about the mirror direction.
        specular: Color,
        /// Sharpness of the lobe, at least 0.
        exponent: f64,
    },
    /// A mirror over a diffuse base.
    Polished {
        /// Part reflected diffusely.
        albedo: Color,
        /// Part mirrored.
        reflectance: Color,
    },
    /// A perfect mirror.
    Mirror {
        /// Part mirrored.
        reflectance: Color,
    },
    /// A smooth dielectric interface; the normal points to the outside.
    Glass {
        /// Index of refraction of the inside against air.
        ior: f64,
        /// Of what is transmitted, once for each crossing.
        tint: Color,
        /// Beer-Lambert, per scene unit, inside.
        absorption: Rgb,
    },
}

/// A colour that may vary over the surface.
#[derive(Clone, Debug, PartialEq)]
pub enum Color {
    /// The same everywhere.
    Constant(Rgb),
    /// From an image.
    Texture(TextureUse),
}

/// Bumps that move nothing and tilt the normal.
#[derive(Clone, Debug, PartialEq)]
pub enum Relief {
    /// A tangent-space normal map.
    Normal {
        /// The map.
        map: TextureUse,
        /// Scales red and green.
        strength: f64,
    },
    /// A height map.
    Height {
        /// The map.
        map: TextureUse,
        /// Height of white over black, scene units.
        depth: f64,
    },
}
