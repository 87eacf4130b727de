use super::{
    checks::{Checks, MAX_LENGTH},
    names::Names,
};
use crate::{
    math::Rgb,
    scene::{Color, Material, MaterialModel, Relief, TextureUse},
};

/// Checks a material.
pub(super) fn material(material: &Material, names: &Names<'_>, checks: &mut Checks<'_>) {
    match &material.model {
        MaterialModel::Diffuse { albedo } => color("albedo", albedo, names, checks),
        MaterialModel::Phong { albedo, specular, exponent } => {
            reflecting(("albedo", albedo), ("specular", specular), names, checks);
            checks.within("exponent", *exponent, 0.0, 1e9);
        }
        MaterialModel::Polished { albedo, reflectance } => {
            reflecting(("albedo", albedo), ("reflectance", reflectance), names, checks);
        }
        MaterialModel::Mirror { reflectance } => color("reflectance", reflectance, names, checks),
        MaterialModel::Glass { ior, tint, absorption, priority: _ } => {
            checks.within("ior", *ior, 0.01, 100.0);
            color("tint", tint, names, checks);
            checks.radiance("absorption", *absorption);
        }
    }
    match &material.relief {
        Some(Relief::Normal { map, strength }) => {
            let checks = &mut checks.at("normal_map");
            texture_use(map, names, checks);
            checks.within("strength", *strength, -1e3, 1e3);
        }
        Some(Relief::Height { map, depth }) => {
            let checks = &mut checks.at("height_map");
            texture_use(map, names, checks);
            checks.within("depth", *depth, -MAX_LENGTH, MAX_LENGTH);
        }
        None => {}
    }
}

/// Checks a reflectance or a transmittance: 0 to 1 in each channel.
fn color(key: &str, color: &Color, names: &Names<'_>, checks: &mut Checks<'_>) {
    match color {
        Color::Constant(c) => checks.require(c.cmpge(Rgb::ZERO).all() && c.cmple(Rgb::ONE).all(), key, || {
            format!("found {c}, expected 0 to 1 in each channel")
        }),
        Color::Texture(map) => texture_use(map, names, &mut checks.at(key)),
    }
}

/// Checks two reflectances whose sum may not exceed 1 in any channel.
fn reflecting(base: (&str, &Color), top: (&str, &Color), names: &Names<'_>, checks: &mut Checks<'_>) {
    color(base.0, base.1, names, checks);
    color(top.0, top.1, names, checks);
    if let (Color::Constant(a), Color::Constant(b)) = (base.1, top.1) {
        // Decimals like 0.9 + 0.1 may exceed 1 by a rounding of f32.
        let fits = (*a + *b).cmple(Rgb::splat(1.0 + 2.0 * f32::EPSILON)).all();
        checks.require(fits || a.max_element() > 1.0 || b.max_element() > 1.0, top.0, || {
            format!("found {b}; with {} {a} the sum exceeds 1, expected {0} + {} <= 1 in each channel", base.0, top.0)
        });
    }
}

fn texture_use(map: &TextureUse, names: &Names<'_>, checks: &mut Checks<'_>) {
    checks.name("texture", &map.texture, "texture", &names.textures);
    for (index, factor) in map.scale.to_array().into_iter().enumerate() {
        checks.within(&format!("scale[{index}]"), factor, -1e6, 1e6);
    }
}
