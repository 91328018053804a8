//! After the substeps: poses take up the motion, boxes follow, rest is timed.

use super::boxes::{self, Boxes, Moved, Way};
use super::rests;
use super::solve::Lengths;
use crate::broad_phase::BroadPhase;
use crate::describe::BodyKind;
use crate::dynamics::{Bodies, BodyInfo, Motion, REFINEMENT, Shapes, Slot};
use crate::geometry::Sweep;
use crate::math::{Aabb, Pose, Transform, Vec2};
use crate::simd::Row;
use crate::threads::{SharedSlice, Team};

/// A body that moved so far in one step that it might have jumped over something.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FastBody {
    pub(crate) body: u32,
    /// Pose of the centre of mass at the start of the step.
    pub(crate) start: Pose,
    /// Pose at the end of the step.
    pub(crate) end: Pose,
    /// What it moved, metres.
    pub(crate) motion: Vec2,
    /// What it turned, radians.
    pub(crate) turn: f32,
    /// Velocity that it must lose: what drives its middle into something.
    pub(crate) lost: Vec2,
    /// When it was stopped, as a part of the step; 1 where it was not, more where something took it along.
    pub(crate) fraction: f32,
}

impl FastBody {
    /// The last step of any body that did not turn by half a turn in it; what is not awake rests.
    pub(crate) fn of_step(bodies: &Bodies, body: u32) -> Self {
        let end = bodies.poses[body as usize];
        let awake = bodies.infos[body as usize].awake;
        let start = if awake { bodies.previous[body as usize] } else { end };
        let (motion, turn) = (end.p.relative_to(start.p), end.q.angle_from(start.q));
        Self { body, start, end, motion, turn, lost: Vec2::ZERO, fraction: 1.0 }
    }

    /// Sets it back to a part of the step, unless it was stopped before or taken along.
    pub(crate) fn set_back(&mut self, fraction: f32) {
        if fraction >= self.fraction || self.fraction > 1.0 {
            return;
        }
        let share = fraction / self.fraction;
        (self.motion, self.turn, self.fraction) =
            (self.motion * share, self.turn * share, fraction);
        self.end = Pose::new(self.start.p + self.motion, self.start.q.integrate(self.turn));
    }

    /// How it went.
    pub(crate) fn course(&self) -> Way {
        Way { start: self.start, motion: self.motion, turn: self.turn }
    }

    /// How it went as seen from another body's start.
    pub(crate) fn seen_from(&self, start: Pose) -> Sweep {
        let frame = Transform::new(self.start.p.relative_to(start.p), self.start.q);
        Sweep::new(frame, Vec2::ZERO, self.motion, self.turn)
    }

    /// Does its way lie outside a box, with all that it may reach of it?
    pub(crate) fn misses(&self, info: &BodyInfo, bounds: &Aabb) -> bool {
        let extent = f64::from(info.max_extent);
        let apart = |a: f64, b: f64, least: f32, most: f32| {
            let (from, to) = if a < b { (a, b) } else { (b, a) };
            from - extent > f64::from(most) || to + extent < f64::from(least)
        };
        let (a, b) = (self.start.p, self.end.p);
        apart(a.x, b.x, bounds.min.x, bounds.max.x) || apart(a.y, b.y, bounds.min.y, bounds.max.y)
    }

    /// The longest way that a point of the body can have gone, metres.
    pub(crate) fn way(&self, info: &BodyInfo) -> f32 {
        self.motion.length() + self.turn.abs() * info.max_extent
    }
}

/// What [`run`] needs to know of the world's settings.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Options {
    pub(crate) dt: f32,
    /// Length of a plain substep, seconds.
    h: f32,
    pub(crate) continuous: bool,
    /// See [`Settings::length_unit`](crate::Settings).
    pub(crate) length_unit: f32,
    /// What the step adds to how nearly a slow body has settled.
    calm: u8,
}

impl Options {
    pub(crate) fn new(lengths: Lengths, continuous: bool, length_unit: f32) -> Self {
        let Lengths { dt, h, .. } = lengths;
        Self { dt, h, continuous, length_unit, calm: rests::calm_of(dt) }
    }
}

/// Bodies whose outline moves less than this fraction of their smallest half width in a step cannot jump.
pub(super) const SAFE_FRACTION: f32 = 0.5;

/// What goes off by more than this part of what the forces on it ask for is not held.
const HELD: f32 = 0.25;

/// What forces would take longer than this to get to its sleep speed may sleep, seconds: what floats swings on for long.
const PATIENCE: f32 = 20.0;

/// The same for what joints and contacts leave of them, seconds. They tremble.
const STEADY: f32 = 4.0;

/// What a body gains counts as along its velocity or against it from this square of the cosine on: a rope trembles across.
const CLEAR: f32 = 0.25;

/// What has gained for so long, seconds, and is still slower than this part of its sleep speed, squared, trembles: where substeps are
/// short, by more than [`STEADY`] allows for, and in the last of a step always the same way.
const TREMBLES: (f32, f32) = (0.25, 1.0e-4);

/// Bodies that one member of the team finalises at a time.
const CHUNK: usize = 128;

/// What finalising a chunk of bodies found.
#[derive(Clone, Debug, Default)]
pub(crate) struct Findings {
    moved: Moved,
    /// Fast bodies: their boxes are left for the continuous stage.
    pub(crate) fast: Vec<FastBody>,
    /// Fast kinematic bodies.
    pub(crate) carriers: Vec<FastBody>,
    /// Bodies whose numbers are no longer finite.
    pub(crate) broken: Vec<u32>,
}

crate::footprint::footprint!(Findings { moved, fast, carriers, broken });

/// Takes the motion of the step over into poses and boxes. `found` gets the findings by chunk, in the order of
/// the bodies; entries past the returned count are left over from other steps.
pub(crate) fn run(
    team: &Team,
    bodies: &mut Bodies,
    shapes: &mut Shapes,
    broad_phase: &mut BroadPhase,
    options: Options,
    found: &mut Vec<Findings>,
) -> usize {
    let Bodies { awake, rows, poses, previous, motions, starts, infos, .. } = bodies;
    let previous = SharedSlice::new(previous);
    let (rows, poses, infos) =
        (SharedSlice::new(rows), SharedSlice::new(poses), SharedSlice::new(infos));
    let chunks = boxes::share(shapes, broad_phase, |boxes| {
        team.map_chunks(awake.len(), CHUNK, found, |range, found| {
            found.moved.clear();
            found.fast.clear();
            found.carriers.clear();
            found.broken.clear();
            for &index in &awake[range] {
                rows.update(index, |row| {
                    poses.update(index, |pose| {
                        previous.write(index, *pose);
                        infos.update(index, |info| {
                            let (motion, start) =
                                (&motions[index as usize], &starts[index as usize]);
                            let body = FinalBody { index, row, pose, info, motion, start };
                            finalize_body(body, boxes, options, found);
                        });
                    });
                });
            }
        })
    });
    for chunk in &*chunks {
        boxes::take_over(shapes, broad_phase, &chunk.moved);
    }
    chunks.len()
}

/// A body on its way out of the step.
struct FinalBody<'a> {
    index: u32,
    row: &'a mut Row,
    pose: &'a mut Pose,
    info: &'a mut BodyInfo,
    /// What forces have added in the last substep, and the velocity that they had made before impulses.
    motion: &'a Motion,
    start: &'a [f32; 4],
}

#[inline]
fn finalize_body(body: FinalBody<'_>, boxes: Boxes<'_>, options: Options, found: &mut Findings) {
    let FinalBody { index, row, pose, info, motion: Motion { gain, .. }, start: base } = body;
    let motion = Vec2::new(row[Slot::DX], row[Slot::DY]);
    let turn = row[Slot::DA];
    // All eight at once, without a branch for each.
    if !row.iter().fold(true, |finite, value| finite & value.is_finite()) {
        found.broken.push(index);
        return;
    }
    row[Slot::DX] = 0.0;
    row[Slot::DY] = 0.0;
    row[Slot::DA] = 0.0;
    let start = *pose;
    *pose = Pose::new(start.p + motion, start.q.integrate(turn));
    let way = motion.length();
    time_rest(row, [way, turn], [base, gain], info, options);
    info.force = Vec2::ZERO;
    info.torque = 0.0;
    let reach = way + info.turned_reach(turn);
    if options.continuous && reach > SAFE_FRACTION * info.min_extent {
        let (end, lost) = (*pose, Vec2::ZERO);
        let fast = FastBody { body: index, start, end, motion, turn, lost, fraction: 1.0 };
        if info.kind == BodyKind::Dynamic {
            found.fast.push(fast);
            return;
        }
        found.carriers.push(fast);
    }
    boxes.follow(info.first_shape, *pose, motion, &mut found.moved);
}

/// Counts the time that a body has been slower than its sleep speed, by its velocity and by how far it went:
/// what is being pushed out of something has no velocity left at the end of a step. What is not held against the forces on it
/// does not rest, however slow it is yet.
#[inline]
fn time_rest(
    row: &Row,
    [way, turn]: [f32; 2],
    [base, gain]: [&[f32; 4]; 2],
    info: &mut BodyInfo,
    options: Options,
) {
    let Options { dt, h, length_unit, .. } = options;
    // All are finite.
    let larger = |a: f32, b: f32| if a > b { a } else { b };
    let speed = larger(Vec2::new(row[Slot::VX], row[Slot::VY]).length(), way / dt);
    let spin = larger(row[Slot::W].abs(), turn.abs() / dt);
    let extent = rests::turning_extent(info, length_unit);
    let fastest = larger(speed, spin * extent);
    info.calm = rests::calmer(info.calm, fastest / length_unit, options.calm);
    info.stirred = larger(info.stirred - dt, 0.0);
    // A platform that creeps must not stop.
    let limit = if info.kind == BodyKind::Dynamic { info.sleep_speed * length_unit } else { 0.0 };
    info.sleep_time = if info.can_sleep && fastest <= limit {
        let change = limit * h / REFINEMENT[usize::from(info.pace)] as f32;
        rested(info.sleep_time, row, [base, gain], [limit, change, extent, dt])
    } else {
        0.0
    };
}

/// How long a slow body has rested after a step. What swings is slow where it turns: there it gains speed as it goes, after it has
/// lost some. What rests, or swings slowly all along, gains next to nothing, or has gained some and loses it. Until then
/// the time counts below zero. `by`: its sleep speed, that by the substep's length, the radius at which turning counts, the
/// step's length.
fn rested(time: f32, row: &Row, [base, gain]: [&[f32; 4]; 2], by: [f32; 4]) -> f32 {
    let [limit, change, extent, dt] = by;
    let gained = [0, 1, 2].map(|k| row[k] - base[k] + gain[k]);
    let dot = |a: &[f32], b: &[f32]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2] * (extent * extent);
    let [along, size, speed] = [dot(&gained, row), dot(&gained, &gained), dot(row, row)];
    let clear = along * along > CLEAR * size * speed;
    let slow = speed < limit * limit * TREMBLES.1;
    match time {
        _ if !is_held(gained, gain, [change / PATIENCE, extent]) => 0.0,
        // What the guard of energy stops gains something and has nothing.
        _ if time > 0.0 || speed == 0.0 || size * STEADY * STEADY <= change * change => {
            time.abs() + dt
        }
        0.0 if clear && along < 0.0 => 0.0,
        _ if clear && along < 0.0 || slow && time < -TREMBLES.0 => dt - time,
        _ if clear || time < 0.0 || slow => time - dt,
        _ => 0.0,
    }
}

/// Is a body held against the forces on it, or is what they add to its speed in a substep no more than `most`?
fn is_held(gained: [f32; 3], gain: &[f32; 4], [most, extent]: [f32; 2]) -> bool {
    let yields = |k: usize| (gained[k] - HELD * gain[k]) * gain[k];
    yields(0) + yields(1) <= most * most && yields(2) * extent * extent <= most * most
}
