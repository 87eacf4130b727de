//! The cosine correction of photons that arrived where the surface has another normal than the point that gathers them.

use crate::math::Lanes;
use glam::Vec3;

/// The factor of a photon's flux at a gathering point: the cosine there over the cosine where the photon arrived. A photon stands for a
/// beam, and a surface with another normal would catch another fraction of it.
#[derive(Clone, Copy, Debug)]
pub(in crate::transport) struct CosineCorrection {
    /// Unit shading normal at the gathering point.
    pub(in crate::transport) normal: Vec3,
    /// Greatest factor.
    pub(in crate::transport) limit: f32,
    /// Radius of the disc over the radius of the sphere that it lies on, seen from outside; 0 on flat surfaces.
    pub(in crate::transport) curvature: f32,
}

/// Coefficients of u, u^3, u^5 and u^7 in twice [`CosineCorrection::lit_fraction`] beyond a half: the series of
/// `8 / (3 pi) * 2 integral of (1 - x^2)^(3/2)`, made to end at 1.
const LIT: [f32; 4] = [1.7126, -0.8563, 0.1284, 0.0153];

impl CosineCorrection {
    /// The factors of eight photons with these directions `wi`, which arrived with these cosines, for a point with the geometric normal
    /// `side`; 0 for photons from behind.
    #[inline(always)]
    pub(in crate::transport) fn factors<L: Lanes>(
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
        if self.curvature == 0.0 {
            return factor;
        }
        l.div(factor, self.lit_fraction(l, l.dot(wi, side)))
    }

    /// The fraction of the kernel over the disc that light from a direction with this cosine reaches on the sphere: the kernel on one
    /// side of the line where the light grazes, `cos / curvature` radii from the middle.
    #[inline(always)]
    fn lit_fraction<L: Lanes>(&self, l: L, cos: L::Vector) -> L::Vector {
        let u = l.min(l.max(l.mul(cos, l.splat(1.0 / self.curvature)), l.splat(0.0)), l.splat(1.0));
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

    /// A sphere under parallel light: the corrected photons of a disc at its pole give the irradiance of the pole.
    #[test]
    fn discs_on_a_sphere_lose_no_light() {
        let l = Portable;
        let radius: f64 = 0.3;
        let correction = CosineCorrection { normal: Vec3::Z, limit: 1e9, curvature: radius as f32 };
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
                    let factors = correction.factors(l, side, [wi.x, wi.y, wi.z].map(|x| l.splat(x)), l.splat(arrived));
                    sum += kernel * f64::from(arrived * l.store(factors)[0]);
                }
            }
            let found = sum / all / elevation.sin();
            assert!((found - 1.0).abs() < 0.02, "{found} at {elevation}");
        }
    }
}
