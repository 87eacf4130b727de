//! Density estimates over a disc: `sum of flux K / integral of K`, with the kernel `K` of the disc.

use super::bandwidth::WIDER;
use super::disc::Disc;
use crate::math::{Lanes, Rgb};
use crate::transport::photons::PhotonMap;
use crate::transport::photons::photon_map::Stack;
use crate::transport::points::{Facet, VisiblePoint, bsdf};
use crate::world::{Lobe, Scattering};

/// Greatest distance between the points where a pixel's paths meet a surface, in radii of the disc, for one estimate to serve all of
/// them: the disc blurs more than the light changes over that distance, and the limit shrinks with the disc.
const MAX_SPREAD: f64 = 0.5;

/// Irradiance at a point, W per square scene unit.
#[inline(always)]
pub(in crate::transport) fn irradiance<L: Lanes>(
    l: L,
    map: &PhotonMap,
    stack: &mut Stack,
    point: &VisiblePoint,
    disc: &Disc,
) -> Rgb {
    let Disc { query, correction, integral, .. } = disc;
    let sum = if disc.visible.is_some() {
        let mut sum = Rgb::ZERO;
        map.for_each(l, query, correction, stack, |weight, photon| {
            sum += if disc.sees(&photon) { weight * photon.flux } else { Rgb::ZERO };
        });
        sum
    } else if correction.curvature > 0.0 || correction.normal != point.n_side {
        map.sum_corrected_flux(l, query, correction, stack)
    } else {
        map.sum_flux(l, query, stack)
    };
    sum / *integral as f32
}

/// Mean radiance that the facets of a point reflect by Lambert's law.
#[inline(always)]
pub(in crate::transport) fn faceted_radiance<L: Lanes>(
    l: L,
    map: &PhotonMap,
    stack: &mut Stack,
    facets: &[Facet],
    disc: &Disc,
) -> Rgb {
    let sum = map.sum_faceted_flux(l, &disc.query, &disc.correction, facets, stack);
    sum * std::f32::consts::FRAC_1_PI / (facets.len() as f32 * disc.integral as f32)
}

/// Radiance that a point reflects with its Phong lobe and with this diffuse scattering function (per steradian).
#[inline(always)]
pub(in crate::transport) fn glossy_radiance<L: Lanes>(
    l: L,
    map: &PhotonMap,
    stack: &mut Stack,
    point: &VisiblePoint,
    disc: &Disc,
    diffuse: Rgb,
) -> Rgb {
    let Some(lobe) = bsdf::GlossyLobe::new(&point.scattering, point.n_shade, point.wo) else { return Rgb::ZERO };
    let mut sum = Rgb::ZERO;
    map.for_each(l, &disc.query, &disc.correction, stack, |weight, photon| {
        if disc.sees(&photon) {
            sum += weight * photon.flux * (diffuse + lobe.eval(photon.wi));
        }
    });
    sum / disc.integral as f32
}

/// Shot noise of a bandwidth difference: its variance for independent photons, summed over channels, for an estimate `light` in this
/// disc.
#[inline(always)]
pub(in crate::transport) fn shot_noise<L: Lanes>(
    l: L,
    map: &PhotonMap,
    stack: &mut Stack,
    light: Rgb,
    disc: &Disc,
) -> f32 {
    let sum = map.sum_flux(l, &disc.query, stack).element_sum();
    // All channels have the same photons, so their deviations add up.
    let squares = map.sum_squares(l, &disc.query, stack);
    let deviation: f32 = squares.to_array().map(f32::sqrt).iter().sum();
    let relative = if sum > 0.0 { deviation / sum } else { 0.0 };
    ((1.0 - 1.0 / WIDER.powi(2)) as f32 * relative * light.element_sum()).powi(2)
}

/// The diffuse scattering function, per steradian, for the irradiance at a point: the mean over the pixel where one estimate serves
/// the whole pixel. With facets it does not, because each has another normal.
#[inline]
pub(in crate::transport) fn diffuse_scattering(point: &VisiblePoint, radius: f64) -> Rgb {
    let mean = Scattering { albedo: point.mean_albedo, ..point.scattering };
    let serves_pixel = point.facets == 0 && covers_pixel(point, radius);
    bsdf::eval_diffuse(if serves_pixel { &mean } else { &point.scattering })
}

/// Whether one estimate in a disc of this radius serves all points where the pixel's paths met the surface.
#[inline]
pub(in crate::transport) fn covers_pixel(point: &VisiblePoint, radius: f64) -> bool {
    f64::from(point.spread) <= MAX_SPREAD * radius
}

/// Whether the pixel shows any diffuse reflection at the point.
#[inline]
pub(in crate::transport) fn is_diffuse(point: &VisiblePoint) -> bool {
    point.scattering.albedo != Rgb::ZERO || point.mean_albedo != Rgb::ZERO
}

/// Whether the point has a Phong lobe.
#[inline]
pub(in crate::transport) fn is_glossy(point: &VisiblePoint) -> bool {
    matches!(point.scattering.lobe, Lobe::Phong { .. })
}
