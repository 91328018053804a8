//! Drive: motor and mouse joints. Bounded springs and velocity motors at the anchors and on the angle.
//!
//! ```text
//! J v = (vB + wB x rB - vA - wA x rA, wB - wA)
//! springs: C = (xB + rB - xA - rA, aB - aA),  |p| <= max      motors: J v = target,  |p| <= max
//! ```
//!
//! A mouse joint has a point of the world in the place of A: its lanes name body 0 and the gap is
//! taken from the point in 64 bits. Its angular part is a damper without a spring.

use super::JointKernel;
use super::axis::drive;
use super::parts::{Pair, Soft, Start, Stride, Symmetric, add, describe_angle, dot, scale, sub};
use super::spring::Rates;
use crate::describe::{JointDef, JointKind, Spring};
use crate::dynamics::DriveBlock;
use crate::math::{DVec2, Pose, Vec2};
use crate::simd::Lanes;

/// What a mouse joint drags loses its turning at this rate, 1/s: it hangs and swings, but not for long.
const MOUSE_TURN_DAMPING: f32 = 2.0;

/// An impulse shortened to a length.
#[inline(always)]
fn shorten<L: Lanes>(stride: &Stride<L>, impulse: [L; 2], max: L) -> [L; 2] {
    let length_sq = dot(impulse, impulse);
    let long = length_sq.gt(max * max);
    let factor = max / L::select(long, length_sq, stride.one).sqrt();
    scale(impulse, L::select(long, factor, stride.one))
}

/// The springs of a mouse joint as a motor joint has them; that itself.
fn as_motor(kind: JointKind) -> JointKind {
    let JointKind::Mouse { spring, max_force, .. } = kind else { return kind };
    JointKind::Motor {
        velocity: Vec2::ZERO,
        max_force: 0.0,
        angular_velocity: 0.0,
        max_torque: 0.0,
        linear_spring: Some(spring),
        max_spring_force: max_force,
        angular_spring: None,
        max_spring_torque: 0.0,
    }
}

impl DriveBlock {
    /// Change of the angular impulses.
    #[inline(always)]
    fn solve_angle<L: Lanes, const BIAS: bool>(&mut self, stride: &Stride<L>, pair: &Pair<L>) -> L {
        let inv_mass = pair.inv_inertia();
        let mass = stride.invert(inv_mass);
        let mut velocity = pair.spin();
        let soft = Soft::<L, BIAS>::load(stride, &self.angular);
        let old = stride.load(&self.twist.impulse);
        let max = stride.load(&self.drive.twist_max);
        let error = pair.angle(stride, &self.angle);
        // What a spring at its most has beyond it takes up the relax pass's share of the damping.
        let kept = if BIAS { old } else { stride.load(&self.drive.uncut_twist) };
        let uncut = kept - soft.impulse_scale * kept - mass * soft.demand(velocity, error);
        stride.store(uncut, &mut self.drive.uncut_twist);
        let impulse = uncut.clamp(-max, max);
        stride.store(impulse, &mut self.twist.impulse);
        let total = impulse - old;
        velocity = velocity + inv_mass * total;
        let old = stride.load(&self.drive.angular_impulse);
        let max = stride.load(&self.drive.angular_max);
        let speed = stride.load(&self.drive.angular_velocity);
        let impulse = drive([speed, max, old], velocity, mass);
        stride.store(impulse, &mut self.drive.angular_impulse);
        total + (impulse - old)
    }

    #[inline(always)]
    fn solve_spring<L: Lanes, const BIAS: bool>(
        &mut self,
        stride: &Stride<L>,
        pair: &Pair<L>,
        inverse: &Symmetric<L>,
    ) -> [L; 2] {
        let soft = Soft::<L, BIAS>::load(stride, &self.linear);
        let old = stride.load2(&self.point.impulse_x, &self.point.impulse_y);
        let (velocity, gap) = (pair.anchor_velocity(), pair.gap);
        let demand = [soft.demand(velocity[0], gap[0]), soft.demand(velocity[1], gap[1])];
        let drive = &mut self.drive;
        let kept = if BIAS { old } else { stride.load2(&drive.uncut_x, &drive.uncut_y) };
        let uncut = sub(sub(kept, scale(kept, soft.impulse_scale)), inverse.apply(demand));
        stride.store2(uncut, &mut drive.uncut_x, &mut drive.uncut_y);
        let impulse = shorten(stride, uncut, stride.load(&drive.spring_max));
        stride.store2(impulse, &mut self.point.impulse_x, &mut self.point.impulse_y);
        sub(impulse, old)
    }

    #[inline(always)]
    fn solve_velocity<L: Lanes>(
        &mut self,
        stride: &Stride<L>,
        pair: &Pair<L>,
        inverse: &Symmetric<L>,
    ) -> [L; 2] {
        let drive = &mut self.drive;
        let old = stride.load2(&drive.velocity_impulse_x, &drive.velocity_impulse_y);
        let target = stride.load2(&drive.velocity_x, &drive.velocity_y);
        let missing = sub(target, pair.anchor_velocity());
        let impulse = add(old, inverse.apply(missing));
        let impulse = shorten(stride, impulse, stride.load(&drive.velocity_max));
        stride.store2(impulse, &mut drive.velocity_impulse_x, &mut drive.velocity_impulse_y);
        sub(impulse, old)
    }
}

impl JointKernel for DriveBlock {
    fn describe(&mut self, lane: usize, def: &JointDef, rates: &Rates) {
        describe_angle(&mut self.angle, lane, def);
        let JointKind::Motor {
            velocity,
            max_force,
            angular_velocity,
            max_torque,
            linear_spring,
            max_spring_force,
            angular_spring,
            max_spring_torque,
        } = as_motor(def.kind)
        else {
            return;
        };
        self.linear.write(lane, rates.spring(linear_spring));
        self.angular.write(lane, rates.spring(angular_spring));
        let most = |spring: Option<Spring>, max: f32| spring.map_or(0.0, |_| max * rates.h);
        let drive = &mut self.drive;
        drive.mouse[lane] = 0.0;
        (drive.velocity_x[lane], drive.velocity_y[lane]) = (velocity.x, velocity.y);
        drive.velocity_max[lane] = max_force * rates.h;
        drive.angular_velocity[lane] = angular_velocity;
        drive.angular_max[lane] = max_torque * rates.h;
        drive.spring_max[lane] = most(linear_spring, max_spring_force);
        drive.twist_max[lane] = most(angular_spring, max_spring_torque);
        if let JointKind::Mouse { target, max_force, .. } = def.kind {
            drive.mouse[lane] = 1.0;
            (drive.target_x[lane], drive.target_y[lane]) = (target.x, target.y);
            // w' = w / (1 + damping h)
            let lost = MOUSE_TURN_DAMPING * rates.h;
            self.angular.mass_scale[lane] = lost / (1.0 + lost);
            self.angular.impulse_scale[lane] = 1.0 / (1.0 + lost);
            drive.twist_max[lane] = if max_force > 0.0 { f32::MAX } else { 0.0 };
            let frame = &mut self.frame;
            frame.body_a[lane] = 0;
            (frame.local_a_x[lane], frame.local_a_y[lane]) = (0.0, 0.0);
        }
    }

    #[inline(always)]
    fn prepare<L: Lanes>(&mut self, stride: &Stride<L>, start: &Start<L>, poses: &[Pose]) {
        start.prepare_angle(stride, &mut self.angle);
        for i in stride.at..stride.at + L::WIDTH {
            if self.drive.mouse[i] != 0.0 {
                let target = DVec2::new(self.drive.target_x[i], self.drive.target_y[i]);
                let between = poses[self.frame.body_b[i] as usize].p.relative_to(target);
                self.frame.between_x[i] = between.x;
                self.frame.between_y[i] = between.y;
            }
        }
    }

    #[inline(always)]
    fn warm_start<L: Lanes>(&mut self, stride: &Stride<L>, pair: &mut Pair<L>) {
        let drive = &self.drive;
        let impulse = add(
            stride.load2(&self.point.impulse_x, &self.point.impulse_y),
            stride.load2(&drive.velocity_impulse_x, &drive.velocity_impulse_y),
        );
        let angular = stride.load(&self.twist.impulse) + stride.load(&drive.angular_impulse);
        pair.apply_at_anchors(impulse, angular);
    }

    #[inline(always)]
    fn solve<L: Lanes, const BIAS: bool>(&mut self, stride: &Stride<L>, pair: &mut Pair<L>) {
        let angular = self.solve_angle::<L, BIAS>(stride, pair);
        pair.apply([stride.zero; 2], angular, angular);
        let inverse = pair.point_mass(stride);
        let change = self.solve_spring::<L, BIAS>(stride, pair, &inverse);
        pair.apply_at_anchors(change, stride.zero);
        let change = self.solve_velocity(stride, pair, &inverse);
        pair.apply_at_anchors(change, stride.zero);
    }

    fn impulse(&self, lane: usize) -> (Vec2, f32) {
        let drive = &self.drive;
        let spring = Vec2::new(self.point.impulse_x[lane], self.point.impulse_y[lane]);
        let motor = Vec2::new(drive.velocity_impulse_x[lane], drive.velocity_impulse_y[lane]);
        (spring + motor, self.twist.impulse[lane] + drive.angular_impulse[lane])
    }
}
