use super::coincidence::TOUCHING;
use super::crossings::{crossings, point_of, spread};
use crate::geometry::Primitive;
use crate::math::{Aabb, Ray, Rgb, warp};
use crate::world::Surface;
use glam::DVec3;
use rayon::prelude::*;
use std::collections::HashMap;

/// Lines that are drawn through a body to see whether it is closed. Fewer would miss gaps of a few percent of its surface; more would take
/// time after each edit.
const TEST_LINES: usize = 128;
/// Lines that may slip through the seams of a closed body. With none, the seams of a closed body could make it open; with more, larger gaps
/// would pass as closed.
const SLIPPED: usize = 1;
/// Area of a surface, over that of the largest one, below which no line is drawn through its points: at the rim of a film, rounding would
/// tell what the line crosses.
const NARROW: f64 = 1e-8;
/// Distance, in diagonals of the body's box, at which a ray from a surface may hit this surface again: above rounding.
const SELF: f64 = 1e-6;
/// Rays that tell on which side of a closed surface a point is. An odd number has a majority. With fewer, rays through seams
/// could decide; more would take time after each edit.
const VOTES: usize = 9;

/// One piece of glass, or of any other clear medium. Its rank is its index in the world.
#[derive(Clone, Debug)]
pub struct Body {
    /// The name of the body, or of the material of objects without one.
    pub name: String,
    /// Index of refraction, relative to air.
    pub ior: f64,
    /// The Beer-Lambert absorption coefficient, per scene unit; `None` where it is zero.
    pub absorption: Option<Rgb>,
    /// Indices of the primitives that bound it.
    pub(in crate::world) primitives: Vec<u32>,
    /// The box of its surfaces; infinite with a plane.
    pub(in crate::world) bounds: Aabb,
    /// Whether it has an inside without gaps.
    pub(super) is_closed: bool,
}

impl Body {
    /// The body without surfaces.
    pub(in crate::world) fn new(name: String, ior: f64, absorption: Rgb) -> Self {
        let absorption = (absorption != Rgb::ZERO).then_some(absorption);
        Self { name, ior, absorption, primitives: Vec::new(), bounds: Aabb::EMPTY, is_closed: false }
    }

    /// Whether light goes through the body as through air.
    pub(in crate::world) fn is_air(&self) -> bool {
        self.ior == 1.0 && self.absorption.is_none()
    }

    /// Transmittance over this distance (scene units), by the Beer-Lambert law.
    #[inline]
    pub fn transmittance(&self, distance: f64) -> Rgb {
        self.absorption.map_or(Rgb::ONE, |a| (-a * distance as f32).exp())
    }

    /// Adds a surface.
    pub(in crate::world) fn add(&mut self, index: u32, primitive: &Primitive) {
        self.primitives.push(index);
        let unbounded = Aabb { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY };
        let bounds = if matches!(primitive, Primitive::Plane(_)) { unbounded } else { primitive.bounds() };
        self.bounds = self.bounds.union(&bounds);
    }

    /// The crossings of a ray with the body, in any order: the distance along the ray, and whether it comes from the front.
    pub(super) fn crossings(&self, ray: &Ray, primitives: &[Primitive]) -> impl Iterator<Item = (f64, bool)> {
        self.primitives.iter().flat_map(move |&p| crossings(ray, &primitives[p as usize]))
    }

    /// Whether lines enter the body as often as they leave it. A line may slip through a seam of patches. A half-space is closed.
    pub(super) fn is_crossed_evenly(&self, primitives: &[Primitive]) -> bool {
        self.lines_with(primitives, |fronts| fronts.map(|front| if front { 1 } else { -1 }).sum::<i32>() != 0)
            <= SLIPPED
    }

    /// Whether the body has an inside without gaps.
    pub(in crate::world) fn is_closed(&self) -> bool {
        self.is_closed
    }

    /// Whether the surfaces leave gaps, whichever way their normals point: lines meet them an odd number of times.
    pub(in crate::world) fn has_gaps(&self, primitives: &[Primitive]) -> bool {
        self.lines_with(primitives, |fronts| fronts.count() % 2 == 1) > SLIPPED
    }

    /// The number of test lines through the body whose crossings (from the front or not) `is_counted` accepts; 0 for a half-space.
    fn lines_with(
        &self,
        primitives: &[Primitive],
        is_counted: impl Fn(&mut dyn Iterator<Item = bool>) -> bool + Sync,
    ) -> usize {
        if !self.bounds.min.is_finite() {
            return 0;
        }
        let areas = self.primitives.iter().map(|&p| primitives[p as usize].bounds().half_area());
        let narrow = NARROW * areas.clone().fold(0.0, f64::max);
        let wide: Vec<u32> = areas.zip(&self.primitives).filter(|(area, _)| *area >= narrow).map(|(_, &p)| p).collect();
        let counted = |k: &usize| {
            let through = &primitives[wide[k % wide.len()] as usize];
            point_of(through, spread(*k)).is_some_and(|(point, _)| {
                let line = Ray { t_min: f64::NEG_INFINITY, ..Ray::new(point, warp::uniform_sphere(spread(k / 2))) };
                is_counted(&mut self.crossings(&line, primitives).map(|(_, front)| front))
            })
        };
        (0..TEST_LINES).into_par_iter().filter(counted).count()
    }

    /// The primitives of a body without gaps whose normals point to its inside: behind them is the outside of the body, before them not.
    /// Primitives of which the normals point to the same side of one sheet are told by the first of them.
    pub(in crate::world) fn facing_inward(&self, primitives: &[Primitive], surfaces: &[Surface]) -> Vec<u32> {
        let mut sides: HashMap<u32, bool> = HashMap::new();
        let is_inward = |p: &&u32| match surfaces[**p as usize] {
            Surface::Object { front_side, .. } => {
                *sides.entry(front_side).or_insert_with(|| self.is_inward(**p, primitives))
            }
            Surface::Light(_) => false,
        };
        self.primitives.iter().filter(is_inward).copied().collect()
    }

    fn is_inward(&self, primitive: u32, primitives: &[Primitive]) -> bool {
        let votes = (0..VOTES).filter(|&k| {
            point_of(&primitives[primitive as usize], spread(k)).is_some_and(|(point, normal)| {
                let depth = |direction| self.depth_beside(primitive, point, direction, primitives);
                depth(normal) != 0 && depth(-normal) == 0
            })
        });
        2 * votes.count() > VOTES
    }

    /// How often a path from far away enters the body without leaving it on its way to a point just beside a primitive.
    fn depth_beside(&self, primitive: u32, point: DVec3, direction: DVec3, primitives: &[Primitive]) -> i32 {
        let of = |&other: &u32| {
            // The surface itself is not ahead, but one that coincides with it is.
            let t_min = if other == primitive {
                SELF * self.bounds.diagonal()
            } else {
                -TOUCHING * primitives[other as usize].magnitude().length()
            };
            let ray = Ray { t_min, ..Ray::new(point, direction) };
            crossings(&ray, &primitives[other as usize]).map(|(_, front)| if front { -1 } else { 1 }).sum::<i32>()
        };
        self.primitives.iter().map(of).sum()
    }

    /// Whether a closed surface contains the point; almost never for an open one.
    pub(in crate::world) fn contains(&self, point: DVec3, primitives: &[Primitive]) -> bool {
        let is_inside = |k: usize| {
            let ray = Ray::new(point, warp::uniform_sphere(spread(k)));
            self.crossings(&ray, primitives).count() % 2 == 1
        };
        self.bounds.distance(point) == 0.0 && (0..VOTES).all(is_inside)
    }
}
