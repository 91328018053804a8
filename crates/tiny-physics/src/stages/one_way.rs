//! One-way platforms: a contact with one may only begin from its solid side.
//!
//! A pair that starts to touch is judged by its manifold: the normal must point out of the solid side, the shapes
//! must not part, and the overlap must not be deeper than what the shapes came nearer in the last step. What is turned down waits
//! among the contacts that do not touch, and is judged again in the next step; what is accepted stays so until
//! it ends. So a body that rises through a platform meets nothing until it is out on top, and one that stands
//! on a platform stays there however that moves.

use crate::dynamics::{Bodies, Contact, ShapeRecord, Shapes};
use crate::geometry::{LINEAR_SLOP, collide};
use crate::math::{Rot, Vec2};

/// A normal of the solid side may be this far from its direction, as a cosine: 60 degrees. Faces are solid up to
/// there, too.
pub(super) const LEAST_COSINE: f32 = 0.5;

/// What parts faster than this is still on its way out, metres a second; multiplied by the length unit.
const PARTING_SPEED: f32 = 0.1;

/// May this contact, which touches now and did not before, begin? Points up to `reach` apart are contacts, metres.
pub(crate) fn may_begin(
    contact: &Contact,
    bodies: &Bodies,
    shapes: &Shapes,
    (reach, length_unit): (f32, f32),
) -> bool {
    let record = |i: u32| &shapes.records[i as usize];
    let (a, b) = (record(contact.shape_a), record(contact.shape_b));
    if a.one_way.is_none() && b.one_way.is_none() {
        return true;
    }
    let pose = |shape: &ShapeRecord| bodies.poses[shape.body as usize].compose(shape.central);
    let (frame_a, frame_b) = (pose(a), pose(b));
    let b_in_a = frame_b.relative_to(frame_a);
    let manifold = collide(&a.shape, &b.shape, b_in_a, reach);
    let normal = frame_a.q.rotate(manifold.normal);
    let (mut depth, mut point) = (f32::NEG_INFINITY, frame_a.p);
    for p in manifold.points() {
        if -p.separation > depth {
            (depth, point) = (-p.separation, frame_a.apply(p.point));
        }
    }
    // How a point that lies there now moved with a body in the last step, whatever has become of its velocity since.
    let moved = |body: u32| {
        let (from, to) = (bodies.previous[body as usize], bodies.poses[body as usize]);
        point.relative_to(from.apply(to.unapply(point)))
    };
    let velocity = |body: u32| {
        let arm = point.relative_to(bodies.poses[body as usize].p);
        bodies.velocity(body) + arm.perp() * bodies.angular_velocity(body)
    };
    let [came, closing] = [
        moved(contact.body_a) - moved(contact.body_b),
        velocity(contact.body_a) - velocity(contact.body_b),
    ]
    .map(|way| way.dot(normal));
    let came = if came > 0.0 { came } else { 0.0 };
    let turned = [contact.body_a, contact.body_b].map(|body| bodies.poses[body as usize].q);
    (came > 0.0 || closing >= -PARTING_SPEED * length_unit)
        && depth <= LINEAR_SLOP * length_unit + came
        && are_solid_along([a, b], turned, normal)
}

/// Does a normal from A to B point out of the solid sides of both? `turned` are the rotations of their bodies.
pub(crate) fn are_solid_along([a, b]: [&ShapeRecord; 2], turned: [Rot; 2], normal: Vec2) -> bool {
    let is_solid = |shape: &ShapeRecord, q: Rot, outward: Vec2| {
        let along = |way: Vec2| q.rotate(way.normalized()).dot(outward);
        shape.one_way.is_none_or(|way| along(way) >= LEAST_COSINE)
    };
    is_solid(a, turned[0], normal) && is_solid(b, turned[1], -normal)
}

/// Does one let pass what moves by `way` relative to it, and a point of which turning takes `turned` further at most? `q` is the rotation
/// of its body.
pub(crate) fn lets_pass(shape: &ShapeRecord, q: Rot, way: Vec2, turned: f32) -> bool {
    let along = |direction: Vec2| q.rotate(direction.normalized()).dot(way);
    shape.one_way.is_some_and(|direction| along(direction) >= turned)
}
