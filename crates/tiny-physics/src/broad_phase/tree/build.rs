//! Building trees anew, and where full nodes are cut.

use super::super::NONE;
use super::super::node_boxes::WIDTH;
use super::{Branch, DynamicTree};
use crate::math::Aabb;
use crate::work;

impl DynamicTree {
    /// Builds the tree anew where that is worth it: once about as much has changed as there are
    /// boxes, and a node has become larger by a quarter, at the mean.
    pub fn maintain(&mut self) {
        if self.changes <= self.count + 64 {
            return;
        }
        self.changes = 0;
        if self.size() > self.built_size + 0.32 {
            self.rebuild();
        }
    }

    /// Builds the tree anew, top down, by halving along the longer side of the boxes' centres.
    pub fn rebuild(&mut self) {
        let mut branches = core::mem::take(&mut self.spare.0);
        branches.reserve(self.count);
        for (index, node) in (0..).zip(&self.nodes).filter(|(_, node)| node.level == 0) {
            work::note();
            let lanes = (0..WIDTH).filter(|&lane| node.child[lane] != NONE);
            branches.extend(lanes.map(|lane| self.branch(index, lane)));
        }
        branches.sort_unstable_by_key(|branch| branch.child);
        self.boxes.clear();
        self.nodes.clear();
        (self.root, self.free) = (NONE, NONE);
        if !branches.is_empty() {
            let mut level = 0;
            while capacity(level) < branches.len() {
                level += 1;
            }
            self.root = self.build(&mut branches, level);
        }
        branches.clear();
        self.spare.0 = branches;
        self.changes = 0;
        self.built_size = self.size();
    }

    /// Perimeters of all nodes, per box in the tree.
    pub(super) fn cost(&self) -> f32 {
        let mut total = 0.0;
        for boxes in &self.boxes {
            let perimeter = boxes.union().perimeter();
            if perimeter > 0.0 {
                total += perimeter;
            }
        }
        total / self.count as f32
    }

    /// Logarithm to the base of 2 of the perimeter of a node, at the mean: one box far off makes the nodes above it as large as that is
    /// far, and in a sum of perimeters nothing else would count.
    fn size(&self) -> f32 {
        let perimeters = self.boxes.iter().map(|boxes| boxes.union().perimeter());
        let (sum, count) = perimeters
            .filter(|&it| it > 0.0 && it < f32::INFINITY)
            .fold((0.0, 0.0_f32), |(sum, count), it| (sum + logarithm(it), count + 1.0));
        sum / count.max(1.0)
    }

    fn build(&mut self, branches: &mut [Branch], level: u8) -> u32 {
        let index = self.allocate(level);
        if level == 0 {
            // How parts were halved leaves the order within them to the library's algorithm; bits must not hang on that.
            branches.sort_unstable_by_key(|branch| branch.child);
            self.fill(index, branches);
            return index;
        }
        let parts = branches.len().div_ceil(capacity(level - 1));
        let mut lane = 0;
        self.build_parts(index, &mut lane, branches, parts);
        self.nodes[index as usize].count = lane as u8;
        index
    }

    fn build_parts(&mut self, index: u32, lane: &mut usize, part: &mut [Branch], parts: usize) {
        if parts == 1 {
            let child = self.build(part, self.nodes[index as usize].level - 1);
            self.put(index, *lane, self.summary(child));
            *lane += 1;
            return;
        }
        let middle = part.len() * (parts / 2) / parts;
        let axis = wider_axis(part);
        part.select_nth_unstable_by(middle, |a, b| compare(a, b, axis));
        let (low, high) = part.split_at_mut(middle);
        self.build_parts(index, lane, low, parts / 2);
        self.build_parts(index, lane, high, parts - parts / 2);
    }
}

/// To the base of 2, exact at the powers and straight between them: a float's exponent with its fraction behind.
fn logarithm(of: f32) -> f32 {
    of.to_bits() as f32 / (1 << 23) as f32 - 127.0
}

/// Leaves that a tree with its root on this level can hold.
fn capacity(level: u8) -> usize {
    WIDTH.saturating_pow(u32::from(level) + 1)
}

/// The axis along which the centres spread more.
fn wider_axis(branches: &[Branch]) -> usize {
    let mut centers = Aabb::EMPTY;
    for branch in branches {
        let center = branch.aabb.center();
        centers = centers.union(&Aabb::new(center, center));
    }
    usize::from(centers.max.y - centers.min.y > centers.max.x - centers.min.x)
}

#[inline]
fn compare(a: &Branch, b: &Branch, axis: usize) -> core::cmp::Ordering {
    let (p, q) = (a.aabb.center()[axis], b.aabb.center()[axis]);
    p.total_cmp(&q).then(a.child.cmp(&b.child))
}

/// Sorts the children of a full node and finds where to cut: least perimeter of both parts, three
/// children a part at least.
pub(super) fn best_cut(all: &mut [Branch; WIDTH + 1]) -> usize {
    let axis = wider_axis(all);
    all.sort_unstable_by(|a, b| compare(a, b, axis));
    let union = |part: &[Branch]| {
        part.iter().fold(Aabb::EMPTY, |all, branch| all.union(&branch.aabb)).perimeter()
    };
    let (mut best, mut best_cost) = (WIDTH.div_ceil(2), f32::INFINITY);
    for cut in 3..=WIDTH - 2 {
        let cost = union(&all[..cut]) + union(&all[cut..]);
        if cost < best_cost {
            (best, best_cost) = (cut, cost);
        }
    }
    best
}
