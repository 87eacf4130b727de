use super::crossings::point_of;
use crate::geometry::{Hit, Primitive};
use crate::math::Ray;
use crate::math::float::{SELF_HIT_OFFSET, rounding};
use crate::world::Surface;
use glam::{DVec2, DVec3};
use std::collections::HashMap;

/// Points along each side of a surface at which its distance to another one is tested. Fewer would miss faces that share some
/// hundredths of their area; more would take time for each pair of surfaces whose boxes meet, after each edit.
const TESTED: usize = 8;
/// How near surfaces are that may be in contact, relative to their coordinates: no nearer than a ray starts off a surface that it leaves,
/// else the ray would miss the second surface.
pub(in crate::world) const TOUCHING: f64 = 2.0 * SELF_HIT_OFFSET;
/// Tolerance of a contact over the rounding of its surfaces, which is greater in other directions of the normal.
const MARGIN: f64 = TOUCHING / SELF_HIT_OFFSET;

/// For surfaces of glass, the surfaces that coincide with them over an area, up to rounding.
///
/// A ray cannot meet them one after the other: they are one interface between the medium before and the medium behind all of them.
#[derive(Clone, Debug, Default)]
pub struct Contacts {
    of: HashMap<u32, Vec<u32>>,
    /// Distance at which each surface is one with those that touch it, scene units; equal for all that touch each other, so that a ray that
    /// leaves one of them is beyond all.
    tolerances: HashMap<u32, f64>,
}

impl Contacts {
    /// The contacts of all surfaces of glass, of primitives with these magnitudes.
    pub(in crate::world) fn new(primitives: &[Primitive], surfaces: &[Surface], magnitudes: &[DVec3]) -> Self {
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
                let pair = [a, b].map(|k: u32| (&primitives[k as usize], magnitudes[k as usize]));
                let Some(tolerance) = contact(pair) else { continue };
                contacts.of.entry(a).or_default().push(b);
                if is_other_glass {
                    contacts.of.entry(b).or_default().push(a);
                }
                for k in [a, b] {
                    let known = contacts.tolerances.entry(k).or_default();
                    *known = known.max(tolerance);
                }
            }
        }
        contacts.share_tolerances();
        contacts
    }

    /// Gives all surfaces that touch each other, directly or by way of others, the greatest tolerance among them.
    fn share_tolerances(&mut self) {
        let pairs = self.pairs();
        let mut is_shared = false;
        while !is_shared {
            is_shared = true;
            for (a, b) in &pairs {
                let [x, y] = [self.tolerances[a], self.tolerances[b]];
                is_shared &= x == y;
                self.tolerances.extend([a, b].map(|&k| (k, x.max(y))));
            }
        }
    }

    /// Distance at which a surface is one with those that touch it, scene units; 0 without contact.
    pub(in crate::world) fn tolerance(&self, primitive: u32) -> f64 {
        self.tolerances.get(&primitive).copied().unwrap_or(0.0)
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

/// The distance at which two primitives of these magnitudes are one where they coincide over an area, scene units; `None` if they do not.
fn contact([a, b]: [(&Primitive, DVec3); 2]) -> Option<f64> {
    // At least the tolerance in any direction of the normal.
    let most = 3.0 * MARGIN * SELF_HIT_OFFSET * a.1.length().max(b.1.length()).max(least_extent(a.0, b.0));
    let (inflated, bounds) = (a.0.bounds().inflated(most), b.0.bounds());
    let meet = inflated.min.cmple(bounds.max).all() && bounds.min.cmple(inflated.max).all();
    let unbounded = inflated.is_empty() || bounds.is_empty();
    let found = (meet || unbounded).then(|| tolerance_on(a, b).max(tolerance_on(b, a)))?;
    (found > 0.0).then_some(found)
}

/// The extent of the smaller one of two primitives, scene units; 0 of two planes. Surfaces nearer than rounding of this length are one,
/// wherever the origin lies.
fn least_extent(a: &Primitive, b: &Primitive) -> f64 {
    let extent = |p: &Primitive| if p.bounds().is_empty() { f64::INFINITY } else { p.bounds().diagonal() };
    let least = extent(a).min(extent(b));
    if least.is_finite() { least } else { 0.0 }
}

/// The greatest tolerance of contact at tested points of `a` that touch `b`; 0 if none does.
fn tolerance_on(a: (&Primitive, DVec3), b: (&Primitive, DVec3)) -> f64 {
    let least = SELF_HIT_OFFSET * least_extent(a.0, b.0);
    let at = |k: usize| {
        let uv = (DVec2::new((k % TESTED) as f64, (k / TESTED) as f64) + 0.5) / TESTED as f64;
        let (point, normal) = point_of(a.0, uv)?;
        let known = |magnitude: DVec3| rounding(magnitude.max(point.abs()), normal);
        let tolerance = MARGIN * known(a.1).max(known(b.1)).max(least);
        touching(b.0, 0, [point, normal], tolerance).map(|_| tolerance)
    };
    (0..TESTED * TESTED).filter_map(at).fold(0.0, f64::max)
}
