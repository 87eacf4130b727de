//! How passes are cut into pieces that threads take: always the same pieces, joined in the same order, so that the
//! number of threads changes nothing.

use std::ops::Range;

/// Paths of one piece of a photon pass: small enough to be cancelled within a millisecond or two.
const PATHS_PER_BLOCK: u64 = 2048;

/// Some paths of one light.
#[derive(Clone, Debug)]
pub(super) struct Block {
    pub(super) light: usize,
    pub(super) paths: Range<u64>,
}

/// The blocks of a pass that follows these paths of each light's sequence.
pub(super) fn of_photons(paths_by_light: impl Iterator<Item = Range<u64>>) -> Vec<Block> {
    let of_light = |(light, paths): (usize, Range<u64>)| {
        let end = paths.end;
        let starts = paths.step_by(PATHS_PER_BLOCK as usize);
        starts.map(move |start| Block { light, paths: start..(start + PATHS_PER_BLOCK).min(end) })
    };
    paths_by_light.enumerate().flat_map(of_light).collect()
}

/// What the pieces hold, in their order.
pub(crate) fn join<P, T: Copy>(pieces: &[P], items: impl Fn(&P) -> &Vec<T>) -> Vec<T> {
    pieces.iter().map(|piece| items(piece).as_slice()).collect::<Vec<_>>().concat()
}
