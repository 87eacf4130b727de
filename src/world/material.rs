use super::Image;
use crate::geometry::Tangents;
use crate::math::{OrthonormalBasis, Rgb};
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// A value that is constant or varies over the surface.
#[derive(Clone, Debug)]
pub(super) enum Source {
    Constant(Rgb),
    Image { image: Arc<Image>, scale: DVec2 },
}

/// A map that tilts the shading normal.
#[derive(Clone, Debug)]
pub(super) enum Relief {
    Normal { image: Arc<Image>, scale: DVec2, strength: f64 },
    Height { image: Arc<Image>, scale: DVec2, depth: f64 },
}

#[derive(Clone, Debug)]
pub(super) enum Model {
    Diffuse { albedo: Source },
    Phong { albedo: Source, specular: Source, exponent: f64 },
    Polished { albedo: Source, reflectance: Source },
    Mirror { reflectance: Source },
    Glass { tint: Source },
}

/// A material with its textures.
#[derive(Clone, Debug)]
pub struct Material {
    model: Model,
    relief: Option<Relief>,
    /// Texture lookups for one scattering and normal.
    lookups: u32,
    /// The scattering of a material without textures, computed once per material instead of at every point.
    uniform: Option<Scattering>,
}

/// The scattering at a point: a diffuse lobe and at most one other lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scattering {
    /// The albedo of the diffuse (Lambertian) lobe.
    pub albedo: Rgb,
    /// The Phong, mirror or glass lobe, if any.
    pub lobe: Lobe,
}

/// A lobe besides diffuse reflection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lobe {
    /// Diffuse reflection alone.
    None,
    /// A Phong lobe around the mirror direction.
    Phong {
        /// The greatest albedo of the lobe.
        specular: Rgb,
        /// The Phong exponent.
        exponent: f64,
    },
    /// A perfect mirror.
    Mirror {
        /// The reflectance.
        reflectance: Rgb,
    },
    /// A smooth dielectric interface.
    Glass {
        /// The factor of transmitted light.
        tint: Rgb,
    },
}

impl Source {
    fn sample(&self, uv: DVec2) -> Rgb {
        match self {
            Self::Constant(value) => *value,
            Self::Image { image, scale } => image.sample(uv * *scale),
        }
    }

    fn is_image(&self) -> bool {
        matches!(self, Self::Image { .. })
    }

    /// An upper bound over the surface and the channels, 1 for textures.
    fn bound(&self) -> f32 {
        match self {
            Self::Constant(value) => value.max_element(),
            Self::Image { .. } => 1.0,
        }
    }
}

impl Model {
    fn sources(&self) -> [Option<&Source>; 2] {
        match self {
            Model::Diffuse { albedo } => [Some(albedo), None],
            Model::Phong { albedo, specular, .. } => [Some(albedo), Some(specular)],
            Model::Polished { albedo, reflectance } => [Some(albedo), Some(reflectance)],
            Model::Mirror { reflectance } => [Some(reflectance), None],
            Model::Glass { tint } => [Some(tint), None],
        }
    }
}

impl Material {
    pub(super) fn new(model: Model, relief: Option<Relief>) -> Self {
        let images = model.sources().into_iter().flatten().filter(|source| source.is_image()).count();
        let lookups = images as u32 + u32::from(relief.is_some());
        let mut material = Self { model, relief, lookups, uniform: None };
        material.uniform = (lookups == 0).then(|| material.scattering(DVec2::ZERO));
        material
    }

    /// The scattering of a material without textures; `None` for a material with textures.
    #[inline]
    pub fn uniform(&self) -> Option<Scattering> {
        self.uniform
    }

    /// The scattering at (u, v).
    pub fn scattering(&self, uv: DVec2) -> Scattering {
        let (albedo, lobe) = match &self.model {
            Model::Diffuse { albedo } => (albedo.sample(uv), Lobe::None),
            Model::Phong { albedo, specular, exponent } => {
                (albedo.sample(uv), Lobe::Phong { specular: specular.sample(uv), exponent: *exponent })
            }
            Model::Polished { albedo, reflectance } => {
                (albedo.sample(uv), Lobe::Mirror { reflectance: reflectance.sample(uv) })
            }
            Model::Mirror { reflectance } => (Rgb::ZERO, Lobe::Mirror { reflectance: reflectance.sample(uv) }),
            Model::Glass { tint } => (Rgb::ZERO, Lobe::Glass { tint: tint.sample(uv) }),
        };
        Scattering { albedo: within_energy(albedo, lobe), lobe }
    }

    /// The unit shading normal on the front side, at a point with this geometric unit normal and these tangents.
    pub fn shading_normal(&self, n_geom: DVec3, tangents: &Tangents) -> DVec3 {
        let tilted = match &self.relief {
            None => return n_geom,
            Some(Relief::Normal { image, scale, strength }) => {
                let texel = 2.0 * image.sample(tangents.uv * *scale).as_dvec3() - 1.0;
                let local = DVec3::new(texel.x * strength, texel.y * strength, texel.z);
                OrthonormalBasis::from_derivatives(n_geom, tangents.dpdu, tangents.dpdv).world_from_local(local)
            }
            Some(Relief::Height { image, scale, depth }) => {
                let slope = image.gradient(tangents.uv * *scale) * *scale * *depth;
                // Bump mapping \[Blinn78\]: the normal of S + h n, without the change of n itself.
                let (du, dv) = (tangents.dpdu + slope.x * n_geom, tangents.dpdv + slope.y * n_geom);
                let normal = du.cross(dv);
                if normal.dot(n_geom) < 0.0 { -normal } else { normal }
            }
        };
        // A tilt by a right angle or more has no meaning on a surface that is not displaced.
        tilted.try_normalize().filter(|n| n.dot(n_geom) > 1e-3).unwrap_or(n_geom)
    }

    /// Texture lookups for one scattering and normal.
    #[inline]
    pub fn lookups(&self) -> u32 {
        self.lookups
    }

    /// Whether a map tilts the shading normal.
    pub fn has_relief(&self) -> bool {
        self.relief.is_some()
    }

    /// Whether it has a specular lobe: mirror, glass, polished.
    pub fn is_specular(&self) -> bool {
        match &self.model {
            Model::Polished { reflectance, .. } | Model::Mirror { reflectance } => reflectance.bound() > 0.0,
            Model::Glass { .. } => true,
            Model::Diffuse { .. } | Model::Phong { .. } => false,
        }
    }

    /// An upper bound of the albedo without specular lobes, over the surface and the channels.
    pub fn scattered_bound(&self) -> f32 {
        match &self.model {
            Model::Diffuse { albedo } | Model::Polished { albedo, .. } => albedo.bound(),
            Model::Phong { albedo, specular, .. } => (albedo.bound() + specular.bound()).min(1.0),
            Model::Mirror { .. } | Model::Glass { .. } => 0.0,
        }
    }
}

/// The diffuse albedo, reduced where both lobes together would reflect more light than arrives: validation checks
/// constants, but not texels.
fn within_energy(albedo: Rgb, lobe: Lobe) -> Rgb {
    match lobe {
        Lobe::Phong { specular: other, .. } | Lobe::Mirror { reflectance: other } => {
            albedo.min((Rgb::ONE - other).max(Rgb::ZERO))
        }
        Lobe::None | Lobe::Glass { .. } => albedo,
    }
}
