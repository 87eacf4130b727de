//! The photons that the photon passes store.

use super::photon::Photon;
use crate::math::Rgb;
use crate::transport::counters::{Counted, Counters};
use crate::transport::energy::PathEnergy;

/// Light that a caustic photon adds to the pixel that sees it.
#[derive(Clone, Copy, Debug)]
pub struct Splat {
    /// Index of the pixel, row by row from the top.
    pub pixel: u32,
    /// Radiance in the mean over the pixel, W per steradian and square scene unit.
    pub radiance: Rgb,
}

/// Photons of interreflection.
#[derive(Clone, Debug, Default)]
pub struct GlobalPhotons {
    /// Photons straight from a diffuse or glossy surface: their density is smooth.
    pub photons: Vec<Photon>,
    /// Photons that mirrors or glass sent on after a diffuse or glossy surface: indirect caustics.
    pub indirect_caustics: Vec<Photon>,
    /// Photons at Phong lobes, their flux times the MIS weight of photons: see [`GlossyMis`](crate::transport::GlossyMis).
    pub glossy: Vec<Photon>,
    /// Work done.
    pub counters: Counters,
    /// What became of the flux of the paths.
    pub energy: PathEnergy,
}

impl Counted for GlobalPhotons {
    fn counters(&self) -> Counters {
        self.counters
    }
}
