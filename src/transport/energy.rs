//! Energy balance of the photon paths: the flux that lights emit is the flux that ends somewhere.

use crate::math::Rgb;
use crate::transport::points::Continuation;
use crate::world::Lobe;
use serde::{Deserialize, Serialize};
use std::iter::Sum;
use std::ops::AddAssign;

/// The energy balances of the components that photons bring.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Energy {
    /// Paths of the caustic photon pass.
    pub caustics: PathEnergy,
    /// Paths of the photon pass of interreflection.
    pub interreflection: PathEnergy,
    /// The iteration with the worst balance of the caustic photon pass.
    pub worst_of_caustics: WorstBalance,
    /// The iteration with the worst balance of the photon pass of interreflection.
    pub worst_of_interreflection: WorstBalance,
}

/// The worst balance of a component in any single iteration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct WorstBalance {
    /// The greatest absolute value of the component's balances.
    pub balance: f64,
    /// The number of its iteration in the run; 0 before the first.
    pub iteration: u64,
}

impl WorstBalance {
    fn of_iteration(iteration: u64, energy: &PathEnergy) -> Self {
        Self { balance: energy.path_balance().abs().max(energy.photon_balance().abs()), iteration }
    }

    fn worse(self, other: Self) -> Self {
        if other.balance > self.balance || self.iteration == 0 { other } else { self }
    }
}

impl Energy {
    /// The energy of the iteration with this number in the run.
    pub(crate) fn of_iteration(iteration: u64, caustics: PathEnergy, interreflection: PathEnergy) -> Self {
        Self {
            caustics,
            interreflection,
            worst_of_caustics: WorstBalance::of_iteration(iteration, &caustics),
            worst_of_interreflection: WorstBalance::of_iteration(iteration, &interreflection),
        }
    }
}

/// What becomes of the flux of the photon paths of a component: sums over the paths and over the three channels, W. Each entry is computed
/// from the flux that arrives at an event and from the numbers of the material, not from the flux with which the path goes on, so a fault in
/// that flux unsettles the balance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PathEnergy {
    /// Flux with which the paths leave the lights.
    pub emitted: f64,
    /// Absorbed at surfaces.
    pub absorbed: f64,
    /// Absorbed in media, on the way between surfaces.
    pub absorbed_in_media: f64,
    /// Left the scene: no surface is in the way.
    pub escaped: f64,
    /// Arrived at a light.
    pub met_light: f64,
    /// Caustics: scattered by the first surface of its path, which is light of other components.
    pub other_components: f64,
    /// Caustics: scattered by a later surface, where the path ends.
    pub scattered: f64,
    /// Cut off where a path has `max_bounces` events.
    pub cut_off: f64,
    /// Flux of the paths that Russian roulette and the choice of one direction end, less the flux that surviving paths gain. Its
    /// expectation is 0.
    pub roulette: f64,
    /// The greatest albedo of Phong lobes, less the albedo in the sampled directions.
    pub phong_lobes: f64,
    /// Lost by the shading factor of normal and height maps; negative where they gain.
    pub shading_normals: f64,
    /// Flux that arrived where the component leaves photons.
    pub arrived: f64,
    /// The part of `arrived` that camera paths bring: direct light, and the MIS weight of camera paths at Phong lobes.
    pub camera_paths: f64,
    /// The part of `arrived` that is stored for the camera, in a map, on the film or in light sheets.
    pub stored: f64,
    /// Caustics: the part of `stored` that light sheets bring.
    pub sheets: f64,
}

impl PathEnergy {
    /// Emitted flux less the flux of all ends of paths, over the emitted flux: 0 up to rounding.
    pub fn path_balance(&self) -> f64 {
        let surfaces = self.absorbed + self.other_components + self.scattered + self.phong_lobes + self.shading_normals;
        let ends = self.absorbed_in_media + self.escaped + self.met_light + self.cut_off + self.roulette;
        relative(self.emitted - (surfaces + ends), self.emitted)
    }

    /// Flux that arrived less the flux that camera paths bring or that is stored, over the flux that arrived: 0 up to rounding.
    pub fn photon_balance(&self) -> f64 {
        relative(self.arrived - self.camera_paths - self.stored, self.arrived)
    }

    /// A path arrives with this flux through media of this transmittance.
    #[inline]
    pub(super) fn absorb_in_media(&mut self, flux: Rgb, transmittance: Rgb) {
        if transmittance != Rgb::ONE {
            self.absorbed_in_media += power(flux * (Rgb::ONE - transmittance));
        }
    }

    /// Divides the power that arrives at a surface: what the surface does not reflect is absorbed, and Russian roulette exchanges the reflected
    /// power for the power of the path that goes on, 0 where the path ends.
    #[inline]
    pub(super) fn reflect(&mut self, arrived: f64, reflected: f64, survivor: f64) {
        self.absorbed += arrived - reflected;
        self.roulette += reflected - survivor;
    }

    /// A branch of a path leaves a mirror or glass that this flux meets: absorbs by the tint of glass, and exchanges power by Russian roulette,
    /// which the branch survives with this probability.
    pub(super) fn branch(&mut self, flux: Rgb, next: &Continuation, lobe: &Lobe, survival: Option<f32>) {
        let tint = next.material_tint(lobe);
        if matches!(lobe, Lobe::Glass { .. }) && tint != Rgb::ONE {
            self.absorbed += next.fraction * power(flux * (Rgb::ONE - tint));
        }
        if survival != Some(1.0) {
            let gain = survival.map_or(0.0, |survival| 1.0 / f64::from(survival));
            self.roulette += (1.0 - gain) * next.fraction * power(flux * tint);
        }
    }
}

/// The greatest albedo of a lobe; of glass, which divides all light between two directions, without its tint.
#[inline]
pub(super) fn lobe_albedo(lobe: &Lobe) -> Rgb {
    match *lobe {
        Lobe::None => Rgb::ZERO,
        Lobe::Phong { specular, .. } => specular,
        Lobe::Mirror { reflectance } => reflectance,
        Lobe::Glass { .. } => Rgb::ONE,
    }
}

/// The sum of the channels. Its rounding, as that of the flux, is below 1e-7, and less in the sum over many paths.
#[inline]
pub(super) fn power(flux: Rgb) -> f64 {
    f64::from(flux.element_sum())
}

fn relative(difference: f64, whole: f64) -> f64 {
    if whole == 0.0 { difference } else { difference / whole }
}

impl Sum for PathEnergy {
    fn sum<I: Iterator<Item = Self>>(energies: I) -> Self {
        energies.fold(Self::default(), |mut sum, energy| {
            sum += energy;
            sum
        })
    }
}

impl AddAssign for PathEnergy {
    fn add_assign(&mut self, other: Self) {
        self.emitted += other.emitted;
        self.absorbed += other.absorbed;
        self.absorbed_in_media += other.absorbed_in_media;
        self.escaped += other.escaped;
        self.met_light += other.met_light;
        self.other_components += other.other_components;
        self.scattered += other.scattered;
        self.cut_off += other.cut_off;
        self.roulette += other.roulette;
        self.phong_lobes += other.phong_lobes;
        self.shading_normals += other.shading_normals;
        self.arrived += other.arrived;
        self.camera_paths += other.camera_paths;
        self.stored += other.stored;
        self.sheets += other.sheets;
    }
}

impl AddAssign for Energy {
    fn add_assign(&mut self, other: Self) {
        self.worst_of_caustics = self.worst_of_caustics.worse(other.worst_of_caustics);
        self.worst_of_interreflection = self.worst_of_interreflection.worse(other.worst_of_interreflection);
        self.caustics += other.caustics;
        self.interreflection += other.interreflection;
    }
}
