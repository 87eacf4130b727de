//! Photon passes in blocks of paths: the same blocks, concatenated in the same order, for any number of threads.

use std::ops::Range;

/// Paths of one block: few enough that a pass is cancelled within a millisecond or two.
const PATHS_PER_BLOCK: u64 = 2048;

/// Some paths of one source.
#[derive(Clone, Debug)]
pub(in crate::transport) struct PathBlock {
    /// Index of the source.
    pub(in crate::transport) source: usize,
    /// Indices of the paths in the sequence of the source.
    pub(in crate::transport) paths: Range<u64>,
}

/// The blocks of a pass, for the range of paths of each source, such as a light.
pub(in crate::transport) fn path_blocks(paths_by_source: impl Iterator<Item = Range<u64>>) -> Vec<PathBlock> {
    let of_source = |(source, paths): (usize, Range<u64>)| {
        let end = paths.end;
        let starts = paths.step_by(PATHS_PER_BLOCK as usize);
        starts.map(move |start| PathBlock { source, paths: start..(start + PATHS_PER_BLOCK).min(end) })
    };
    paths_by_source.enumerate().flat_map(of_source).collect()
}

/// Concatenates a list of each piece, in the order of the pieces.
pub(in crate::transport) fn concat<P, T: Copy>(pieces: &[P], items: impl Fn(&P) -> &Vec<T>) -> Vec<T> {
    pieces.iter().map(|piece| items(piece).as_slice()).collect::<Vec<_>>().concat()
}
