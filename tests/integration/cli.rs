//! The program as users and scripts call it.

use crate::support::{advanced, patchlight};
use patchlight::{
    engine::Session,
    film::ToneMap,
    scene::{SceneFile, built_in_scenes},
};
use std::{
    fs,
    path::Path,
    process::{Command, Output, Stdio},
    time::Duration,
};
use tempfile::TempDir;

const SCENE: &str = r#"version = 1
name = "a ball"

[camera]
position = [0, 0, 4]
target = [0, 0, 0]
fov_y = 40

[[material]]
name = "white"
type = "diffuse"
albedo = [0.5, 0.5, 0.5]

[[light]]
name = "lamp"
type = "point"
position = [2, 2, 2]
intensity = [10, 10, 10]

[[object]]
name = "ball"
type = "sphere"
center = [0, 0, 0]
radius = 1
material = "white"
"#;

/// A folder with the scene `ball.toml` in it.
fn folder() -> TempDir {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("ball.toml"), SCENE).unwrap();
    dir
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

/// Asserts that the program ended with this code and without a panic, and that its message has all these phrases.
fn fails(output: &Output, code: i32, phrases: &[&str]) {
    let message = stderr(output);
    assert_eq!(output.status.code(), Some(code), "{message}");
    assert!(!message.contains("panicked"), "{message}");
    for phrase in phrases {
        assert!(message.contains(phrase), "should say {phrase:?}, but says\n{message}");
    }
}

fn names(dir: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(dir).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn renders_png_exr_and_statistics() {
    let dir = folder();
    let budget = ["--iterations", "3", "--size", "40x30", "--threads", "1"];
    let run = |out: &str, more: &[&str]| {
        let output = patchlight(dir.path(), &[&["render", "ball.toml", "-o", out], &budget[..], more].concat());
        assert!(output.status.success(), "{}", stderr(&output));
    };
    run("a.png", &["--stats", "a.json"]);
    run("a.exr", &[]);
    run("b.exr", &[]);
    run("c.exr", &["--seed", "1"]);
    let png = image::open(dir.path().join("a.png")).unwrap().into_rgb8();
    assert_eq!(png.dimensions(), (40, 30));
    assert_eq!(png.get_pixel(0, 0).0, [0, 0, 0], "the corner shows the black background");
    assert!(png.get_pixel(23, 10).0[0] > 100, "the side towards the light, above and to the right, is bright");
    let read = |name: &str| fs::read(dir.path().join(name)).unwrap();
    assert_eq!(read("a.exr"), read("b.exr"), "the same seed, the same picture");
    assert_ne!(read("a.exr"), read("c.exr"), "another seed, another noise");
    let stats: serde_json::Value = serde_json::from_slice(&read("a.json")).unwrap();
    for (key, value) in [("iterations", 3), ("width", 40), ("height", 30), ("threads", 1), ("dropped_samples", 0)] {
        assert_eq!(stats[key], value, "{key}");
    }
    for key in ["photons_emitted", "rays", "seconds", "cpu_seconds", "error_estimate"] {
        assert!(stats[key].is_number(), "{key} in {stats}");
    }
    assert!(stats["counters"]["shadow_rays"].as_u64().is_some_and(|n| n > 0), "{stats}");
    assert_eq!(stats["counters"]["caustic_gathers"], 0, "there is no mirror");
    for component in ["caustics", "interreflection"] {
        for balance in ["path_balance", "photon_balance"] {
            let balance = stats["energy"][component][balance].as_f64();
            assert!(balance.is_some_and(|lost| lost.abs() < 1e-6), "{component}: {stats}");
        }
    }
    for component in ["caustics", "interreflection"] {
        let balance = &stats["energy"][component];
        assert!(balance["worst_balance"].as_f64().is_some_and(|lost| lost < 1e-6), "{stats}");
        assert!(balance["worst_iteration"].as_u64().is_some_and(|iteration| iteration > 0), "{stats}");
    }
    assert!(stats["plan"].as_array().is_some_and(|plan| !plan.is_empty()), "{stats}");
}

#[test]
fn one_thread_and_three_give_the_same_bits() {
    let dir = folder();
    for (out, threads) in [("one.exr", "1"), ("three.exr", "3")] {
        let fixed = ["render", "report", "--iterations", "2", "--size", "48x48", "-o", out, "--threads", threads];
        assert!(patchlight(dir.path(), &fixed).status.success());
    }
    assert_eq!(fs::read(dir.path().join("one.exr")).unwrap(), fs::read(dir.path().join("three.exr")).unwrap());
}

#[test]
fn rendering_ends_within_its_seconds() {
    let dir = folder();
    let run = patchlight(
        dir.path(),
        &["render", "ball.toml", "-o", "a.png", "--seconds", "0.5", "--size", "32x32", "--stats", "a.json"],
    );
    assert!(run.status.success(), "{}", stderr(&run));
    let stats: serde_json::Value = serde_json::from_slice(&fs::read(dir.path().join("a.json")).unwrap()).unwrap();
    let seconds = stats["seconds"].as_f64().unwrap();
    // It ends before the iteration that would end too late; only the length of that iteration is unknown, and it is tiny here.
    assert!(seconds > 0.1 && seconds < 0.7, "{seconds}");
}

#[test]
fn a_black_scene_ends_by_error_too() {
    let dir = folder();
    fs::write(dir.path().join("dark.toml"), SCENE.replace("[10, 10, 10]", "[0, 0, 0]")).unwrap();
    let run = patchlight(dir.path(), &["render", "dark.toml", "-o", "a.png", "--error", "0.01", "--size", "16x16"]);
    assert!(run.status.success(), "{}", stderr(&run));
}

/// The picture so far is written, and the exit code is the one that shells expect.
#[cfg(unix)]
#[test]
fn signals_end_a_rendering_with_its_picture() {
    let dir = folder();
    for (signal, code) in [("INT", 130), ("TERM", 143)] {
        let output = format!("{signal}.exr");
        let run = Command::new(env!("CARGO_BIN_EXE_patchlight"))
            .args(["render", "ball.toml", "-o", &output, "--seconds", "60", "--size", "64x64", "--threads", "1"])
            .current_dir(dir.path())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        // The first iterations take milliseconds; a signal before them would end with one iteration, too.
        std::thread::sleep(Duration::from_secs(1));
        let kill = Command::new("kill").args(["-s", signal, &run.id().to_string()]).status().unwrap();
        assert!(kill.success());
        let ended = run.wait_with_output().unwrap();
        fails(&ended, code, &[&output, "iteration", "ended early by SIG"]);
        let picture = patchlight::film::read_exr(&dir.path().join(&output)).unwrap();
        assert!(picture.pixels.iter().any(|p| p.x > 0.0), "the ball is there");
    }
}

#[test]
fn a_file_of_control_points_is_shown_as_a_scene() {
    let dir = folder();
    let patch = "# one patch\n1\n3 3\n0 0 0 0 0 1 0 0 2 0 0 3  1 0 0 1 1 1 1 1 2 1 0 3
        2 0 0 2 1 1 2 1 2 2 0 3  3 0 0 3 0 1 3 0 2 3 0 3 # the last row\n";
    fs::write(dir.path().join("sheet.bpt"), patch).unwrap();
    let run = patchlight(dir.path(), &["render", "sheet.bpt", "-o", "a.exr", "--iterations", "2", "--size", "48x48"]);
    assert!(run.status.success(), "{}", stderr(&run));
    let picture = patchlight::film::read_exr(&dir.path().join("a.exr")).unwrap();
    // The patch of albedo 0.7 fills the middle, under a light that would give a radiance of 0.7 where it falls straight.
    let middle = picture.pixels[24 * 48 + 24].x;
    assert!((0.3..0.8).contains(&middle), "{middle}");
    fs::write(dir.path().join("sheet.bpt"), "1\n3 3\n0 0").unwrap();
    fails(&patchlight(dir.path(), &["check", "sheet.bpt"]), 2, &["sheet.bpt: line 3: the file ends"]);
    fs::write(dir.path().join("sheet.bpt"), format!("1\n3 3\n{}", "0 0 0\n".repeat(16))).unwrap();
    fails(&patchlight(dir.path(), &["check", "sheet.bpt"]), 2, &["sheet.bpt", "all control points are the same point"]);
    fs::write(dir.path().join("sheet.bpt"), "7".repeat(1_000_000)).unwrap();
    let long = patchlight(dir.path(), &["check", "sheet.bpt"]);
    fails(&long, 2, &["sheet.bpt: line 1"]);
    assert!(stderr(&long).len() < 2000, "the number is not printed whole");
    fs::write(dir.path().join("sheet.bpt"), "0\n").unwrap();
    assert!(patchlight(dir.path(), &["check", "sheet.bpt"]).status.success(), "no patch is no error");
}

#[test]
fn two_pictures_are_compared_in_numbers_and_colours() {
    let dir = folder();
    for (seed, name) in [("1", "a.exr"), ("2", "b.exr"), ("1", "c.exr")] {
        let arguments = ["render", "ball.toml", "-o", name, "--iterations", "2", "--size", "32x32", "--seed", seed];
        assert!(patchlight(dir.path(), &arguments).status.success());
    }
    let compared = |arguments: &[&str]| {
        let run = patchlight(dir.path(), &[&["compare"], arguments].concat());
        assert!(run.status.success(), "{}", stderr(&run));
        String::from_utf8(run.stdout).unwrap()
    };
    let same = compared(&["a.exr", "c.exr"]);
    assert!(same.contains("pixels          1024") && same.contains("RMSE            0.000000e0"), "{same}");
    let other = compared(&["a.exr", "b.exr", "-o", "difference.png"]);
    assert!(!other.contains("RMSE            0.000000e0"), "{other}");
    let colors = image::open(dir.path().join("difference.png")).unwrap().into_rgb8();
    let [first, ..] = colors.pixels().collect::<Vec<_>>()[..] else { panic!("there are pixels") };
    assert!(colors.dimensions() == (32, 32) && colors.pixels().any(|pixel| pixel != first), "there is noise");
    fails(&patchlight(dir.path(), &["compare", "a.exr", "b.exr", "-o", "a.exr"]), 2, &["ends in .png"]);
    fails(&patchlight(dir.path(), &["compare", "a.exr", "missing.exr"]), 2, &["missing.exr: cannot be read"]);
    let small = ["render", "ball.toml", "-o", "small.exr", "--iterations", "1", "--size", "16x16"];
    assert!(patchlight(dir.path(), &small).status.success());
    fails(&patchlight(dir.path(), &["compare", "a.exr", "small.exr"]), 2, &["16 x 16", "32 x 32"]);
}

/// The scene of a picture's file renders the same picture again.
#[test]
fn a_picture_tells_its_scene() {
    let dir = folder();
    let first = ["render", "ball.toml", "-o", "a.exr", "--iterations", "2", "--size", "32x24", "--seed", "5"];
    assert!(patchlight(dir.path(), &first).status.success());
    let (image, told) = patchlight::film::read_exr_with_provenance(&dir.path().join("a.exr")).unwrap();
    assert_eq!(told.iterations, 2);
    assert!(told.settings.contains(&("Seed".to_owned(), "5".to_owned())), "{:?}", told.settings);
    fs::write(dir.path().join("again.toml"), told.scene.unwrap()).unwrap();
    let again = ["render", "again.toml", "-o", "b.exr", "--iterations", "2", "--seed", "5"];
    assert!(patchlight(dir.path(), &again).status.success());
    assert_eq!(patchlight::film::read_exr(&dir.path().join("b.exr")).unwrap(), image);
    let deep = ["render", "ball.toml", "-o", "a.png", "--iterations", "1", "--size", "8x8", "--png-bits", "16"];
    assert!(patchlight(dir.path(), &deep).status.success());
    assert_eq!(image::open(dir.path().join("a.png")).unwrap().color(), image::ColorType::Rgb16);
}

#[test]
fn no_output_overwrites_the_scene_or_another_output() {
    let dir = folder();
    fs::write(dir.path().join("scene.png"), SCENE).unwrap();
    let render = |scene: &str, more: &[&str]| {
        patchlight(dir.path(), &[&["render", scene, "--iterations", "1", "--size", "8x8"], more].concat())
    };
    fails(&render("scene.png", &["-o", "./scene.png"]), 2, &["scene.png: is the scene"]);
    fails(&render("ball.toml", &["-o", "a.png", "--stats", "ball.toml"]), 2, &["ball.toml: is the scene"]);
    fails(&render("ball.toml", &["-o", "a.png", "--stats", "./a.png"]), 2, &["both the picture and the statistics"]);
    assert_eq!(fs::read_to_string(dir.path().join("scene.png")).unwrap(), SCENE, "the scene is still there");
    #[cfg(unix)]
    {
        // A link to a file that the same command writes, and that does not exist yet.
        std::os::unix::fs::symlink("later.exr", dir.path().join("link.json")).unwrap();
        let both = render("ball.toml", &["-o", "later.exr", "--stats", "link.json"]);
        fails(&both, 2, &["both the picture and the statistics"]);
    }
}

#[test]
fn no_output_overwrites_a_file_that_is_read() {
    let dir = folder();
    image::RgbImage::new(4, 4).save(dir.path().join("t.png")).unwrap();
    let textured = SCENE.to_owned() + "[[texture]]\nname = \"t\"\nfile = \"t.png\"\n";
    fs::write(dir.path().join("textured.toml"), textured).unwrap();
    let run = |arguments: &[&str]| patchlight(dir.path(), arguments);
    let render = ["render", "textured.toml", "--iterations", "1", "-o", "t.png"];
    fails(&run(&render), 2, &["t.png: is a file of the scene, which would be lost"]);
    let picture = run(&["render", "ball.toml", "--iterations", "1", "--size", "8x8", "-o", "r.exr"]);
    assert!(picture.status.success(), "{}", stderr(&picture));
    let bench = ["bench", "ball.toml", "--reference", "r.exr", "--seconds", "0.1", "--csv", "r.exr"];
    fails(&run(&bench), 2, &["r.exr: is a picture to compare with"]);
    let patches = "1\n3 3\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n0 1 0\n1 1 0\n2 1 0\n3 1 0\n0 2 0\n1 2 0\n2 2 0\n3 2 0\n0 3 0\n1 3 0\n2 3 0\n3 3 0\n";
    fs::write(dir.path().join("p.bpt"), patches).unwrap();
    fails(&run(&["export", "p.bpt", "-o", "p.bpt"]), 2, &["p.bpt: is the scene"]);
    assert!(stdout(&run(&["check", "p.bpt"])).starts_with("p.bpt: valid; 2 objects, 1 Bezier patch"));
}

#[test]
fn files_without_end_are_refused() {
    let dir = folder();
    fails(&patchlight(dir.path(), &["check", "."]), 2, &[".: cannot be read: it is a folder"]);
    if cfg!(unix) {
        fails(&patchlight(dir.path(), &["check", "/dev/zero"]), 2, &["/dev/zero", "a pipe or a device"]);
        assert!(Command::new("mkfifo").arg(dir.path().join("pipe")).status().unwrap().success());
        fails(&patchlight(dir.path(), &["check", "pipe"]), 2, &["pipe: cannot be read", "a pipe or a device"]);
        let textured = SCENE.to_owned() + "[[texture]]\nname = \"t\"\nfile = \"pipe\"\n";
        fs::write(dir.path().join("t.toml"), textured).unwrap();
        fails(&patchlight(dir.path(), &["check", "t.toml"]), 2, &["texture[0].file", "a pipe or a device"]);
    }
}

#[test]
fn messages_name_the_file_and_a_way_to_mend_it() {
    let dir = folder();
    let without_digit = SCENE.replace("fov_y = 40", "fov_y = .5");
    fs::write(dir.path().join("digit.toml"), without_digit).unwrap();
    fails(&patchlight(dir.path(), &["check", "digit.toml"]), 2, &["digit.toml:7:9", "as in 0.5"]);
    fails(&patchlight(dir.path(), &["export", "ball.toml", "-o", "a.obj"]), 2, &["ball.toml: the scene has no object"]);
    let render = ["render", "ball.toml", "-o", "a.exr", "--iterations", "1", "--size", "6x4"];
    assert!(patchlight(dir.path(), &render).status.success());
    let mask = image::GrayImage::from_fn(6, 6, |x, _| image::Luma([if x < 3 { 255 } else { 0 }]));
    mask.save(dir.path().join("mask.png")).unwrap();
    let bench = ["bench", "ball.toml", "--reference", "a.exr", "--mask", "mask.png"];
    fails(&patchlight(dir.path(), &bench), 2, &["mask.png: the mask has 6 x 6 pixels", "6 x 4"]);
}

/// A problem each in some ten thousand objects, with names that are near to none: the first twenty are listed, the others counted.
#[test]
fn many_mistakes_are_counted() {
    let dir = folder();
    let object = |k: u32| {
        format!("[[object]]\nname = \"{k}\"\ntype = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"w{k}\"\n")
    };
    let text = SCENE.to_owned() + &(0..20_000).map(object).collect::<String>();
    fs::write(dir.path().join("many.toml"), text).unwrap();
    let run = patchlight(dir.path(), &["check", "many.toml"]);
    fails(&run, 2, &["object[1].material: found \"w0\"", "many.toml: and 19980 more problems"]);
    assert_eq!(stderr(&run).lines().count(), 21);
}

#[test]
fn check_prints_the_plan() {
    let dir = folder();
    let output = patchlight(dir.path(), &["check", "ball.toml"]);
    assert!(output.status.success(), "{}", stderr(&output));
    let text = stdout(&output);
    assert!(
        text.starts_with("ball.toml: valid; 1 object, 0 Bezier patches, 1 light, 1 material, 0 textures\n"),
        "{text}"
    );
    assert!(text.contains("rendered  direct light: "), "{text}");
    assert!(text.contains("skipped   caustics: "), "{text}");
    let report = stdout(&patchlight(dir.path(), &["check", "report"]));
    assert!(report.contains("rendered  caustics: "), "{report}");
}

/// The system ends a program that runs out of memory, so the program compares with the free memory first.
#[cfg(target_os = "linux")]
#[test]
fn a_picture_too_large_for_the_memory_is_refused() {
    let dir = folder();
    let render = format!(
        "ulimit -v 2000000; exec '{}' render ball.toml -o a.png --size 16384x16384 --iterations 1",
        env!("CARGO_BIN_EXE_patchlight")
    );
    let output = Command::new("sh").args(["-c", &render]).current_dir(dir.path()).output().unwrap();
    fails(&output, 1, &["a picture of 16384 x 16384 pixels takes about", "more than is free"]);
    assert_eq!(names(dir.path()), ["ball.toml"], "no file was written");
}

#[test]
fn a_long_list_of_mistakes_is_cut() {
    let dir = folder();
    fs::write(dir.path().join("bad.toml"), format!("{SCENE}{}", "[[light]]\nname = \"\"\n".repeat(50))).unwrap();
    let output = patchlight(dir.path(), &["check", "bad.toml"]);
    fails(&output, 2, &["bad.toml:26:1: light[1]: the key `type` is missing", "bad.toml: and 30 more"]);
}

/// One iteration of a built-in scene with seed 0, as 8-bit sRGB.
fn displayed(name: &str, (width, height): (u32, u32)) -> Vec<u8> {
    let mut file = SceneFile::built_in(name).unwrap();
    (file.scene.film.width, file.scene.film.height) = (width, height);
    let image = advanced(Session::prepare(&file, 0, None).unwrap(), 1).film().image();
    ToneMap::new(file.scene.film.exposure, file.scene.film.tone_curve).map_image(&image).into_raw()
}

#[test]
fn built_in_scenes_render_in_any_folder() {
    let dir = folder();
    let size = (32, 24);
    for scene in built_in_scenes() {
        let run = ["render", scene.name, "-o", "a.png", "--iterations", "1", "--size", "32x24"];
        let output = patchlight(dir.path(), &run);
        assert!(output.status.success(), "{}: {}", scene.name, stderr(&output));
        assert!(stderr(&output).contains("a.png: 1 iteration in "), "{}", stderr(&output));
        let picture = image::open(dir.path().join("a.png")).unwrap().into_rgb8();
        assert_eq!(picture.dimensions(), size, "{}", scene.name);
        let lit = picture.pixels().filter(|pixel| pixel.0.into_iter().max() > Some(32)).count();
        assert!(2 * lit > 32 * 24, "{}: {lit} pixels are lit", scene.name);
        assert!(picture.into_raw() == displayed(scene.name, size), "{}: the library renders other pixels", scene.name);
    }
}

#[test]
fn scene_mistakes_are_located() {
    let dir = folder();
    fs::write(dir.path().join("bad.toml"), SCENE.replace("radius = 1", "raduis = 1")).unwrap();
    for command in [&["check", "bad.toml"][..], &["render", "bad.toml", "-o", "a.png"], &["bad.toml"]] {
        let output = patchlight(dir.path(), command);
        fails(&output, 2, &["bad.toml:24:1: object[0].raduis: unknown key", "did you mean \"radius\"?"]);
    }
    assert_eq!(names(dir.path()), ["bad.toml", "ball.toml"], "no file was written");
}

#[test]
fn a_texture_that_is_no_image_is_a_scene_mistake() {
    let dir = folder();
    let texture = "[[texture]]\nname = \"t\"\nfile = \"ball.toml\"\n\n[[material]]";
    let scene = SCENE.replace("[[material]]", texture).replace("[0.5, 0.5, 0.5]", "{ texture = \"t\" }");
    fs::write(dir.path().join("bad.toml"), scene).unwrap();
    fails(&patchlight(dir.path(), &["check", "bad.toml"]), 2, &["ball.toml"]);
}

#[test]
fn command_line_mistakes_end_with_2() {
    let dir = folder();
    let mistakes: [(&[&str], &str); 16] = [
        (&["render", "ball.toml"], "--output"),
        (&["render", "ball.toml", "-o", "a.jpg"], "ends in .png or .exr"),
        (&["render", "ball.toml", "-o", "no/a.png"], "the folder no does not exist"),
        (&["render", "ball.toml", "-o", "a.png", "--seconds", "1", "--iterations", "1"], "cannot be used with"),
        (&["render", "ball.toml", "-o", "a.png", "--seconds", "-1"], "expected a number above 0"),
        (&["render", "ball.toml", "-o", "a.png", "--size", "0x4"], "like 640x480"),
        (&["render", "ball.toml", "-o", "a.png", "--threads", "0"], "--threads"),
        (&["render", "missing.toml", "-o", "a.png"], "missing.toml: cannot be read"),
        (
            &["render", "tepot", "-o", "a.png"],
            "tepot: no such scene file or built-in scene; the built-in scenes are report, report-flipped, water, cardioid, lens, teapot, \
             cornell; did you mean \"teapot\"?",
        ),
        (
            &["render", "bogus", "-o", "a.png"],
            "bogus: no such scene file or built-in scene; the built-in scenes are report",
        ),
        (&["bench", "ball.toml", "--reference", "missing.exr"], "missing.exr: cannot be read"),
        (&["bench", "ball.toml"], "expected either SCENE --reference REF.exr, or --suite FILE.toml --output FOLDER"),
        (&["bench", "--suite", "a.toml", "--output", "out"], "a.toml: cannot be read"),
        (&["bench", "--suite", "a.toml", "--output", "out", "--seeds", "2"], "cannot be used with"),
        (
            &["bench", "ball.toml", "--reference", "a.exr", "--plot", "a.svg"],
            "a.svg: expected a name that ends in .png",
        ),
        (&["bench", "ball.toml", "--reference", "a.exr", "--plot", "no/a.png"], "the folder no does not exist"),
    ];
    for (arguments, message) in mistakes {
        fails(&patchlight(dir.path(), arguments), 2, &[message]);
    }
    assert_eq!(names(dir.path()), ["ball.toml"], "no file was written");
}

#[test]
fn a_failed_write_ends_with_1_and_leaves_the_old_file() {
    let dir = folder();
    fs::create_dir(dir.path().join("a.png")).unwrap();
    let run = ["render", "ball.toml", "-o", "a.png", "--iterations", "1", "--size", "8x8"];
    fails(&patchlight(dir.path(), &run), 1, &["a.png: cannot be written"]);
    assert_eq!(names(dir.path()), ["a.png", "ball.toml"], "no temporary file stays");
}

/// A folder with a scene, a reference of it and a mask.
fn bench_folder() -> TempDir {
    let dir = folder();
    for (out, iterations) in [("truth.exr", "64"), ("mask.png", "1")] {
        let run = ["render", "ball.toml", "-o", out, "--size", "32x32", "--seed", "7", "--iterations", iterations];
        assert!(patchlight(dir.path(), &run).status.success());
    }
    dir
}

/// The column of this name in a table with a head.
fn column<'a>(csv: &'a str, name: &str) -> Vec<&'a str> {
    let lines: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    assert!(lines.iter().all(|line| line.len() == lines[0].len()), "{csv}");
    let index = lines[0].iter().position(|key| *key == name).unwrap_or_else(|| panic!("{name} in {csv}"));
    lines[1..].iter().map(|line| line[index]).collect()
}

#[test]
fn bench_measures_against_a_reference() {
    let dir = bench_folder();
    let run =
        ["--reference", "truth.exr", "--mask", "mask.png", "--seconds", "0.2,0.05", "--seeds", "2", "--csv", "a.csv"];
    let output = patchlight(dir.path(), &[&["bench", "ball.toml"], &run[..]].concat());
    assert!(output.status.success(), "{}", stderr(&output));
    for phrase in ["RMSE falls as t^", "\nmedians of 2 seeds\n", "RMSE out  relMSE out"] {
        assert!(stdout(&output).contains(phrase), "{phrase:?} in\n{}", stdout(&output));
    }
    let csv = fs::read_to_string(dir.path().join("a.csv")).unwrap();
    assert_eq!(column(&csv, "seed"), ["0", "0", "1", "1"]);
    assert_eq!(column(&csv, "mark"), ["0.05", "0.2", "0.05", "0.2"]);
    assert_eq!(column(&csv, "caustic_paths"), ["0"; 4], "there is no mirror");
    assert!(column(&csv, "shadow_rays").iter().all(|n| n.parse::<u64>().is_ok_and(|n| n > 0)), "{csv}");
    for rmse in column(&csv, "rmse") {
        let rmse: f64 = rmse.parse().unwrap();
        assert!(rmse > 0.0 && rmse < 0.1, "a ball lit by one lamp is soon right: {csv}");
    }
    // Outside the mask are the black background, which has no error, and the ball's dark side.
    let outside = column(&csv, "rmse_outside");
    assert!(outside.iter().all(|rmse| rmse.parse().is_ok_and(|rmse: f64| rmse < 0.1)), "{csv}");
    assert_ne!(outside, column(&csv, "rmse"));
}

#[test]
fn bench_without_a_mask_counts_every_pixel() {
    let dir = bench_folder();
    let run = ["bench", "ball.toml", "--reference", "truth.exr", "--seconds", "0.05", "--csv", "a.csv"];
    let output = patchlight(dir.path(), &run);
    assert!(output.status.success(), "{}", stderr(&output));
    for phrase in ["falls as", "median", "out"] {
        assert!(!stdout(&output).contains(phrase), "{phrase:?} in\n{}", stdout(&output));
    }
    let csv = fs::read_to_string(dir.path().join("a.csv")).unwrap();
    assert_eq!(column(&csv, "rmse_outside"), [""]);
}

#[test]
fn bench_draws_a_plot() {
    let dir = bench_folder();
    let run = ["bench", "ball.toml", "--reference", "truth.exr", "--seconds", "0.05,0.2", "--plot", "a.PNG"];
    let output = patchlight(dir.path(), &run);
    assert!(output.status.success(), "{}", stderr(&output));
    let plot = image::load_from_memory(&fs::read(dir.path().join("a.PNG")).unwrap()).unwrap().into_rgb8();
    let colored = plot.pixels().filter(|pixel| pixel.0.iter().max().unwrap() - pixel.0.iter().min().unwrap() > 100);
    assert!(colored.count() > 500, "two curves in colour");
}

const SUITE: &str = r#"
[[run]]
name = "own"
scene = "ball.toml"
reference_seconds = 0.3
seconds = [0.05, 0.1, 0.2]
seeds = 2

[[run]]
name = "given"
scene = "ball.toml"
reference = "truth.exr"
second_reference = "truth.exr"
mask = "mask.png"
others = 1e-3
seconds = [0.1]
"#;

#[test]
fn a_suite_measures_each_of_its_scenes() {
    let dir = bench_folder();
    let small = SCENE.replace("[[material]]", "[film]\nwidth = 24\nheight = 16\n\n[[material]]");
    fs::write(dir.path().join("ball.toml"), small).unwrap();
    fs::write(dir.path().join("suite.toml"), SUITE).unwrap();
    fs::create_dir(dir.path().join("elsewhere")).unwrap();
    // Paths in the suite are relative to it, the folder to the working directory.
    let elsewhere = dir.path().join("elsewhere");
    let output = patchlight(&elsewhere, &["bench", "--suite", "../suite.toml", "--output", "out/put"]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(stdout(&output).contains("rendering a reference for 0.3 s\n"), "{}", stdout(&output));
    let out = elsewhere.join("out/put");
    assert_eq!(names(&out), ["given.csv", "own.csv", "own.png", "suite.md"], "one mark makes no curve");
    let read = |name: &str| fs::read_to_string(out.join(name)).unwrap();
    assert_eq!(column(&read("own.csv"), "seed"), ["0", "0", "0", "1", "1", "1"]);
    for rmse in column(&read("own.csv"), "rmse") {
        let rmse: f64 = rmse.parse().unwrap();
        assert!(rmse > 0.0 && rmse < 0.1, "the reference has another noise: {}", read("own.csv"));
    }
    let table = read("suite.md");
    let marks: Vec<_> = table.lines().filter_map(|line| line.split('|').nth(2)).map(str::trim).collect();
    assert_eq!(marks, ["mark", "--:", "0.05", "0.1", "0.2", "0.1"], "{table}");
    assert!(table.contains("| compared relMSE | compared over ours |"), "{table}");
}

#[test]
fn suite_mistakes_end_with_2_before_the_rendering() {
    let dir = folder();
    let suite = SUITE.replace("truth.exr", "ball.toml");
    for (text, phrases) in [
        (suite.clone(), &["suite.toml: run \"given\": ", "mask.png: cannot be read"][..]),
        (suite.replace("mask = ", "maks = "), &["suite.toml: ", "line 14", "unknown field `maks`", "`mask`"]),
        (suite.replace("seeds = 2", "seeds = \"2\""), &["suite.toml: ", "line 7", "invalid type: string \"2\""]),
        (suite.replace("\"ball.toml\"", "\"no.toml\""), &["suite.toml: run \"own\": no.toml: cannot be read"]),
        (suite.replace("\"ball.toml\"", "\"tepot\""), &["run \"own\": ", "did you mean \"teapot\"?"]),
        (suite.replace("mask = \"mask.png\"", ""), &["suite.toml: run \"given\": ball.toml: "]),
    ] {
        fs::write(dir.path().join("suite.toml"), text).unwrap();
        fails(&patchlight(dir.path(), &["bench", "--suite", "suite.toml", "--output", "out"]), 2, phrases);
    }
    assert_eq!(names(dir.path()), ["ball.toml", "suite.toml"], "no file was written");
}

#[test]
fn the_suites_of_the_project_are_valid() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let dir = folder();
    fs::write(dir.path().join("taken"), "").unwrap();
    let taken = dir.path().join("taken");
    // The program reads all files before it creates the folder, and the failed creation ends it before the rendering.
    for suite in ["suite", "references", "others"] {
        let file = format!("benches/suite/{suite}.toml");
        let run = ["bench", "--suite", &file, "--output", taken.to_str().unwrap()];
        fails(&patchlight(root, &run), 1, &["taken: the folder cannot be created"]);
    }
}

#[test]
fn a_mask_must_have_the_size_of_the_reference() {
    let dir = folder();
    for (out, size) in [("truth.exr", "8x8"), ("mask.png", "9x8")] {
        let run = ["render", "ball.toml", "-o", out, "--size", size, "--iterations", "1"];
        assert!(patchlight(dir.path(), &run).status.success());
    }
    let run = ["bench", "ball.toml", "--reference", "truth.exr", "--mask", "mask.png"];
    fails(&patchlight(dir.path(), &run), 2, &["the mask has 9 x 8 pixels"]);
}

#[test]
fn without_a_display_a_message_names_the_render_command() {
    let dir = folder();
    fails(&patchlight(dir.path(), &[]), 1, &["patchlight render report -o"]);
    fails(&patchlight(dir.path(), &["ball.toml"]), 1, &["patchlight render ball.toml -o"]);
}

#[test]
fn help_and_version_are_printed() {
    let dir = folder();
    assert!(stdout(&patchlight(dir.path(), &["--help"])).contains("render"));
    assert!(stdout(&patchlight(dir.path(), &["--version"])).starts_with("patchlight 0."));
}

/// The shell's limit of the stack, here 64 kB, binds only the main thread, where no command works.
#[cfg(target_os = "linux")]
#[test]
fn commands_need_no_stack_of_the_shell() {
    let dir = tempfile::tempdir().unwrap();
    let deep = format!("version = 1\nname = {}{}\n", "[".repeat(20_000), "]".repeat(20_000));
    std::fs::write(dir.path().join("deep.toml"), deep).unwrap();
    let run = |arguments: &str| {
        let line = format!("ulimit -s 64 && exec \"$0\" {arguments}");
        let program = env!("CARGO_BIN_EXE_patchlight");
        let output = std::process::Command::new("sh").args(["-c", &line, program]).current_dir(dir.path()).output();
        output.unwrap().status.code()
    };
    assert_eq!(run("check deep.toml"), Some(2), "a message, no overflow");
    assert_eq!(run("check teapot"), Some(0));
    assert_eq!(run("render water --size 16x16 --iterations 1 -o out.png"), Some(0));
    assert_eq!(run("export report -o out.bpt"), Some(0));
    std::fs::write(dir.path().join("rays.csv"), "0,0,5,0,0,-1\n").unwrap();
    assert!(run("intersect out.bpt rays.csv").is_some(), "no signal ended it");
}
