use super::*;
use crate::{
    math::Rgb,
    scene::{Color, Emitter, Light, Material, MaterialModel, Object, Revolution, Shape, Transform},
};
use glam::{DVec2, DVec3};

fn scene() -> Scene {
    let material = |name: &str| Material {
        name: name.to_owned(),
        model: MaterialModel::Diffuse { albedo: Color::Constant(Rgb::splat(0.5)) },
        relief: None,
    };
    let shape = Shape::Sphere { center: DVec3::ZERO, radius: 1.0 };
    Scene {
        materials: vec![material("white"), material("black")],
        lights: vec![Light {
            name: "lamp".to_owned(),
            emitter: Emitter::Point { position: DVec3::ZERO, intensity: Rgb::ONE },
        }],
        objects: vec![Object { name: "ball".to_owned(), material: "white".to_owned(), shape, body: None }],
        ..Scene::default()
    }
}

/// The path of the one problem that an edit makes.
fn problem_after(edit: impl Fn(&mut Scene)) -> String {
    let mut scene = scene();
    edit(&mut scene);
    let problems = validate(&scene);
    assert_eq!(problems.len(), 1, "{problems:?}");
    problems[0].path.clone()
}

#[test]
fn a_good_scene_has_no_problem() {
    assert_eq!(validate(&scene()), []);
    assert_eq!(validate(&Scene::default()), []);
}

#[test]
fn edits_that_break_a_scene_are_found() {
    assert_eq!(problem_after(|s| s.camera.target = s.camera.position), "camera.target");
    assert_eq!(problem_after(|s| s.camera.up = DVec3::Z), "camera.up");
    assert_eq!(problem_after(|s| s.camera.up = DVec3::ZERO), "camera.up");
    assert_eq!(problem_after(|s| s.camera.fov_y = f64::NAN), "camera.fov_y");
    assert_eq!(problem_after(|s| s.camera.fov_y = 180.0), "camera.fov_y");
    assert_eq!(problem_after(|s| s.film.exposure = f64::INFINITY), "film.exposure");
    assert_eq!(problem_after(|s| s.render.background.x = -1.0), "render.background");
    assert_eq!(problem_after(|s| s.materials[1].name = "white".to_owned()), "material[1].name");
    assert_eq!(problem_after(|s| s.lights[0].name.clear()), "light[0].name");
    assert_eq!(problem_after(|s| s.objects[0].material = "grey".to_owned()), "object[0].material");
    let shape = |shape: Shape| problem_after(|s| s.objects[0].shape = shape.clone());
    assert_eq!(shape(Shape::Sphere { center: DVec3::ZERO, radius: 0.0 }), "object[0].radius");
    assert_eq!(shape(Shape::Sphere { center: DVec3::NAN, radius: 1.0 }), "object[0].center");
    assert_eq!(shape(Shape::Quad { corner: DVec3::ZERO, edge_u: DVec3::X, edge_v: -DVec3::X }), "object[0].edge_v");
    assert_eq!(shape(Shape::Quad { corner: DVec3::ZERO, edge_u: DVec3::ZERO, edge_v: DVec3::X }), "object[0].edge_u");
    assert_eq!(
        shape(Shape::Plane { point: DVec3::ZERO, normal: DVec3::Y, u_axis: Some(DVec3::Y) }),
        "object[0].u_axis"
    );
}

#[test]
fn the_values_of_a_revolution_are_checked_one_by_one() {
    let profile = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.5, 2.0)].map(DVec2::from);
    let problem = |change: &dyn Fn(&mut Vec<DVec2>), angle: f64| {
        let mut profile = profile.to_vec();
        change(&mut profile);
        let vase = Revolution::new(Transform::default(), profile, angle, true);
        problem_after(|s| s.objects[0].shape = Shape::Revolution(vase.clone()))
    };
    assert_eq!(problem(&|profile| profile[1].x = -0.1, 360.0), "object[0].profile[1]");
    assert_eq!(problem(&|profile| profile[2].y = f64::NAN, 360.0), "object[0].profile[2]");
    assert_eq!(problem(&|profile| profile.truncate(3), 360.0), "object[0].profile");
    assert_eq!(problem(&|profile| profile.clear(), 360.0), "object[0].profile");
    assert_eq!(problem(&|profile| profile.resize(Revolution::MOST_POINTS + 3, DVec2::ONE), 360.0), "object[0].profile");
    assert_eq!(problem(&|profile| profile.iter_mut().for_each(|point| point.x = 0.0), 360.0), "object[0].profile");
    for angle in [0.0, -90.0, 361.0, f64::NAN] {
        assert_eq!(problem(&|_| (), angle), "object[0].angle");
    }
    let transform = Transform { scale: DVec3::ZERO.with_x(1.0).with_z(1.0), ..Transform::default() };
    let flat = Revolution::new(transform, profile.to_vec(), 90.0, false);
    assert_eq!(problem_after(|s| s.objects[0].shape = Shape::Revolution(flat.clone())), "object[0].transform.scale[1]");
    let mut good = scene();
    good.objects[0].shape = Shape::Revolution(Revolution::new(Transform::default(), profile.to_vec(), 90.0, false));
    assert_eq!(validate(&good), []);
}

#[test]
fn materials_of_one_body_have_one_medium() {
    let glass =
        |ior: f64| MaterialModel::Glass { ior, tint: Color::Constant(Rgb::ONE), absorption: Rgb::ZERO, priority: 0 };
    let two = |iors: [f64; 2]| {
        let mut scene = scene();
        scene.objects.push(Object { name: "top".to_owned(), material: "black".to_owned(), ..scene.objects[0].clone() });
        for (k, ior) in iors.into_iter().enumerate() {
            scene.materials[k].model = glass(ior);
            scene.objects[k].body = Some("water".to_owned());
        }
        scene
    };
    assert_eq!(validate(&two([1.33, 1.33])), []);
    let problems = validate(&two([1.33, 1.5]));
    assert_eq!(problems.len(), 1, "{problems:?}");
    assert_eq!(problems[0].path, "object[1].body");
    assert!(problems[0].message.contains("\"white\"") && problems[0].message.contains("\"black\""), "{problems:?}");
}

#[test]
fn reflecting_all_the_light_is_allowed() {
    let mut scene = scene();
    let polished = |albedo: f32, reflectance: f32| MaterialModel::Polished {
        albedo: Color::Constant(Rgb::splat(albedo)),
        reflectance: Color::Constant(Rgb::splat(reflectance)),
    };
    for tenths in 0..=10u8 {
        let fraction = f32::from(tenths) / 10.0;
        scene.materials[0].model = polished(fraction, 1.0 - fraction);
        assert_eq!(validate(&scene), [], "{fraction}");
    }
    scene.materials[0].model = polished(0.9, 0.1 + 1e-5);
    assert_eq!(validate(&scene).len(), 1);
}
