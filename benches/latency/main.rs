//! How long it takes from an edit to a picture, while a control point is dragged and after it was let go, and how well
//! those pictures show its caustic.

#![allow(clippy::expect_used, reason = "a measurement that cannot go on has failed")]
#![allow(clippy::print_stdout, reason = "the table is what it is for")]

mod caustic;

use caustic::Caustic;
use crossbeam_channel::{Receiver, bounded};
use patchlight::engine::{Command, Engine, EngineSettings, Frame};
use patchlight::scene::{SceneFile, Shape};
use std::sync::Arc;
use std::time::{Duration, Instant};

const SIDE: u32 = 512;
/// Moves of a drag; the first ones, by which drafts find their size, do not count.
const MOVES: usize = 120;
const MOVES_TO_SETTLE: usize = 20;

/// How far the control point is lifted in the end, and at each move before it less, or after it more.
const LIFT: f64 = 0.2;
const MOVE: f64 = 0.001;

/// The report scene with an inner control point of its sheet lifted by this much.
fn lifted(by: f64) -> Arc<SceneFile> {
    let mut file = SceneFile::built_in("report").expect("there is such a scene");
    (file.scene.film.width, file.scene.film.height) = (SIDE, SIDE);
    for object in &mut file.scene.objects {
        if let Shape::Bezier(bezier) = &mut object.shape {
            let mut patches = bezier.patches.as_ref().clone();
            patches[0].points[1][1].y += by;
            (bezier.patches, bezier.file) = (Arc::new(patches), None);
        }
    }
    Arc::new(file)
}

/// Waits for the first frame of the newest scene that will do; the time since `start`, and the frame.
fn wait(
    engine: &Engine,
    woken: &Receiver<()>,
    start: Instant,
    will_do: impl Fn(&Frame) -> bool,
) -> (Duration, Arc<Frame>) {
    loop {
        if let Some(frame) = engine.newest_frame()
            && frame.generation == engine.generation()
            && will_do(&frame)
        {
            return (start.elapsed(), frame);
        }
        woken.recv().expect("the engine runs");
    }
}

fn milliseconds(sorted: &[Duration], part: f64) -> f64 {
    1e3 * sorted[((sorted.len() - 1) as f64 * part).round() as usize].as_secs_f64()
}

fn main() {
    let (wake, woken) = bounded(1);
    // A full channel already says that there is something new.
    let wake = move || wake.try_send(()).unwrap_or_default();
    let engine = Engine::start(EngineSettings { threads: None, seed: 1 }, wake).expect("there are threads");
    let mut drafts = Vec::new();
    let mut newest = None;
    for k in 0..MOVES {
        let scene = lifted(LIFT - MOVE * (MOVES - 1 - k) as f64);
        let start = Instant::now();
        engine.send(Command::Show(scene));
        let (time, frame) = wait(&engine, &woken, start, |_| true);
        if k >= MOVES_TO_SETTLE {
            drafts.push(time);
        }
        newest = Some(frame);
        // So often a mouse reports that it moves.
        std::thread::sleep(Duration::from_millis(8));
    }
    drafts.sort();
    let draft = newest.expect("there are moves").image.clone();
    let size = draft.width;
    println!("| report scene, {SIDE} x {SIDE} | |\n|---|--:|");
    println!("| first draft ({size} pixels wide), median | {:.0} ms |", milliseconds(&drafts, 0.5));
    println!("| first draft, 95th percentile | {:.0} ms |", milliseconds(&drafts, 0.95));
    // The first picture with all pixels, and the first one that goes on to converge.
    let (mut wholes, mut iterations, mut newest) = (Vec::new(), Vec::new(), None);
    for k in (0..5).rev() {
        let scene = lifted(LIFT + MOVE * f64::from(k));
        let start = Instant::now();
        engine.send(Command::Show(scene));
        let (time, frame) = wait(&engine, &woken, start, |frame| frame.image.width == SIDE);
        wholes.push(time);
        newest = Some(frame);
        iterations.push(wait(&engine, &woken, start, |frame| !frame.draft).0);
    }
    let whole = newest.expect("there are pictures").image.clone();
    wholes.sort();
    iterations.sort();
    println!("| first whole picture, median | {:.0} ms |", milliseconds(&wholes, 0.5));
    println!("| first iteration, median | {:.0} ms |", milliseconds(&iterations, 0.5));
    // Its threads rest while the converged picture is rendered.
    drop(engine);
    let caustic = Caustic::render(&lifted(LIFT));
    for (name, image) in [("draft", &draft), ("whole picture", &whole)] {
        let (with, without) = (caustic.likeness(image), caustic.likeness_without(image.width));
        println!("| caustic in the first {name}, correlation with the converged one | {with:.2} |");
        println!("| the converged one, as wide but without caustics | {without:.2} |");
    }
}
