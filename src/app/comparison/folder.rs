//! The folder beside a scene that keeps its snapshots: one OpenEXR file each, with the snapshot's scene in its attributes.

use super::snapshot::Snapshot;
use crate::film::{read_exr_with_provenance, write_exr};
use crate::scene::Location;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Most snapshots of a folder.
const MOST: usize = 99;

/// The folder of the snapshots of the scene in this file: for `room.toml` it is `room.snapshots`.
fn folder_of(scene: &Path) -> PathBuf {
    scene.with_extension("snapshots")
}

/// The file of a snapshot, given its place from 0.
fn file_of(folder: &Path, place: usize) -> PathBuf {
    folder.join(format!("{:02}.exr", place + 1))
}

/// Writes the snapshots of the scene in this file, and removes those of former times that are no more.
///
/// # Errors
/// Returns a message that names the file that cannot be written.
pub(crate) fn write_snapshots(scene: &Path, snapshots: &[Snapshot]) -> Result<(), String> {
    let folder = folder_of(scene);
    let failed = |error: io::Error| format!("{} cannot be written: {error}", folder.display());
    if !snapshots.is_empty() {
        fs::create_dir_all(&folder).map_err(failed)?;
    }
    for (place, snapshot) in snapshots.iter().take(MOST).enumerate() {
        let written = write_exr(&file_of(&folder, place), &snapshot.image, &snapshot.provenance());
        written.map_err(|error| error.to_string())?;
    }
    for old in (snapshots.len()..MOST).map(|place| file_of(&folder, place)).filter(|old| old.exists()) {
        fs::remove_file(old).map_err(failed)?;
    }
    Ok(())
}

/// The snapshots that were saved with the scene in this file, and a message for each that cannot be read.
pub(crate) fn read_snapshots(scene: &Path) -> (Vec<Snapshot>, Vec<String>) {
    let folder = folder_of(scene);
    let location = Location::Disk(scene.to_owned());
    let (mut snapshots, mut messages) = (Vec::new(), Vec::new());
    for file in (0..MOST).map(|place| file_of(&folder, place)).filter(|file| file.is_file()) {
        match read_exr_with_provenance(&file) {
            Ok((image, provenance)) => {
                let stem = file.file_stem().unwrap_or_default().to_string_lossy();
                snapshots.push(Snapshot::of_file(&stem, image, &provenance, &location));
            }
            Err(error) => messages.push(error.to_string()),
        }
    }
    (snapshots, messages)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::LinearImage;
    use crate::math::Rgb;
    use crate::scene::SceneFile;
    use std::sync::Arc;

    fn snapshot(name: &str, scene: &Path) -> Snapshot {
        let file = SceneFile { location: Location::Disk(scene.to_owned()), ..SceneFile::built_in("cornell").unwrap() };
        let image = LinearImage { width: 2, height: 1, pixels: vec![Rgb::X, Rgb::splat(0.25)] };
        Snapshot {
            name: name.to_owned(),
            image: Arc::new(image),
            file: Some(Arc::new(file)),
            iterations: 7,
            seconds: Some(2.5),
            error: Some(0.125),
        }
    }

    #[test]
    fn snapshots_come_back_with_their_scenes() {
        let dir = tempfile::tempdir().unwrap();
        let scene = dir.path().join("room.toml");
        let kept = [snapshot("first", &scene), snapshot("second: brighter", &scene)];
        write_snapshots(&scene, &kept).unwrap();
        let (read, messages) = read_snapshots(&scene);
        assert!(messages.is_empty(), "{messages:?}");
        for (read, kept) in read.iter().zip(&kept) {
            assert_eq!((&read.name, &read.image, &read.file), (&kept.name, &kept.image, &kept.file));
            assert_eq!((read.iterations, read.seconds, read.error), (7, Some(2.5), Some(0.125)));
        }
        write_snapshots(&scene, &kept[1..]).unwrap();
        let names: Vec<String> = read_snapshots(&scene).0.into_iter().map(|snapshot| snapshot.name).collect();
        assert_eq!(names, ["second: brighter"]);
    }

    #[test]
    fn a_damaged_snapshot_is_named_and_the_others_come() {
        let dir = tempfile::tempdir().unwrap();
        let scene = dir.path().join("room.toml");
        assert!(read_snapshots(&scene).0.is_empty(), "no folder");
        write_snapshots(&scene, &[snapshot("a", &scene), snapshot("b", &scene)]).unwrap();
        fs::write(dir.path().join("room.snapshots/01.exr"), "no picture").unwrap();
        let (read, messages) = read_snapshots(&scene);
        assert_eq!(read.len(), 1);
        assert!(messages.len() == 1 && messages[0].contains("01.exr"), "{messages:?}");
    }
}
