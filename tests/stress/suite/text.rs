#[path = "../../shared/scene_text.rs"]
mod scene_text;
#[path = "../../shared/solids.rs"]
mod solids;

pub(crate) use scene_text::{HEAD, lamp, object, quad, sphere};
pub(crate) use solids::{box_of, dented_cube};

/// A camera with a square film.
pub(crate) fn camera(position: [f64; 3], target: [f64; 3], fov_y: f64, pixels: u32) -> String {
    format!(
        "[camera]\nposition = {position:?}\ntarget = {target:?}\nup = [0.1, 0.9, 0.2]\nfov_y = {fov_y:?}
        [film]\nwidth = {pixels}\nheight = {pixels}\n"
    )
}

/// The limit of bounces and the radiance of the background.
pub(crate) fn render_limits(max_bounces: u32, background: f64) -> String {
    format!("[render]\nmax_bounces = {max_bounces}\nbackground = {:?}\n", [background; 3])
}

/// A material; `rest` holds the lines of its model.
pub(crate) fn material(name: &str, model: &str, rest: &str) -> String {
    format!("[[material]]\nname = \"{name}\"\ntype = \"{model}\"\n{rest}\n")
}

/// A diffuse material.
pub(crate) fn diffuse(name: &str, albedo: f64) -> String {
    material(name, "diffuse", &format!("albedo = {:?}", [albedo; 3]))
}

/// A mirror.
pub(crate) fn mirror(name: &str, reflectance: f64) -> String {
    material(name, "mirror", &format!("reflectance = {:?}", [reflectance; 3]))
}

/// A material of glass.
pub(crate) fn glass(name: &str, ior: f64, absorption: f64) -> String {
    material(name, "glass", &format!("ior = {ior:?}\nabsorption = {:?}", [absorption; 3]))
}

/// A light; `rest` holds the lines of its shape and strength.
pub(crate) fn light(name: &str, emitter: &str, rest: &str) -> String {
    format!("[[light]]\nname = \"{name}\"\ntype = \"{emitter}\"\n{rest}\n")
}

/// A point light.
pub(crate) fn point_light(position: [f64; 3], intensity: f64) -> String {
    light("lamp", "point", &format!("position = {position:?}\nintensity = {:?}", [intensity; 3]))
}

/// A spherical light.
pub(crate) fn sphere_light(center: [f64; 3], radius: f64, radiance: f64) -> String {
    light("lamp", "sphere", &format!("center = {center:?}\nradius = {radius:?}\nradiance = {:?}", [radiance; 3]))
}

/// A quad that shines to the side of `edge_u x edge_v`.
pub(crate) fn quad_light([corner, edge_u, edge_v]: [[f64; 3]; 3], radiance: f64) -> String {
    let edges = format!("corner = {corner:?}\nedge_u = {edge_u:?}\nedge_v = {edge_v:?}");
    light("lamp", "quad", &format!("{edges}\nradiance = {:?}", [radiance; 3]))
}

/// A ball of eight Bezier patches with outward normals, which is round within 3e-4 of its radius.
pub(crate) fn patch_ball(name: &str, center: [f64; 3], radius: f64, material: &str, transform: &str) -> String {
    let nets = ball_nets(center, radius);
    object(name, "bezier", material, &format!("{transform}patches = {nets:?}"))
}

/// The control nets of [`patch_ball`]: each octant turns a quarter circle about the y axis; one edge is the pole.
pub(crate) fn ball_nets(center: [f64; 3], radius: f64) -> Vec<[[[f64; 3]; 4]; 4]> {
    /// The control points of a cubic that is nearest to a quarter circle.
    const K: f64 = 0.552_284_749_830_793_4;
    let arc = [[1.0, 0.0], [1.0, K], [K, 1.0], [0.0, 1.0]];
    let octant = |k: usize| -> [[[f64; 3]; 4]; 4] {
        let quarter = k / 2;
        let up = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        let point = |i: usize, j: usize| {
            // Along v around the axis; the lower half runs backwards, so that its normal stays outward.
            let [c, s] = arc[if up > 0.0 { j } else { 3 - j }];
            let [ring, height] = arc[i];
            let (x, z) = (ring * c, ring * s);
            let (x, z) = [(x, z), (-z, x), (-x, -z), (z, -x)][quarter];
            [center[0] + radius * x, center[1] + radius * up * height, center[2] + radius * z]
        };
        std::array::from_fn(|i| std::array::from_fn(|j| point(i, j)))
    };
    (0..8).map(octant).collect()
}
