//! The time from an edit to a picture while a control point is dragged and after its release, and how well these pictures
//! show the caustic.

#![allow(clippy::expect_used, reason = "a measurement that cannot go on has failed")]
#![allow(clippy::print_stdout, reason = "the benchmark prints a table")]

mod caustic;

use caustic::Caustic;
use crossbeam_channel::{Receiver, bounded};
use patchlight::engine::{Command, Engine, EngineSettings, Frame};
use patchlight::scene::{SceneFile, Shape};
use std::sync::Arc;
use std::time::{Duration, Instant};

const SIDE: u32 = 512;
/// Moves of a drag. The first `MOVES_TO_SETTLE` do not count: drafts adapt their size during them.
const MOVES: usize = 120;
const MOVES_TO_SETTLE: usize = 20;

/// The final lift of the control point, and the lift per move on the way there, in scene units.
const LIFT: f64 = 0.2;
const MOVE: f64 = 0.001;

/// The report scene with an inner control point of its sheet lifted by `by` scene units.
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

/// Waits for the first frame of the newest scene for which `will_do` holds. Returns the time since `start` and the frame.
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

fn milliseconds(sorted: &[Duration], quantile: f64) -> f64 {
    1e3 * sorted[((sorted.len() - 1) as f64 * quantile).round() as usize].as_secs_f64()
}

fn main() {
    let (wake, woken) = bounded(1);
    // A full channel already announces a new frame.
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
        // A mouse reports moves at this rate.
        std::thread::sleep(Duration::from_millis(8));
    }
    drafts.sort();
    let draft = newest.expect("there are moves").image.clone();
    let size = draft.width;
    println!("| report scene, {SIDE} x {SIDE} | |\n|---|--:|");
    println!("| first draft ({size} pixels wide), median | {:.0} ms |", milliseconds(&drafts, 0.5));
    println!("| first draft, 95th percentile | {:.0} ms |", milliseconds(&drafts, 0.95));
    // The last draft, which has all pixels, and the first iteration.
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
    println!("| last draft (all pixels), median | {:.0} ms |", milliseconds(&wholes, 0.5));
    println!("| first iteration, median | {:.0} ms |", milliseconds(&iterations, 0.5));
    // Stops the engine's threads while the converged picture is rendered.
    drop(engine);
    let caustic = Caustic::render(&lifted(LIFT));
    for (name, image) in [("first draft", &draft), ("last draft", &whole)] {
        let (with, without) = (caustic.likeness(image), caustic.likeness_without(image.width));
        println!("| caustic in the {name}, correlation with the converged picture | {with:.2} |");
        println!("| converged picture without caustics, of equal width | {without:.2} |");
    }
}
