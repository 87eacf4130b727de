//! Nodes and leaves of the tree in structure-of-arrays form: one SIMD lane for each child or photon.

use crate::math::LANES;
use crate::transport::photons::Photon;
use glam::Vec3;

/// Eight values of each of three coordinates or channels.
pub(super) type Columns = [[f32; LANES]; 3];

/// Up to eight photons. Unused lanes hold photons without flux, infinitely far away.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(super) struct PhotonBlock {
    pub(super) position: Columns,
    pub(super) flux: Columns,
    /// Unit directions towards where the photons came from.
    pub(super) wi: Columns,
    pub(super) cos: [f32; LANES],
    pub(super) tag: [u32; LANES],
}

impl PhotonBlock {
    /// The photon in lane `k`.
    pub(super) fn photon(&self, k: usize) -> Photon {
        let at = |columns: &Columns| Vec3::from_array(columns.map(|column| column[k]));
        Photon {
            position: at(&self.position),
            flux: at(&self.flux),
            wi: at(&self.wi),
            cos: self.cos[k],
            tag: self.tag[k],
        }
    }
}

/// A node with up to eight children. Unused lanes have empty boxes.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(super) struct Node {
    pub(super) min: Columns,
    pub(super) max: Columns,
    /// The least and the greatest tag of each child's photons.
    pub(super) tags: [[u32; LANES]; 2],
    /// Index of an inner node, or of the first block of a leaf with its subtree in the highest bits.
    pub(super) first: [u32; LANES],
    /// Number of blocks of a leaf; 0 for an inner node.
    pub(super) blocks: [u32; LANES],
}

/// Moments of the flux over the photons of each child; `d` is a photon's offset from the middle of the child's box.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(super) struct Moments {
    /// Sum of the flux.
    pub(super) flux: Columns,
    /// Sum of `d` times the flux, by channel.
    pub(super) first: [Columns; 3],
    /// Sum of `|d|^2` times the flux.
    pub(super) second: Columns,
}

/// Bits of a block's index within the blocks of its subtree.
pub(super) const BLOCK_INDEX_BITS: u32 = u32::BITS - LANES.ilog2();

/// Stores a vector in one lane.
pub(super) fn set(columns: &mut Columns, slot: usize, value: Vec3) {
    for (column, x) in columns.iter_mut().zip(value.to_array()) {
        column[slot] = x;
    }
}

impl Node {
    pub(super) const EMPTY: Self = Self {
        min: [[f32::INFINITY; LANES]; 3],
        max: [[f32::NEG_INFINITY; LANES]; 3],
        tags: [[u32::MAX; LANES], [0; LANES]],
        first: [0; LANES],
        blocks: [0; LANES],
    };
}

impl Moments {
    pub(super) const ZERO: Self =
        Self { flux: [[0.0; LANES]; 3], first: [[[0.0; LANES]; 3]; 3], second: [[0.0; LANES]; 3] };
}

impl PhotonBlock {
    pub(super) const EMPTY: Self = Self {
        position: [[f32::MAX; LANES]; 3],
        flux: [[0.0; LANES]; 3],
        wi: [[0.0; LANES]; 3],
        cos: [1.0; LANES],
        tag: [0; LANES],
    };
}
