//! The photon maps of an iteration: light of different sharpness needs different radii, so each kind has a map of its own.

use super::photon::Photon;
use super::photon_map::PhotonMap;
use crate::transport::counters::{Counted, Counters};
use serde::{Deserialize, Serialize};

/// The photon maps of an iteration.
#[derive(Clone, Debug, Default)]
pub struct Maps {
    /// Caustics: photons that only mirrors and glass have touched.
    pub caustic: PhotonMap,
    /// Interreflection: photons straight from a diffuse or glossy surface.
    pub global: PhotonMap,
    /// Indirect caustics: photons that mirrors or glass sent on after a diffuse or glossy surface.
    pub indirect_caustic: PhotonMap,
    /// Photons at Phong lobes, scattered once before, with the MIS weight of photons: see [`GlossyMis`](super::super::GlossyMis).
    pub glossy: PhotonMap,
}

impl Maps {
    /// Builds the maps of an iteration from its photons, the second argument in the order global, indirect caustic, glossy. The global map,
    /// the largest, is built in parallel to the other three.
    pub fn build(caustic: &[Photon], [global, indirect_caustic, glossy]: [&[Photon]; 3]) -> Self {
        let small = [caustic, indirect_caustic, glossy];
        let (global, [caustic, indirect_caustic, glossy]) =
            rayon::join(|| PhotonMap::build(global), || small.map(PhotonMap::build));
        Self { caustic, global, indirect_caustic, glossy }
    }
}

/// Counts the maps that hold photons.
impl Counted for Maps {
    fn counters(&self) -> Counters {
        let built = MapKind::ALL.into_iter().filter(|kind| !self[*kind].is_empty()).count();
        Counters { map_builds: built as u64, ..Counters::default() }
    }
}

impl std::ops::Index<MapKind> for Maps {
    type Output = PhotonMap;

    fn index(&self, kind: MapKind) -> &PhotonMap {
        match kind {
            MapKind::Caustic => &self.caustic,
            MapKind::Global => &self.global,
            MapKind::IndirectCaustic => &self.indirect_caustic,
            MapKind::Glossy => &self.glossy,
        }
    }
}

/// Names one of the [`Maps`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapKind {
    /// [`Maps::caustic`].
    Caustic,
    /// [`Maps::global`].
    Global,
    /// [`Maps::indirect_caustic`].
    IndirectCaustic,
    /// [`Maps::glossy`].
    Glossy,
}

impl MapKind {
    /// All maps.
    pub const ALL: [Self; 4] = [Self::Caustic, Self::Global, Self::IndirectCaustic, Self::Glossy];
}

/// One value for each of the [`Maps`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PerMap<T>([T; 4]);

impl<T> PerMap<T> {
    /// The value of a function for each map.
    pub fn from_fn(of: impl FnMut(MapKind) -> T) -> Self {
        Self(MapKind::ALL.map(of))
    }

    /// The values of a function, computed on all threads.
    pub(in crate::transport) fn in_parallel(of: &(impl Fn(MapKind) -> T + Sync)) -> Self
    where
        T: Send,
    {
        let [a, b, c, d] = MapKind::ALL.map(|kind| move || of(kind));
        let ((a, b), (c, d)) = rayon::join(|| rayon::join(a, b), || rayon::join(c, d));
        Self([a, b, c, d])
    }
}

impl<T> std::ops::Index<MapKind> for PerMap<T> {
    type Output = T;

    fn index(&self, kind: MapKind) -> &T {
        &self.0[kind as usize]
    }
}

impl<T> std::ops::IndexMut<MapKind> for PerMap<T> {
    fn index_mut(&mut self, kind: MapKind) -> &mut T {
        &mut self.0[kind as usize]
    }
}
