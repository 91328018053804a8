//! Gear: couples a motion of A with one of B.
//!
//! ```text
//! C = (change of A) + ratio (change of B)
//! change: of the angle, J v = w;  or of the anchor's place along s, J v = s . (v + w x r)
//! ```
//!
//! The changes are summed up step by step, so any number of turns is coupled, however fast.

use super::JointKernel;
use super::parts::{Pair, Sides, Soft, Stride, add, cross, dot, sub};
use super::spring::Rates;
use crate::describe::{JointDef, JointKind};
use crate::dynamics::{GearBlock, Slot, TreeLink};
use crate::math::Vec2;
use crate::simd::Lanes;
use crate::threads::SharedRows;

impl GearBlock {
    #[inline(always)]
    fn mesh<L: Lanes>(&self, stride: &Stride<L>, pair: &Pair<L>) -> Sides<L> {
        let gear = &self.gear;
        let slide_a = stride.load2(&gear.slide_a_x, &gear.slide_a_y);
        let slide_b = stride.load2(&gear.slide_b_x, &gear.slide_b_y);
        let arm_a = cross(pair.anchor_a, slide_a) + stride.load(&gear.spin_a);
        let arm_b = cross(pair.anchor_b, slide_b) + stride.load(&gear.spin_b);
        Sides { directions: [slide_a, slide_b], arms: [arm_a, arm_b] }
    }

    /// Error now: that of the step's start and what has come since.
    #[inline(always)]
    fn error<L: Lanes>(&self, stride: &Stride<L>, pair: &Pair<L>, mesh: &Sides<L>) -> L {
        let (a, b) = (&pair.a, &pair.b);
        let start_a = stride.load2(&self.frame.a_x, &self.frame.a_y);
        let start_b = stride.load2(&self.frame.b_x, &self.frame.b_y);
        let moved_a = add([a[Slot::DX], a[Slot::DY]], sub(pair.anchor_a, start_a));
        let moved_b = add([b[Slot::DX], b[Slot::DY]], sub(pair.anchor_b, start_b));
        stride.load(&self.gear.error)
            + (dot(mesh.directions[0], moved_a) + stride.load(&self.gear.spin_a) * a[Slot::DA])
            + (dot(mesh.directions[1], moved_b) + stride.load(&self.gear.spin_b) * b[Slot::DA])
    }
}

impl JointKernel for GearBlock {
    fn tie(&self, stride: &Stride<f64>, pair: &Pair<f64>, link: &mut TreeLink) {
        let mesh = self.mesh(stride, pair);
        link.mesh(&mesh, self.error(stride, pair, &mesh));
    }

    fn describe(&mut self, lane: usize, def: &JointDef, rates: &Rates) {
        let JointKind::Gear { ratio, slide_a, slide_b } = def.kind else { return };
        rates.write(def, None, &mut self.soft, lane);
        let gear = &mut self.gear;
        let a = slide_a.map_or(Vec2::ZERO, Vec2::normalized);
        let b = slide_b.map_or(Vec2::ZERO, Vec2::normalized) * ratio;
        (gear.slide_a_x[lane], gear.slide_a_y[lane]) = (a.x, a.y);
        (gear.slide_b_x[lane], gear.slide_b_y[lane]) = (b.x, b.y);
        gear.spin_a[lane] = if slide_a.is_some() { 0.0 } else { 1.0 };
        gear.spin_b[lane] = if slide_b.is_some() { 0.0 } else { ratio };
    }

    #[inline(always)]
    fn warm_start<L: Lanes>(&mut self, stride: &Stride<L>, pair: &mut Pair<L>) {
        let mesh = self.mesh(stride, pair);
        mesh.apply(pair, stride.load(&self.gear.impulse));
    }

    #[inline(always)]
    fn solve<L: Lanes, const BIAS: bool>(&mut self, stride: &Stride<L>, pair: &mut Pair<L>) {
        let soft = Soft::<L, BIAS>::load(stride, &self.soft);
        let mesh = self.mesh(stride, pair);
        let error = self.error(stride, pair, &mesh);
        let old = stride.load(&self.gear.impulse);
        let demand = soft.demand(mesh.velocity(pair), error);
        let change = -(stride.invert(mesh.inv_mass(pair)) * demand) - soft.impulse_scale * old;
        stride.store(old + change, &mut self.gear.impulse);
        mesh.apply(pair, change);
    }

    #[inline(always)]
    fn finish<L: Lanes>(&mut self, stride: &Stride<L>, rows: SharedRows<'_>) {
        let pair = Pair::load(stride, rows, &self.frame);
        let mesh = self.mesh(stride, &pair);
        let error = self.error(stride, &pair, &mesh);
        stride.store(error, &mut self.gear.error);
    }

    fn impulse(&self, lane: usize) -> (Vec2, f32) {
        let gear = &self.gear;
        let slide = Vec2::new(gear.slide_b_x[lane], gear.slide_b_y[lane]);
        (slide * gear.impulse[lane], gear.spin_b[lane] * gear.impulse[lane])
    }
}
