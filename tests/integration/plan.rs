//! The components that the plan renders and skips.

use crate::support::{ball, floor, head, quad, sphere, world};
use patchlight::transport::{Plan, PlanItem};

const DIRECT: PlanItem = PlanItem::DirectLight;
const CAUSTICS: PlanItem = PlanItem::Caustics;
const SEEN: PlanItem = PlanItem::IndirectlySeenCaustics;
const INTERREFLECTION: PlanItem = PlanItem::Interreflection;

/// The components that the plan renders in a scene with these objects.
fn rendered(max_bounces: u32, objects: &[String]) -> Vec<PlanItem> {
    let text = format!("{}{}[render]\nmax_bounces = {max_bounces}\n", head(), objects.concat());
    let notes = Plan::new(&world(&text)).notes;
    assert!(notes.iter().all(|note| !note.reason.is_empty()), "every decision has a reason: {notes:?}");
    notes.into_iter().filter(|note| note.rendered).map(|note| note.item).collect()
}

#[test]
fn only_components_that_can_contribute_are_rendered() {
    let (grey, mirror) = (ball("a", 0.0, 0.5, "grey"), ball("b", 1.5, 0.5, "mirror"));
    let cases: [(u32, &[String], &[PlanItem]); 9] = [
        (16, &[floor("grey"), grey.clone(), mirror.clone()], &[DIRECT, CAUSTICS, SEEN, INTERREFLECTION]),
        (16, &[floor("grey"), grey.clone()], &[DIRECT, INTERREFLECTION]),
        (1, &[floor("grey"), grey.clone(), mirror.clone()], &[DIRECT]),
        // From the light to a mirror, a floor, the mirror again and the camera takes three events.
        (2, &[floor("grey"), grey.clone(), mirror.clone()], &[DIRECT, CAUSTICS, INTERREFLECTION]),
        // A floor lights itself by way of a mirror alone, which takes three events too.
        (2, &[floor("grey"), mirror.clone()], &[DIRECT, CAUSTICS]),
        (16, &[floor("grey"), mirror.clone()], &[DIRECT, CAUSTICS, SEEN, INTERREFLECTION]),
        // Convex from where the light is; around the light it is not.
        (16, &[grey], &[DIRECT]),
        (16, &[ball("room", 0.0, 5.0, "grey")], &[DIRECT, INTERREFLECTION]),
        (16, &[floor("black"), mirror], &[]),
    ];
    for (max_bounces, objects, expected) in cases {
        assert_eq!(rendered(max_bounces, objects), expected, "{max_bounces} bounces, {objects:?}");
    }
}

/// A lamp in front of a wall, and a lamp behind it that is twenty times as strong.
fn two_lamps(objects: &str) -> String {
    let outside = "[[light]]\nname = \"outside\"\ntype = \"point\"\nposition = [0, 0, -6]\nintensity = [20, 20, 20]\n";
    let wall = quad("wall", [[-0.3, -1.0, -1.0], [0.6, 0.0, 0.0], [0.0, 1.5, 0.0]], "grey");
    [&head(), outside, &wall, objects].concat()
}

#[test]
fn lamps_whose_light_stays_out_of_view_get_few_paths() {
    let plan = |objects: &str| Plan::new(&world(&two_lamps(&(floor("grey") + objects))));
    // The floor is an endless plane: light from behind the wall reaches the visible floor in front of the wall.
    let plan = [plan(""), plan(&sphere("lid", [0.0, 0.0, -6.0], 0.5, "grey"))];
    assert!(plan[0].global_paths[1] > plan[0].global_paths[0], "the stronger lamp");
    assert!(plan[1].global_paths[1] < plan[1].global_paths[0] && plan[1].global_paths[1] > 0, "but not quite none");
    let is_said = |plan: &Plan| plan.notes.iter().any(|note| note.item == PlanItem::PathsOutOfView);
    assert_eq!(plan.each_ref().map(is_said), [false, true]);
}

#[test]
fn surfaces_in_a_mirror_are_in_view() {
    // Behind the camera a screen with a lamp on its far side: only the mirror shows it.
    let lamp = "[[light]]\nname = \"behind\"\ntype = \"quad\"\ncorner = [-1, 0, 8]\nedge_u = [2, 0, 0]\nedge_v = [0, 1, 0]\n\
                radiance = [1, 1, 1]\n";
    let screen = quad("screen", [[-2.0, -2.0, 10.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]], "grey");
    let ball = ball("ball", -0.5, 0.3, "grey");
    let mirror = sphere("mirror", [1.0, 0.0, 0.0], 0.5, "mirror");
    let paths = |mirror: &str| Plan::new(&world(&[&head(), lamp, &screen, &ball, mirror].concat())).global_paths[1];
    let (unseen, seen) = (paths(""), paths(&mirror));
    assert!(seen > 2 * unseen, "{seen} {unseen}");
}
