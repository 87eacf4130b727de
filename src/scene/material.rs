use super::TextureUse;
use crate::math::Rgb;

/// A material: how a surface scatters light.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The name, unique among materials.
    pub name: String,
    /// The scattering model.
    pub model: MaterialModel,
    /// A map that tilts the shading normal, if any.
    pub relief: Option<Relief>,
}

/// The scattering model of a material.
#[derive(Clone, Debug, PartialEq)]
pub enum MaterialModel {
    /// Lambertian reflection.
    Diffuse {
        /// The reflectance, 0 to 1.
        albedo: Color,
    },
    /// The energy-normalised modified Phong model \[LafortuneWillems94\].
    Phong {
        /// The diffuse reflectance, 0 to 1.
        albedo: Color,
        /// The greatest reflectance of the lobe around the mirror direction, 0 to 1.
        specular: Color,
        /// The Phong exponent, at least 0.
        exponent: f64,
    },
    /// A mirror over a diffuse base.
    Polished {
        /// The diffuse reflectance, 0 to 1.
        albedo: Color,
        /// The mirror reflectance, 0 to 1.
        reflectance: Color,
    },
    /// A perfect mirror.
    Mirror {
        /// The mirror reflectance, 0 to 1.
        reflectance: Color,
    },
    /// A smooth dielectric interface; the normal points to the outside.
    Glass {
        /// The index of refraction of the inside, relative to air.
        ior: f64,
        /// The factor of transmitted light, once per crossing, 0 to 1.
        tint: Color,
        /// The Beer-Lambert absorption coefficient of the inside, per scene unit.
        absorption: Rgb,
        /// Where bodies overlap, the one with the highest priority counts.
        priority: i32,
    },
}

/// A colour, constant or from a texture.
#[derive(Clone, Debug, PartialEq)]
pub enum Color {
    /// A constant colour.
    Constant(Rgb),
    /// The colours of a texture.
    Texture(TextureUse),
}

/// A map that tilts the shading normal without displacing the surface.
#[derive(Clone, Debug, PartialEq)]
pub enum Relief {
    /// A tangent-space normal map.
    Normal {
        /// The texture of the map.
        map: TextureUse,
        /// The factor of red and green.
        strength: f64,
    },
    /// A height map.
    Height {
        /// The texture of the map.
        map: TextureUse,
        /// The height of white above black, scene units.
        depth: f64,
    },
}
