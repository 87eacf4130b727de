use crate::math::lanes::{LANES, Lanes};

/// A number of each of up to eight boxes or parts.
pub(super) type Numbers = [f32; LANES];

/// What the lanes of vectors stand for.
pub(super) trait Lineup: Copy {
    /// The lanes that count where there are so many things, a bit each.
    fn counting(self, things: usize) -> u32;

    /// The numbers that belong to the lanes.
    fn numbers<L: Lanes>(self, l: L, of: &Numbers) -> L::Vector;

    /// Three of them.
    #[inline(always)]
    fn numbers3<L: Lanes>(self, l: L, [x, y, z]: &[Numbers; 3]) -> [L::Vector; 3] {
        [self.numbers(l, x), self.numbers(l, y), self.numbers(l, z)]
    }
}

/// One ray against up to eight boxes or parts.
#[derive(Clone, Copy)]
pub(super) struct OneRay;

/// Eight rays against one box or part.
#[derive(Clone, Copy)]
pub(super) struct EightRays(pub(super) usize);

impl Lineup for OneRay {
    #[inline(always)]
    fn counting(self, things: usize) -> u32 {
        (1 << things) - 1
    }

    #[inline(always)]
    fn numbers<L: Lanes>(self, l: L, of: &Numbers) -> L::Vector {
        l.load(of)
    }
}

impl Lineup for EightRays {
    #[inline(always)]
    fn counting(self, _: usize) -> u32 {
        (1 << LANES) - 1
    }

    #[inline(always)]
    fn numbers<L: Lanes>(self, l: L, of: &Numbers) -> L::Vector {
        l.splat(of[self.0])
    }
}
