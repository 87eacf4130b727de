//! The photon maps of an iteration, one for each kind of light that differs in how sharp it is.

use super::photon_map::PhotonMap;

/// The maps of an iteration.
#[derive(Clone, Debug, Default)]
pub struct Maps {
    /// Photons that only mirrors and glass have touched.
    pub caustic: PhotonMap,
    /// Photons that came from surfaces that scatter in many directions.
    pub global: PhotonMap,
    /// Photons that mirrors or glass sent on after they were scattered.
    pub focused: PhotonMap,
    /// Photons that were scattered once, with what Phong lobes take from them: see [`LobeLight`](super::LobeLight).
    pub glossy: PhotonMap,
}

impl std::ops::Index<MapKind> for Maps {
    type Output = PhotonMap;

    fn index(&self, kind: MapKind) -> &PhotonMap {
        match kind {
            MapKind::Caustic => &self.caustic,
            MapKind::Global => &self.global,
            MapKind::Focused => &self.focused,
            MapKind::Glossy => &self.glossy,
        }
    }
}

/// Which of the [`Maps`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapKind {
    /// Of caustics.
    Caustic,
    /// Of interreflection.
    Global,
    /// Of interreflection that was focused.
    Focused,
    /// Of interreflection in Phong lobes.
    Glossy,
}

impl MapKind {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Caustic, Self::Global, Self::Focused, Self::Glossy];
}

/// Something for each of the [`Maps`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PerMap<T>([T; 4]);

impl<T> PerMap<T> {
    /// What the function says of each.
    pub fn from_fn(of: impl FnMut(MapKind) -> T) -> Self {
        Self(MapKind::ALL.map(of))
    }

    /// The same, on all threads.
    pub(super) fn in_parallel(of: &(impl Fn(MapKind) -> T + Sync)) -> Self
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
