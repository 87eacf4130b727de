use arrayvec::ArrayVec;

/// Bodies that may contain one point; beyond this number, bodies of the lowest rank are dropped. With fewer, paths in nested bodies would leave
/// them into air; with more, every event would copy longer lists.
const MAX_NESTED: usize = 8;

/// The bodies around a point of a path, by their ranks.
///
/// A body is entered where the path crosses one of its surfaces from the front, and left where it crosses one from the back. It may
/// be entered several times before it is left, where its surfaces overlap.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Media {
    /// In ascending order: the medium of the last one applies.
    inside: ArrayVec<u32, MAX_NESTED>,
}

impl Media {
    /// The rank of the body whose medium applies; `None` in air.
    #[inline]
    pub fn body(&self) -> Option<u32> {
        self.inside.last().copied()
    }

    /// Whether the body of this rank is around the point.
    pub fn contains(&self, body: u32) -> bool {
        self.inside.contains(&body)
    }

    /// The media in front of and behind surfaces that a path in these media crosses at one point. Each crossing is the rank of the
    /// surface's body, and whether the path comes from the surface's front.
    ///
    /// A path at the back of a surface is in its body, even if it never entered it: bodies may be open.
    pub fn across(&self, crossings: &[(u32, bool)]) -> (Self, Self) {
        let mut before = self.clone();
        for &(body, _) in crossings.iter().filter(|(body, front)| !front && !self.contains(*body)) {
            before.enter(body);
        }
        let mut behind = before.clone();
        for &(body, front) in crossings {
            if front { behind.enter(body) } else { behind.leave(body) }
        }
        (before, behind)
    }

    /// Adds a body once more.
    pub(super) fn enter(&mut self, body: u32) {
        if self.inside.is_full() {
            self.inside.remove(0);
        }
        let at = self.inside.partition_point(|other| *other <= body);
        self.inside.insert(at, body);
    }

    fn leave(&mut self, body: u32) {
        if let Some(at) = self.inside.iter().rposition(|other| *other == body) {
            self.inside.remove(at);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn around(bodies: &[u32]) -> Media {
        let mut media = Media::default();
        bodies.iter().for_each(|&body| media.enter(body));
        media
    }

    #[test]
    fn the_body_of_the_highest_rank_gives_the_medium_in_any_order() {
        assert_eq!(Media::default().body(), None);
        assert_eq!(around(&[2, 5, 1]), around(&[5, 1, 2]));
        assert_eq!(around(&[2, 5, 1]).body(), Some(5));
        let (before, behind) = around(&[2, 5]).across(&[(5, false)]);
        assert_eq!((before.body(), behind.body()), (Some(5), Some(2)));
        let (before, behind) = around(&[2, 5]).across(&[(2, false)]);
        assert_eq!((before.body(), behind.body()), (Some(5), Some(5)), "the lower one ends inside of the higher one");
    }

    #[test]
    fn bodies_may_be_open_and_overlap_themselves() {
        let (before, behind) = Media::default().across(&[(3, false)]);
        assert_eq!((before.body(), behind.body()), (Some(3), None), "left without having been entered");
        let twice = around(&[3, 3]);
        assert_eq!(twice.across(&[(3, false)]).1, around(&[3]), "still in the other half");
    }

    #[test]
    fn coincident_surfaces_are_crossed_at_once() {
        let (before, behind) = around(&[1]).across(&[(4, true), (1, false)]);
        assert_eq!((before, behind), (around(&[1]), around(&[4])));
        let (before, behind) = around(&[1]).across(&[(1, true), (1, false)]);
        assert_eq!((before, behind), (around(&[1]), around(&[1])), "two halves of one body");
    }

    #[test]
    fn deep_nesting_drops_the_lowest() {
        let media = around(&(0..20).collect::<Vec<_>>());
        assert_eq!(media, around(&(12..20).collect::<Vec<_>>()));
    }
}
