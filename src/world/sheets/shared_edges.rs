/// The edges of a patch over which its sheet goes on in another patch, or in the patch itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SharedEdges {
    /// Whether the edges at u = 0 and u = 1 are shared.
    pub u: [bool; 2],
    /// Whether the edges at v = 0 and v = 1 are shared.
    pub v: [bool; 2],
}
