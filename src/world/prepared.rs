use super::bodies::{Surroundings, touching};
use super::texture::TextureKey;
use super::texture_place::TexturePlaces;
use super::{
    Body, Camera, Contacts, Image, Light, LightMedia, Material, Media, Precision, Scattering, Surface, SurfacePoint,
    View,
};
use crate::geometry::{Aggregate, Hit};
use crate::math::{Ray, Rgb};
use arrayvec::ArrayVec;
use glam::DVec3;
use std::sync::Arc;

/// Surfaces of glass that may coincide in one point; further ones are not crossed there. Bodies side by side need two, overlapping ones a few;
/// a greater number would only lengthen the list that each event at glass fills.
const MAX_COINCIDENT: usize = 8;

/// A scene as the renderer reads it.
#[derive(Clone, Debug)]
pub struct World {
    /// All surfaces, area lights included.
    pub aggregate: Aggregate,
    /// For each primitive of the aggregate, the object or light that it belongs to.
    pub surfaces: Vec<Surface>,
    /// The materials, in the order of the scene.
    pub materials: Vec<Material>,
    /// The lights with power above zero, in the order of the scene.
    pub lights: Vec<Light>,
    /// For each light, the media in which its paths begin.
    pub light_media: Vec<LightMedia>,
    /// The bodies of glass, in ascending order of their rank: of several around a point, the last one's medium applies.
    pub bodies: Vec<Body>,
    /// Surfaces that coincide with surfaces of glass.
    pub contacts: Contacts,
    /// The media around the camera.
    pub camera_media: Media,
    /// The camera, with the pixel grid of the film.
    pub camera: Camera,
    /// The radiance along rays that leave the scene.
    pub background: Rgb,
    /// The greatest number of scattering events on a path between light and camera.
    pub max_bounces: u32,
    /// What the camera sees.
    pub view: View,
    /// For each primitive of the aggregate, how well its points are known.
    pub(super) precisions: Vec<Precision>,
    /// For each light, how well its points are known.
    pub(super) light_precisions: Vec<Precision>,
    /// Where the patches show their textures.
    pub(super) texture_places: TexturePlaces,
    /// The decoded images, for the next world.
    pub(super) textures: Vec<(TextureKey, Arc<Image>)>,
}

impl World {
    /// The decoded images of textures and maps, each once, in the order in which materials first use them.
    pub fn images(&self) -> impl Iterator<Item = &Arc<Image>> {
        self.textures.iter().map(|(_, image)| image)
    }

    /// The nearest hit of a ray; `None` for a miss. Where glass touches an opaque surface, and where either touches a light, the
    /// hit lies on the opaque surface or the light.
    #[inline]
    pub fn closest_hit(&self, ray: &Ray) -> Option<Hit> {
        self.aggregate.closest_hit(ray).map(|hit| self.on_opaque(ray, hit))
    }

    /// A hit, moved to the opaque surface that coincides with the glass that was hit, or to the light that coincides with either.
    #[inline]
    pub fn on_opaque(&self, ray: &Ray, hit: Hit) -> Hit {
        if self.contacts.of(hit.primitive).is_empty() { hit } else { self.opaque_contact(ray, hit) }
    }

    #[inline(never)]
    fn opaque_contact(&self, ray: &Ray, hit: Hit) -> Hit {
        let point = self.surface_point(ray, hit);
        let mut opaque = self.contacts.of(hit.primitive).iter().filter(|&&q| self.body_of(q).is_none());
        let touched = opaque.find_map(|&q| self.touching(q, &point));
        touched.map_or(hit, |(touched, ..)| Hit { t: hit.t, ..touched })
    }

    /// The surface point of a ray's hit.
    pub fn surface_point(&self, ray: &Ray, hit: Hit) -> SurfacePoint {
        let primitive = &self.aggregate.primitives()[hit.primitive as usize];
        let (position, n_geom) = primitive.surface(ray, &hit);
        SurfacePoint { position, n_geom, front: ray.direction.dot(n_geom) < 0.0, hit }
    }

    /// The hit on a primitive that coincides with another one at this point, and the primitive's geometric normal there.
    pub(super) fn touching(&self, primitive: u32, point: &SurfacePoint) -> Option<(Hit, DVec3)> {
        let shape = &self.aggregate.primitives()[primitive as usize];
        let distance = self.rounding(point, point.hit.primitive).max(self.rounding(point, primitive));
        touching(shape, primitive, [point.position, point.n_geom], distance)
    }

    /// The index in the scene of the object that a primitive belongs to; `None` for the surface of a light.
    pub fn object_of(&self, primitive: u32) -> Option<u32> {
        match self.surfaces[primitive as usize] {
            Surface::Object { object, .. } => Some(object),
            Surface::Light(_) => None,
        }
    }

    /// The rank of the body that a primitive bounds; `None` if it is not of glass.
    #[inline]
    pub fn body_of(&self, primitive: u32) -> Option<u32> {
        match self.surfaces[primitive as usize] {
            Surface::Object { body, .. } => body,
            Surface::Light(_) => None,
        }
    }

    /// The media before and behind the interface of glass at a point, for a path in these media: it crosses all surfaces that coincide
    /// there at once.
    #[inline]
    pub fn across(&self, point: &SurfacePoint, media: &Media) -> (Media, Media) {
        let primitive = point.hit.primitive;
        let mut crossings: ArrayVec<(u32, bool), MAX_COINCIDENT> = ArrayVec::new();
        crossings.extend(self.body_of(primitive).map(|body| (body, point.front)));
        for &other in self.contacts.of(primitive) {
            let (Some(body), Some((_, n_geom))) = (self.body_of(other), self.touching(other, point)) else { continue };
            // A full list loses surfaces beyond the eighth in one place.
            let _full = crossings.try_push((body, n_geom.dot(point.n_side()) > 0.0));
        }
        media.across(&crossings)
    }

    /// The body whose medium applies in these media; `None` in air.
    #[inline]
    pub fn body(&self, media: &Media) -> Option<&Body> {
        media.body().map(|rank| &self.bodies[rank as usize])
    }

    /// Transmittance of these media over a distance, scene units.
    #[inline]
    pub fn transmittance(&self, media: &Media, distance: f64) -> Rgb {
        self.body(media).map_or(Rgb::ONE, |body| body.transmittance(distance))
    }

    /// The media in which a path begins at a point of a light, which for an area light is to lie just off its surface.
    pub fn media_at_light(&self, light: usize, point: DVec3) -> Media {
        match &self.light_media[light] {
            LightMedia::Uniform(media) => media.clone(),
            LightMedia::Mixed => self.media_around(point),
        }
    }

    /// The bodies whose inside faces the point.
    pub fn media_around(&self, point: DVec3) -> Media {
        let (aggregate, surfaces, bodies) = (&self.aggregate, &self.surfaces, &self.bodies);
        Surroundings { aggregate, surfaces, bodies }.media(point)
    }

    /// The scattering of a material at a point, and the unit shading normal on the side that the ray came from.
    #[inline]
    pub fn scattering(&self, point: &SurfacePoint, material: u32) -> (Scattering, DVec3) {
        let material = &self.materials[material as usize];
        material
            .uniform()
            .map_or_else(|| self.textured_scattering(point, material), |scattering| (scattering, point.n_side()))
    }

    /// The scattering and the shading normal of a material with textures. Not inlined, so that the loops of scenes without
    /// textures stay small.
    #[inline(never)]
    fn textured_scattering(&self, point: &SurfacePoint, material: &Material) -> (Scattering, DVec3) {
        let primitive = &self.aggregate.primitives()[point.hit.primitive as usize];
        let tangents = primitive.tangents(&point.hit, point.n_geom);
        let tangents = self.texture_places.tangents(point.hit.primitive, tangents);
        let n_front = material.shading_normal(point.n_geom, &tangents);
        // On the back side mirrored in the tangent plane, so that bumps stay bumps.
        let n_shade = if point.front { n_front } else { n_front - 2.0 * n_front.dot(point.n_geom) * point.n_geom };
        (material.scattering(tangents.uv), n_shade)
    }

    /// The origin of a ray that leaves a surface point in this direction: offset from the surface, to the side of the
    /// direction, by more than rounding.
    pub fn leave(&self, point: &SurfacePoint, direction: DVec3) -> DVec3 {
        let offset = self.rounding(point, point.hit.primitive);
        point.position + point.n_geom * offset.copysign(direction.dot(point.n_geom))
    }

    /// Least distance from a point of a light at which rays that leave it in this direction (unit length), and shadow rays that arrive in the
    /// opposite direction, meet surfaces, scene units: the height above the light is beyond rounding. It is the same for both, so that light
    /// crosses a nearer surface either as a photon and as direct light, or as neither. 0 for suns and beams.
    #[inline]
    pub fn clearance_of_light(&self, light: usize, point: DVec3, direction: DVec3) -> f64 {
        match &self.lights[light] {
            Light::Parallel(_) => 0.0,
            Light::Point { .. } => self.light_precisions[light].contact,
            area @ (Light::Sphere { .. } | Light::Quad { .. }) => self.clearance_of_area(light, area, point, direction),
        }
    }

    #[inline(never)]
    fn clearance_of_area(&self, index: usize, light: &Light, point: DVec3, direction: DVec3) -> f64 {
        let normal = light.normal(point).unwrap_or(direction);
        self.light_precisions[index].rounding(point, normal) / direction.dot(normal).abs()
    }

    /// How far rounding may move a primitive, and the surfaces that touch it, at a point along the point's normal, scene units.
    #[inline]
    fn rounding(&self, point: &SurfacePoint, primitive: u32) -> f64 {
        self.precisions[primitive as usize].rounding(point.position, point.n_geom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Sampler, Stream, warp};
    use crate::scene::{Location, SceneFile};
    use crate::world::prepare;

    /// The world of one object of this shape.
    fn world(shape: &str) -> World {
        let text = format!(
            "version = 1\n[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 0]\nfov_y = 40
            [[material]]\nname = \"m\"\ntype = \"diffuse\"\nalbedo = [1, 1, 1]
            [[object]]\nname = \"o\"\nmaterial = \"m\"\n{shape}\n"
        );
        let file = SceneFile::parse(&text, Location::Unsaved).expect("the scene is valid");
        prepare(&file.scene, &file.location, None).expect("the scene can be prepared")
    }

    /// Points of flat and convex surfaces near the origin, whose primitives reach far: rays that leave them to the outside meet nothing, and
    /// begin no farther off than this.
    fn assert_leaves(shape: &str, from: DVec3, farthest: f64) {
        let world = world(shape);
        let mut hits = 0;
        for k in 0..2000 {
            let mut sampler = Sampler::new(1, Stream::Probe, 0, k);
            let target = 0.3 * warp::uniform_sphere(sampler.next_2d());
            let ray = Ray::new(from, (target - from).normalize());
            let Some(hit) = world.closest_hit(&ray) else { continue };
            let point = world.surface_point(&ray, hit);
            let direction = warp::uniform_sphere(sampler.next_2d());
            let direction = direction * direction.dot(point.n_side()).signum();
            let left = Ray::new(world.leave(&point, direction), direction);
            assert!(
                left.origin.distance(point.position) <= farthest,
                "{shape}: {}",
                left.origin.distance(point.position)
            );
            assert_eq!(world.closest_hit(&left), None, "{shape}: leaves {} towards {direction}", point.position);
            hits += 1;
        }
        assert!(hits > 1000, "{shape}: {hits} hits");
    }

    #[test]
    fn rays_leave_surfaces_of_any_size() {
        let above = DVec3::new(0.2, 3.0, 0.1);
        for size in [1.0, 1e3, 1e6, 1e9f64] {
            let half = 0.5 * size;
            let quad = |corner: [f64; 3], u: [f64; 3], v: [f64; 3]| {
                format!("type = \"quad\"\ncorner = {corner:?}\nedge_u = {u:?}\nedge_v = {v:?}")
            };
            let level = quad([-half, 0.1, half], [size, 0.0, 0.0], [0.0, 0.0, -size]);
            assert_leaves(&level, above, 1e-11 * (0.1 + 1e-3 * size));
            let tilted = quad([-half, -0.3 * half, half], [size, 0.3 * size, 0.0], [0.0, 0.0, -size]);
            assert_leaves(&tilted, above, 1e-11 * size);
            let ball = format!("type = \"sphere\"\ncenter = [0, {:?}, 0]\nradius = {size:?}", -size);
            assert_leaves(&ball, above, 1e-10 * size);
            let plane = |point: [f64; 3]| format!("type = \"plane\"\npoint = {point:?}\nnormal = [0.6, 0.8, 0]");
            assert_leaves(&plane([0.8 * size, -0.6 * size, size]), above, 3e-11 * size);
            let row = |i: i32| {
                let at = |k: i32| (f64::from(k) / 3.0 - 0.5) * size;
                (0..4).map(|j| [at(i), 0.3 * at(i), -at(j)]).collect::<Vec<_>>()
            };
            let rows: Vec<_> = (0..4).map(row).collect();
            assert_leaves(&format!("type = \"bezier\"\npatches = [{rows:?}]"), above, 1e-10 * size);
        }
    }
}
