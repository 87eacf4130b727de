use crate::math::{Rgb, octahedral};
use glam::{DVec2, Vec3};

/// Light that arrived at a point of a surface.
#[derive(Clone, Copy, Debug)]
pub struct Photon {
    /// Relative to the middle of the world, which keeps 24 bits of precision inside the scene.
    pub position: Vec3,
    /// W.
    pub flux: Rgb,
    /// Towards where it came from.
    pub wi: PackedDirection,
    /// Surface, side and scattering events so far: see [`tag`].
    pub tag: u32,
}

/// Scattering events that a tag can tell apart.
pub(super) const MAX_TAG_BOUNCES: u32 = 255;

/// A number that orders photons first by surface and side, then by their scattering events since the light.
pub(super) fn tag(object: u32, front: bool, bounces: u32) -> u32 {
    (object << 1 | u32::from(front)) << 8 | bounces.min(MAX_TAG_BOUNCES)
}

/// A unit vector in 32 bits, within 1e-4 radians.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PackedDirection(u32);

impl PackedDirection {
    /// Rounds a unit vector.
    pub fn pack(direction: Vec3) -> Self {
        let square = octahedral::square_from_direction(direction.as_dvec3());
        let bits = |x: f64| (x * 65535.0 + 0.5) as u32;
        Self(bits(square.x) << 16 | bits(square.y))
    }

    /// The unit vector.
    pub fn unpack(self) -> Vec3 {
        let square = DVec2::new(f64::from(self.0 >> 16), f64::from(self.0 & 0xffff)) / 65535.0;
        octahedral::direction_from_square(square).as_vec3()
    }

    pub(super) fn bits(self) -> u32 {
        self.0
    }

    pub(super) fn from_bits(bits: u32) -> Self {
        Self(bits)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Sampler, Stream, warp};

    #[test]
    fn directions_survive_packing() {
        for k in 0..1000 {
            let d = warp::uniform_sphere(Sampler::new(0, Stream::Test, 1, k).next_2d()).as_vec3();
            assert!(PackedDirection::pack(d).unpack().distance(d) < 1e-4, "{d}");
        }
    }
}
