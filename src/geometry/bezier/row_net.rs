use super::ControlNet;
use super::row::{Row, Rows};
use crate::math::Aabb;
use glam::DVec3;

/// A control net by coordinates: the form in which whole nets are transformed and bounded quickly.
#[derive(Clone, Copy, Debug)]
pub(super) struct RowNet {
    pub(super) x: Rows,
    pub(super) y: Rows,
    pub(super) z: Rows,
}

impl RowNet {
    pub(super) fn new(net: &ControlNet) -> Self {
        let rows = |axis: usize| Rows(net.points.map(|row| Row(row.map(|p| p[axis]))));
        Self { x: rows(0), y: rows(1), z: rows(2) }
    }

    /// The net in other coordinates, given by their gradients and by where they are zero.
    #[inline(always)]
    pub(super) fn in_coordinates(&self, gradients: [DVec3; 3], origin: DVec3) -> Self {
        let (x, y, z) = (self.x.less(origin.x), self.y.less(origin.y), self.z.less(origin.z));
        let mut rows = [Rows::ZERO; 3];
        for (rows, along) in rows.iter_mut().zip(gradients) {
            for i in 0..4 {
                rows.0[i] = x.0[i] * along.x + y.0[i] * along.y + z.0[i] * along.z;
            }
        }
        let [x, y, z] = rows;
        Self { x, y, z }
    }

    /// Control point `[i][j]`.
    #[inline(always)]
    pub(super) fn point(&self, i: usize, j: usize) -> DVec3 {
        DVec3::new(self.x.0[i].0[j], self.y.0[i].0[j], self.z.0[i].0[j])
    }

    /// The mean of the corners.
    #[inline(always)]
    pub(super) fn middle(&self) -> DVec3 {
        DVec3::new(self.x.middle(), self.y.middle(), self.z.middle())
    }

    /// The means of the partial derivatives, with parameters from -1 to 1.
    #[inline(always)]
    pub(super) fn mean_derivatives(&self) -> [DVec3; 2] {
        let diagonals = (self.point(3, 3) - self.point(0, 0), self.point(3, 0) - self.point(0, 3));
        [0.25 * (diagonals.0 + diagonals.1), 0.25 * (diagonals.0 - diagonals.1)]
    }

    /// The box around the control points.
    #[inline(always)]
    pub(super) fn bounds(&self) -> Aabb {
        let (x, y, z) = (self.x.range(), self.y.range(), self.z.range());
        Aabb { min: DVec3::new(x.low, y.low, z.low), max: DVec3::new(x.high, y.high, z.high) }
    }

    /// The net of the part between these ends along u and along v; they may lie outside of the unit interval.
    #[inline(always)]
    pub(super) fn restricted(&self, u: (f64, f64), v: (f64, f64)) -> Self {
        let along_u = Self { x: self.x.part(u.0, u.1), y: self.y.part(u.0, u.1), z: self.z.part(u.0, u.1) };
        let Self { x, y, z } = along_u.transposed();
        Self { x: x.part(v.0, v.1), y: y.part(v.0, v.1), z: z.part(v.0, v.1) }.transposed()
    }

    /// The halves `u <= 1/2` and `u >= 1/2`.
    #[inline(always)]
    pub(super) fn split_u(&self) -> [Self; 2] {
        let ([x0, x1], [y0, y1], [z0, z1]) = (self.x.halves(), self.y.halves(), self.z.halves());
        [Self { x: x0, y: y0, z: z0 }, Self { x: x1, y: y1, z: z1 }]
    }

    /// The halves `v <= 1/2` and `v >= 1/2`.
    #[inline(always)]
    pub(super) fn split_v(&self) -> [Self; 2] {
        let [a, b] = self.transposed().split_u();
        [a.transposed(), b.transposed()]
    }

    /// The same surface with the roles of u and v exchanged.
    #[inline(always)]
    fn transposed(&self) -> Self {
        Self { x: self.x.transposed(), y: self.y.transposed(), z: self.z.transposed() }
    }
}
