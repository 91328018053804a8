//! Sway: what stands on something firm comes to rest on it.
//!
//! Bodies that press on each other with both points of a contact, and stick, are one piece with what they stand on: none
//! of them moves against another. The solver sees to that between neighbours, but a pass reaches few of them, and warm
//! starting keeps what is left like a spring: a tower swings as a rod does, eleven crates by 2 cm for more than ten seconds.
//! So every few steps the velocities of such pieces, as seen from what they stand on, are made less.

use crate::dynamics::{Bodies, Bucket, DisjointSets, Graph};
use crate::footprint::footprint;
use crate::math::Vec2;
use crate::simd::BLOCK;

/// Steps between two looks: one costs about a hundredth of a step.
const INTERVAL: u64 = 4;
/// How fast sway goes away, 1 / second.
const RATE: f32 = 7.5;
/// What is faster than this is no sway, length units a second.
const FASTEST: f32 = 0.2;
/// What takes a greater part of the friction that there is may be about to slide.
const STICKS: f32 = 0.8;

/// What a body stands on, or at the index of its root a piece.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
enum Stand {
    #[default]
    Nothing,
    /// On what moves at a velocity, all of it.
    Firm(Vec2),
    /// On things that move apart, or turn.
    Torn,
}

impl Stand {
    /// On something that is not dynamic.
    fn on(bodies: &Bodies, body: u32) -> Self {
        let turns = bodies.angular_velocity(body) != 0.0;
        if turns { Self::Torn } else { Self::Firm(bodies.velocity(body)) }
    }

    /// On both.
    fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::Nothing, one) | (one, Self::Nothing) => one,
            (one, other) if one == other => one,
            _ => Self::Torn,
        }
    }
}

/// Lists that [`calm`] fills anew; kept for their memory.
#[derive(Debug, Default)]
pub(crate) struct Memory {
    pieces: DisjointSets,
    stands: Vec<Stand>,
}

footprint!(Memory { pieces, stands });

/// Is it time to look? Between the looks of [`paces`](super::paces) and [`sleep`](super::sleep).
pub(crate) fn is_due(step: u64) -> bool {
    step % INTERVAL == INTERVAL / 2
}

/// What is left of sway after a look.
pub(crate) fn kept(dt: f32) -> f32 {
    1.0 / (1.0 + RATE * INTERVAL as f32 * dt)
}

/// Makes the velocities less of what swings on something firm.
pub(crate) fn calm(
    bodies: &mut Bodies,
    graph: &Graph,
    (dt, length_unit): (f32, f32),
    memory: &mut Memory,
) {
    let Memory { pieces, stands } = memory;
    pieces.reset(bodies.infos.len(), bodies.awake.iter().copied());
    stands.resize(bodies.infos.len(), Stand::Nothing);
    bodies.awake.iter().for_each(|&body| stands[body as usize] = Stand::Nothing);
    for (_, bucket) in graph.touching_buckets() {
        for block in 0..bucket.constraints.len() {
            for (lane, _) in holding(bucket, block).into_iter().enumerate().filter(|&(_, on)| on) {
                let (a, b) = bucket.bodies(block * BLOCK + lane);
                let (on, under) = if bodies.is_solved(a) { (a, b) } else { (b, a) };
                if bodies.is_solved(under) {
                    pieces.join(on, under);
                } else {
                    stands[on as usize] = stands[on as usize].and(Stand::on(bodies, under));
                }
            }
        }
    }
    for &body in &bodies.awake {
        let root = pieces.root(body) as usize;
        stands[root] = stands[root].and(stands[body as usize]);
    }
    let (keep, fastest) = (kept(dt), FASTEST * length_unit);
    for i in 0..bodies.awake.len() {
        let body = bodies.awake[i];
        let Stand::Firm(ground) = stands[pieces.root(body) as usize] else { continue };
        let (velocity, spin) = (bodies.velocity(body) - ground, bodies.angular_velocity(body));
        let speed = velocity.length() + spin.abs() * bodies.infos[body as usize].max_extent;
        if bodies.is_dynamic(body) && speed < fastest {
            bodies.set_velocity(body, ground + velocity * keep);
            bodies.set_angular_velocity(body, spin * keep);
        }
    }
}

/// Lanes of a block in which both points of a contact bear, and stick.
fn holding(bucket: &Bucket, block: usize) -> [bool; BLOCK] {
    let (constraint, belt) = (&bucket.constraints[block], &bucket.surfaces[block].tangent_speed);
    let [first, second] = &constraint.points;
    let used = bucket.contacts.len() - block * BLOCK;
    // Without branches: the compiler looks at several lanes at once.
    core::array::from_fn(|lane| {
        let loads = [first.load[lane], second.load[lane]];
        let friction = (first.tangent_impulse[lane] + second.tangent_impulse[lane]).abs();
        let most = STICKS * constraint.friction[lane] * (loads[0] + loads[1]);
        let bears = (loads[0] > 0.0) & (loads[1] > 0.0);
        bears & (friction < most) & (belt[lane] == 0.0) & (lane < used)
    })
}
