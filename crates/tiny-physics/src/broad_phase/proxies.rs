//! Proxies of shapes, and the pairs of them that came close.

use super::{BoxCast, DynamicTree};
use crate::math::{Aabb, Vec2};
use core::ops::{ControlFlow, Range};

/// The leaf of a shape in the broad phase.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct ProxyId(pub u32);

impl ProxyId {
    /// No proxy.
    pub const NONE: Self = Self(u32::MAX);
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

/// What a query looks at for each hit; 32 bytes.
#[derive(Clone, Copy, Debug)]
struct Proxy {
    category: u64,
    mask: u64,
    user: u32,
    margin: f32,
    /// `None` for a free entry.
    kind: Option<ProxyKind>,
    /// Is it in the buffer?
    moved: bool,
}

const _: () = assert!(size_of::<Proxy>() == 32);

/// Proxies of all shapes, and which of them have to look for new partners.
///
/// A proxy's *fat box* is its tight box and a margin. While the tight box stays inside, nothing
/// happens; when it leaves, the fat box is made anew and the proxy goes into the buffer of moved ones.
/// [`BroadPhase::update_pairs`] asks for the partners of the moved ones alone, so what rests costs nothing.
///
/// Pairs are of the callers' `user` numbers, smaller first, sorted, each once: the same whatever the shape of
/// the trees and however many threads asked.
#[derive(Clone, Debug, Default)]
pub struct BroadPhase {
    proxies: Vec<Proxy>,
    free: Vec<u32>,
    moved: Vec<ProxyId>,
    /// By [`ProxyKind`].
    trees: [DynamicTree; 3],
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
        let mut proxy = Proxy { category, mask, user, margin, kind: Some(kind), moved: false };
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

    /// Removes a proxy; false where there is none. Its id may be given to a later one. In the buffer its
    /// entry stays behind until the next update, and is passed over (or serves the later one).
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
        self.buffer(id);
        true
    }

    /// Tells where a proxy is now. True where it left its fat box and was buffered.
    pub fn move_proxy(&mut self, id: ProxyId, tight: Aabb, displacement: Vec2) -> bool {
        match self.needed_fat_aabb(id, tight, displacement) {
            Some(fat) => self.set_fat_aabb(id, fat),
            None => false,
        }
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

    /// Makes the next update look for all partners of a proxy, though it has not moved.
    pub fn buffer(&mut self, id: ProxyId) {
        if self.kind(id).is_some() && !self.proxies[id.0 as usize].moved {
            self.proxies[id.0 as usize].moved = true;
            self.moved.push(id);
        }
    }

    /// The buffered proxies; some may be gone since.
    pub fn moved(&self) -> &[ProxyId] {
        &self.moved
    }

    /// Adds the pairs of a range of [`BroadPhase::moved`] to `out`, unsorted. A pair of two moved
    /// proxies is found by one of the two alone, so disjoint ranges give disjoint pairs. `accept` can turn
    /// a pair down early (it gets the `user` numbers, smaller first): what it turns down need not be sorted.
    pub fn query_moved(
        &self,
        range: Range<usize>,
        mut accept: impl FnMut(u32, u32) -> bool,
        out: &mut Vec<(u32, u32)>,
    ) {
        for &id in self.moved.get(range).unwrap_or_default() {
            let proxy = &self.proxies[id.0 as usize];
            let (Some(kind), Some(aabb)) = (proxy.kind, self.fat_aabb(id)) else { continue };
            for &partner in kind.partners() {
                self.trees[partner as usize].query(&aabb, proxy.mask, |other_id| {
                    let other = &self.proxies[other_id as usize];
                    let mine = other_id > id.0 || (other_id != id.0 && !other.moved);
                    if mine && other.mask & proxy.category != 0 {
                        let pair = ordered(proxy.user, other.user);
                        if accept(pair.0, pair.1) {
                            out.push(pair);
                        }
                    }
                    ControlFlow::Continue(())
                });
            }
        }
    }

    /// Forgets which proxies moved. Call it after all ranges have been queried.
    pub fn clear_moved(&mut self) {
        for id in self.moved.drain(..) {
            self.proxies[id.0 as usize].moved = false;
        }
    }

    /// All pairs of the moved proxies into `out` (its old contents are dropped), sorted; then forgets which moved.
    pub fn update_pairs(&mut self, out: &mut Vec<(u32, u32)>) {
        out.clear();
        self.maintain();
        self.query_moved(0..self.moved.len(), |_, _| true, out);
        sort_pairs(out);
        self.clear_moved();
    }

    /// Keeps the trees good after many moves. Call it before the queries of a step; it changes no result.
    pub fn maintain(&mut self) {}

    /// Calls `visit` with the `user` number of every proxy of any kind whose fat box overlaps `aabb` and whose
    /// category has a bit of `mask`, until it breaks.
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

    /// Calls `visit` with the `user` numbers of proxies whose fat box the cast may hit before the limit; see
    /// [`DynamicTree::cast`].
    pub fn cast(
        &self,
        cast: &BoxCast,
        max_fraction: f32,
        mask: u64,
        mut visit: impl FnMut(u32, f32) -> f32,
    ) {
        let mut limit = max_fraction;
        for tree in &self.trees {
            tree.cast(cast, limit, mask, |id, current| {
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

    /// Checks every invariant. For tests.
    ///
    /// # Errors
    ///
    /// Says what is wrong.
    pub fn validate(&self) -> Result<(), String> {
        for tree in &self.trees {
            tree.validate()?;
        }
        let mut counts = [0; 3];
        for (index, proxy) in self.proxies.iter().enumerate() {
            let buffered = self.moved.iter().filter(|id| id.0 as usize == index).count();
            if buffered != usize::from(proxy.moved) {
                return Err(format!("proxy {index} is {buffered} times in the buffer"));
            }
            let Some(kind) = proxy.kind else { continue };
            counts[kind as usize] += 1;
            if !self.trees[kind as usize].contains(index as u32) {
                return Err(format!("proxy {index} is not in its tree"));
            }
        }
        if counts != [0, 1, 2].map(|kind| self.trees[kind].len()) {
            return Err(format!("{counts:?} proxies, but the trees have others"));
        }
        Ok(())
    }
}

#[inline]
fn ordered(a: u32, b: u32) -> (u32, u32) {
    if a < b { (a, b) } else { (b, a) }
}

/// Sorts pairs and drops repeated ones: the last step after ranges were queried by several threads.
pub fn sort_pairs(pairs: &mut Vec<(u32, u32)>) {
    pairs.sort_unstable_by_key(|&(a, b)| u64::from(a) << 32 | u64::from(b));
    pairs.dedup();
}
