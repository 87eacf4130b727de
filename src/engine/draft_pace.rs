//! How coarse drafts are: the first one takes the time of a frame, finer ones follow until the first iteration is due.

/// Time that the first draft should take, seconds: a frame of 30 Hz, less preparation and display.
const DRAFT_SECONDS: f64 = 0.022;
/// Coarseness of the first draft before any draft was timed: a sixteenth of the pixels. A lower value could freeze the first picture on a
/// slow machine, a higher one makes the first picture needlessly coarse; the time of each draft corrects it.
const FIRST_COARSENESS: f64 = 4.0;
/// Greatest coarseness of a first draft: coarser ones, some 30 pixels wide, would show no objects; a lower limit makes slow machines stall
/// during a drag.
const COARSEST_DRAFT: f64 = 16.0;
/// Most time of a finer draft, seconds, except for the last one, which has all pixels. A longer draft adds to the wait for all pixels; with a
/// shorter limit no draft comes between the first and the last one.
const LONGEST_DRAFT_SECONDS: f64 = 0.12;
/// Time of a draft with all pixels, seconds, from which on a coarser draft comes before it: shorter waits need none, in longer ones the
/// first draft stays visible too long.
const LONGEST_WAIT: f64 = 0.5;
/// Time per pixel of a draft with all pixels over that of a coarser draft: in fine drafts, fewer pixels gather light.
const ALL_PIXELS_TIME: f64 = 0.3;

/// Chooses the coarseness of drafts by the time that earlier drafts took.
#[derive(Debug)]
pub(super) struct DraftPace {
    /// Coarseness of the next scene's first draft.
    first: f64,
    /// Coarseness of the present scene's next draft; 0 when iterations are due.
    next: u32,
}

impl Default for DraftPace {
    fn default() -> Self {
        Self { first: FIRST_COARSENESS, next: 0 }
    }
}

impl DraftPace {
    /// The coarseness of a scene's first draft: it has every n-th pixel each way.
    pub(super) fn first(&self) -> u32 {
        self.first.round().max(1.0) as u32
    }

    /// Tells how long the first draft took.
    pub(super) fn first_took(&mut self, seconds: f64) {
        let coarseness = self.first();
        // Time goes with the number of pixels, the inverse square of the coarseness. Half a step at a time avoids flicker.
        let wanted = f64::from(coarseness) * (seconds / DRAFT_SECONDS).sqrt();
        self.first = (0.5 * (self.first + wanted)).clamp(1.0, COARSEST_DRAFT);
        self.next = finer(coarseness, seconds);
    }

    /// The coarseness of the present scene's next draft; `None` when iterations are due.
    pub(super) fn next(&self) -> Option<u32> {
        (self.next > 0).then_some(self.next)
    }

    /// Tells how long the last draft took.
    pub(super) fn next_took(&mut self, seconds: f64) {
        self.next = finer(self.next, seconds);
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

    #[test]
    fn the_first_draft_takes_about_a_frame() {
        let mut pace = DraftPace::default();
        // A machine that takes 1 s for all pixels.
        for _ in 0..20 {
            pace.first_took(1.0 / f64::from(pace.first()).powi(2));
        }
        let seconds = 1.0 / f64::from(pace.first()).powi(2);
        assert!((0.5 * DRAFT_SECONDS..2.0 * DRAFT_SECONDS).contains(&seconds), "{seconds}");
    }

    #[test]
    fn finer_drafts_end_with_all_pixels() {
        let mut pace = DraftPace { first: 16.0, next: 0 };
        // Coarse drafts of 10 ms: all pixels would take 0.77 s.
        pace.first_took(0.01);
        assert_eq!(pace.next(), Some(8), "a finer draft comes before all pixels");
        pace.next_took(0.04);
        assert_eq!(pace.next(), Some(1), "another one would take too long");
        pace.next_took(0.5);
        assert_eq!(pace.next(), None, "iterations follow the draft with all pixels");
    }
}
