//! Soft selection: how far control points near the moved ones follow. Knows no widget.

/// Radius of a new falloff as a fraction of the object's extent.
const FIRST: f64 = 0.4;
/// Logarithm of the radius's ratio per screen point of scrolling.
const WHEEL: f64 = 0.002;

/// The falloff of soft selection.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Falloff {
    /// Whether control points near the moved ones follow.
    pub(crate) on: bool,
    /// The distance from which on points stay, scene units; `None` before the first drag.
    radius: Option<f64>,
}

impl Falloff {
    /// The radius for an object of this extent. A radius that does not fit the object is replaced.
    pub(crate) fn radius(&mut self, extent: f64) -> f64 {
        let fits = |radius: &f64| (0.001 * extent..=10.0 * extent).contains(radius);
        *self.radius.insert(self.radius.filter(fits).unwrap_or(FIRST * extent))
    }

    /// Changes the radius by a turn of the wheel, in screen points.
    pub(crate) fn scroll(&mut self, points: f32) {
        self.radius = self.radius.map(|radius| radius * (WHEEL * f64::from(points)).exp());
    }
}

/// The fraction of the way that a control point follows, at a distance from the nearest moved one: 1 there, 0 from `radius` on,
/// smooth between.
pub(crate) fn weight(distance: f64, radius: f64) -> f64 {
    let nearness = (1.0 - distance / radius).clamp(0.0, 1.0);
    // The cubic with zero slope at both ends. NaN, of a radius of 0, follows nothing.
    let weight = nearness * nearness * (3.0 - 2.0 * nearness);
    if weight.is_nan() { 0.0 } else { weight }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_weight_falls_smoothly_from_1_to_0() {
        assert_eq!([0.0, 1.0, 2.0, 3.0].map(|distance| weight(distance, 2.0)), [1.0, 0.5, 0.0, 0.0]);
        let slope = |at: f64| (weight(at + 1e-6, 2.0) - weight(at, 2.0)) / 1e-6;
        assert!(slope(0.0).abs() < 1e-5 && slope(2.0 - 1e-6).abs() < 1e-5, "no crease at either end");
        assert!((1..200).all(|k| weight(0.01 * f64::from(k), 2.0) < weight(0.01 * f64::from(k - 1), 2.0)));
        assert_eq!(weight(0.0, 0.0), 0.0);
    }

    #[test]
    fn the_radius_fits_the_object_and_follows_the_wheel() {
        let mut falloff = Falloff::default();
        assert_eq!(falloff.radius(4.0), 1.6);
        falloff.scroll(100.0);
        let wider = falloff.radius(4.0);
        assert!(wider > 1.9, "{wider}");
        assert_eq!(falloff.radius(5.0), wider, "kept for an object of similar size");
        assert_eq!(falloff.radius(400_000.0), 160_000.0);
    }
}
