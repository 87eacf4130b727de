//! The pass that traces sheets of light: the lattices of all lights, square by square.

use super::input::PassInput;
use crate::math::{Stream, morton_2d};
use crate::transport::counters::Counters;
use crate::transport::light_sheets::{Divided, Lattice, LightSheets, SheetsOfLight};
use crate::transport::lights::{PROJECTION_SIDE, Pencil};
use crate::transport::plan::CausticPlan;
use glam::{DVec2, UVec2};
use rayon::prelude::*;

/// Steps along a block of the finest lattice within which rays are traced everywhere.
const SURE_BLOCK: u32 = 8;

/// The sheets of an iteration.
pub(super) struct Sheets {
    pub(super) all: LightSheets,
    /// What is left to photons, for each light and each of its points that has sheets; none for a light whose caustics photons bring alone.
    pub(super) of_lights: Vec<Vec<SheetsOfLight>>,
    pub(super) counters: Counters,
}

/// Traces the sheets of an iteration; `None` when cancelled.
pub(super) fn light_sheet_pass(input: &PassInput, caustics: &CausticPlan) -> Option<Sheets> {
    let mut divided = Vec::new();
    let mut pencils = Vec::new();
    for (light, _) in caustics.sheets.iter().enumerate().filter(|(_, has)| **has) {
        let points = if Pencil::varies(&input.world.lights[light]) { caustics.lattice.points_of_lamp } else { 1 };
        for point in 0..points {
            let index = input.iteration * points + point;
            let mut sampler = input.sampler(Stream::LightSheets, light as u64, index);
            let shift = sampler.next_2d();
            let pencil = if points == 1 {
                Pencil::middle(input.world, light)
            } else {
                Pencil::sample(input.world, light, points, &mut sampler)
            };
            let paths = input.plan.paths(caustics.paths[light], input.iteration).count() / points as usize;
            divided.push(divided_lattice(input, light, &pencil, shift, paths, caustics)?);
            pencils.push((light, pencil));
        }
    }
    let (all, regions, counters) = LightSheets::build(divided);
    let mut of_lights: Vec<Vec<SheetsOfLight>> = caustics.sheets.iter().map(|_| Vec::new()).collect();
    for ((light, pencil), regions) in pencils.into_iter().zip(regions) {
        of_lights[light].push(SheetsOfLight { pencil, regions });
    }
    Some(Sheets { all, of_lights, counters })
}

/// The lattice of a light, each of its squares divided, in Morton order; `None` when cancelled.
fn divided_lattice(
    input: &PassInput,
    light: usize,
    pencil: &Pencil,
    shift: DVec2,
    paths: usize,
    caustics: &CausticPlan,
) -> Option<Vec<Divided>> {
    // One square more each way, because the lattice lies aside.
    let side = PROJECTION_SIDE as u32;
    let mut squares: Vec<UVec2> =
        (0..(side + 1) * (side + 1)).map(|k| UVec2::new(k % (side + 1), k / (side + 1))).collect();
    squares.sort_by_key(|square| morton_2d(*square));
    let is_aimed = |square: &UVec2| {
        let min = (square.as_dvec2() - shift) / f64::from(side);
        caustics.projection_maps[light].aims_between(min, min + 1.0 / f64::from(side))
    };
    let aimed: Vec<bool> = squares.iter().map(is_aimed).collect();
    let steps = caustics.lattice.steps(paths, aimed.iter().filter(|&&aimed| aimed).count());
    let lattice = Lattice {
        world: input.world,
        camera: &input.plan.camera,
        light,
        pencil,
        side,
        shift,
        steps,
        sure_block: steps.min(SURE_BLOCK),
    };
    let divide = |(square, aimed): (UVec2, bool)| {
        let found = if aimed { lattice.divide(square) } else { lattice.undivided(square) };
        (!input.cancel.is_cancelled()).then_some(found)
    };
    squares.into_par_iter().zip(aimed).map(divide).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::lanes::Portable;
    use crate::math::{Ray, Rgb};
    use crate::transport::light_sheets::SheetQuery;
    use crate::transport::photons::photon;
    use crate::transport::plan::Plan;
    use crate::transport::testing::{self, lamp, quad};
    use crate::world::World;
    use glam::{DVec3, Vec3};

    /// A screen in the plane z = 0, a lamp at distance 4 before it, and behind the lamp a mirror (reflectance 0.8) at distance 5.
    fn lit_by_a_mirror() -> World {
        let mirror = [[-2.0, -2.0, 5.0], [0.0, 4.0, 0.0], [4.0, 0.0, 0.0]];
        let screen = "[[object]]\nname = \"screen\"\ntype = \"plane\"\nmaterial = \"grey\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n";
        testing::world(&[&quad("mirror", mirror, "mirror"), screen, &lamp([0.3, 0.2, 4.0])].concat())
    }

    fn sheets(world: &World, plan: &Plan, iteration: u64) -> LightSheets {
        let input = PassInput::uncancelled(world, plan, 1, iteration);
        let caustics = plan.caustics.as_ref().expect("there is a mirror");
        light_sheet_pass(&input, caustics).expect("never cancelled").all
    }

    /// The irradiance at a point of the screen, which light meets after one event at most.
    fn irradiance(world: &World, sheets: &LightSheets, at: DVec3) -> Rgb {
        let screen =
            (0..world.surfaces.len() as u32).find(|&p| world.material_of(p).is_some() && !world.is_specular(p));
        let hit = testing::vertex(world, &Ray::new(at + DVec3::Z, DVec3::NEG_Z));
        assert_eq!(Some(hit.point.hit.primitive), screen);
        let tag = photon::tag(hit.side, 0);
        let query = SheetQuery::square((at - world.view.origin).as_vec3(), Vec3::Z, 0.02, [tag, 4]);
        let mut sum = Rgb::ZERO;
        sheets.for_each(Portable, &query, |irradiance, _| sum += irradiance);
        sum
    }

    /// The mirror shows the lamp at distance `d = 6` behind the screen: the irradiance is `0.8 d / (d^2 + rho^2)^(3/2)`.
    #[test]
    fn a_mirror_lights_a_screen_as_the_image_of_the_lamp() {
        let world = lit_by_a_mirror();
        let plan = Plan::new(&world);
        let iterations: Vec<LightSheets> = (1..=8).map(|i| sheets(&world, &plan, i)).collect();
        for (x, y) in [(1.0, 0.7), (-2.0, 1.5), (2.5, -2.0)] {
            let rho2 = (x - 0.3f64).powi(2) + (y - 0.2f64).powi(2);
            let expected = 0.8 * 6.0 / (36.0 + rho2).powf(1.5);
            let at = DVec3::new(x, y, 0.0);
            let found: Vec<f64> = iterations.iter().map(|s| f64::from(irradiance(&world, s, at).x)).collect();
            eprintln!("{x} {y} {:?}", found.iter().map(|one| one / expected).collect::<Vec<_>>());
            let mean = found.iter().sum::<f64>() / found.len() as f64;
            assert!((mean / expected - 1.0).abs() < 0.005, "{mean} instead of {expected} at {x}, {y}");
            assert!(found.iter().all(|one| (one / expected - 1.0).abs() < 0.05), "{found:?} instead of {expected}");
        }
        let beside = irradiance(&world, &iterations[3], DVec3::new(30.0, 0.0, 0.0));
        assert_eq!(beside, Rgb::ZERO, "the mirror ends");
    }

    #[test]
    fn lattices_of_different_iterations_lie_aside_of_each_other() {
        let world = lit_by_a_mirror();
        let plan = Plan::new(&world);
        let at = DVec3::new(1.3, -0.7, 0.0);
        let [a, b, again] = [4, 5, 4].map(|i| irradiance(&world, &sheets(&world, &plan, i), at));
        assert_ne!(a, b);
        assert_eq!(a, again, "a function of the iteration alone");
    }
}
