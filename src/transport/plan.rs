//! What a scene needs, decided before rendering, and why the rest is skipped.

use super::Rows;
use super::bandwidth::{self, Bandwidth, Contrasts, WIDER};
use super::camera_pass::Clearance;
use super::guide::Guide;
use super::light_choice::{CHOSEN, LightChoice};
use super::lobe_light::LobeLight;
use super::maps::MapKind;
use super::measured::Measured;
use super::pixel_samples::SampleCounts;
use super::relevance;
use super::schedule::{self, SMALLEST};
use super::sharing::Lattice;
use crate::geometry::Primitive;
use crate::math::{Rgb, Stream};
use crate::world::{Camera, Light, Lobe, Surface, World};
use std::ops::Range;
use std::sync::Arc;

/// One decision, for people.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlanNote {
    /// A component of light or of work.
    pub what: String,
    /// Whether it is rendered; otherwise it is skipped.
    pub rendered: bool,
    /// Why.
    pub reason: String,
}

/// What every iteration does for a scene.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The eye and the film's grid, which is coarser for a draft.
    pub camera: Camera,
    /// Whether paths from the camera look for emission and direct light.
    pub finds_direct_light: bool,
    /// Caustics, where light can meet mirrors or glass.
    pub caustics: Option<CausticPlan>,
    /// Which lights points ask for direct light.
    pub light_choice: Arc<LightChoice>,
    /// Which light in Phong lobes paths from the camera find, and which photons bring.
    pub lobe_light: LobeLight,
    /// Paths that look for interreflection in a full iteration, by light; empty where there is none.
    pub global_paths: Vec<u64>,
    /// Radius of the density estimate of caustics after one full iteration, where nothing is near, pixels' footprints.
    pub caustic_radius: f64,
    /// The same where another object is at hand: it may cast sharp shadows in the caustic.
    pub least_caustic_radius: f64,
    /// The same for interreflection, where nothing is near.
    pub global_radius: f64,
    /// The same where another object is at hand.
    pub least_global_radius: f64,
    /// The same where it stands on the surface: its foot casts sharp shadows even of indirect light.
    pub least_standing_radius: f64,
    /// The same for interreflection that mirrors or glass focused.
    pub focused_radius: f64,
    /// The same for interreflection in Phong lobes.
    pub glossy_radius: f64,
    /// The largest radius, parts of the world's radius.
    pub largest_radius: f64,
    /// Every decision.
    pub notes: Vec<PlanNote>,
    is_draft: bool,
    /// By what radii have shrunk, once it was measured.
    bandwidth: Option<Arc<Bandwidth>>,
    /// Samples of each pixel, once it was measured how they differ.
    samples: Option<Arc<SampleCounts>>,
}

/// How caustics are rendered.
#[derive(Clone, Debug)]
pub struct CausticPlan {
    /// Paths in a full iteration, by light.
    pub paths: Vec<u64>,
    /// Where each light meets mirrors or glass.
    pub guides: Arc<Vec<Guide>>,
    /// Whether the camera may see caustics in mirrors, through glass or in glossy surfaces.
    pub seen_indirectly: bool,
    /// Until radii are measured, so many full iterations' directly seen caustics are gathered from the map, which is smoother
    /// while photons are few.
    pub gathered: f64,
}

/// Paths for interreflection in a full iteration, for each pixel: about as much work as the pixel's own paths.
const GLOBAL_PATHS_PER_PIXEL: f64 = 4.0;
/// Samples of a pixel in a full iteration as long as nothing was measured. Photons are gathered for one of them, which is most
/// of the work; the others find direct light, whose edges need them.
const CAMERA_SAMPLES: f64 = 4.0;
/// Paths for caustics in a full iteration, for each pixel.
const CAUSTIC_PATHS_PER_PIXEL: f64 = 2.0;
/// Radius of the density estimate of caustics that may be sharp, after one full iteration, pixels' footprints.
const CAUSTIC_RADIUS: f64 = 2.0;
/// Radii, but for the least ones, are at most this part of the distance to the next object.
const PART_OF_CLEARANCE: f64 = 0.5;
/// Radius for interreflection in Phong lobes after one full iteration, pixels' footprints.
const GLOSSY_RADIUS: f64 = 6.0;
/// A lobe blurs what is seen in it, so that discs there may be noisier: the least part of their radius. Measured: a tenth off the
/// error for time of a glossy floor, a fifth in a room of gloss.
const LEAST_PART_IN_LOBE: f64 = 0.3;
const LEAST_PATHS: f64 = 16_384.0;
/// More would make an iteration last longer than a user waits for the next frame.
const MOST_PATHS: f64 = 524_288.0;
/// Radius for interreflection in a draft, pixels' footprints.
const DRAFT_RADIUS: f64 = 16.0;
/// Photons a pixel from which on adding them to the film is better than a density estimate, where caustics may be sharp.
const PHOTONS_PER_PIXEL_TO_SPLAT: f64 = 1.0;
/// Directly seen caustics are gathered where discs of more than this radius, pixels, are best. A disc of 0.65 pixels is as noisy
/// as the pixel by itself, and has bias as well.
const LARGE_CAUSTIC_RADIUS: f64 = 1.3;
/// A disc may cover this part of a sphere's radius, so that it stays nearly flat.
pub(super) const MAX_PART_OF_SPHERE: f64 = 0.32;

impl Plan {
    /// The plan for a world.
    pub fn new(world: &World) -> Self {
        let mut notes = Notes::default();
        let lit = notes.lights(world);
        let caustics = if lit { plan_caustics(world, &mut notes) } else { None };
        if lit && caustics.is_none() {
            notes.skip(SEEN_INDIRECTLY, "there are no caustics to be seen");
        }
        let global_paths = if lit { plan_interreflection(world, &mut notes) } else { Vec::new() };
        let glossy_paths = plan_gloss(world, &global_paths, &mut notes);
        notes.textures(world);
        notes.background(world);
        Self {
            camera: world.camera,
            finds_direct_light: true,
            caustics,
            light_choice: Arc::new(LightChoice::new(world)),
            lobe_light: LobeLight::new(world.camera, glossy_paths, GLOSSY_RADIUS),
            global_paths,
            caustic_radius: if are_large(world) { 4.0 } else { CAUSTIC_RADIUS },
            least_caustic_radius: CAUSTIC_RADIUS,
            global_radius: 24.0,
            least_global_radius: 10.0,
            least_standing_radius: 5.0,
            focused_radius: 6.0,
            glossy_radius: GLOSSY_RADIUS,
            largest_radius: 0.15,
            notes: notes.0,
            is_draft: false,
            bandwidth: None,
            samples: None,
        }
    }

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

    /// The radius for interreflection after one full iteration at a point with this footprint and this far from other
    /// objects: light from near objects changes within a part of their distance \[Ward88\].
    pub(super) fn global_radius_at(&self, footprint: f64, clearance: Clearance) -> f64 {
        let (least, most) = (self.least_global_radius * footprint, self.global_radius * footprint);
        let by_any = (PART_OF_CLEARANCE * clearance.any).clamp(least, most);
        by_any.min((PART_OF_CLEARANCE * clearance.standing).max(self.least_standing_radius * footprint))
    }

    /// A radius where what is seen is blurred this far, scene units.
    pub(super) fn radius_in_lobe(&self, radius: f64, blur: f32) -> f64 {
        radius * (radius / (radius + f64::from(blur))).max(LEAST_PART_IN_LOBE)
    }

    /// A radius for caustics, limited at a point with this footprint and this far from other objects: discs that
    /// reach over several of them and their shadows would not tell that it differs between these.
    pub(super) fn limited_caustic_radius(&self, radius: f64, footprint: f64, clearance: Clearance) -> f64 {
        radius.min((PART_OF_CLEARANCE * clearance.any).max(self.least_caustic_radius * footprint))
    }

    /// The distances from which on other objects matter neither for radii nor for what is seen within them; `None`
    /// where none ever does.
    pub(super) fn wanted_clearance(&self, footprint: f64) -> Option<Clearance> {
        let grown = |kind, radius: f64| bandwidth::most_growth(kind) * radius;
        let (caustic, focused) =
            (grown(MapKind::Caustic, self.caustic_radius), grown(MapKind::Focused, self.focused_radius));
        let widest = WIDER * caustic.max(focused).max(self.least_standing_radius);
        let global = |radius: f64| if self.global_paths.is_empty() { 0.0 } else { radius };
        let limit = |radius: f64| footprint * widest.max(global(radius).max(caustic) / PART_OF_CLEARANCE);
        let limits = Clearance { any: limit(self.global_radius), standing: limit(self.least_global_radius) };
        (self.gathers() && !self.is_draft).then_some(limits)
    }

    /// The film in bands of rows, whose paths from the camera and density estimates need nothing of each other.
    pub fn bands(&self, iteration: u64) -> Vec<Rows> {
        self.lattice(iteration).bands(self.camera.height)
    }

    /// Which pixels gather interreflection for others.
    pub(super) fn lattice(&self, iteration: u64) -> Lattice {
        let width = self.camera.width;
        if self.is_draft { Lattice::draft(width) } else { Lattice::new(width, iteration) }
    }

    /// Whether caustics that the camera sees directly in a pixel come from the map in this iteration; else each photon is
    /// added to the film by itself, as it always is on balls so small that only small discs lie flat on them.
    pub(super) fn gathers_visible_caustics(&self, primitive: &Primitive, pixel: u32, iteration: u64) -> bool {
        let is_large = match &self.bandwidth {
            None => self.begins_with_gathering(iteration),
            Some(bandwidth) => self.caustic_radius * bandwidth.least_caustic_near(pixel) > LARGE_CAUSTIC_RADIUS,
        };
        is_large && (self.is_draft || self.holds_large_disc(primitive))
    }

    fn holds_large_disc(&self, primitive: &Primitive) -> bool {
        let Primitive::Sphere(sphere) = primitive else { return true };
        let footprint = self.camera.footprint(self.camera.position.distance(sphere.center));
        MAX_PART_OF_SPHERE * sphere.radius > LARGE_CAUSTIC_RADIUS * footprint
    }

    /// Whether the map of caustics serves anything in this iteration. Where measured radii say that it does not, it never will:
    /// nothing is measured any more, and the best radii get smaller as iterations get more.
    pub fn needs_caustic_map(&self, iteration: u64) -> bool {
        let Some(caustics) = &self.caustics else { return false };
        caustics.seen_indirectly
            || match &self.bandwidth {
                None => self.begins_with_gathering(iteration) || schedule::measures(iteration),
                Some(bandwidth) => self.caustic_radius * bandwidth.greatest_least_caustic() > LARGE_CAUSTIC_RADIUS,
            }
    }

    fn begins_with_gathering(&self, iteration: u64) -> bool {
        self.caustics.as_ref().is_some_and(|caustics| schedule::size_before(iteration) < caustics.gathered)
    }

    /// The weight of an iteration in the mean of what photons bring: its part of the paths of a full one.
    pub fn weight(&self, iteration: u64) -> f64 {
        if self.is_draft { 1.0 } else { schedule::size(iteration) }
    }

    /// Which samples of a pixel's sequence belong to an iteration; at least one.
    pub(super) fn camera_samples(&self, pixel: u32, iteration: u64) -> Range<u64> {
        if self.is_draft {
            return 0..1;
        }
        if let Some(samples) = &self.samples {
            return samples.at(pixel, iteration);
        }
        let before = |i| (CAMERA_SAMPLES * schedule::size_before(i)).ceil() as u64;
        before(iteration)..before(iteration + 1)
    }

    /// How much the mean of a pixel's samples of an iteration weighs beside those of other iterations.
    pub(super) fn samples_weight(&self, pixel: u32, iteration: u64) -> f32 {
        match &self.samples {
            Some(samples) => samples.weight(pixel),
            None => self.camera_samples(pixel, iteration).count() as f32,
        }
    }

    /// The factor by which radii have shrunk in an iteration as long as nothing was measured.
    pub(super) fn shrink(&self, iteration: u64) -> f64 {
        if self.is_draft { 1.0 } else { schedule::shrink(iteration) }
    }

    /// The radius in an iteration at a distance from the camera, scene units: that for caustics, where there are any,
    /// else that for interreflection far from other objects, in the mean over the film; 0 where nothing is gathered.
    pub fn radius_at(&self, distance: f64, iteration: u64) -> f64 {
        if !self.gathers() {
            return 0.0;
        }
        let (kind, pixels) = match &self.caustics {
            Some(_) => (MapKind::Caustic, self.caustic_radius),
            None => (MapKind::Global, self.global_radius),
        };
        let shrink = self.bandwidth.as_ref().map_or_else(|| self.shrink(iteration), |bandwidth| bandwidth.mean(kind));
        pixels * shrink * self.camera.footprint(distance)
    }

    /// The factor by which a map's radius has shrunk in a pixel, if it was measured; else it is [`Plan::shrink`].
    pub(super) fn measured_shrink(&self, kind: MapKind, pixel: u32) -> Option<f64> {
        self.bandwidth.as_ref().map(|bandwidth| bandwidth.at(kind, pixel))
    }

    /// Whether density estimates at edges are right for light that changes linearly. Not before radii were measured: with
    /// few photons the noise of it outweighs the bias.
    pub(super) fn corrects_edges(&self) -> bool {
        self.bandwidth.is_some()
    }

    /// Whether light in a pixel is also gathered in wider discs in this iteration.
    pub(super) fn compares_discs(&self, pixel: u32, iteration: u64) -> bool {
        !self.is_draft && Contrasts::includes([self.camera.width, self.camera.height], pixel, iteration)
    }

    /// The plan for what follows iteration `i`, with the samples and radii that what was measured asks for; `None` where it
    /// stays as it is.
    pub fn refined(&self, i: u64, measured: &Measured) -> Option<Self> {
        if !schedule::refines_after(i) {
            return None;
        }
        let next = |pixel| self.camera_samples(pixel, i).end;
        let samples = self.finds_direct_light.then(|| Arc::new(SampleCounts::best(i, &measured.samples, next)));
        let bandwidth = self.gathers().then(|| {
            let total = schedule::size_before(2 * i + 1);
            Arc::new(match &self.bandwidth {
                None => Bandwidth::first(&measured.contrasts, total, self.shrink(i)),
                Some(bandwidth) => bandwidth.next(&measured.contrasts, total),
            })
        });
        Some(Self { bandwidth, samples, ..self.clone() })
    }

    /// Which paths of a light's sequence belong to an iteration, where a full one has `count`.
    pub(super) fn paths(&self, count: u64, iteration: u64) -> Range<u64> {
        let start = (count as f64 * schedule::size_before(iteration)) as u64;
        start..start + (count as f64 * self.weight(iteration)) as u64
    }

    /// Whether it is for a quick first picture.
    pub(super) fn is_draft(&self) -> bool {
        self.is_draft
    }

    /// Whether anything is gathered at visible points.
    pub(super) fn gathers(&self) -> bool {
        self.caustics.is_some() || !self.global_paths.is_empty()
    }

    /// Drafts draw their own numbers.
    pub(super) fn stream(&self, stream: Stream) -> Stream {
        if self.is_draft { Stream::Draft(stream.number()) } else { stream }
    }
}

/// If no more of a light's paths reach the view, it is said to be out of it.
const FEW: f64 = 0.01;
/// A light with at least this part of the world's radius blurs caustics well.
const LARGE_LIGHT: f64 = 0.1;
const SEEN_INDIRECTLY: &str = "caustics in mirrors and glass";

fn plan_caustics(world: &World, notes: &mut Notes) -> Option<CausticPlan> {
    const WHAT: &str = "caustics";
    let needless = if world.max_bounces < 2 {
        Some("max_bounces leaves only direct light")
    } else if !(0..world.surfaces.len()).any(|p| world.is_specular(p as u32)) {
        Some("no surface mirrors or refracts")
    } else {
        None
    };
    if let Some(reason) = needless {
        notes.skip(WHAT, reason);
        return None;
    }
    let guides: Vec<Guide> =
        world.lights.iter().enumerate().map(|(i, light)| Guide::build(world, light, i as u64)).collect();
    let weights = world.lights.iter().zip(&guides).map(|(light, guide)| power(light) * guide.covered()).collect();
    let total = (world.camera.pixel_count() as f64 * CAUSTIC_PATHS_PER_PIXEL).clamp(LEAST_PATHS, MOST_PATHS);
    let paths = share(weights, total);
    let covered = guides.iter().map(Guide::covered).fold(0.0, f64::max);
    notes.render(
        WHAT,
        format!("mirrors and glass fill up to {:.1} % of a light's directions; photons aim there", 100.0 * covered),
    );
    let seen_indirectly = plan_seen_indirectly(world, notes);
    let photons_per_pixel = paths.iter().sum::<u64>() as f64 / world.camera.pixel_count() as f64;
    let gathered = if may_be_sharp(world) { PHOTONS_PER_PIXEL_TO_SPLAT / photons_per_pixel } else { f64::INFINITY };
    Some(CausticPlan { paths, guides: Arc::new(guides), seen_indirectly, gathered })
}

/// Whether caustics may be as sharp as can be: lights blur them if they are larger than the discs.
fn may_be_sharp(world: &World) -> bool {
    let distance = world.camera.position.distance(world.center).max(world.radius);
    world.lights.iter().any(|light| light.reach() < CAUSTIC_RADIUS * world.camera.footprint(distance))
}

/// Whether all lights are so large that hardly any caustic of theirs is sharp.
fn are_large(world: &World) -> bool {
    world.lights.iter().all(|light| light.reach() >= LARGE_LIGHT * world.radius)
}

fn plan_seen_indirectly(world: &World, notes: &mut Notes) -> bool {
    let sends_on = |p: u32| shows_at(world, p) && (world.is_specular(p) || world.is_glossy(p));
    let (all, seen) = (0..world.surfaces.len() as u32)
        .filter(|&p| sends_on(p))
        .fold((0, 0), |(all, seen), p| (all + 1, seen + usize::from(world.may_be_in_view(p))));
    let needless = if world.max_bounces < 3 {
        Some("max_bounces leaves no path to a caustic that way")
    } else if seen == 0 {
        Some("nothing in view mirrors or refracts: photons go straight to the film")
    } else {
        None
    };
    match needless {
        Some(reason) => notes.skip(SEEN_INDIRECTLY, reason),
        None => notes
            .render(SEEN_INDIRECTLY, format!("{seen} of {all} mirrors, glasses and glossy surfaces may be in view")),
    }
    needless.is_none()
}

fn plan_interreflection(world: &World, notes: &mut Notes) -> Vec<u64> {
    const WHAT: &str = "interreflection";
    let scattering: Vec<u32> = (0..world.surfaces.len() as u32).filter(|&p| world.scattered_bound(p) > 0.0).collect();
    let needless = if world.max_bounces < 2 {
        Some("max_bounces leaves only direct light")
    } else if let [only] = scattering[..]
        && !may_light_itself(world, only)
    {
        Some("the only surface that scatters light cannot light itself")
    } else {
        None
    };
    if let Some(reason) = needless {
        notes.skip(WHAT, reason);
        return Vec::new();
    }
    notes.render(
        WHAT,
        match scattering.len() {
            1 => "1 surface scatters light, and some of it comes back".to_owned(),
            surfaces => format!("{surfaces} surfaces scatter light to each other"),
        },
    );
    let total = (world.camera.pixel_count() as f64 * GLOBAL_PATHS_PER_PIXEL).clamp(LEAST_PATHS, MOST_PATHS);
    share(weights(world, notes), total)
}

/// Paths of photons that bring light to Phong lobes: those for interreflection, where there are lobes that may be divided.
fn plan_gloss(world: &World, global_paths: &[u64], notes: &mut Notes) -> Vec<u64> {
    const WHAT: &str = "photons for gloss";
    let glossy = (0..world.surfaces.len() as u32).filter(|&p| world.may_divide_lobes(p)).count();
    if glossy == 0 || global_paths.is_empty() {
        let reason = if glossy == 0 {
            "no surface has a wide Phong lobe without textures"
        } else {
            "there is no interreflection"
        };
        notes.skip(WHAT, reason);
        return Vec::new();
    }
    notes.render(WHAT, format!("{glossy} surfaces have wide Phong lobes; photons bring them light of bright spots"));
    global_paths.to_vec()
}

/// Whether light that a surface scatters may come back to it: it is not convex towards the lights, or a mirror or glass
/// sends light back within the bounces.
fn may_light_itself(world: &World, primitive: u32) -> bool {
    let sent_back = world.max_bounces >= 3 && (0..world.surfaces.len() as u32).any(|p| world.is_specular(p));
    let is_convex = match &world.aggregate.primitives()[primitive as usize] {
        Primitive::Quad(_) | Primitive::Plane(_) => true,
        Primitive::Sphere(sphere) => {
            world.lights.iter().all(|light| light.center().distance(sphere.center) > sphere.radius + light.reach())
        }
        Primitive::Patch(_) => false,
    };
    sent_back || !is_convex
}

fn power(light: &Light) -> f64 {
    f64::from(light.power().max_element())
}

/// What paths of each light are worth that are not aimed: where a part `p` of them matters, the variance of what they find goes
/// with `power^2 p`, and is least for all together with paths in proportion to its root.
fn weights(world: &World, notes: &mut Notes) -> Vec<f64> {
    let relevances = relevance::of_lights(world);
    let (all, few) = (relevances.len(), relevances.iter().filter(|&&part| part < FEW).count());
    if 0 < few && few < all {
        let reason = format!("of {few} of {all} lights hardly any reach the view");
        notes.skip("most paths of lights out of view", &reason);
    }
    world.lights.iter().zip(relevances).map(|(light, part)| power(light) * part.sqrt()).collect()
}

/// Numbers of paths in proportion to the weights, not 0 where the weight is not 0, about `total` together; multiples of
/// what the schedule divides them by.
fn share(weights: Vec<f64>, total: f64) -> Vec<u64> {
    let sum: f64 = weights.iter().sum();
    let paths = |w: f64| ((w / sum * total) as u64).next_multiple_of(SMALLEST).max(SMALLEST);
    weights.into_iter().map(|w| if w > 0.0 { paths(w) } else { 0 }).collect()
}

fn shows(world: &World, is_so: impl Fn(&World, u32) -> bool) -> bool {
    (0..world.surfaces.len() as u32).any(|p| shows_at(world, p) && is_so(world, p))
}

/// Whether a primitive is an object's and not a light's.
fn shows_at(world: &World, primitive: u32) -> bool {
    matches!(world.surfaces[primitive as usize], Surface::Object { .. })
}

impl World {
    pub(super) fn material_of(&self, primitive: u32) -> Option<&crate::world::Material> {
        match self.surfaces[primitive as usize] {
            Surface::Object { material, .. } => Some(&self.materials[material as usize]),
            Surface::Light(_) => None,
        }
    }

    fn scattered_bound(&self, primitive: u32) -> f32 {
        self.material_of(primitive).map_or(0.0, crate::world::Material::scattered_bound)
    }

    pub(super) fn is_glossy(&self, primitive: u32) -> bool {
        let scattering = self.material_of(primitive).map(|m| m.scattering(glam::DVec2::ZERO));
        scattering.is_some_and(|s| matches!(s.lobe, Lobe::Phong { .. }))
    }

    /// Whether any part of a primitive may be inside the view pyramid.
    pub(super) fn may_be_in_view(&self, primitive: u32) -> bool {
        let bounds = self.aggregate.primitives()[primitive as usize].bounds();
        bounds.is_empty() || self.camera.may_see(bounds.center(), 0.5 * bounds.diagonal())
    }
}

#[derive(Default)]
struct Notes(Vec<PlanNote>);

impl Notes {
    fn render(&mut self, what: &str, reason: String) {
        self.0.push(PlanNote { what: what.to_owned(), rendered: true, reason });
    }

    fn skip(&mut self, what: &str, reason: &str) {
        self.0.push(PlanNote { what: what.to_owned(), rendered: false, reason: reason.to_owned() });
    }

    /// Whether there is light to transport.
    fn lights(&mut self, world: &World) -> bool {
        const WHAT: &str = "direct light and photons";
        if world.lights.is_empty() {
            self.skip(WHAT, "there is no light that has any power");
        } else if world.max_bounces == 0 {
            self.skip(WHAT, "max_bounces is 0: only lights are seen");
        } else if !shows(world, |_, _| true) {
            self.skip(WHAT, "there is no surface to light");
        } else if !shows(world, |world, p| world.scattered_bound(p) > 0.0) {
            self.skip(WHAT, "no surface scatters light in many directions");
        } else {
            let reason = match world.lights.len() {
                1 => "1 light, one shadow ray for each point".to_owned(),
                few if few <= CHOSEN => format!("{few} lights, one shadow ray each"),
                many => format!("{many} lights; each point asks {CHOSEN}, chosen by their share of its light"),
            };
            self.render("direct light", reason);
            return true;
        }
        false
    }

    fn textures(&mut self, world: &World) {
        match world.materials.iter().filter(|m| m.needs_parameters()).count() {
            0 => self.skip("textures", "no visible material has one: surface parameters are never computed"),
            1 => self.render("textures", "1 material reads them".to_owned()),
            textured => self.render("textures", format!("{textured} materials read them")),
        }
    }

    fn background(&mut self, world: &World) {
        if world.background != Rgb::ZERO {
            self.render(
                "background",
                "the camera sees it, also in mirrors, glass and gloss; it sends no light to diffuse surfaces"
                    .to_owned(),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Location, SceneFile};
    use crate::world::prepare;

    #[test]
    fn discs_for_caustics_are_small_where_objects_are_near() {
        let text = "version = 1\n[camera]\nposition = [0, 0, 9]\ntarget = [0, 0, 0]\nfov_y = 40
            [[light]]\nname = \"l\"\ntype = \"sphere\"\ncenter = [0, 3, 0]\nradius = 1\nradiance = [1, 1, 1]\n";
        let file = SceneFile::parse(text, Location::Unsaved).expect("the scene is valid");
        let plan = Plan::new(&prepare(&file.scene, &Location::Unsaved, None).expect("it can be prepared"));
        let radius = |wanted: f64, any: f64| {
            plan.limited_caustic_radius(wanted, 0.01, Clearance { any, standing: f64::INFINITY })
        };
        let half = 0.5 * plan.caustic_radius * 0.01;
        assert_eq!(radius(0.04, f64::INFINITY), 0.04);
        assert_eq!(radius(0.04, 0.06), 0.03);
        assert_eq!(radius(0.04, 0.0), half, "no less than where caustics may be sharp");
        assert_eq!(radius(0.5 * half, 0.0), 0.5 * half, "but for shrinking");
    }
}
