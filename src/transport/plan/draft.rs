//! The plan of a quick first picture.

use super::paths::allocate;
use super::radii::DRAFT_RADIUS;
use super::render_plan::{CausticPlan, Plan};
use super::sheet_lattice::SheetLattice;
use crate::world::Camera;
use std::sync::Arc;

/// Photon paths of a draft for caustics: more would take longer than what they show is worth.
const CAUSTIC_PATHS: f64 = 32_768.0;
/// Least rays of a draft into each cell where a light meets mirrors and glass, for light sheets in place of photons. With fewer, a draft has
/// few cells of sheets, and as they take more time than photons, coarser pixels.
const RAYS_FOR_SHEETS: u64 = 16;
/// Photon paths of a draft for interreflection: it is smooth, so a draft blurs it instead.
const GLOBAL_PATHS: f64 = 8192.0;
/// Photon paths for interreflection and pixel for which the radius of a draft is made.
const GLOBAL_PATHS_PER_PIXEL: f64 = 0.25;

/// How much a draft leaves out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DraftSize {
    /// It has every n-th pixel each way; at least 1.
    pub coarseness: u32,
    /// It has one of n photon paths; at least 1.
    pub thinning: u32,
}

impl DraftSize {
    /// All pixels and photon paths of a draft.
    pub const FULL: Self = Self { coarseness: 1, thinning: 1 };
}

impl Plan {
    /// The plan for a first picture of bounded cost: fewer pixels, and fewer photons, in discs that hold about equally many of them for
    /// any number of pixels. Light that was traced with the plan of one coarseness serves all others of the same thinning.
    pub fn draft(&self, DraftSize { coarseness, thinning }: DraftSize) -> Self {
        let size = |pixels: u32| pixels.div_ceil(coarseness.max(1)).max(1);
        let camera = self.camera.resized(size(self.camera.width), size(self.camera.height));
        let fewer = |paths: &[u64], total: f64| allocate(paths.iter().map(|&p| p as f64).collect(), total);
        let [caustic_paths, global_paths] =
            [CAUSTIC_PATHS, GLOBAL_PATHS].map(|paths| paths / f64::from(thinning.max(1)));
        let radii = |camera: Camera| {
            let pixels = camera.pixel_count() as f64;
            let wider = |paths_per_pixel: f64, paths: f64| (paths_per_pixel * pixels / paths).sqrt().max(1.0);
            let global_radius = DRAFT_RADIUS * wider(GLOBAL_PATHS_PER_PIXEL, global_paths);
            self.radii.draft(wider(1.0, caustic_paths), global_radius)
        };
        let caustics = self.caustics.as_ref().map(|caustics| {
            let paths = fewer(&caustics.paths, caustic_paths);
            let rays_suffice =
                |light: usize| paths[light] >= RAYS_FOR_SHEETS * caustics.projection_maps[light].aimed_cells();
            let sheets = caustics.sheets.iter().enumerate().map(|(light, has)| *has && rays_suffice(light)).collect();
            CausticPlan {
                paths,
                sheets,
                lattice: SheetLattice::DRAFT,
                gathered_iterations: f64::INFINITY,
                ..caustics.clone()
            }
        });
        Self {
            camera,
            caustics,
            glossy_mis: self.glossy_mis.draft(|paths| fewer(paths, global_paths), radii(self.camera).glossy),
            global_paths: fewer(&self.global_paths, global_paths),
            radii: radii(camera),
            is_draft: true,
            bandwidth: None,
            samples: None,
            ..self.clone()
        }
    }

    /// The plan of a draft that leaves out some pixels; `chosen` holds one value for each pixel of the draft.
    pub fn of_pixels(self, chosen: Arc<[bool]>) -> Self {
        Self { draft_pixels: Some(chosen), ..self }
    }
}
