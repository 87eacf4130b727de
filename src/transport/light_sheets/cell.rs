use super::coverage::fraction_in_square;
use super::query::SheetQuery;
use crate::math::Rgb;
use glam::{Vec2, Vec3, Vec4};

/// Least cosine between a surface and the light for which the light's cross-section is projected on the surface.
const LEAST_COS: f32 = 1e-4;
/// How far a surface may rise over a cell, over the diagonal of the cell.
const RISE: f32 = 0.15;

/// A corner of a cell where it lands.
#[derive(Clone, Copy, Debug)]
pub(super) struct CellCorner {
    /// Position relative to [`View::origin`](crate::world::View::origin).
    pub(super) position: Vec3,
    /// Unit direction towards where the light came from.
    pub(super) wi: Vec3,
}

/// Three coordinates of each of four corners, a vector for each coordinate.
type OfCorners = [Vec4; 3];

fn of_corners(vectors: [Vec3; 4]) -> OfCorners {
    std::array::from_fn(|axis| Vec4::from_array(vectors.map(|vector| vector[axis])))
}

/// The product with a vector for each corner.
#[inline(always)]
fn dot([x, y, z]: OfCorners, v: Vec3) -> Vec4 {
    x * v.x + y * v.y + z * v.z
}

/// The light of a cell of the lattice where it lands: two triangles, between the corners 0, 1, 2 and 0, 2, 3.
#[derive(Clone, Copy, Debug)]
pub(super) struct SheetCell {
    positions: OfCorners,
    wi: OfCorners,
    /// Flux of each triangle, W.
    pub(super) flux: [Rgb; 2],
    /// Side of the surface and number of surfaces on the way, as of photons.
    pub(super) tag: u32,
    /// Whether the surface is flat.
    is_flat: bool,
}

impl SheetCell {
    /// A cell from its corners, the flux of each triangle, W, its tag, and whether its surface is flat; `None` where a number is not finite.
    pub(super) fn new(corners: [CellCorner; 4], flux: [Rgb; 2], tag: u32, is_flat: bool) -> Option<Self> {
        let (positions, wi) =
            (of_corners(corners.map(|corner| corner.position)), of_corners(corners.map(|corner| corner.wi)));
        let is_valid =
            flux.iter().all(|flux| flux.is_finite()) && positions.iter().chain(&wi).all(|vector| vector.is_finite());
        is_valid.then_some(Self { positions, wi, flux, tag, is_flat })
    }

    /// The corners of the box around the surface that the cell may light, least and greatest coordinates.
    pub(super) fn bounds(&self) -> [Vec3; 2] {
        let (min, max) = (self.positions.map(Vec4::min_element).into(), self.positions.map(Vec4::max_element).into());
        let rise = if self.is_flat { 0.0 } else { RISE * Vec3::distance(min, max) };
        [min - rise, max + rise]
    }

    /// The mean irradiance that the cell brings to the parallelogram of the query, W per square scene unit; 0 from behind the surface.
    #[inline(always)]
    pub(super) fn irradiance(&self, query: &SheetQuery) -> Rgb {
        let SheetQuery { position, normal, axes, .. } = query;
        let offsets: OfCorners = std::array::from_fn(|axis| self.positions[axis] - position[axis]);
        // Along the light into the plane of the query.
        let cosines = dot(self.wi, *normal);
        let along = dot(offsets, *normal) / cosines;
        let offsets: OfCorners = std::array::from_fn(|axis| offsets[axis] - self.wi[axis] * along);
        let [x, y] = axes.map(|axis| dot(offsets, axis));
        let is_aside =
            x.min_element() > 1.0 || y.min_element() > 1.0 || x.max_element() < -1.0 || y.max_element() < -1.0;
        if is_aside || cosines.min_element() < LEAST_COS {
            return Rgb::ZERO;
        }
        let corner = |k: usize| Vec2::new(x[k], y[k]);
        let flux = self.flux[0] * fraction_in_square([corner(0), corner(1), corner(2)])
            + self.flux[1] * fraction_in_square([corner(0), corner(2), corner(3)]);
        flux / query.area
    }

    /// Unit direction towards where the light of the cell comes from.
    #[inline]
    pub(super) fn wi(&self) -> Vec3 {
        Vec3::from(self.wi.map(Vec4::element_sum)).normalize_or(Vec3::from(self.wi.map(|axis| axis.x)))
    }
}
