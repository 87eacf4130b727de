//! The state of a scene as text, valid or not, for a later window.

use super::{Location, Scene, SceneError, SceneFile, Shape, load, save};

impl SceneFile {
    /// The text of the scene with all patches in it: it depends on no `.bpt` file.
    pub fn snapshot(&self) -> String {
        let mut scene: Scene = self.scene.clone();
        for object in &mut scene.objects {
            if let Shape::Bezier(bezier) = &mut object.shape {
                bezier.file = None;
            }
        }
        save::text(&scene)
    }

    /// The scene of a [`SceneFile::snapshot`]. Neither validates the scene nor reads the files that it names.
    ///
    /// # Errors
    ///
    /// If the text was changed since, and has values that no scene can have.
    pub fn restore(snapshot: &str, location: Location) -> Result<Self, SceneError> {
        match load::parse_unchecked(snapshot) {
            Ok(scene) => Ok(Self { scene, location }),
            Err(problems) => Err(SceneError::Invalid { file: location.label(), problems }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Texture, built_in_scenes, validate};

    #[test]
    fn snapshots_keep_every_built_in_scene() {
        for scene in built_in_scenes() {
            let file = SceneFile::built_in(scene.name).unwrap();
            let mut expected = file.clone();
            for object in &mut expected.scene.objects {
                if let Shape::Bezier(bezier) = &mut object.shape {
                    bezier.file = None;
                }
            }
            assert_eq!(SceneFile::restore(&file.snapshot(), file.location.clone()).unwrap(), expected);
        }
    }

    #[test]
    fn a_snapshot_keeps_an_invalid_scene() {
        let mut file = SceneFile::built_in("cornell").unwrap();
        file.scene.camera.fov_y = 0.0;
        file.scene.film.width = 0;
        file.scene.objects[0].material = "no such material".to_owned();
        file.scene.objects[1].name = file.scene.objects[0].name.clone();
        file.scene.textures.push(Texture {
            name: String::new(),
            file: "/no such file.png".to_owned(),
            encoding: Default::default(),
        });
        assert!(validate(&file.scene).len() > 3, "it is invalid");
        assert_eq!(SceneFile::restore(&file.snapshot(), file.location.clone()).unwrap(), file);
    }

    #[test]
    fn a_damaged_snapshot_is_an_error() {
        let text = SceneFile::built_in("cornell").unwrap().snapshot();
        let error = SceneFile::restore(&text[..text.len() / 2], Location::Disk("kept".into())).unwrap_err();
        assert!(error.to_string().starts_with("kept:"), "{error}");
    }
}
