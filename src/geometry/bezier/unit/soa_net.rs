use super::ordinates::{Ordinates, Row};
use crate::geometry::bezier::ControlNet;
use crate::math::Aabb;
use glam::DVec3;

/// A control net as a structure of arrays, one per coordinate, so that SIMD transforms, splits and bounds whole nets.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SoaNet {
    pub(crate) x: Ordinates,
    pub(crate) y: Ordinates,
    pub(crate) z: Ordinates,
}

impl SoaNet {
    /// The net in this layout.
    pub(crate) fn new(net: &ControlNet) -> Self {
        let ordinates = |axis: usize| Ordinates(net.points.map(|row| Row(row.map(|p| p[axis]))));
        Self { x: ordinates(0), y: ordinates(1), z: ordinates(2) }
    }

    /// The net in affine coordinates that have these gradients and are zero at `origin`.
    #[inline(always)]
    pub(crate) fn in_coordinates(&self, gradients: [DVec3; 3], origin: DVec3) -> Self {
        let (x, y, z) = (self.x.minus(origin.x), self.y.minus(origin.y), self.z.minus(origin.z));
        let mut transformed = [Ordinates::ZERO; 3];
        for (ordinates, along) in transformed.iter_mut().zip(gradients) {
            for i in 0..4 {
                ordinates.0[i] = x.0[i] * along.x + y.0[i] * along.y + z.0[i] * along.z;
            }
        }
        let [x, y, z] = transformed;
        Self { x, y, z }
    }

    /// Control point `[i][j]`.
    #[inline(always)]
    pub(crate) fn point(&self, i: usize, j: usize) -> DVec3 {
        DVec3::new(self.x.0[i].0[j], self.y.0[i].0[j], self.z.0[i].0[j])
    }

    /// The mean of the four corner points.
    #[inline(always)]
    pub(crate) fn corner_mean(&self) -> DVec3 {
        DVec3::new(self.x.corner_mean(), self.y.corner_mean(), self.z.corner_mean())
    }

    /// The means over the patch of the derivatives by s and by t, the parameters scaled to -1 to 1.
    #[inline(always)]
    pub(crate) fn mean_derivatives(&self) -> [DVec3; 2] {
        let diagonals = (self.point(3, 3) - self.point(0, 0), self.point(3, 0) - self.point(0, 3));
        [0.25 * (diagonals.0 + diagonals.1), 0.25 * (diagonals.0 - diagonals.1)]
    }

    /// The box of the control points, which holds the surface.
    #[inline(always)]
    pub(crate) fn bounds(&self) -> Aabb {
        let (x, y, z) = (self.x.range(), self.y.range(), self.z.range());
        Aabb { min: DVec3::new(x.low, y.low, z.low), max: DVec3::new(x.high, y.high, z.high) }
    }

    /// The net of the subpatch over `u.0 <= u <= u.1`, `v.0 <= v <= v.1`; the ends may lie outside of 0 to 1.
    #[inline(always)]
    pub(crate) fn restricted(&self, u: (f64, f64), v: (f64, f64)) -> Self {
        let along_u =
            Self { x: self.x.restricted(u.0, u.1), y: self.y.restricted(u.0, u.1), z: self.z.restricted(u.0, u.1) };
        let Self { x, y, z } = along_u.transposed();
        Self { x: x.restricted(v.0, v.1), y: y.restricted(v.0, v.1), z: z.restricted(v.0, v.1) }.transposed()
    }

    /// The subpatches over `u <= 1/2` and over `u >= 1/2`.
    #[inline(always)]
    pub(crate) fn split_u(&self) -> [Self; 2] {
        let ([x0, x1], [y0, y1], [z0, z1]) = (self.x.halves(), self.y.halves(), self.z.halves());
        [Self { x: x0, y: y0, z: z0 }, Self { x: x1, y: y1, z: z1 }]
    }

    /// The subpatches over `v <= 1/2` and over `v >= 1/2`.
    #[inline(always)]
    pub(crate) fn split_v(&self) -> [Self; 2] {
        let [a, b] = self.transposed().split_u();
        [a.transposed(), b.transposed()]
    }

    /// The surface with u and v exchanged.
    #[inline(always)]
    fn transposed(&self) -> Self {
        Self { x: self.x.transposed(), y: self.y.transposed(), z: self.z.transposed() }
    }
}
