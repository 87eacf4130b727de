use super::{measurement::Measurement, table, truth::Truth};
use crate::{
    cli::{
        CliError,
        rendering::{advance, advance_until},
    },
    engine::Session,
    scene::SceneFile,
    transport::Component,
};
use std::io::{Write, stdout};

/// The measurement of one scene.
pub(super) struct Trial {
    pub(super) file: SceneFile,
    pub(super) truth: Truth,
    /// The marks in seconds, ascending.
    pub(super) marks: Vec<f64>,
    pub(super) seeds: u64,
    /// The component of the light that is measured; `None` for all.
    pub(super) only: Option<Component>,
}

impl Trial {
    /// The measurement of a scene with the image size of the reference, after each of these seconds and with this number of
    /// seeds.
    pub(super) fn new(mut file: SceneFile, truth: Truth, seconds: &[f64], seeds: u64) -> Self {
        (file.scene.film.width, file.scene.film.height) = truth.size();
        let mut marks = seconds.to_vec();
        marks.sort_by(f64::total_cmp);
        Self { file, truth, marks, seeds, only: None }
    }

    /// The measurement of one component of the light, or of all.
    pub(super) fn only(self, only: Option<Component>) -> Self {
        Self { only, ..self }
    }

    /// Measures with each seed, and prints each measurement. Renders in the current thread pool.
    pub(super) fn measure(&self) -> Result<Vec<Measurement>, CliError> {
        writeln!(stdout(), "{}", table::header(self.truth.is_masked()))?;
        let mut rows = Vec::new();
        for seed in 0..self.seeds {
            self.measure_seed(seed, &mut rows)?;
        }
        write!(stdout(), "{}", table::summary(&rows, self.seeds))?;
        Ok(rows)
    }

    /// Renders until the last mark and measures at each mark, but not before the end of the first iteration.
    fn measure_seed(&self, seed: u64, rows: &mut Vec<Measurement>) -> Result<(), CliError> {
        let mut session = Session::prepare(&self.file, seed, None)?.only(self.only);
        let mut last = advance(&mut session);
        for mark in &self.marks {
            last = advance_until(&mut session, last, *mark);
            let frame = session.frame(0);
            let (errors, outside) = self.truth.errors(&frame.image)?;
            let (flip, flip_outside) = self.truth.flip(&frame.image, &self.file.scene.film);
            let row = Measurement { seed, mark: *mark, stats: frame.stats, errors, outside, flip, flip_outside };
            writeln!(stdout(), "{}", table::line(&row))?;
            rows.push(row);
        }
        Ok(())
    }
}
