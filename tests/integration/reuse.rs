//! An edited scene reuses the trees and images that the edit left alone, and the picture does not depend on reuse.

use crate::support::advanced;
use patchlight::engine::Session;
use patchlight::geometry::Primitive;
use patchlight::geometry::bezier::Patch;
use patchlight::math::Rgb;
use patchlight::scene::{Color, Emitter, Encoding, Material, MaterialModel, Scene, SceneFile, Shape};
use patchlight::world::{Image, World, prepare};
use std::path::Path;
use std::sync::Arc;
use tempfile::TempDir;

/// Two objects of Bezier patches, three patches in all, on a floor with a texture.
fn scene(folder: &Path) -> SceneFile {
    image::RgbImage::from_fn(4, 4, |x, y| image::Rgb([200, if (x + y) % 2 == 0 { 80 } else { 160 }, 60]))
        .save(folder.join("checks.png"))
        .unwrap();
    let patch = |x: f64, z: f64| -> Vec<Vec<[f64; 3]>> {
        let point = |i: i32, j: i32| {
            let height = if i % 3 > 0 && j % 3 > 0 { 0.6 } else { 0.2 };
            [x + 0.2 * f64::from(i), height, z - 0.2 * f64::from(j)]
        };
        (0..4).map(|i| (0..4).map(|j| point(i, j)).collect()).collect()
    };
    let text = format!(
        "version = 1\n[camera]\nposition = [0, 2, 3]\ntarget = [0, 0.2, 0]\nfov_y = 40\n[film]\nwidth = 32\nheight = 24
        [[texture]]\nname = \"checks\"\nfile = \"checks.png\"
        [[material]]\nname = \"tiles\"\ntype = \"diffuse\"\nalbedo = {{ texture = \"checks\", scale = [4, 4] }}
        [[material]]\nname = \"glass\"\ntype = \"glass\"\nior = 1.5
        [[material]]\nname = \"paper\"\ntype = \"diffuse\"\nalbedo = [0.5, 0.4, 0.3]
        [[object]]\nname = \"sheets\"\ntype = \"bezier\"\nmaterial = \"paper\"\npatches = {:?}
        [[object]]\nname = \"lens\"\ntype = \"bezier\"\nmaterial = \"glass\"\npatches = {:?}
        [[object]]\nname = \"floor\"\ntype = \"quad\"\nmaterial = \"tiles\"\ncorner = [-2, 0, 2]\nedge_u = [4, 0, 0]\nedge_v = [0, 0, -4]
        [[light]]\nname = \"l\"\ntype = \"point\"\nposition = [1, 3, 1]\nintensity = [9, 9, 9]\n",
        [patch(-0.9, 0.4), patch(-0.9, -0.4)],
        [patch(0.3, 0.3)],
    );
    std::fs::write(folder.join("scene.toml"), text).unwrap();
    SceneFile::open(&folder.join("scene.toml")).expect("the scene is valid")
}

fn patches(world: &World) -> Vec<&Arc<Patch>> {
    let patches = world.aggregate.primitives().iter().filter_map(|primitive| match primitive {
        Primitive::Patch(patch) => Some(patch),
        _ => None,
    });
    patches.collect()
}

/// The world of the scene with all trees built, and the world after an edit.
fn edited(edit: impl Fn(&mut Scene)) -> [World; 2] {
    let folder: TempDir = tempfile::tempdir().unwrap();
    let before = scene(folder.path());
    let old = prepare(&before.scene, &before.location, None).expect("the scene can be prepared");
    patches(&old).iter().for_each(|patch| patch.prepare());
    let mut after = before.clone();
    edit(&mut after.scene);
    assert_ne!(before.scene, after.scene, "the edit changes something");
    let new = prepare(&after.scene, &after.location, Some(&old)).expect("the edited scene can be prepared");
    [old, new]
}

/// For each patch and for the texture, whether the world of an edited scene reuses it from the world before.
fn reused(edit: impl Fn(&mut Scene)) -> ([bool; 3], bool) {
    let [old, new] = edited(edit);
    let (old_patches, new_patches) = (patches(&old), patches(&new));
    let is_reused = [0, 1, 2].map(|k| Arc::ptr_eq(old_patches[k], new_patches[k]));
    // A reused tree stays built, and rays that find what the camera sees build new ones.
    assert_eq!([0, 1, 2].map(|k| new_patches[k].is_prepared()), [true; 3]);
    let image = |world: &World| -> Arc<Image> { world.images().next().expect("the floor's texture").clone() };
    (is_reused, Arc::ptr_eq(&image(&old), &image(&new)))
}

fn bezier_point(scene: &mut Scene, object: usize, patch: usize) -> &mut glam::DVec3 {
    let Shape::Bezier(bezier) = &mut scene.objects[object].shape else { panic!("no patches") };
    &mut Arc::make_mut(&mut bezier.patches)[patch].points[1][2]
}

#[test]
fn a_moved_control_point_rebuilds_its_patch_alone() {
    assert_eq!(reused(|scene| bezier_point(scene, 0, 1).y += 0.1), ([true, false, true], true));
    assert_eq!(reused(|scene| bezier_point(scene, 1, 0).y += 0.1), ([true, true, false], true));
}

#[test]
fn a_patch_out_of_view_has_no_tree_until_a_ray_comes_near() {
    let [_, new] = edited(|scene| {
        let Shape::Bezier(bezier) = &mut scene.objects[0].shape else { panic!("no patches") };
        let net = &mut Arc::make_mut(&mut bezier.patches)[1];
        net.points.as_flattened_mut().iter_mut().for_each(|point| point.z += 1e3);
    });
    assert_eq!([0, 1, 2].map(|k| patches(&new)[k].is_prepared()), [true, false, true]);
}

#[test]
fn edits_of_materials_lights_and_the_camera_reuse_every_patch() {
    let all = ([true; 3], true);
    let repaint = |scene: &mut Scene| {
        let MaterialModel::Diffuse { albedo } = &mut scene.materials[2].model else { panic!("paper is diffuse") };
        *albedo = Color::Constant(Rgb::splat(0.9));
    };
    assert_eq!(reused(repaint), all);
    assert_eq!(reused(|scene| scene.objects[0].material = "glass".to_owned()), all);
    assert_eq!(reused(|scene| scene.camera.position.x += 1.0), all);
    let move_light = |scene: &mut Scene| {
        let Emitter::Point { position, .. } = &mut scene.lights[0].emitter else { panic!("a point light") };
        position.x -= 1.0;
    };
    assert_eq!(reused(move_light), all);
    let add_material = |scene: &mut Scene| {
        let added = Material { name: "more".to_owned(), ..scene.materials[2].clone() };
        scene.materials.insert(0, added);
    };
    assert_eq!(reused(add_material), all);
}

#[test]
fn a_texture_is_decoded_again_for_a_new_encoding_but_not_for_a_new_scale() {
    assert_eq!(reused(|scene| scene.textures[0].encoding = Encoding::Linear), ([true; 3], false));
    let rescale = |scene: &mut Scene| {
        let MaterialModel::Diffuse { albedo: Color::Texture(texture) } = &mut scene.materials[0].model else {
            panic!("tiles have a texture")
        };
        texture.scale *= 2.0;
    };
    assert_eq!(reused(rescale), ([true; 3], true));
}

/// A world with reused trees and a world from scratch give the same bits.
#[test]
fn the_picture_does_not_depend_on_reuse() {
    let folder = tempfile::tempdir().unwrap();
    let file = scene(folder.path());
    let first = advanced(Session::prepare(&file, 1, None).expect("the scene can be prepared"), 1);
    let mut edited = file.clone();
    for object in [0, 1] {
        let Shape::Bezier(bezier) = &mut edited.scene.objects[object].shape else { panic!("no patches") };
        let net = &mut Arc::make_mut(&mut bezier.patches)[0];
        net.points.as_flattened_mut().iter_mut().for_each(|point| *point += glam::DVec3::new(0.3, 0.4, 0.2));
    }
    let image =
        |previous| advanced(Session::prepare(&edited, 1, previous).expect("it can be prepared"), 2).film().image();
    let reused = image(Some(&first));
    assert!(reused == image(None), "the pictures differ");
    assert!(reused != advanced(first, 2).film().image(), "the edit shows");
}
