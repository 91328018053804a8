//! A dynamic tree of boxes with eight children a node.
//!
//! An R-tree (Guttman, "R-Trees: A Dynamic Index Structure for Spatial Searching", 1984) whose
//! nodes keep the boxes of their children as four rows of eight floats, so that one node is tested
//! with a handful of vector compares. All leaves are at the same depth, so a million boxes are
//! seven to ten levels at worst, whatever the order of insertion. A new box goes down where it adds
//! the least perimeter; a full node is cut in two along the axis where its boxes spread more.
//!
//! Every child has the union of its leaves' categories, so a query skips subtrees that it cannot
//! collide with. Results of a query do not depend on the shape of the tree, only their order does.

mod build;
mod check;
mod join;

use super::node_boxes::{Boxes, WIDTH};
use super::stack::Stack;
use super::{NONE, Search, clamped};
use crate::codec::{Data, Reader, Sink, store};
use crate::error::Error;
use crate::footprint::{Footprint, MemoryUse};
use crate::math::Aabb;
use core::ops::ControlFlow;

/// Everything of a node but the boxes.
#[derive(Clone, Copy, Debug)]
struct Node {
    category: [u64; WIDTH],
    /// Ids at level 0, nodes above. `NONE` where there is none.
    child: [u32; WIDTH],
    /// `NONE` for the root; the next free node for a free one.
    parent: u32,
    /// Which child of the parent this is.
    lane: u8,
    level: u8,
    count: u8,
}

impl Node {
    const fn new(level: u8) -> Self {
        Self { category: [0; WIDTH], child: [NONE; WIDTH], parent: NONE, lane: 0, level, count: 0 }
    }

    #[inline]
    fn all_categories(&self) -> u64 {
        self.category.iter().fold(0, |all, category| all | category)
    }
}

/// A child with its box: what is moved about when nodes are cut and built.
#[derive(Clone, Copy, Debug)]
struct Branch {
    aabb: Aabb,
    category: u64,
    child: u32,
}

store! {
    /// A map from small ids to boxes, with fast queries by area.
    ///
    /// Ids are the caller's: dense numbers, because a table over all ids up to the largest is kept. A
    /// box with NaN in it overlaps nothing; coordinates beyond [`LIMIT`](super::LIMIT) count as that
    /// limit.
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
        boxes: Vec<Boxes>,
        nodes: Vec<Node>,
        /// Node and lane of each id as `node * WIDTH + lane`, or `NONE`.
        places: Vec<u32>,
        root: u32,
        free: u32,
        count: usize,
        /// How much has changed since the last look at the quality, in boxes.
        changes: usize,
        /// [`size`](Self::size) after the last rebuild.
        built_size: f32,
        spare: Spare<Vec<Branch>> as derived,
    }
}

/// Memory that is filled anew where it is used, and no part of what holds it: copies have none.
#[derive(Debug, Default)]
pub(super) struct Spare<T>(pub(super) T);

impl<T: Footprint> Footprint for Spare<T> {
    fn footprint(&self) -> MemoryUse {
        self.0.footprint()
    }
}

impl<T: Default> Clone for Spare<T> {
    fn clone(&self) -> Self {
        Self::default()
    }

    fn clone_from(&mut self, _: &Self) {}
}

impl Data for Node {
    fn save(&self, sink: &mut Sink) {
        let Self { category, child, parent, lane, level, count } = self;
        parent.save(sink);
        sink.put([*lane, *level, *count]);
        let used = (0..WIDTH).fold(0, |used, k| used | u8::from(child[k] != NONE) << k);
        sink.put([used]);
        (0..WIDTH).filter(|k| used >> k & 1 != 0).for_each(|k| (child[k], category[k]).save(sink));
    }

    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        let parent = Data::load(reader)?;
        let [lane, level, count, used] = Data::load(reader)?;
        let mut node = Self { parent, lane, count, ..Self::new(level) };
        for k in (0..WIDTH).filter(|k| used >> k & 1 != 0) {
            (node.child[k], node.category[k]) = Data::load(reader)?;
        }
        Ok(node)
    }
}

/// A tree for each kind of body.
impl Data for [DynamicTree; 3] {
    fn save(&self, sink: &mut Sink) {
        self.iter().for_each(|tree| tree.save(sink));
    }

    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        Ok([Data::load(reader)?, Data::load(reader)?, Data::load(reader)?])
    }

    fn memory(&self) -> MemoryUse {
        self.iter().map(Data::memory).sum()
    }
}

impl Default for DynamicTree {
    fn default() -> Self {
        Self::new()
    }
}

impl DynamicTree {
    /// A tree with nothing in it.
    pub const fn new() -> Self {
        Self {
            boxes: Vec::new(),
            nodes: Vec::new(),
            places: Vec::new(),
            root: NONE,
            free: NONE,
            count: 0,
            changes: 0,
            built_size: 0.0,
            spare: Spare(Vec::new()),
        }
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
        self.place(id).is_some()
    }

    /// The box of an id, `None` where there is none.
    #[inline]
    pub fn get(&self, id: u32) -> Option<Aabb> {
        self.place(id).map(|(node, lane)| self.boxes[node as usize].get(lane))
    }

    /// The union of all boxes; [`Aabb::EMPTY`] without any.
    pub fn bounds(&self) -> Aabb {
        if self.root == NONE { Aabb::EMPTY } else { self.boxes[self.root as usize].union() }
    }

    /// The union of all categories.
    pub fn category(&self) -> u64 {
        if self.root == NONE { 0 } else { self.nodes[self.root as usize].all_categories() }
    }

    /// Removes all boxes; keeps the memory.
    pub fn clear(&mut self) {
        self.boxes.clear();
        self.nodes.clear();
        self.places.clear();
        (self.root, self.free, self.count) = (NONE, NONE, 0);
        (self.changes, self.built_size) = (0, 0.0);
    }

    /// Puts a box in, in place of the one that the id had before, if any.
    pub fn insert(&mut self, id: u32, aabb: Aabb, category: u64) {
        self.remove(id);
        let index = id as usize;
        if self.places.len() <= index {
            self.places.resize(index + 1, NONE);
        }
        self.count += 1;
        self.changes = self.changes.saturating_add(2);
        self.link(Branch { aabb: clamped(aabb), category, child: id });
    }

    /// Takes a box out; false where the id has none.
    pub fn remove(&mut self, id: u32) -> bool {
        let Some((node, lane)) = self.place(id) else { return false };
        self.places[id as usize] = NONE;
        self.count -= 1;
        self.unlink(node, lane);
        true
    }

    /// Gives a box that is in the tree a new place; false where the id has none.
    ///
    /// The box stays in its node, whose ancestors grow where they have to: cheap, but the tree gets
    /// worse until [`maintain`](Self::maintain).
    #[inline]
    pub fn update(&mut self, id: u32, aabb: Aabb) -> bool {
        let Some((node, lane)) = self.place(id) else { return false };
        let aabb = clamped(aabb);
        self.boxes[node as usize].set(lane, aabb);
        self.changes = self.changes.saturating_add(1);
        self.grow(node, &aabb);
        true
    }

    /// Gives a box another category; false where the id has none.
    pub fn set_category(&mut self, id: u32, category: u64) -> bool {
        let Some((node, lane)) = self.place(id) else { return false };
        self.nodes[node as usize].category[lane] = category;
        self.refit(node);
        true
    }

    /// Calls `visit` with every id whose box overlaps `aabb` (edges count) and whose category has a
    /// bit of `mask`, until it breaks. The order depends on the shape of the tree.
    #[inline]
    pub fn query(&self, aabb: &Aabb, mask: u64, mut visit: impl FnMut(u32) -> ControlFlow<()>) {
        let Some(mut node) = self.nodes.get(self.root as usize) else { return };
        let aabb = clamped(*aabb);
        let mut bits = self.overlaps(self.root, &aabb);
        if bits == 0 {
            return;
        }
        let mut stack = Stack::new();
        loop {
            while bits != 0 {
                let lane = bits.trailing_zeros() as usize % WIDTH;
                bits &= bits - 1;
                if node.category[lane] & mask == 0 {
                    continue;
                }
                if node.level > 0 {
                    stack.push(node.child[lane]);
                } else if visit(node.child[lane]).is_break() {
                    return;
                }
            }
            let Some(index) = stack.pop() else { return };
            (node, bits) = (&self.nodes[index as usize], self.overlaps(index, &aabb));
        }
    }

    /// Calls `visit` with every node of the lowest level that may have children which overlap one of some boxes and
    /// have a bit of `mask`, and with the lanes of those boxes, of the lanes asked for.
    #[inline]
    pub(super) fn walk_together(
        &self,
        boxes: &Boxes,
        lanes: u32,
        mask: u64,
        mut visit: impl FnMut(u32, u32),
    ) {
        if self.root == NONE {
            return;
        }
        if self.nodes[self.root as usize].level == 0 {
            return visit(self.root, lanes);
        }
        let bounds = boxes.union_of(lanes);
        let mut stack = Stack::new();
        let mut next = Some(self.root);
        while let Some(index) = next {
            let (node, children) = (&self.nodes[index as usize], &self.boxes[index as usize]);
            let mut bits = children.overlaps(&bounds);
            while bits != 0 {
                let lane = bits.trailing_zeros() as usize % WIDTH;
                bits &= bits - 1;
                let near = boxes.overlaps(&children.get(lane)) & lanes;
                if near == 0 || node.category[lane] & mask == 0 {
                    continue;
                }
                if node.level == 1 {
                    visit(node.child[lane], near);
                } else {
                    stack.push(node.child[lane]);
                }
            }
            next = stack.pop();
        }
    }

    /// Are these all the lanes of a node that have children?
    #[inline]
    pub(super) fn is_all(&self, index: u32, lanes: u32) -> bool {
        lanes.count_ones() == u32::from(self.nodes[index as usize].count)
    }

    /// The boxes of a node's children.
    #[inline]
    pub(super) fn boxes(&self, index: u32) -> &Boxes {
        &self.boxes[index as usize]
    }

    /// Bit `i` set where child `i` of a node overlaps the box.
    #[inline]
    pub(super) fn overlaps(&self, index: u32, aabb: &Aabb) -> u32 {
        self.boxes[index as usize].overlaps(aabb)
    }

    /// Id in a lane of a node of the lowest level.
    #[inline]
    pub(super) fn child(&self, index: u32, lane: usize) -> u32 {
        self.nodes[index as usize].child[lane]
    }

    /// Number of nodes, free ones included.
    pub(super) fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// Id and box in a lane of a node of the lowest level.
    #[inline]
    pub(super) fn leaf(&self, index: u32, lane: usize) -> (u32, Aabb) {
        (self.nodes[index as usize].child[lane], self.boxes[index as usize].get(lane))
    }

    /// Calls `visit` with the ids whose box a cast may hit, or another search may find, before a limit (of a cast a
    /// fraction), roughly the nearest first. `visit` gets the id and the current limit and returns the new one: the same
    /// to go on, the fraction of a hit to look only for nearer ones, 0 to stop.
    pub fn cast(
        &self,
        search: &impl Search,
        mut limit: f32,
        mask: u64,
        mut visit: impl FnMut(u32, f32) -> f32,
    ) {
        let mut bounds = clamped(search.bounds(limit));
        let mut stack = Stack::new();
        let mut next = (self.root != NONE).then_some(self.root);
        while let Some(index) = next {
            let node = &self.nodes[index as usize];
            let (order, count) = self.lanes_on_the_way(index, search, (&bounds, limit), mask);
            if node.level > 0 {
                // The last one pushed, the nearest, is the next one popped.
                order[..count].iter().rev().for_each(|&lane| stack.push(node.child[lane]));
                next = stack.pop();
                continue;
            }
            for &lane in &order[..count] {
                if !self.boxes[index as usize].get(lane).overlaps(&bounds) {
                    continue;
                }
                let fraction = visit(node.child[lane], limit);
                if fraction <= 0.0 {
                    return;
                }
                if fraction < limit {
                    limit = fraction;
                    bounds = clamped(search.bounds(limit));
                }
            }
            next = stack.pop();
        }
    }

    /// Longest way from the root to a leaf, in nodes; 0 for an empty tree.
    pub fn height(&self) -> u32 {
        if self.root == NONE { 0 } else { u32::from(self.nodes[self.root as usize].level) + 1 }
    }

    /// Perimeters of all inner nodes over the perimeter of the root: about how many nodes a query
    /// of random place looks at. Lower is better.
    pub fn area_ratio(&self) -> f32 {
        let root = self.bounds().perimeter();
        if self.root == NONE || root <= 0.0 || root.is_nan() {
            return 0.0;
        }
        self.cost() * self.count as f32 / root
    }

    /// Node and lane of an id.
    #[inline]
    pub(super) fn place(&self, id: u32) -> Option<(u32, usize)> {
        let place = *self.places.get(id as usize)?;
        (place != NONE).then_some((place / WIDTH as u32, place as usize % WIDTH))
    }

    #[inline]
    fn branch(&self, node: u32, lane: usize) -> Branch {
        let Node { category, child, .. } = &self.nodes[node as usize];
        let aabb = self.boxes[node as usize].get(lane);
        Branch { aabb, category: category[lane], child: child[lane] }
    }

    fn allocate(&mut self, level: u8) -> u32 {
        if self.free == NONE {
            self.boxes.push(Boxes::EMPTY);
            self.nodes.push(Node::new(level));
            return self.nodes.len() as u32 - 1;
        }
        let index = self.free;
        self.free = self.nodes[index as usize].parent;
        self.boxes[index as usize] = Boxes::EMPTY;
        self.nodes[index as usize] = Node::new(level);
        index
    }

    fn release(&mut self, index: u32) {
        self.nodes[index as usize].parent = self.free;
        self.free = index;
    }

    /// Puts a branch in a lane and tells the child.
    #[inline]
    fn put(&mut self, index: u32, lane: usize, branch: Branch) {
        let node = &mut self.nodes[index as usize];
        node.child[lane] = branch.child;
        node.category[lane] = branch.category;
        let level = node.level;
        self.boxes[index as usize].set(lane, branch.aabb);
        if level == 0 {
            self.places[branch.child as usize] = index * WIDTH as u32 + lane as u32;
        } else {
            let child = &mut self.nodes[branch.child as usize];
            (child.parent, child.lane) = (index, lane as u8);
        }
    }

    /// The branch of a whole node.
    #[inline]
    fn summary(&self, index: u32) -> Branch {
        Branch {
            aabb: self.boxes[index as usize].union(),
            category: self.nodes[index as usize].all_categories(),
            child: index,
        }
    }

    /// Puts a leaf into the best node of level 0.
    fn link(&mut self, branch: Branch) {
        if self.root == NONE {
            self.root = self.allocate(0);
        }
        let mut index = self.root;
        while self.nodes[index as usize].level > 0 {
            let lane = self.best_lane(index, branch.aabb);
            index = self.nodes[index as usize].child[lane];
        }
        self.add(index, branch);
    }

    /// The lane that grows least, the smallest of those that grow the same.
    #[inline]
    fn best_lane(&self, index: u32, aabb: Aabb) -> usize {
        let (node, boxes) = (&self.nodes[index as usize], &self.boxes[index as usize]);
        let mut best = (f32::INFINITY, f32::INFINITY, 0);
        let mut found = false;
        for lane in 0..WIDTH {
            if node.child[lane] == NONE {
                continue;
            }
            let perimeter = boxes.get(lane).perimeter();
            let growth = boxes.get(lane).union(&aabb).perimeter() - perimeter;
            if !found || growth < best.0 || (growth == best.0 && perimeter < best.1) {
                best = (growth, perimeter, lane);
                found = true;
            }
        }
        best.2
    }

    /// Adds a branch to a node, cutting it and its ancestors in two where they are full.
    fn add(&mut self, mut index: u32, mut branch: Branch) {
        loop {
            let node = &mut self.nodes[index as usize];
            if (node.count as usize) < WIDTH {
                node.count += 1;
                let lane = node.child.iter().position(|&child| child == NONE).unwrap_or(0);
                self.put(index, lane, branch);
                self.refit(index);
                return;
            }
            branch = self.split(index, branch);
            let parent = self.nodes[index as usize].parent;
            if parent == NONE {
                let level = self.nodes[index as usize].level + 1;
                let root = self.allocate(level);
                self.nodes[root as usize].count = 2;
                self.put(root, 0, self.summary(index));
                self.put(root, 1, branch);
                self.root = root;
                return;
            }
            let lane = self.nodes[index as usize].lane as usize;
            self.put(parent, lane, self.summary(index));
            index = parent;
        }
    }

    /// Shares the children of a full node and one more between it and a new node; gives the new
    /// one.
    fn split(&mut self, index: u32, extra: Branch) -> Branch {
        let mut all = [extra; WIDTH + 1];
        for (lane, branch) in all[..WIDTH].iter_mut().enumerate() {
            *branch = self.branch(index, lane);
        }
        let cut = build::best_cut(&mut all);
        let Node { level, parent, lane, .. } = self.nodes[index as usize];
        self.boxes[index as usize] = Boxes::EMPTY;
        self.nodes[index as usize] = Node { parent, lane, ..Node::new(level) };
        let other = self.allocate(level);
        self.fill(index, &all[..cut]);
        self.fill(other, &all[cut..]);
        self.summary(other)
    }

    fn fill(&mut self, index: u32, branches: &[Branch]) {
        for (lane, branch) in branches.iter().enumerate() {
            self.put(index, lane, *branch);
        }
        self.nodes[index as usize].count = branches.len() as u8;
    }

    /// Takes a lane off; nodes that get empty go.
    fn unlink(&mut self, mut index: u32, mut lane: usize) {
        loop {
            let node = &mut self.nodes[index as usize];
            node.child[lane] = NONE;
            node.category[lane] = 0;
            node.count -= 1;
            let (count, parent, up) = (node.count, node.parent, node.lane as usize);
            self.boxes[index as usize].set(lane, Aabb::EMPTY);
            if count > 0 {
                self.refit(index);
                return;
            }
            self.release(index);
            if parent == NONE {
                self.root = NONE;
                return;
            }
            (index, lane) = (parent, up);
        }
    }

    /// Makes the ancestors of a node hold a new box.
    #[inline]
    fn grow(&mut self, mut index: u32, aabb: &Aabb) {
        loop {
            let Node { parent, lane, .. } = self.nodes[index as usize];
            if parent == NONE {
                return;
            }
            let boxes = &mut self.boxes[parent as usize];
            let now = boxes.get(lane as usize);
            if now.contains(aabb) {
                return;
            }
            boxes.set(lane as usize, now.union(aabb));
            index = parent;
        }
    }

    /// Tells the ancestors of a node how large it is now, no larger; stops where nothing changes.
    #[inline]
    pub(super) fn refit(&mut self, mut index: u32) {
        loop {
            let Node { parent, lane, .. } = self.nodes[index as usize];
            if parent == NONE {
                return;
            }
            let (lane, summary) = (lane as usize, self.summary(index));
            let category = &mut self.nodes[parent as usize].category[lane];
            let boxes = &mut self.boxes[parent as usize];
            if boxes.get(lane) == summary.aabb && *category == summary.category {
                return;
            }
            *category = summary.category;
            boxes.set(lane, summary.aabb);
            index = parent;
        }
    }

    /// Lanes in which a search may find something, the nearest first.
    #[inline]
    fn lanes_on_the_way(
        &self,
        index: u32,
        search: &impl Search,
        (bounds, limit): (&Aabb, f32),
        mask: u64,
    ) -> ([usize; WIDTH], usize) {
        let (node, boxes) = (&self.nodes[index as usize], &self.boxes[index as usize]);
        let (mut order, mut keys, mut count) = ([0; WIDTH], [0.0; WIDTH], 0);
        let mut bits = boxes.overlaps(bounds);
        while bits != 0 {
            let lane = bits.trailing_zeros() as usize % WIDTH;
            bits &= bits - 1;
            let aabb = boxes.get(lane);
            if node.category[lane] & mask == 0 {
                continue;
            }
            let Some(key) = search.order(&aabb, limit) else { continue };
            let mut at = count;
            while at > 0 && key < keys[at - 1] {
                (keys[at], order[at]) = (keys[at - 1], order[at - 1]);
                at -= 1;
            }
            (keys[at], order[at]) = (key, lane);
            count += 1;
        }
        (order, count)
    }
}
