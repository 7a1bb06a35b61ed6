//! Union–find.

/// Disjoint sets of the numbers below `n`; each is known by its least member, with which every
/// other agrees or disagrees (Tarjan 1975, with parity).
#[derive(Clone, Debug)]
pub struct Sets {
    toward: Vec<usize>,
    /// Whether a number disagrees with the one it points to.
    against: Vec<bool>,
}

impl Sets {
    /// Every number alone.
    pub fn new(n: usize) -> Self {
        Self { toward: (0..n).collect(), against: vec![false; n] }
    }

    /// The least member of the set of `i`.
    pub fn find(&mut self, i: usize) -> usize {
        self.side(i).0
    }

    /// The least member of the set of `i`, and whether `i` disagrees with it.
    pub fn side(&mut self, mut i: usize) -> (usize, bool) {
        let mut against = false;
        while self.toward[i] != i {
            // Halving the way on the way keeps later ways short.
            let next = self.toward[i];
            self.against[i] ^= self.against[next];
            self.toward[i] = self.toward[next];
            against ^= self.against[i];
            i = self.toward[i];
        }
        (i, against)
    }

    /// Makes one set of two; false where they are one already.
    pub fn join(&mut self, a: usize, b: usize) -> bool {
        let apart = self.find(a) != self.find(b);
        self.relate(a, b, false);
        apart
    }

    /// Makes one set of two whose members `a` and `b` disagree (or agree); false where that
    /// contradicts what was stated before.
    pub fn relate(&mut self, a: usize, b: usize, disagree: bool) -> bool {
        let ((a, of_a), (b, of_b)) = (self.side(a), self.side(b));
        let against = of_a ^ of_b ^ disagree;
        if a == b {
            return !against;
        }
        self.toward[a.max(b)] = a.min(b);
        self.against[a.max(b)] = against;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

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

    proptest! {
        /// Numbers of two colours, pairs stated as they are: every member is on the side of its
        /// colour, and the contrary is refused.
        #[test]
        fn members_are_on_the_side_of_their_colour(colour in prop::collection::vec(any::<bool>(), 20), pairs in prop::collection::vec((0usize..20, 0usize..20), 0..40)) {
            let mut sets = Sets::new(20);
            for &(a, b) in &pairs {
                prop_assert!(sets.relate(a, b, colour[a] != colour[b]));
            }
            for i in 0..20 {
                let (least, against) = sets.side(i);
                prop_assert!(least <= i && against == (colour[i] != colour[least]));
                prop_assert!(!sets.relate(i, least, !against));
            }
        }
    }
}
