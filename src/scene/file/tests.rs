use super::*;
use crate::scene::{Encoding, Texture};
use std::fs;

#[test]
fn every_built_in_scene_opens() {
    for scene in built_in_scenes() {
        let file = SceneFile::built_in(scene.name).unwrap_or_else(|e| panic!("{e}"));
        assert!(!file.scene.objects.is_empty() && !file.scene.lights.is_empty(), "{} shows something", scene.name);
    }
}

#[test]
fn an_unknown_example_suggests_one() {
    let message = SceneFile::built_in("tepot").unwrap_err().to_string();
    assert!(message.ends_with("did you mean \"teapot\"?"), "{message}");
}

/// Every built-in scene saved to a new folder opens again equal, and its files have equal bytes.
#[test]
fn built_in_scenes_take_their_files_along() {
    let dir = tempfile::tempdir().unwrap();
    for scene in built_in_scenes() {
        let original = SceneFile::built_in(scene.name).unwrap();
        let path = dir.path().join(scene.name).with_extension("toml");
        let mut saved = original.clone();
        saved.save(&path).unwrap();
        let reopened = SceneFile::open(&path).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(reopened, saved);
        for (before, after) in original.scene.textures.iter().zip(&reopened.scene.textures) {
            assert_eq!(original.location.read(&before.file).unwrap(), reopened.location.read(&after.file).unwrap());
        }
        let patches = |file: &SceneFile| -> Vec<_> {
            let shapes = file.scene.objects.iter().map(|o| o.shape.clone());
            shapes.filter_map(|s| if let Shape::Bezier(b) = s { Some(b.patches) } else { None }).collect()
        };
        assert_eq!(patches(&original), patches(&reopened));
    }
}

fn with_texture(location: Location, file: &str) -> SceneFile {
    let texture = Texture { name: "t".to_owned(), file: file.to_owned(), encoding: Encoding::Srgb };
    SceneFile { scene: Scene { textures: vec![texture], ..Scene::default() }, location }
}

#[test]
fn paths_are_rewritten_for_the_new_folder() {
    let dir = tempfile::tempdir().unwrap();
    for folder in ["here", "there/deep", "images"] {
        fs::create_dir_all(dir.path().join(folder)).unwrap();
    }
    let picture = include_bytes!("../../../assets/textures/face.png");
    fs::write(dir.path().join("images/t.png"), picture).unwrap();
    let mut file = with_texture(Location::Disk(dir.path().join("here/a.toml")), "../images/t.png");
    file.save(&dir.path().join("here/b.toml")).unwrap();
    assert_eq!(file.scene.textures[0].file, "../images/t.png", "the same folder, the same path");
    file.save(&dir.path().join("there/deep/c.toml")).unwrap();
    assert_eq!(file.scene.textures[0].file, "../../images/t.png");
    let moved = SceneFile::open(&dir.path().join("there/deep/c.toml")).unwrap();
    assert_eq!(&*moved.location.read("../../images/t.png").unwrap(), picture);
}

#[test]
fn other_files_are_never_overwritten() {
    let dir = tempfile::tempdir().unwrap();
    let mut file = SceneFile::built_in("report").unwrap();
    let name = file.scene.textures[0].file.rsplit('/').next().unwrap().to_owned();
    fs::write(dir.path().join(&name), b"mine").unwrap();
    file.save(&dir.path().join("a.toml")).unwrap();
    assert_eq!(fs::read(dir.path().join(&name)).unwrap(), b"mine");
    assert_ne!(file.scene.textures[0].file, name);
    let count = fs::read_dir(dir.path()).unwrap().count();
    SceneFile::built_in("report").unwrap().save(&dir.path().join("b.toml")).unwrap();
    assert_eq!(
        fs::read_dir(dir.path()).unwrap().count(),
        count + 1,
        "the second scene refers to the files of the first"
    );
}

#[test]
fn a_failed_save_leaves_the_file_unchanged() {
    let mut file = SceneFile::built_in("cornell").unwrap();
    let before = file.clone();
    let message = file.save(Path::new("no such folder/a.toml")).unwrap_err().to_string();
    assert!(message.starts_with("no such folder/a.toml: cannot be written: "), "{message}");
    assert_eq!(file, before);
}

#[test]
fn invalid_utf8_is_located() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.toml");
    fs::write(&path, b"version = 1\nname = \"\xff\"\n").unwrap();
    let message = SceneFile::open(&path).unwrap_err().to_string();
    assert!(message.ends_with("a.toml:2:9: the file is not valid UTF-8 from here on"), "{message}");
    assert!(SceneFile::open(dir.path()).unwrap_err().to_string().contains("cannot be read"));
}
