use super::UvRect;
use crate::geometry::bezier::{ControlNet, Patch};
use glam::{DAffine3, DMat3, DVec3};
use std::sync::Arc;

/// The shape of a Bezier object: bicubic patches with one transform.
#[derive(Clone, Debug, PartialEq)]
pub struct Bezier {
    /// From the object space of the patches to the world.
    pub transform: Transform,
    /// The control nets in object space; reference-counted, so that a clone does not copy them.
    pub patches: Arc<Vec<ControlNet>>,
    /// The `.bpt` file with exactly these patches, relative to the scene file; `None` if the scene file holds them.
    pub file: Option<String>,
    /// For each patch, the part of texture space that it shows; `None` if each shows the whole texture.
    pub uv: Option<Arc<Vec<UvRect>>>,
}

impl Bezier {
    /// The patches in world space. A transform that mirrors the surface keeps its outside.
    pub fn placed_patches(&self) -> impl Iterator<Item = Patch> {
        let is_mirrored = self.transform.is_mirroring();
        self.placed_nets().into_iter().map(move |net| Patch::new(net).mirrored(is_mirrored))
    }

    /// The control nets in world space.
    pub fn placed_nets(&self) -> Vec<ControlNet> {
        let world_from_object = self.transform.world_from_object();
        self.patches.iter().map(|net| net.transformed(&world_from_object)).collect()
    }
}

/// A transform: scale, then rotate about x, y and z in turn, then translate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// Translation, scene units.
    pub translate: DVec3,
    /// Rotation about x, y and z, degrees.
    pub rotate: DVec3,
    /// Factors along x, y and z; not 0.
    pub scale: DVec3,
}

impl Default for Transform {
    fn default() -> Self {
        Self { translate: DVec3::ZERO, rotate: DVec3::ZERO, scale: DVec3::ONE }
    }
}

impl Transform {
    /// Whether it mirrors: an odd number of factors is negative.
    pub fn is_mirroring(&self) -> bool {
        self.scale.to_array().iter().filter(|factor| **factor < 0.0).count() % 2 == 1
    }

    /// The affine map from object space to world space.
    pub fn world_from_object(&self) -> DAffine3 {
        let [x, y, z] = self.rotate.to_array().map(f64::to_radians);
        let rotation = DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x);
        DAffine3 { matrix3: rotation * DMat3::from_diagonal(self.scale), translation: self.translate }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_then_rotates_about_x_then_y_then_z_then_translates() {
        let transform = Transform {
            translate: DVec3::new(10.0, 20.0, 30.0),
            rotate: DVec3::splat(90.0),
            scale: DVec3::new(2.0, 3.0, 4.0),
        };
        // (1, 1, 1) scaled is (2, 3, 4); about x (2, -4, 3); about y (3, -4, -2); about z (4, 3, -2).
        let moved = transform.world_from_object().transform_point3(DVec3::ONE);
        // Sines of 90 degrees and sums of size 30 are off by a few ulp.
        assert!(moved.distance(DVec3::new(14.0, 23.0, 28.0)) < 1e-13, "{moved}");
    }
}
