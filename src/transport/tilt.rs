//! Photons that arrived where the surface looks another way than where they are gathered.

use crate::math::Lanes;
use glam::Vec3;

/// How a photon counts for a point: the flux that it brought is that of a beam, of which the surface at the point would
/// have caught more or less.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tilt {
    /// Unit normal that reflects the light at the point.
    pub(super) normal: Vec3,
    /// No photon counts more often than this.
    pub(super) limit: f32,
    /// Radius of the disc over the radius of a sphere that it lies on, seen from outside; 0 where it is flat.
    pub(super) bend: f32,
}

/// Coefficients of u, u^3, u^5 and u^7 in [`Tilt::lit_part`], twice its part beyond a half: the series of
/// `8 / (3 pi) * 2 integral of (1 - x^2)^(3/2)`, made to end at 1.
const LIT: [f32; 4] = [1.7126, -0.8563, 0.1284, 0.0153];

impl Tilt {
    /// The factors of eight photons, by the directions towards where they came from and the cosines of these where they
    /// arrived, for a point with this geometric normal; 0 for those that came from behind.
    #[inline(always)]
    pub(super) fn factors<L: Lanes>(
        &self,
        l: L,
        side: [L::Vector; 3],
        wi: [L::Vector; 3],
        arrived: L::Vector,
    ) -> L::Vector {
        let normal = [self.normal.x, self.normal.y, self.normal.z].map(
            #[inline(always)]
            |x| l.splat(x),
        );
        let cos = l.max(l.dot(wi, normal), l.splat(0.0));
        let factor = l.min(l.div(cos, arrived), l.splat(self.limit));
        if self.bend == 0.0 {
            return factor;
        }
        l.div(factor, self.lit_part(l, l.dot(wi, side)))
    }

    /// The part of the kernel over the disc that light from a direction with this cosine reaches on the sphere, up to
    /// where it grazes: the kernel's part on one side of a line at the distance `cos / bend` radii from its middle.
    #[inline(always)]
    fn lit_part<L: Lanes>(&self, l: L, cos: L::Vector) -> L::Vector {
        let u = l.min(l.max(l.mul(cos, l.splat(1.0 / self.bend)), l.splat(0.0)), l.splat(1.0));
        let u2 = l.mul(u, u);
        let [c1, c3, c5, c7] = LIT.map(
            #[inline(always)]
            |c| l.splat(0.5 * c),
        );
        let series = l.mul_add(u2, l.mul_add(u2, l.mul_add(u2, c7, c5), c3), c1);
        l.mul_add(u, series, l.splat(0.5))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::lanes::Portable;

    /// A sphere in even light: what photons bring to a disc at its pole, each counted as tilted, is what falls on the pole.
    #[test]
    fn bent_discs_lose_no_light() {
        let l = Portable;
        let radius: f64 = 0.3;
        let tilt = Tilt { normal: Vec3::Z, limit: 1e9, bend: radius as f32 };
        let side = [0.0, 0.0, 1.0].map(|x| l.splat(x));
        for elevation in [0.02, 0.1, 0.2, 0.3, 0.6, 1.2f64] {
            let wi = Vec3::new(elevation.cos() as f32, 0.0, elevation.sin() as f32);
            let n = 600;
            let (mut sum, mut all) = (0.0, 0.0);
            for k in 0..n * n {
                let at = |k: i32| radius * (f64::from(2 * k + 1) / f64::from(n) - 1.0);
                let (x, y) = (at(k % n), at(k / n));
                let kernel = (1.0 - (x * x + y * y) / (radius * radius)).max(0.0);
                // Chords of this length lead to a height of half their square below the pole.
                let height = 1.0 - 0.5 * (x * x + y * y);
                let scale = ((1.0 - height * height) / (x * x + y * y)).sqrt();
                let arrived = (Vec3::new((scale * x) as f32, (scale * y) as f32, height as f32)).dot(wi);
                all += kernel;
                if arrived > 0.0 {
                    let factors = tilt.factors(l, side, [wi.x, wi.y, wi.z].map(|x| l.splat(x)), l.splat(arrived));
                    sum += kernel * f64::from(arrived * l.store(factors)[0]);
                }
            }
            let found = sum / all / elevation.sin();
            assert!((found - 1.0).abs() < 0.02, "{found} at {elevation}");
        }
    }
}
