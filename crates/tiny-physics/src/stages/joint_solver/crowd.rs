//! How many springs act on a body together.
//!
//! A spring in lanes knows its own two bodies alone: of what it would do to the motion between them the part `c = (w h)^2` happens in a
//! substep, and to all that meet in a body that is a matrix with these on its diagonal, each in the part `s` that this body has in the motion
//! between the two. No motion can be changed by more than its trace, `sum of s c`. So with both bodies of a spring it acts as `1 + sum of s c'
//! / c` of its kind would, over the others. What is stiffer counts as one more of its kind: it has to give way itself.

use super::spring::MAX_RATE_FRACTION;
use crate::describe::{BodyKind, JointDef, JointKind};
use crate::dynamics::{BodyInfo, JointRecord, Joints, Place};
use crate::math::Vec2;

/// So many springs like those of a joint act on its bodies, itself included; 1 where it has none.
pub(super) fn crowd(joints: &Joints, infos: &[BodyInfo], index: u32, h: f32) -> f32 {
    let record = &joints.records[index as usize];
    let own = stiffness(&record.def, h);
    let mut crowd = 1.0;
    if own > 0.0 {
        for body in [record.body_a, record.body_b] {
            let info = &infos[body as usize];
            if info.kind != BodyKind::Dynamic {
                continue;
            }
            for (joint, side) in joints.of_body(info.first_joint) {
                let other = &joints.records[joint as usize];
                if joint != index && other.place != Place::Asleep {
                    let part = stiffness(&other.def, h) / own;
                    crowd += part.min(1.0) * share(infos, other, side);
                }
            }
        }
    }
    crowd
}

/// What a joint's springs change in a substep, the stiffest of them.
fn stiffness(def: &JointDef, h: f32) -> f32 {
    let [a, b] = def.kind.springs().map(|spring| spring.map_or(0.0, |spring| spring.hertz));
    let rate = a.max(b).min(MAX_RATE_FRACTION / h) * h;
    rate * rate
}

/// The part of a joint's motion that is that of one of its bodies.
fn share(infos: &[BodyInfo], record: &JointRecord, side: u32) -> f32 {
    let def = &record.def;
    let turns = matches!(def.kind, JointKind::Revolute { .. }) || def.kind.springs()[0].is_none();
    let ends = [(record.body_a, def.anchor_a), (record.body_b, def.anchor_b)];
    let [a, b] = ends.map(|(body, anchor)| gives_way(&infos[body as usize], anchor, turns));
    let one = [a, b][side as usize];
    if one > 0.0 { one / (a + b) } else { 0.0 }
}

/// Inverse mass of a body at an anchor, on the mean over all directions, or in turning.
fn gives_way(info: &BodyInfo, anchor: Vec2, turns: bool) -> f32 {
    if info.kind != BodyKind::Dynamic {
        return 0.0;
    }
    let inverse = |mass: f32| if mass > 0.0 { 1.0 / mass } else { 0.0 };
    let free = !info.locks.rotation && !info.never_turns;
    let turning = if free { inverse(info.inertia) } else { 0.0 };
    if turns {
        return turning;
    }
    inverse(info.mass) + 0.5 * (anchor - info.local_center).length_sq() * turning
}
