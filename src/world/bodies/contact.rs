use super::crossings::point_of;
use crate::geometry::{Hit, Primitive};
use crate::math::Ray;
use crate::math::float::SELF_HIT_OFFSET;
use crate::world::Surface;
use glam::{DVec2, DVec3};
use std::collections::HashMap;

/// Points along each side of a surface at which its distance to another one is tested. Fewer would miss faces that share some
/// hundredths of their area; more would take time for each pair of surfaces whose boxes meet, after each edit.
const TESTED: usize = 8;
/// How near surfaces are that may be in contact, relative to their coordinates: no nearer than a ray starts off a surface that it leaves,
/// else the ray would miss the second surface.
pub(in crate::world) const TOUCHING: f64 = 2.0 * SELF_HIT_OFFSET;

/// For surfaces of glass, the surfaces that coincide with them over an area, up to rounding.
///
/// A ray cannot meet them one after the other: they are one interface between the medium before and the medium behind all of them.
#[derive(Clone, Debug, Default)]
pub struct Contacts {
    of: HashMap<u32, Vec<u32>>,
}

impl Contacts {
    /// The contacts of all surfaces of glass, of primitives with these magnitudes.
    pub(in crate::world) fn new(primitives: &[Primitive], surfaces: &[Surface], magnitudes: &[DVec3]) -> Self {
        // At least the rounding along any normal.
        let rounding = |k: u32| TOUCHING * magnitudes[k as usize].length();
        let mut contacts = Self::default();
        for (a, surface) in (0..).zip(surfaces) {
            let Surface::Object { object, body: Some(_), .. } = surface else { continue };
            for (b, other) in (0..).zip(surfaces) {
                let is_other_glass = match other {
                    // Patches of one object meet at their edges.
                    Surface::Object { object: same, .. } if same == object => continue,
                    Surface::Object { body, .. } => body.is_some(),
                    Surface::Light(_) => false,
                };
                if is_other_glass && b < a {
                    continue;
                }
                let [p, q] = [a, b].map(|k: u32| &primitives[k as usize]);
                if touch(p, q, rounding(a).max(rounding(b))) {
                    contacts.of.entry(a).or_default().push(b);
                    if is_other_glass {
                        contacts.of.entry(b).or_default().push(a);
                    }
                }
            }
        }
        contacts
    }

    /// All pairs of surfaces of glass and surfaces that touch them, in ascending order.
    pub fn pairs(&self) -> Vec<(u32, u32)> {
        let mut pairs: Vec<_> =
            self.of.iter().flat_map(|(&a, touching)| touching.iter().map(move |&b| (a, b))).collect();
        // A pair of two surfaces of glass stands under both.
        pairs.retain(|(a, b)| a < b || !self.of.contains_key(b));
        pairs.sort_unstable();
        pairs
    }

    /// The surfaces that touch this one somewhere.
    #[inline]
    pub fn of(&self, primitive: u32) -> &[u32] {
        if self.of.is_empty() { &[] } else { self.of.get(&primitive).map_or(&[], Vec::as_slice) }
    }
}

/// The hit on a primitive within this distance of a point of another surface with this unit normal, and the primitive's unit normal
/// there; `None` where they do not touch.
pub(in crate::world) fn touching(
    primitive: &Primitive,
    index: u32,
    [point, normal]: [DVec3; 2],
    distance: f64,
) -> Option<(Hit, DVec3)> {
    let ray = Ray { t_max: 2.0 * distance, ..Ray::new(point + distance * normal, -normal) };
    let (t, u, v) = primitive.intersect(&ray)?;
    let hit = Hit { t, primitive: index, u, v };
    Some((hit, primitive.surface(&ray, &hit).1))
}

/// Whether two primitives coincide over an area.
fn touch(a: &Primitive, b: &Primitive, distance: f64) -> bool {
    let (inflated, bounds) = (a.bounds().inflated(distance), b.bounds());
    let meet = inflated.min.cmple(bounds.max).all() && bounds.min.cmple(inflated.max).all();
    let unbounded = inflated.is_empty() || bounds.is_empty();
    (meet || unbounded) && (touches(a, b, distance) || touches(b, a, distance))
}

fn touches(a: &Primitive, b: &Primitive, distance: f64) -> bool {
    (0..TESTED * TESTED).any(|k| {
        let uv = (DVec2::new((k % TESTED) as f64, (k / TESTED) as f64) + 0.5) / TESTED as f64;
        point_of(a, uv).is_some_and(|(point, normal)| touching(b, 0, [point, normal], distance).is_some())
    })
}
