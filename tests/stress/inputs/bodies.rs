//! What must hold of any bytes as a file: no panic, and an error that names the file and, in texts, the place.

use patchlight::cli::write_hits;
use patchlight::engine::{CheckpointFile, Run, Session};
use patchlight::film::{LinearImage, Provenance, read_exr, write_exr};
use patchlight::scene::{Location, SceneFile};
use patchlight::transport::Cancel;
use std::path::Path;

/// Calls `body` with the path of a file of these bytes.
fn with_file<T>(name: &str, bytes: &[u8], body: impl FnOnce(&Path) -> T) -> T {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).expect("the file can be written");
    body(&path)
}

/// Asserts that a message names the file, and the place as a line, a column or an index.
fn assert_names(message: &str, file: &str, has_place: bool) {
    assert!(message.contains(file), "the message does not name {file}: {message}");
    let after = message.split_once(file).map_or("", |(_, after)| after);
    let place =
        after.contains("line ") || after.contains("index ") || after.contains("patch") || is_line_and_column(after);
    assert!(!has_place || place, "the message names no place: {message}");
    assert!(message.len() < 20_000, "the message has {} bytes", message.len());
}

/// Whether a text begins with `:line:column:`.
fn is_line_and_column(text: &str) -> bool {
    let mut parts = text.split(':').skip(1);
    let mut is_number = || parts.next().is_some_and(|part| part.parse::<usize>().is_ok_and(|number| number > 0));
    is_number() && is_number()
}

/// A scene file: an error, or a small picture of finite radiance.
pub(crate) fn scene(bytes: &[u8]) {
    with_file("fuzzed.toml", bytes, |path| match SceneFile::open(path) {
        Ok(file) => assert_renders(file),
        Err(error) => assert_names(&error.to_string(), "fuzzed.toml", true),
    });
}

/// A `.bpt` file.
pub(crate) fn patches(bytes: &[u8]) {
    with_file("fuzzed.bpt", bytes, |path| match SceneFile::open(path) {
        Ok(file) => assert_renders(file),
        Err(error) => assert_names(&error.to_string(), "fuzzed.bpt", true),
    });
}

/// Renders one iteration of a picture of 6 x 6 pixels; the scene may also be refused, with a message.
fn assert_renders(mut file: SceneFile) {
    (file.scene.film.width, file.scene.film.height) = (6, 6);
    file.scene.render.max_bounces = file.scene.render.max_bounces.min(4);
    match Session::prepare(&file, 1, None) {
        Err(error) => assert!(!error.to_string().is_empty(), "an error has a message"),
        Ok(mut session) => {
            session.advance(Cancel::NEVER).expect("never cancelled");
            assert_proper(&session.film().image());
        }
    }
}

fn assert_proper(image: &LinearImage) {
    for pixel in &image.pixels {
        assert!(pixel.is_finite() && pixel.min_element() >= 0.0, "a pixel of {pixel}");
    }
}

/// A PNG or JPEG file.
pub(crate) fn texture(bytes: &[u8]) {
    with_file("fuzzed.png", bytes, |path| {
        let scene = Location::Disk(path.with_file_name("scene.toml"));
        if let Err(error) = scene.read_picture("fuzzed.png") {
            assert_names(&error, "fuzzed.png", false);
        }
    });
}

/// An EXR file: an error, or a picture that reads the same after it was written.
pub(crate) fn exr(bytes: &[u8]) {
    with_file("fuzzed.exr", bytes, |path| match read_exr(path) {
        Err(error) => assert_names(&error.to_string(), "fuzzed.exr", false),
        Ok(image) => {
            write_exr(path, &image, &Provenance::default()).expect("the picture can be written");
            let again = read_exr(path).expect("the picture can be read");
            let bits =
                |image: &LinearImage| image.pixels.iter().map(|p| p.to_array().map(f32::to_bits)).collect::<Vec<_>>();
            assert!(bits(&again) == bits(&image), "the picture reads the same");
        }
    });
}

/// A patch for the rays.
const PATCH: &str = "patch p\n0 0 0\n0 0 1\n0 0 2\n0 0 3\n1 0 0\n1 1 1\n1 1 2\n1 0 3\n2 0 0\n2 1 1\n2 1 2\n2 0 3\n3 0 0\n3 0 1\n3 0 2\n3 0 3\n";

/// A table of rays: an error, or a line for each ray.
pub(crate) fn rays(bytes: &[u8]) {
    with_file("fuzzed.csv", bytes, |path| {
        let patches = path.with_file_name("patches.txt");
        std::fs::write(&patches, PATCH).expect("the file can be written");
        let mut output = Vec::new();
        match write_hits(&patches, None, path, &mut output) {
            Err(error) => assert_names(&error.to_string(), "fuzzed.csv", std::str::from_utf8(bytes).is_ok()),
            Ok(()) => {
                for line in String::from_utf8(output).expect("text").lines() {
                    let numbers = line.split(',').filter(|field| !field.is_empty());
                    let are_finite =
                        numbers.map(str::parse).all(|number: Result<f64, _>| number.is_ok_and(f64::is_finite));
                    assert!(line.split(',').count() == 4 && are_finite, "{line}");
                }
            }
        }
    });
}

/// The scene of the films.
pub(crate) fn scene_of_films() -> SceneFile {
    let mut file = SceneFile::built_in("cornell").expect("a built-in scene");
    (file.scene.film.width, file.scene.film.height) = (7, 5);
    file
}

/// A checkpoint: an error, or a film with a picture; one of the run of [`scene_of_films`] also goes on.
pub(crate) fn film(bytes: &[u8]) {
    with_file("fuzzed.film", bytes, |path| {
        let read = CheckpointFile::open(path).and_then(CheckpointFile::read);
        let checkpoint = match read {
            Err(error) => return assert_names(&error.to_string(), "fuzzed.film", false),
            Ok(checkpoint) => checkpoint,
        };
        let (width, height) = checkpoint.run.size();
        assert_eq!(checkpoint.part.film().image().pixels.len(), (width * height) as usize);
        let file = scene_of_films();
        let run = Run::new(&file, 1, None).expect("a run");
        if checkpoint.run.difference(&run).is_none() {
            let session = Session::prepare(&file, 1, None).expect("the scene can be prepared");
            let mut session = session.resuming(checkpoint.part);
            session.advance(Cancel::NEVER).expect("never cancelled");
            assert_eq!(session.frame(0).image.pixels.len(), (width * height) as usize);
        }
    });
}
