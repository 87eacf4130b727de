//! Faces of two bodies of glass that coincide.

use super::warning::Warning;
use crate::scene::Scene;
use crate::world::World;
use crate::world::bodies::Body;
use std::collections::BTreeMap;

/// Difference of the boxes of two bodies that fill the same space, in diagonals: above the rounding of a file.
const SAME: f64 = 1e-6;

/// For each two bodies with coincident faces, one warning with the names of two such faces.
pub(super) fn of_contacts(scene: &Scene, world: &World, warnings: &mut Vec<Warning>) {
    let mut faces: BTreeMap<[u32; 2], Vec<(u32, u32)>> = BTreeMap::new();
    for (a, b) in world.contacts.pairs_of_glass() {
        let (Some(p), Some(q)) = (world.body_of(a), world.body_of(b)) else { continue };
        if p != q {
            faces.entry([p.min(q), p.max(q)]).or_default().push((a, b));
        }
    }
    for (ranks, faces) in faces {
        let [hidden, counting] = ranks.map(|rank| &world.bodies[rank as usize]);
        let names = <[u32; 2]>::from(faces[0])
            .map(|k| world.object_of(k).map_or("", |object| &scene.objects[object as usize].name));
        let of = format!("coincides with a face of \"{}\"", names[1]);
        let (fault, remedy) = if (hidden.ior, hidden.absorption) == (counting.ior, counting.absorption) {
            let fault = format!("{of}, of the same medium: the faces are invisible");
            (fault, "leave both faces out, or give the objects the same `body`")
        } else if fill_the_same_space(hidden, counting, &faces) {
            let fault = format!("{of}, as all faces do: only the medium of the body \"{}\" is seen", counting.name);
            (fault, "take one of the bodies away, or make one smaller")
        } else {
            let fault = format!("{of}, of another medium: no air is between them");
            (fault, "move the bodies apart, unless that is meant")
        };
        warnings.push(Warning::new(format!("object \"{}\"", names[0]), fault, remedy));
    }
}

/// Whether two bodies with these coincident faces have no other ones, and equal boxes.
fn fill_the_same_space(a: &Body, b: &Body, faces: &[(u32, u32)]) -> bool {
    let tolerance = SAME * a.bounds.diagonal();
    let corners = [(a.bounds.min, b.bounds.min), (a.bounds.max, b.bounds.max)];
    let touch = |p: &u32| faces.iter().any(|(x, y)| x == p || y == p);
    corners.iter().all(|(x, y)| x.distance(*y) <= tolerance) && a.primitives.iter().chain(&b.primitives).all(touch)
}
