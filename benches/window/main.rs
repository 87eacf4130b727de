//! The stalls of the window's thread while a control point is dragged for twenty seconds. Needs a display: `xvfb-run cargo bench --bench
//! window`.

#![allow(clippy::expect_used, reason = "a measurement that cannot go on has failed")]
#![allow(clippy::print_stdout, reason = "the benchmark prints a table")]

use patchlight::app::{WindowFrame, replay_drag};
use patchlight::scene::SceneFile;

const SIZE: [f32; 2] = [1280.0, 960.0];
const SECONDS: f32 = 20.0;

/// The value below which this fraction of the sorted values lies, milliseconds.
fn milliseconds(sorted: &[f64], fraction: f64) -> f64 {
    1e3 * sorted[((sorted.len() - 1) as f64 * fraction).round() as usize]
}

fn row(name: &str, frames: &[WindowFrame], seconds: fn(&WindowFrame) -> f64) {
    let mut sorted: Vec<f64> = frames.iter().map(seconds).collect();
    sorted.sort_by(f64::total_cmp);
    let [median, p95, p99, most] = [0.5, 0.95, 0.99, 1.0].map(|fraction| milliseconds(&sorted, fraction));
    println!("| {name} | {median:.1} | {p95:.1} | {p99:.1} | {most:.1} |");
}

fn main() {
    let scene = std::env::args().skip(1).find(|argument| !argument.starts_with('-'));
    let scene = scene.unwrap_or_else(|| "report".to_owned());
    let file = SceneFile::find(scene.as_ref()).expect("there is such a scene");
    let frames = replay_drag(file, SIZE, SECONDS).expect("there is a display");
    let pictures = frames.last().expect("the scene has patches").pictures - frames[0].pictures;
    println!("{scene}, {} x {} points, {SECONDS} s: {} frames, {pictures} pictures", SIZE[0], SIZE[1], frames.len());
    println!("| ms | median | 95 % | 99 % | longest |");
    println!("|---|---|---|---|---|");
    row("the window's thread is busy", &frames, |frame| frame.busy);
    row("between two frames", &frames, |frame| frame.interval);
    row("the newest picture waits", &frames, |frame| frame.behind);
}
