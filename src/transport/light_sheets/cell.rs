use super::coverage::fraction_in_square;
use super::query::SheetQuery;
use crate::math::Rgb;
use glam::{Vec2, Vec3};

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

/// The light of a cell of the lattice where it lands: two triangles, between the corners 0, 1, 2 and 0, 2, 3.
#[derive(Clone, Copy, Debug)]
pub(super) struct SheetCell {
    pub(super) corners: [CellCorner; 4],
    /// Flux of each triangle, W.
    pub(super) flux: [Rgb; 2],
    /// Side of the surface and number of surfaces on the way, as of photons.
    pub(super) tag: u32,
    /// Whether the surface is flat.
    pub(super) is_flat: bool,
}

impl SheetCell {
    /// Whether all its numbers are finite.
    pub(super) fn is_valid(&self) -> bool {
        self.flux.iter().all(|flux| flux.is_finite())
            && self.corners.iter().all(|corner| corner.position.is_finite() && corner.wi.is_finite())
    }

    /// The corners of the box around the surface that the cell may light, least and greatest coordinates.
    pub(super) fn bounds(&self) -> [Vec3; 2] {
        let positions = self.corners.map(|corner| corner.position);
        let fold = |of: fn(Vec3, Vec3) -> Vec3| positions.into_iter().reduce(of).unwrap_or_default();
        let (min, max) = (fold(Vec3::min), fold(Vec3::max));
        let rise = if self.is_flat { 0.0 } else { RISE * min.distance(max) };
        [min - rise, max + rise]
    }

    /// The mean irradiance that the cell brings to the parallelogram of the query, W per square scene unit; 0 from behind the surface.
    #[inline(always)]
    pub(super) fn irradiance(&self, query: &SheetQuery) -> Rgb {
        let SheetQuery { position, normal, axes, .. } = query;
        let (mut x, mut y, mut cosines) = ([0.0; 4], [0.0; 4], [0.0; 4]);
        for (k, CellCorner { position: corner, wi }) in self.corners.iter().enumerate() {
            let offset = *corner - *position;
            cosines[k] = wi.dot(*normal);
            // Along the light into the plane of the query.
            let offset = offset - *wi * (offset.dot(*normal) / cosines[k]);
            (x[k], y[k]) = (offset.dot(axes[0]), offset.dot(axes[1]));
        }
        let (least, most) =
            (|v: &[f32; 4]| v[0].min(v[1]).min(v[2].min(v[3])), |v: &[f32; 4]| v[0].max(v[1]).max(v[2].max(v[3])));
        let is_aside = least(&x) > 1.0 || least(&y) > 1.0 || most(&x) < -1.0 || most(&y) < -1.0;
        if is_aside || least(&cosines) < LEAST_COS {
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
        self.corners.iter().map(|corner| corner.wi).sum::<Vec3>().normalize_or(self.corners[0].wi)
    }
}
