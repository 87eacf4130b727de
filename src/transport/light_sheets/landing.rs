use crate::math::Rgb;
use crate::transport::counters::Counters;
use crate::transport::lights::emission::Emission;
use crate::transport::photons::{CausticBranch, Signature, photon};
use crate::transport::points::Vertex;
use crate::world::{Surface, World};
use glam::{DVec3, Vec3};

/// Least flux of a branch that is followed, over that of its path: below, photons bring the light.
const LEAST_FLUX: f32 = 0.01;
/// Most surfaces on all branches of one ray.
const MOST_SURFACES: u32 = 64;

/// Where light that only mirrors and glass have touched arrives at a surface that scatters it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Landing {
    /// The way of the light, up to the surface.
    pub(super) signature: Signature,
    /// In scene units.
    pub(super) position: DVec3,
    /// Unit direction towards where the light came from.
    pub(super) wi: Vec3,
    /// The flux, W, if all light of the lamp went this way.
    pub(super) flux: Rgb,
    /// The flux over that of the ray, in the strongest channel.
    pub(super) share: f32,
    /// Side of the surface and number of surfaces on the way, as of photons.
    pub(super) tag: u32,
    /// Index of the primitive.
    pub(super) primitive: u32,
}

/// Follows a ray of a light, both ways at glass, and appends where its light lands, sorted by signature.
pub(super) fn trace(
    world: &World,
    light: usize,
    emission: Emission,
    landings: &mut Vec<Landing>,
    counters: &mut Counters,
) {
    let (first, of_path) = (landings.len(), emission.flux.max_element());
    let mut branches = vec![CausticBranch::from_light(world, light, emission)];
    let mut surfaces = 0;
    while let Some(mut branch) = branches.pop() {
        surfaces += 1;
        counters.rays += 1;
        let Some(hit) = world.closest_hit(&branch.ray) else { continue };
        let Surface::Object { front_side, material, .. } = world.surfaces[hit.primitive as usize] else { continue };
        if branch.bounces == 0 && !world.materials[material as usize].is_specular() {
            continue;
        }
        branch.flux *= world.transmittance(&branch.media, hit.t);
        let vertex = Vertex::at_hit(world, &branch.ray, hit, [front_side, material], counters);
        if vertex.scatters() && branch.bounces > 0 && branch.bounces < world.max_bounces {
            landings.push(Landing {
                signature: branch.signature.arrived(vertex.side),
                position: vertex.point.position,
                wi: vertex.wo.as_vec3(),
                flux: branch.flux,
                share: branch.flux.max_element() / of_path,
                tag: photon::tag(vertex.side, branch.bounces),
                primitive: hit.primitive,
            });
        }
        if branch.bounces + 1 >= world.max_bounces || surfaces >= MOST_SURFACES {
            continue;
        }
        for way in branch.ways_on(world, &vertex) {
            let flux = branch.flux * way.0.tint * way.0.fraction as f32;
            // Written so that a flux of NaN ends.
            if flux.max_element() >= LEAST_FLUX * of_path {
                branches.push(branch.along(world, &vertex, way, flux));
            }
        }
    }
    landings[first..].sort_unstable_by_key(|landing| landing.signature);
}
