use crate::scene::{Location, MaterialModel, Scene, SceneError, SceneFile, Shape};

const HEAD: &str = "version = 1\n[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 0]\nfov_y = 40\n";

fn parse(text: &str) -> Result<Scene, SceneError> {
    SceneFile::parse(text, Location::BuiltIn("test".to_owned())).map(|file| file.scene)
}

/// The problems of a text after a valid head, as `line:column: path: message`, lines counted after the head.
fn problems(rest: &str) -> Vec<String> {
    match parse(&format!("{HEAD}{rest}")) {
        Ok(_) => Vec::new(),
        Err(SceneError::Invalid { problems, .. }) => {
            let head = HEAD.lines().count();
            problems
                .iter()
                .map(|p| format!("{}:{}: {}", p.line as isize - head as isize, p.column, p.problem))
                .collect()
        }
        Err(other) => panic!("{other}"),
    }
}

#[test]
fn an_empty_scene_is_a_scene() {
    let scene = parse(HEAD).unwrap();
    assert_eq!(scene.film.width, 512);
    assert_eq!(scene.camera.up, glam::DVec3::Y);
}

#[test]
fn all_problems_are_reported_in_order() {
    let found = problems(
        r#"
[film]
widht = 256
exposure = "bright"

[[material]]
name = "glass"
type = "glas"
index = 1.5

[[object]]
name = "ball"
type = "sphere"
center = [0, 0]
radius = -0.5
material = "galss"
"#,
    );
    let expected = [
        "3:1: film.widht: unknown key, expected one of width, height, exposure, tone_curve; did you mean \"width\"?",
        "4:12: film.exposure: found the string \"bright\", expected a number",
        "8:8: material[0].type: found \"glas\", expected one of diffuse, phong, polished, mirror, glass; \
         did you mean \"glass\"?",
        "14:10: object[0].center: found a list of 2, expected three numbers like [0.0, 1.0, 0.0]",
        "15:10: object[0].radius: found -0.5, expected a number from 1e-9 to 1000000000.0",
        "16:12: object[0].material: found \"galss\", expected the name of a material; did you mean \"glass\"?",
    ];
    assert_eq!(found, expected);
}

/// Every kind of mistake in a scene of its own, with the expected message.
#[test]
fn mistakes_are_named() {
    let cases = [
        (
            "[[light]]\nname = \"a\"\n",
            "1:1: light[0]: the key `type` is missing, expected one of point, sphere, quad, sun, beam",
        ),
        ("[[light]]\nname = \"a\"\ntype = 3\n", "3:8: light[0].type: found the number 3, expected a string"),
        ("[light]\nname = \"a\"\n", "1:1: light: found a table, expected a list, each of them a table [[light]]"),
        ("material = [1]\n", "1:1: camera.material: unknown key, expected one of position, target, up, fov_y"),
        ("[render]\nmax_bounces = 0\n", "2:15: render.max_bounces: found 0, expected 1 to 1024"),
        ("[render]\nmax_bounces = -3\n", "found the number -3, expected 1 or more"),
        (
            "[render]\nbackground = [nan, 0, 0]\n",
            "2:15: render.background[0]: found the number nan, expected a finite number",
        ),
        ("[render]\nbackground = [0, 1e39, 0]\n", "2:18: render.background[1]: found the number 1e39"),
        ("[film]\nexposure = 1e999\n", "2:12: film.exposure: found the number 1e999, expected a finite number"),
        (
            "[film]\ntone_curve = \"filmc\"\n",
            "found the string \"filmc\", expected \"srgb\" or \"filmic\"; did you mean \"filmic\"?",
        ),
        ("[film]\nwidth = 0\nheight = 99999\n", "2:9: film.width: found 0, expected 1 to 16384 pixels"),
        ("[[texture]]\nname = \"t\"\nfile = \"no.png\"\n", "3:8: texture[0].file: \"no.png\" cannot be read"),
        (
            "[[material]]\nname = \"m\"\ntype = \"diffuse\"\nalbedo = 0.5\n",
            "4:10: material[0].albedo: found the number 0.5",
        ),
        (
            "[[material]]\nname = \"m\"\ntype = \"diffuse\"\nalbedo = [0.5, 0.5, 1.5]\n",
            "expected 0 to 1 in each channel",
        ),
        (
            "[[material]]\nname = \"m\"\ntype = \"polished\"\nalbedo = [0.5, 0.5, 0.5]\nreflectance = [0.6, 0, 0]\n",
            "5:15: material[0].reflectance: found [0.6, 0, 0]; with albedo [0.5, 0.5, 0.5] the sum exceeds 1",
        ),
        ("[[material]]\nname = \"m\"\ntype = \"diffuse\"\n", "1:1: material[0]: the key `albedo` is missing"),
        (
            "[[material]]\nname = \"m\"\ntype = \"diffuse\"\nalbedo = { texture = \"x\", sclae = [1, 1] }\n",
            "4:27: material[0].albedo.sclae: unknown key, expected one of texture, scale; did you mean \"scale\"?",
        ),
        (
            "[[object]]\nname = \"s\"\ntype = \"bezier\"\nmaterial = \"m\"\n",
            "one of the keys `patches` and `file` is missing",
        ),
        (
            "[[object]]\nname = \"s\"\ntype = \"bezier\"\nmaterial = \"m\"\npatches = [[[0]]]\n",
            "patches[0]: found a list of 1, expected 4 rows",
        ),
        ("[[object]]\nname = \"s\"\ntype = \"bezier\"\nmaterial = \"m\"\npatches = []\n", "patches: found no patch"),
        (
            "[[object]]\nname = \"s\"\ntype = \"bezier\"\nmaterial = \"m\"\nfile = \"no.bpt\"\n",
            "5:8: object[0].file: \"no.bpt\" cannot be read",
        ),
        ("[film]\nwidth = \n", "2:9: expected a value after `=`, found none"),
        ("[film]\nwidth = 1\nwidth = 2\n", "3:1: found the key `width` for the second time"),
        (
            "[[texture]]\nname = \"t\"\nfile = \"report.toml\"\n",
            "3:8: texture[0].file: \"report.toml\" is not a valid PNG or JPEG image",
        ),
    ];
    for (text, expected) in cases {
        let found = problems(text);
        assert!(found.iter().any(|p| p.contains(expected)), "{text}\nshould say {expected}\nbut says {found:#?}");
    }
}

#[test]
fn mistakes_in_texture_coordinates_are_located() {
    let row = "[[0,0,0],[0,0,1],[0,0,2],[0,0,3]],[[1,0,0],[1,1,1],[1,1,2],[1,0,3]]";
    let net = format!("[{row},{}]", row.replace("[1,", "[3,").replace("[0,", "[2,"));
    let cases = [
        ("[[0, 0, 1, 1], [0, 0, 1, 1]]", "10:6: object[0].uv: found 2, expected a rectangle for each patch: 1"),
        ("[]", "10:6: object[0].uv: found 0, expected a rectangle for each patch: 1"),
        ("[[0, 0, 1]]", "10:7: object[0].uv[0]: found a list of 3, expected four numbers like"),
        ("[[0, 0, 1, inf]]", "10:17: object[0].uv[0][3]: found the number inf, expected a finite number"),
        ("[[0, 0.5, 1, 0.5]]", "10:7: object[0].uv[0]: found [0.0, 0.5, 1.0, 0.5], expected [u0, v0, u1, v1]"),
        ("[[0, 0, 2e9, 1]]", "10:7: object[0].uv[0]: found [0.0, 0.0, 2000000000.0, 1.0], expected"),
    ];
    for (uv, expected) in cases {
        let text = format!(
            "[[material]]\nname = \"m\"\ntype = \"mirror\"\nreflectance = [1, 1, 1]\n[[object]]\nname = \"s\"\n\
             type = \"bezier\"\nmaterial = \"m\"\npatches = [{net}]\nuv = {uv}\n"
        );
        let found = problems(&text);
        assert!(found.len() == 1 && found[0].starts_with(expected), "{uv}\nshould say {expected}\nbut says {found:#?}");
    }
}

#[test]
fn one_mistake_is_one_problem() {
    // The material has a name although its type is unknown: the object that uses it is not blamed.
    let text = "[[material]]\nname = \"m\"\ntype = \"paint\"\n[[object]]\nname = \"s\"\ntype = \"sphere\"\n\
                center = [0, 0, 0]\nradius = 1\nmaterial = \"m\"\n";
    assert_eq!(problems(text).len(), 1);
    // An unreadable list hides wrong references to it.
    let text = "[material]\nname = \"m\"\ntype = \"mirror\"\nreflectance = [1, 1, 1]\n[[object]]\nname = \"s\"\n\
                type = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"m\"\n";
    assert_eq!(problems(text).len(), 1);
}

#[test]
fn keys_with_too_many_points_are_located() {
    let deep = ".a".repeat(50_000);
    for (text, place) in [(format!("[film]\nwidth = 64\n  a{deep} = 1\n"), "3:3"), (format!("\n[a{deep}]\n"), "2:1")] {
        let found = problems(&text);
        assert!(found.len() == 1 && found[0].starts_with(&format!("{place}: ")), "{place}: {found:?}");
        assert!(found[0].ends_with("found a key with too many points: no table of a scene is nested so deeply"));
    }
}

#[test]
fn a_missing_patch_file_is_one_problem() {
    let text = "[[material]]\nname = \"m\"\ntype = \"mirror\"\nreflectance = [1, 1, 1]\n[[object]]\nname = \"s\"\n\
                type = \"bezier\"\nfile = \"no.bpt\"\nmaterial = \"m\"\n";
    assert_eq!(problems(text).len(), 1);
}

#[test]
fn optional_keys_have_defaults() {
    let text = format!(
        "{HEAD}[[material]]\nname = \"g\"\ntype = \"glass\"\nior = 1.5\n\
         [[object]]\nname = \"p\"\ntype = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nmaterial = \"g\"\n"
    );
    let scene = parse(&text).unwrap();
    assert!(
        matches!(&scene.materials[0].model, MaterialModel::Glass { absorption, .. } if *absorption == glam::Vec3::ZERO)
    );
    assert!(matches!(scene.objects[0].shape, Shape::Plane { u_axis: None, .. }));
}

#[test]
fn decimals_are_rounded_once() {
    // Just above the middle between 1 and the next f32: rounding to f64 first would end on the middle, and then at 1.
    let text = format!("{HEAD}[render]\nbackground = [1.00000005960464477539062500001, 0, 0]\n");
    assert_eq!(parse(&text).unwrap().render.background.x, 1f32.next_up());
}

proptest::proptest! {
    /// No text makes the reader panic.
    #[test]
    fn any_text_is_read_or_refused(noise in ".{0,200}", cut in 0usize..3000) {
        let text = include_str!("../../../scenes/cornell.toml");
        let end = text.char_indices().map(|(at, _)| at).take_while(|at| *at <= cut).last().unwrap_or(0);
        drop(parse(&noise));
        drop(parse(&format!("{}{noise}{}", &text[..end], &text[end..])));
    }
}

#[test]
fn a_number_without_a_digit_beside_its_point_gets_a_hint() {
    for number in [".5", "-.5", "+.5", "5.", "-5.", "1.e5", "1e.5", "5.e"] {
        let found = problems(&format!("[film]\nexposure = {number}\n"));
        assert!(found.len() == 1 && found[0].contains("as in 0.5 and 5.0"), "{number}: {found:#?}");
    }
    for other in ["1,5", "0x1g", "a.b", "1_"] {
        let found = problems(&format!("[film]\nexposure = {other}\n"));
        assert!(found.len() == 1 && !found[0].contains("as in 0.5"), "{other}: {found:#?}");
    }
    assert_eq!(problems("[film]\nexposure = 5.\nwidth = .5 # .5\n").len(), 2, "one for each line");
}
