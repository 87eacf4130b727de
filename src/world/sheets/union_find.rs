/// A partition of the numbers from 0 on into sets that only grow. Each number is of one of two kinds, relative to the least one of its set.
pub(super) struct UnionFind {
    /// For each number, a lesser one of its set, or itself, and whether the two differ in kind.
    parents: Vec<(usize, bool)>,
}

impl UnionFind {
    /// Each number in a set of its own.
    pub(super) fn new(count: usize) -> Self {
        Self { parents: (0..count).map(|k| (k, false)).collect() }
    }

    /// The least number in the set of k.
    pub(super) fn least(&mut self, k: usize) -> usize {
        self.find(k).0
    }

    /// The least number in the set of k, and whether k differs from it in kind.
    pub(super) fn find(&mut self, mut k: usize) -> (usize, bool) {
        let mut differs = false;
        loop {
            let (parent, from_parent) = self.parents[k];
            if parent == k {
                return (k, differs);
            }
            let (next, from_next) = self.parents[parent];
            self.parents[k] = (next, from_parent != from_next);
            differs ^= self.parents[k].1;
            k = next;
        }
    }

    /// Unites the sets of two numbers of one kind.
    pub(super) fn unite(&mut self, a: usize, b: usize) {
        self.relate(a, b, false);
    }

    /// Unites the sets of two numbers that differ in kind or not. Returns whether earlier relations agree.
    pub(super) fn relate(&mut self, a: usize, b: usize, differ: bool) -> bool {
        let ((a, a_differs), (b, b_differs)) = (self.find(a), self.find(b));
        let differ = differ != (a_differs != b_differs);
        if a != b {
            self.parents[a.max(b)] = (a.min(b), differ);
        }
        a != b || !differ
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_follow_from_pairs() {
        let mut sets = UnionFind::new(7);
        for (a, b, differ) in [(5, 6, true), (1, 2, true), (3, 4, true), (2, 3, false), (5, 4, true)] {
            assert!(sets.relate(a, b, differ));
        }
        let found: Vec<_> = (0..7).map(|k| sets.find(k)).collect();
        let kinds = [false, true, true, false, true, false];
        assert_eq!(found[0], (0, false));
        assert!((1..7).all(|k| found[k] == (1, kinds[k - 1])), "{found:?}");
        assert!(sets.relate(6, 1, false) && !sets.relate(6, 1, true), "a contradiction");
    }
}
