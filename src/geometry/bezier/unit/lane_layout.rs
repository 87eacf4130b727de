use crate::math::lanes::{LANES, Lanes};

/// One number of each of eight boxes or subpatches: a column of their structure of arrays.
pub(crate) type Column = [f32; LANES];

/// The pairs of ray and item in the lanes of a vector: one ray against eight items, or eight rays against one item. An
/// item is a box or a subpatch.
pub(crate) trait LaneLayout: Copy {
    /// The lanes in use where a group holds `items`, a bit for each lane.
    fn active(self, items: usize) -> u32;

    /// The items' numbers, by lanes.
    fn load<L: Lanes>(self, l: L, column: &Column) -> L::Vector;

    /// Three columns.
    #[inline(always)]
    fn load3<L: Lanes>(self, l: L, [x, y, z]: &[Column; 3]) -> [L::Vector; 3] {
        [self.load(l, x), self.load(l, y), self.load(l, z)]
    }
}

/// One ray against up to eight items.
#[derive(Clone, Copy)]
pub(crate) struct ItemPerLane;

/// A packet of eight rays against the item with this index in its group.
#[derive(Clone, Copy)]
pub(crate) struct RayPerLane(pub(crate) usize);

impl LaneLayout for ItemPerLane {
    #[inline(always)]
    fn active(self, items: usize) -> u32 {
        (1 << items) - 1
    }

    #[inline(always)]
    fn load<L: Lanes>(self, l: L, column: &Column) -> L::Vector {
        l.load(column)
    }
}

impl LaneLayout for RayPerLane {
    #[inline(always)]
    fn active(self, _: usize) -> u32 {
        (1 << LANES) - 1
    }

    #[inline(always)]
    fn load<L: Lanes>(self, l: L, column: &Column) -> L::Vector {
        l.splat(column[self.0])
    }
}
