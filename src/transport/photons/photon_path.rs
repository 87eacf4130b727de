//! The state of a photon path of interreflection, and how surfaces scatter it.

use crate::math::{OrthonormalBasis, Ray, Rgb, Sampler, warp};
use crate::transport::energy::{self, PathEnergy, power};
use crate::transport::points::{SpecularEvent, Vertex, bsdf};
use crate::world::{Lobe, Media, Scattering, World};
use glam::{DVec2, DVec3};

/// The state of one photon path.
pub(super) struct PhotonPath {
    pub(super) light: usize,
    /// Point on the light.
    pub(super) origin: DVec3,
    pub(super) ray: Ray,
    pub(super) flux: Rgb,
    pub(super) media: Media,
    /// Scattering events so far.
    pub(super) bounces: u32,
    /// Whether a diffuse or glossy surface scattered it.
    pub(super) was_scattered: bool,
    /// Whether the last event was at a mirror or glass.
    pub(super) last_was_specular: bool,
    /// For a path that the first surface scattered and none since but mirrors and glass: the density that
    /// [`camera_weight`](crate::transport::points::GlossyMis::camera_weight) takes.
    pub(super) mis_density: Option<f64>,
}

/// The event that a path has chosen at a vertex.
struct Choice {
    /// Two numbers for the direction.
    u: DVec2,
    /// The number that chose the event; it also chooses between mirrored and refracted light.
    number: f64,
    /// The probability of the event.
    probability: f64,
    /// Power after the event, by the numbers of the material and before the factors of the direction.
    power: f64,
}

impl PhotonPath {
    /// Scatters the path, which arrives with this power: samples diffuse reflection, the lobe or absorption in proportion to the flux that
    /// each would leave. Returns the new direction, `None` for absorption. This Russian roulette keeps the flux of all photons about equal. It
    /// is not [`roulette`](crate::transport::points::roulette), which only ends paths below a threshold: here the same number also chooses the
    /// event.
    #[inline(always)]
    pub(super) fn scatter(
        &mut self,
        world: &World,
        vertex: &Vertex,
        sampler: &mut Sampler,
        energy: &mut PathEnergy,
        arrived: f64,
    ) -> Option<DVec3> {
        let Scattering { albedo, lobe } = &vertex.scattering;
        let (u, number): (DVec2, f64) = (sampler.next_2d(), sampler.next_1d());
        self.last_was_specular = false;
        let fluxes = [self.flux * *albedo, self.flux * energy::lobe_albedo(lobe)];
        let brightest = self.flux.max_element();
        let [diffuse, of_lobe] = fluxes.map(|flux| f64::from(flux.max_element() / brightest));
        // Of different colours, the brightest channels of both may be more than all light.
        let all = (diffuse + of_lobe).max(1.0);
        let (diffuse, of_lobe) = (diffuse / all, of_lobe / all);
        let diffuse_power = power(fluxes[0]);
        let lobe_power = if matches!(lobe, Lobe::None) { 0.0 } else { power(fluxes[1]) };
        let reflected = diffuse_power + lobe_power;
        if number < diffuse {
            let choice = Choice { u, number, probability: diffuse, power: diffuse_power / diffuse };
            energy.reflect(arrived, reflected, choice.power);
            return self.reflect_diffusely(vertex, &choice, energy);
        }
        // False also for a path without flux, whose probabilities are NaN.
        let meets_lobe = number - diffuse < of_lobe;
        if !meets_lobe {
            energy.reflect(arrived, reflected, 0.0);
            return None;
        }
        let choice = Choice { u, number, probability: of_lobe, power: lobe_power / of_lobe };
        energy.reflect(arrived, reflected, choice.power);
        match lobe {
            Lobe::Phong { .. } => self.follow_gloss(vertex, &choice, energy),
            Lobe::None | Lobe::Mirror { .. } | Lobe::Glass { .. } => {
                self.follow_specular(world, vertex, &choice, energy)
            }
        }
    }

    #[inline(always)]
    fn reflect_diffusely(&mut self, vertex: &Vertex, choice: &Choice, energy: &mut PathEnergy) -> Option<DVec3> {
        self.flux *= vertex.scattering.albedo / choice.probability as f32;
        self.was_scattered = true;
        self.bounces += 1;
        let direction =
            OrthonormalBasis::from_normal(vertex.n_side).world_from_local(warp::cosine_hemisphere(choice.u));
        let factor = bsdf::diffuse_shading_factor(vertex.wo, vertex.n_side, vertex.n_shade);
        if factor != 1.0 {
            self.flux *= factor as f32;
            energy.shading_normals += (1.0 - factor) * choice.power;
        }
        (factor > 0.0).then_some(direction)
    }

    /// Sends the path on in a Phong lobe.
    fn follow_gloss(&mut self, vertex: &Vertex, choice: &Choice, energy: &mut PathEnergy) -> Option<DVec3> {
        let Vertex { scattering, n_side, n_shade, wo: wi, .. } = vertex;
        let Some((direction, weight)) = bsdf::sample_glossy(scattering, *n_shade, *n_side, *wi, choice.u) else {
            energy.phong_lobes += choice.power;
            return None;
        };
        let fraction = bsdf::glossy_fraction(scattering, *n_shade, direction);
        let shading = bsdf::shading_factor(*wi, direction, *n_side, *n_shade);
        energy.phong_lobes += (1.0 - fraction) * choice.power;
        energy.shading_normals += (1.0 - shading) * fraction * choice.power;
        self.flux *= weight / choice.probability as f32;
        self.flux *= shading as f32;
        self.was_scattered = true;
        self.bounces += 1;
        Some(direction)
    }

    /// Sends the path on at a mirror or glass.
    fn follow_specular(
        &mut self,
        world: &World,
        vertex: &Vertex,
        choice: &Choice,
        energy: &mut PathEnergy,
    ) -> Option<DVec3> {
        let (_, next) = SpecularEvent::at(world, vertex, &self.media)?.choose(choice.number);
        if matches!(vertex.scattering.lobe, Lobe::Glass { .. }) {
            energy.absorbed += choice.power - power(self.flux * next.material_tint(&vertex.scattering.lobe));
        }
        self.last_was_specular = true;
        self.flux *= next.tint / choice.probability as f32;
        self.bounces = next.bounces_after(self.bounces);
        self.media = next.media;
        Some(next.direction)
    }
}
