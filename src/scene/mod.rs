//! What the user describes: plain data that can be cloned, compared, loaded and saved. It knows nothing of rendering.
//!
//! The file format is one TOML file; every type here mirrors one table of it.

use crate::geometry::bezier::ControlNet;
use crate::math::Rgb;
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// Everything there is to see, by whom, and how it is shown.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Scene {
    /// For the window's title and for people; may be empty.
    pub name: String,
    /// The eye.
    pub camera: Camera,
    /// The picture.
    pub film: Film,
    /// What light transport is computed.
    pub render: Render,
    /// Images that materials refer to by name.
    pub textures: Vec<Texture>,
    /// Surfaces' looks, that objects refer to by name.
    pub materials: Vec<Material>,
    /// Where light comes from.
    pub lights: Vec<Light>,
    /// The surfaces.
    pub objects: Vec<Object>,
}

/// A pinhole camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The pinhole, scene units.
    pub position: DVec3,
    /// The point in the middle of the picture.
    pub target: DVec3,
    /// Points upwards in the picture.
    pub up: DVec3,
    /// The whole vertical angle of view, degrees, between 0 and 180.
    pub fov_y: f64,
}

impl Default for Camera {
    fn default() -> Self {
        Self { position: DVec3::new(0.0, 0.0, 3.8), target: DVec3::ZERO, up: DVec3::Y, fov_y: 40.0 }
    }
}

/// The picture's size and how it is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Film {
    /// Pixels, 1 to 16384.
    pub width: u32,
    /// Pixels, 1 to 16384.
    pub height: u32,
    /// Stops; for the screen and PNG only.
    pub exposure: f64,
    /// For the screen and PNG only.
    pub tone_curve: ToneCurve,
}

impl Default for Film {
    fn default() -> Self {
        Self { width: 512, height: 512, exposure: 0.0, tone_curve: ToneCurve::Srgb }
    }
}

/// How linear radiance becomes what a screen shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum ToneCurve {
    /// The sRGB curve; clips at 1.
    #[default]
    Srgb,
    /// Rolls highlights off.
    Filmic,
}

/// What light transport is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Render {
    /// Scattering events between light and eye on the longest path; 1 is direct light alone.
    pub max_bounces: u32,
    /// Radiance of what a ray sees when it leaves the scene.
    pub background: Rgb,
}

impl Default for Render {
    fn default() -> Self {
        Self { max_bounces: 16, background: Rgb::ZERO }
    }
}

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

/// A texture as a material uses it.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureUse {
    /// Name of the texture.
    pub texture: String,
    /// Multiplies (u, v).
    pub scale: DVec2,
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

/// A source of light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Unique among lights.
    pub name: String,
    /// Its form and strength.
    pub emitter: Emitter,
}

/// The kinds of light sources.
#[derive(Clone, Debug, PartialEq)]
pub enum Emitter {
    /// An invisible point.
    Point {
        /// Scene units.
        position: DVec3,
        /// W/sr.
        intensity: Rgb,
    },
    /// A sphere that shines outwards.
    Sphere {
        /// Scene units.
        center: DVec3,
        /// Scene units, above 0.
        radius: f64,
        /// W/(sr m^2).
        radiance: Rgb,
    },
    /// A parallelogram that shines to the side of `edge_u x edge_v`.
    Quad {
        /// Scene units.
        corner: DVec3,
        /// Scene units.
        edge_u: DVec3,
        /// Scene units.
        edge_v: DVec3,
        /// W/(sr m^2).
        radiance: Rgb,
    },
}

/// A surface with a material.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Unique among objects.
    pub name: String,
    /// Name of its material.
    pub material: String,
    /// Its form.
    pub shape: Shape,
}

/// The kinds of surfaces.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A parallelogram.
    Quad {
        /// (u, v) = (0, 0).
        corner: DVec3,
        /// Where u runs.
        edge_u: DVec3,
        /// Where v runs.
        edge_v: DVec3,
    },
    /// A sphere.
    Sphere {
        /// Scene units.
        center: DVec3,
        /// Scene units, above 0.
        radius: f64,
    },
    /// An unbounded plane.
    Plane {
        /// Any point of it.
        point: DVec3,
        /// Points to its front; any length but 0.
        normal: DVec3,
        /// Where u runs; `None`: the x axis laid into the plane, or z where the normal is along x.
        u_axis: Option<DVec3>,
    },
    /// Bicubic Bezier patches that move together.
    Bezier(Bezier),
}

/// Bicubic Bezier patches that move together.
#[derive(Clone, Debug, PartialEq)]
pub struct Bezier {
    /// Where the patches are put.
    pub transform: Transform,
    /// The control points before the transform; shared, so that a clone costs nothing.
    pub patches: Arc<Vec<ControlNet>>,
    /// The `.bpt` file that holds exactly these patches, relative to the scene file; `None`: written in the scene.
    pub file: Option<String>,
}

/// Scale, then rotate about x, y, z in turn, then translate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// Scene units.
    pub translate: DVec3,
    /// Degrees about x, y and z.
    pub rotate: DVec3,
    /// Factors along x, y and z, none of them 0.
    pub scale: DVec3,
}

impl Default for Transform {
    fn default() -> Self {
        Self { translate: DVec3::ZERO, rotate: DVec3::ZERO, scale: DVec3::ONE }
    }
}
