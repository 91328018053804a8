//! What passes by: contacts whose points come together, while their shapes do not.

use super::ahead::{Predictions, go_by};
use super::narrow_context::Context;
use crate::dynamics::Blocks;
use crate::math::Vec2;
use crate::simd::BLOCK;

/// Of the lanes from one on that come together (`coming`, as bits), takes the points from those whose shapes pass by each other;
/// gives these. The normal of a corner that is still apart would hold off whatever goes by, as a wall does. That they are looked
/// at again if something strikes them ([`Predictions`]), they count as closing in.
#[inline(never)]
pub(super) fn leave_out(
    context: &Context<'_>,
    predictions: &Predictions,
    blocks: &mut Blocks<'_>,
    (index, at, mut coming): (usize, usize, u32),
    normals: &[[f32; BLOCK]; 2],
) -> u32 {
    let mut passing = 0;
    while coming != 0 {
        let lane = at + coming.trailing_zeros() as usize;
        let bit = coming & coming.wrapping_neg();
        coming ^= bit;
        let block = &mut blocks.manifolds[index];
        let is_foreseen = predictions.of(blocks.contacts[index * BLOCK + lane]).is_some();
        let normal = Vec2::new(normals[0][lane], normals[1][lane]);
        if is_foreseen || !go_by(context, [block.shape_a[lane], block.shape_b[lane]], normal) {
            continue;
        }
        passing |= bit;
        (block.id_1[lane], block.id_2[lane]) = (-1.0, -1.0);
        let Some(constraint) = blocks.constraints.get_mut(index) else { continue };
        for point in &mut constraint.points {
            (point.normal_mass[lane], point.tangent_mass[lane]) = (0.0, 0.0);
            (point.normal_impulse[lane], point.tangent_impulse[lane]) = (0.0, 0.0);
        }
    }
    passing
}
