//! The components that the plan renders and skips.

use crate::support::{HEAD, ball, floor, world};
use patchlight::transport::{Plan, PlanItem};

const DIRECT: PlanItem = PlanItem::DirectLight;
const CAUSTICS: PlanItem = PlanItem::Caustics;
const SEEN: PlanItem = PlanItem::IndirectlySeenCaustics;
const INTERREFLECTION: PlanItem = PlanItem::Interreflection;

/// The components that the plan renders in a scene with these objects.
fn rendered(max_bounces: u32, objects: &[String]) -> Vec<PlanItem> {
    let text = format!("{HEAD}{}[render]\nmax_bounces = {max_bounces}\n", objects.concat());
    let notes = Plan::new(&world(&text)).notes;
    assert!(notes.iter().all(|note| !note.reason.is_empty()), "every decision has a reason: {notes:?}");
    notes.into_iter().filter(|note| note.rendered).map(|note| note.item).collect()
}

#[test]
fn only_what_can_contribute_is_rendered() {
    let (white, mirror) = (ball("a", 0.0, 0.5, "white"), ball("b", 1.5, 0.5, "mirror"));
    let cases: [(u32, &[String], &[PlanItem]); 9] = [
        (16, &[floor("white"), white.clone(), mirror.clone()], &[DIRECT, CAUSTICS, SEEN, INTERREFLECTION]),
        (16, &[floor("white"), white.clone()], &[DIRECT, INTERREFLECTION]),
        (1, &[floor("white"), white.clone(), mirror.clone()], &[DIRECT]),
        // From the light to a mirror, a floor, the mirror again and the eye takes three events.
        (2, &[floor("white"), white.clone(), mirror.clone()], &[DIRECT, CAUSTICS, INTERREFLECTION]),
        // A floor lights itself by way of a mirror alone, which takes three events too.
        (2, &[floor("white"), mirror.clone()], &[DIRECT, CAUSTICS]),
        (16, &[floor("white"), mirror.clone()], &[DIRECT, CAUSTICS, SEEN, INTERREFLECTION]),
        // Convex from where the light is; around the light it is not.
        (16, &[white], &[DIRECT]),
        (16, &[ball("room", 0.0, 5.0, "white")], &[DIRECT, INTERREFLECTION]),
        (16, &[floor("black"), mirror], &[]),
    ];
    for (max_bounces, objects, expected) in cases {
        assert_eq!(rendered(max_bounces, objects), expected, "{max_bounces} bounces, {objects:?}");
    }
}

/// A lamp in front of a wall, and one behind it that is twenty times as strong.
fn two_lamps(objects: &str) -> String {
    format!(
        r#"{HEAD}
    [[light]]
    name = "outside"
    type = "point"
    position = [0, 0, -6]
    intensity = [20, 20, 20]
    [[object]]
    name = "wall"
    type = "quad"
    material = "white"
    corner = [-0.3, -1, -1]
    edge_u = [0.6, 0, 0]
    edge_v = [0, 1.5, 0]
    {objects}"#
    )
}

#[test]
fn lamps_that_light_nothing_in_view_get_few_paths() {
    let plan = |objects: &str| {
        let text = two_lamps(&format!("{}{objects}", floor("white")));
        Plan::new(&world(&text))
    };
    // The floor is an endless plane: light from behind the wall reaches what the camera sees of it in front.
    let closed =
        "[[object]]\nname = \"lid\"\ntype = \"sphere\"\ncenter = [0, 0, -6]\nradius = 0.5\nmaterial = \"white\"\n";
    let plan = [plan(""), plan(closed)];
    assert!(plan[0].global_paths[1] > plan[0].global_paths[0], "the stronger one");
    assert!(plan[1].global_paths[1] < plan[1].global_paths[0] && plan[1].global_paths[1] > 0, "but not quite none");
    let is_said = |plan: &Plan| plan.notes.iter().any(|note| note.item == PlanItem::PathsOutOfView);
    assert_eq!(plan.each_ref().map(is_said), [false, true]);
}

#[test]
fn what_is_seen_in_a_mirror_is_in_view() {
    let mirror =
        "[[object]]\nname = \"mirror\"\ntype = \"sphere\"\ncenter = [1, 0, 0]\nradius = 0.5\nmaterial = \"mirror\"\n";
    // Behind the camera a screen, lit from its far side's lamp: only the ball shows it.
    let text = |mirror: &str| {
        format!(
            "{HEAD}{}{mirror}",
            r#"
    [[light]]
    name = "behind"
    type = "quad"
    corner = [-1, 0, 8]
    edge_u = [2, 0, 0]
    edge_v = [0, 1, 0]
    radiance = [1, 1, 1]
    [[object]]
    name = "screen"
    type = "quad"
    material = "white"
    corner = [-2, -2, 10]
    edge_u = [4, 0, 0]
    edge_v = [0, 4, 0]
    [[object]]
    name = "ball"
    type = "sphere"
    material = "white"
    center = [-0.5, 0, 0]
    radius = 0.3
"#
        )
    };
    let paths = |text: String| Plan::new(&world(&text)).global_paths[1];
    let (unseen, seen) = (paths(text("")), paths(text(mirror)));
    assert!(seen > 2 * unseen, "{seen} {unseen}");
}
