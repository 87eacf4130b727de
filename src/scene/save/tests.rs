use super::super::{
    Bezier, Camera, Color, Emitter, Encoding, Film, Light, Location, Material, MaterialModel, Object, Relief, Render,
    Scene, SceneFile, Shape, Texture, TextureUse, ToneCurve, Transform, UvRect, validate,
};
use crate::scene::Revolution;
use crate::{geometry::bezier::ControlNet, math::Rgb};
use glam::{DVec2, DVec3};
use proptest::{collection::vec, prelude::*, sample::select};
use std::sync::Arc;

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        -1e9..1e9,
        -2.0..2.0,
        Just(0.0),
        Just(-0.0),
        Just(1e-300),
        Just(0.1),
        (-1000i32..1000).prop_map(f64::from)
    ]
}

fn point() -> impl Strategy<Value = DVec3> {
    [number(), number(), number()].prop_map(DVec3::from_array)
}

/// Two directions that are not parallel.
fn directions() -> impl Strategy<Value = (DVec3, DVec3)> {
    let unit = [-1.0..1.0, -1.0..1.0, -1.0..1.0].prop_map(DVec3::from_array);
    (unit.clone(), unit).prop_filter("not parallel", |(a, b)| a.cross(*b).length() > 1e-3)
}

fn size() -> impl Strategy<Value = f64> {
    prop_oneof![1e-9..1e9, Just(0.1), Just(1.0)]
}

fn fraction() -> impl Strategy<Value = Rgb> {
    [0f32..0.5, 0f32..0.5, 0f32..0.5].prop_map(Rgb::from_array)
}

fn strength() -> impl Strategy<Value = Rgb> {
    [0f32..1e12, 0f32..2.0, 0f32..1e-40].prop_map(Rgb::from_array)
}

fn name() -> impl Strategy<Value = String> {
    prop_oneof!["[a-z ]{1,8}", any::<String>().prop_filter("a name", |s| !s.is_empty())]
}

fn texture_use() -> impl Strategy<Value = TextureUse> {
    [-9.0..9.0, 0.1..9.0].prop_map(|s| TextureUse { texture: "texture 0".to_owned(), scale: DVec2::from_array(s) })
}

fn color() -> impl Strategy<Value = Color> {
    prop_oneof![fraction().prop_map(Color::Constant), texture_use().prop_map(Color::Texture)]
}

fn model() -> impl Strategy<Value = MaterialModel> {
    prop_oneof![
        color().prop_map(|albedo| MaterialModel::Diffuse { albedo }),
        (color(), color(), 0.0..1e9).prop_map(|(albedo, specular, exponent)| MaterialModel::Phong {
            albedo,
            specular,
            exponent
        }),
        (color(), color()).prop_map(|(albedo, reflectance)| MaterialModel::Polished { albedo, reflectance }),
        color().prop_map(|reflectance| MaterialModel::Mirror { reflectance }),
        (0.01..100.0, color(), strength(), any::<i32>())
            .prop_map(|(ior, tint, absorption, priority)| MaterialModel::Glass { ior, tint, absorption, priority }),
    ]
}

fn relief() -> impl Strategy<Value = Option<Relief>> {
    prop_oneof![
        Just(None),
        (texture_use(), -9.0..9.0).prop_map(|(map, strength)| Some(Relief::Normal { map, strength })),
        (texture_use(), -9.0..9.0).prop_map(|(map, depth)| Some(Relief::Height { map, depth })),
    ]
}

fn emitter() -> impl Strategy<Value = Emitter> {
    prop_oneof![
        (point(), strength()).prop_map(|(position, intensity)| Emitter::Point { position, intensity }),
        (point(), size(), strength()).prop_map(|(center, radius, radiance)| Emitter::Sphere {
            center,
            radius,
            radiance
        }),
        (point(), directions(), strength()).prop_map(|(corner, (edge_u, edge_v), radiance)| Emitter::Quad {
            corner,
            edge_u,
            edge_v,
            radiance
        }),
        (directions(), strength(), 0.0..90.0).prop_map(|((direction, _), irradiance, diameter)| Emitter::Sun {
            direction,
            irradiance,
            diameter
        }),
        (point(), directions(), size(), strength()).prop_map(|(center, (direction, _), radius, power)| Emitter::Beam {
            center,
            direction,
            radius,
            power
        }),
    ]
}

fn transform() -> impl Strategy<Value = Transform> {
    prop_oneof![
        Just(Transform::default()),
        (point(), point(), [0.1..9.0, -9.0..-0.1, 0.1..9.0]).prop_map(|(translate, rotate, scale)| Transform {
            translate,
            rotate,
            scale: DVec3::from_array(scale)
        }),
    ]
}

fn uv_rect() -> impl Strategy<Value = UvRect> {
    [-9.0..9.0, -9.0..9.0, 0.01..9.0, -9.0..-0.01].prop_map(|[u, v, width, height]| {
        let start = DVec2::new(u, v);
        UvRect { start, end: start + DVec2::new(width, height) }
    })
}

fn shape() -> impl Strategy<Value = Shape> {
    let row = || [point(), point(), point(), point()];
    let net = [row(), row(), row(), row()].prop_map(|points| ControlNet { points });
    prop_oneof![
        (point(), directions()).prop_map(|(corner, (edge_u, edge_v))| Shape::Quad { corner, edge_u, edge_v }),
        (point(), size()).prop_map(|(center, radius)| Shape::Sphere { center, radius }),
        (point(), directions(), any::<bool>()).prop_map(|(point, (normal, across), given)| Shape::Plane {
            point,
            normal,
            u_axis: given.then_some(across)
        }),
        (transform(), vec((net, uv_rect()), 1..3), any::<bool>()).prop_map(|(transform, patches, has_uv)| {
            let (patches, uv): (Vec<_>, _) = patches.into_iter().unzip();
            let uv = has_uv.then(|| Arc::new(uv));
            Shape::Bezier(Bezier { transform, patches: Arc::new(patches), file: None, uv })
        }),
        (transform(), 1_usize..4, vec([0.0..9.0, -9.0..9.0], 10), 0.1..=360.0, any::<bool>()).prop_map(
            |(transform, segments, points, angle, caps)| {
                let profile = points.into_iter().take(3 * segments + 1).map(DVec2::from_array).collect();
                Shape::Revolution(Revolution::new(transform, profile, angle, caps))
            }
        ),
    ]
}

fn film_and_render() -> impl Strategy<Value = (Film, Render)> {
    let curve = select(vec![ToneCurve::Srgb, ToneCurve::Filmic]);
    (1u32..16384, 1u32..16384, -9.0..9.0, curve, 1u32..1024, strength()).prop_map(
        |(width, height, exposure, tone_curve, max_bounces, background)| {
            (Film { width, height, exposure, tone_curve }, Render { max_bounces, background })
        },
    )
}

prop_compose! {
    fn scene()(
        name in any::<String>(),
        (forward, up) in directions(),
        position in [-2.0..2.0, -2.0..2.0, -2.0..2.0],
        fov_y in 1.0..179.0,
        (film, render) in film_and_render(),
        encoding in select(vec![Encoding::Srgb, Encoding::Linear]),
        materials in vec((name(), model(), relief()), 1..4),
        lights in vec((name(), emitter()), 0..3),
        objects in vec((name(), shape(), proptest::option::of(name())), 0..4),
    ) -> Scene {
        let position = DVec3::from_array(position);
        let numbered = |k: usize, name: String| format!("{name}{k}");
        let texture = Texture { name: "texture 0".to_owned(), file: "../assets/textures/face.png".to_owned(), encoding };
        let materials: Vec<_> = materials.into_iter().enumerate().map(|(k, (name, model, relief))| Material { name: numbered(k, name), model, relief }).collect();
        let material = materials[0].name.clone();
        Scene {
            name,
            camera: Camera { position, target: position + forward, up, fov_y },
            film,
            render,
            textures: vec![texture],
            lights: lights.into_iter().enumerate().map(|(k, (name, emitter))| Light { name: numbered(k, name), emitter }).collect(),
            objects: objects.into_iter().enumerate().map(|(k, (name, shape, body))| Object { name: numbered(k, name), material: material.clone(), shape, body }).collect(),
            materials,
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]
    #[test]
    fn a_saved_scene_loads_as_an_equal_scene(scene in scene()) {
        prop_assume!(validate(&scene).is_empty());
        let location = Location::Disk(std::path::PathBuf::from("src/test.toml"));
        let text = super::text(&scene);
        let loaded = SceneFile::parse(&text, location).map_err(|e| TestCaseError::fail(format!("{e}\n{text}")))?;
        // Debug tells -0 from 0.
        prop_assert_eq!(format!("{:?}", loaded.scene), format!("{scene:?}"));
        prop_assert_eq!(super::text(&loaded.scene), text);
    }
}

#[test]
fn saved_text_is_readable() {
    let scene = SceneFile::built_in("cornell").unwrap().scene;
    let text = super::text(&scene);
    assert!(text.starts_with("version = 1\nname = "), "{text}");
    assert!(
        text.contains("\n\n[[material]]\nname = \"white\"\ntype = \"diffuse\"\nalbedo = [0.725, 0.71, 0.68]\n\n"),
        "{text}"
    );
}
