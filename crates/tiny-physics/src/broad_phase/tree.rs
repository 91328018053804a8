//! A dynamic bounding volume tree over boxes with ids.
//!
//! Binary, with boxes in the leaves. A new leaf goes where it adds the least perimeter (the surface
//! area heuristic of Goldsmith and Salmon, 1987, in the plane), and rotations on the way up keep the
//! tree good (Kopta et al., "Fast, Effective BVH Updates for Animated Scenes", 2012). Every node has
//! the union of its leaves' categories, so a query skips subtrees that it cannot collide with.
//!
//! Results of a query do not depend on the shape of the tree, only their order does.

use super::stack::Stack;
use super::{BoxCast, NONE, clamped};
use crate::math::{Aabb, Vec2};
use core::ops::ControlFlow;

/// A leaf has `child[0] == NONE` and its id in `child[1]`. A free node has the next one in `parent`.
#[derive(Clone, Copy, Debug)]
struct Node {
    aabb: Aabb,
    category: u64,
    parent: u32,
    child: [u32; 2],
    height: u32,
}

const _: () = assert!(size_of::<Node>() == 40);

impl Node {
    #[inline]
    fn is_leaf(&self) -> bool {
        self.child[0] == NONE
    }
}

/// A map from small ids to boxes, with fast queries by area.
///
/// Ids are the caller's: dense numbers, because a table over all ids up to the largest is kept. A box
/// with NaN in it overlaps nothing; coordinates beyond [`LIMIT`](super::LIMIT) count as that limit.
///
/// ```
/// use tiny_physics::{Aabb, Vec2, broad_phase::DynamicTree};
/// use std::ops::ControlFlow;
/// let mut tree = DynamicTree::new();
/// tree.insert(7, Aabb::from_center(Vec2::ZERO, Vec2::splat(1.0)), 1);
/// let mut found = Vec::new();
/// tree.query(&Aabb::from_center(Vec2::X, Vec2::splat(0.5)), u64::MAX, |id| {
///     found.push(id);
///     ControlFlow::Continue(())
/// });
/// assert_eq!(found, [7]);
/// ```
#[derive(Debug)]
pub struct DynamicTree {
    nodes: Vec<Node>,
    /// Leaf node of each id, or `NONE`.
    leaves: Vec<u32>,
    root: u32,
    free: u32,
    count: usize,
}

impl Default for DynamicTree {
    fn default() -> Self {
        Self::new()
    }
}

impl Clone for DynamicTree {
    fn clone(&self) -> Self {
        Self { nodes: self.nodes.clone(), leaves: self.leaves.clone(), ..*self }
    }

    fn clone_from(&mut self, source: &Self) {
        self.nodes.clone_from(&source.nodes);
        self.leaves.clone_from(&source.leaves);
        (self.root, self.free, self.count) = (source.root, source.free, source.count);
    }
}

impl DynamicTree {
    /// A tree with nothing in it.
    pub const fn new() -> Self {
        Self { nodes: Vec::new(), leaves: Vec::new(), root: NONE, free: NONE, count: 0 }
    }

    /// Number of boxes.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Is there no box?
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Is there a box with this id?
    pub fn contains(&self, id: u32) -> bool {
        self.leaf(id).is_some()
    }

    /// The box of an id, `None` where there is none.
    pub fn get(&self, id: u32) -> Option<Aabb> {
        self.leaf(id).map(|leaf| self.nodes[leaf as usize].aabb)
    }

    /// The union of all boxes; [`Aabb::EMPTY`] without any.
    pub fn bounds(&self) -> Aabb {
        if self.root == NONE { Aabb::EMPTY } else { self.nodes[self.root as usize].aabb }
    }

    /// The union of all categories.
    pub fn category(&self) -> u64 {
        if self.root == NONE { 0 } else { self.nodes[self.root as usize].category }
    }

    /// Removes all boxes; keeps the memory.
    pub fn clear(&mut self) {
        self.nodes.clear();
        self.leaves.clear();
        (self.root, self.free, self.count) = (NONE, NONE, 0);
    }

    /// Puts a box in, in place of the one that the id had before, if any.
    pub fn insert(&mut self, id: u32, aabb: Aabb, category: u64) {
        self.remove(id);
        let leaf = self.allocate(Node {
            aabb: clamped(aabb),
            category,
            parent: NONE,
            child: [NONE, id],
            height: 0,
        });
        let slot = id as usize;
        if self.leaves.len() <= slot {
            self.leaves.resize(slot + 1, NONE);
        }
        self.leaves[slot] = leaf;
        self.count += 1;
        self.link(leaf);
    }

    /// Takes a box out; false where the id has none.
    pub fn remove(&mut self, id: u32) -> bool {
        let Some(leaf) = self.leaf(id) else { return false };
        self.leaves[id as usize] = NONE;
        self.count -= 1;
        self.unlink(leaf);
        self.release(leaf);
        true
    }

    /// Gives a box that is in the tree a new place; false where the id has none. A box that stayed
    /// near only changes its ancestors; one that went far is put in anew.
    pub fn update(&mut self, id: u32, aabb: Aabb) -> bool {
        let Some(leaf) = self.leaf(id) else { return false };
        let aabb = clamped(aabb);
        let parent = self.nodes[leaf as usize].parent;
        if parent != NONE && !self.nodes[parent as usize].aabb.contains(&aabb) {
            self.unlink(leaf);
            self.nodes[leaf as usize].aabb = aabb;
            self.link(leaf);
        } else {
            self.nodes[leaf as usize].aabb = aabb;
            self.refit(parent);
        }
        true
    }

    /// Gives a box another category; false where the id has none.
    pub fn set_category(&mut self, id: u32, category: u64) -> bool {
        let Some(leaf) = self.leaf(id) else { return false };
        self.nodes[leaf as usize].category = category;
        self.refit(self.nodes[leaf as usize].parent);
        true
    }

    /// Calls `visit` with every id whose box overlaps `aabb` (edges count) and whose category has a bit of
    /// `mask`, until it breaks. The order depends on the shape of the tree.
    #[inline]
    pub fn query(&self, aabb: &Aabb, mask: u64, mut visit: impl FnMut(u32) -> ControlFlow<()>) {
        let aabb = clamped(*aabb);
        let mut stack = Stack::new();
        let mut next = (self.root != NONE).then_some(self.root);
        while let Some(index) = next {
            let node = &self.nodes[index as usize];
            if node.category & mask == 0 || !node.aabb.overlaps(&aabb) {
                next = stack.pop();
            } else if node.is_leaf() {
                if visit(node.child[1]).is_break() {
                    return;
                }
                next = stack.pop();
            } else {
                stack.push(node.child[1]);
                next = Some(node.child[0]);
            }
        }
    }

    /// Calls `visit` with the ids whose box the cast may hit before `max_fraction`, roughly the nearest
    /// first. `visit` gets the id and the current limit and returns the new one: the same to go on, the fraction of
    /// a hit to look only for nearer ones, 0 to stop.
    pub fn cast(
        &self,
        cast: &BoxCast,
        max_fraction: f32,
        mask: u64,
        mut visit: impl FnMut(u32, f32) -> f32,
    ) {
        let mut limit = max_fraction;
        let mut bounds = clamped(cast.bounds(limit));
        let mut stack = Stack::new();
        let mut next = (self.root != NONE).then_some(self.root);
        while let Some(index) = next {
            let node = &self.nodes[index as usize];
            if node.category & mask == 0
                || !node.aabb.overlaps(&bounds)
                || cast.line_misses(&node.aabb)
            {
                next = stack.pop();
            } else if node.is_leaf() {
                let fraction = visit(node.child[1], limit);
                if fraction <= 0.0 {
                    return;
                }
                if fraction < limit {
                    limit = fraction;
                    bounds = clamped(cast.bounds(limit));
                }
                next = stack.pop();
            } else {
                let (near, far) = self.near_far(node, cast.translation);
                stack.push(far);
                next = Some(near);
            }
        }
    }

    /// Builds all inner nodes anew, top down, by halving along the longer side.
    pub fn rebuild(&mut self) {
        let mut leaves: Vec<u32> = self.leaves.iter().copied().filter(|&n| n != NONE).collect();
        self.free_inner_nodes();
        self.root = if leaves.is_empty() { NONE } else { self.build(&mut leaves) };
        if self.root != NONE {
            self.nodes[self.root as usize].parent = NONE;
        }
    }

    /// Longest way from the root to a leaf; 0 for one box or none.
    pub fn height(&self) -> u32 {
        if self.root == NONE { 0 } else { self.nodes[self.root as usize].height }
    }

    /// Perimeters of all inner nodes over the perimeter of the root: about how many nodes a query of
    /// random place looks at. Lower is better.
    pub fn area_ratio(&self) -> f32 {
        let root = self.bounds().perimeter();
        if root <= 0.0 || root.is_nan() {
            return 0.0;
        }
        let mut total = 0.0;
        self.for_each_node(|node| {
            if !node.is_leaf() {
                total += node.aabb.perimeter();
            }
        });
        total / root
    }

    /// Checks every invariant. For tests.
    ///
    /// # Errors
    ///
    /// Says what is wrong, and at which node.
    pub fn validate(&self) -> Result<(), String> {
        let (mut leaves, mut inner) = (0, 0);
        let mut stack = vec![(self.root, NONE)];
        while let Some((index, parent)) = stack.pop() {
            if index == NONE {
                continue;
            }
            let node =
                self.nodes.get(index as usize).ok_or(format!("node {index} is not there"))?;
            if node.parent != parent {
                return Err(format!("node {index} has parent {}, not {parent}", node.parent));
            }
            if node.is_leaf() {
                leaves += 1;
                if self.leaf(node.child[1]) != Some(index) {
                    return Err(format!("id {} does not know its leaf {index}", node.child[1]));
                }
                continue;
            }
            inner += 1;
            if self.summary(node.child) != (node.aabb, node.category, node.height) {
                return Err(format!("node {index} is not the union of its children"));
            }
            stack.extend(node.child.map(|child| (child, index)));
        }
        let known = self.leaves.iter().filter(|&&leaf| leaf != NONE).count();
        if leaves != self.count || known != self.count || inner != self.count.saturating_sub(1) {
            return Err(format!("{leaves} leaves, {inner} inner nodes, {} boxes", self.count));
        }
        Ok(())
    }

    #[inline]
    fn leaf(&self, id: u32) -> Option<u32> {
        self.leaves.get(id as usize).copied().filter(|&leaf| leaf != NONE)
    }

    fn allocate(&mut self, node: Node) -> u32 {
        if self.free == NONE {
            self.nodes.push(node);
            return self.nodes.len() as u32 - 1;
        }
        let index = self.free;
        self.free = self.nodes[index as usize].parent;
        self.nodes[index as usize] = node;
        index
    }

    fn release(&mut self, index: u32) {
        self.nodes[index as usize].parent = self.free;
        self.free = index;
    }

    #[inline]
    fn aabb(&self, index: u32) -> Aabb {
        self.nodes[index as usize].aabb
    }

    /// What a node over these children has.
    #[inline]
    fn summary(&self, child: [u32; 2]) -> (Aabb, u64, u32) {
        let (a, b) = (&self.nodes[child[0] as usize], &self.nodes[child[1] as usize]);
        let height = 1 + if a.height > b.height { a.height } else { b.height };
        (a.aabb.union(&b.aabb), a.category | b.category, height)
    }

    /// Hangs a leaf beside the best sibling.
    fn link(&mut self, leaf: u32) {
        if self.root == NONE {
            self.root = leaf;
            self.nodes[leaf as usize].parent = NONE;
            return;
        }
        let sibling = self.best_sibling(self.aabb(leaf));
        let parent = self.nodes[sibling as usize].parent;
        let joint = self.allocate(Node {
            aabb: Aabb::EMPTY,
            category: 0,
            parent,
            child: [sibling, leaf],
            height: 0,
        });
        self.replace_child(parent, sibling, joint);
        self.nodes[sibling as usize].parent = joint;
        self.nodes[leaf as usize].parent = joint;
        self.refit(joint);
    }

    /// Takes a leaf off; its sibling takes the place of their parent.
    fn unlink(&mut self, leaf: u32) {
        let parent = self.nodes[leaf as usize].parent;
        if parent == NONE {
            self.root = NONE;
            return;
        }
        let Node { child, parent: grandparent, .. } = self.nodes[parent as usize];
        let sibling = if child[0] == leaf { child[1] } else { child[0] };
        self.nodes[sibling as usize].parent = grandparent;
        self.replace_child(grandparent, parent, sibling);
        self.release(parent);
        self.refit(grandparent);
    }

    fn replace_child(&mut self, parent: u32, old: u32, new: u32) {
        if parent == NONE {
            self.root = new;
            return;
        }
        let child = &mut self.nodes[parent as usize].child;
        child[usize::from(child[0] != old)] = new;
    }

    /// Goes down to where a new parent of the box adds the least perimeter.
    fn best_sibling(&self, aabb: Aabb) -> u32 {
        let mut index = self.root;
        loop {
            let node = &self.nodes[index as usize];
            if node.is_leaf() {
                return index;
            }
            let joined = node.aabb.union(&aabb).perimeter();
            let inherited = joined - node.aabb.perimeter();
            let [a, b] = node.child.map(|child| {
                let child = &self.nodes[child as usize];
                let joined = child.aabb.union(&aabb).perimeter();
                if child.is_leaf() { joined } else { joined - child.aabb.perimeter() }
            });
            if joined < inherited + a && joined < inherited + b {
                return index;
            }
            index = node.child[usize::from(b < a)];
        }
    }

    /// Recomputes the nodes from `index` up to the root, rotating where that helps.
    fn refit(&mut self, mut index: u32) {
        while index != NONE {
            self.rotate(index);
            let summary = self.summary(self.nodes[index as usize].child);
            let node = &mut self.nodes[index as usize];
            (node.aabb, node.category, node.height) = summary;
            index = node.parent;
        }
    }

    /// Swaps a child of `index` with a grandchild where that makes the other child smaller.
    fn rotate(&mut self, index: u32) {
        let child = self.nodes[index as usize].child;
        let mut best = (0.0, 0, 0);
        for side in 0..2 {
            let (low, high) = (&self.nodes[child[side] as usize], self.aabb(child[1 - side]));
            if low.is_leaf() {
                continue;
            }
            let perimeter = low.aabb.perimeter();
            for k in 0..2 {
                let kept = self.aabb(low.child[1 - k]);
                let gain = perimeter - kept.union(&high).perimeter();
                if gain > best.0 {
                    best = (gain, side, k);
                }
            }
        }
        if best.0 > 0.0 {
            self.swap(index, best.1, best.2);
        }
    }

    fn swap(&mut self, index: u32, side: usize, k: usize) {
        let child = self.nodes[index as usize].child;
        let (low, high) = (child[side], child[1 - side]);
        let grandchild = self.nodes[low as usize].child[k];
        self.nodes[index as usize].child[1 - side] = grandchild;
        self.nodes[grandchild as usize].parent = index;
        self.nodes[low as usize].child[k] = high;
        self.nodes[high as usize].parent = low;
        let summary = self.summary(self.nodes[low as usize].child);
        let node = &mut self.nodes[low as usize];
        (node.aabb, node.category, node.height) = summary;
    }

    fn near_far(&self, node: &Node, direction: Vec2) -> (u32, u32) {
        let [a, b] = node.child;
        let towards = |index| self.aabb(index).center().dot(direction);
        if towards(b) < towards(a) { (b, a) } else { (a, b) }
    }

    fn for_each_node(&self, mut visit: impl FnMut(&Node)) {
        let mut stack = vec![self.root];
        while let Some(index) = stack.pop() {
            if index == NONE {
                continue;
            }
            let node = &self.nodes[index as usize];
            visit(node);
            if !node.is_leaf() {
                stack.extend(node.child);
            }
        }
    }

    fn free_inner_nodes(&mut self) {
        let mut stack = vec![self.root];
        while let Some(index) = stack.pop() {
            if index == NONE || self.nodes[index as usize].is_leaf() {
                continue;
            }
            stack.extend(self.nodes[index as usize].child);
            self.release(index);
        }
    }

    fn build(&mut self, leaves: &mut [u32]) -> u32 {
        if let [leaf] = leaves {
            return *leaf;
        }
        let middle = self.partition(leaves);
        let (low, high) = leaves.split_at_mut(middle);
        let child = [self.build(low), self.build(high)];
        let (aabb, category, height) = self.summary(child);
        let index = self.allocate(Node { aabb, category, parent: NONE, child, height });
        for child in child {
            self.nodes[child as usize].parent = index;
        }
        index
    }

    /// Sorts the leaves into two halves along the longer side of their centres.
    fn partition(&self, leaves: &mut [u32]) -> usize {
        let mut centers = Aabb::EMPTY;
        for &leaf in leaves.iter() {
            let center = self.aabb(leaf).center();
            centers = centers.union(&Aabb::new(center, center));
        }
        let axis = usize::from(centers.max.y - centers.min.y > centers.max.x - centers.min.x);
        let middle = leaves.len() / 2;
        leaves.select_nth_unstable_by(middle, |&a, &b| {
            let (p, q) = (self.aabb(a).center()[axis], self.aabb(b).center()[axis]);
            p.total_cmp(&q).then(a.cmp(&b))
        });
        middle
    }
}
