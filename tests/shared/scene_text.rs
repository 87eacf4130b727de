//! Texts of scenes for unit tests and integration tests, each without its `version`.

/// A camera, and the materials white (albedo 1), grey (albedo 0.5), black, mirror (reflectance 0.8).
pub(crate) const HEAD: &str = r#"
[camera]
position = [0, 0, 4]
target = [0, 0, 0]
fov_y = 40
[[material]]
name = "white"
type = "diffuse"
albedo = [1, 1, 1]
[[material]]
name = "grey"
type = "diffuse"
albedo = [0.5, 0.5, 0.5]
[[material]]
name = "black"
type = "diffuse"
albedo = [0, 0, 0]
[[material]]
name = "mirror"
type = "mirror"
reflectance = [0.8, 0.8, 0.8]
"#;

/// The text of a sphere.
pub(crate) fn sphere(name: &str, center: [f64; 3], radius: f64, material: &str) -> String {
    object(name, "sphere", material, &format!("center = {center:?}\nradius = {radius}"))
}

/// The text of a quad.
pub(crate) fn quad(name: &str, [corner, edge_u, edge_v]: [[f64; 3]; 3], material: &str) -> String {
    object(name, "quad", material, &format!("corner = {corner:?}\nedge_u = {edge_u:?}\nedge_v = {edge_v:?}"))
}

/// The text of an object; `rest` holds the lines of its shape.
pub(crate) fn object(name: &str, shape: &str, material: &str, rest: &str) -> String {
    format!("[[object]]\nname = \"{name}\"\ntype = \"{shape}\"\nmaterial = \"{material}\"\n{rest}\n")
}

/// The text of a point light of intensity 1.
pub(crate) fn lamp(position: [f64; 3]) -> String {
    format!("[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = {position:?}\nintensity = [1, 1, 1]\n")
}
