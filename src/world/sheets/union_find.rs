/// A partition of the numbers from 0 on into sets that only grow.
pub(super) struct UnionFind(Vec<usize>);

impl UnionFind {
    /// Each number in a set of its own.
    pub(super) fn new(count: usize) -> Self {
        Self((0..count).collect())
    }

    /// The least number in the set of k.
    pub(super) fn least(&mut self, mut k: usize) -> usize {
        while self.0[k] != k {
            self.0[k] = self.0[self.0[k]];
            k = self.0[k];
        }
        k
    }

    /// Unites the sets of two numbers.
    pub(super) fn unite(&mut self, a: usize, b: usize) {
        let (a, b) = (self.least(a), self.least(b));
        self.0[a.max(b)] = a.min(b);
    }
}
