use crate::geometry::Primitive;
use crate::geometry::bezier::ControlNet;
use crate::math::Rgb;
use crate::transport::counters::Counters;
use crate::transport::lights::emission::Emission;
use crate::transport::photons::{CausticBranch, Signature};
use crate::transport::points::Vertex;
use crate::world::{Light, Surface, World};
use glam::{DVec2, DVec3};

/// A ray that meets the object within this part of the patch's size from the aimed point has met that point.
const NEAR: f64 = 1e-4;
/// Lines along the edge of a patch keep this distance in u and v, so that no ray passes beside the edge by rounding.
const INSET: f64 = 1e-6;
/// Most surfaces on a way.
const MOST_SURFACES: u32 = 64;

/// Where the light of a way lands: on the first surface that scatters it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Landing {
    /// The surfaces on the way, with the sides on which the light met the patch and the surface where it lands.
    pub(super) signature: Signature,
    /// In scene units.
    pub(super) position: DVec3,
    /// Geometric unit normal on the lit side.
    pub(super) n_side: DVec3,
}

/// A light and a patch that it may shine on.
#[derive(Clone, Copy)]
pub(super) struct Source<'w> {
    pub(super) world: &'w World,
    light: usize,
    object: u32,
    net: &'w ControlNet,
    /// The diagonal of the patch's box, scene units.
    size: f64,
}

impl<'w> Source<'w> {
    /// The light and the patch by their indices in the world; `None` for a primitive that is no patch of an object.
    pub(super) fn new(world: &'w World, light: usize, primitive: u32) -> Option<Self> {
        let Primitive::Patch(patch) = &world.aggregate.primitives()[primitive as usize] else { return None };
        let object = world.object_of(primitive)?;
        Some(Self { world, light, object, net: patch.net(), size: patch.bounds().diagonal() })
    }

    /// Where light lands that leaves the light straight to the point of the patch at `uv`, in `[0, 1]^2`. `None` where the light does not
    /// reach the point, or where what the patch sends on lands nowhere.
    pub(super) fn landing(&self, uv: DVec2) -> Option<Landing> {
        self.follow(uv, |_| ()).1
    }

    /// The corners of the way of that light: on the light, on each surface, and where it lands. Light that leaves the scene ends in the
    /// open. Empty where the light does not reach the point.
    pub(super) fn way(&self, uv: DVec2) -> Vec<DVec3> {
        let mut corners = Vec::new();
        if self.follow(uv, |corner| corners.push(corner)).0 { corners } else { Vec::new() }
    }

    /// Calls `visit` at each corner of a way. Returns whether it begins with the point of the patch, and where it lands.
    fn follow(&self, uv: DVec2, mut visit: impl FnMut(DVec3)) -> (bool, Option<Landing>) {
        let world = self.world;
        let uv = uv.clamp(DVec2::splat(INSET), DVec2::splat(1.0 - INSET));
        let point = self.net.eval(uv.x, uv.y);
        let Some(emission) = self.emission(point) else { return (false, None) };
        let mut branch = CausticBranch::from_light(world, self.light, emission);
        visit(branch.ray.at(branch.ray.t_min));
        for surface in 0..MOST_SURFACES {
            let is_first = surface == 0;
            let Some(hit) = world.closest_hit(&branch.ray) else {
                visit(branch.ray.at(self.open_end()));
                return (!is_first, None);
            };
            let Surface::Object { front_side, material, .. } = world.surfaces[hit.primitive as usize] else {
                visit(branch.ray.at(hit.t));
                return (!is_first, None);
            };
            let vertex = Vertex::at_hit(world, &branch.ray, hit, [front_side, material], &mut Counters::default());
            visit(vertex.point.position);
            if is_first {
                let is_object = world.object_of(hit.primitive) == Some(self.object);
                if !is_object || vertex.point.position.distance(point) > NEAR * self.size {
                    return (false, None);
                }
                // Light on the two sides of a patch goes different ways.
                branch.signature = branch.signature.arrived(vertex.side);
            } else if vertex.scatters() {
                let signature = branch.signature.arrived(vertex.side);
                let landing = Landing { signature, position: vertex.point.position, n_side: vertex.n_side };
                return (true, (branch.bounces < world.max_bounces).then_some(landing));
            }
            // Refracted light is the last of the ways on, where there is any.
            let way = branch.ways_on(world, &vertex).last();
            let Some(way) = way.filter(|_| branch.bounces + 1 < world.max_bounces) else {
                return (true, None);
            };
            branch = branch.along(world, &vertex, way, Rgb::ONE);
        }
        (true, None)
    }

    /// The ray from the middle of the light to a point; `None` where the light does not shine.
    fn emission(&self, point: DVec3) -> Option<Emission> {
        let light = &self.world.lights[self.light];
        let along = (point - light.center()).try_normalize()?;
        let (origin, direction) = match light {
            Light::Point { position, .. } => (*position, along),
            Light::Sphere { sphere, .. } => (sphere.center + sphere.radius * along, along),
            Light::Quad { quad, .. } => (quad.position(0.5, 0.5), along),
            Light::Parallel(rays) => (rays.point(rays.crossing(point, rays.direction)), rays.direction),
        };
        let shines = match light {
            Light::Point { .. } => true,
            Light::Sphere { sphere, .. } => point.distance(sphere.center) > sphere.radius,
            Light::Quad { quad, .. } => quad.normal().dot(along) > 0.0,
            Light::Parallel(rays) => {
                let is_in = origin.distance(rays.center) <= rays.radius && rays.direction.dot(point - origin) > 0.0;
                rays.from_outside || is_in
            }
        };
        shines.then_some(Emission { origin, direction, flux: Rgb::ONE })
    }

    /// How far a way is drawn that leaves the scene, scene units.
    fn open_end(&self) -> f64 {
        let bounds = self.world.aggregate.bounds();
        if bounds.is_empty() { self.size } else { bounds.diagonal() }
    }
}
