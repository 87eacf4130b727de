use super::{Bezier, Transform, UvRect};
use crate::geometry::bezier::revolved;
use glam::DVec2;
use std::sync::Arc;

/// The shape of a surface of revolution: a profile that turns around the y axis, and the patches that it sweeps. The patches
/// always belong to the profile: every change makes them again.
///
/// ```
/// use glam::DVec2;
/// use patchlight::scene::{Revolution, Transform};
///
/// let points = [(1.0, 0.0), (1.0, 0.5), (0.6, 0.8), (0.4, 1.0)].map(DVec2::from);
/// let vase = Revolution::new(Transform::default(), points.to_vec(), 360.0, false);
/// // One segment of the profile, in twelve arcs.
/// assert_eq!(vase.surface().patches.len(), 12);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Revolution {
    profile: Vec<DVec2>,
    angle: f64,
    caps: bool,
    surface: Bezier,
}

impl Revolution {
    /// The most points of a profile; they make some ten thousand patches.
    pub const MOST_POINTS: usize = 3001;

    /// The surface that `profile`, control points (r, y) of cubic segments, sweeps by `angle`, degrees, around the y axis of
    /// the object's space; `caps` closes it. A profile or an angle that is not valid sweeps no patch.
    pub fn new(transform: Transform, profile: Vec<DVec2>, angle: f64, caps: bool) -> Self {
        // Beyond the limit validation tells; patches would take the memory before that.
        let swept = if profile.len() > Self::MOST_POINTS { Vec::new() } else { revolved(&profile, angle, caps) };
        let (nets, uv) = swept.iter().map(|patch| (patch.net, UvRect { start: patch.uv[0], end: patch.uv[1] })).unzip();
        let surface = Bezier { transform, patches: Arc::new(nets), file: None, uv: Some(Arc::new(uv)) };
        Self { profile, angle, caps, surface }
    }

    /// The control points (r, y) of the profile, in object space: 3 n + 1 of n cubic segments, from one end to the other. The
    /// outside is on the right of this direction.
    pub fn profile(&self) -> &[DVec2] {
        &self.profile
    }

    /// The angle of the turn, degrees, above 0 and at most 360.
    pub fn angle(&self) -> f64 {
        self.angle
    }

    /// Whether discs close the ends of the profile, and walls the ends of a turn of less than 360 degrees.
    pub fn caps(&self) -> bool {
        self.caps
    }

    /// From the object space of the profile to the world.
    pub fn transform(&self) -> &Transform {
        &self.surface.transform
    }

    /// The transform, to change it: the patches are in object space and stay.
    pub fn transform_mut(&mut self) -> &mut Transform {
        &mut self.surface.transform
    }

    /// The surface with another profile.
    #[must_use]
    pub fn with_profile(&self, profile: Vec<DVec2>) -> Self {
        Self::new(self.surface.transform, profile, self.angle, self.caps)
    }

    /// The surface with another angle, degrees.
    #[must_use]
    pub fn with_angle(&self, angle: f64) -> Self {
        Self::new(self.surface.transform, self.profile.clone(), angle, self.caps)
    }

    /// The surface with or without caps.
    #[must_use]
    pub fn with_caps(&self, caps: bool) -> Self {
        Self::new(self.surface.transform, self.profile.clone(), self.angle, caps)
    }

    /// The patches. The control points of the profile, in the plane z = 0, are `points[0]` of the first patches: one patch for
    /// each segment.
    pub fn surface(&self) -> &Bezier {
        &self.surface
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn profile() -> Vec<DVec2> {
        [(1.0, 0.0), (1.0, 0.5), (0.6, 0.8), (0.4, 1.0)].map(DVec2::from).to_vec()
    }

    #[test]
    fn a_change_keeps_the_rest() {
        let transform = Transform { translate: DVec3::ONE, ..Transform::default() };
        let vase = Revolution::new(transform, profile(), 90.0, true);
        let narrower = vase.with_profile(profile().into_iter().map(|point| 0.5 * point).collect());
        assert_eq!((narrower.angle(), narrower.caps(), narrower.transform()), (90.0, true, &transform));
        assert_eq!(narrower.surface().patches[0].points[0][0], DVec3::new(0.5, 0.0, 0.0));
        assert_eq!(vase.with_angle(180.0).with_angle(90.0), vase);
        assert_ne!(vase.with_caps(false), vase);
    }

    #[test]
    fn every_patch_has_its_place_in_the_texture() {
        let vase = Revolution::new(Transform::default(), profile(), 100.0, true);
        let surface = vase.surface();
        assert_eq!(surface.uv.as_ref().map(|uv| uv.len()), Some(surface.patches.len()));
    }

    #[test]
    fn too_many_points_take_no_memory() {
        let points = vec![DVec2::ONE; Revolution::MOST_POINTS + 3];
        assert!(Revolution::new(Transform::default(), points, 360.0, false).surface().patches.is_empty());
    }
}
