//! The kinds of shapes, lights, materials and textures: their names, and conversions between kinds.

use crate::math::Rgb;
use crate::scene::{Color, Emitter, Encoding, MaterialModel, Shape};
use glam::DVec3;

/// The kinds of materials, by their names in the scene format.
pub(crate) const MODEL_KINDS: [&str; 5] = ["diffuse", "phong", "polished", "mirror", "glass"];
/// The kinds of lights, by their names in the scene format.
pub(crate) const EMITTER_KINDS: [&str; 5] = ["point", "sphere", "quad", "sun", "beam"];

/// The name of a shape's kind in the scene format.
pub(crate) fn shape_kind(shape: &Shape) -> &'static str {
    match shape {
        Shape::Quad { .. } => "quad",
        Shape::Sphere { .. } => "sphere",
        Shape::Plane { .. } => "plane",
        Shape::Bezier(_) => "bezier",
        Shape::Revolution(_) => "revolution",
    }
}

/// The name of a light's kind in the scene format.
pub(crate) fn emitter_kind(emitter: &Emitter) -> &'static str {
    match emitter {
        Emitter::Point { .. } => "point",
        Emitter::Sphere { .. } => "sphere",
        Emitter::Quad { .. } => "quad",
        Emitter::Sun { .. } => "sun",
        Emitter::Beam { .. } => "beam",
    }
}

/// Whether the light emits nothing.
pub(crate) fn is_dark(emitter: &Emitter) -> bool {
    let (Emitter::Point { intensity: strength, .. }
    | Emitter::Sphere { radiance: strength, .. }
    | Emitter::Quad { radiance: strength, .. }
    | Emitter::Sun { irradiance: strength, .. }
    | Emitter::Beam { power: strength, .. }) = emitter;
    *strength == Rgb::ZERO
}

/// The name of a material's kind in the scene format.
pub(crate) fn model_kind(model: &MaterialModel) -> &'static str {
    match model {
        MaterialModel::Diffuse { .. } => "diffuse",
        MaterialModel::Phong { .. } => "phong",
        MaterialModel::Polished { .. } => "polished",
        MaterialModel::Mirror { .. } => "mirror",
        MaterialModel::Glass { .. } => "glass",
    }
}

/// The name of a texture's encoding, for the outline.
pub(crate) fn encoding_kind(encoding: Encoding) -> &'static str {
    match encoding {
        Encoding::Srgb => "sRGB",
        Encoding::Linear => "linear",
    }
}

/// A material of the kind `kind` that keeps the colours that both kinds have.
pub(crate) fn model_like(model: &MaterialModel, kind: &str) -> MaterialModel {
    let white = || Color::Constant(Rgb::splat(0.9));
    let (albedo, reflectance) = match model.clone() {
        MaterialModel::Diffuse { albedo } => (albedo, white()),
        MaterialModel::Phong { albedo, specular, .. } => (albedo, specular),
        MaterialModel::Polished { albedo, reflectance } => (albedo, reflectance),
        MaterialModel::Mirror { reflectance } => (Color::Constant(Rgb::splat(0.5)), reflectance),
        MaterialModel::Glass { .. } => (Color::Constant(Rgb::splat(0.5)), white()),
    };
    // Diffuse and specular reflectance must not exceed 1 together.
    let gloss = Color::Constant(Rgb::splat(0.1));
    let dimmed = |color| match color {
        Color::Constant(value) => Color::Constant(value.min(Rgb::splat(0.9))),
        textured @ Color::Texture(_) => textured,
    };
    match kind {
        "phong" => MaterialModel::Phong { albedo: dimmed(albedo), specular: gloss, exponent: 50.0 },
        "polished" => MaterialModel::Polished { albedo: dimmed(albedo), reflectance: gloss },
        "mirror" => MaterialModel::Mirror { reflectance },
        "glass" => {
            MaterialModel::Glass { ior: 1.5, tint: Color::Constant(Rgb::ONE), absorption: Rgb::ZERO, priority: 0 }
        }
        _ => MaterialModel::Diffuse { albedo },
    }
}

/// A light of the kind `kind` at the same position, with the same peak intensity. A sun from there lights the
/// origin as the other kinds do, and a beam lights its whole way as they do at a distance of 1.
pub(crate) fn emitter_like(emitter: &Emitter, kind: &str) -> Emitter {
    emitter_of_size(emitter, kind, 0.1)
}

/// As [`emitter_like`], where a sphere or a beam gets this radius, scene units, and a quad twice this side.
pub(super) fn emitter_of_size(emitter: &Emitter, kind: &str, size: f64) -> Emitter {
    const PI: f32 = std::f32::consts::PI;
    // Intensity along the brightest direction, W/sr: a small surface of projected area A and radiance L has A L.
    let (at, intensity) = match *emitter {
        Emitter::Point { position, intensity } => (position, intensity),
        Emitter::Sphere { center, radius, radiance } => (center, radiance * (PI * (radius * radius) as f32)),
        Emitter::Quad { corner, edge_u, edge_v, radiance } => {
            (corner + 0.5 * (edge_u + edge_v), radiance * edge_u.cross(edge_v).length() as f32)
        }
        Emitter::Sun { direction, irradiance, .. } => (-direction, irradiance * direction.length_squared() as f32),
        Emitter::Beam { center, radius, power, .. } => (center, power / (PI * (radius * radius) as f32)),
    };
    match kind {
        "sphere" => Emitter::Sphere { center: at, radius: size, radiance: intensity / (PI * (size * size) as f32) },
        "quad" => Emitter::Quad {
            corner: at - size * DVec3::new(1.0, 0.0, 1.0),
            edge_u: 2.0 * size * DVec3::X,
            edge_v: 2.0 * size * DVec3::Z,
            radiance: intensity / (4.0 * size * size) as f32,
        },
        "sun" => {
            let direction = if at == DVec3::ZERO { DVec3::NEG_Y } else { -at };
            let irradiance = intensity / direction.length_squared() as f32;
            Emitter::Sun { direction, irradiance, diameter: Emitter::SUN_DIAMETER }
        }
        "beam" => Emitter::Beam {
            center: at,
            direction: DVec3::NEG_Y,
            radius: size,
            power: intensity * (PI * (size * size) as f32),
        },
        _ => Emitter::Point { position: at, intensity },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_converted_light_keeps_its_intensity() {
        let point = Emitter::Point { position: DVec3::ONE, intensity: Rgb::new(1.0, 2.0, 3.0) };
        for kind in EMITTER_KINDS {
            let Emitter::Point { position, intensity } = emitter_like(&emitter_like(&point, kind), "point") else {
                panic!("a point light was asked for")
            };
            // f32 radiance and back: a few roundings of 6e-8.
            assert!((intensity - Rgb::new(1.0, 2.0, 3.0)).length() < 1e-5, "{intensity} through {kind}");
            assert!(position.distance(DVec3::ONE) < 1e-12, "{position} through {kind}");
        }
    }

    #[test]
    fn a_converted_material_keeps_its_colour() {
        let red = Color::Constant(Rgb::new(0.8, 0.1, 0.1));
        let model = model_like(&MaterialModel::Diffuse { albedo: red.clone() }, "phong");
        assert!(matches!(model, MaterialModel::Phong { albedo, .. } if albedo == red), "red stays red");
    }
}
