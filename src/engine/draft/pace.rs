//! How coarse drafts are: the first picture takes the time of a frame, finer ones follow until the first iteration is due.

use super::image::Draft;
use crate::transport::DraftSize;

/// Time that the first picture should take, seconds: a frame of 30 Hz, less preparation and display.
const PICTURE_SECONDS: f64 = 0.02;
/// Part of this time for photons, of which the rest of the time has the light seen.
const PHOTONS: f64 = 0.4;
/// Part of the remaining time for the draft that tells what an edit has changed, where there is a picture before the edit. The rest is for a
/// finer draft of what has changed.
const LOOK: f64 = 0.4;
/// Size of the first draft before any draft was timed. More pixels and photons could freeze the first picture on a slow machine, fewer make
/// the first picture needlessly coarse; the time of each draft corrects them.
const FIRST: DraftSize = DraftSize { coarseness: 4, thinning: 4 };
/// Greatest coarseness of a first draft: coarser ones, some 30 pixels wide, would show no objects; a lower limit makes slow machines stall
/// during a drag.
const COARSEST: f64 = 16.0;
/// Greatest thinning: with fewer photons a caustic cannot be recognised.
const THINNEST: u32 = 16;
/// Factor between the coarseness that would take the wanted time and the present one from which on that changes: 1.7 times the time. A draft
/// of the scene before an edit serves all edits for as long as the coarseness stays.
const INERTIA: f64 = 1.3;
/// Time of pixels that an edit has changed over that of the same number of others: the edited object is often the dearest.
const CHANGED: f64 = 1.3;
/// Coarseness of a finer draft over that of the draft before, at most: otherwise it would show little more.
const FINER: f64 = 0.75;
/// Time of a finer draft of what an edit has changed, seconds, before the one with all pixels: it bridges the time that this takes on a slow
/// or busy machine.
const BRIDGE_SECONDS: f64 = 0.08;
/// Most time of a finer draft, seconds, except for the last one, which has all pixels. A longer draft adds to the wait for all pixels; with a
/// shorter limit no draft comes between the first and the last one.
const LONGEST_DRAFT_SECONDS: f64 = 0.12;
/// Time of a draft with all pixels, seconds, from which on a coarser draft comes before it: shorter waits need none, in longer ones the
/// first draft stays visible too long.
const LONGEST_WAIT: f64 = 0.5;
/// Time per pixel of a draft with all pixels over that of a coarser draft: in fine drafts, fewer pixels gather light.
const ALL_PIXELS_TIME: f64 = 0.3;

/// Chooses the size of drafts by the time that earlier drafts took.
#[derive(Debug)]
pub(in crate::engine) struct DraftPace {
    /// Size of the last first draft.
    size: DraftSize,
    /// Time of a draft for its photons, and for each pixel, seconds; `None` before any was timed.
    times: Option<[f64; 2]>,
    /// Coarseness of the present scene's last draft.
    last: u32,
    /// Coarseness of the present scene's next draft; 0 when iterations are due.
    next: u32,
}

impl Default for DraftPace {
    fn default() -> Self {
        Self { size: FIRST, times: None, last: 0, next: 0 }
    }
}

impl DraftPace {
    /// The size of the first draft for a film of `pixels` pixels; with `stand_in`, a picture before the edit shows what has not changed.
    pub(in crate::engine) fn first(&mut self, pixels: usize, stand_in: bool) -> DraftSize {
        if let Some([photons, pixel]) = self.times {
            let rest = (PICTURE_SECONDS - photons).max(0.25 * PICTURE_SECONDS) * if stand_in { LOOK } else { 1.0 };
            let wanted = (pixels as f64 * pixel / rest).sqrt().clamp(1.0, COARSEST);
            let change = wanted / f64::from(self.size.coarseness);
            if !(1.0 / INERTIA..=INERTIA).contains(&change) {
                self.size.coarseness = wanted.round() as u32;
            }
        }
        self.size
    }

    /// The thinning of drafts that have not all pixels.
    pub(in crate::engine) fn thinning(&self) -> u32 {
        self.size.thinning
    }

    /// Takes the time of the first draft into account.
    pub(in crate::engine) fn first_took(&mut self, draft: &Draft) {
        let passes = draft.stats.passes;
        let now = [passes.photons + passes.map, (passes.camera + passes.gather) / draft.image.pixels.len() as f64];
        // Half a step at a time avoids flicker.
        let [photons, pixel] = self.times.map_or(now, |before| [0, 1].map(|k| 0.5 * (before[k] + now[k])));
        self.times = Some([photons, pixel]);
        let wanted = f64::from(self.size.thinning) * photons / (PHOTONS * PICTURE_SECONDS);
        if wanted > 1.5 * f64::from(self.size.thinning) && self.size.thinning < THINNEST {
            (self.size.thinning, self.times) = (2 * self.size.thinning, Some([0.5 * photons, pixel]));
        } else if wanted < 0.4 * f64::from(self.size.thinning) && self.size.thinning > 1 {
            (self.size.thinning, self.times) = (self.size.thinning / 2, Some([2.0 * photons, pixel]));
        }
        self.next_took(draft.size.coarseness, draft.stats.seconds);
    }

    /// The coarseness of a draft of the changed part of a film of `pixels` pixels that may follow the first draft within the time of the
    /// first picture, of which `seconds` have passed; `None` where it would not be much finer.
    pub(in crate::engine) fn of_changes(&self, pixels: usize, changed: f64, seconds: f64) -> Option<u32> {
        (changed > 0.0).then(|| self.finer_within(PICTURE_SECONDS - seconds, pixels, changed, self.size.coarseness))?
    }

    /// The coarseness of a draft of the changed part of a film that takes this time; `None` where it would not be much finer than `before`.
    fn finer_within(&self, seconds: f64, pixels: usize, changed: f64, before: u32) -> Option<u32> {
        let [photons, pixel] = self.times?;
        let time = CHANGED * changed * pixels as f64 * pixel;
        let wanted = (time / (seconds - photons).max(0.0)).sqrt().ceil();
        (wanted <= FINER * f64::from(before)).then(|| wanted.max(1.0) as u32)
    }

    /// The coarseness of the present scene's next draft; `None` when iterations are due.
    pub(in crate::engine) fn next(&self) -> Option<u32> {
        (self.next > 0).then_some(self.next)
    }

    /// [`Self::next`] for a draft of the changed part of a film of `pixels` pixels, where a picture before the edit stands in for the rest.
    pub(in crate::engine) fn next_of_changes(&self, pixels: usize, changed: f64) -> Option<u32> {
        self.next()?;
        Some(self.finer_within(BRIDGE_SECONDS, pixels, changed, self.last).unwrap_or(1))
    }

    /// Takes the time of a draft of this coarseness, seconds, into account.
    pub(in crate::engine) fn next_took(&mut self, coarseness: u32, seconds: f64) {
        (self.last, self.next) = (coarseness, finer(coarseness, seconds));
    }
}

/// The coarseness of the draft after one that took so long; 0 where iterations are due.
fn finer(coarseness: u32, seconds: f64) -> u32 {
    let all_pixels = ALL_PIXELS_TIME * seconds * f64::from(coarseness).powi(2);
    match coarseness {
        0 | 1 => 0,
        // A draft of half the coarseness has four times the pixels.
        _ if all_pixels > LONGEST_WAIT && 4.0 * seconds <= LONGEST_DRAFT_SECONDS => coarseness / 2,
        _ => 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Rgb;

    const FILM: usize = 512 * 512;

    /// A draft of this size of a scene that takes 100 ms for all photons and `all` seconds for all pixels.
    fn draft(size: DraftSize, all: f64) -> Draft {
        let pixels = FILM / (size.coarseness as usize).pow(2);
        let mut draft = Draft { size, ..Draft::of_pixels(pixels as u32, vec![Rgb::ONE; pixels], 1.0, 1.0) };
        draft.stats.passes.photons = 0.1 / f64::from(size.thinning);
        draft.stats.passes.camera = all * pixels as f64 / FILM as f64;
        draft.stats.seconds = draft.stats.passes.photons + draft.stats.passes.camera;
        draft
    }

    fn settled(stand_in: bool) -> (DraftPace, Draft) {
        let mut pace = DraftPace::default();
        for _ in 0..20 {
            let size = pace.first(FILM, stand_in);
            pace.first_took(&draft(size, 0.2));
        }
        let size = pace.first(FILM, stand_in);
        (pace, draft(size, 0.2))
    }

    #[test]
    fn the_first_draft_takes_about_a_frame() {
        let (_, draft) = settled(false);
        assert!((0.5..1.5).contains(&(draft.stats.seconds / PICTURE_SECONDS)), "{:?}", draft.size);
        assert!(draft.stats.passes.photons < 0.5 * PICTURE_SECONDS, "{:?}", draft.size);
    }

    #[test]
    fn a_small_change_is_drafted_finely_within_the_same_time() {
        let (pace, draft) = settled(true);
        let spent = draft.stats.seconds;
        assert!(spent < 0.8 * PICTURE_SECONDS, "{spent}");
        let finer = pace.of_changes(FILM, 0.05, spent).expect("there is time left");
        assert!(2 * finer <= draft.size.coarseness, "{finer}");
        assert_eq!(pace.of_changes(FILM, 1.0, spent), None, "too much has changed");
        assert_eq!(pace.of_changes(FILM, 0.05, PICTURE_SECONDS), None, "no time is left");
        assert_eq!(pace.of_changes(FILM, 0.0, spent), None, "nothing has changed");
    }

    #[test]
    fn a_large_change_is_drafted_step_by_step_and_a_small_one_at_once() {
        let (mut pace, draft) = settled(true);
        assert_eq!(pace.next_of_changes(FILM, 0.05), Some(1));
        let bridge = pace.next_of_changes(FILM, 1.0).expect("all pixels are missing");
        assert!(1 < bridge && bridge < draft.size.coarseness, "{bridge}");
        pace.next_took(bridge, BRIDGE_SECONDS);
        assert_eq!(pace.next_of_changes(FILM, 1.0), Some(1));
        pace.next_took(1, 0.3);
        assert_eq!(pace.next_of_changes(FILM, 1.0), None, "iterations follow");
    }

    #[test]
    fn finer_drafts_end_with_all_pixels() {
        let mut pace = DraftPace::default();
        // All pixels would take 0.77 s.
        pace.next_took(16, 0.01);
        assert_eq!(pace.next(), Some(8), "a finer draft comes before all pixels");
        pace.next_took(8, 0.04);
        assert_eq!(pace.next(), Some(1), "another one would take too long");
        pace.next_took(1, 0.5);
        assert_eq!(pace.next(), None, "iterations follow the draft with all pixels");
    }
}
