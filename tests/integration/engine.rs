//! The engine: drafts first, newest scene wins, pause, restart, failures.

use crate::support::scene;
use crossbeam_channel::{Receiver, Sender, bounded};
use glam::DVec3;
use patchlight::engine::{Command, Engine, EngineSettings, Frame, Limits, Session, Status};
use patchlight::film::LinearImage;
use patchlight::math::Rgb;
use patchlight::scene::{Emitter, Light, SceneFile, Shape};
use patchlight::transport::{Cancel, Component};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Timeout of a wait, long enough for the slowest machine.
const PATIENCE: Duration = Duration::from_secs(60);

fn room(radius: f64) -> Arc<SceneFile> {
    Arc::new(scene(&format!(
        "[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 0]\nfov_y = 40\n[film]\nwidth = 64\nheight = 48
        [[material]]\nname = \"glass\"\ntype = \"glass\"\nior = 1.5
        [[material]]\nname = \"wall\"\ntype = \"diffuse\"\nalbedo = [0.5, 0.4, 0.3]
        [[object]]\nname = \"ball\"\ntype = \"sphere\"\ncenter = [0,0,0]\nradius = {radius}\nmaterial = \"glass\"
        [[object]]\nname = \"floor\"\ntype = \"plane\"\npoint = [0,-1,0]\nnormal = [0,1,0]\nmaterial = \"wall\"
        [[light]]\nname = \"l\"\ntype = \"point\"\nposition = [1, 1.5, 1]\nintensity = [2, 2, 2]\n"
    )))
}

#[test]
fn an_error_estimate_waits_for_noise_and_bias() {
    let estimated_from = |file: &SceneFile| {
        let mut session = Session::prepare(file, 1, None).expect("the scene can be prepared");
        (1..10).find(|_| {
            session.advance(Cancel::NEVER).expect("never cancelled");
            let estimate = session.stats().error_estimate;
            assert_eq!(session.reaches(f64::INFINITY), estimate.is_some());
            estimate.is_some()
        })
    };
    assert_eq!(estimated_from(&room(0.5)), Some(5), "the ball's caustic is sharp");
    let mut diffuse = room(0.5).as_ref().clone();
    diffuse.scene.objects.remove(0);
    assert_eq!(estimated_from(&diffuse), Some(3));
}

fn engine() -> Engine {
    Engine::start(EngineSettings { threads: Some(2), seed: 1 }, || {}).expect("threads")
}

fn wait_for<T>(mut condition: impl FnMut() -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        if let Some(found) = condition() {
            return found;
        }
        assert!(start.elapsed() < PATIENCE, "the engine did not get there");
        std::thread::yield_now();
    }
}

fn frame_where(engine: &Engine, condition: impl Fn(&Frame) -> bool) -> Arc<Frame> {
    wait_for(|| engine.newest_frame().filter(|frame| condition(frame)))
}

/// An engine that waits at each frame until the test has looked, so that the test sees every one.
struct Watched {
    called: Receiver<()>,
    look: Sender<()>,
    engine: Engine,
}

impl Watched {
    fn start() -> Self {
        let (call, called) = bounded(0);
        let (look, looked) = bounded::<()>(0);
        let wake = move || {
            // Both fail once the test is over.
            let _looked = call.send(()).is_ok() && looked.recv().is_ok();
        };
        let engine = Engine::start(EngineSettings { threads: Some(2), seed: 1 }, wake).expect("threads");
        Self { called, look, engine }
    }

    /// All frames up to the first for which the condition holds.
    fn frames_until(&mut self, condition: impl Fn(&Frame) -> bool) -> Vec<Arc<Frame>> {
        let mut frames: Vec<Arc<Frame>> = Vec::new();
        while frames.last().is_none_or(|frame| !condition(frame)) {
            self.called.recv_timeout(PATIENCE).expect("the engine gets there");
            frames.extend(self.engine.newest_frame());
            self.look.send(()).expect("the engine waits");
        }
        frames
    }
}

#[test]
fn a_draft_comes_first_and_then_the_picture() {
    let mut engine = Watched::start();
    assert_eq!(engine.engine.status(), Status::Idle);
    engine.engine.send(Command::Show(room(0.5)));
    let frames = engine.frames_until(|frame| !frame.draft && frame.stats.error_estimate.is_some());
    let size = |frame: &Frame| (frame.image.width, frame.image.height);
    let (drafts, pictures) = frames.split_at(frames.iter().take_while(|frame| frame.draft).count());
    assert!(!drafts.is_empty(), "the first frame is a draft");
    assert!(drafts.iter().all(|draft| draft.iteration == 0 && draft.generation == 1));
    assert!(drafts.iter().all(|draft| size(draft) == (64, 48)), "coarse drafts are shown with the film's pixels");
    assert!(pictures.iter().all(|frame| !frame.draft && size(frame) == (64, 48) && frame.generation == 1));
    assert_eq!(pictures[0].iteration, 1);
    assert!(pictures.is_sorted_by(|a, b| a.iteration < b.iteration));
    let last = pictures.last().expect("a picture with an estimate");
    assert!(last.stats.photons_emitted > 0 && last.stats.seconds > 0.0);
}

/// During a fast drag every edit outdates the one before: pictures still appear, in order, and the last edit's
/// picture stays.
#[test]
fn pictures_appear_during_a_fast_drag() {
    let engine = engine();
    let (mut shown, mut newest) = (0, 0);
    for edit in 1..=60 {
        engine.send(Command::Show(room(0.3 + 0.005 * f64::from(edit))));
        let until = Instant::now() + Duration::from_millis(16);
        while Instant::now() < until {
            if let Some(frame) = engine.newest_frame() {
                assert!(frame.generation >= newest, "never back to an older scene");
                (shown, newest) = (shown + 1, frame.generation);
            }
            std::thread::yield_now();
        }
    }
    assert!(shown >= 5, "{shown} pictures in a drag of 60 edits");
    assert_eq!(frame_where(&engine, |frame| !frame.draft).generation, 60);
}

/// The first frame after an edit of a picture that has converged for a while, and the picture before.
fn edited(edit: impl FnOnce(&mut SceneFile)) -> [Arc<Frame>; 2] {
    let mut engine = Watched::start();
    engine.engine.send(Command::Show(room(0.5)));
    let before = engine.frames_until(|frame| frame.iteration >= 20);
    let mut file = room(0.5).as_ref().clone();
    edit(&mut file);
    engine.engine.send(Command::Show(Arc::new(file)));
    let after = engine.frames_until(|frame| frame.generation == 2);
    [before, after].map(|frames| frames.last().expect("there are frames").clone())
}

/// The mean relative difference between the red values of two pictures in the rows from `first` on.
fn difference(a: &Frame, b: &Frame, first: usize) -> f32 {
    let pixels = a.shown().pixels.iter().zip(&b.shown().pixels).skip(first * 64);
    let pairs: Vec<_> = pixels.map(|(a, b)| (a.x, b.x)).collect();
    pairs.iter().map(|(a, b)| (a - b).abs()).sum::<f32>() / pairs.iter().map(|(a, _)| a).sum::<f32>()
}

/// The ball becomes smaller, and more of the floor's light comes from it.
#[test]
fn the_picture_before_an_edit_stands_in_for_what_has_not_changed() {
    let [before, after] = edited(|file| {
        let Shape::Sphere { radius, .. } = &mut file.scene.objects[0].shape else { panic!("the ball comes first") };
        *radius = 0.45;
    });
    assert!(after.draft && after.image.width == 64, "all pixels at once");
    let below = difference(&before, &after, 44);
    assert!(below > 0.0 && below < 0.05, "the floor in front is as before: {below}");
}

#[test]
fn brighter_light_makes_the_picture_before_brighter() {
    let [before, after] = edited(|file| {
        let Emitter::Point { intensity, .. } = &mut file.scene.lights[0].emitter else { panic!("a point") };
        *intensity *= 2.0;
    });
    let brighter = Frame {
        image: Arc::new(LinearImage {
            pixels: before.shown().pixels.iter().map(|p| 2.0 * *p).collect(),
            ..*before.image.as_ref()
        }),
        ..before.as_ref().clone()
    };
    let difference = difference(&brighter, &after, 44);
    assert!(difference < 0.02, "{difference}");
}

#[test]
fn a_camera_that_moves_sees_what_it_saw_before_from_elsewhere() {
    let [before, after] = edited(|file| file.scene.camera.position += DVec3::new(0.2, 0.0, 0.0));
    assert!(after.draft && after.image.width == 64, "all pixels at once");
    let mut moved = room(0.5).as_ref().clone();
    moved.scene.camera.position += DVec3::new(0.2, 0.0, 0.0);
    let mut session = Session::prepare(&moved, 2, None).expect("the scene can be prepared");
    (0..20).for_each(|_| session.advance(Cancel::NEVER).expect("never cancelled"));
    let truth = session.frame(2);
    let [now, then] = [&after, &before].map(|frame| difference(&truth, frame, 40));
    assert!(now < 0.5 * then, "{now} instead of {then}");
}

/// A draft would be coarse if there was no picture before: a restart begins without one.
#[test]
fn a_restart_begins_without_the_picture_before() {
    let engine = engine();
    engine.send(Command::Show(room(0.5)));
    frame_where(&engine, |frame| frame.iteration >= 2);
    engine.send(Command::Restart);
    let frame = frame_where(&engine, |frame| frame.generation == 2 && !frame.draft);
    assert!(frame.preview.is_none());
}

#[test]
fn a_picture_rests_at_its_limits() {
    let engine = engine();
    engine.send(Command::Limits(Limits { iterations: Some(3), seconds: None }));
    engine.send(Command::Show(room(0.5)));
    let rested = || wait_for(|| (engine.status() == Status::LimitReached).then(|| engine.newest_frame()));
    assert_eq!(rested().map(|frame| frame.iteration), Some(3));
    engine.send(Command::Limits(Limits { iterations: Some(5), seconds: None }));
    let more = frame_where(&engine, |frame| frame.iteration == 5);
    engine.send(Command::Limits(Limits { iterations: None, seconds: Some(1e-9) }));
    engine.send(Command::Show(room(0.6)));
    let edited = frame_where(&engine, |frame| frame.generation > more.generation && !frame.draft);
    assert_eq!(edited.iteration, 1, "a picture has one iteration at least");
    rested();
}

/// A component is the picture of a session for it alone; frames tell noise and what pixels show.
#[test]
fn a_component_is_rendered_alone_and_noise_is_told_on_demand() {
    let mut engine = Watched::start();
    engine.engine.send(Command::Noise(true));
    engine.engine.send(Command::Show(room(0.5)));
    let all = engine.frames_until(|frame| frame.iteration >= 6).last().expect("there are frames").clone();
    let noise = all.noise.as_ref().expect("it was asked for");
    let mean = f64::from(noise.iter().sum::<f32>()) / noise.len() as f64;
    assert!(noise.len() == 64 * 48 && mean > 0.0 && mean < 0.2, "{mean}");
    let g_buffer = all.g_buffer.as_ref().expect("after the first iteration");
    let middle = g_buffer.first_hits[24 * 64 + 32];
    assert!(middle.object == Some(0) && (middle.depth - 3.5).abs() < 0.05, "the ball: {middle:?}");
    engine.engine.send(Command::Only(Some(Component::Caustics)));
    engine.engine.send(Command::Noise(false));
    let alone = engine.frames_until(|frame| frame.generation == 2 && frame.iteration >= 4);
    let alone = alone.last().expect("there are frames");
    let session = Session::prepare(&room(0.5), 1, None).expect("the scene can be prepared");
    let mut session = session.only(Some(Component::Caustics));
    while session.iterations() < alone.iteration {
        session.advance(Cancel::NEVER).expect("never cancelled");
    }
    assert_eq!(alone.image, session.frame(2).image);
    assert!(alone.noise.is_none());
}

/// Undo shows the picture as it was left, and it goes on converging; its display settings do not matter.
#[test]
fn a_scene_that_comes_back_has_its_picture_at_once() {
    let mut engine = Watched::start();
    engine.engine.send(Command::Show(room(0.5)));
    let left = engine.frames_until(|frame| frame.iteration >= 20).last().expect("there are frames").clone();
    engine.engine.send(Command::Show(room(0.4)));
    engine.frames_until(|frame| frame.generation == 2 && frame.iteration >= 1);
    let mut brighter = room(0.5).as_ref().clone();
    brighter.scene.film.exposure += 1.0;
    engine.engine.send(Command::Show(Arc::new(brighter)));
    let back = engine.frames_until(|frame| frame.generation == 3 && frame.iteration > left.iteration + 2);
    let of_it: Vec<_> = back.iter().filter(|frame| frame.generation == 3).collect();
    assert!(!of_it[0].draft && of_it[0].iteration >= left.iteration, "iteration {}", of_it[0].iteration);
    let mut session = Session::prepare(&room(0.5), 1, None).expect("the scene can be prepared");
    while session.iterations() < of_it[of_it.len() - 1].iteration {
        session.advance(Cancel::NEVER).expect("never cancelled");
    }
    assert_eq!(of_it[of_it.len() - 1].image, session.frame(1).image, "the same film as without a visit elsewhere");
    engine.engine.send(Command::Restart);
    let again = engine.frames_until(|frame| frame.generation == 4 && frame.iteration >= 1);
    assert_eq!(again.last().map(|frame| frame.iteration), Some(1), "a restart begins anew");
}

/// Less noise is for the screen alone: the film has the bits of a rendering without a screen. It comes and goes while the engine pauses.
#[test]
fn a_smoothed_preview_leaves_the_film_as_it_is() {
    let mut file = SceneFile::built_in("cornell").expect("there is such a scene");
    (file.scene.film.width, file.scene.film.height) = (64, 64);
    let engine = engine();
    engine.send(Command::Smooth(true));
    engine.send(Command::Show(Arc::new(file.clone())));
    let draft = frame_where(&engine, |frame| frame.draft);
    assert!(draft.smoothed && draft.shown() != &draft.image, "drafts are smoothed, too");
    let smoothed = frame_where(&engine, |frame| frame.iteration >= 2);
    let mut session = Session::prepare(&file, 1, None).expect("the scene can be prepared");
    while session.iterations() < smoothed.iteration {
        session.advance(Cancel::NEVER).expect("never cancelled");
    }
    assert_eq!(smoothed.image, session.frame(1).image, "the same film as without a screen");
    assert!(smoothed.smoothed && smoothed.shown() != &smoothed.image);
    pause(&engine);
    let held = wait_for(|| engine.newest_frame());
    engine.send(Command::Smooth(false));
    let as_it_is = wait_for(|| engine.newest_frame());
    assert!(!as_it_is.smoothed && as_it_is.preview.is_none());
    assert_eq!((as_it_is.iteration, &as_it_is.image), (held.iteration, &held.image));
    engine.send(Command::Smooth(true));
    let before = wait_for(|| engine.newest_frame());
    assert!(before.smoothed);
    engine.send(Command::Show(Arc::new(file)));
    let after = frame_where(&engine, |frame| frame.generation == 2);
    let pairs = || after.image.pixels.iter().zip(&before.shown().pixels);
    assert!(pairs().all(|(a, b)| (*a - *b).abs().max_element() < 1e-4), "the smoothed picture stands in");
}

/// An engine that holds a picture.
fn paused_engine() -> Engine {
    let engine = engine();
    engine.send(Command::Show(room(0.5)));
    frame_where(&engine, |frame| frame.iteration >= 2);
    pause(&engine);
    engine
}

/// Returns once the engine pauses.
fn pause(engine: &Engine) {
    engine.send(Command::Pause);
    wait_for(|| (engine.status() == Status::Paused).then_some(()));
}

#[test]
fn pause_holds_and_restart_begins_again() {
    let engine = paused_engine();
    let held = wait_for(|| engine.newest_frame());
    std::thread::sleep(Duration::from_millis(100));
    assert!(engine.newest_frame().is_none(), "no frame while the engine pauses");
    engine.send(Command::Resume);
    frame_where(&engine, |frame| frame.iteration > held.iteration);
    pause(&engine);
    engine.send(Command::Restart);
    // While paused, the engine renders one iteration of a picture that it begins.
    let restarted = frame_where(&engine, |frame| frame.generation == 2 && !frame.draft);
    assert_eq!(restarted.iteration, 1, "the film begins again");
}

#[test]
fn a_converged_picture_rests_until_the_target_or_the_scene_changes() {
    let engine = engine();
    engine.send(Command::Target(Some(0.2)));
    engine.send(Command::Show(room(0.5)));
    let converged = || wait_for(|| (engine.status() == Status::Converged).then(|| engine.newest_frame()));
    let error = |frame: &Frame| frame.stats.error_estimate.expect("it is known");
    let rough = converged().expect("the last frame has the reached error");
    assert!(error(&rough) <= 0.2, "{}", error(&rough));
    std::thread::sleep(Duration::from_millis(100));
    assert!(engine.newest_frame().is_none(), "no frame while the engine rests");
    let finer = 0.5 * error(&rough);
    engine.send(Command::Target(Some(finer)));
    let fine = frame_where(&engine, |frame| error(frame) <= finer);
    assert!(fine.generation == rough.generation && fine.iteration > rough.iteration, "it goes on where it rested");
    converged();
    engine.send(Command::Show(room(0.6)));
    frame_where(&engine, |frame| frame.generation == 2 && !frame.draft);
    converged();
    engine.send(Command::Target(None));
    frame_where(&engine, |frame| frame.iteration > fine.iteration);
}

#[test]
fn an_edit_while_paused_gets_one_iteration() {
    let engine = paused_engine();
    engine.send(Command::Show(room(0.6)));
    let edited = frame_where(&engine, |frame| frame.generation == 2 && !frame.draft);
    assert_eq!(edited.iteration, 1);
    wait_for(|| (engine.status() == Status::Paused).then_some(()));
    assert!(engine.newest_frame().is_none_or(|frame| frame.iteration == 1), "then it pauses");
}

#[test]
fn an_invalid_scene_gives_a_reason_and_the_next_scene_renders() {
    let mut broken = (*room(0.5)).clone();
    "missing".clone_into(&mut broken.scene.objects[0].material);
    let engine = engine();
    engine.send(Command::Show(Arc::new(broken)));
    let reason = wait_for(|| if let Status::Failed(reason) = engine.status() { Some(reason) } else { None });
    assert!(reason.contains("`ball`") && reason.contains("`missing`"), "{reason}");
    engine.send(Command::Show(room(0.5)));
    assert_eq!(frame_where(&engine, |frame| frame.iteration >= 1).generation, 2);
}

/// The thread that renders outlives a caller's function that panics, at a status as well as at a frame.
#[test]
fn a_panic_when_waking_the_caller_stops_nothing() {
    let wake = || std::panic::resume_unwind(Box::new("the caller's fault"));
    let engine = Engine::start(EngineSettings { threads: Some(2), seed: 1 }, wake).expect("threads");
    engine.send(Command::Show(room(0.5)));
    frame_where(&engine, |frame| frame.iteration >= 1);
    engine.send(Command::Pause);
    wait_for(|| (engine.status() == Status::Paused).then_some(()));
}

#[test]
fn dropping_the_engine_ends_its_thread() {
    let (alive, ended) = crossbeam_channel::bounded::<()>(0);
    let wake = move || {
        // The thread owns this end of the channel.
        let _alive = &alive;
    };
    let engine = Engine::start(EngineSettings { threads: Some(2), seed: 1 }, wake).expect("threads");
    engine.send(Command::Show(room(0.5)));
    wait_for(|| engine.newest_frame());
    drop(engine);
    assert_eq!(ended.recv_timeout(PATIENCE), Err(crossbeam_channel::RecvTimeoutError::Disconnected));
}

/// A lamp so strong that three of its paths would outshine the picture: what they would bring shows no noise, but may be missing.
#[test]
fn light_that_was_never_sampled_counts_as_error() {
    let after = |hidden: f32| {
        let mut file = room(0.5).as_ref().clone();
        // Below the floor, which hides all of its light.
        let emitter = Emitter::Point { position: DVec3::new(0.0, -3.0, 0.0), intensity: Rgb::splat(hidden) };
        file.scene.lights.push(Light { name: "hidden".to_owned(), emitter });
        let mut session = Session::prepare(&file, 1, None).expect("the scene can be prepared");
        (0..8).for_each(|_| session.advance(Cancel::NEVER).expect("never cancelled"));
        session.stats()
    };
    let (near, far) = (after(0.0), after(1e6));
    assert!(near.error_estimate.is_some_and(|error| error < 0.5) && near.missing_light.is_none(), "{near:?}");
    assert!(far.error_estimate.is_some_and(|error| error > 1.0), "{far:?}");
    let missing = far.missing_light.expect("photons are missing").to_string();
    assert!(missing.contains("too few photons for"), "{missing}");
}

/// A worker thread in the middle of a step does not keep the program from ending.
#[test]
fn leaving_does_not_wait_for_a_step() {
    let (release, held) = crossbeam_channel::bounded::<()>(0);
    let hold = move || {
        // An error means that the test is over.
        let _released = held.recv();
    };
    let engine = Engine::start(EngineSettings { threads: Some(2), seed: 1 }, hold).expect("threads");
    engine.send(Command::Show(room(0.5)));
    let (left, has_left) = crossbeam_channel::bounded(1);
    std::thread::spawn(move || {
        drop(engine);
        left.send(()).expect("the test waits");
    });
    has_left.recv_timeout(PATIENCE).expect("the engine is left while its thread is held up");
    drop(release);
}
