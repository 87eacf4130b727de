use super::{ImageError, LinearImage, Provenance};
use crate::{
    file::{read_limited, write_whole},
    math::Rgb,
    scene::{Camera, Film},
};
use exr::meta::{MetaData, attribute::LineOrder};
use exr::prelude::{
    Encoding, Image, Layer, LayerAttributes, ReadChannels, ReadLayers, ReadSpecificChannel, SpecificChannels, Text,
    WritableImage, read,
};
use glam::DVec3;
use std::{
    io::{self, Cursor},
    path::Path,
};

/// Most bytes of a file: the largest picture of the program takes 3 GB without compression.
const MAX_BYTES: u64 = 4 << 30;

/// Luminance of the colour (1, 1, 1), cd/m^2: that of white light of 1 W/(sr m^2) by the luminous efficacy of Radiance \[WardLarson98\].
const WHITE_LUMINANCE: f32 = 179.0;

/// Writes an image as an OpenEXR file of 32-bit floats, without exposure and tone curve, with its provenance in the attributes `software`,
/// `comments`, `worldToCamera`, `fieldOfViewVertical` and `fieldOfViewHorizontal`. The file is written whole or not at all.
///
/// # Errors
///
/// If the file cannot be written.
pub fn write_exr(path: &Path, image: &LinearImage, provenance: &Provenance) -> Result<(), ImageError> {
    let failed = |source| ImageError::Write { file: path.to_owned(), source };
    let width = image.width as usize;
    let channels = SpecificChannels::rgb(|at: exr::math::Vec2<usize>| {
        let pixel = image.pixels[at.y() * width + at.x()];
        (pixel.x, pixel.y, pixel.z)
    });
    let size = (width, image.height as usize);
    // Otherwise blocks stand in the order in which threads pack them, and equal pictures are different files.
    let encoding = Encoding { line_order: LineOrder::Increasing, ..Encoding::SMALL_FAST_LOSSLESS };
    let layer = Layer::new(size, attributes(image, provenance), encoding, channels);
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer).write().to_buffered(&mut bytes).map_err(|e| failed(io::Error::other(e)))?;
    write_whole(path, bytes.get_ref()).map_err(failed)
}

fn attributes(image: &LinearImage, provenance: &Provenance) -> LayerAttributes {
    // The format leaves the encoding open; other programs read and write UTF-8, too.
    let text = |text: &str| Some(Text::from_slice_unchecked(text.as_bytes()));
    let camera = provenance.camera;
    let vertical = camera.map(|camera| camera.fov_y as f32);
    let aspect = image.width as f32 / image.height as f32;
    let horizontal = |fov: f32| (2.0 * (aspect * (0.5 * fov.to_radians()).tan()).atan()).to_degrees();
    LayerAttributes {
        white_luminance: Some(WHITE_LUMINANCE),
        software_name: text(Provenance::SOFTWARE),
        comments: text(&provenance.comment()),
        world_to_camera: camera.map(world_to_camera),
        vertical_field_of_view: vertical,
        horizontal_field_of_view: vertical.map(horizontal),
        ..LayerAttributes::named("radiance")
    }
}

/// The matrix by which a row vector in world space becomes one in the space of the camera, which looks along -z with y upwards; row by row.
fn world_to_camera(camera: Camera) -> [f32; 16] {
    let Camera { position, target, up, .. } = camera;
    let forward = (target - position).normalize_or_zero();
    let right = forward.cross(up).normalize_or_zero();
    let axes = [right, right.cross(forward), -forward];
    let rows = [DVec3::X, DVec3::Y, DVec3::Z].map(|world| axes.map(|axis| axis.dot(world)));
    let origin = axes.map(|axis| -axis.dot(position));
    let with_last = |[x, y, z]: [f64; 3], w: f64| [x, y, z, w].map(|x| x as f32);
    let [a, b, c] = rows.map(|row| with_last(row, 0.0));
    [a, b, c, with_last(origin, 1.0)].concat().try_into().unwrap_or_default()
}

/// Reads the first layer with channels R, G and B of an OpenEXR file, of half or single precision.
///
/// # Errors
///
/// If the file cannot be read, is not an OpenEXR file with such a layer, or states a size that no film has.
pub fn read_exr(path: &Path) -> Result<LinearImage, ImageError> {
    read_exr_with_provenance(path).map(|(image, _)| image)
}

/// [`read_exr`], with what the file tells of the picture's provenance, without its camera.
///
/// # Errors
///
/// As [`read_exr`].
pub fn read_exr_with_provenance(path: &Path) -> Result<(LinearImage, Provenance), ImageError> {
    let bytes = read_limited(path, MAX_BYTES).map_err(|source| ImageError::Read { file: path.to_owned(), source })?;
    let wrong = |message: String| ImageError::Content { file: path.to_owned(), message };
    check_sizes(&bytes).map_err(wrong)?;
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .specific_channels()
        .required("R")
        .required("G")
        .required("B")
        .collect_pixels(
            |size, _| LinearImage::black(size.width() as u32, size.height() as u32),
            |image, at, (r, g, b): (f32, f32, f32)| {
                image.pixels[at.y() * image.width as usize + at.x()] = Rgb::new(r, g, b);
            },
        )
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(|e| wrong(not_exr(&e)))?;
    let comments = image.layer_data.attributes.comments;
    let provenance = comments.map(|text| Provenance::of_comment(&String::from_utf8_lossy(text.as_slice())));
    Ok((image.layer_data.channel_data.pixels, provenance.unwrap_or_default()))
}

/// Checks the sizes of all layers before memory is taken for their pixels.
///
/// # Errors
///
/// A message, if the header cannot be read, or a layer is larger than a film, or has fewer bytes in the file than its blocks take.
fn check_sizes(bytes: &[u8]) -> Result<(), String> {
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(|e| not_exr(&e))?;
    for header in &meta.headers {
        let (width, height) = (header.layer_size.width(), header.layer_size.height());
        if width.max(height) > Film::MOST_PIXELS as usize {
            return Err(format!(
                "has {width} x {height} pixels, expected at most {most} x {most}",
                most = Film::MOST_PIXELS
            ));
        }
        // Each block has its offset and its size in the file.
        if header.chunk_count * 12 > bytes.len() {
            return Err(format!("has {width} x {height} pixels by its header, but ends before them"));
        }
    }
    Ok(())
}

fn not_exr(error: &exr::error::Error) -> String {
    format!("not an OpenEXR image with channels R, G and B: {error}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use exr::prelude::{AnyChannel, AnyChannels, FlatSamples, f16};
    use std::fs;

    fn write_exr(path: &Path, image: &LinearImage) -> Result<(), ImageError> {
        super::write_exr(path, image, &Provenance::default())
    }

    fn image() -> LinearImage {
        let pixels = (0..35).map(|k| Rgb::new(k as f32, 1.0 / (k as f32 + 1.0), 1e20 * k as f32)).collect();
        LinearImage { width: 7, height: 5, pixels }
    }

    #[test]
    fn floats_survive_exactly() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.exr");
        write_exr(&path, &image()).unwrap();
        assert_eq!(read_exr(&path).unwrap(), image());
    }

    #[test]
    fn the_file_tells_where_the_picture_comes_from() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.exr");
        let camera =
            Camera { position: DVec3::new(1.0, 2.0, 7.0), target: DVec3::new(1.0, 2.0, 3.0), ..Camera::default() };
        let camera = Camera { fov_y: 60.0, ..camera };
        let provenance = Provenance {
            scene: Some("version = 1\nname = \"\u{e4} \u{6c34}\"\n".to_owned()),
            iterations: 5,
            error: Some(0.25),
            camera: Some(camera),
            ..Provenance::default()
        };
        super::write_exr(&path, &image(), &provenance).unwrap();
        let (read, told) = read_exr_with_provenance(&path).unwrap();
        assert_eq!((read, told), (image(), Provenance { camera: None, ..provenance }));
        let meta = MetaData::read_from_file(&path, false).unwrap();
        let attributes = &meta.headers[0].own_attributes;
        assert_eq!(attributes.software_name.as_ref().map(|text| text.to_string()), Some(Provenance::SOFTWARE.into()));
        assert_eq!((attributes.white_luminance, attributes.vertical_field_of_view), (Some(179.0), Some(60.0)));
        let horizontal = f64::from(attributes.horizontal_field_of_view.unwrap()).to_radians();
        assert!(((0.5 * horizontal).tan() - 1.4 * 30f64.to_radians().tan()).abs() < 1e-6, "{horizontal}");
        // A point 4 units before the camera and 1 to its right.
        let m = attributes.world_to_camera.unwrap();
        let point = [2.0, 2.0, 3.0, 1.0];
        let seen: Vec<f32> = (0..3).map(|j| (0..4).map(|i| point[i] * m[4 * i + j]).sum()).collect();
        assert!(seen.iter().zip([1.0, 0.0, -4.0]).all(|(a, b)| (a - b).abs() < 1e-6), "{seen:?}");
    }

    #[test]
    fn equal_pictures_are_equal_files() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.exr");
        let pixels = (0..600 * 400_u64).map(|k| Rgb::splat((k * k % 1009) as f32)).collect();
        let image = LinearImage { width: 600, height: 400, pixels };
        let file = || {
            write_exr(&path, &image).unwrap();
            fs::read(&path).unwrap()
        };
        let first = file();
        assert!((0..20).all(|_| file() == first));
    }

    #[test]
    fn halves_and_further_channels_are_read() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.exr");
        let halves = |x: f32| FlatSamples::F16((0..6).map(|k| f16::from_f32(x + k as f32)).collect());
        let channels = ["A", "B", "G", "R", "depth"].map(|name| AnyChannel::new(name, halves(name.len() as f32)));
        let size = exr::math::Vec2(3usize, 2usize);
        Image::from_channels(size, AnyChannels::sort(channels.into_iter().collect())).write().to_file(&path).unwrap();
        let read = read_exr(&path).unwrap();
        assert_eq!((read.width, read.height, read.pixels[5]), (3, 2, Rgb::splat(6.0)));
    }

    /// The data window of a header is at a fixed place in files of the program: the test writes another one there.
    #[test]
    fn huge_windows_take_no_memory() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.exr");
        write_exr(&path, &image()).unwrap();
        let bytes = fs::read(&path).unwrap();
        let name = b"dataWindow\0box2i\0";
        let at = bytes.windows(name.len()).position(|window| window == name).unwrap() + name.len() + 4;
        for (size, phrase) in [(200_000, "expected at most 16384"), (16_384, "not an OpenEXR image")] {
            let mut bytes = bytes.clone();
            for corner in [at + 8, at + 12] {
                bytes[corner..corner + 4].copy_from_slice(&(size - 1i32).to_le_bytes());
            }
            fs::write(&path, &bytes).unwrap();
            let error = read_exr(&path).unwrap_err().to_string();
            assert!(error.contains("a.exr") && (error.contains(phrase) || error.contains("ends before")), "{error}");
        }
    }

    #[test]
    fn broken_files_are_refused() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.exr");
        write_exr(&path, &image()).unwrap();
        let bytes = fs::read(&path).unwrap();
        for length in (0..bytes.len()).step_by(7) {
            fs::write(&path, &bytes[..length]).unwrap();
            assert!(matches!(read_exr(&path), Err(ImageError::Content { .. })), "cut after {length} bytes");
        }
    }
}
