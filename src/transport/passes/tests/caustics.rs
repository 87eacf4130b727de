use crate::math::lanes::Portable;
use crate::math::{Ray, Rgb};
use crate::transport::light_sheets::SheetQuery;
use crate::transport::passes::{CausticPhotons, PassInput, caustic_photon_pass};
use crate::transport::photons::photon;
use crate::transport::plan::Plan;
use crate::transport::testing;
use crate::world::World;
use glam::{DVec2, DVec3, Vec3};
use std::collections::BTreeMap;

/// The first full iteration.
const FIRST: u64 = 4;

/// The caustics of a scene in some iterations, by light sheets and by the photons of what the sheets leave.
pub(super) struct Caustics {
    world: World,
    passes: Vec<CausticPhotons>,
}

impl Caustics {
    /// By sheets and photons, for a camera of so many pixels along a side.
    pub(super) fn new(scene: &str, pixels: u32, iterations: u64) -> Self {
        Self::by(scene, pixels, iterations, true)
    }

    /// By photons alone.
    pub(super) fn by_photons(scene: &str, pixels: u32, iterations: u64) -> Self {
        Self::by(scene, pixels, iterations, false)
    }

    fn by(scene: &str, pixels: u32, iterations: u64, sheets: bool) -> Self {
        let world = testing::world(&format!("[film]\nwidth = {pixels}\nheight = {pixels}\n{scene}"));
        let mut plan = Plan::new(&world);
        let caustics = plan.caustics.as_mut().expect("there are mirrors or glass");
        caustics.sheets.fill(sheets);
        // The map keeps all photons.
        caustics.seen_indirectly = true;
        let input = |k| PassInput::uncancelled(&world, &plan, 1, FIRST + k);
        let passes = (0..iterations).map(|k| caustic_photon_pass(&input(k)).expect("never cancelled")).collect();
        Self { world, passes }
    }

    /// The irradiance in the red channel, mean over the iterations and over a rectangle, by light after this many mirrors and interfaces.
    pub(super) fn irradiance(&self, rectangle: &Rectangle, events: u32) -> f64 {
        let Rectangle { middle, sides } = *rectangle;
        let normal = sides[0].cross(sides[1]).normalize();
        let hit = testing::vertex(&self.world, &Ray::new(middle + 1e-3 * normal, -normal));
        let (tag, origin) = (photon::tag(hit.side, events), self.world.view.origin);
        let half = sides.map(|side| (0.5 * side).as_vec3());
        let query = SheetQuery::parallelogram((middle - origin).as_vec3(), normal.as_vec3(), half, [tag, 1]);
        let holds = |position: Vec3| {
            let offset = position.as_dvec3() + origin - middle;
            sides.iter().all(|side| offset.dot(*side).abs() <= 0.5 * side.length_squared())
        };
        let of_pass = |pass: &CausticPhotons| {
            let mut of_sheets = Rgb::ZERO;
            pass.sheets.for_each(Portable, &query, |irradiance, _| of_sheets += irradiance);
            let photons = pass.photons.iter().filter(|photon| photon.tag == tag && holds(photon.position));
            let flux: f64 = photons.map(|photon| f64::from(photon.flux.x)).sum();
            f64::from(of_sheets.x) + flux / sides[0].cross(sides[1]).length()
        };
        self.passes.iter().map(of_pass).sum::<f64>() / self.passes.len() as f64
    }

    /// The flux in each iteration, W in the mean of the channels, by the tag of the light: side of the surface and number of events.
    pub(super) fn fluxes(&self) -> BTreeMap<u32, Vec<f64>> {
        let mut by_tag = BTreeMap::new();
        for (k, pass) in self.passes.iter().enumerate() {
            let of_photons = pass.photons.iter().map(|photon| (photon.tag, photon.flux));
            for (tag, flux) in of_photons.chain(pass.sheets.fluxes()) {
                let of_tag = by_tag.entry(tag).or_insert_with(|| vec![0.0; self.passes.len()]);
                of_tag[k] += f64::from(flux.element_sum()) / 3.0;
            }
        }
        by_tag
    }

    /// The mean flux over the iterations, W in the mean of the channels, by the number of events.
    pub(super) fn flux_by_events(&self) -> BTreeMap<u32, f64> {
        let mut by_events = BTreeMap::new();
        for (tag, fluxes) in self.fluxes() {
            *by_events.entry(tag & 0xff).or_insert(0.0) += fluxes.iter().sum::<f64>() / fluxes.len() as f64;
        }
        by_events
    }
}

/// A rectangle on a surface, by its middle and its sides, scene units; the light falls on the side of `sides[0] x sides[1]`.
pub(super) struct Rectangle {
    pub(super) middle: DVec3,
    pub(super) sides: [DVec3; 2],
}

impl Rectangle {
    /// A square on the floor z = 0, lit from above.
    pub(super) fn on_floor(middle: DVec2, side: f64) -> Self {
        Self { middle: middle.extend(0.0), sides: [DVec3::X * side, DVec3::Y * side] }
    }
}
