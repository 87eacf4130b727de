//! From a scene to the text of a scene file, laid out for editing by hand.
//!
//! | file | holds |
//! |---|---|
//! | `value` | `Value`: types as TOML text; `Text`: the text so far |

mod value;

use super::data::VERSION;
use super::{
    Bezier, Emitter, Light, Material, MaterialModel, Object, Relief, Revolution, Scene, Shape, Texture, Transform,
};
use value::{Text, Value, net};

/// The text of a scene, which loads as an equal scene. Bezier objects with a `file` have its path instead of patches.
pub(super) fn text(scene: &Scene) -> String {
    let mut t = Text::default();
    t.key("version", &VERSION);
    t.key("name", &scene.name);
    t.table("[camera]");
    t.key("position", &scene.camera.position);
    t.key("target", &scene.camera.target);
    t.key("up", &scene.camera.up);
    t.key("fov_y", &scene.camera.fov_y);
    t.table("[film]");
    t.key("width", &scene.film.width);
    t.key("height", &scene.film.height);
    t.key("exposure", &scene.film.exposure);
    t.key("tone_curve", &scene.film.tone_curve);
    t.table("[render]");
    t.key("max_bounces", &scene.render.max_bounces);
    t.key("background", &scene.render.background);
    scene.textures.iter().for_each(|x| texture(x, &mut t));
    scene.materials.iter().for_each(|x| material(x, &mut t));
    scene.lights.iter().for_each(|x| light(x, &mut t));
    scene.objects.iter().for_each(|x| object(x, &mut t));
    t.finish()
}

fn texture(texture: &Texture, t: &mut Text) {
    t.table("[[texture]]");
    t.key("name", &texture.name);
    t.key("file", &texture.file);
    t.key("encoding", &texture.encoding);
}

fn material(material: &Material, t: &mut Text) {
    t.table("[[material]]");
    t.key("name", &material.name);
    model(&material.model, t);
    match &material.relief {
        Some(Relief::Normal { map, strength }) => {
            t.inline("normal_map", &[("texture", &map.texture), ("scale", &map.scale), ("strength", strength)]);
        }
        Some(Relief::Height { map, depth }) => {
            t.inline("height_map", &[("texture", &map.texture), ("scale", &map.scale), ("depth", depth)]);
        }
        None => {}
    }
}

fn model(model: &MaterialModel, t: &mut Text) {
    match model {
        MaterialModel::Diffuse { albedo } => typed(t, "diffuse", &[("albedo", albedo)]),
        MaterialModel::Phong { albedo, specular, exponent } => {
            typed(t, "phong", &[("albedo", albedo), ("specular", specular), ("exponent", exponent)]);
        }
        MaterialModel::Polished { albedo, reflectance } => {
            typed(t, "polished", &[("albedo", albedo), ("reflectance", reflectance)]);
        }
        MaterialModel::Mirror { reflectance } => typed(t, "mirror", &[("reflectance", reflectance)]),
        MaterialModel::Glass { ior, tint, absorption, priority } => {
            typed(t, "glass", &[("ior", ior), ("tint", tint), ("absorption", absorption)]);
            if *priority != 0 {
                t.key("priority", priority);
            }
        }
    }
}

/// The key `type` and the keys of this type.
fn typed(t: &mut Text, kind: &'static str, keys: &[(&str, &dyn Value)]) {
    t.key("type", &kind);
    for (key, value) in keys {
        t.key(key, *value);
    }
}

fn light(light: &Light, t: &mut Text) {
    t.table("[[light]]");
    t.key("name", &light.name);
    match &light.emitter {
        Emitter::Point { position, intensity } => {
            typed(t, "point", &[("position", position), ("intensity", intensity)]);
        }
        Emitter::Sphere { center, radius, radiance } => {
            typed(t, "sphere", &[("center", center), ("radius", radius), ("radiance", radiance)]);
        }
        Emitter::Quad { corner, edge_u, edge_v, radiance } => {
            let keys: [(&str, &dyn Value); 4] =
                [("corner", corner), ("edge_u", edge_u), ("edge_v", edge_v), ("radiance", radiance)];
            typed(t, "quad", &keys);
        }
        Emitter::Sun { direction, irradiance, diameter } => {
            let keys: [(&str, &dyn Value); 3] =
                [("direction", direction), ("irradiance", irradiance), ("diameter", diameter)];
            typed(t, "sun", &keys);
        }
        Emitter::Beam { center, direction, radius, power } => {
            let keys: [(&str, &dyn Value); 4] =
                [("center", center), ("direction", direction), ("radius", radius), ("power", power)];
            typed(t, "beam", &keys);
        }
    }
}

fn object(object: &Object, t: &mut Text) {
    t.table("[[object]]");
    t.key("name", &object.name);
    let material: (&str, &dyn Value) = ("material", &object.material);
    match &object.shape {
        Shape::Quad { corner, edge_u, edge_v } => {
            typed(t, "quad", &[material, ("corner", corner), ("edge_u", edge_u), ("edge_v", edge_v)]);
        }
        Shape::Sphere { center, radius } => typed(t, "sphere", &[material, ("center", center), ("radius", radius)]),
        Shape::Plane { point, normal, u_axis } => {
            typed(t, "plane", &[material, ("point", point), ("normal", normal)]);
            if let Some(u_axis) = u_axis {
                t.key("u_axis", u_axis);
            }
        }
        Shape::Bezier(b) => {
            typed(t, "bezier", &[material]);
            bezier(b, t);
        }
        Shape::Revolution(r) => {
            typed(t, "revolution", &[material]);
            revolution(r, t);
        }
    }
    if let Some(body) = &object.body {
        t.key("body", body);
    }
}

fn transform(transform: &Transform, t: &mut Text) {
    let Transform { translate, rotate, scale } = transform;
    if *transform != Transform::default() {
        t.inline("transform", &[("translate", translate), ("rotate", rotate), ("scale", scale)]);
    }
}

fn revolution(revolution: &Revolution, t: &mut Text) {
    transform(revolution.transform(), t);
    t.key("angle", &revolution.angle());
    t.key("caps", &revolution.caps());
    t.list("profile", revolution.profile().iter().map(Value::toml));
}

fn bezier(bezier: &Bezier, t: &mut Text) {
    transform(&bezier.transform, t);
    match &bezier.file {
        Some(file) => t.key("file", file),
        None => t.list("patches", bezier.patches.iter().map(net)),
    }
    if let Some(uv) = &bezier.uv {
        t.list("uv", uv.iter().map(Value::toml));
    }
}

#[cfg(test)]
mod tests;
