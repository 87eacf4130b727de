use super::coincidence::{Shape, contact};
use crate::geometry::Primitive;
use crate::math::Aabb;
use crate::world::Surface;
use glam::DVec3;
use std::collections::HashMap;

/// For surfaces, those that coincide with them over an area, up to rounding.
///
/// A ray cannot meet surfaces of glass one after the other that coincide: they are one interface between the medium before and the medium
/// behind all of them. Where glass coincides with an opaque surface or a light, the ray meets the latter; where an opaque surface
/// coincides with a light, it meets the light.
#[derive(Clone, Debug, Default)]
pub struct Contacts {
    /// Of glass, all surfaces; of opaque surfaces, the lights. Lights come first, then in ascending order.
    of: HashMap<u32, Vec<u32>>,
    /// Distance at which each surface is one with those that touch it, scene units; equal for all that touch each other, so that a ray that
    /// leaves one of them is beyond all.
    tolerances: HashMap<u32, f64>,
}

/// Which surface a ray meets where several coincide: the greatest.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Glass,
    Opaque,
    Light,
}

impl Contacts {
    /// The contacts of all primitives, which have these magnitudes.
    pub(in crate::world) fn new(primitives: &[Primitive], surfaces: &[Surface], magnitudes: &[DVec3]) -> Self {
        let shape = |k: u32| Shape { primitive: &primitives[k as usize], magnitude: magnitudes[k as usize] };
        let shapes: Vec<Shape<'_>> = (0..primitives.len() as u32).map(shape).collect();
        let kind = |k: u32| match surfaces[k as usize] {
            Surface::Object { body: Some(_), .. } => Kind::Glass,
            Surface::Object { body: None, .. } => Kind::Opaque,
            Surface::Light(_) => Kind::Light,
        };
        let object = |k: u32| match surfaces[k as usize] {
            Surface::Object { object, .. } => Some(object),
            Surface::Light(_) => None,
        };
        // A ray that meets the first also meets the second.
        let yields = |a: u32, b: u32| kind(a) == Kind::Glass || kind(a) < kind(b);
        let mut contacts = Self::default();
        let mut pairs = Vec::new();
        for [a, b] in neighbours(&shapes, |a, b| yields(a, b) || yields(b, a)) {
            let is_one_object = object(a).is_some() && object(a) == object(b);
            let Some(tolerance) = contact(shapes[a as usize], shapes[b as usize], is_one_object) else { continue };
            pairs.push([a, b]);
            for [from, to] in [[a, b], [b, a]] {
                if yields(from, to) {
                    contacts.of.entry(from).or_default().push(to);
                }
                let known = contacts.tolerances.entry(from).or_default();
                *known = known.max(tolerance);
            }
        }
        contacts.of.values_mut().for_each(|list| list.sort_unstable_by_key(|&k| (kind(k) != Kind::Light, k)));
        contacts.share_tolerances(&pairs);
        contacts
    }

    /// Gives all surfaces that touch each other, directly or by way of others, the greatest tolerance among them.
    fn share_tolerances(&mut self, pairs: &[[u32; 2]]) {
        let mut is_shared = false;
        while !is_shared {
            is_shared = true;
            for pair in pairs {
                let [x, y] = pair.map(|k| self.tolerances[&k]);
                is_shared &= x == y;
                self.tolerances.extend(pair.map(|k| (k, x.max(y))));
            }
        }
    }

    /// Distance at which a surface is one with those that touch it, scene units; 0 without contact.
    pub(in crate::world) fn tolerance(&self, primitive: u32) -> f64 {
        self.tolerances.get(&primitive).copied().unwrap_or(0.0)
    }

    /// The pairs of surfaces of glass that touch, in ascending order.
    pub fn pairs_of_glass(&self) -> Vec<(u32, u32)> {
        let of = |(&a, touching): (&u32, &Vec<u32>)| touching.iter().map(|&b| (a, b)).collect::<Vec<_>>();
        let mut pairs: Vec<_> = self.of.iter().flat_map(of).collect();
        // Glass stands under glass on both sides.
        pairs.retain(|(a, b)| a < b && self.of(*b).contains(a));
        pairs.sort_unstable();
        pairs
    }

    /// The surfaces that touch this one somewhere, as far as a ray that meets this one meets them, too.
    #[inline]
    pub fn of(&self, primitive: u32) -> &[u32] {
        if self.of.is_empty() { &[] } else { self.of.get(&primitive).map_or(&[], Vec::as_slice) }
    }
}

/// The pairs of primitives whose boxes are within the tolerance of contacts and that `is_wanted` accepts, each once: a sweep along x.
fn neighbours(shapes: &[Shape], is_wanted: impl Fn(u32, u32) -> bool) -> Vec<[u32; 2]> {
    let everywhere = Aabb { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY };
    let inflated = |shape: &Shape| {
        let bounds = shape.primitive.bounds();
        if bounds.is_empty() { everywhere } else { bounds.inflated(shape.reach()) }
    };
    let mut boxes: Vec<(Aabb, u32)> = shapes.iter().map(inflated).zip(0..).collect();
    boxes.sort_by(|(a, _), (b, _)| a.min.x.total_cmp(&b.min.x));
    let mut pairs = Vec::new();
    for (k, (a, p)) in boxes.iter().enumerate() {
        for (b, q) in boxes[k + 1..].iter().take_while(|(b, _)| b.min.x <= a.max.x) {
            let meet = a.min.cmple(b.max).all() && b.min.cmple(a.max).all();
            if meet && is_wanted(*p, *q) {
                pairs.push([*p.min(q), *p.max(q)]);
            }
        }
    }
    pairs
}
