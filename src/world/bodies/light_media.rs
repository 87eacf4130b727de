use super::{Media, Surroundings};
use glam::DVec3;

/// The media in which the paths of a light begin.
#[derive(Clone, Debug, PartialEq)]
pub enum LightMedia {
    /// The same bodies surround every point of the light.
    Uniform(Media),
    /// Different bodies surround different points of the light.
    Mixed,
}

impl LightMedia {
    /// The media of a light with these points; air for a light without points.
    pub(in crate::world) fn at(points: impl IntoIterator<Item = DVec3>, around: &Surroundings<'_>) -> Self {
        let mut points = points.into_iter();
        let first = points.next().map_or(Media::default(), |point| around.media(point));
        if points.all(|point| around.media(point) == first) { Self::Uniform(first) } else { Self::Mixed }
    }
}
