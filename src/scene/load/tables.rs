//! The tables of the format, each read into the type that mirrors it.

use super::{
    field::{Field, mismatch},
    notes::Notes,
    table::Table,
};
use crate::scene::data::VERSION;
use crate::{
    math::Rgb,
    scene::{
        Bezier, Camera, Color, Emitter, Film, Light, Material, MaterialModel, Object, Relief, Render, Revolution,
        Scene, Shape, Texture, TextureUse, Transform, problem::suggestion,
    },
};
use glam::{DVec2, DVec3};
use std::sync::Arc;
use toml::de::{DeTable, DeValue};

const BLACK: Color = Color::Constant(Rgb::ZERO);
const WHITE: Color = Color::Constant(Rgb::ONE);

/// The whole file. Values that cannot be read are reported and replaced by defaults.
pub(super) fn scene(root: &DeTable<'_>, notes: &mut Notes) -> Scene {
    let mut t = Table::new(root, "", notes);
    let version = t.required("version", VERSION);
    if version != VERSION {
        t.add_at("version", format!("found {version}, expected {VERSION}, the only version of the format"));
    }
    let scene = Scene {
        name: t.optional("name", String::new()),
        camera: t.required("camera", Camera::default()),
        film: t.optional("film", Film::default()),
        render: t.optional("render", Render::default()),
        textures: t.optional("texture", Vec::new()),
        materials: t.optional("material", Vec::new()),
        lights: t.optional("light", Vec::new()),
        objects: t.optional("object", Vec::new()),
    };
    t.finish();
    scene
}

/// Implements [`Field`] for a type that a function reads from a table.
macro_rules! table_field {
    ($type:ty, $expected:literal, $read:ident) => {
        impl Field for $type {
            const EXPECTED: &'static str = $expected;

            fn read(value: &DeValue<'_>, path: &str, notes: &mut Notes) -> Option<Self> {
                let DeValue::Table(entries) = value else { return mismatch(value, path, Self::EXPECTED, notes) };
                let mut table = Table::new(entries, path, notes);
                let read = $read(&mut table);
                table.finish();
                Some(read)
            }
        }
    };
}

table_field!(Camera, "a table [camera]", camera);
table_field!(Film, "a table [film]", film);
table_field!(Render, "a table [render]", render);
table_field!(Texture, "a table [[texture]]", texture);
table_field!(Material, "a table [[material]]", material);
table_field!(Light, "a table [[light]]", light);
table_field!(Object, "a table [[object]]", object);
table_field!(TextureUse, "{ texture = \"NAME\" }", texture_use);
table_field!(NormalMap, "{ texture = \"NAME\", strength = 1.0 }", normal_map);
table_field!(HeightMap, "{ texture = \"NAME\", depth = 0.01 }", height_map);
table_field!(Transform, "{ translate = [0, 0, 0], rotate = [0, 0, 0], scale = [1, 1, 1] }", transform);

fn camera(t: &mut Table<'_>) -> Camera {
    let default = Camera::default();
    Camera {
        position: t.required("position", default.position),
        target: t.required("target", default.target),
        up: t.optional("up", default.up),
        fov_y: t.required("fov_y", default.fov_y),
    }
}

fn film(t: &mut Table<'_>) -> Film {
    let default = Film::default();
    Film {
        width: t.optional("width", default.width),
        height: t.optional("height", default.height),
        exposure: t.optional("exposure", default.exposure),
        tone_curve: t.optional("tone_curve", default.tone_curve),
    }
}

fn render(t: &mut Table<'_>) -> Render {
    let default = Render::default();
    Render {
        max_bounces: t.optional("max_bounces", default.max_bounces),
        background: t.optional("background", default.background),
    }
}

fn name(t: &mut Table<'_>) -> String {
    t.required("name", String::new())
}

fn texture(t: &mut Table<'_>) -> Texture {
    Texture {
        name: name(t),
        file: t.required("file", String::new()),
        encoding: t.optional("encoding", Default::default()),
    }
}

/// Reads the key `type` and then the keys of this type; `None` after reporting a type that is not among `types`.
fn by_type<T>(t: &mut Table<'_>, types: &[&str], read: impl Fn(&str, &mut Table<'_>) -> Option<T>) -> Option<T> {
    let given = t.has("type");
    let found: String = t.maybe("type").unwrap_or_default();
    let kind = read(&found, t);
    if kind.is_none() {
        let expected = types.join(", ");
        if !given {
            t.add(format!("the key `type` is missing, expected one of {expected}"));
        } else if !found.is_empty() {
            let hint = suggestion(&found, types.iter().copied());
            t.add_at("type", format!("found \"{found}\", expected one of {expected}{hint}"));
        }
        t.accept_all();
    }
    kind
}

fn material(t: &mut Table<'_>) -> Material {
    let name = name(t);
    let types = ["diffuse", "phong", "polished", "mirror", "glass"];
    let model = by_type(t, &types, material_model).unwrap_or(MaterialModel::Diffuse { albedo: BLACK });
    Material { name, model, relief: relief(t) }
}

fn material_model(kind: &str, t: &mut Table<'_>) -> Option<MaterialModel> {
    Some(match kind {
        "diffuse" => MaterialModel::Diffuse { albedo: t.required("albedo", BLACK) },
        "phong" => MaterialModel::Phong {
            albedo: t.required("albedo", BLACK),
            specular: t.required("specular", BLACK),
            exponent: t.required("exponent", 0.0),
        },
        "polished" => MaterialModel::Polished {
            albedo: t.required("albedo", BLACK),
            reflectance: t.required("reflectance", BLACK),
        },
        "mirror" => MaterialModel::Mirror { reflectance: t.required("reflectance", BLACK) },
        "glass" => MaterialModel::Glass {
            ior: t.required("ior", 1.5),
            tint: t.optional("tint", WHITE),
            absorption: t.optional("absorption", Rgb::ZERO),
            priority: t.optional("priority", 0),
        },
        _ => return None,
    })
}

/// The value of `normal_map`.
struct NormalMap(TextureUse, f64);

/// The value of `height_map`.
struct HeightMap(TextureUse, f64);

fn normal_map(t: &mut Table<'_>) -> NormalMap {
    NormalMap(texture_use(t), t.optional("strength", 1.0))
}

fn height_map(t: &mut Table<'_>) -> HeightMap {
    HeightMap(texture_use(t), t.required("depth", 0.0))
}

fn relief(t: &mut Table<'_>) -> Option<Relief> {
    if t.has("normal_map") && t.has("height_map") {
        t.add_at("height_map", "a material can have a `normal_map` or a `height_map`, not both".to_owned());
    }
    let normal = t.maybe("normal_map").map(|NormalMap(map, strength)| Relief::Normal { map, strength });
    let height = t.maybe("height_map").map(|HeightMap(map, depth)| Relief::Height { map, depth });
    normal.or(height)
}

fn texture_use(t: &mut Table<'_>) -> TextureUse {
    TextureUse { texture: t.required("texture", String::new()), scale: t.optional("scale", DVec2::ONE) }
}

impl Field for Color {
    const EXPECTED: &'static str = "a colour like [0.5, 0.5, 0.5] or { texture = \"NAME\" }";

    fn read(value: &DeValue<'_>, path: &str, notes: &mut Notes) -> Option<Self> {
        match value {
            DeValue::Array(_) => Rgb::read(value, path, notes).map(Self::Constant),
            DeValue::Table(_) => TextureUse::read(value, path, notes).map(Self::Texture),
            _ => mismatch(value, path, Self::EXPECTED, notes),
        }
    }
}

fn light(t: &mut Table<'_>) -> Light {
    let name = name(t);
    let fallback = Emitter::Point { position: DVec3::ZERO, intensity: Rgb::ZERO };
    Light { name, emitter: by_type(t, &["point", "sphere", "quad", "sun", "beam"], emitter).unwrap_or(fallback) }
}

fn emitter(kind: &str, t: &mut Table<'_>) -> Option<Emitter> {
    Some(match kind {
        "point" => Emitter::Point {
            position: t.required("position", DVec3::ZERO),
            intensity: t.required("intensity", Rgb::ZERO),
        },
        "sphere" => Emitter::Sphere {
            center: t.required("center", DVec3::ZERO),
            radius: t.required("radius", 1.0),
            radiance: t.required("radiance", Rgb::ZERO),
        },
        "quad" => Emitter::Quad {
            corner: t.required("corner", DVec3::ZERO),
            edge_u: t.required("edge_u", DVec3::X),
            edge_v: t.required("edge_v", DVec3::Y),
            radiance: t.required("radiance", Rgb::ZERO),
        },
        "sun" => Emitter::Sun {
            direction: t.required("direction", DVec3::NEG_Y),
            irradiance: t.required("irradiance", Rgb::ZERO),
            diameter: t.optional("diameter", Emitter::SUN_DIAMETER),
        },
        "beam" => Emitter::Beam {
            center: t.required("center", DVec3::ZERO),
            direction: t.required("direction", DVec3::NEG_Y),
            radius: t.required("radius", 1.0),
            power: t.required("power", Rgb::ZERO),
        },
        _ => return None,
    })
}

fn object(t: &mut Table<'_>) -> Object {
    let name = name(t);
    let shape = by_type(t, &["quad", "sphere", "plane", "bezier", "revolution"], shape);
    let material = t.required("material", String::new());
    let shape = shape.unwrap_or(Shape::Sphere { center: DVec3::ZERO, radius: 1.0 });
    Object { name, material, shape, body: t.maybe("body") }
}

fn shape(kind: &str, t: &mut Table<'_>) -> Option<Shape> {
    Some(match kind {
        "quad" => Shape::Quad {
            corner: t.required("corner", DVec3::ZERO),
            edge_u: t.required("edge_u", DVec3::X),
            edge_v: t.required("edge_v", DVec3::Y),
        },
        "sphere" => Shape::Sphere { center: t.required("center", DVec3::ZERO), radius: t.required("radius", 1.0) },
        "plane" => Shape::Plane {
            point: t.required("point", DVec3::ZERO),
            normal: t.required("normal", DVec3::Y),
            u_axis: t.maybe("u_axis"),
        },
        "bezier" => Shape::Bezier(bezier(t)),
        "revolution" => Shape::Revolution(revolution(t)),
        _ => return None,
    })
}

fn bezier(t: &mut Table<'_>) -> Bezier {
    let transform = t.optional("transform", Transform::default());
    let mut file = t.maybe("file");
    match (t.has("patches"), t.has("file")) {
        (true, true) => {
            t.add_at("file", "a Bezier object can have `patches` or a `file`, not both".to_owned());
            file = None;
        }
        (false, false) => t.add("one of the keys `patches` and `file` is missing".to_owned()),
        _ => {}
    }
    let patches = Arc::new(t.optional("patches", Vec::new()));
    Bezier { transform, patches, file, uv: t.maybe("uv").map(Arc::new) }
}

fn revolution(t: &mut Table<'_>) -> Revolution {
    let transform = t.optional("transform", Transform::default());
    let profile: Vec<DVec2> = t.required("profile", Vec::new());
    Revolution::new(transform, profile, t.optional("angle", 360.0), t.optional("caps", false))
}

fn transform(t: &mut Table<'_>) -> Transform {
    let default = Transform::default();
    Transform {
        translate: t.optional("translate", default.translate),
        rotate: t.optional("rotate", default.rotate),
        scale: t.optional("scale", default.scale),
    }
}
