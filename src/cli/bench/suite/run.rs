use super::file::{Entry, Name, Positive};
use crate::{
    cli::{
        CliError,
        bench::{measurement::Measurement, trial::Trial, truth::Truth},
        rendering::{advance, advance_until},
    },
    engine::Session,
    film::{LinearImage, Mask, compare_with_both, read_exr},
    scene::SceneFile,
    transport::Component,
};
use std::{
    io::{Write, stdout},
    path::Path,
    sync::Arc,
};

/// The seed of rendered references, which no measurement uses.
const REFERENCE_SEED: u64 = u64::MAX;

/// A run with its files loaded.
pub(super) struct Run {
    pub(super) name: String,
    /// The relMSE of another program, to compare with.
    pub(super) others: Option<f64>,
    file: SceneFile,
    reference: Reference,
    mask: Option<Mask>,
    marks: Vec<f64>,
    seeds: u64,
    only: Option<Component>,
}

enum Reference {
    /// A reference image, optionally with a second one.
    Given(LinearImage, Option<LinearImage>),
    /// A reference that is rendered first, for this number of seconds.
    Own(f64),
}

impl Run {
    /// Reads the files of a run; their paths are relative to `folder`.
    pub(super) fn load(entry: &Entry, folder: &Path) -> Result<Self, CliError> {
        let Name(name) = &entry.name;
        let file = SceneFile::find_from(folder, &entry.scene)?;
        let mask = entry.mask.as_ref().map(|mask| Mask::read(&folder.join(mask))).transpose()?;
        let reference = match &entry.reference {
            Some(path) => {
                let second =
                    entry.second_reference.as_ref().map(|second| read_exr(&folder.join(second))).transpose()?;
                Reference::Given(read_exr(&folder.join(path))?, second)
            }
            None => Reference::Own(entry.reference_seconds()),
        };
        // Fails before the first rendering if the sizes of the images differ.
        let (truth, second) = match &reference {
            Reference::Given(image, second) => (image, second.as_ref()),
            Reference::Own(_) => (&LinearImage::black(file.scene.film.width, file.scene.film.height), None),
        };
        compare_with_both(truth, truth, second.unwrap_or(truth), mask.as_ref())?;
        let (marks, seeds) = (entry.seconds.0.clone(), entry.seeds.get());
        let only = entry.only.map(Component::from);
        let others = entry.others.map(|Positive(rel_mse)| rel_mse);
        Ok(Self { name: name.clone(), others, file, reference, mask, marks, seeds, only })
    }

    /// Measures the run. Renders in the current thread pool.
    pub(super) fn measure(self) -> Result<Vec<Measurement>, CliError> {
        let (reference, second) = match self.reference {
            Reference::Given(image, second) => (image, second),
            Reference::Own(seconds) => {
                writeln!(stdout(), "rendering a reference for {seconds} s")?;
                (own_reference(&self.file, self.only, seconds)?, None)
            }
        };
        Trial::new(self.file, Truth::new(reference, second, self.mask)?, &self.marks, self.seeds)
            .only(self.only)
            .measure()
    }
}

fn own_reference(file: &SceneFile, only: Option<Component>, seconds: f64) -> Result<LinearImage, CliError> {
    let mut session = Session::prepare(file, REFERENCE_SEED, None)?.only(only);
    let first = advance(&mut session);
    advance_until(&mut session, first, seconds);
    Ok(Arc::unwrap_or_clone(session.frame(0).image))
}
