//! Surfaces to and from other programs.

use crate::support::patchlight;
use patchlight::geometry::bezier::{ControlNet, PatchFormat};
use patchlight::scene::{SceneFile, Shape};
use std::collections::HashMap;
use std::fs;
use std::path::Path;

fn exported(dir: &Path, arguments: &[&str], name: &str) -> Vec<u8> {
    let path = dir.join(name);
    let output = patchlight(dir, &[&["export"], arguments, &["-o", path.to_str().unwrap()]].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    fs::read(path).unwrap()
}

fn nets(bytes: &[u8], format: PatchFormat) -> Vec<ControlNet> {
    format.read(str::from_utf8(bytes).unwrap()).unwrap()
}

#[test]
fn free_form_obj_holds_the_same_patches_as_bpt() {
    let dir = tempfile::tempdir().unwrap();
    let obj = nets(&exported(dir.path(), &["teapot", "--free-form"], "pot.obj"), PatchFormat::Obj);
    assert_eq!(obj, nets(&exported(dir.path(), &["teapot"], "pot.bpt"), PatchFormat::Bpt));
    let output = patchlight(dir.path(), &["export", "teapot", "--free-form", "-o", "pot.stl"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(!dir.path().join("pot.stl").exists());
}

/// Every edge of the lens, a closed body, is shared by two triangles in opposite directions, and its volume is above 0: it faces out.
#[test]
fn an_stl_of_a_closed_body_is_watertight() {
    let dir = tempfile::tempdir().unwrap();
    let bytes = exported(dir.path(), &["lens", "--steps", "8"], "lens.stl");
    let triangles = bytes[84..].chunks_exact(50);
    assert_eq!(triangles.len(), u32::from_le_bytes(bytes[80..84].try_into().unwrap()) as usize);
    assert_eq!(bytes.len(), 84 + 50 * triangles.len());
    let float = |bytes: &[u8]| f32::from_le_bytes(bytes.try_into().unwrap());
    let (mut edges, mut volume) = (HashMap::<[[u32; 3]; 2], i32>::new(), 0.0);
    for triangle in triangles {
        let corners: Vec<[f32; 3]> = (1..4).map(|k| [0, 4, 8].map(|at| float(&triangle[12 * k + at..][..4]))).collect();
        for k in 0..3 {
            let [a, b] = [corners[k], corners[(k + 1) % 3]].map(|corner| corner.map(|x| (x + 0.0).to_bits()));
            *edges.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
        }
        let [a, b, c] = [0, 1, 2].map(|k| glam::Vec3::from_array(corners[k]).as_dvec3());
        volume += a.dot(b.cross(c)) / 6.0;
    }
    assert!(edges.values().all(|sum| *sum == 0), "an edge lacks its other side");
    assert!(volume > 0.1, "{volume}");
}

#[test]
fn a_step_file_has_a_surface_for_each_patch() {
    let dir = tempfile::tempdir().unwrap();
    let text = String::from_utf8(exported(dir.path(), &["lens"], "lens.step")).unwrap();
    let file = SceneFile::built_in("lens").unwrap();
    let patches = |shape: &Shape| if let Shape::Bezier(bezier) = shape { bezier.patches.len() } else { 0 };
    let expected: usize = file.scene.objects.iter().map(|object| patches(&object.shape)).sum();
    assert_eq!(text.matches("=B_SPLINE_SURFACE_WITH_KNOTS('',3,3,").count(), expected);
    assert!(text.starts_with("ISO-10303-21;") && text.ends_with("END-ISO-10303-21;\n"));
}

/// A hill, as each program writes it.
fn files() -> [(&'static str, String); 4] {
    let height = |i: usize, j: usize| if (1..3).contains(&i) && (1..3).contains(&j) { 1.5 } else { 0.0 };
    let points = || (0..16).map(|k| (k / 4, k % 4)).map(|(i, j)| [i as f64, height(i, j), j as f64]);
    let joined =
        |separator: &str, write: &dyn Fn([f64; 3]) -> String| points().map(write).collect::<Vec<_>>().join(separator);
    let numbers = (1..=16).map(|k| k.to_string()).collect::<Vec<_>>();
    let bpt = format!("1\n{}\n16\n{}\n", numbers.join(","), joined("\n", &|[x, y, z]| format!("{x},{y},{z}")));
    let vertices = joined("\n", &|[x, y, z]| format!("v {x} {y} {z}"));
    let obj = format!(
        "{vertices}\ncstype bezier\ndeg 3 3\nsurf 0 1 0 1 {}\nparm u 0 1\nparm v 0 1\nend\n",
        numbers.join(" ")
    );
    let vectors = joined(", ", &|[x, y, z]| format!("<{x}, {y}, {z}>"));
    let pov = format!(
        "camera {{ location <0, 2, -5> }}\nbicubic_patch {{ type 1 u_steps 4 v_steps 4 {vectors} pigment {{ rgb 1 }} }}\n"
    );
    let rib = format!(
        "WorldBegin\nPatch \"bicubic\" \"P\" [{}]\nWorldEnd\n",
        joined(" ", &|[x, y, z]| format!("{x} {y} {z}"))
    );
    [("bpt", bpt), ("obj", obj), ("pov", pov), ("rib", rib)]
}

#[test]
fn patches_of_other_programs_are_rendered_and_named_by_scenes() {
    let dir = tempfile::tempdir().unwrap();
    for (extension, text) in files() {
        let name = format!("hill.{extension}");
        fs::write(dir.path().join(&name), text).unwrap();
        let arguments = ["render", &name, "--size", "32x32", "--iterations", "1", "-o", "hill.png"];
        let output = patchlight(dir.path(), &arguments);
        assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
        assert!(fs::metadata(dir.path().join("hill.png")).unwrap().len() > 200);
        let material = "version = 1\n[camera]\nposition = [1, 3, 9]\ntarget = [1, 0, 1]\nfov_y = 30\n[[material]]\nname = \"m\"\ntype = \"diffuse\"\nalbedo = [0.5, 0.5, 0.5]\n";
        let object = format!("[[object]]\nname = \"hill\"\ntype = \"bezier\"\nmaterial = \"m\"\nfile = \"{name}\"\n");
        fs::write(dir.path().join("hill.toml"), format!("{material}{object}")).unwrap();
        let file = SceneFile::open(&dir.path().join("hill.toml")).unwrap();
        let Shape::Bezier(bezier) = &file.scene.objects[0].shape else { panic!("{name}") };
        assert_eq!((bezier.patches.len(), bezier.patches[0].points[1][2].y), (1, 1.5), "{name}");
    }
}

#[test]
fn a_mesh_is_refused_with_its_reason() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("mesh.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let output = patchlight(dir.path(), &["check", "mesh.obj"]);
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(message.contains("mesh.obj: line 4: the file holds a mesh (f)"), "{message}");
}
