//! Disjoint sets of numbers (union–find): what is connected with what.

/// The numbers below a count, in sets of which each has one of its own as root.
#[derive(Debug)]
pub(crate) struct Sets {
    /// Each number's way to its root; a root leads to itself.
    parent: Vec<usize>,
}

impl Sets {
    /// Each number alone.
    pub(crate) fn new(count: usize) -> Self {
        Self {
            parent: (0..count).collect(),
        }
    }

    /// The root of the set that holds `k`; the way to it is made shorter.
    pub(crate) fn root(&mut self, mut k: usize) -> usize {
        while self.parent[k] != k {
            self.parent[k] = self.parent[self.parent[k]];
            k = self.parent[k];
        }
        k
    }

    /// Makes one set of those of `a` and `b`, with the root of `a`.
    pub(crate) fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[b] = a;
    }
}

#[cfg(test)]
mod tests {
    use super::Sets;

    #[test]
    fn what_is_joined_has_the_root_of_the_first() {
        let mut sets = Sets::new(6);
        sets.join(2, 1);
        sets.join(4, 5);
        sets.join(1, 5);
        // Once more changes nothing.
        sets.join(5, 2);
        let roots: Vec<usize> = (0..6).map(|k| sets.root(k)).collect();
        assert_eq!(roots, [0, 2, 2, 3, 2, 2]);
    }

    #[test]
    fn a_long_chain_is_one_set() {
        let count = 1000;
        let mut sets = Sets::new(count);
        for k in (1..count).rev() {
            sets.join(k - 1, k);
        }
        assert!((0..count).all(|k| sets.root(k) == 0));
    }
}
