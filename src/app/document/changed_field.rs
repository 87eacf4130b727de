//! The field that an edit changes, by its label in the panels.

use crate::scene::{Camera, Emitter, Film, Light, Material, MaterialModel, Object, Relief, Render, Shape, Texture};

/// A field's label, and whether it stays the same.
type Field = (&'static str, bool);

/// The one field that changes; `None` where none or several change.
fn only(fields: &[Field]) -> Option<&'static str> {
    let mut changed = fields.iter().filter(|(_, same)| !same);
    changed.next().filter(|_| changed.next().is_none()).map(|(label, _)| *label)
}

/// The changed field of the camera.
pub(super) fn of_camera(a: &Camera, b: &Camera) -> Option<&'static str> {
    only(&[
        ("position", a.position == b.position),
        ("target", a.target == b.target),
        ("up", a.up == b.up),
        ("field of view", a.fov_y == b.fov_y),
    ])
}

/// The changed field of the picture.
pub(super) fn of_film(a: &Film, b: &Film) -> Option<&'static str> {
    only(&[
        ("size", (a.width, a.height) == (b.width, b.height)),
        ("exposure", a.exposure == b.exposure),
        ("tone curve", a.tone_curve == b.tone_curve),
    ])
}

/// The changed field of rendering.
pub(super) fn of_render(a: &Render, b: &Render) -> Option<&'static str> {
    only(&[("bounces", a.max_bounces == b.max_bounces), ("background", a.background == b.background)])
}

/// The changed field of a texture.
pub(super) fn of_texture(a: &Texture, b: &Texture) -> Option<&'static str> {
    only(&[("name", a.name == b.name), ("file", a.file == b.file), ("encoding", a.encoding == b.encoding)])
}

/// The changed field of a light.
pub(super) fn of_light(a: &Light, b: &Light) -> Option<&'static str> {
    match [a.name == b.name, a.emitter == b.emitter] {
        [false, true] => Some("name"),
        [true, false] => emitter(&a.emitter, &b.emitter),
        _ => None,
    }
}

fn emitter(a: &Emitter, b: &Emitter) -> Option<&'static str> {
    match (a, b) {
        (Emitter::Point { position, intensity }, Emitter::Point { position: p, intensity: i }) => {
            only(&[("position", position == p), ("intensity", intensity == i)])
        }
        (
            Emitter::Sphere { center, radius, radiance },
            Emitter::Sphere { center: other_center, radius: other_radius, radiance: other },
        ) => only(&[
            ("centre", center == other_center),
            ("radius", radius == other_radius),
            ("radiance", radiance == other),
        ]),
        (
            Emitter::Quad { corner, edge_u, edge_v, radiance },
            Emitter::Quad { corner: c, edge_u: u, edge_v: v, radiance: r },
        ) => only(&[
            ("corner", corner == c),
            ("edge u", edge_u == u),
            ("edge v", edge_v == v),
            ("radiance", radiance == r),
        ]),
        (
            Emitter::Sun { direction, irradiance, diameter },
            Emitter::Sun { direction: d, irradiance: i, diameter: other },
        ) => only(&[("direction", direction == d), ("irradiance", irradiance == i), ("diameter", diameter == other)]),
        (
            Emitter::Beam { center, direction, radius, power },
            Emitter::Beam { center: c, direction: d, radius: r, power: p },
        ) => only(&[
            ("centre", center == c),
            ("direction", direction == d),
            ("radius", radius == r),
            ("power", power == p),
        ]),
        _ => Some("type"),
    }
}

/// The changed field of a material.
pub(super) fn of_material(a: &Material, b: &Material) -> Option<&'static str> {
    let same = [a.name == b.name, a.model == b.model, a.relief == b.relief];
    match same {
        [false, true, true] => Some("name"),
        [true, false, true] => model(&a.model, &b.model),
        [true, true, false] => relief(a.relief.as_ref(), b.relief.as_ref()),
        _ => None,
    }
}

fn model(a: &MaterialModel, b: &MaterialModel) -> Option<&'static str> {
    use MaterialModel::{Diffuse, Glass, Mirror, Phong, Polished};
    match (a, b) {
        (Diffuse { albedo }, Diffuse { albedo: other }) => only(&[("albedo", albedo == other)]),
        (Phong { albedo, specular, exponent }, Phong { albedo: a, specular: s, exponent: e }) => {
            only(&[("albedo", albedo == a), ("specular", specular == s), ("exponent", exponent == e)])
        }
        (Polished { albedo, reflectance }, Polished { albedo: a, reflectance: r }) => {
            only(&[("albedo", albedo == a), ("reflectance", reflectance == r)])
        }
        (Mirror { reflectance }, Mirror { reflectance: other }) => only(&[("reflectance", reflectance == other)]),
        (Glass { ior, tint, absorption, priority }, Glass { ior: i, tint: t, absorption: a, priority: p }) => only(&[
            ("index of refraction", ior == i),
            ("tint", tint == t),
            ("absorption", absorption == a),
            ("priority", priority == p),
        ]),
        _ => Some("type"),
    }
}

fn relief(a: Option<&Relief>, b: Option<&Relief>) -> Option<&'static str> {
    match (a, b) {
        (Some(Relief::Normal { map, strength }), Some(Relief::Normal { map: m, strength: s })) => {
            only(&[("normal map", map == m), ("strength", strength == s)])
        }
        (Some(Relief::Height { map, depth }), Some(Relief::Height { map: m, depth: d })) => {
            only(&[("height map", map == m), ("depth", depth == d)])
        }
        _ => Some("relief"),
    }
}

/// The changed field of an object.
pub(super) fn of_object(a: &Object, b: &Object) -> Option<&'static str> {
    let same = [a.name == b.name, a.material == b.material, a.body == b.body, a.shape == b.shape];
    match same {
        [false, true, true, true] => Some("name"),
        [true, false, true, true] => Some("material"),
        [true, true, false, true] => Some("body"),
        [true, true, true, false] => shape(&a.shape, &b.shape),
        _ => None,
    }
}

fn shape(a: &Shape, b: &Shape) -> Option<&'static str> {
    match (a, b) {
        (Shape::Quad { corner, edge_u, edge_v }, Shape::Quad { corner: c, edge_u: u, edge_v: v }) => {
            only(&[("corner", corner == c), ("edge u", edge_u == u), ("edge v", edge_v == v)])
        }
        (Shape::Sphere { center, radius }, Shape::Sphere { center: c, radius: r }) => {
            only(&[("centre", center == c), ("radius", radius == r)])
        }
        (Shape::Plane { point, normal, u_axis }, Shape::Plane { point: p, normal: n, u_axis: u }) => {
            only(&[("point", point == p), ("normal", normal == n), ("u axis", u_axis == u)])
        }
        (Shape::Bezier(a), Shape::Bezier(b)) => only(&[
            ("translation", a.transform.translate == b.transform.translate),
            ("rotation", a.transform.rotate == b.transform.rotate),
            ("scale", a.transform.scale == b.transform.scale),
            ("patches", (&a.patches, &a.file, &a.uv) == (&b.patches, &b.file, &b.uv)),
        ]),
        (Shape::Revolution(a), Shape::Revolution(b)) => only(&[
            ("translation", a.transform().translate == b.transform().translate),
            ("rotation", a.transform().rotate == b.transform().rotate),
            ("scale", a.transform().scale == b.transform().scale),
            ("profile", a.profile() == b.profile()),
            ("angle", a.angle() == b.angle()),
            ("caps", a.caps() == b.caps()),
        ]),
        _ => Some("shape"),
    }
}
