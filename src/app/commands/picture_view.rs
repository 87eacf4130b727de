//! What the canvas shows of the scene.

use crate::transport::Component;

/// What the canvas shows of the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum PictureView {
    /// All light, or one component of it.
    #[default]
    Light,
    /// The irradiance of matte surfaces, in false colours.
    Irradiance,
    /// The estimated error of each pixel, in false colours.
    Error,
    /// The distance of what the camera sees, in false colours.
    Distance,
    /// The albedo of surfaces.
    Albedo,
    /// The shading normals of surfaces.
    Normals,
}

impl PictureView {
    /// All views, in the order of the menu.
    pub(crate) const ALL: [Self; 6] =
        [Self::Light, Self::Irradiance, Self::Error, Self::Distance, Self::Albedo, Self::Normals];

    /// The label in menus.
    pub(crate) fn label(self) -> &'static str {
        match self {
            Self::Light => "Light",
            Self::Irradiance => "Irradiance, W/m²",
            Self::Error => "Estimated error",
            Self::Distance => "Distance from the camera",
            Self::Albedo => "Albedo",
            Self::Normals => "Normals",
        }
    }

    /// What the view shows, for its tooltip.
    pub(crate) fn tip(self) -> &'static str {
        match self {
            Self::Light => "The picture",
            Self::Irradiance => {
                "Flux on each area of a matte surface: pi times radiance over albedo, the mean over red, green and blue. \
                 Mirrors, glass, glossy surfaces and edges have no number."
            }
            Self::Error => {
                "Standard deviation of the noise over the radiance, by the difference between the first and the later iterations, \
                 over 5 x 5 pixels. The bias of density estimates is not in it."
            }
            Self::Distance => "Length of the camera ray to the surface, scene units",
            Self::Albedo => "The diffuse reflectance, without light",
            Self::Normals => "x, y and z of the shading normal as red, green and blue, from -1 to 1",
        }
    }
}

/// The components of light of the menu, with their labels; `None` is all light.
pub(crate) const COMPONENTS: [(Option<Component>, &str); 4] = [
    (None, "All light"),
    (Some(Component::Direct), "Direct light alone"),
    (Some(Component::Caustics), "Caustics alone"),
    (Some(Component::Interreflection), "Interreflection alone"),
];
