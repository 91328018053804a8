//! Rocking: what swings to and fro on something round comes to rest.
//!
//! What rolls without sliding loses nothing, so a plank on a ball and a capsule on its end would rock for ever, and keep all
//! that they lie on awake. Whatever is real resists rolling a little. Here what rolls on does not. But what has turned
//! back some times, slowly and without a rest, loses its turning against what it touches. A ball by itself that rolls to
//! and fro in a bowl goes on, as it lies on nothing else and nothing on it.

use super::rests::is_calm;
use super::sway;
use crate::dynamics::{Bodies, Bucket, Contacts, Graph, Joints};
use crate::math::Vec2;
use crate::simd::BLOCK;

/// So often has what rocks turned back.
const ENOUGH: u8 = 4;
/// A ball is so round.
const ROUND: f32 = 1.0e-4;
/// What is faster than this does not rock but goes somewhere, length units a second.
const FASTEST: f32 = 0.5;
/// Nor what turns faster than this at its rim: a seesaw that is pushed goes on.
const RIM: f32 = 2.0;

/// Is it time to look? As often as for [`sway`], but not in even measure: what trembles to and fro every four steps would seem not to turn.
pub(crate) fn is_due(step: u64) -> bool {
    matches!(step % 8, 2 | 4)
}

/// Slows what turns against something that rocks.
pub(crate) fn resist(
    bodies: &mut Bodies,
    (contacts, joints): (&Contacts, &Joints),
    graph: &Graph,
    (dt, length_unit): (f32, f32),
) {
    let mut most = 0;
    for i in 0..bodies.awake.len() {
        let body = bodies.awake[i];
        let swings = swings(bodies, joints, body, length_unit);
        bodies.swings[body as usize] = swings;
        most = most.max(swings);
    }
    if most <= ENOUGH {
        return;
    }
    let lost = 1.0 - sway::kept(dt);
    for (_, bucket) in graph.touching_buckets() {
        for slot in (0..bucket.contacts.len()).filter(|&slot| bears(bucket, slot)) {
            let (a, b) = bucket.bodies(slot);
            let rocks = |body: u32| is_restless(bodies, body);
            let free =
                |body: u32| is_led(bodies, body) || rolls_freely(bodies, contacts, joints, body);
            if (rocks(a) || rocks(b)) && !free(a) && !free(b) {
                slow(bodies, a, b, lost);
            }
        }
    }
}

/// Has a body turned back so often without a rest?
pub(crate) fn is_restless(bodies: &Bodies, body: u32) -> bool {
    bodies.swings[body as usize] > ENOUGH
}

/// How often a body has turned back by now. The last bit is the direction.
fn swings(bodies: &Bodies, joints: &Joints, body: u32, length_unit: f32) -> u8 {
    let info = &bodies.infos[body as usize];
    if is_calm(bodies, body) || joints.act_on(info.first_joint) {
        return 0;
    }
    let (swings, spin) = (bodies.swings[body as usize], bodies.angular_velocity(body));
    let way = if swings & 1 == 0 { spin } else { -spin } * info.max_extent;
    match swings {
        _ if bodies.velocity(body).length() > FASTEST * length_unit => 0,
        _ if way.abs() > RIM * length_unit => 0,
        _ if way <= info.sleep_speed * length_unit => swings,
        u8::MAX => u8::MAX - 1,
        _ => swings + 1,
    }
}

/// Is a body a ball about its centre of mass that touches one other alone, or a wheel?
fn rolls_freely(bodies: &Bodies, contacts: &Contacts, joints: &Joints, body: u32) -> bool {
    let info = &bodies.infos[body as usize];
    let all = contacts.of_body(info.first_contact);
    let touching = all.map(|(index, _)| &contacts.records[index as usize]);
    let mut others = touching.filter(|contact| contact.touching).map(|contact| contact.other(body));
    let round = info.max_extent - info.min_extent <= ROUND * info.min_extent;
    let first = others.next();
    let is_wheel = joints.act_on(info.first_joint);
    bodies.is_dynamic(body) && round && (is_wheel || others.all(|other| Some(other) == first))
}

/// Does the user alone move a body? What that takes to and fro does not rock.
fn is_led(bodies: &Bodies, body: u32) -> bool {
    let moves = bodies.velocity(body) != Vec2::ZERO || bodies.angular_velocity(body) != 0.0;
    moves && !bodies.is_dynamic(body)
}

/// Takes away a part of how two bodies turn against each other, at the cost of both.
fn slow(bodies: &mut Bodies, a: u32, b: u32, part: f32) {
    let [(spin_a, inverse_a), (spin_b, inverse_b)] =
        [a, b].map(|body| (bodies.angular_velocity(body), bodies.inverse_masses(body).1));
    if inverse_a + inverse_b > 0.0 {
        let impulse = part * (spin_b - spin_a) / (inverse_a + inverse_b);
        bodies.set_angular_velocity(a, spin_a + impulse * inverse_a);
        bodies.set_angular_velocity(b, spin_b - impulse * inverse_b);
    }
}

/// Does a contact carry anything?
fn bears(bucket: &Bucket, slot: usize) -> bool {
    let (block, lane) = (slot / BLOCK, slot % BLOCK);
    bucket.constraints[block].points.iter().any(|point| point.load[lane] > 0.0)
}
