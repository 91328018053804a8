//! The boxes of a node's children, side by side, so that all are tested at once.

use crate::codec::{Data, Reader, Sink};
use crate::error::Error;
use crate::math::{Aabb, Vec2};
use fearless_simd::{Level, Simd, SimdBase, SimdMask, f32x8};

/// Children of a node.
pub(super) const WIDTH: usize = 8;

/// The boxes of a node's children; lanes without a child are [`Aabb::EMPTY`].
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Boxes {
    min_x: [f32; WIDTH],
    min_y: [f32; WIDTH],
    max_x: [f32; WIDTH],
    max_y: [f32; WIDTH],
}

/// The lanes that have a child.
impl Data for Boxes {
    fn save(&self, sink: &mut Sink) {
        let is_used = |&lane: &usize| self.get(lane) != Aabb::EMPTY;
        sink.put([(0..WIDTH).filter(is_used).fold(0, |used: u8, lane| used | 1 << lane)]);
        (0..WIDTH).filter(is_used).for_each(|lane| self.get(lane).save(sink));
    }

    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        let (used, mut boxes) = (u8::load(reader)?, Self::EMPTY);
        for lane in (0..WIDTH).filter(|lane| used >> lane & 1 != 0) {
            boxes.set(lane, Data::load(reader)?);
        }
        Ok(boxes)
    }
}

const _: () = assert!(size_of::<Boxes>() == 128);

impl Boxes {
    /// No child in any lane.
    pub(super) const EMPTY: Self = Self {
        min_x: [f32::INFINITY; WIDTH],
        min_y: [f32::INFINITY; WIDTH],
        max_x: [f32::NEG_INFINITY; WIDTH],
        max_y: [f32::NEG_INFINITY; WIDTH],
    };

    /// The box of a lane.
    #[inline]
    pub(super) fn get(&self, lane: usize) -> Aabb {
        Aabb::new(
            Vec2::new(self.min_x[lane], self.min_y[lane]),
            Vec2::new(self.max_x[lane], self.max_y[lane]),
        )
    }

    /// Gives a lane a box.
    #[inline]
    pub(super) fn set(&mut self, lane: usize, aabb: Aabb) {
        (self.min_x[lane], self.min_y[lane]) = (aabb.min.x, aabb.min.y);
        (self.max_x[lane], self.max_y[lane]) = (aabb.max.x, aabb.max.y);
    }

    /// Bit `i` set where lane `i` overlaps the box.
    #[inline]
    pub(super) fn overlaps(&self, aabb: &Aabb) -> u32 {
        fearless_simd::dispatch!(Level::baseline(), simd => self.overlaps_by(simd, aabb))
    }

    #[inline(always)]
    fn overlaps_by<S: Simd>(&self, simd: S, aabb: &Aabb) -> u32 {
        let lanes = |values: &[f32; WIDTH]| f32x8::from_slice(simd, values);
        let all = |value| f32x8::splat(simd, value);
        let hit = lanes(&self.min_x).simd_le(all(aabb.max.x))
            & all(aabb.min.x).simd_le(lanes(&self.max_x))
            & lanes(&self.min_y).simd_le(all(aabb.max.y))
            & all(aabb.min.y).simd_le(lanes(&self.max_y));
        hit.to_bitmask() as u32
    }

    /// The union of some lanes.
    #[inline]
    pub(super) fn union_of(&self, mut lanes: u32) -> Aabb {
        let mut all = Aabb::EMPTY;
        while lanes != 0 {
            all = all.union(&self.get(lanes.trailing_zeros() as usize % WIDTH));
            lanes &= lanes - 1;
        }
        all
    }

    /// The union of all lanes.
    #[inline]
    pub(super) fn union(&self) -> Aabb {
        let mut all = self.get(0);
        for lane in 1..WIDTH {
            all = all.union(&self.get(lane));
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::super::clamped;
    use super::super::tests::any_box;
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn lanes_overlap_as_boxes_do(
            children in prop::collection::vec(any_box(), WIDTH),
            probe in any_box(),
            lanes in 0_u32..256,
        ) {
            let (mut boxes, probe) = (Boxes::EMPTY, clamped(probe));
            let children: Vec<Aabb> = children.into_iter().map(clamped).collect();
            children.iter().enumerate().for_each(|(lane, aabb)| boxes.set(lane, *aabb));
            let hit = |lane: usize| u32::from(children[lane].overlaps(&probe)) << lane;
            prop_assert_eq!(boxes.overlaps(&probe), (0..WIDTH).map(hit).sum::<u32>());
            let some = (0..WIDTH).filter(|lane| lanes >> lane & 1 != 0);
            let union = some.fold(Aabb::EMPTY, |all, lane| all.union(&children[lane]));
            prop_assert_eq!(boxes.union_of(lanes), union);
        }
    }
}
