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
/// Time for each pixel that an edit has changed over that of the same number of all pixels, before one was timed: the edited object is often
/// the dearest, but finer pixels share more of their work.
const CHANGED: f64 = 0.5;
/// Least part of the time of the first picture for a draft of what has changed: the picture comes later on a slow machine, but it shows more.
const LEAST_FOR_CHANGES: f64 = 0.5;
/// Greatest coarseness of what has changed: with a detail coarser than 4 pixels the object under the hand cannot be recognised. The picture
/// comes later where this takes longer.
const COARSEST_CHANGES: u32 = 12;
/// Coarseness of a finer draft over that of the draft before, at most: otherwise it would show little more.
const FINER: f64 = 0.75;
/// The same for a draft that bridges the wait for all pixels, which it makes longer.
const MUCH_FINER: f64 = 0.4;
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
    /// Time of a draft of what an edit has changed, for each pixel of it, seconds; `None` before any was timed.
    changed: Option<f64>,
    /// The present scene's last draft.
    last: DraftSize,
    /// The present scene's next draft of the whole film; `None` when iterations are due.
    next: Option<DraftSize>,
}

impl Default for DraftPace {
    fn default() -> Self {
        Self { size: FIRST, times: None, changed: None, last: DraftSize::FULL, next: None }
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
        self.next_took(draft.size, draft.stats.seconds);
    }

    /// The size of a draft of what an edit has changed, `changed` pixels of the film, that may follow the first draft within the time of the
    /// first picture, of which `seconds` have passed, or longer where it would be too coarse; `None` where it would not be much finer.
    pub(in crate::engine) fn of_changes(&self, changed: usize, seconds: f64) -> Option<DraftSize> {
        let left = (PICTURE_SECONDS - seconds).max(LEAST_FOR_CHANGES * PICTURE_SECONDS);
        let coarseness = self.coarseness_within(left, changed)?.min(COARSEST_CHANGES);
        self.is_finer(coarseness, FINER).then_some(DraftSize { coarseness, ..self.size })
    }

    /// The coarseness of a draft of `changed` pixels of the film that takes this time with the photons of the first draft; `None` where nothing
    /// has changed, or no draft was timed.
    fn coarseness_within(&self, seconds: f64, changed: usize) -> Option<u32> {
        let pixel = self.changed.or_else(|| self.times.map(|[_, pixel]| CHANGED * pixel))?;
        (changed > 0).then(|| (changed as f64 * pixel / seconds).sqrt().ceil().max(1.0) as u32)
    }

    /// Whether a coarseness is at most this part of the last draft's.
    fn is_finer(&self, coarseness: u32, part: f64) -> bool {
        f64::from(coarseness) <= part * f64::from(self.last.coarseness)
    }

    /// The present scene needs no drafts.
    pub(in crate::engine) fn skip(&mut self) {
        (self.last, self.next) = (DraftSize::FULL, None);
    }

    /// The present scene's next draft of the whole film; `None` when iterations are due.
    pub(in crate::engine) fn next(&self) -> Option<DraftSize> {
        self.next
    }

    /// The present scene's next draft of `changed` pixels of the film, where a picture before the edit stands in for the rest; `None` when
    /// iterations are due.
    pub(in crate::engine) fn next_of_changes(&self, changed: usize) -> Option<DraftSize> {
        // With the few photons of the first draft all pixels would show little more.
        let is_worth = |coarseness: &u32| *coarseness > 1 && self.is_finer(*coarseness, MUCH_FINER);
        let bridge = self.coarseness_within(BRIDGE_SECONDS, changed).filter(is_worth);
        let next = bridge.map_or(DraftSize::FULL, |coarseness| DraftSize { coarseness, ..self.size });
        (changed > 0 && self.next.is_some()).then_some(next)
    }

    /// Takes the time of a draft of `changed` pixels of the film into account, and of its detail, seconds.
    pub(in crate::engine) fn changes_took(&mut self, draft: &Draft, detail: f64, changed: usize) {
        let coarseness = f64::from(draft.size.coarseness);
        let passes = draft.stats.passes;
        let seconds = passes.camera + passes.gather + detail;
        let now = seconds * coarseness * coarseness / changed.max(1) as f64;
        self.changed = Some(self.changed.map_or(now, |before| 0.5 * (before + now)));
        self.next_took(draft.size, draft.stats.seconds);
    }

    /// Takes the time of a draft of this size, seconds, into account.
    pub(in crate::engine) fn next_took(&mut self, size: DraftSize, seconds: f64) {
        (self.last, self.next) = (size, next(size, seconds));
    }
}

/// The draft of the whole film after one that took so long; `None` where iterations are due.
fn next(size: DraftSize, seconds: f64) -> Option<DraftSize> {
    let all_pixels = ALL_PIXELS_TIME * seconds * f64::from(size.coarseness).powi(2);
    match size {
        DraftSize::FULL => None,
        // A draft of half the coarseness has four times the pixels.
        DraftSize { coarseness: 2.., .. } if all_pixels > LONGEST_WAIT && 4.0 * seconds <= LONGEST_DRAFT_SECONDS => {
            Some(DraftSize { coarseness: size.coarseness / 2, ..size })
        }
        _ => Some(DraftSize::FULL),
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
        let (spent, few) = (draft.stats.seconds, FILM / 20);
        assert!(spent < 0.8 * PICTURE_SECONDS, "{spent}");
        let finer = pace.of_changes(few, spent).expect("there is time left");
        assert!(2 * finer.coarseness <= draft.size.coarseness && finer.thinning == draft.size.thinning, "{finer:?}");
        assert_eq!(pace.of_changes(50 * FILM, spent), None, "too much has changed");
        assert!(
            pace.of_changes(few, PICTURE_SECONDS).expect("there is always some time").coarseness >= finer.coarseness
        );
        assert_eq!(pace.of_changes(0, spent), None, "nothing has changed");
    }

    /// On a machine so slow that the first draft is as coarse as it may be.
    #[test]
    fn a_change_is_readable_whatever_time_that_takes() {
        let mut pace = DraftPace::default();
        for _ in 0..20 {
            let size = pace.first(FILM, true);
            pace.first_took(&draft(size, 20.0));
        }
        assert_eq!(pace.last.coarseness, COARSEST as u32);
        assert_eq!(pace.of_changes(FILM, 0.1).map(|size| size.coarseness), Some(COARSEST_CHANGES));
    }

    #[test]
    fn the_time_of_what_has_changed_is_measured() {
        let (mut pace, first) = settled(true);
        let few = FILM / 20;
        let before = pace.of_changes(few, 0.0).unwrap();
        let mut dear = draft(before, 20.0);
        for _ in 0..8 {
            pace.first_took(&first);
            pace.changes_took(&dear, 0.0, few);
            dear = draft(pace.of_changes(few, 0.0).unwrap_or(before), 20.0);
        }
        pace.first_took(&first);
        let after = pace.of_changes(few, 0.0).map_or(first.size.coarseness, |size| size.coarseness);
        assert!(after >= 2 * before.coarseness, "{before:?} {after}");
    }

    #[test]
    fn the_time_of_the_detail_counts_too() {
        let time_of = |seconds| {
            let (mut pace, first) = settled(true);
            pace.changes_took(&first, seconds, FILM);
            pace.changed
        };
        assert!(time_of(0.1) > time_of(0.0), "{:?} {:?}", time_of(0.1), time_of(0.0));
    }

    #[test]
    fn changes_are_drafted_step_by_step_until_they_have_all_pixels() {
        let (mut pace, first) = settled(true);
        assert_eq!(pace.next_of_changes(FILM / 20), Some(DraftSize::FULL), "few pixels take no time");
        let bridge = pace.next_of_changes(3 * FILM / 2).expect("pixels are missing");
        assert!(1 < bridge.coarseness && bridge.coarseness < first.size.coarseness, "{bridge:?}");
        pace.next_took(bridge, BRIDGE_SECONDS);
        assert_eq!(pace.next_of_changes(3 * FILM / 2), Some(DraftSize::FULL), "another one would show little more");
        assert_eq!(pace.next_of_changes(0), None, "nothing has changed");
        pace.next_took(DraftSize::FULL, 0.3);
        assert_eq!(pace.next_of_changes(FILM), None, "iterations follow");
    }

    #[test]
    fn finer_drafts_end_with_all_pixels() {
        let size = |coarseness| DraftSize { coarseness, thinning: 4 };
        // All pixels would take 0.77 s.
        assert_eq!(next(size(16), 0.01), Some(size(8)), "a finer draft comes before all pixels");
        assert_eq!(next(size(8), 0.04), Some(DraftSize::FULL), "another one would take too long");
        assert_eq!(next(DraftSize::FULL, 0.5), None, "iterations follow the draft with all pixels");
    }
}
