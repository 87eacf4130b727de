//! Damaged and random files: no panic, no wrong picture, errors that name file and place.

use crate::inputs::KINDS;
use crate::suite::Case;

/// Files of one round.
const FILES: u32 = 250;

pub(crate) fn cases() -> Vec<Case> {
    let of_kind = |kind: &'static crate::inputs::Kind| {
        let edited = move |round| kind.fails_edited(FILES, round);
        let random = move |round| kind.fails_random(FILES, round);
        let work = (u64::from(FILES), "files");
        [
            Case::faults(format!("rounds with a failure: edited {}", kind.name), "fuzzing", work, edited),
            Case::faults(format!("rounds with a failure: random {}", kind.name), "fuzzing", work, random),
        ]
    };
    KINDS.iter().flat_map(of_kind).collect()
}
