//! What the screen shows after an edit and during a drag, and how far it is from the converged picture:
//! `cargo bench --bench latency --features flip [-- SCENE ...] [SIDE ...] [TABLE ...]`.
//!
//! | file | holds |
//! |---|---|
//! | `edit` | edits of a scene |
//! | `recorder` | an engine whose frames are recorded |
//! | `screen` | what a screen shows, and its distance from the converged picture |
//! | `start` | what the screen shows after a start |
//! | `caustic` | how well a picture shows the caustic |

#![allow(clippy::expect_used, reason = "a measurement that cannot go on has failed")]
#![allow(clippy::print_stdout, reason = "the benchmark prints a table")]

mod caustic;
mod edit;
mod recorder;
mod screen;
mod start;

use caustic::Caustic;
use edit::Edit;
use patchlight::engine::Frame;
use patchlight::scene::{SceneFile, built_in_scenes};
use recorder::{Recorded, Recorder};
use screen::{Distance, Screen};
use std::f64::consts::TAU;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The allocator of the program.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// The tables, of which arguments choose some.
const TABLES: [&str; 3] = ["starts", "edits", "drags"];
const SIDES: [u32; 2] = [512, 1024];
/// Times after an edit, milliseconds.
const TIMES: [u64; 6] = [33, 66, 100, 200, 500, 1000];
/// Times that an edit is measured; the table holds the median.
const REPEATS: usize = 3;
/// Time for which the picture converges before an edit.
const BEFORE: Duration = Duration::from_millis(3000);
/// Time for which the converged picture is rendered.
const CONVERGED: Duration = Duration::from_secs(12);
/// Time between two moves of a drag: a mouse reports them at this rate.
const MOVE: Duration = Duration::from_millis(8);
/// Moves of a drag, of one round of the dragged point, and of the beginning that does not count: drafts adapt their size.
const DRAG_MOVES: u32 = 310;
const ROUND: u32 = 125;
const SETTLING_MOVES: u32 = 60;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    let (sides, names): (Vec<_>, Vec<_>) = arguments.iter().partition(|argument| argument.parse::<u32>().is_ok());
    let sides: Vec<u32> = sides.iter().filter_map(|side| side.parse().ok()).collect();
    let (tables, names): (Vec<&str>, Vec<&str>) =
        names.into_iter().map(String::as_str).partition(|word| TABLES.contains(word));
    let wanted = |table: &str| tables.is_empty() || tables.contains(&table);
    let all: Vec<&str> = built_in_scenes().iter().map(|scene| scene.name).collect();
    for side in if sides.is_empty() { SIDES.to_vec() } else { sides } {
        let files: Vec<(&str, SceneFile)> =
            if names.is_empty() { &all } else { &names }.iter().map(|name| (*name, of_side(name, side))).collect();
        if wanted("starts") {
            start::table(&files, side);
        }
        if wanted("edits") {
            edits(&files, side);
        }
        if wanted("drags") {
            drags(&files, side);
        }
    }
}

/// A built-in scene with a square film.
fn of_side(name: &str, side: u32) -> SceneFile {
    let mut file = SceneFile::built_in(name).expect("there is such a scene");
    (file.scene.film.width, file.scene.film.height) = (side, side);
    file
}

fn edits(files: &[(&str, SceneFile)], side: u32) {
    println!("After an edit, {side} x {side} pixels: FLIP, and 100 times the RMSE, of what the screen shows.\n");
    let times: Vec<String> = TIMES.iter().map(|time| format!("{time} ms")).collect();
    println!("| scene | edit | first draft | its width | all pixels | {} | brightness | caustic |", times.join(" | "));
    println!("|---|---|--:|--:|--:|{}--:|--:|", "--:|".repeat(TIMES.len()));
    for (name, file) in files {
        for edit in Edit::ALL {
            let (Some(before), Some(after)) = (edit.applied(file, 0.0), edit.applied(file, 1.0)) else { continue };
            let runs = Run::record_some(&before, &after);
            let screen = Screen::converged(&after, CONVERGED);
            let caustic = (edit == Edit::Point).then(|| Caustic::render(&after)).flatten();
            println!("| {name} | {} | {} |", edit.name(), row(&runs, &screen, caustic.as_ref(), side));
        }
    }
    println!();
}

/// The frames after an edit of a picture that has converged for a while.
struct Run {
    start: Instant,
    generation: u64,
    frames: Vec<Recorded>,
}

impl Run {
    fn record_some(before: &Arc<SceneFile>, after: &Arc<SceneFile>) -> Vec<Self> {
        let mut recorder = Recorder::start();
        for _ in 0..SETTLING_MOVES {
            recorder.show(Arc::clone(before));
            recorder.record(MOVE);
        }
        let mut run = || {
            recorder.show(Arc::clone(before));
            recorder.record(BEFORE);
            let start = recorder.show(Arc::clone(after));
            recorder.record(Duration::from_millis(TIMES[TIMES.len() - 1]));
            Self { start, generation: recorder.generation(), frames: recorder.frames.drain(..).collect() }
        };
        (0..REPEATS).map(|_| run()).collect()
    }

    /// The first frame of the edited scene for which `is_it` holds, and when it came, milliseconds after the edit.
    fn first(&self, is_it: impl Fn(&Frame) -> bool) -> Option<(&Frame, f64)> {
        let of_edit = |recorded: &&Recorded| recorded.frame.generation == self.generation && is_it(&recorded.frame);
        let Recorded { frame, came } = self.frames.iter().find(of_edit)?;
        Some((frame, 1e3 * (*came - self.start).as_secs_f64()))
    }

    /// What the screen shows this long after the edit.
    fn shown(&self, after: Duration) -> &Frame {
        let shown = self.frames.iter().rev().find(|recorded| recorded.came <= self.start + after);
        &shown.expect("the picture before the edit is shown").frame
    }
}

/// The cells of an edit: medians over its runs.
fn row(runs: &[Run], screen: &Screen, caustic: Option<&Caustic>, side: u32) -> String {
    let firsts: Vec<(&Frame, f64)> = runs.iter().filter_map(|run| run.first(|_| true)).collect();
    let wholes: Vec<(&Frame, f64)> =
        runs.iter().filter_map(|run| run.first(|frame| frame.image.width == side)).collect();
    let mut cells = vec![
        format!("{:.0} ms", median(firsts.iter().map(|(_, time)| *time))),
        format!("{:.0}", median(firsts.iter().map(|(frame, _)| f64::from(frame.image.width)))),
        format!("{:.0} ms", median(wholes.iter().map(|(_, time)| *time))),
    ];
    for time in TIMES {
        let distances: Vec<Distance> =
            runs.iter().map(|run| screen.distance(run.shown(Duration::from_millis(time)).shown())).collect();
        let flip = median(distances.iter().map(|distance| distance.flip));
        cells.push(format!("{flip:.3}, {:.1}", 100.0 * median(distances.iter().map(|distance| distance.rmse))));
    }
    let brightness = firsts.iter().map(|(frame, _)| screen.distance(frame.shown()).brightness);
    cells.push(format!("{:.3}", median(brightness)));
    cells.push(caustic.map_or_else(String::new, |caustic| {
        let likeness =
            |frames: &[(&Frame, f64)]| median(frames.iter().map(|(frame, _)| caustic.likeness(frame.shown())));
        format!("{:.3}, {:.3}", likeness(&firsts), likeness(&wholes))
    }));
    cells.join(" | ")
}

fn drags(files: &[(&str, SceneFile)], side: u32) {
    println!("While a control point is dragged, {side} x {side} pixels: the age of what the screen shows.\n");
    println!("| scene | pictures a second | width | age, median | age, 95 % |\n|---|--:|--:|--:|--:|");
    for (name, file) in files {
        if Edit::Point.applied(file, 0.0).is_none() {
            continue;
        }
        let mut recorder = Recorder::start();
        recorder.show(Edit::Point.applied(file, 0.0).expect("it was applied before"));
        recorder.record(BEFORE);
        let mut ages = Vec::new();
        for k in 0..DRAG_MOVES {
            let there_and_back = 0.5 - 0.5 * (TAU * f64::from(k) / f64::from(ROUND)).cos();
            recorder.show(Edit::Point.applied(file, there_and_back).expect("it was applied before"));
            recorder.record(MOVE);
            if k == SETTLING_MOVES {
                recorder.frames.clear();
            } else if k > SETTLING_MOVES
                && let Some(age) = recorder.age()
            {
                ages.push(1e3 * age.as_secs_f64());
            }
        }
        ages.sort_by(f64::total_cmp);
        let seconds = (MOVE * (DRAG_MOVES - SETTLING_MOVES)).as_secs_f64();
        let width = median(recorder.frames.iter().map(|recorded| f64::from(recorded.frame.image.width)));
        let at = |quantile: f64| ages[((ages.len() - 1) as f64 * quantile).round() as usize];
        let rate = recorder.frames.len() as f64 / seconds;
        println!("| {name} | {rate:.0} | {width:.0} | {:.0} ms | {:.0} ms |", at(0.5), at(0.95));
    }
    println!();
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
