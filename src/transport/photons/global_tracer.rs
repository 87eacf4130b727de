//! Photon paths of interreflection: light that was scattered in many directions at least once before it arrives.

use super::photon::Photon;
use super::photon_path::PhotonPath;
use super::stored::GlobalPhotons;
use crate::math::{Rgb, Sampler};
use crate::transport::energy::power;
use crate::transport::lights::PhotonEmission;
use crate::transport::lights::emission::{self, Emission};
use crate::transport::points::{GlossyMis, Vertex, bsdf};
use crate::world::{Surface, World};
use glam::DVec3;

/// Distance of a point in front of a surface, relative to the coordinates of a photon: above the rounding of `f32`.
const OFF_SURFACE: f32 = 1e-5;

/// Traces photon paths and stores their photons.
pub(in crate::transport) struct GlobalPhotonTracer<'a> {
    world: &'a World,
    emissions: &'a [PhotonEmission],
    glossy_mis: Option<&'a GlossyMis>,
    /// The photons so far.
    pub(in crate::transport) stored: GlobalPhotons,
}

/// The points, a little in front of surfaces, where one path of a light meets diffuse and glossy surfaces, from the first one on.
pub(in crate::transport) fn arrivals_of_path(
    world: &World,
    emissions: &[PhotonEmission],
    light: usize,
    mut sampler: Sampler,
) -> Vec<DVec3> {
    let mut tracer = GlobalPhotonTracer::new(world, emissions, None);
    let Some(path) = tracer.start(light, 1, &mut sampler) else { return Vec::new() };
    // As if a surface had scattered it before: so the first arrival leaves a photon, too.
    let path = PhotonPath { was_scattered: true, ..path };
    tracer.follow(path, &mut sampler);
    let GlobalPhotons { photons, indirect_caustics, .. } = tracer.stored;
    let in_front = |photon: &Photon| {
        let offset = OFF_SURFACE * photon.position.abs().max_element();
        world.view.origin + photon.position.as_dvec3() + (offset * photon.wi).as_dvec3()
    };
    photons.iter().chain(&indirect_caustics).map(in_front).collect()
}

impl<'a> GlobalPhotonTracer<'a> {
    /// A tracer with nothing stored. Without MIS weights no photons are stored at Phong lobes.
    pub(in crate::transport) fn new(
        world: &'a World,
        emissions: &'a [PhotonEmission],
        glossy_mis: Option<&'a GlossyMis>,
    ) -> Self {
        Self { world, emissions, glossy_mis, stored: GlobalPhotons::default() }
    }

    /// Traces one of `path_count` paths of a light.
    pub(in crate::transport) fn trace(&mut self, light: usize, path_count: u64, mut sampler: Sampler) {
        if let Some(path) = self.start(light, path_count, &mut sampler) {
            self.follow(path, &mut sampler);
        }
    }

    /// The first ray of a path; `None` where the light does not shine in the sampled direction.
    ///
    /// Inlined, like the next function: a path is so large that a call would copy it.
    #[inline(always)]
    fn start(&mut self, light: usize, path_count: u64, sampler: &mut Sampler) -> Option<PhotonPath> {
        self.stored.counters.global_paths += 1;
        let Emission { origin, direction, flux } = self.emissions[light].emit(&self.world.lights[light], sampler)?;
        let ray = emission::ray_from_light(self.world, light, origin, direction);
        let flux = flux / path_count as f32;
        self.stored.energy.emitted += power(flux);
        Some(PhotonPath {
            light,
            origin,
            ray,
            flux,
            media: self.world.media_at_light(light, ray.at(ray.t_min)),
            bounces: 0,
            was_scattered: false,
            last_was_specular: false,
            mis_density: None,
        })
    }

    #[inline(always)]
    fn follow(&mut self, mut path: PhotonPath, sampler: &mut Sampler) {
        while self.step(&mut path, sampler).is_some() {}
    }

    /// Follows a path to the next surface and off it; `None` where the path ends.
    fn step(&mut self, path: &mut PhotonPath, sampler: &mut Sampler) -> Option<()> {
        let GlobalPhotons { counters, energy, .. } = &mut self.stored;
        counters.rays += 1;
        let Some(hit) = self.world.closest_hit(&path.ray) else {
            energy.escaped += power(path.flux);
            return None;
        };
        let Surface::Object { front_side, material, .. } = self.world.surfaces[hit.primitive as usize] else {
            energy.met_light += power(path.flux);
            return None;
        };
        let transmittance = self.world.transmittance(&path.media, hit.t);
        energy.absorb_in_media(path.flux, transmittance);
        path.flux *= transmittance;
        let vertex = Vertex::at_hit(self.world, &path.ray, hit, [front_side, material], counters);
        let arrived = power(path.flux);
        if vertex.scattering.albedo != Rgb::ZERO {
            energy.arrived += arrived;
        }
        if path.bounces < self.world.max_bounces {
            self.store(path, &vertex, arrived);
        }
        self.go_on(path, &vertex, arrived, sampler)
    }

    /// Sends a path, which arrives with this power, on from a vertex; `None` where it ends.
    fn go_on(&mut self, path: &mut PhotonPath, vertex: &Vertex, arrived: f64, sampler: &mut Sampler) -> Option<()> {
        let energy = &mut self.stored.energy;
        if path.bounces + 1 >= self.world.max_bounces {
            energy.cut_off += arrived;
            return None;
        }
        let bounces = path.bounces;
        let direction = path.scatter(self.world, vertex, sampler, energy, arrived)?;
        path.mis_density = self.mis_density(path, bounces, vertex, direction);
        path.ray = vertex.ray(self.world, direction);
        path.flux.is_finite().then_some(())
    }

    /// Stores the photons that a path, which arrives with this power, leaves at a vertex.
    fn store(&mut self, path: &PhotonPath, vertex: &Vertex, arrived: f64) {
        let stored = &mut self.stored;
        if path.was_scattered && vertex.scattering.albedo != Rgb::ZERO {
            let photons = if path.last_was_specular { &mut stored.indirect_caustics } else { &mut stored.photons };
            photons.push(Photon::arrived(self.world, vertex, path.flux, path.bounces));
            stored.counters.photons_stored += 1;
            stored.energy.stored += arrived;
        } else if vertex.scattering.albedo != Rgb::ZERO {
            stored.energy.camera_paths += arrived;
        }
        if let Some(density) = path.mis_density {
            self.store_at_lobe(path, density, vertex);
        }
    }

    /// Stores a photon at a Phong lobe, its flux times the MIS weight of photons.
    #[inline(never)]
    fn store_at_lobe(&mut self, path: &PhotonPath, density: f64, vertex: &Vertex) -> Option<()> {
        let mis = self.glossy_mis?;
        let lobe = mis.viewing_lobe(self.world, vertex, vertex.wo, 0.0)?;
        let camera_weight = mis.camera_weight(path.light, density, lobe);
        let energy = &mut self.stored.energy;
        energy.arrived += power(path.flux);
        energy.camera_paths += camera_weight * power(path.flux);
        let weight = 1.0 - camera_weight;
        if weight > 0.0 {
            let flux = weight as f32 * path.flux;
            energy.stored += power(flux);
            self.stored.glossy.push(Photon::arrived(self.world, vertex, flux, path.bounces));
            self.stored.counters.photons_stored += 1;
        }
        Some(())
    }

    /// [`PhotonPath::mis_density`] of a path that leaves a vertex in this direction; `bounces` is the number of events before
    /// the vertex.
    fn mis_density(&self, path: &PhotonPath, bounces: u32, vertex: &Vertex, direction: DVec3) -> Option<f64> {
        match (bounces, path.last_was_specular) {
            (0, false) if self.glossy_mis.is_some_and(GlossyMis::uses_photons) => {
                let light = &self.world.lights[path.light];
                let scattered =
                    f64::from(bsdf::eval(&vertex.scattering, vertex.n_shade, direction, vertex.wo).max_element());
                let emitted = self.emissions[path.light].density(light, path.origin, vertex.point.position);
                Some(scattered * vertex.wo.dot(vertex.n_side) * emitted)
            }
            (1.., true) => path.mis_density,
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Stream;
    use crate::transport::photons::photon::{self, MAX_TAG_BOUNCES};
    use crate::transport::testing::{self, lamp, sphere};

    const PATHS: u64 = 1 << 14;

    /// Photons of a closed room, a sphere of this material with a point light (power 4 pi) off its middle.
    fn traced(material: &str, max_bounces: u32) -> GlobalPhotons {
        let polished = "[[material]]\nname = \"polished\"\ntype = \"polished\"\nalbedo = [0.5, 0.5, 0.5]
            reflectance = [0.5, 0.5, 0.5]\n";
        let room = sphere("room", [0.0; 3], 2.0, material);
        let world = testing::world(&format!(
            "{polished}{room}{}[render]\nmax_bounces = {max_bounces}\n",
            lamp([0.3, -0.2, 0.5])
        ));
        let emissions = PhotonEmission::of_lights(&world);
        let mut tracer = GlobalPhotonTracer::new(&world, &emissions, None);
        for index in 0..PATHS {
            tracer.trace(0, PATHS, Sampler::new(4, Stream::Camera, 0, index));
        }
        tracer.stored
    }

    /// Flux of photons over the light's power.
    fn flux(photons: &[Photon]) -> f64 {
        photons.iter().map(|photon| f64::from(photon.flux.y)).sum::<f64>() / (4.0 * std::f64::consts::PI)
    }

    fn assert_flux(photons: &[Photon], expected: f64, case: &str) {
        let found = flux(photons);
        // Fewer than `max_bounces` photons a path: a standard error below 2 / sqrt(PATHS), which stratification lowers.
        assert!((found - expected).abs() < 6.0 / (PATHS as f64).sqrt(), "{case}: {found} instead of {expected}");
    }

    /// In a closed room of albedo 1/2 the light arrives with 1/2, 1/4, ... of its flux; the first arrival is direct light.
    #[test]
    fn a_closed_room_keeps_the_albedo_at_every_arrival() {
        for (max_bounces, expected) in [(1, 0.0), (2, 0.5), (3, 0.75), (6, 1.0 - 0.5f64.powi(5))] {
            let found = traced("grey", max_bounces);
            assert_flux(&found.photons, expected, &format!("{max_bounces} bounces"));
            assert!(found.indirect_caustics.is_empty() && found.glossy.is_empty());
            assert_eq!(found.counters.photons_stored, found.photons.len() as u64);
            assert_eq!(found.counters.global_paths, PATHS);
        }
    }

    /// Where half of the light is scattered and half mirrored, arrival k (from 0) comes from diffuse reflection with 1/2, and from the
    /// mirror after some diffuse event with `1/2 (1 - 2^(1 - k))`.
    #[test]
    fn light_from_mirrors_is_kept_apart() {
        let found = traced("polished", 4);
        assert_flux(&found.photons, 3.0 * 0.5, "scattered");
        assert_flux(&found.indirect_caustics, 0.25 + 0.375, "mirrored after it was scattered");
    }

    #[test]
    fn tags_count_scattering_events() {
        let found = traced("white", 5);
        let count = |bounces: u32| found.photons.iter().filter(|p| p.tag & MAX_TAG_BOUNCES == bounces).count() as u64;
        assert_eq!([0, 1, 2, 3, 4, 5].map(count), [0, PATHS, PATHS, PATHS, PATHS, 0], "white keeps every path");
        // The room is object 0, seen from inside.
        assert!(found.photons.iter().all(|p| p.tag & !MAX_TAG_BOUNCES == photon::tag(0, 0)));
    }

    #[test]
    fn paths_arrive_where_light_comes_first() {
        let world = testing::world(&[sphere("room", [0.0; 3], 2.0, "black"), lamp([0.0; 3])].concat());
        let arrivals =
            arrivals_of_path(&world, &PhotonEmission::of_lights(&world), 0, Sampler::new(4, Stream::Camera, 0, 0));
        assert!(arrivals.is_empty(), "a black room stores nothing");
        let world = testing::world(&[sphere("room", [0.0; 3], 2.0, "grey"), lamp([0.0; 3])].concat());
        let arrivals =
            arrivals_of_path(&world, &PhotonEmission::of_lights(&world), 0, Sampler::new(4, Stream::Camera, 0, 0));
        let distance = arrivals.first().expect("the first arrival counts, too").length();
        assert!(distance < 2.0 && distance > 2.0 - 1e-4, "a little in front of the wall: {distance}");
    }
}
