use glam::DVec3;

/// An axis-aligned box; empty where a component of `min` exceeds the component of `max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// The corner with the smallest coordinates.
    pub min: DVec3,
    /// The corner with the largest coordinates.
    pub max: DVec3,
}

impl Aabb {
    /// The box without points, the neutral element of [`Aabb::union`].
    pub const EMPTY: Self = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// The smallest box around all points.
    pub fn around(points: impl IntoIterator<Item = DVec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, |bounds, p| Self { min: bounds.min.min(p), max: bounds.max.max(p) })
    }

    /// The smallest box around both.
    pub fn union(&self, other: &Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Whether the box has no points.
    pub fn is_empty(&self) -> bool {
        !(self.min.cmple(self.max).all())
    }

    /// The eight corners; x varies fastest.
    pub fn corners(&self) -> [DVec3; 8] {
        let [x, y, z] = [0, 1, 2].map(|axis| [self.min[axis], self.max[axis]]);
        std::array::from_fn(|k| DVec3::new(x[k & 1], y[k >> 1 & 1], z[k >> 2]))
    }

    /// The center; NaN for [`Aabb::EMPTY`].
    pub fn center(&self) -> DVec3 {
        0.5 * (self.min + self.max)
    }

    /// The edge lengths, zero for an empty box.
    pub fn size(&self) -> DVec3 {
        (self.max - self.min).max(DVec3::ZERO)
    }

    /// The length of the diagonal.
    pub fn diagonal(&self) -> f64 {
        self.size().length()
    }

    /// Half the surface area, the measure of the surface area heuristic.
    pub fn half_area(&self) -> f64 {
        let s = self.size();
        s.x * s.y + s.y * s.z + s.z * s.x
    }

    /// The distance of a point to the box; 0 inside, infinite for [`Aabb::EMPTY`].
    pub fn distance(&self, point: DVec3) -> f64 {
        (self.min - point).max(point - self.max).max(DVec3::ZERO).length()
    }

    /// The box enlarged by `margin` on every side.
    pub fn inflated(&self, margin: f64) -> Self {
        Self { min: self.min - margin, max: self.max + margin }
    }
}
