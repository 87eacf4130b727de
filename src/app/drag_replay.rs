//! Replays a drag in a real window, and measures the window's thread: how long each frame keeps it, and how old the picture is that
//! the frame shows.

use super::canvas::Projection;
use super::document::{Handle, PointIndex};
use super::startup::{AppError, open_window};
use super::window::Window;
use crate::engine::Frame as Picture;
use crate::scene::SceneFile;
use eframe::{App, Frame};
use egui::{Context, Event, Modifiers, PointerButton, Pos2, RawInput, Ui, Vec2, ViewportBuilder, ViewportCommand};
use std::f32::consts::TAU;
use std::mem::take;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

/// The radius of the circle that the pointer follows, screen points.
const RADIUS: f32 = 40.0;
/// The time of one round, seconds.
const ROUND: f32 = 4.0;
/// The time before the drag in which the panels settle and the first pictures come, seconds.
const BEFORE: f32 = 2.0;

/// A frame of the window during a drag.
#[derive(Clone, Copy, Debug, Default)]
pub struct WindowFrame {
    /// The time for which the frame kept the window's thread: input, panels, painting and upload, seconds.
    pub busy: f64,
    /// The time from the beginning of the frame before to the beginning of this one, seconds.
    pub interval: f64,
    /// The time since the newest picture of the engine came, while the frame still shows an older one; 0 if it shows the newest, seconds.
    pub behind: f64,
    /// The number of pictures that the engine made so far.
    pub pictures: usize,
}

/// Drags a control point of the scene's first Bezier patch around in a window of this size in points, for some seconds. Returns the frames
/// of the window during the drag; none for a scene without patches.
///
/// # Errors
/// Returns an error when no window can open, or the engine cannot start.
pub fn replay_drag(scene: SceneFile, size: [f32; 2], seconds: f32) -> Result<Vec<WindowFrame>, AppError> {
    let frames = Arc::new(Mutex::new(Vec::new()));
    let recorded = Arc::clone(&frames);
    let viewport = ViewportBuilder::default().with_inner_size(size);
    open_window(scene, viewport, None, move |window| Box::new(Replay::new(window, seconds, frames)))?;
    Ok(take(&mut *recorded.lock().unwrap_or_else(PoisonError::into_inner)))
}

/// A window whose pointer follows a circle.
struct Replay {
    window: Window,
    seconds: f32,
    /// The first frame, and the beginning of the present one.
    start: Instant,
    frame_start: Instant,
    /// Where the drag began; `None` before it.
    grabbed: Option<Pos2>,
    newest: Option<(Arc<Picture>, Instant)>,
    pictures: usize,
    frames: Arc<Mutex<Vec<WindowFrame>>>,
}

impl Replay {
    fn new(window: Window, seconds: f32, frames: Arc<Mutex<Vec<WindowFrame>>>) -> Self {
        let now = Instant::now();
        Self { window, seconds, start: now, frame_start: now, grabbed: None, newest: None, pictures: 0, frames }
    }

    /// Where the dragged control point lies on the screen; `None` before the first frame, and without patches.
    fn handle(&self) -> Option<Pos2> {
        let editor = self.window.editor();
        let (scene, object) = (editor.document.scene(), editor.document.selection.item);
        let object = if let crate::app::document::Item::Object(object) = object { object } else { return None };
        let point = PointIndex { patch: 0, i: 1, j: 1 };
        let world = Handle::Point { object, point }.position(scene)?;
        let film = Projection::new(&scene.camera, &scene.film)?.project(world)?;
        Some(editor.canvas.transform?.to_screen(film))
    }

    /// The frame that ends now, with the time that the window's thread spent on the one before.
    fn record(&mut self, busy: f64) {
        let newest = self.window.editor().rendering.frame();
        if let Some(newest) =
            newest.filter(|newest| self.newest.as_ref().is_none_or(|(known, _)| !Arc::ptr_eq(known, newest)))
        {
            self.newest = Some((Arc::clone(newest), self.frame_start));
            self.pictures += 1;
        }
        let now = Instant::now();
        let is_behind = !self.window.editor().display.is_up_to_date();
        let behind = self.newest.as_ref().filter(|_| is_behind).map_or(0.0, |(_, since)| since.elapsed().as_secs_f64());
        let interval = (now - self.frame_start).as_secs_f64();
        self.frame_start = now;
        if self.grabbed.is_some() {
            let frame = WindowFrame { busy, interval, behind, pictures: self.pictures };
            self.frames.lock().unwrap_or_else(PoisonError::into_inner).push(frame);
        }
    }
}

impl App for Replay {
    fn raw_input_hook(&mut self, _ctx: &Context, input: &mut RawInput) {
        let seconds = self.start.elapsed().as_secs_f32() - BEFORE;
        let button = |pos, pressed| Event::PointerButton {
            pos,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        };
        match self.grabbed {
            None if seconds >= 0.0 => {
                if let Some(at) = self.handle() {
                    input.events.extend([Event::PointerMoved(at), button(at, true)]);
                    self.grabbed = Some(at);
                }
            }
            Some(start) => {
                let circle = Vec2::angled(TAU * seconds / ROUND) - Vec2::angled(0.0);
                input.events.push(Event::PointerMoved(start + RADIUS * circle));
            }
            None => {}
        }
    }

    fn logic(&mut self, ctx: &Context, frame: &mut Frame) {
        self.window.logic(ctx, frame);
        if self.start.elapsed().as_secs_f32() > BEFORE + self.seconds {
            self.window.discard();
            ctx.send_viewport_cmd(ViewportCommand::Close);
        }
        // A user's hand moves the pointer before each frame.
        ctx.request_repaint();
    }

    fn ui(&mut self, ui: &mut Ui, frame: &mut Frame) {
        self.window.ui(ui, frame);
        self.record(frame.info().cpu_usage.map_or(0.0, f64::from));
    }
}
