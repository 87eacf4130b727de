//! Materials with the parameters of real glass, liquids, metals and paint, to start from.

use crate::math::Rgb;
use crate::scene::{Color, Material, MaterialModel};

/// A ready-made material.
#[derive(Clone, Debug)]
pub(crate) struct Preset {
    /// The name in menus, and of a new material.
    pub(crate) name: &'static str,
    pub(crate) model: MaterialModel,
}

/// Presets under one heading of the menus.
pub(crate) struct Family {
    pub(crate) heading: &'static str,
    pub(crate) presets: &'static [Preset],
}

/// All presets, in the order of the menus.
///
/// Indices of refraction are those of the yellow helium line (587.6 nm), at room temperature:
/// - N-BK7 1.51680, N-K5 1.52249, N-SF10 1.72828, N-SF11 1.78472: the data sheets of Schott.
/// - Fused silica 1.4585: I. Malitson, Interspecimen comparison of the refractive index of fused silica, JOSA 55(10), 1965.
/// - Acrylic (PMMA) 1.491, polycarbonate 1.585: N. Sultanova et al., Dispersion properties of optical polymers, Acta Physica
///   Polonica A 116(4), 2009.
/// - Water 1.333: G. Hale, M. Querry, Optical constants of water in the 200-nm to 200-um wavelength region, Applied Optics
///   12(3), 1973.
/// - Ice 1.310: S. Warren, R. Brandt, Optical constants of ice from the ultraviolet to the microwave, JGR 113, 2008.
/// - Diamond 2.417: F. Peter, Ueber Brechungsindizes und Absorptionskonstanten des Diamanten, Zeitschrift fuer Physik 15, 1923.
///
/// Reflectances of metals at normal incidence are those of T. Akenine-Moeller et al., Real-Time Rendering, 4th edition, 2018,
/// table 9.2: linear Rec.709 RGB, gold clipped to 1.
pub(crate) static FAMILIES: &[Family] = &[
    Family {
        heading: "Glass",
        presets: &[
            glass("BK7 glass", 1.5168),
            glass("crown glass (K5)", 1.5225),
            glass("dense flint glass (SF10)", 1.7283),
            glass("dense flint glass (SF11)", 1.7847),
            glass("fused silica", 1.4585),
            glass("acrylic", 1.491),
            glass("polycarbonate", 1.585),
        ],
    },
    Family {
        heading: "Liquids and crystals",
        presets: &[glass("water", 1.333), glass("ice", 1.31), glass("diamond", 2.417)],
    },
    Family {
        heading: "Mirrors",
        presets: &[
            mirror("gold", [1.0, 0.782, 0.344]),
            mirror("silver", [0.972, 0.96, 0.915]),
            mirror("copper", [0.955, 0.638, 0.538]),
            mirror("aluminium", [0.913, 0.922, 0.924]),
            mirror("chrome", [0.549, 0.556, 0.554]),
        ],
    },
    Family {
        heading: "Matte",
        presets: &[
            // White paint reflects no more: whiter walls make rooms brighter than real ones.
            matte("matte white", 0.8),
            matte("matte grey", 0.4),
            matte("matte black", 0.04),
        ],
    },
    Family {
        heading: "Plastic",
        presets: &[
            plastic("white plastic", [0.75, 0.75, 0.75]),
            plastic("red plastic", [0.6, 0.03, 0.03]),
            plastic("blue plastic", [0.03, 0.1, 0.5]),
            satin("satin white plastic", [0.75, 0.75, 0.75]),
        ],
    },
];

/// Reflectance at normal incidence of an index of 1.5, the index of most plastics: `((n - 1) / (n + 1))^2`.
const PLASTIC_GLOSS: f32 = 0.04;

impl Preset {
    /// The material with the parameters of the preset. It keeps its name and its relief, and glass its priority, because they
    /// say where the material is in the scene.
    pub(crate) fn applied_to(&self, material: &Material) -> Material {
        let mut model = self.model.clone();
        if let (MaterialModel::Glass { priority, .. }, MaterialModel::Glass { priority: kept, .. }) =
            (&mut model, &material.model)
        {
            *priority = *kept;
        }
        Material { name: material.name.clone(), model, relief: material.relief.clone() }
    }
}

const fn color(rgb: [f32; 3]) -> Color {
    Color::Constant(Rgb::from_array(rgb))
}

const fn glass(name: &'static str, ior: f64) -> Preset {
    Preset { name, model: MaterialModel::Glass { ior, tint: color([1.0; 3]), absorption: Rgb::ZERO, priority: 0 } }
}

const fn mirror(name: &'static str, reflectance: [f32; 3]) -> Preset {
    Preset { name, model: MaterialModel::Mirror { reflectance: color(reflectance) } }
}

const fn matte(name: &'static str, albedo: f32) -> Preset {
    Preset { name, model: MaterialModel::Diffuse { albedo: color([albedo; 3]) } }
}

/// Plastic with a smooth surface.
const fn plastic(name: &'static str, albedo: [f32; 3]) -> Preset {
    let model = MaterialModel::Polished { albedo: color(albedo), reflectance: color([PLASTIC_GLOSS; 3]) };
    Preset { name, model }
}

/// Plastic with a slightly rough surface, which reflects lamps as soft spots.
const fn satin(name: &'static str, albedo: [f32; 3]) -> Preset {
    let model = MaterialModel::Phong { albedo: color(albedo), specular: color([PLASTIC_GLOSS; 3]), exponent: 60.0 };
    Preset { name, model }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Relief, Scene, TextureUse, validate};
    use glam::DVec2;
    use std::collections::BTreeSet;

    fn all() -> impl Iterator<Item = &'static Preset> {
        FAMILIES.iter().flat_map(|family| family.presets)
    }

    #[test]
    fn every_preset_is_a_valid_material_with_a_name_of_its_own() {
        let named = |preset: &Preset| Material { name: preset.name.into(), model: preset.model.clone(), relief: None };
        let mut scene = Scene { materials: all().map(named).collect(), ..Scene::default() };
        assert_eq!(validate(&scene), []);
        scene.materials.push(named(all().next().unwrap()));
        assert_eq!(validate(&scene).len(), 1, "validation sees the materials");
        let names: BTreeSet<_> = all().map(|preset| preset.name).collect();
        assert_eq!(names.len(), all().count());
    }

    #[test]
    fn a_material_keeps_its_name_relief_and_priority() {
        let map = TextureUse { texture: "bumps".into(), scale: DVec2::ONE };
        let relief = Some(Relief::Height { map, depth: 0.1 });
        let model = MaterialModel::Glass { ior: 1.5, tint: color([0.5; 3]), absorption: Rgb::ONE, priority: 3 };
        let before = Material { name: "pane".into(), model, relief };
        let diamond = all().find(|preset| preset.name == "diamond").unwrap();
        let after = diamond.applied_to(&before);
        assert_eq!((&after.name, &after.relief), (&before.name, &before.relief));
        let MaterialModel::Glass { ior, priority, absorption, .. } = after.model else { panic!("glass") };
        assert_eq!((ior, priority, absorption), (2.417, 3, Rgb::ZERO));
    }
}
