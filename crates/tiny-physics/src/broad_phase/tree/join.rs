//! Which boxes of two trees overlap.

use super::super::NONE;
use super::super::node_boxes::WIDTH;
use super::DynamicTree;

impl DynamicTree {
    /// Calls `visit` with the ids of every two boxes that overlap, one of this tree and one of the other. A tree and
    /// itself: with every two of its boxes, once.
    ///
    /// Goes down both trees at once, so what lies together is looked at together.
    pub(in crate::broad_phase) fn join(&self, other: &Self, mut visit: impl FnMut(u32, u32)) {
        let same = core::ptr::eq(self, other);
        let mut pairs = Vec::new();
        if self.root != NONE && other.root != NONE {
            pairs.push((self.root, other.root));
        }
        while let Some((a, b)) = pairs.pop() {
            let (level_a, level_b) = (self.level(a), other.level(b));
            if level_a > level_b {
                let bounds = other.boxes[b as usize].union();
                let hit = self.overlaps(a, &bounds);
                pairs.extend(bits(hit).map(|lane| (self.child(a, lane), b)));
                continue;
            }
            if level_a < level_b {
                let bounds = self.boxes[a as usize].union();
                let hit = other.overlaps(b, &bounds);
                pairs.extend(bits(hit).map(|lane| (a, other.child(b, lane))));
                continue;
            }
            for lane in 0..WIDTH {
                let (child, aabb) = self.leaf(a, lane);
                let mut hit = other.overlaps(b, &aabb);
                if same && a == b {
                    // Each pair of children once; a node also meets itself, a leaf does not.
                    hit &= u32::MAX << (lane + usize::from(level_a == 0));
                }
                for partner in bits(hit).map(|lane| other.child(b, lane)) {
                    if level_a == 0 {
                        visit(child, partner);
                    } else {
                        pairs.push((child, partner));
                    }
                }
            }
        }
    }

    fn level(&self, index: u32) -> u8 {
        self.nodes[index as usize].level
    }
}

/// The numbers of the bits that are set.
fn bits(mut word: u32) -> impl Iterator<Item = usize> {
    core::iter::from_fn(move || {
        let lowest = word.trailing_zeros() as usize;
        word &= word.wrapping_sub(1);
        (lowest < WIDTH).then_some(lowest)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Aabb, Vec2};

    fn boxes(count: u32, mut state: u32, size: f32) -> Vec<Aabb> {
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / (1 << 24) as f32
        };
        let mut aabb = || {
            let (center, half) = (Vec2::new(random(), random()), Vec2::new(random(), random()));
            Aabb::from_center(center * 20.0, half * size)
        };
        (0..count).map(|_| aabb()).collect()
    }

    fn tree(boxes: &[Aabb]) -> DynamicTree {
        let mut tree = DynamicTree::new();
        boxes.iter().zip(0..).for_each(|(aabb, id)| tree.insert(id, *aabb, 1));
        // Some are gone again.
        (0..boxes.len() as u32).step_by(7).for_each(|id| assert!(tree.remove(id)));
        tree
    }

    /// All pairs one by one; of a list and itself each once.
    fn brute_force(a: &[Aabb], b: &[Aabb], same: bool) -> Vec<(u32, u32)> {
        let there = |list: &[Aabb]| (0..list.len() as u32).filter(|id| id % 7 != 0).collect();
        let (ids_a, ids_b): (Vec<u32>, Vec<u32>) = (there(a), there(b));
        let pairs = ids_a.iter().flat_map(|&i| ids_b.iter().map(move |&k| (i, k)));
        let overlap = |&(i, k): &(u32, u32)| a[i as usize].overlaps(&b[k as usize]);
        pairs.filter(|(i, k)| !same || i < k).filter(overlap).collect()
    }

    #[test]
    fn finds_the_pairs_that_are_there() {
        // Trees of different heights, one without anything.
        let lists = [(0, 1.0), (5, 9.0), (60, 1.0), (700, 0.4)];
        let lists = lists.map(|(count, size)| boxes(count, count + 1, size));
        let trees = lists.each_ref().map(|boxes| tree(boxes));
        let mut found_any = 0;
        for (a, tree_a) in lists.iter().zip(&trees) {
            for (b, tree_b) in lists.iter().zip(&trees) {
                let same = core::ptr::eq(tree_a, tree_b);
                let mut found = Vec::new();
                tree_a.join(tree_b, |i, k| found.push(if same && k < i { (k, i) } else { (i, k) }));
                found.sort_unstable();
                assert_eq!(found, brute_force(a, b, same));
                found_any += usize::from(!found.is_empty());
            }
        }
        assert!(found_any >= 9);
    }
}
