use crate::geometry::Tangents;
use crate::scene::{Scene, UvRect};

/// For each primitive before the last patch with a rectangle of its own, the part of texture space that it shows; empty
/// in scenes without such patches.
#[derive(Clone, Debug, Default)]
pub(super) struct TexturePlaces(Vec<UvRect>);

impl TexturePlaces {
    /// The places of the primitives of all objects, in the order of the scene.
    pub(super) fn of(scene: &Scene) -> Self {
        let mut places = Vec::new();
        let mut first = 0;
        for object in &scene.objects {
            let Some(bezier) = object.shape.surface() else {
                first += 1;
                continue;
            };
            if let Some(uv) = &bezier.uv {
                places.resize(first, UvRect::default());
                places.extend(uv.iter().take(bezier.patches.len()));
            }
            first += bezier.patches.len();
        }
        Self(places)
    }

    /// Parameters and derivatives of a primitive, with texture coordinates in place of the parameters.
    #[inline]
    pub(super) fn tangents(&self, primitive: u32, tangents: Tangents) -> Tangents {
        let Some(place) = self.0.get(primitive as usize) else { return tangents };
        let extent = place.extent();
        Tangents { uv: place.at(tangents.uv), dpdu: tangents.dpdu / extent.x, dpdv: tangents.dpdv / extent.y }
    }
}
