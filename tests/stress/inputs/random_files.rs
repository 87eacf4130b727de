//! Random files with the structure of their kind and extreme values in it.

use super::corpus::{exr_bytes, film_bytes};
use super::edits::NUMBERS;
use flate2::{Compression, Crc, read::DeflateDecoder, write::DeflateEncoder};
use glam::DVec3;
use image::{DynamicImage, ImageFormat};
use patchlight::film::LinearImage;
use patchlight::geometry::bezier::{ControlNet, write_bpt};
use patchlight::math::Rgb;
use proptest::{array::uniform3, collection::vec, prelude::*, sample::select};
use std::io::{Cursor, Read, Write};

/// Numbers of every size, most of them ordinary.
fn number() -> BoxedStrategy<String> {
    prop_oneof![4 => (-2.0..2.0f64).prop_map(|x| format!("{x:?}")), 1 => select(&NUMBERS[..]).prop_map(str::to_owned)]
        .boxed()
}

fn numbers(count: usize) -> BoxedStrategy<String> {
    vec(number(), count).prop_map(|numbers| format!("[{}]", numbers.join(", "))).boxed()
}

/// A value of any type.
fn value() -> BoxedStrategy<String> {
    let word =
        select(&["\"\"", "\"ball\"", "\"glass\"", "\"quad\"", "\"sphere\"", "true", "[]", "{}", "'", "1979-05-27"][..]);
    prop_oneof![3 => number(), 3 => numbers(3), 1 => numbers(2), 2 => word.prop_map(str::to_owned)].boxed()
}

/// A scene of right tables with extreme numbers, or of wrong tables.
pub(super) fn scene() -> BoxedStrategy<Vec<u8>> {
    let text = prop_oneof![3 => right_tables(), 1 => wrong_tables()];
    text.prop_map(|text| format!("version = 1\n{text}").into_bytes()).boxed()
}

fn right_tables() -> BoxedStrategy<String> {
    let of = |(head, keys): (&'static str, &'static [(&'static str, usize)])| {
        let lines = keys.iter().map(|(key, count)| {
            let value = if *count == 1 { number() } else { numbers(*count) };
            value.prop_map(move |value| format!("{key} = {value}\n"))
        });
        lines.collect::<Vec<_>>().prop_map(move |lines| format!("{head}\n{}", lines.concat()))
    };
    let object = prop_oneof![
        of(("type = \"quad\"", &[("corner", 3), ("edge_u", 3), ("edge_v", 3)])),
        of(("type = \"sphere\"", &[("center", 3), ("radius", 1)])),
        of(("type = \"plane\"", &[("point", 3), ("normal", 3)])),
        vec(numbers(3), 16).prop_map(|points| {
            let rows: Vec<String> = points.chunks(4).map(|row| format!("[{}]", row.join(", "))).collect();
            format!("type = \"bezier\"\npatches = [[{}]]\n", rows.join(", "))
        }),
    ];
    let material = select(&["white", "glass", "mirror", "gloss"][..]);
    let objects = vec((object, material), 0..6).prop_map(|objects| {
        let table = |(k, (shape, material)): (usize, &(String, &str))| {
            format!("[[object]]\nname = \"o{k}\"\nmaterial = \"{material}\"\n{shape}")
        };
        objects.iter().enumerate().map(table).collect::<String>()
    });
    let light = prop_oneof![
        of(("type = \"point\"", &[("position", 3), ("intensity", 3)])),
        of(("type = \"sphere\"", &[("center", 3), ("radius", 1), ("radiance", 3)])),
        of(("type = \"quad\"", &[("corner", 3), ("edge_u", 3), ("edge_v", 3), ("radiance", 3)])),
        of(("type = \"sun\"", &[("direction", 3), ("irradiance", 3), ("diameter", 1)])),
        of(("type = \"beam\"", &[("center", 3), ("direction", 3), ("radius", 1), ("power", 3)])),
    ];
    // Without negative numbers, most lights are valid.
    let lights = vec(light, 0..3).prop_map(|lights| {
        let table = |(k, light): (usize, &String)| format!("[[light]]\nname = \"l{k}\"\n{}", light.replace('-', ""));
        lights.iter().enumerate().map(table).collect::<String>()
    });
    let camera = of(("[camera]", &[("position", 3), ("target", 3)]));
    (camera, objects, lights)
        .prop_map(|(camera, objects, lights)| format!("{camera}{MATERIALS}{objects}{lights}"))
        .boxed()
}

const MATERIALS: &str = "[[material]]\nname = \"white\"\ntype = \"diffuse\"\nalbedo = [0.8, 0.8, 0.8]
[[material]]\nname = \"glass\"\ntype = \"glass\"\nior = 1.5\nabsorption = [0.1, 0, 0]
[[material]]\nname = \"mirror\"\ntype = \"mirror\"\nreflectance = [1, 1, 1]
[[material]]\nname = \"gloss\"\ntype = \"phong\"\nalbedo = [0.4, 0.4, 0.4]\nspecular = [0.5, 0.5, 0.5]\nexponent = 20\n";

fn wrong_tables() -> BoxedStrategy<String> {
    let head = select(
        &[
            "[camera]",
            "[film]",
            "[render]",
            "[[texture]]",
            "[[material]]",
            "[[light]]",
            "[[object]]",
            "[[x.y]]",
            "[object]",
        ][..],
    );
    let keys = [
        "name",
        "type",
        "material",
        "position",
        "radius",
        "albedo",
        "file",
        "patches",
        "width",
        "fov_y",
        "priority",
        "transform",
        "x",
    ];
    let line = (select(keys.to_vec()), value()).prop_map(|(key, value)| format!("{key} = {value}\n"));
    let table = (head, vec(line, 0..6)).prop_map(|(head, lines)| format!("{head}\n{}", lines.concat()));
    vec(table, 0..8).prop_map(|tables| tables.concat()).boxed()
}

/// Up to three patches of points of every size.
pub(super) fn patches() -> BoxedStrategy<Vec<u8>> {
    let coordinate =
        prop_oneof![6 => -2.0..2.0f64, 1 => select(vec![0.0, 1e-300, 1e300, -1e300, 1e9, f64::MIN_POSITIVE, f64::MAX])];
    let net = vec(uniform3(coordinate), 16).prop_map(|points| ControlNet {
        points: std::array::from_fn(|i| std::array::from_fn(|j| DVec3::from_array(points[4 * i + j]))),
    });
    vec(net, 0..4).prop_map(|nets| write_bpt(&nets).into_bytes()).boxed()
}

/// A picture of every depth as a PNG or JPEG file, perhaps cut off.
pub(super) fn texture() -> BoxedStrategy<Vec<u8>> {
    let picture = (1u32..40, 1u32..40, 0usize..6, any::<u8>()).prop_map(|(width, height, depth, shade)| {
        let mut grey = image::GrayImage::new(width, height);
        grey.pixels_mut().enumerate().for_each(|(k, pixel)| pixel.0 = [(k as u8).wrapping_mul(shade)]);
        let grey = DynamicImage::ImageLuma8(grey);
        match depth {
            0 => grey,
            1 => grey.to_luma_alpha8().into(),
            2 => grey.to_rgb8().into(),
            3 => grey.to_rgba8().into(),
            4 => grey.to_luma16().into(),
            _ => grey.to_rgb16().into(),
        }
    });
    let encoded = |(picture, is_png, kept): (DynamicImage, bool, f64)| {
        let mut bytes = Cursor::new(Vec::new());
        // JPEG has neither alpha nor 16 bits.
        let (picture, format) =
            if is_png { (picture, ImageFormat::Png) } else { (picture.to_rgb8().into(), ImageFormat::Jpeg) };
        picture.write_to(&mut bytes, format).expect("the picture can be encoded");
        let mut bytes = bytes.into_inner();
        bytes.truncate((bytes.len() as f64 * kept.min(1.0)) as usize);
        bytes
    };
    (picture, any::<bool>(), 0.5..2.0f64).prop_map(encoded).boxed()
}

/// A picture of any floats.
pub(super) fn exr() -> BoxedStrategy<Vec<u8>> {
    let size = (1u32..20, 1u32..20);
    let picture = size.prop_flat_map(|(width, height)| {
        let pixels = vec(uniform3(any::<u32>()), (width * height) as usize);
        pixels.prop_map(move |pixels| LinearImage {
            width,
            height,
            pixels: pixels.into_iter().map(|bits| Rgb::from_array(bits.map(f32::from_bits))).collect(),
        })
    });
    picture.prop_map(|picture| exr_bytes(&picture)).boxed()
}

/// A table with the columns in any order and numbers of every size.
pub(super) fn rays() -> BoxedStrategy<Vec<u8>> {
    let columns = Just(vec!["ox", "oy", "oz", "dx", "dy", "dz", "tmin", "id"]).prop_shuffle();
    let rows = vec(vec(number(), 8), 0..20);
    let text = |(columns, rows): (Vec<&str>, Vec<Vec<String>>)| {
        let lines = rows.iter().map(|row| row.join(","));
        [columns.join(",")].into_iter().chain(lines).collect::<Vec<_>>().join("\n").into_bytes()
    };
    (columns, rows).prop_map(text).boxed()
}

/// Bytes of a checkpoint before its head: a name, format, length of the head, length and checksum of the body, checksum of these and the
/// head.
const FIELDS: usize = 32;

/// A film with changed bytes in its packed part, and the checksums of these bytes: as a hostile writer would make it.
pub(super) fn film() -> BoxedStrategy<Vec<u8>> {
    let film = film_bytes(5);
    let head = FIELDS + u32::from_le_bytes([film[12], film[13], film[14], film[15]]) as usize;
    let mut body = Vec::new();
    DeflateDecoder::new(&film[head..]).read_to_end(&mut body).expect("a packed body");
    let change = (any::<prop::sample::Index>(), select(vec![0u8, 1, 2, 0x7f, 0x80, 0xf0, 0xff]));
    let changed = move |changes: Vec<(prop::sample::Index, u8)>| {
        let (mut body, length) = (body.clone(), body.len());
        changes.into_iter().for_each(|(at, byte)| body[at.index(length)] = byte);
        let mut packed = DeflateEncoder::new(Vec::new(), Compression::fast());
        packed.write_all(&body).expect("memory takes all");
        let packed = packed.finish().expect("memory takes all");
        let mut film = film[..head].to_vec();
        film[16..24].copy_from_slice(&(packed.len() as u64).to_le_bytes());
        film[24..28].copy_from_slice(&checksum(&[&packed]).to_le_bytes());
        let of_head = checksum(&[&film[..28], &film[FIELDS..]]);
        film[28..32].copy_from_slice(&of_head.to_le_bytes());
        [film, packed].concat()
    };
    vec(change, 1..6).prop_map(changed).boxed()
}

fn checksum(parts: &[&[u8]]) -> u32 {
    let mut checksum = Crc::new();
    parts.iter().for_each(|part| checksum.update(part));
    checksum.sum()
}
