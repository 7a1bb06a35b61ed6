//! Union–find.

/// Disjoint sets of the numbers below `n`; each is known by its least member.
#[derive(Clone, Debug)]
pub struct Sets {
    toward: Vec<usize>,
}

impl Sets {
    /// Every number alone.
    pub fn new(n: usize) -> Self {
        Self { toward: (0..n).collect() }
    }

    /// The least member of the set of `i`.
    pub fn find(&mut self, mut i: usize) -> usize {
        while self.toward[i] != i {
            // Halving the way on the way keeps later ways short.
            self.toward[i] = self.toward[self.toward[i]];
            i = self.toward[i];
        }
        i
    }

    /// Makes one set of two; false where they are one already.
    pub fn join(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.find(a), self.find(b));
        self.toward[a.max(b)] = a.min(b);
        a != b
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_member_names_the_set_whatever_the_order() {
        for pairs in [[(3, 1), (5, 3), (2, 4)], [(5, 3), (1, 3), (4, 2)]] {
            let mut sets = Sets::new(6);
            assert!(pairs.iter().all(|&(a, b)| sets.join(a, b)));
            assert_eq!((0..6).map(|i| sets.find(i)).collect::<Vec<_>>(), [0, 1, 2, 1, 2, 1]);
            assert!(!sets.join(5, 1) && sets.join(5, 0));
            assert_eq!(sets.find(3), 0);
        }
    }
}
