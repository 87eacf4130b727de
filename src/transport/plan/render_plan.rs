//! The plan that every pass reads.

use super::notes::PlanNote;
use super::radii::Radii;
use super::sheet_lattice::SheetLattice;
use crate::transport::density::Bandwidth;
use crate::transport::density::sample_allocation::SampleAllocation;
use crate::transport::lights::{LightSampler, PhotonEmission, ProjectionMap};
use crate::transport::points::GlossyMis;
use crate::world::Camera;
use std::sync::Arc;

/// The work of every iteration for a scene.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The pinhole and the film's grid, which is coarser for a draft.
    pub camera: Camera,
    /// Whether camera paths look for emission and direct light.
    pub finds_direct_light: bool,
    /// How caustics are rendered; `None` where light cannot meet mirrors or glass.
    pub caustics: Option<CausticPlan>,
    /// Samples lights for direct light.
    pub light_sampler: Arc<LightSampler>,
    /// Weights between camera paths and photons for light in Phong lobes.
    pub glossy_mis: GlossyMis,
    /// How photons of interreflection leave each light.
    pub photon_emissions: Arc<Vec<PhotonEmission>>,
    /// Photon paths of interreflection in a full iteration, by light; empty without interreflection.
    pub global_paths: Vec<u64>,
    /// Whether neighbours reuse each other's samples of Phong lobes.
    pub reuses_lobes: bool,
    /// Radii of density estimates after one full iteration.
    pub radii: Radii,
    /// Every decision.
    pub notes: Vec<PlanNote>,
    /// The light that one photon path would bring.
    pub(super) radiance_of_path: RadianceOfPath,
    /// Whether the plan is for a quick first picture.
    pub(super) is_draft: bool,
    /// The pixels of a draft; `None` for all.
    pub(super) draft_pixels: Option<Arc<[bool]>>,
    /// Measured radii, from the first refinement on.
    pub(super) bandwidth: Option<Arc<Bandwidth>>,
    /// Measured sample counts, from the first refinement on.
    pub(super) samples: Option<Arc<SampleAllocation>>,
    /// Whether refinements leave the plan as it is.
    pub(super) is_kept: bool,
}

/// Mean radiance over the film that one path would bring after one full iteration, by component.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RadianceOfPath {
    /// Of a camera sample in the narrowest beam.
    pub(super) direct: f64,
    pub(super) caustics: f64,
    pub(super) interreflection: f64,
}

/// How caustics are rendered.
#[derive(Clone, Debug)]
pub struct CausticPlan {
    /// Photon paths of a full iteration, by light.
    pub paths: Vec<u64>,
    /// Directions in which each light meets mirrors or glass.
    pub projection_maps: Arc<Vec<ProjectionMap>>,
    /// For each light, whether sheets of light bring its caustics, as far as they are smooth.
    pub sheets: Vec<bool>,
    /// How many rays these sheets have.
    pub lattice: SheetLattice,
    /// Whether the camera may see caustics in mirrors, through glass or in Phong lobes.
    pub seen_indirectly: bool,
    /// Until radii are measured, directly seen caustics of this many full iterations are gathered from the map, which is smoother than
    /// splats while photons are few.
    pub gathered_iterations: f64,
}

impl Plan {
    /// Whether the plan is for a quick first picture.
    pub(in crate::transport) fn is_draft(&self) -> bool {
        self.is_draft
    }

    /// Whether visible points gather any photons.
    pub(in crate::transport) fn gathers(&self) -> bool {
        self.caustics.is_some() || !self.global_paths.is_empty()
    }
}
