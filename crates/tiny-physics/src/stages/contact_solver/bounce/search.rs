//! Which contacts bounce in a substep, and how fast their points are to leave.

use super::HANDED_ON;
use crate::dynamics::{
    Bucket, Contact, Graph, HELD, IDLE, Motion, Place, Slot, flags, locked, pace_at,
};
use crate::geometry::manifold::PairClass;
use crate::simd::{BLOCK, Lanes};
use crate::stages::contact_solver::Parameters;
use crate::stages::contact_solver::pair::Pair;
use crate::threads::{SharedRows, Team};

/// Contacts that one member of the team looks at at a time.
const CHUNK: usize = 256;

/// Where a contact is in the graph.
#[derive(Clone, Copy, Debug)]
pub(super) struct At {
    pub(super) place: usize,
    pub(super) class: PairClass,
    pub(super) slot: usize,
}

impl At {
    /// Where one is that is solved at a pace.
    pub(super) fn of(contact: &Contact, pace: usize) -> Option<Self> {
        let Place::Graph { colour, slot } = contact.place else { return None };
        let is_here = usize::from(colour) != IDLE && pace_at(colour.into()) == pace;
        let at = Self { place: colour.into(), class: contact.class, slot: slot as usize };
        is_here.then_some(at)
    }

    /// That of this step: hooks may change it.
    pub(super) fn restitution(self, graph: &Graph) -> f32 {
        let surfaces = &graph.bucket(self.place, self.class).surfaces;
        surfaces[self.slot / BLOCK].restitution[self.slot % BLOCK]
    }

    pub(super) fn key(self) -> u64 {
        (self.place as u64) << 40 | (self.class as u64) << 32 | self.slot as u64
    }
}

/// A contact that bounces.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hit {
    pub(super) at: At,
    /// Speeds at which its points are to leave; 0 for one that does not hit, as yet.
    pub(super) targets: [f32; 2],
    /// Speeds along the tangent with which they came, times restitution.
    pub(super) slips: [f32; 2],
    /// Impulses that its points have had in bounces of the substep: along the normal, along the tangent.
    pub(super) given: [[f32; 2]; 2],
    /// When its shapes meet, seconds since the substep began; see [`moment`](super::moment).
    pub(super) due: f32,
    /// Is it one of the first round, or has it waited since?
    pub(super) first: bool,
}

/// What falls back within this time is as good as at rest, seconds: what forces press together bounces from the speed
/// on that they would give it in this time, or from the threshold on if that is less. So balls on a table without
/// gravity, and those that touch a wall aslant, keep what speed they have, and what lies on the ground lies.
const SHORT: f32 = 0.13;

/// What would be stopped within a substep bounces before it, and so does what rounding may have stopped.
const SOON: f32 = 1.0 + 1e-5;

/// What would leave more slowly than this part of the threshold does not bounce: in a drum of things of restitution 0.1 such bounces
/// took a twentieth of the step.
const LEFT: f32 = 0.05;

/// So much of the speed at which something leaves is lost, so that rounding heats nothing: without it a gas of elastic
/// balls gains 2e-5 of its energy in ten minutes.
const LOST: f32 = 2.4e-7;

/// Lists the contacts of a pace whose points approached faster than the threshold when the step began, or, where nothing
/// was pressed, at all. Gives the greatest restitution.
pub(super) fn list_approaching(
    graph: &Graph,
    pace: usize,
    parameters: &Parameters,
    list: &mut Vec<At>,
) -> f32 {
    let mut bounciest = 0.0;
    list.clear();
    let touching = graph.all().take_while(|&(place, ..)| place != IDLE);
    for (place, class, bucket) in touching.filter(|&(place, ..)| pace_at(place) == pace) {
        for (block, head) in bucket.heads.iter().enumerate() {
            if head.flags & flags::RESTITUTION != 0 {
                let slots = block * BLOCK..bucket.contacts.len().min((block + 1) * BLOCK);
                let approaching = slots.filter(|&slot| approaches(bucket, slot, parameters));
                list.extend(approaching.map(|slot| At { place, class, slot }));
                bounciest =
                    bucket.surfaces[block].restitution.into_iter().fold(bounciest, f32::max);
            }
        }
    }
    bounciest
}

fn approaches(bucket: &Bucket, slot: usize, parameters: &Parameters) -> bool {
    let (block, lane) = (slot / BLOCK, slot % BLOCK);
    let (surface, points) = (&bucket.surfaces[block], &bucket.constraints[block].points);
    let (threshold, restitution) = (parameters.restitution_threshold, surface.restitution[lane]);
    let approaches = [surface.approach_1[lane], surface.approach_2[lane]];
    // What is dull may share a block with what bounces.
    restitution > 0.0
        && points.iter().zip(approaches).any(|(point, approach)| {
            let fresh = point.normal_impulse[lane] == 0.0;
            approach < -threshold || fresh && rebounds(restitution, approach, threshold)
        })
}

/// Is what comes so fast, and nothing pressed before, to bounce? What would hardly leave is stopped.
fn rebounds(restitution: f32, velocity: f32, threshold: f32) -> bool {
    velocity < -HANDED_ON * threshold && restitution * velocity < -LEFT * threshold
}

/// Does what comes so fast leave so fast that it is worth while?
pub(super) fn leaves(restitution: f32, velocity: f32, threshold: f32) -> bool {
    restitution * restitution * velocity < -HANDED_ON * threshold
}

/// The bodies of a contact: not those of the lane, since trees take contacts out of these.
#[inline(always)]
fn pair_of(graph: &Graph, rows: SharedRows<'_>, at: At) -> Pair<f32> {
    let bucket = graph.bucket(at.place, at.class);
    let (constraint, lane) = (&bucket.constraints[at.slot / BLOCK], at.slot % BLOCK);
    let (body_a, body_b) = bucket.bodies(at.slot);
    let mut a = f32::gather((), rows, &[body_a]);
    let mut b = f32::gather((), rows, &[body_b]);
    let locked = locked((), [&mut a, &mut b]);
    let normal = [constraint.normal_x[lane], constraint.normal_y[lane]];
    Pair { token: (), a, b, normal, locked }
}

impl Hit {
    pub(super) fn bodies(&self, graph: &Graph) -> [u32; 2] {
        graph.bucket(self.at.place, self.at.class).bodies(self.at.slot).into()
    }

    /// Adds what it was given in another round.
    pub(super) fn add(&mut self, other: &Self) {
        for (sum, more) in self.given.iter_mut().flatten().zip(other.given.iter().flatten()) {
            *sum += more;
        }
    }

    /// Its points are to leave no faster than they do now: what was handed on is theirs no longer. Is any of it left?
    pub(super) fn keep(&mut self, graph: &Graph, rows: SharedRows<'_>) -> bool {
        let bucket = graph.bucket(self.at.place, self.at.class);
        let (block, lane) = (self.at.slot / BLOCK, self.at.slot % BLOCK);
        let pair = pair_of(graph, rows, self.at);
        for (k, point) in bucket.constraints[block].points.iter().enumerate() {
            let speed = pair.normal_velocity(point.normal_arm_a[lane], point.normal_arm_b[lane]);
            self.targets[k] = self.targets[k].min(speed.max(0.0));
            if self.targets[k] == 0.0 {
                self.given[k] = [0.0; 2];
            }
        }
        self.targets != [0.0; 2]
    }
}

/// What bounces in a round.
#[derive(Clone, Copy)]
pub(super) struct Search<'a> {
    pub(super) graph: &'a Graph,
    pub(super) rows: SharedRows<'a>,
    pub(super) parameters: &'a Parameters,
    pub(super) motions: &'a [Motion],
    /// Is it the first of the substep?
    pub(super) first: bool,
}

impl Search<'_> {
    /// Lists those of a list that hit; what comes later in the step is added to `approaching`.
    pub(super) fn run(
        self,
        team: &Team,
        list: &[At],
        found: &mut Vec<Vec<Hit>>,
        (hits, approaching): (&mut Vec<Hit>, &mut Vec<At>),
    ) {
        let chunks = team.map_chunks(list.len(), CHUNK, found, |range, found| {
            found.clear();
            found.extend(list[range].iter().filter_map(|&at| self.aim(at)));
        });
        let all = chunks.iter().flatten();
        hits.clear();
        hits.extend(all.clone().filter(|hit| hit.targets != [0.0; 2]));
        hits.sort_unstable_by_key(|hit| hit.at.key());
        hits.dedup_by_key(|hit| hit.at.key());
        if !self.first {
            let later = all.filter(|hit| hit.targets == [0.0; 2] && !self.is_held_back(hit.at));
            approaching.extend(later.map(|hit| hit.at));
        }
    }

    fn is_held_back(&self, at: At) -> bool {
        let surfaces = &self.graph.bucket(at.place, at.class).surfaces;
        surfaces[at.slot / BLOCK].approach_1[at.slot % BLOCK] == HELD
    }

    /// What forces add to the velocities of a body in a substep: nothing if it cannot move.
    fn gain(&self, body: u32, row: &[f32; 8]) -> [f32; 3] {
        let moves = row[Slot::INV_MASS].abs() + row[Slot::INV_INERTIA] > 0.0;
        let [x, y, turn, _] = self.motions[body as usize].gain;
        if moves { [x, y, turn] } else { [0.0; 3] }
    }

    /// How fast the points of a contact are to leave that hit in this substep; nothing where none comes at all.
    ///
    /// With approach v, separation s, closing acceleration c (by all forces on the two bodies; negative where they part)
    /// and restitution e, the surfaces meet at speed `sqrt(v^2 + 2 c s)`. The bounce takes place here, at separation s,
    /// so the speed that has to be set is `sqrt(e^2 (v^2 + 2 c s) - 2 c s)`. Velocities of the semi-implicit scheme are
    /// half a substep late: `c h / 2` is missing from the approach and needed on top of the speed.
    pub(super) fn aim(&self, at: At) -> Option<Hit> {
        let Parameters { inv_h, restitution_threshold: threshold, .. } = *self.parameters;
        let (block, lane) = (at.slot / BLOCK, at.slot % BLOCK);
        let bucket = self.graph.bucket(at.place, at.class);
        let constraint = &bucket.constraints[block];
        let surface = &bucket.surfaces[block];
        let (restitution, belt) = (surface.restitution[lane], surface.tangent_speed[lane]);
        let (body_a, body_b) = bucket.bodies(at.slot);
        let pair = pair_of(self.graph, self.rows, at);
        let (mut targets, mut slips, mut any) = ([0.0; 2], [0.0; 2], false);
        for (k, point) in constraint.points.iter().enumerate().take(at.class.max_points()) {
            let arms = [point.normal_arm_a[lane], point.normal_arm_b[lane]];
            let velocity = pair.normal_velocity(arms[0], arms[1]);
            let comes = match self.first {
                true => velocity < -threshold || rebounds(restitution, velocity, threshold),
                false => leaves(restitution, velocity, threshold),
            };
            if !comes || point.normal_mass[lane] <= 0.0 {
                continue;
            }
            any = true;
            let gain_a = self.gain(body_a, &pair.a);
            let gain_b = self.gain(body_b, &pair.b);
            // What the forces add to the approach in a substep.
            let closing = pair.normal[0] * (gain_a[0] - gain_b[0])
                + pair.normal[1] * (gain_a[1] - gain_b[1])
                + (arms[0] * gain_a[2] - arms[1] * gain_b[2]);
            let least = match (self.first, point.normal_impulse[lane] == 0.0) {
                (true, true) => (closing.max(0.0) * (SHORT * inv_h)).min(threshold),
                (true, false) => threshold,
                (false, _) => 0.0,
            };
            let s = pair.separation(point.separation[lane], arms[0], arms[1]);
            // At the latest where the solver would stop it.
            let arrives = s * inv_h + velocity * SOON < closing.max(0.0);
            let (late, fall) = (0.5 * closing, 2.0 * inv_h * closing * s);
            let approach = late - velocity;
            let meet = approach * approach + fall;
            if velocity < -least && arrives && meet > 0.0 {
                let speed = (restitution * restitution * meet - fall).max(0.0).sqrt() + late;
                targets[k] = speed * (1.0 - LOST);
                let arms = [point.tangent_arm_a[lane], point.tangent_arm_b[lane]];
                slips[k] = restitution * (pair.tangent_velocity(arms[0], arms[1]) + belt);
            }
        }
        any.then_some(Hit { at, targets, slips, given: [[0.0; 2]; 2], due: 0.0, first: self.first })
    }
}
