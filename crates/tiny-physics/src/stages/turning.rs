//! What lies on something that turns goes along its arc.
//!
//! A contact sees how fast a face of a kinematic body comes, and takes that for the whole step. On a drum that is straight
//! ahead at the rim's speed: a ball would leave the circle by `w^2 r dt^2 / 2` in each step, and be inside the wall. A face
//! through `(x, -d)` that turns at `w` about the origin comes up by `w x dt + w (u - w d / 2) dt^2` under a point that goes
//! along it at `u`. So for as long as the substeps take, the arms `x` of such contacts are longer by `(u - w d / 2) dt`.

use super::ahead::Predictions;
use super::islands::Stores;
use crate::describe::BodyKind;
use crate::dynamics::{ConstraintBlock, Contacts, Graph, Place, PointLanes, Shapes};
use crate::geometry::Shape;
use crate::math::Vec2;
use crate::simd::BLOCK;

/// A contact of which the arms of one side were changed, and what they were.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lean {
    contact: u32,
    side: usize,
    arms: [f32; 2],
}

/// Changes the arms of contacts on kinematic bodies that turn; those that were go to `leans`. What is foreseen is left as it
/// is, and disks: their faces do not turn with them.
pub(crate) fn lean(
    stores: &mut Stores<'_>,
    (shapes, dt): (&Shapes, f32),
    predictions: &Predictions,
    leans: &mut Vec<Lean>,
) {
    leans.clear();
    let Stores { bodies, contacts, graph, .. } = stores;
    for &body in &bodies.awake {
        let (info, spin) = (&bodies.infos[body as usize], bodies.angular_velocity(body));
        if info.kind != BodyKind::Kinematic || spin == 0.0 {
            continue;
        }
        for (index, side) in contacts.of_body(info.first_contact) {
            let side = side as usize;
            let contact = &contacts.records[index as usize];
            let is_disk = [contact.shape_a, contact.shape_b]
                .map(|shape| matches!(shapes.records[shape as usize].shape, Shape::Circle { .. }));
            let other = if side == 0 { contact.body_b } else { contact.body_a };
            let foreseen = predictions.of(index).is_some();
            if foreseen || is_disk[side] || !graph.touches(contact) {
                continue;
            }
            let Some((constraint, lane)) = constraint(contacts, graph, index) else { continue };
            let tangent = Vec2::new(constraint.normal_y[lane], -constraint.normal_x[lane]);
            let slide = bodies.velocity(other).dot(tangent);
            // A disk goes along as its middle does, a corner as it turns, too.
            let turn = if is_disk[1 - side] { 0.0 } else { bodies.angular_velocity(other) };
            let mut arms = [0.0; 2];
            for (point, old) in constraint.points.iter_mut().zip(&mut arms) {
                let [own, others] = [side, 1 - side].map(|side| tangent_arm(point, side, lane));
                let (rim, arm) = (spin * own, normal_arm(point, side, lane));
                let along = (slide + turn * others).max(-rim.abs()).min(rim.abs());
                *old = *arm;
                *arm += (along - 0.5 * rim) * dt;
            }
            leans.push(Lean { contact: index, side, arms });
        }
    }
}

/// Changes them back.
pub(crate) fn straighten(contacts: &Contacts, graph: &mut Graph, leans: &[Lean]) {
    for &Lean { contact, side, arms } in leans {
        if let Some((constraint, lane)) = constraint(contacts, graph, contact) {
            for (point, arm) in constraint.points.iter_mut().zip(arms) {
                *normal_arm(point, side, lane) = arm;
            }
        }
    }
}

/// The block and the lane of a contact, if it is solved.
fn constraint<'a>(
    contacts: &Contacts,
    graph: &'a mut Graph,
    contact: u32,
) -> Option<(&'a mut ConstraintBlock, usize)> {
    let contact = &contacts.records[contact as usize];
    let Place::Graph { colour, slot } = contact.place else { return None };
    let (block, lane) = (slot as usize / BLOCK, slot as usize % BLOCK);
    let bucket = graph.bucket_mut(colour.into(), contact.class);
    bucket.constraints.get_mut(block).map(|constraint| (constraint, lane))
}

fn normal_arm(point: &mut PointLanes, side: usize, lane: usize) -> &mut f32 {
    if side == 0 { &mut point.normal_arm_a[lane] } else { &mut point.normal_arm_b[lane] }
}

fn tangent_arm(point: &PointLanes, side: usize, lane: usize) -> f32 {
    if side == 0 { point.tangent_arm_a[lane] } else { point.tangent_arm_b[lane] }
}
