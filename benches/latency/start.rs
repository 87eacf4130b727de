//! What the screen shows after a start, without a picture before it: with the display filter and without it.

use crate::recorder::Recorder;
use crate::screen::Screen;
use crate::{REPEATS, median};
use patchlight::engine::Frame;
use patchlight::film::LinearImage;
use patchlight::scene::SceneFile;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Times after the start, milliseconds.
const TIMES: [u64; 6] = [100, 200, 500, 1000, 2000, 4000];
/// Time for which the converged picture is rendered.
const CONVERGED: Duration = Duration::from_secs(30);

/// Prints the table of some scenes.
pub(crate) fn table(files: &[(&str, SceneFile)], side: u32) {
    println!("After a start, {side} x {side} pixels: FLIP without the display filter, with it, and their ratio.\n");
    let times: Vec<String> = TIMES.iter().map(|time| format!("{time} ms")).collect();
    println!("| scene | {} |\n|---|{}", times.join(" | "), "--:|".repeat(TIMES.len()));
    for (name, file) in files {
        let file = Arc::new(file.clone());
        let starts: Vec<Vec<Option<Arc<Frame>>>> = (0..REPEATS).map(|_| frames(&file)).collect();
        let screen = Screen::converged(&file, CONVERGED);
        let cells: Vec<String> =
            (0..TIMES.len()).map(|k| cell(&screen, starts.iter().filter_map(|frames| frames[k].as_deref()))).collect();
        println!("| {name} | {} |", cells.join(" | "));
    }
    println!();
}

/// The frame that is shown at each time after a start.
fn frames(file: &Arc<SceneFile>) -> Vec<Option<Arc<Frame>>> {
    let mut recorder = Recorder::start();
    let start = recorder.show(Arc::clone(file));
    let mut shown = Vec::new();
    for time in TIMES {
        recorder.record((start + Duration::from_millis(time)).saturating_duration_since(Instant::now()));
        // A busy machine may not have shown anything yet.
        shown.push(recorder.frames.last().map(|recorded| Arc::clone(&recorded.frame)));
    }
    shown
}

fn cell<'a>(screen: &Screen, frames: impl Iterator<Item = &'a Frame> + Clone) -> String {
    let flip =
        |image: fn(&Frame) -> &LinearImage| median(frames.clone().map(|frame| screen.distance(image(frame)).flip));
    let (without, with) = (flip(|frame| &frame.image), flip(|frame| frame.shown()));
    format!("{without:.4}, {with:.4}: {:.2}", with / without)
}
