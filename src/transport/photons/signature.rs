use crate::math::mix64;

/// The sequence of surfaces on the way of light, as a hash. Two ways of one signature met the same objects in the same order, and each
/// reflected or refracted the light in the same way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::transport) struct Signature(u64);

impl Signature {
    /// The way, reflected by an object.
    #[inline]
    pub(in crate::transport) fn reflected(self, object: u32) -> Self {
        self.then(u64::from(object) << 2 | 1)
    }

    /// The way, refracted by an object.
    #[inline]
    pub(in crate::transport) fn refracted(self, object: u32) -> Self {
        self.then(u64::from(object) << 2 | 2)
    }

    /// The way to the side of a surface that scatters the light.
    #[inline]
    pub(in crate::transport) fn arrived(self, side: u32) -> Self {
        self.then(u64::from(side) << 2 | 3)
    }

    /// A shorter hash.
    #[inline]
    pub(in crate::transport) fn short(self) -> u32 {
        self.0 as u32
    }

    #[inline]
    fn then(self, event: u64) -> Self {
        Self(mix64(self.0 ^ event))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_object_and_event_tell_ways_apart() {
        let start = Signature::default();
        let ways = [
            start,
            start.reflected(1),
            start.refracted(1),
            start.arrived(1),
            start.reflected(2),
            start.reflected(1).refracted(2),
            start.refracted(2).reflected(1),
            start.reflected(1).reflected(1),
        ];
        for (i, a) in ways.iter().enumerate() {
            assert!(ways[..i].iter().all(|b| a != b), "{i}");
        }
        assert_eq!(start.reflected(7).arrived(3), start.reflected(7).arrived(3));
    }
}
