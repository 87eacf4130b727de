//! The one scattering event at mirrors and smooth dielectric interfaces, for camera paths, photons and caustic photons alike.

use super::bsdf;
use super::medium::Media;
use super::vertex::Vertex;
use crate::math::{Rgb, Sampler};
use crate::world::{Lobe, World};
use glam::DVec3;

/// How a mirror or an interface sends a path on.
pub(in crate::transport) struct SpecularEvent {
    /// Along the mirror direction.
    pub(in crate::transport) reflected: Continuation,
    /// Through the interface; `None` at mirrors and at total reflection.
    pub(in crate::transport) refracted: Option<Continuation>,
}

/// One direction in which a path goes on.
pub(in crate::transport) struct Continuation {
    /// Unit length.
    pub(in crate::transport) direction: DVec3,
    /// Reflectance of a mirror, tint of glass for refracted light, else 1.
    pub(in crate::transport) tint: Rgb,
    /// Part of the light that goes this way by Fresnel's equations, 0 to 1.
    pub(in crate::transport) fraction: f64,
    /// `eta^2` of a refracted direction, else 1. Radiance is divided by it, because the interface squeezes it into another solid
    /// angle; flux is not \[Veach97, 5.2\].
    solid_angle_ratio: f64,
    /// The media that the path is in from here on.
    pub(in crate::transport) media: Media,
}

impl SpecularEvent {
    /// The event at a vertex for a path in these media; `None` where the surface neither mirrors nor refracts.
    #[inline]
    pub(in crate::transport) fn at(world: &World, vertex: &Vertex, media: &Media) -> Option<Self> {
        match vertex.scattering.lobe {
            Lobe::None | Lobe::Phong { .. } => None,
            Lobe::Mirror { reflectance } => {
                Some(Self { reflected: Continuation::mirrored(vertex, media, reflectance, 1.0), refracted: None })
            }
            Lobe::Glass { tint, .. } => Some(Self::at_interface(world, vertex, media, tint)),
        }
    }

    #[inline]
    fn at_interface(world: &World, vertex: &Vertex, media: &Media, tint: Rgb) -> Self {
        let entering = vertex.point.front;
        let eta = media.eta(world, vertex.material, entering);
        let fresnel = bsdf::fresnel(vertex.wo.dot(vertex.n_shade), eta);
        let reflected = Continuation::mirrored(vertex, media, Rgb::ONE, fresnel.reflectance);
        let refracted = (fresnel.reflectance < 1.0).then(|| Continuation {
            direction: bsdf::refract(vertex.wo, vertex.n_shade, eta, fresnel.cos_transmitted),
            tint,
            fraction: 1.0 - fresnel.reflectance,
            solid_angle_ratio: eta * eta,
            media: media.crossed(vertex.material, entering),
        });
        Self { reflected, refracted }
    }

    /// One of the directions, each with its fraction as probability, by a number in `[0, 1)`.
    #[inline]
    pub(in crate::transport) fn choose(self, u: f64) -> Continuation {
        match self.refracted {
            Some(refracted) if u >= self.reflected.fraction => refracted,
            _ => self.reflected,
        }
    }
}

impl Continuation {
    /// The factor of radiance along a camera path, without the Fresnel fraction.
    #[inline]
    pub(in crate::transport) fn radiance_weight(&self) -> Rgb {
        self.tint / self.solid_angle_ratio as f32
    }

    #[inline]
    fn mirrored(vertex: &Vertex, media: &Media, tint: Rgb, fraction: f64) -> Self {
        let direction = bsdf::reflect_above(vertex.wo, vertex.n_shade, vertex.n_side);
        Self { direction, tint, fraction, solid_angle_ratio: 1.0, media: media.clone() }
    }
}

/// Russian roulette for a path of this strength: the probability with which it went on, 1 from the threshold on; `None` where it
/// ends. The caller divides by the probability.
#[inline]
pub(in crate::transport) fn roulette(strength: f32, threshold: f32, sampler: &mut Sampler) -> Option<f32> {
    // Written so that a strength of NaN goes on: the film counts and drops it.
    if !(strength < threshold) {
        return Some(1.0);
    }
    let survival = strength / threshold;
    (sampler.next_1d() < f64::from(survival)).then_some(survival)
}
