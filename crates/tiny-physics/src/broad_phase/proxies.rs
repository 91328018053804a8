//! Proxies of shapes, and the pairs of them that came close.
//!
//! In a step: every shape that moved asks for the fat box that it needs ([`BroadPhase::needed_fat_aabb`]), then the
//! pairs of those that left their fat boxes are asked for ([`BroadPhase::prepare_pairs`],
//! [`BroadPhase::query_groups`] on any number of threads, [`BroadPhase::clear_moved`]).
//!
//! Invariants: a proxy is in the tree of its kind under its own number; it is flagged as moved
//! exactly when it is in the buffer; nodes hold the fat boxes below them.

use super::node_boxes::{Boxes, WIDTH};
use super::tree::Spare;
use super::{DynamicTree, Search, clamped, sort_pairs};
use crate::codec::{Data, Reader, Sink, bad, data_enum, record, store};
use crate::error::Error;
use crate::math::{Aabb, Vec2};
use crate::threads::{SharedSlice, Team};
use core::ops::{ControlFlow, Range};

/// Moved proxies that one member of a team forgets at a time.
const MOVED_CHUNK: usize = 1024;

/// The leaf of a shape in the broad phase.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct ProxyId(pub u32);

impl ProxyId {
    /// No proxy.
    pub const NONE: Self = Self(u32::MAX);
}

impl Data for ProxyId {
    fn save(&self, sink: &mut Sink) {
        self.0.save(sink);
    }
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        Data::load(reader).map(Self)
    }
}

/// The kind of body that a proxy belongs to. Pairs need at least one dynamic proxy.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u8)]
pub enum ProxyKind {
    /// Never moves by itself.
    Static,
    /// Moves as it is told.
    Kinematic,
    /// Moved by forces and contacts.
    Dynamic,
}

impl ProxyKind {
    /// Kinds that can pair with this one.
    #[inline]
    fn partners(self) -> &'static [Self] {
        match self {
            Self::Static | Self::Kinematic => &[Self::Dynamic],
            Self::Dynamic => &[Self::Dynamic, Self::Static, Self::Kinematic],
        }
    }
}

/// What a proxy is.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ProxyDef {
    /// Which tree it lives in.
    pub kind: ProxyKind,
    /// What it is, as bits.
    pub category: u64,
    /// What it pairs with, as bits of the other's category; both ways must agree.
    pub mask: u64,
    /// The caller's name for it; pairs are made of these.
    pub user: u32,
    /// Room around the tight box in the fat box, metres.
    pub margin: f32,
}

record! {
    /// What a query looks at for each hit: a cache line.
    #[derive(Clone, Copy, Debug)]
    #[repr(C, align(64))]
    struct Proxy {
        category: u64,
        mask: u64,
        user: u32,
        margin: f32,
        /// The fat box with which partners were last asked for; [`Aabb::EMPTY`] to ask for all anew.
        asked: Aabb,
        /// `None` for a free entry.
        kind: Option<ProxyKind>,
        /// Is it in the buffer?
        moved: bool,
    }
}

const _: () = assert!(size_of::<Proxy>() == 64);

data_enum!(ProxyKind { 0 => Static, 1 => Kinematic, 2 => Dynamic });

/// A node with moved proxies: they are near each other and go down the trees together.
struct Group {
    kind: ProxyKind,
    node: u32,
    /// The lanes that moved.
    moved: u32,
    /// What any of those pairs with.
    mask: u64,
}

store! {
    /// Proxies of all shapes, and which of them have to look for new partners.
    ///
    /// A proxy's *fat box* is its tight box and a margin. While the tight box stays inside, nothing
    /// happens; when it leaves, the fat box is made anew and the proxy goes into the buffer of moved
    /// ones. [`BroadPhase::update_pairs`] asks for the partners of the moved ones alone, so what rests
    /// costs nothing; and a pair whose boxes overlapped when they were last asked for is not given again.
    ///
    /// Pairs are of the callers' `user` numbers, smaller first, sorted, each once: the same whatever
    /// the shape of the trees and however many threads asked.
    #[derive(Debug, Default)]
    pub struct BroadPhase {
        proxies: Vec<Proxy>,
        free: Vec<u32>,
        moved: Vec<ProxyId>,
        /// Tree and node of the moved proxies, while pairs are asked for.
        groups: Vec<(ProxyKind, u32)> as derived,
        /// For each node, which children moved.
        marks: [Vec<u8>; 3] as derived,
        /// For each node of which some moved, the boxes with which its children last asked.
        asked: Spare<[Vec<Boxes>; 3]> as derived,
        /// By [`ProxyKind`].
        trees: [DynamicTree; 3],
    }
    load with BroadPhase::check_loaded
}

impl BroadPhase {
    /// Without proxies.
    pub fn new() -> Self {
        Self::default()
    }

    /// Number of proxies.
    pub fn len(&self) -> usize {
        self.proxies.len() - self.free.len()
    }

    /// Is there no proxy?
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The tree of all proxies of a kind; its ids are those of the proxies.
    pub fn tree(&self, kind: ProxyKind) -> &DynamicTree {
        &self.trees[kind as usize]
    }

    /// Adds a proxy around the tight box; it is buffered.
    pub fn create_proxy(&mut self, def: ProxyDef, tight: Aabb) -> ProxyId {
        let ProxyDef { kind, category, mask, user, margin } = def;
        let asked = Aabb::EMPTY;
        let mut proxy =
            Proxy { category, mask, user, margin, asked, kind: Some(kind), moved: false };
        let index = self.free.pop().unwrap_or(self.proxies.len() as u32);
        match self.proxies.get_mut(index as usize) {
            Some(entry) => {
                proxy.moved = entry.moved;
                *entry = proxy;
            }
            None => self.proxies.push(proxy),
        }
        let id = ProxyId(index);
        self.trees[kind as usize].insert(index, tight.grown(margin), category);
        self.buffer(id);
        id
    }

    /// Removes a proxy; false where there is none. Its id may be given to a later one. In the
    /// buffer its entry stays behind until the next update, and is passed over (or serves the later
    /// one).
    pub fn destroy_proxy(&mut self, id: ProxyId) -> bool {
        let Some(kind) = self.kind(id) else { return false };
        self.trees[kind as usize].remove(id.0);
        self.proxies[id.0 as usize].kind = None;
        self.free.push(id.0);
        true
    }

    /// The kind of a proxy, `None` where there is none.
    pub fn kind(&self, id: ProxyId) -> Option<ProxyKind> {
        self.proxies.get(id.0 as usize)?.kind
    }

    /// The caller's name for a proxy.
    pub fn user(&self, id: ProxyId) -> Option<u32> {
        self.kind(id).map(|_| self.proxies[id.0 as usize].user)
    }

    /// The fat box of a proxy.
    #[inline]
    pub fn fat_aabb(&self, id: ProxyId) -> Option<Aabb> {
        let kind = self.proxies.get(id.0 as usize)?.kind?;
        self.trees[kind as usize].get(id.0)
    }

    /// Is this the fat box of a proxy, as far as the limits of coordinates let it be?
    pub(crate) fn has_box(&self, id: ProxyId, fat: Aabb) -> bool {
        self.fat_aabb(id) == Some(clamped(fat))
    }

    /// The fat box that a proxy needs for this tight box: `None` while the one it has is enough.
    /// `displacement` is the motion that is expected soon, metres: the box reaches as far ahead.
    ///
    /// Takes `&self`, so that several threads can ask; then [`BroadPhase::set_fat_aabb`].
    #[inline]
    pub fn needed_fat_aabb(&self, id: ProxyId, tight: Aabb, displacement: Vec2) -> Option<Aabb> {
        let fat = self.fat_aabb(id)?;
        if fat.contains(&tight) {
            return None;
        }
        let fat = tight.grown(self.proxies[id.0 as usize].margin);
        let (back, ahead) = (displacement.min(Vec2::ZERO), displacement.max(Vec2::ZERO));
        Some(Aabb::new(fat.min + back, fat.max + ahead))
    }

    /// Gives a proxy a fat box as it is, and buffers it. False where there is no such proxy.
    pub fn set_fat_aabb(&mut self, id: ProxyId, fat: Aabb) -> bool {
        let Some(kind) = self.kind(id) else { return false };
        self.trees[kind as usize].update(id.0, fat);
        self.note_moved(id);
        true
    }

    /// Changes what a proxy is and pairs with, and buffers it. False where there is no such proxy.
    pub fn set_filter(&mut self, id: ProxyId, category: u64, mask: u64) -> bool {
        let Some(kind) = self.kind(id) else { return false };
        self.trees[kind as usize].set_category(id.0, category);
        let proxy = &mut self.proxies[id.0 as usize];
        (proxy.category, proxy.mask) = (category, mask);
        self.buffer(id);
        true
    }

    /// Makes the next update look for all partners of a proxy, those that it had included.
    pub fn buffer(&mut self, id: ProxyId) {
        if self.kind(id).is_some() {
            self.proxies[id.0 as usize].asked = Aabb::EMPTY;
            self.note_moved(id);
        }
    }

    /// Puts a proxy into the buffer.
    #[inline]
    fn note_moved(&mut self, id: ProxyId) {
        if !core::mem::replace(&mut self.proxies[id.0 as usize].moved, true) {
            self.moved.push(id);
        }
    }

    /// Does the next update give all partners of a proxy, not only those that came since the last one?
    #[inline]
    pub fn asks_anew(&self, id: ProxyId) -> bool {
        self.proxies.get(id.0 as usize).is_some_and(|proxy| proxy.asked == Aabb::EMPTY)
    }

    /// The buffered proxies; some may be gone since.
    pub fn moved(&self) -> &[ProxyId] {
        &self.moved
    }

    /// Gets ready for [`BroadPhase::query_groups`] and returns the number of groups: moved proxies
    /// that are near each other ask together. It also keeps the trees good.
    pub fn prepare_pairs(&mut self) -> usize {
        for (tree, (marks, asked)) in
            self.trees.iter_mut().zip(self.marks.iter_mut().zip(&mut self.asked.0))
        {
            tree.maintain();
            marks.clear();
            marks.resize(tree.node_count(), 0);
            asked.resize(tree.node_count(), Boxes::EMPTY);
        }
        self.groups.clear();
        for &id in &self.moved {
            let Proxy { kind: Some(kind), asked, .. } = self.proxies[id.0 as usize] else {
                continue;
            };
            let tree = &self.trees[kind as usize];
            let Some((node, lane)) = tree.place(id.0) else { continue };
            let mark = &mut self.marks[kind as usize][node as usize];
            let boxes = &mut self.asked.0[kind as usize][node as usize];
            if *mark == 0 {
                self.groups.push((kind, node));
                *boxes = *tree.boxes(node);
            }
            *mark |= 1 << lane;
            boxes.set(lane, asked);
        }
        // Near in the tree is near in memory: a quarter less for refitting 300,000 boxes, nothing
        // lost on few.
        self.groups.sort_unstable_by_key(|&(kind, node)| (kind as u8, node));
        for &(kind, node) in &self.groups {
            self.trees[kind as usize].refit(node);
        }
        self.groups.len()
    }

    /// Adds the new pairs of a range of groups to `out`, unsorted. A pair of two moved proxies is found
    /// by one of the two alone, so disjoint ranges give disjoint pairs. `accept` can turn a pair
    /// down early (it gets the `user` numbers, smaller first): what it turns down need not be
    /// sorted.
    ///
    /// For several threads: [`prepare_pairs`](Self::prepare_pairs) gives the number of groups; cut
    /// that into ranges in any way, join the lists, [`sort_pairs`],
    /// [`clear_moved`](Self::clear_moved). Nothing else may change in between.
    pub fn query_groups(
        &self,
        range: Range<usize>,
        mut accept: impl FnMut(u32, u32) -> bool,
        out: &mut Vec<(u32, u32)>,
    ) {
        for &(kind, node) in self.groups.get(range).unwrap_or_default() {
            let group = self.group(kind, node);
            let mut report = |a: &Proxy, b: &Proxy| {
                let pair = ordered(a.user, b.user);
                if accept(pair.0, pair.1) {
                    out.push(pair);
                }
            };
            for &partner in kind.partners() {
                let boxes = self.tree(kind).boxes(node);
                let tree = self.tree(partner);
                tree.walk_together(boxes, group.moved, group.mask, |other, members| {
                    self.meet(&group, members, (partner, other), &mut report);
                });
            }
        }
    }

    /// Reports the children of a node that some members of a group have come to overlap, if it is for the group to do
    /// so. Most boxes that overlap did so when they last asked: that is seen side by side.
    #[inline]
    fn meet(
        &self,
        group: &Group,
        mut members: u32,
        (kind, node): (ProxyKind, u32),
        report: &mut impl FnMut(&Proxy, &Proxy),
    ) {
        let (own_tree, tree) = (self.tree(group.kind), self.tree(kind));
        let moved = u32::from(self.marks[kind as usize][node as usize]);
        let is_itself = kind == group.kind && node == group.node;
        let is_later = group.kind as u8 > kind as u8 || group.kind == kind && node > group.node;
        if !is_itself && !is_later && tree.is_all(node, moved) {
            return;
        }
        let (own, boxes) = (own_tree.boxes(group.node), tree.boxes(node));
        let own_asked = &self.asked.0[group.kind as usize][group.node as usize];
        let asked = if moved == 0 { boxes } else { &self.asked.0[kind as usize][node as usize] };
        while members != 0 {
            let lane = members.trailing_zeros() as usize % WIDTH;
            members &= members - 1;
            // Of two that moved the earlier one reports the later one.
            let found = if is_later { u32::MAX } else { !moved };
            let found = if is_itself { found | u32::MAX << 1 << lane } else { found };
            let mut bits = boxes.overlaps(&own.get(lane)) & found;
            bits &= !asked.overlaps(&own_asked.get(lane));
            while bits != 0 {
                let other = tree.child(node, bits.trailing_zeros() as usize % WIDTH);
                bits &= bits - 1;
                let pair = [own_tree.child(group.node, lane), other];
                let [a, b] = pair.map(|id| &self.proxies[id as usize]);
                if a.mask & b.category != 0 && b.mask & a.category != 0 {
                    report(a, b);
                }
            }
        }
    }

    #[inline]
    fn group(&self, kind: ProxyKind, node: u32) -> Group {
        let moved = u32::from(self.marks[kind as usize][node as usize]);
        let lanes = (0..WIDTH).filter(|lane| moved >> lane & 1 != 0);
        let ids = lanes.map(|lane| self.tree(kind).child(node, lane));
        let mask = ids.fold(0, |mask, id| mask | self.proxies[id as usize].mask);
        Group { kind, node, moved, mask }
    }

    /// Forgets which proxies moved. Call it after all groups have been queried.
    pub fn clear_moved(&mut self) {
        self.forget_moved(&Team::alone());
    }

    /// The same by all members of a team.
    pub(crate) fn forget_moved(&mut self, team: &Team) {
        let Self { proxies, moved, trees, .. } = self;
        let proxies = SharedSlice::new(proxies);
        team.for_each_chunk(moved.len(), MOVED_CHUNK, |range| {
            for id in &moved[range] {
                proxies.update(id.0, |proxy| {
                    let tree = proxy.kind.map(|kind| &trees[kind as usize]);
                    proxy.asked = tree.and_then(|tree| tree.get(id.0)).unwrap_or(Aabb::EMPTY);
                    proxy.moved = false;
                });
            }
        });
        moved.clear();
        self.groups.clear();
    }

    /// All new pairs of the moved proxies into `out` (its old contents are dropped), sorted; then
    /// forgets which moved.
    pub fn update_pairs(&mut self, out: &mut Vec<(u32, u32)>) {
        out.clear();
        let count = self.prepare_pairs();
        self.query_groups(0..count, |_, _| true, out);
        sort_pairs(out);
        self.clear_moved();
    }

    /// Calls `visit` with the `user` number of every proxy of any kind whose fat box overlaps
    /// `aabb` and whose category has a bit of `mask`, until it breaks.
    pub fn query(&self, aabb: &Aabb, mask: u64, mut visit: impl FnMut(u32) -> ControlFlow<()>) {
        let mut flow = ControlFlow::Continue(());
        for tree in &self.trees {
            if flow.is_continue() {
                tree.query(aabb, mask, |id| {
                    flow = visit(self.proxies[id as usize].user);
                    flow
                });
            }
        }
    }

    /// Is there any proxy of one kind?
    pub(crate) fn has_any(&self, kind: ProxyKind) -> bool {
        !self.trees[kind as usize].is_empty()
    }

    /// Visits the users of the proxies of one kind whose fat boxes overlap `aabb` and whose category has a bit of `mask`,
    /// in no fixed order.
    #[inline]
    pub(crate) fn each_of(
        &self,
        kind: ProxyKind,
        aabb: &Aabb,
        mask: u64,
        mut visit: impl FnMut(u32),
    ) {
        self.trees[kind as usize].query(aabb, mask, |id| {
            visit(self.proxies[id as usize].user);
            ControlFlow::Continue(())
        });
    }

    /// Calls `visit` with the `user` numbers of proxies whose fat box a cast or another search may find before a limit;
    /// see [`DynamicTree::cast`].
    pub fn cast(
        &self,
        search: &impl Search,
        mut limit: f32,
        mask: u64,
        mut visit: impl FnMut(u32, f32) -> f32,
    ) {
        for tree in &self.trees {
            tree.cast(search, limit, mask, |id, current| {
                let fraction = visit(self.proxies[id as usize].user, current);
                if fraction < limit {
                    limit = fraction;
                }
                fraction
            });
            if limit <= 0.0 {
                return;
            }
        }
    }

    /// Calls `visit` with the `user` numbers of every two proxies whose fat boxes overlap, the smaller first, once;
    /// but not of two that are static or kinematic.
    pub(crate) fn each_overlap(&self, mut visit: impl FnMut(u32, u32)) {
        let dynamic = self.tree(ProxyKind::Dynamic);
        for &kind in ProxyKind::Dynamic.partners() {
            dynamic.join(self.tree(kind), |a, b| {
                let (a, b) = ordered(self.proxies[a as usize].user, self.proxies[b as usize].user);
                visit(a, b);
            });
        }
    }

    /// Does [`BroadPhase::each_overlap`] visit these two proxies, which have these fat boxes?
    pub(crate) fn would_pair(&self, a: (ProxyId, Aabb), b: (ProxyId, Aabb)) -> bool {
        let dynamic = ProxyKind::Dynamic;
        let pairs = match (self.kind(a.0), self.kind(b.0)) {
            (Some(kind_a), Some(kind_b)) => kind_a == dynamic || kind_b == dynamic,
            _ => false,
        };
        pairs && clamped(a.1).overlaps(&clamped(b.1))
    }

    /// Refuses what was read where it is no broad phase.
    fn check_loaded(&mut self) -> Result<(), Error> {
        self.check().map_err(bad)
    }

    /// Checks every invariant. For tests.
    ///
    /// # Errors
    ///
    /// Says what is wrong.
    pub fn validate(&self) -> Result<(), String> {
        self.check().map_err(|what| {
            // Trees tell more by themselves.
            let told = self.trees.iter().find_map(|tree| tree.validate().err());
            told.unwrap_or(what.into())
        })
    }

    /// Nothing leads out of the lists, and each proxy is where it should be.
    fn check(&self) -> Result<(), &'static str> {
        let mut seen = vec![false; self.proxies.len()];
        for &id in &self.free {
            match (self.proxies.get(id as usize), seen.get_mut(id as usize)) {
                (Some(proxy), Some(seen)) if proxy.kind.is_none() && !*seen => *seen = true,
                _ => return Err("the free proxies are not"),
            }
        }
        let alive = |kind: ProxyKind| self.proxies.iter().filter(|p| p.kind == Some(kind)).count();
        let kinds = [ProxyKind::Static, ProxyKind::Kinematic, ProxyKind::Dynamic];
        if self.free.len() + kinds.iter().map(|&kind| alive(kind)).sum::<usize>() != seen.len() {
            return Err("proxies are neither used nor free");
        }
        for (kind, tree) in kinds.into_iter().zip(&self.trees) {
            tree.check_loaded()?;
            let in_tree =
                |(id, proxy): (usize, &Proxy)| proxy.kind != Some(kind) || tree.contains(id as u32);
            if tree.len() != alive(kind) || !self.proxies.iter().enumerate().all(in_tree) {
                return Err("a tree holds other proxies than there are");
            }
        }
        let mut buffered = vec![false; self.proxies.len()];
        for id in &self.moved {
            match buffered.get_mut(id.0 as usize) {
                Some(buffered) if !*buffered => *buffered = true,
                _ => return Err("the moved proxies are wrong"),
            }
        }
        if self.proxies.iter().zip(&buffered).any(|(proxy, &buffered)| proxy.moved != buffered) {
            return Err("the moved proxies are not those that are marked");
        }
        Ok(())
    }
}

#[inline]
fn ordered(a: u32, b: u32) -> (u32, u32) {
    if a < b { (a, b) } else { (b, a) }
}
