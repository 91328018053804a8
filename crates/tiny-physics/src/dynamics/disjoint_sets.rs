//! Disjoint sets that only grow together (union-find): what hangs together through pairs.
//!
//! Source: R. E. Tarjan and J. van Leeuwen, *Worst-case analysis of set union algorithms*, 1984: path halving. Of two
//! roots the smaller becomes that of both, so the result depends on the sets alone and on no order of pairs.

/// Numbers from 0 on, each in one set.
#[derive(Debug, Default)]
pub(crate) struct DisjointSets {
    /// Of each number a smaller one of its set; its own where it is the smallest, the *root*.
    parents: Vec<u32>,
}

crate::footprint::footprint!(DisjointSets { parents });

impl DisjointSets {
    /// Puts each of some numbers below `count` into a set of its own. The others are not to be asked for or joined: to go
    /// past them costs nothing.
    pub(crate) fn reset(&mut self, count: usize, numbers: impl IntoIterator<Item = u32>) {
        self.parents.resize(self.parents.len().max(count), 0);
        for number in numbers {
            self.parents[number as usize] = number;
        }
    }

    /// The smallest number of the set that a number is in.
    pub(crate) fn root(&mut self, mut at: u32) -> u32 {
        while self.parents[at as usize] != at {
            let above = self.parents[self.parents[at as usize] as usize];
            self.parents[at as usize] = above;
            at = above;
        }
        at
    }

    /// Makes one set of those of two numbers; false where they are one already.
    pub(crate) fn join(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = (self.root(a), self.root(b));
        let (root, child) = if a < b { (a, b) } else { (b, a) };
        self.parents[child as usize] = root;
        a != b
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn join_tells_whether_two_sets_became_one() {
        let mut sets = DisjointSets::default();
        sets.reset(5, 0..5);
        assert!(sets.join(3, 4));
        assert!(sets.join(1, 3));
        assert!(!sets.join(4, 1), "3 joins them");
        assert!(!sets.join(2, 2));
        let roots: Vec<u32> = (0..5).map(|at| sets.root(at)).collect();
        assert_eq!(roots, [0, 1, 2, 1, 1]);
        sets.reset(2, 0..2);
        assert_eq!(sets.root(1), 1, "what was joined is forgotten");
        assert_eq!(sets.root(4), 1, "of those alone that are named");
    }

    /// Random pairs against labels that are rewritten one by one.
    #[test]
    fn the_root_is_the_smallest_number_of_the_set() {
        const COUNT: u32 = 40;
        let mut state = 7_u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 16) % COUNT
        };
        let mut sets = DisjointSets::default();
        for _ in 0..20 {
            sets.reset(COUNT as usize, 0..COUNT);
            let mut labels: Vec<u32> = (0..COUNT).collect();
            for _ in 0..60 {
                let (a, b) = (random(), random());
                let (label_a, label_b) = (labels[a as usize], labels[b as usize]);
                assert_eq!(sets.join(a, b), label_a != label_b);
                let least = label_a.min(label_b);
                for label in &mut labels {
                    if *label == label_a || *label == label_b {
                        *label = least;
                    }
                }
                let asked = random();
                assert_eq!(sets.root(asked), labels[asked as usize]);
            }
        }
    }
}
