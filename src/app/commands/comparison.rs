//! Ways to compare two pictures, and requests to snapshots.

/// How two pictures are compared on the canvas.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Comparison {
    /// The first picture alone.
    #[default]
    Off,
    /// The second picture in place of the first.
    Flip,
    /// The second picture to the right of a line.
    Split,
    /// The difference in false colours.
    Difference,
}

impl Comparison {
    /// All ways, in the order of the buttons.
    pub(crate) const ALL: [Self; 4] = [Self::Off, Self::Flip, Self::Split, Self::Difference];

    /// The label of its button.
    pub(crate) fn label(self) -> &'static str {
        match self {
            Self::Off => "Off",
            Self::Flip => "Flip",
            Self::Split => "Split",
            Self::Difference => "Difference",
        }
    }
}

/// A request to the snapshots; an index is a snapshot's place in the strip.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum SnapshotCommand {
    /// The first picture of a comparison; `None` for the present picture.
    First(Option<usize>),
    /// The second picture of a comparison.
    Second(usize),
    /// Compare in this way.
    Compare(Comparison),
    /// The place of the line between two pictures, from 0 at the left to 1 at the right.
    Split(f32),
    /// Go back to the scene of a snapshot.
    Restore(usize),
    /// Another name.
    Rename(usize, String),
    /// Forget a snapshot.
    Remove(usize),
    /// Whether snapshots are saved with the scene.
    KeepWithScene(bool),
}
