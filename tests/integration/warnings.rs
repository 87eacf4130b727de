//! Warnings about scenes that can be rendered: wrong ones, and right ones beside them.

use crate::bodies::glass;
use crate::support::{box_of, object, patches_of, quad, scene, sphere, world};
use patchlight::world::warnings;

const NONE: Vec<String> = Vec::new();
const WHITE: &str = "[[material]]\nname = \"white\"\ntype = \"diffuse\"\nalbedo = [1, 1, 1]\n";

/// The subjects and the faults of the warnings about a scene.
fn faults(text: &str) -> Vec<String> {
    let scene = scene(text).scene;
    let found = warnings(&scene, &world(text));
    found.into_iter().map(|warning| format!("{} {}", warning.subject, warning.fault)).collect()
}

#[test]
fn faults_of_bodies_are_told_with_the_name_of_the_object() {
    let head = glass([1.0, 2.0, 5.0], &[("g", 1.5, 0.0), ("h", 1.5, 0.0)]);
    let whole = |material: &'static str| box_of("box", [[-1.0; 3], [1.0; 3]], move |_| material);
    let told = |bodies: &str| faults(&format!("{head}{bodies}"));
    assert_eq!(told(&whole("g")), NONE);
    let open = whole("g").replace("edge_v = [0.0, 2.0, 0.0]\n", "edge_v = [0.0, 1.0, 0.0]\n");
    assert!(told(&open)[0].contains("\"box left\"") && told(&open)[0].contains("has gaps"), "{:?}", told(&open));
    let inside_out = whole("g").replacen(
        "edge_u = [0.0, 0.0, 2.0]\nedge_v = [0.0, 2.0, 0.0]",
        "edge_u = [0.0, 2.0, 0.0]\nedge_v = [0.0, 0.0, 2.0]",
        1,
    );
    let told_inward = told(&inside_out);
    assert_eq!(told_inward.len(), 1, "{told_inward:?}");
    assert!(told_inward[0].starts_with("glass of object \"box left\" is inside out"), "{told_inward:?}");
    let above = box_of("lid", [[-1.0, 1.0, -1.0], [1.0, 1.5, 1.0]], |_| "h");
    assert!(told(&(whole("g") + &above))[0].contains("coincides with a face"), "{:?}", told(&(whole("g") + &above)));
    let lamp = "[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = [0, 0, 0]\nintensity = [1, 1, 1]\n";
    assert!(told(&(whole("g") + lamp))[0].starts_with("light \"lamp\" is inside of the glass \"g\""));
    let hidden = format!("{WHITE}{lamp}{}", sphere("stone", [0.0; 3], 1.0, "white"));
    assert!(told(&hidden)[0].contains("inside of the opaque object \"stone\""), "{:?}", told(&hidden));
    let in_glass = head.replace("position = [1.0, 2.0, 5.0]", "position = [0.5, 0.5, 0.5]");
    assert!(faults(&format!("{in_glass}{}", whole("g")))[0].starts_with("the camera is inside of the glass"));
}

/// A camera before the origin, water, glass and a white material.
fn water_and_glass() -> String {
    glass([1.0, 2.0, 5.0], &[("water", 1.33, 0.0), ("g", 1.5, 0.0)]) + WHITE
}

/// A level square of water with this half side in a white basin that is 2 wide.
fn pool(half: f64) -> String {
    let basin = box_of("basin", [[-1.0, -1.0, -1.0], [1.0, 0.5, 1.0]], |_| "white");
    let open =
        basin.replace("\"basin top\"", "\"lid\"").replacen("edge_v = [2.0, 0.0, 0.0]", "edge_v = [0.01, 0.0, 0.0]", 1);
    let side = 2.0 * half;
    let water = quad("water", [[-half, 0.0, -half], [0.0, 0.0, side], [side, 0.0, 0.0]], "water");
    format!("{}{open}{water}", water_and_glass())
}

/// A pool's water needs no face at its walls.
#[test]
fn water_that_walls_close_has_no_gaps() {
    assert_eq!(faults(&pool(1.0)), NONE);
    for half in [0.8, 0.98, 0.99] {
        let told = faults(&pool(half));
        assert_eq!(told.len(), 1, "{half}: {told:?}");
        assert!(told[0].starts_with("glass of object \"water\" has gaps at the edge of \"water\""), "{told:?}");
    }
    let brim =
        box_of("basin", [[-1.0, -1.0, -1.0], [1.0, 0.0, 1.0]], |face| if face == "top" { "water" } else { "white" });
    assert_eq!(faults(&format!("{}{brim}", water_and_glass())), NONE);
}

/// The water ends within thick walls, as modelled often.
#[test]
fn edges_in_walls_are_no_gaps() {
    let side = |name: &str, low: [f64; 3], high: [f64; 3]| box_of(name, [low, high], |_| "white");
    let walls = [
        side("floor", [-1.2, -1.2, -1.2], [1.2, -1.0, 1.2]),
        side("left", [-1.2, -1.0, -1.2], [-1.0, 0.5, 1.2]),
        side("right", [1.0, -1.0, -1.2], [1.2, 0.5, 1.2]),
        side("back", [-1.0, -1.0, -1.2], [1.0, 0.5, -1.0]),
        side("front", [-1.0, -1.0, 1.0], [1.0, 0.5, 1.2]),
    ];
    let water = quad("water", [[-1.1, 0.0, -1.1], [0.0, 0.0, 2.2], [2.2, 0.0, 0.0]], "water");
    assert_eq!(faults(&format!("{}{}{water}", water_and_glass(), walls.concat())), NONE);
}

/// A sea up to the horizon has its edges where nobody sees them.
#[test]
fn edges_far_away_are_no_gaps() {
    let ground = object("ground", "plane", "white", "point = [0, -1, 0]\nnormal = [0, 1, 0]\n");
    let sea = |half: f64| quad("sea", [[-half, 0.0, -half], [0.0, 0.0, 2.0 * half], [2.0 * half, 0.0, 0.0]], "water");
    let told = |half: f64| faults(&format!("{}{ground}{}", water_and_glass(), sea(half)));
    assert_eq!(told(500.0), NONE);
    assert!(told(3.0)[0].contains("has gaps"), "{:?}", told(3.0));
}

/// Of water in a glass, the glass is another body: it does not close the water.
#[test]
fn glass_of_another_body_closes_no_water() {
    let walls =
        box_of("out", [[-1.2, -1.2, -1.2], [1.2, 1.2, 1.2]], |_| "g") + &box_of("in", [[1.0; 3], [-1.0; 3]], |_| "g");
    let head = water_and_glass();
    let sheet = quad("water", [[-1.0, 0.0, -1.0], [0.0, 0.0, 2.0], [2.0, 0.0, 0.0]], "water");
    let told = faults(&format!("{head}{walls}{sheet}"));
    assert!(told.len() == 1 && told[0].starts_with("glass of object \"water\" has gaps"), "{told:?}");
    let whole = |depth: f64| box_of("water", [[-depth; 3], [depth, 0.0, depth]], |_| "water");
    assert_eq!(faults(&format!("{head}{walls}{}", whole(1.001))), NONE, "pushed into the glass");
    let told = faults(&format!("{head}{walls}{}", whole(1.0)));
    assert!(told.len() == 1 && told[0].contains("of another medium: no air is between them"), "{told:?}");
}

/// A film of quads and one of patches: however thin, it is neither open nor inside out.
#[test]
fn thin_films_are_closed() {
    for thickness in [1e-3, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9] {
        let quads = box_of("film", [[-1.0, 0.0, -1.0], [1.0, thickness, 1.0]], |_| "g");
        let head = water_and_glass();
        assert_eq!(faults(&format!("{head}{quads}")), NONE, "quads, {thickness}");
        assert_eq!(faults(&format!("{head}{}", patches_of(&quads, "g"))), NONE, "patches, {thickness}");
    }
}

/// A lid that floats 1 % of the width above its box.
#[test]
fn narrow_gaps_are_found() {
    let whole = box_of("box", [[-1.0; 3], [1.0; 3]], |_| "g");
    let at = whole.find("\"box top\"").expect("a top");
    let lifted = |by: f64| {
        whole[..at].to_owned() + &whole[at..].replacen("[-1.0, 1.0, -1.0]", &format!("[-1.0, {:?}, -1.0]", 1.0 + by), 1)
    };
    for (what, body) in [("quads", lifted(0.01)), ("patches", patches_of(&lifted(0.01), "g"))] {
        let told = faults(&(water_and_glass() + &body));
        assert!(told.len() == 1 && told[0].contains("has gaps at the edge of"), "{what}: {told:?}");
    }
    assert_eq!(faults(&(water_and_glass() + &lifted(1e-6))), NONE, "up to the rounding of a file");
}

/// Surfaces of one body that overlap or coincide bound its inside, too.
#[test]
fn overlapping_surfaces_of_a_body_are_not_inside_out() {
    let head = water_and_glass();
    let ball = |name: &str, x: f64, radius: f64| sphere(name, [x, 0.0, 0.0], radius, "g");
    assert_eq!(faults(&format!("{head}{}{}", ball("a", 0.0, 1.0), ball("b", 0.1, 0.3))), NONE, "one in the other");
    assert_eq!(faults(&format!("{head}{}{}", ball("a", 0.0, 1.0), ball("b", 0.0, 1.0))), NONE, "two in one place");
    let inverted = box_of("box", [[1.0; 3], [-1.0; 3]], |_| "g");
    assert!(faults(&(head + &inverted))[0].contains("is inside out"));
}

fn point_lamp(position: [f64; 3]) -> String {
    format!("[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = {position:?}\nintensity = [1, 1, 1]\n")
}

#[test]
fn lights_in_closed_boxes_are_told() {
    let mirror = "[[material]]\nname = \"mirror\"\ntype = \"mirror\"\nreflectance = [1, 1, 1]\n";
    let head = water_and_glass() + mirror + &point_lamp([0.2, 0.3, 0.1]);
    let whole = box_of("box", [[-1.0; 3], [1.0; 3]], |_| "mirror");
    let room = box_of("room", [[-9.0; 3], [9.0; 3]], |_| "white");
    for text in [format!("{head}{whole}"), format!("{head}{whole}{room}")] {
        let told = faults(&text);
        assert!(
            told.len() == 1 && told[0].starts_with("light \"lamp\" is inside of the opaque objects \"box left\""),
            "{told:?}"
        );
    }
    let open = whole.replacen("edge_v = [0.0, 2.0, 0.0]", "edge_v = [0.0, 1.5, 0.0]", 1);
    assert_eq!(faults(&format!("{head}{open}")), NONE, "an opening");
    assert_eq!(faults(&format!("{head}{room}")), NONE, "a room with the camera");
}

/// Boxes that share a strip of their faces have no gaps.
#[test]
fn a_narrow_contact_is_no_gap() {
    let beside = |width: f64| box_of("beside", [[1.0, 1.0 - width, -1.0], [2.0, 2.0, 1.0]], |_| "water");
    let head = water_and_glass() + &box_of("box", [[-1.0; 3], [1.0; 3]], |_| "g");
    for width in [0.001, 0.01, 0.1, 0.5] {
        let told = faults(&format!("{head}{}", beside(width)));
        assert!(told.len() == 1 && told[0].contains("coincides with a face of \"be"), "{width}: {told:?}");
    }
}

#[test]
fn a_camera_in_a_dark_solid_is_told() {
    let head = water_and_glass();
    let ball = sphere("ball", [1.0, 2.0, 5.0], 0.5, "white");
    let told = faults(&format!("{head}{ball}{}", point_lamp([0.0; 3])));
    assert!(told.len() == 1 && told[0].starts_with("the camera is inside of the opaque object \"ball\""), "{told:?}");
    let dome = sphere("dome", [0.0; 3], 100.0, "white");
    assert_eq!(faults(&format!("{head}{dome}{}", point_lamp([0.0; 3]))), NONE, "a dome with a lamp");
}

/// A small face on a large one, and two bodies in one place: one warning for each two bodies.
#[test]
fn faces_that_coincide_are_told() {
    let head = glass([1.0, 2.0, 5.0], &[("g", 1.5, 0.0), ("h", 1.5, 0.0), ("dense", 1.7, 0.0)]);
    let lower = box_of("lower", [[-1.0; 3], [1.0, 0.0, 1.0]], |_| "g");
    let upper = |material: &'static str| box_of("upper", [[-0.3, 0.0, -0.3], [0.5, 0.8, 0.5]], move |_| material);
    let same = box_of("same", [[-1.0; 3], [1.0, 0.0, 1.0]], |_| "dense");
    for (other, face, fault) in [
        (upper("h"), "upper bottom", "of the same medium: the faces are invisible"),
        (upper("dense"), "upper bottom", "of another medium: no air is between them"),
        (same, "same", "as all faces do: only the medium of the body \"dense\" is seen"),
    ] {
        let told = faults(&format!("{head}{lower}{other}"));
        assert_eq!(told.len(), 1, "{told:?}");
        assert!(
            told[0].contains(&format!("coincides with a face of \"{face}")) && told[0].ends_with(fault),
            "{told:?}"
        );
    }
}
