//! Checkpoints: films that go on, films that merge, and files that are no whole checkpoints.

use crate::support::{advanced, ball, floor, head, patchlight, scene};
use flate2::Crc;
use patchlight::engine::{Checkpoint, CheckpointFile, FilmPart, FilmSums, Run, Session};
use patchlight::scene::SceneFile;
use std::{
    fs,
    ops::RangeInclusive,
    path::{Path, PathBuf},
    process::{Child, Command, Output, Stdio},
    time::Duration,
};

/// A small picture of a mirror ball over a floor, with caustics and interreflection.
fn room() -> SceneFile {
    let mut file = scene(&(head() + &ball("ball", 0.3, 0.5, "mirror") + &floor("grey")));
    (file.scene.film.width, file.scene.film.height) = (26, 19);
    file
}

fn prepared(file: &SceneFile) -> Session {
    Session::prepare(file, 3, None).unwrap()
}

/// The part as a checkpoint brings it back.
fn stored(file: &SceneFile, part: &FilmPart) -> FilmPart {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.film");
    Checkpoint::write(&path, &Run::new(file, 3, None).unwrap(), part).unwrap();
    CheckpointFile::open(&path).unwrap().read().unwrap().part
}

/// The session after the iteration of the run with this number.
fn until(session: Session, last: u64) -> Session {
    let first = session.part().film().first();
    advanced(session, last + 1 - first)
}

/// The part of a run with these iterations, begun with the measurements of the iterations before them.
fn measured_part(file: &SceneFile, iterations: RangeInclusive<u64>) -> FilmPart {
    let session = prepared(file).beginning_with(*iterations.start());
    until_in_film(session, *iterations.end()).part().clone()
}

/// As [`until`], where iterations before the film are rendered, too.
fn until_in_film(mut session: Session, last: u64) -> Session {
    while session.part().rendered() < last {
        session.advance(patchlight::transport::Cancel::NEVER).unwrap();
    }
    session
}

fn error(part: &FilmPart) -> f64 {
    part.error_estimate().unwrap()
}

fn merged(parts: Vec<FilmPart>) -> FilmPart {
    let merge = |a: FilmPart, b: FilmPart| {
        assert!(a.precedes(&b) && !b.precedes(&a));
        a.followed_by(b)
    };
    parts.into_iter().reduce(merge).unwrap()
}

fn assert_equal_sums(film: &FilmSums, one_run: &FilmSums) {
    let difference = film.greatest_difference(one_run);
    assert_eq!((film.first(), film.last(), film.weight()), (1, one_run.last(), one_run.weight()));
    assert!(difference < 1e-12, "{difference:e}");
}

#[test]
fn a_resumed_film_is_that_of_one_run() {
    let file = room();
    let one_run = advanced(prepared(&file), 17);
    // Within the first refinement, at refinements, and between them.
    for breaks in [&[1][..], &[3, 4], &[5, 8, 13]] {
        let mut session = prepared(&file);
        for last in breaks {
            let part = stored(&file, advanced(session, *last).part());
            session = prepared(&file).resuming(part);
        }
        let session = advanced(session, 17);
        assert_eq!(session.film(), one_run.film(), "{breaks:?}");
        let (stats, expected) = (session.stats(), one_run.stats());
        assert_eq!((stats.error_estimate, stats.counters), (expected.error_estimate, expected.counters));
    }
}

#[test]
fn parts_that_measure_again_merge_to_one_run() {
    let file = room();
    let one_run = advanced(prepared(&file), 18);
    for ranges in [&[1..=6, 7..=12, 13..=18][..], &[1..=4, 5..=18]] {
        let parts = ranges.iter().map(|range| stored(&file, &measured_part(&file, range.clone())));
        let merged = merged(parts.collect());
        assert_equal_sums(merged.film(), one_run.film());
        let ratio = error(&merged) / error(one_run.part());
        assert!((ratio - 1.0).abs() < 0.03, "{ranges:?}: {ratio}");
        let merged = prepared(&file).resuming(merged);
        let (stats, expected) = (merged.stats(), one_run.stats());
        assert_eq!(stats.counters, expected.counters, "iterations that only measure are no work of the film");
        let emitted = [stats, expected].map(|stats| stats.energy.interreflection.emitted);
        assert!((emitted[0] / emitted[1] - 1.0).abs() < 1e-12, "{emitted:?}");
        // The merged film goes on as the run does.
        let longer = advanced(merged, 20);
        assert_equal_sums(longer.film(), advanced(prepared(&file), 20).film());
    }
}

#[test]
fn parts_with_the_plan_of_the_first_one_merge_to_one_run_with_that_plan() {
    let file = room();
    let first = advanced(prepared(&file), 8).part().clone();
    let one_run = until(prepared(&file).resuming(first.clone()).keeping(&first), 36);
    let part = |iterations: RangeInclusive<u64>| {
        let session = prepared(&file).beginning_with(*iterations.start()).keeping(&first);
        stored(&file, until(session, *iterations.end()).part())
    };
    let merged = merged(vec![first.clone(), part(9..=15), part(16..=31), part(32..=32), part(33..=36)]);
    assert_equal_sums(merged.film(), one_run.film());
    let ratio = error(&merged) / error(one_run.part());
    assert!((ratio - 1.0).abs() < 0.05, "{ratio}");
    let other_plan = measured_part(&file, 17..=17);
    assert!(!part(9..=16).precedes(&other_plan), "its radii are refined");
    let longer = until(prepared(&file).resuming(merged), 38);
    assert_equal_sums(longer.film(), until(one_run, 38).film());
}

/// Renders some iterations of a small scene.
fn render(dir: &Path, more: &[&str]) -> Output {
    patchlight(dir, &[&["render", "report", "--size", "20x16"], more].concat())
}

fn succeeds(output: &Output) {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// Asserts that the command line was refused with a message that has these phrases.
fn refuses(output: &Output, phrases: &[&str]) {
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{message}");
    for phrase in phrases {
        assert!(message.contains(phrase), "should say {phrase:?}, but says\n{message}");
    }
}

#[test]
fn the_commands_resume_and_merge() {
    let dir = tempfile::tempdir().unwrap();
    let run = |more: &[&str]| succeeds(&render(dir.path(), more));
    run(&["--iterations", "12", "-o", "one.exr", "--checkpoint", "one.film", "--stats", "one.json"]);
    run(&["--iterations", "4", "--checkpoint", "a.film"]);
    run(&["--iterations", "12", "--resume", "a.film", "-o", "resumed.exr", "--checkpoint", "a12.film"]);
    run(&["--iterations", "5..12", "--checkpoint", "b.film"]);
    run(&["--iterations", "5..12", "--plan", "a.film", "--checkpoint", "kept.film"]);
    for parts in [&["b.film", "a.film"][..], &["one.film"], &["a12.film"]] {
        let merge = [&["merge", "-o", "merged.exr", "--checkpoint", "all.film", "--stats", "all.json"], parts].concat();
        succeeds(&patchlight(dir.path(), &merge));
        let read = |name: &str| fs::read(dir.path().join(name)).unwrap();
        assert!(read("merged.exr") == read("one.exr"), "{parts:?}");
        let stats = |name: &str| serde_json::from_slice::<serde_json::Value>(&read(name)).unwrap();
        for key in ["iterations", "photons_emitted", "rays", "counters", "error_estimate"] {
            assert_eq!(stats("all.json")[key], stats("one.json")[key], "{key} of {parts:?}");
        }
        assert!(read("resumed.exr") == read("one.exr"));
    }
    succeeds(&patchlight(dir.path(), &["merge", "a.film", "kept.film", "-o", "kept.png"]));
    let merge = |more: &[&str]| patchlight(dir.path(), &[&["merge", "a.film", "b.film"], more].concat());
    refuses(&merge(&["--checkpoint", "b.film"]), &["b.film: is a film, which would be lost"]);
    refuses(&merge(&["-o", "x.exr", "--checkpoint", "x.exr"]), &["x.exr: is both the picture and the checkpoint"]);
}

#[test]
fn films_of_other_runs_are_refused_by_name() {
    let dir = tempfile::tempdir().unwrap();
    let part = |iterations: &str, file: &str, more: &[&str]| {
        let output = render(dir.path(), &[&["--iterations", iterations, "--checkpoint", file], more].concat());
        succeeds(&output);
    };
    part("2", "a.film", &[]);
    part("3..4", "seed.film", &["--seed", "1"]);
    part("3..4", "only.film", &["--only", "direct"]);
    part("2..4", "overlap.film", &[]);
    part("4..6", "gap.film", &[]);
    for (scene, size, film) in [("report", "8x8", "size.film"), ("lens", "20x16", "scene.film")] {
        let other = ["render", scene, "--size", size, "--iterations", "3..4", "--checkpoint", film];
        succeeds(&patchlight(dir.path(), &other));
    }
    let merge = |other: &str| patchlight(dir.path(), &["merge", other, "a.film", "-o", "a.exr"]);
    let resume = |film: &str, more: &[&str]| render(dir.path(), &[&["--resume", film, "-o", "a.exr"], more].concat());
    for (film, what) in [
        ("seed.film", "another seed: 1, not 0"),
        ("size.film", "another size: 8 x 8 pixels, not 20 x 16"),
        ("only.film", "other components of light: only direct, not all light"),
        ("scene.film", "another scene: built-in scene lens, not built-in scene report"),
    ] {
        refuses(&merge(film), &[film, what, "as a.film"]);
        refuses(&resume(film, &[]), &[film, what]);
    }
    refuses(&merge("overlap.film"), &["a.film and overlap.film both have iterations 2 to 2"]);
    refuses(&merge("gap.film"), &["iterations 3 to 3 are missing between a.film and gap.film"]);
    refuses(&resume("gap.film", &["--iterations", "9"]), &["gap.film: begins with iteration 4"]);
    refuses(&resume("a.film", &["--iterations", "1"]), &["a.film: already has iteration 2"]);
    let plan = |iterations| ["--iterations", iterations, "--plan", "a.film", "--checkpoint", "p.film"];
    refuses(&render(dir.path(), &plan("2..5")), &["a.film", "--iterations 3.."]);
    refuses(&resume("a.film", &["--stats", "a.film"]), &["a.film: is the film, which would be lost"]);
    let lost = render(dir.path(), &["--iterations", "3..5", "--plan", "a.film", "--checkpoint", "a.film"]);
    refuses(&lost, &["a.film: is the plan, which would be lost"]);
    assert!(!dir.path().join("a.exr").exists());
    as_another_version(&dir.path().join("a.film"));
    refuses(&resume("a.film", &[]), &["a.film", "another version of patchlight: 9.9.9, not "]);
}

/// Changes the version of the program in a checkpoint, and the checksum with it.
fn as_another_version(path: &Path) {
    let mut bytes = fs::read(path).unwrap();
    let version = env!("CARGO_PKG_VERSION").as_bytes();
    let at = bytes.windows(version.len()).position(|window| window == version).unwrap();
    bytes[at..at + version.len()].copy_from_slice(b"9.9.9");
    let head = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    let mut checksum = Crc::new();
    checksum.update(&bytes[..28]);
    checksum.update(&bytes[32..32 + head]);
    bytes[28..32].copy_from_slice(&checksum.sum().to_le_bytes());
    fs::write(path, bytes).unwrap();
}

#[test]
fn damaged_checkpoints_are_refused() {
    let file = &room();
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.film");
    let part = advanced(prepared(file), 5).part().clone();
    Checkpoint::write(&path, &Run::new(file, 3, None).unwrap(), &part).unwrap();
    let whole = fs::read(&path).unwrap();
    let message = |bytes: &[u8]| {
        fs::write(&path, bytes).unwrap();
        let read = CheckpointFile::open(&path).and_then(CheckpointFile::read);
        read.map_err(|error| error.to_string()).unwrap_err()
    };
    let head = 32 + u32::from_le_bytes(whole[12..16].try_into().unwrap()) as usize;
    let tenth = whole.len() / 10;
    for length in (0..=head + 9).chain((1..10).map(|k| k * tenth)).chain([whole.len() - 1]) {
        let message = message(&whole[..length]);
        assert!(message.contains("a.film: is a damaged checkpoint") && message.contains("older copy"), "{message}");
    }
    let longer = message(&[&whole[..], &[0]].concat());
    assert!(longer.contains("its length"), "{longer}");
    for at in (0..head + 99).chain((head..whole.len()).step_by(997)) {
        for bit in [0, 7] {
            let mut flipped = whole.clone();
            flipped[at] ^= 1 << bit;
            let message = message(&flipped);
            assert!(message.contains("a.film: "), "byte {at}: {message}");
        }
    }
    assert!(message(b"a picture, and not a film of 32 bytes").contains("is no checkpoint"));
    // Lengths of exabytes, with nothing behind them.
    let mut huge = whole[..head].to_vec();
    huge[12..24].fill(0xff);
    assert!(message(&huge).contains("its length"));
}

/// Begins an endless rendering that saves again and again.
#[cfg(unix)]
fn endless(dir: &Path, more: &[&str]) -> Child {
    let arguments = ["render", "report", "--size", "64x48", "--seconds", "600", "--threads", "1"];
    Command::new(env!("CARGO_BIN_EXE_patchlight"))
        .args(arguments)
        .args(more)
        .current_dir(dir)
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

#[cfg(unix)]
#[test]
fn a_signal_leaves_a_checkpoint_that_goes_on() {
    let dir = tempfile::tempdir().unwrap();
    let run = endless(dir.path(), &["--checkpoint", "a.film", "--checkpoint-seconds", "0.001"]);
    // The program writes it after the first iteration; a minute is enough for the slowest machine.
    let is_there = |_| {
        std::thread::sleep(Duration::from_millis(5));
        dir.path().join("a.film").exists()
    };
    assert!((0..12_000).any(is_there), "a checkpoint was written");
    assert!(Command::new("kill").args(["-s", "TERM", &run.id().to_string()]).status().unwrap().success());
    let ended = run.wait_with_output().unwrap();
    let message = String::from_utf8_lossy(&ended.stderr);
    assert_eq!(ended.status.code(), Some(143), "{message}");
    assert!(message.contains("a.film: ") && message.contains("go on with --resume a.film"), "{message}");
    let last = CheckpointFile::open(&dir.path().join("a.film")).unwrap().iterations().1;
    let iterations = (last + 2).to_string();
    let render = |more: &[&str]| {
        let budget = ["render", "report", "--size", "64x48", "--iterations", &iterations];
        succeeds(&patchlight(dir.path(), &[&budget[..], more].concat()));
    };
    render(&["--resume", "a.film", "-o", "resumed.exr"]);
    render(&["-o", "one.exr"]);
    assert!(fs::read(dir.path().join("resumed.exr")).unwrap() == fs::read(dir.path().join("one.exr")).unwrap());
}

/// Kills a rendering while it saves; the checkpoint is whole each time, and no temporary file stays for long.
#[cfg(unix)]
#[test]
fn a_killed_rendering_leaves_a_whole_checkpoint() {
    let dir = tempfile::tempdir().unwrap();
    let path: PathBuf = dir.path().join("a.film");
    let mut last = 0;
    for round in 0..6 {
        let resume = if round == 0 { &[][..] } else { &["--resume", "a.film"] };
        let every = ["--checkpoint", "a.film", "--checkpoint-seconds", "0.001"];
        let mut run = endless(dir.path(), &[&every[..], resume].concat());
        while !path.exists() {
            std::thread::sleep(Duration::from_millis(5));
        }
        std::thread::sleep(Duration::from_millis(300 + 37 * round));
        run.kill().unwrap();
        run.wait().unwrap();
        let checkpoint = CheckpointFile::open(&path).unwrap();
        assert!(checkpoint.iterations().1 >= last, "it went on");
        last = checkpoint.iterations().1;
        checkpoint.read().unwrap();
    }
}
