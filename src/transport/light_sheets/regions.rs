//! Which sequences of surfaces each part of a lattice claims, and where photons still have to go.

use crate::transport::photons::Signature;
use glam::DVec2;

/// Density of photons where sheets bring the light, over that where photons bring it: for faint ways, which no sheet claims, and in case the
/// lattice missed a surface. With less, the few photons that find such light would be bright dots.
const BESIDE_SHEETS: f64 = 0.125;
/// Density of photons where a lattice was traced and found no caustics, over that where photons bring all light, in case it missed some: with
/// less, the few photons that find such light would be bright dots.
const BESIDE_LIGHT: f64 = 0.03;
/// Fraction of the photons where no lattice was traced (defensive sampling).
const DEFENSIVE: f64 = 0.03;

/// A rectangle of the unit square of a light's chart.
pub(super) struct Region {
    /// Corner and size.
    pub(super) rectangle: [DVec2; 2],
    /// The sheets that bring the light of the rectangle.
    pub(super) claims: Vec<Signature>,
    /// Share of the light that photons have to bring; more than 1 counts as 1.
    pub(super) unclaimed: f32,
    /// Whether a lattice was traced in it.
    pub(super) is_traced: bool,
}

impl Region {
    fn area(&self) -> f64 {
        self.rectangle[1].x * self.rectangle[1].y
    }

    /// Whether light of the rectangle lands anywhere.
    fn has_light(&self) -> bool {
        !self.claims.is_empty() || self.unclaimed > 0.0
    }
}

/// The rectangles of a lattice, and a density of photons over them.
#[derive(Clone, Debug, Default)]
pub(in crate::transport) struct Regions {
    rectangles: Vec<[DVec2; 2]>,
    /// Cumulative probability, one value more than rectangles, from 0 to 1.
    cumulative: Vec<f64>,
    claims: Vec<Signature>,
    /// End of the claims of each rectangle.
    claims_end: Vec<u32>,
    /// Fraction of the photons that are needed.
    photon_fraction: f64,
}

impl Regions {
    pub(super) fn new(regions: impl Iterator<Item = Region>) -> Self {
        let mut all = Self { cumulative: vec![0.0], ..Self::default() };
        let regions: Vec<Region> = regions.filter(|region| region.area() > 0.0).collect();
        let all_light: f64 = regions.iter().filter(|region| region.has_light()).map(Region::area).sum();
        let all_light = all_light.max(f64::MIN_POSITIVE);
        let density = |region: &Region| match (region.has_light(), region.is_traced) {
            (true, _) => f64::from(region.unclaimed).clamp(BESIDE_SHEETS, 1.0),
            (false, true) => BESIDE_LIGHT,
            (false, false) => DEFENSIVE * all_light,
        };
        let mut sum = 0.0;
        for region in regions {
            let density = density(&region);
            sum += region.area() * density;
            let Region { rectangle, claims, .. } = region;
            all.rectangles.push(rectangle);
            all.cumulative.push(sum);
            all.claims.extend(claims);
            all.claims_end.push(all.claims.len() as u32);
        }
        all.cumulative.iter_mut().for_each(|x| *x /= sum);
        let photon_fraction = (sum / all_light).min(1.0);
        Self { photon_fraction, ..all }
    }

    /// Fraction of the photons that are needed, of those that would bring all light.
    pub(in crate::transport) fn photon_fraction(&self) -> f64 {
        self.photon_fraction
    }

    /// Samples a point of the unit square; returns it with its density and the claims there.
    #[inline]
    pub(in crate::transport) fn sample(&self, u: DVec2) -> (DVec2, f64, &[Signature]) {
        let index = self.cumulative.partition_point(|&c| c <= u.x).clamp(1, self.rectangles.len()) - 1;
        let probability = self.cumulative[index + 1] - self.cumulative[index];
        let x = ((u.x - self.cumulative[index]) / probability).clamp(0.0, 1.0);
        let [min, size] = self.rectangles[index];
        let start = if index == 0 { 0 } else { self.claims_end[index - 1] as usize };
        let claims = &self.claims[start..self.claims_end[index] as usize];
        (min + size * DVec2::new(x, u.y), probability / (size.x * size.y), claims)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Sampler, Stream};

    #[test]
    fn photons_go_where_light_is_left() {
        let claimed = Signature::default().reflected(1);
        let region = |x: f64, claims: &[Signature], unclaimed: f32, is_traced: bool| Region {
            rectangle: [DVec2::new(x, 0.0), DVec2::new(0.2, 1.0)],
            claims: claims.to_vec(),
            unclaimed,
            is_traced,
        };
        let all = [
            region(0.0, &[claimed], 0.0, true),
            region(0.2, &[], 0.0, false),
            region(0.4, &[], 0.0, true),
            region(0.6, &[], 1.7, true),
            region(0.8, &[claimed], 0.5, true),
        ];
        let regions = Regions::new(all.into_iter());
        let n = 4096;
        let mut counts = [0; 5];
        let mut area = 0.0;
        for k in 0..n {
            let (square, density, claims) = regions.sample(Sampler::new(1, Stream::CausticPhoton, 0, k).next_2d());
            let column = (5.0 * square.x) as usize;
            counts[column] += 1;
            area += 1.0 / density;
            let expected = if column.is_multiple_of(4) { vec![claimed] } else { Vec::new() };
            assert_eq!(claims, expected, "{square}");
        }
        assert!((area / n as f64 - 1.0).abs() < 0.01, "densities are those of the samples: {area}");
        let densities = [BESIDE_SHEETS, DEFENSIVE * 0.6, BESIDE_LIGHT, 1.0, 0.5];
        let sum: f64 = densities.iter().sum();
        for (count, density) in counts.into_iter().zip(densities) {
            assert!((f64::from(count) - density / sum * n as f64).abs() < 3.0, "{counts:?}");
        }
        let fraction = sum * 0.2 / 0.6;
        assert!((regions.photon_fraction() - fraction).abs() < 1e-9);
    }
}
