use crate::math::OrthonormalBasis;
use glam::Vec3;

/// Rounding of positions, over the largest coordinate.
const ROUNDING: f32 = 4.0 * f32::EPSILON;
/// Distance from the plane of a parallelogram to cells that light it, over its size.
const THICKNESS: f32 = 0.1;

/// A point of a surface that asks for the light of sheets, and a parallelogram around it over which the light is averaged.
pub(in crate::transport) struct SheetQuery {
    /// Relative to [`View::origin`](crate::world::View::origin).
    pub(in crate::transport) position: Vec3,
    /// Geometric unit normal.
    pub(in crate::transport) normal: Vec3,
    /// Half the sides of the parallelogram.
    sides: [Vec3; 2],
    /// The vectors whose products with an offset are its coordinates, from -1 to 1 in the parallelogram.
    pub(super) axes: [Vec3; 2],
    /// Area of the parallelogram, square scene units.
    pub(super) area: f32,
    /// First tag of light that counts.
    pub(in crate::transport) tag_start: u32,
    /// Number of tags that count.
    pub(in crate::transport) tag_span: u32,
}

impl SheetQuery {
    /// The query in the middle of a square of this side, scene units, on the plane of this normal.
    #[inline]
    pub(in crate::transport) fn square(position: Vec3, normal: Vec3, side: f32, tags: [u32; 2]) -> Self {
        let OrthonormalBasis { tangent, bitangent, .. } = OrthonormalBasis::from_normal(normal.as_dvec3());
        let half = 0.5 * side;
        Self::parallelogram(position, normal, [half * tangent.as_vec3(), half * bitangent.as_vec3()], tags)
    }

    /// The query in the middle of a parallelogram of which these are half the sides, across the normal.
    #[inline]
    pub(in crate::transport) fn parallelogram(
        position: Vec3,
        normal: Vec3,
        sides: [Vec3; 2],
        [tag_start, tag_span]: [u32; 2],
    ) -> Self {
        let across = [sides[1].cross(normal), sides[0].cross(normal)];
        let axes = [across[0] / across[0].dot(sides[0]), across[1] / across[1].dot(sides[1])];
        Self { position, normal, sides, axes, area: 4.0 * sides[0].cross(sides[1]).length(), tag_start, tag_span }
    }

    /// The least and greatest coordinates of what lies on the parallelogram, up to rounding: the surface and the cells on it may both be flat.
    #[inline]
    pub(super) fn bounds(&self) -> [Vec3; 2] {
        let rounding = ROUNDING * self.position.abs().max_element();
        let reach = self.sides[0].abs() + self.sides[1].abs();
        let reach = reach + rounding + THICKNESS * reach.max_element();
        [self.position - reach, self.position + reach]
    }
}
