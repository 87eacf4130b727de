use super::media::{Bodies, Containing};
use super::random::Random;
use super::ray::{Hit, Ray};
use super::scattering::{lobe, reflect, refract};
use super::surfaces::{Kind, Surfaces};
use glam::DVec3;
use patchlight::scene::{Color, Emitter, MaterialModel, Scene};
use std::f64::consts::PI;

/// A scene, prepared for paths.
pub(super) struct Tracer<'a> {
    scene: &'a Scene,
    surfaces: Surfaces,
    bodies: Bodies,
    around_camera: Containing,
}

/// The end of a segment of a path, and the fraction of light that absorption leaves on the way.
struct Segment {
    transmittance: DVec3,
    /// Length; infinite outside of the scene.
    length: f64,
    end: End,
}

enum End {
    /// The ray leaves the scene.
    Outside,
    /// A lamp, by the index of its surface, from its shining side or not.
    Lamp { surface: usize, is_shining: bool },
    /// A surface that scatters light; of an interface of several surfaces the opaque one.
    Surface { hit: Hit, material: usize, interface: Vec<Hit> },
}

impl<'a> Tracer<'a> {
    pub(super) fn new(scene: &'a Scene) -> Self {
        let bodies = Bodies::new(scene);
        let surfaces = Surfaces::new(scene, |object| bodies.of_object(object));
        let around_camera = bodies.around(&surfaces, scene.camera.position);
        Self { scene, surfaces, bodies, around_camera }
    }

    /// The radiance that one random path from the camera brings.
    pub(super) fn radiance(&self, mut ray: Ray, random: &mut Random) -> DVec3 {
        let (mut radiance, mut throughput) = (DVec3::ZERO, DVec3::ONE);
        let mut containing = self.around_camera.clone();
        // Next event estimation has brought the lamps' light to the last vertex; the background lights nothing diffuse.
        let (mut counts_lamps, mut counts_background) = (true, true);
        for bounce in 0..=self.scene.render.max_bounces {
            let segment = self.segment(&mut ray, &mut containing);
            throughput *= segment.transmittance;
            let (hit, material, interface) = match segment.end {
                End::Outside if counts_background => {
                    return radiance + throughput * self.scene.render.background.as_dvec3();
                }
                End::Lamp { surface, is_shining: true } if counts_lamps => {
                    return radiance + throughput * self.lamp(surface);
                }
                End::Outside | End::Lamp { .. } => return radiance,
                End::Surface { .. } if bounce == self.scene.render.max_bounces => return radiance,
                End::Surface { hit, material, interface } => (hit, material, interface),
            };
            let position = ray.at(hit.distance);
            let normal = if hit.normal.dot(ray.direction) < 0.0 { hit.normal } else { -hit.normal };
            let mirrored = reflect(ray.direction, normal);
            let onward = match &self.scene.materials[material].model {
                MaterialModel::Mirror { reflectance } => {
                    counts_lamps = true;
                    throughput *= constant(reflectance);
                    mirrored
                }
                MaterialModel::Glass { tint, .. } => {
                    counts_lamps = true;
                    let behind = self.bodies.behind(&self.surfaces, &containing, &interface, &ray);
                    let (from, to) = (self.index(&containing), self.index(&behind));
                    match refract(ray.direction, hit.normal, from, to) {
                        Some((refracted, reflected)) if random.next() >= reflected => {
                            // Radiance over the square of the index is what refraction keeps.
                            throughput *= constant(tint) * (from / to).powi(2);
                            containing = behind;
                            refracted
                        }
                        _ => mirrored,
                    }
                }
                model => {
                    let (albedo, second, exponent) = match model {
                        MaterialModel::Phong { albedo, specular, exponent } => {
                            (albedo, Some(specular), Some(*exponent))
                        }
                        MaterialModel::Polished { albedo, reflectance } => (albedo, Some(reflectance), None),
                        MaterialModel::Diffuse { albedo } => (albedo, None, None),
                        MaterialModel::Mirror { .. } | MaterialModel::Glass { .. } => unreachable!("matched above"),
                    };
                    let (albedo, second) = (constant(albedo), second.map_or(DVec3::ZERO, constant));
                    let (direct, lobe_probability) = (
                        self.direct(position, normal, &containing, random),
                        0.5 * f64::from(u8::from(second != DVec3::ZERO)),
                    );
                    radiance += throughput * albedo / PI * direct;
                    if random.next() < lobe_probability {
                        counts_lamps = true;
                        throughput *= second / lobe_probability;
                        match exponent {
                            None => mirrored,
                            Some(exponent) => {
                                counts_background = false;
                                let sampled = lobe(mirrored, exponent, random);
                                throughput *= (exponent + 2.0) / (exponent + 1.0) * sampled.dot(normal).max(0.0);
                                sampled
                            }
                        }
                    } else {
                        (counts_lamps, counts_background) = (false, false);
                        throughput *= albedo / (1.0 - lobe_probability);
                        lobe(normal, 1.0, random)
                    }
                }
            };
            // Russian roulette.
            let survival = throughput.max_element().min(1.0);
            if random.next() >= survival {
                return radiance;
            }
            throughput /= survival;
            ray = Ray { origin: position, direction: onward };
        }
        radiance
    }

    /// Follows a ray to the next surface that does anything with light, through interfaces between equal media. The ray then begins at
    /// the last interface that it crossed.
    fn segment(&self, ray: &mut Ray, containing: &mut Containing) -> Segment {
        let (mut transmittance, mut length) = (DVec3::ONE, 0.0);
        loop {
            let interface = self.surfaces.interface(ray);
            let Some(first) = interface.first() else {
                let absorbs = self.bodies.medium(containing).is_some_and(|body| body.absorption != DVec3::ZERO);
                let transmittance = if absorbs { DVec3::ZERO } else { transmittance };
                return Segment { transmittance, length: f64::INFINITY, end: End::Outside };
            };
            if let Some(body) = self.bodies.medium(containing) {
                transmittance *= (-body.absorption * first.distance).exp();
            }
            length += first.distance;
            let opaque = interface.iter().find(|hit| !self.is_glass(hit.surface));
            let hit = *opaque.unwrap_or(first);
            let material = match self.surfaces.list[hit.surface].kind {
                Kind::Lamp(_) => {
                    let end = End::Lamp { surface: hit.surface, is_shining: hit.normal.dot(ray.direction) < 0.0 };
                    return Segment { transmittance, length, end };
                }
                Kind::Object { material, .. } => material,
            };
            let behind = self.bodies.behind(&self.surfaces, containing, &interface, ray);
            if opaque.is_some() || !self.is_one_medium(containing, &behind) {
                return Segment { transmittance, length, end: End::Surface { hit, material, interface } };
            }
            *containing = behind;
            *ray = Ray { origin: ray.at(hit.distance), direction: ray.direction };
        }
    }

    /// Irradiance of a point by one point of each lamp.
    fn direct(&self, position: DVec3, normal: DVec3, containing: &Containing, random: &mut Random) -> DVec3 {
        let mut irradiance = DVec3::ZERO;
        for (surface, lamp) in self.surfaces.list.iter().enumerate() {
            let Kind::Lamp(radiance) = lamp.kind else { continue };
            let (point, lamp_normal, area) = lamp.shape.sample(random.next(), random.next());
            let offset = point - position;
            let direction = offset.normalize();
            let (cos, lamp_cos) = (normal.dot(direction), -lamp_normal.dot(direction));
            if cos > 0.0 && lamp_cos > 0.0 {
                let segment = self.segment(&mut Ray { origin: position, direction }, &mut containing.clone());
                if matches!(segment.end, End::Lamp { surface: met, is_shining: true } if met == surface) {
                    irradiance += segment.transmittance * radiance * cos * lamp_cos * area / offset.length_squared();
                }
            }
        }
        for light in &self.scene.lights {
            let Emitter::Point { position: lamp, intensity } = light.emitter else { continue };
            let offset = lamp - position;
            let direction = offset.normalize();
            let cos = normal.dot(direction);
            if cos > 0.0 {
                irradiance += self.transmittance(position, lamp, containing) * intensity.as_dvec3() * cos
                    / offset.length_squared();
            }
        }
        irradiance
    }

    /// The fraction of light that a straight way leaves; 0 where a surface is in the way.
    fn transmittance(&self, from: DVec3, to: DVec3, containing: &Containing) -> DVec3 {
        let mut ray = Ray { origin: from, direction: (to - from).normalize() };
        if self.segment(&mut ray, &mut containing.clone()).length < from.distance(to) {
            return DVec3::ZERO;
        }
        self.bodies.medium(containing).map_or(DVec3::ONE, |body| (-body.absorption * from.distance(to)).exp())
    }

    fn lamp(&self, surface: usize) -> DVec3 {
        match self.surfaces.list[surface].kind {
            Kind::Lamp(radiance) => radiance,
            Kind::Object { .. } => DVec3::ZERO,
        }
    }

    fn is_glass(&self, surface: usize) -> bool {
        matches!(self.surfaces.list[surface].kind, Kind::Object { body: Some(_), .. })
    }

    fn index(&self, containing: &Containing) -> f64 {
        self.bodies.medium(containing).map_or(1.0, |body| body.ior)
    }

    fn is_one_medium(&self, a: &Containing, b: &Containing) -> bool {
        let medium =
            |containing| self.bodies.medium(containing).map_or((1.0, DVec3::ZERO), |body| (body.ior, body.absorption));
        medium(a) == medium(b)
    }
}

/// A colour without a texture.
fn constant(color: &Color) -> DVec3 {
    match color {
        Color::Constant(color) => color.as_dvec3(),
        Color::Texture(_) => panic!("the oracle knows no textures"),
    }
}
