//! The plan of a quick first picture.

use super::paths::allocate;
use super::radii::DRAFT_RADIUS;
use super::render_plan::{CausticPlan, Plan};

/// Least and most photon paths of a draft for caustics, of which there is one per pixel in between: fewer leave too much noise, more take
/// longer than the frame that a draft may take.
const CAUSTIC_PATHS: [f64; 2] = [4096.0, 32_768.0];
/// Least and most photon paths of a draft for interreflection, for the same reasons.
const GLOBAL_PATHS: [f64; 2] = [1024.0, 8192.0];
/// Photon paths of a draft for interreflection, for each pixel: interreflection is smooth, so a draft blurs it instead.
const GLOBAL_PATHS_PER_PIXEL: f64 = 0.25;

impl Plan {
    /// The plan for a first picture of bounded cost: every `coarseness`-th pixel each way, and fewer photons, in discs that hold about
    /// equally many of them for any number of pixels.
    pub fn draft(&self, coarseness: u32) -> Self {
        let size = |pixels: u32| pixels.div_ceil(coarseness.max(1)).max(1);
        let camera = self.camera.resized(size(self.camera.width), size(self.camera.height));
        let pixels = camera.pixel_count() as f64;
        let fewer = |paths: &[u64], total: f64| allocate(paths.iter().map(|&p| p as f64).collect(), total);
        let caustic_paths = pixels.clamp(CAUSTIC_PATHS[0], CAUSTIC_PATHS[1]);
        let global_paths = (GLOBAL_PATHS_PER_PIXEL * pixels).clamp(GLOBAL_PATHS[0], GLOBAL_PATHS[1]);
        let wider = |paths_per_pixel: f64, paths: f64| (paths_per_pixel * pixels / paths).sqrt().max(1.0);
        let caustic_wider = wider(1.0, caustic_paths);
        let global_radius = DRAFT_RADIUS * wider(GLOBAL_PATHS_PER_PIXEL, global_paths);
        let radii = self.radii.draft(caustic_wider, global_radius);
        let caustics = self.caustics.as_ref().map(|caustics| CausticPlan {
            paths: fewer(&caustics.paths, caustic_paths),
            gathered_iterations: f64::INFINITY,
            ..caustics.clone()
        });
        Self {
            camera,
            caustics,
            glossy_mis: self.glossy_mis.draft(camera, |paths| fewer(paths, global_paths), radii.glossy),
            global_paths: fewer(&self.global_paths, global_paths),
            radii,
            is_draft: true,
            bandwidth: None,
            samples: None,
            ..self.clone()
        }
    }
}
