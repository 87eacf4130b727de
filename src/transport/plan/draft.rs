//! The plan of a quick first picture.

use super::paths::share;
use super::{CausticPlan, Plan};

/// Radius for interreflection in a draft, pixels' footprints.
const DRAFT_RADIUS: f64 = 16.0;
/// How far from each other pixels of a draft are at most that share what they see in lobes, pixels' footprints: next to each
/// other.
const DRAFT_LOBE_REACH: f64 = 1.5;

impl Plan {
    /// The plan for a first picture of bounded cost: every `coarseness`-th pixel each way, and fewer photons, in discs that
    /// hold as many of them however many pixels there are.
    pub fn draft(&self, coarseness: u32) -> Self {
        let size = |pixels: u32| pixels.div_ceil(coarseness.max(1)).max(1);
        let camera = self.camera.resized(size(self.camera.width), size(self.camera.height));
        let pixels = camera.pixel_count() as f64;
        let fewer = |paths: &[u64], total: f64| share(paths.iter().map(|&p| p as f64).collect(), total);
        let (caustic_paths, global_paths) = (pixels.clamp(4096.0, 32_768.0), (0.25 * pixels).clamp(1024.0, 8192.0));
        let wider = |paths_per_pixel: f64, paths: f64| (paths_per_pixel * pixels / paths).sqrt().max(1.0);
        let (caustic_wider, global_wider) = (wider(1.0, caustic_paths), wider(0.25, global_paths));
        let glossy_radius = 0.75 * DRAFT_RADIUS * global_wider;
        let caustics = self.caustics.as_ref().map(|caustics| CausticPlan {
            paths: fewer(&caustics.paths, caustic_paths),
            gathered: f64::INFINITY,
            ..caustics.clone()
        });
        Self {
            camera,
            caustics,
            lobe_light: self.lobe_light.draft(camera, |paths| fewer(paths, global_paths), glossy_radius),
            global_paths: fewer(&self.global_paths, global_paths),
            lobe_reach: DRAFT_LOBE_REACH,
            caustic_radius: caustic_wider * self.caustic_radius,
            least_caustic_radius: caustic_wider * self.caustic_radius,
            least_global_radius: DRAFT_RADIUS * global_wider,
            least_standing_radius: DRAFT_RADIUS * global_wider,
            global_radius: DRAFT_RADIUS * global_wider,
            focused_radius: glossy_radius,
            glossy_radius,
            largest_radius: 0.2,
            is_draft: true,
            bandwidth: None,
            samples: None,
            ..self.clone()
        }
    }
}
