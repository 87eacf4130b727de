use crate::math::Rgb;
use crate::world::Scattering;
use glam::{DVec2, Vec2, Vec3};

/// A point where photons are gathered, and which the camera sees directly, in mirrors, through glass or in Phong lobes.
#[derive(Clone, Copy, Debug)]
pub struct VisiblePoint {
    /// Index of the pixel, row by row from the top of the film.
    pub pixel: u32,
    /// Where the camera path crosses the pixel, from 0 to 1 each way.
    pub in_pixel: Vec2,
    /// The surfaces on the way of the camera path, as a hash; `None` behind a Phong lobe.
    pub way: Option<u32>,
    /// Position relative to [`View::origin`](crate::world::View::origin).
    pub position: Vec3,
    /// Geometric unit normal on the seen side.
    pub n_side: Vec3,
    /// Shading unit normal on the seen side.
    pub n_shade: Vec3,
    /// Unit direction towards the previous vertex of the camera path.
    pub wo: Vec3,
    /// Throughput of the camera path for light that leaves towards `wo`.
    pub throughput: Rgb,
    /// Scattering function at the point.
    pub scattering: Scattering,
    /// Side of the pixel's footprint, scene units.
    pub footprint: f32,
    /// Distances to other objects.
    pub clearance: Clearance,
    /// Index of the primitive.
    pub primitive: u32,
    /// Parameters of the point on the primitive.
    pub uv: DVec2,
    /// First tag of the photons on the same surface and side.
    pub tag: u32,
    /// Most scattering events of a photon that counts here.
    pub photon_bounces: u32,
    /// Mean albedo over the pixel's paths that met the same surface first.
    pub mean_albedo: Rgb,
    /// Greatest distance to a point where another path of the pixel met the same surface first, scene units.
    pub spread: f32,
    /// Index of the point's first facet in the list of facets that the camera pass returns.
    pub first_facet: u32,
    /// Number of facets; 0 on surfaces without relief.
    pub facets: u32,
    /// Whether the camera path has no vertex before this one.
    pub seen_directly: bool,
    /// Whether the pixel's paths met different surfaces first.
    pub on_an_edge: bool,
    /// Distance over which the viewing lobe blurs the point, scene units; 0 without a lobe.
    pub blur: f32,
}

/// Shading normal and albedo where one camera path of a pixel met a surface first.
#[derive(Clone, Copy, Debug)]
pub struct Facet {
    /// Shading unit normal on the seen side.
    pub normal: Vec3,
    /// Diffuse albedo.
    pub albedo: Rgb,
    /// First tag of the photons on the same surface and side.
    pub tag: u32,
    /// Position relative to [`View::origin`](crate::world::View::origin).
    pub position: Vec3,
}

/// Distances from a point to other objects, scene units; infinite beyond the distances at which an object matters for density estimates.
#[derive(Clone, Copy, Debug)]
pub struct Clearance {
    /// To the nearest object; 0 on a patch, whose own curves are near.
    pub any: f64,
    /// To the nearest object that stands on the point's quad or plane, and not only along its edges; infinite where none matters.
    pub standing: f64,
}

/// The least cosine between the normals of two points that use each other's light: 2.5 degrees, over which light hardly changes.
pub(in crate::transport) const LEAST_COS_OF_NEIGHBOURS: f32 = 0.999;

impl Clearance {
    /// No object is near.
    pub(in crate::transport) const FREE: Self = Self { any: f64::INFINITY, standing: f64::INFINITY };
}
