//! The analysis over the picture, made off the UI thread.

use super::choice::Analysis;
use super::image::{Analysed, analysed};
use super::legend::legend_ui;
use crate::app::canvas::projection::Projection;
use crate::app::canvas::stage::Stage;
use crate::app::document::Item;
use crate::scene::SceneFile;
use crossbeam_channel::{Receiver, Sender, bounded};
use egui::{Color32, Context, Pos2, Rect, TextureHandle, TextureOptions, Ui, Vec2};
use std::sync::Arc;

/// A Bezier object to analyse as the camera sees it.
#[derive(Clone, Debug)]
struct Job {
    file: Arc<SceneFile>,
    object: usize,
    projection: Projection,
    /// The size of the shown film, pixels; it differs from the scene's film where the picture matches the window.
    film: Vec2,
    analysis: Analysis,
}

impl Job {
    fn same_result(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.file, &other.file)
            && (self.object, self.projection, self.film, self.analysis)
                == (other.object, other.projection, other.film, other.analysis)
    }

    fn run(&self) -> Option<Analysed> {
        let surface = self.file.scene.objects.get(self.object)?.shape.surface()?;
        Some(analysed(&self.file.scene, self.object, surface, &self.projection, self.film, self.analysis))
    }
}

/// A finished job; without an image where its object has no patches.
type Done = (Job, Option<Analysed>);

/// A finished job with its texture.
struct Shown {
    job: Job,
    texture: TextureHandle,
    scale: Option<f64>,
}

/// The analysis of the selected surface over the picture. The image is kept until the scene, the camera or the analysis changes.
pub(crate) struct AnalysisLayer {
    pub(crate) analysis: Analysis,
    requested: Option<Job>,
    shown: Option<Shown>,
    busy: bool,
    done: (Sender<Done>, Receiver<Done>),
}

impl Default for AnalysisLayer {
    fn default() -> Self {
        Self { analysis: Analysis::default(), requested: None, shown: None, busy: false, done: bounded(1) }
    }
}

impl std::fmt::Debug for AnalysisLayer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("AnalysisLayer").field("analysis", &self.analysis).finish_non_exhaustive()
    }
}

impl AnalysisLayer {
    /// Whether the image of the present request is shown.
    #[cfg(test)]
    pub(crate) fn is_shown(&self) -> bool {
        self.shown.as_ref().zip(self.requested.as_ref()).is_some_and(|(shown, job)| shown.job.same_result(job))
    }

    /// Shows the analysis of the selected Bezier object, once it is made. While a job is busy, the newest request waits.
    pub(in crate::app::canvas) fn show(&mut self, ui: &mut Ui, stage: &Stage<'_>) {
        if let Ok((job, analysed)) = self.done.1.try_recv() {
            self.busy = false;
            self.shown = analysed.map(|analysed| upload(ui.ctx(), job, analysed));
        }
        self.requested = self.job(stage);
        let Some(job) = &self.requested else { return };
        let is_shown = self.shown.as_ref().is_some_and(|shown| shown.job.same_result(job));
        if !self.busy && !is_shown {
            self.busy = true;
            start(job.clone(), self.done.0.clone(), ui.ctx().clone());
        }
        // During a drag the last image stays until the next is made.
        if let Some(shown) =
            self.shown.as_ref().filter(|shown| (shown.job.object, shown.job.analysis) == (job.object, job.analysis))
        {
            let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
            let painter = ui.painter_at(stage.transform.canvas);
            painter.image(shown.texture.id(), stage.transform.picture(), whole, Color32::WHITE);
            if let Some((shading, scale)) = job.analysis.shading.zip(shown.scale) {
                legend_ui(ui, stage.transform.canvas, shading, scale);
            }
        }
    }

    /// The job for the present scene; `None` where nothing is to be drawn.
    fn job(&self, stage: &Stage<'_>) -> Option<Job> {
        let document = stage.document;
        let Item::Object(object) = document.selection.item else { return None };
        document.selection.surface(document.scene())?;
        let analysis = self.analysis;
        let (projection, film) = (stage.projection, stage.transform.film);
        let job = Job { file: Arc::clone(document.file()), object, projection, film, analysis };
        (analysis != Analysis::default()).then_some(job)
    }
}

fn start(job: Job, done: Sender<Done>, ctx: Context) {
    rayon::spawn(move || {
        let analysed = job.run();
        // One job runs at a time, so the channel has room; it is closed only after the window.
        if done.try_send((job, analysed)).is_ok() {
            ctx.request_repaint();
        }
    });
}

fn upload(ctx: &Context, job: Job, Analysed { image, scale }: Analysed) -> Shown {
    Shown { job, texture: ctx.load_texture("analysis", image, TextureOptions::LINEAR), scale }
}
