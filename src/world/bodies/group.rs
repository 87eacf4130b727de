use super::Body;
use crate::geometry::Primitive;
use crate::scene::{BodyKey, Material, MaterialModel, Object, Scene};
use crate::world::Surface;

/// A body with its key and priority.
struct Group<'s> {
    key: BodyKey<'s>,
    body: Body,
    priority: i32,
}

/// The bodies of a scene in ascending order of their rank; enters each into its surfaces.
///
/// Where several bodies contain a point, the medium of the body with the highest priority applies; among equals that of the smaller
/// bounding box, then that of the later body in the file.
pub(in crate::world) fn bodies(scene: &Scene, primitives: &[Primitive], surfaces: &mut [Surface]) -> Vec<Body> {
    let mut groups = Vec::new();
    for (index, surface) in (0..).zip(surfaces.iter()) {
        if let Surface::Object { object, material, .. } = surface {
            let (object, material) = (&scene.objects[*object as usize], &scene.materials[*material as usize]);
            add(object, material, index, &primitives[index as usize], &mut groups);
        }
    }
    for group in &mut groups {
        group.body.is_closed = group.body.is_crossed_evenly(primitives);
    }
    let mut groups = joined(groups, primitives);
    // Stable: of equal bodies the later one in the file stays behind.
    groups.sort_by(|a, b| {
        let area = |group: &Group<'_>| group.body.bounds.half_area();
        a.priority.cmp(&b.priority).then(area(b).total_cmp(&area(a)))
    });
    let bodies: Vec<Body> = groups.into_iter().map(|group| group.body).collect();
    for (rank, body) in (0..).zip(&bodies) {
        for &p in &body.primitives {
            if let Surface::Object { body, .. } = &mut surfaces[p as usize] {
                *body = Some(rank);
            }
        }
    }
    bodies
}

/// Adds a primitive to its group, if it is of glass.
fn add<'s>(object: &'s Object, material: &Material, index: u32, primitive: &Primitive, groups: &mut Vec<Group<'s>>) {
    let MaterialModel::Glass { ior, absorption, priority, .. } = material.model else { return };
    let key = object.body_key();
    let found = groups.iter().position(|group| group.key == key);
    let at = found.unwrap_or_else(|| {
        groups.push(Group { key, body: Body::new(key.name().to_owned(), ior, absorption), priority });
        groups.len() - 1
    });
    groups[at].priority = groups[at].priority.max(priority);
    groups[at].body.add(index, primitive);
}

/// The groups, with open bodies of equal medium and priority made one where they close each other: a box of water whose top has a material of
/// its own.
fn joined<'s>(groups: Vec<Group<'s>>, primitives: &[Primitive]) -> Vec<Group<'s>> {
    let mut joined: Vec<Group<'s>> = Vec::new();
    for (at, group) in groups.iter().enumerate() {
        let fits = |other: &&Group<'_>| {
            let (a, b) = (&group.body, &other.body);
            !b.is_closed && (a.ior, a.absorption, group.priority) == (b.ior, b.absorption, other.priority)
        };
        let mut body = group.body.clone();
        if !body.is_closed {
            let all = groups.iter().filter(fits).flat_map(|other| other.body.primitives.clone());
            let mut whole = Body { primitives: Vec::new(), ..body.clone() };
            all.for_each(|p| whole.add(p, &primitives[p as usize]));
            if whole.primitives.len() > body.primitives.len() && whole.is_crossed_evenly(primitives) {
                if groups[..at].iter().any(|other| fits(&other)) {
                    continue;
                }
                body = Body { is_closed: true, ..whole };
            }
        }
        joined.push(Group { key: group.key, body, priority: group.priority });
    }
    joined
}
