use glam::DVec3;

/// A cubic Bezier curve by its control points.
#[derive(Clone, Copy)]
pub(super) struct Cubic(pub(super) [DVec3; 4]);

/// `(1 - t) a + t b`, exact at both ends.
#[inline]
fn mix(a: DVec3, b: DVec3, t: f64) -> DVec3 {
    (1.0 - t) * a + t * b
}

impl Cubic {
    /// The point at `t`.
    #[inline]
    pub(super) fn eval(&self, t: f64) -> DVec3 {
        self.derivatives(t)[0]
    }

    /// The point at `t`, the first and the second derivative, by de Casteljau's algorithm.
    #[inline]
    pub(super) fn derivatives(&self, t: f64) -> [DVec3; 3] {
        let [p0, p1, p2, p3] = self.0;
        let (a, b, c) = (mix(p0, p1, t), mix(p1, p2, t), mix(p2, p3, t));
        let (d, e) = (mix(a, b, t), mix(b, c, t));
        [mix(d, e, t), 3.0 * (e - d), 6.0 * ((c - b) - (b - a))]
    }

    /// The curve over `t <= 1/2` and over `t >= 1/2`.
    pub(super) fn halves(&self) -> [Self; 2] {
        let [p0, p1, p2, p3] = self.0;
        let (a, b, c) = (p0.midpoint(p1), p1.midpoint(p2), p2.midpoint(p3));
        let (d, e) = (a.midpoint(b), b.midpoint(c));
        let middle = d.midpoint(e);
        [Self([p0, a, d, middle]), Self([middle, e, c, p3])]
    }

    /// The curve over `low <= t <= high`. Each new control point is the blossom of the curve at three arguments, `low` or
    /// `high` \[Ramshaw89\].
    pub(super) fn restricted(&self, (low, high): (f64, f64)) -> Self {
        let [p0, p1, p2, p3] = self.0;
        let first_level = |t: f64| [mix(p0, p1, t), mix(p1, p2, t), mix(p2, p3, t)];
        let ([a, b, c], [d, e, f]) = (first_level(low), first_level(high));
        let (ab, bc, de, ef) = (mix(a, b, low), mix(b, c, low), mix(d, e, high), mix(e, f, high));
        Self([mix(ab, bc, low), mix(ab, bc, high), mix(de, ef, low), mix(de, ef, high)])
    }
}
