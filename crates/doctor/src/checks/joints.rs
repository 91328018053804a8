//! Joints: apart, beyond their limits, against each other.

use crate::look::{About, Findings, Look, Sighting, Words, figure};
use crate::{Code, Severity};
use std::collections::BTreeMap;
use tiny_physics::{
    BodyId, BodyKind, JointDef, JointId, JointKind, JointRef, Limits, Motor, Rot, Vec2,
};

/// Length units and radians of a limit that may be overrun.
const OVERRUN: [f32; 2] = [0.03, 0.07];

/// Seconds for which a knock may tear a joint apart.
const LASTING: f32 = 0.4;

/// Hertz of a pin's softness below which it gives way visibly.
const SOFT: f32 = 30.0;
/// Parts of the smaller body's size by which a weld made of springs may give way.
const SAG: f32 = 0.25;

/// What is remembered of joints that look ill.
#[derive(Default, Debug, Clone)]
pub(crate) struct Memory {
    ill: BTreeMap<JointId, Ill>,
    /// Does a joint do work by itself, or store it?
    pub(crate) driven: bool,
    driven_now: bool,
}

/// Since when a joint is ill.
#[derive(Clone, Copy, Debug, Default)]
struct Ill {
    apart_since: Option<u64>,
    /// Did it bear more than its bodies' weight when last seen awake?
    strained: bool,
    against_since: Option<u64>,
    over_since: Option<u64>,
    motor_since: Option<u64>,
}

impl Memory {
    pub(crate) fn begin_round(&mut self, look: &Look<'_>) {
        self.driven = core::mem::take(&mut self.driven_now);
        self.ill.retain(|&id, _| look.world.joint(id).is_some());
    }

    /// Bytes.
    pub(crate) fn memory(&self) -> usize {
        self.ill.len() * size_of::<(JointId, Ill)>()
    }
}

/// Does a joint of this kind do work by itself, or store it?
pub(crate) fn is_driven(def: &JointDef) -> bool {
    if !def.enabled {
        return false;
    }
    match &def.kind {
        JointKind::Mouse { .. } | JointKind::Motor { .. } => true,
        kind => motor(kind).is_some_and(|motor| motor.max > 0.0 && motor.speed != 0.0),
    }
}

fn motor(kind: &JointKind) -> Option<Motor> {
    match kind {
        JointKind::Distance { motor, .. }
        | JointKind::Revolute { motor, .. }
        | JointKind::Prismatic { motor, .. }
        | JointKind::Wheel { motor, .. } => *motor,
        _ => None,
    }
}

fn has_spring(kind: &JointKind) -> bool {
    match kind {
        JointKind::Distance { spring, .. }
        | JointKind::Revolute { spring, .. }
        | JointKind::Prismatic { spring, .. }
        | JointKind::Wheel { spring, .. } => spring.is_some(),
        JointKind::Weld { linear, angular } => linear.is_some() || angular.is_some(),
        _ => false,
    }
}

/// How a joint is: what it holds rigid, and what moves.
struct State {
    /// Metres by which it is apart.
    gap: f32,
    /// Its coordinate, and whether that is an angle.
    coordinate: Option<(f32, bool)>,
    limits: Option<Limits>,
}

fn state(look: &Look<'_>, joint: &JointRef<'_>) -> Option<State> {
    let def = joint.def();
    let (a, b) = joint.bodies();
    let (a, b) = (look.world.body(a)?, look.world.body(b)?);
    let (from, to) = joint.anchors();
    let way = to.relative_to(from);
    let frame_a = a.rotation().compose(Rot::from_angle(def.angle_a));
    let frame_b = b.rotation().compose(Rot::from_angle(def.angle_b));
    let along = way.dot(frame_a.x_axis());
    let across = way.dot(frame_a.y_axis());
    Some(match def.kind {
        JointKind::Revolute { limits, .. } => State {
            gap: way.length(),
            coordinate: Some((frame_b.angle_from(frame_a), true)),
            limits,
        },
        JointKind::Prismatic { limits, .. } | JointKind::Wheel { limits, .. } => {
            State { gap: across.abs(), coordinate: Some((along, false)), limits }
        }
        JointKind::Weld { .. } => State {
            gap: way.length(),
            coordinate: Some((frame_b.angle_from(frame_a), true)),
            limits: None,
        },
        JointKind::Distance { length, spring: None, limits: None, motor: None } => {
            State { gap: (way.length() - length).abs(), coordinate: None, limits: None }
        }
        JointKind::Distance { limits, .. } => {
            State { gap: 0.0, coordinate: Some((way.length(), false)), limits }
        }
        _ => State { gap: 0.0, coordinate: None, limits: None },
    })
}

pub(crate) fn check(
    look: &Look<'_>,
    joint: &JointRef<'_>,
    memory: &mut Memory,
    findings: &mut Findings,
) {
    let kind = &joint.def().kind;
    if !joint.def().enabled {
        memory.ill.remove(&joint.id());
        return;
    }
    memory.driven_now |= is_driven(joint.def()) || has_spring(kind);
    let Some(state) = state(look, joint) else { return };
    let ends = [joint.bodies().0, joint.bodies().1];
    let awake = ends.iter().filter_map(|&id| look.world.body(id)).any(|body| body.is_awake());
    let mut ill = memory.ill.get(&joint.id()).copied().unwrap_or_default();
    // Two that are as strong hold each other, and may sleep.
    check_rival_motor(look, joint, ends, &mut ill.against_since, findings);
    if awake {
        look_closer(look, joint, ends, &state, &mut ill, findings);
    } else {
        fell_asleep_apart(look, joint, ends, &state, ill, findings);
        ill = Ill { against_since: ill.against_since, ..Ill::default() };
    }
    let since = [ill.apart_since, ill.over_since, ill.motor_since, ill.against_since];
    if since.iter().any(Option::is_some) {
        memory.ill.insert(joint.id(), ill);
    } else {
        memory.ill.remove(&joint.id());
    }
}

/// What can be wrong with a joint that is awake.
fn look_closer(
    look: &Look<'_>,
    joint: &JointRef<'_>,
    ends: [BodyId; 2],
    state: &State,
    ill: &mut Ill,
    findings: &mut Findings,
) {
    check_ratio(look, joint, ends, findings);
    check_springs(look, joint, ends, state, &mut ill.apart_since, findings);
    check_gap(look, joint, ends, state, ill, findings);
    check_limits(look, joint, ends, state, &mut ill.over_since, findings);
    check_motor(look, joint, ends, state, &mut ill.motor_since, findings);
}

/// Radius that holds all shapes of a body, metres.
fn size(look: &Look<'_>, id: BodyId) -> f32 {
    let Some(body) = look.world.body(id) else { return 0.0 };
    let shapes = body.shapes().filter_map(|id| look.world.shape(id));
    shapes.map(|shape| shape.shape().bounding_radius()).fold(0.0, f32::max)
}

/// The smaller of the sizes of the bodies that move, metres.
fn smaller(look: &Look<'_>, ends: [BodyId; 2]) -> f32 {
    let moving = ends
        .into_iter()
        .filter(|&id| look.world.body(id).is_some_and(|body| body.kind() != BodyKind::Static));
    moving.map(|id| 2.0 * size(look, id)).filter(|size| *size > 0.0).fold(f32::INFINITY, f32::min)
}

/// From which gap on a joint is apart, metres, and what that is told by: the size of the smaller body.
fn gap_bound(look: &Look<'_>, ends: [BodyId; 2]) -> (f32, f32) {
    let size = smaller(look, ends);
    let size = if size.is_finite() { size } else { look.unit };
    ((0.02 * size).max(0.01 * look.unit), size)
}

fn check_gap(
    look: &Look<'_>,
    joint: &JointRef<'_>,
    ends: [BodyId; 2],
    state: &State,
    ill: &mut Ill,
    findings: &mut Findings,
) {
    if is_sprung(&joint.def().kind) {
        return;
    }
    let (bound, size) = gap_bound(look, ends);
    if state.gap < bound {
        ill.apart_since = None;
        return;
    }
    let first = *ill.apart_since.get_or_insert(look.step);
    let seconds = (look.step - first) as f32 * look.dt;
    ill.strained = is_strained(look, joint, ends, state);
    if seconds > 0.75 && ill.strained {
        report_fight(look, joint, ends, [state.gap, bound], findings);
    } else if first < look.step && state.gap > (0.03 * size).max(0.02 * look.unit) {
        // A knock may tear a joint apart for a moment.
        let lasts = seconds > LASTING || state.gap > 0.5 * size;
        let severity = if lasts { Severity::Warning } else { Severity::Note };
        report_stretch(look, joint, ends, [state.gap, bound], severity, findings);
    }
}

/// What sleeps bears nothing any more, but it may have fallen asleep while two things tore at it.
fn fell_asleep_apart(
    look: &Look<'_>,
    joint: &JointRef<'_>,
    ends: [BodyId; 2],
    state: &State,
    ill: Ill,
    findings: &mut Findings,
) {
    let (bound, _) = gap_bound(look, ends);
    if ill.apart_since.is_some() && ill.strained && state.gap > bound {
        report_fight(look, joint, ends, [state.gap, bound], findings);
    }
}

/// Is a joint springy where it would else be rigid?
fn is_sprung(kind: &JointKind) -> bool {
    matches!(kind, JointKind::Weld { linear, angular } if linear.is_some() || angular.is_some())
}

/// A weld made of springs gives way by much.
fn check_springs(
    look: &Look<'_>,
    joint: &JointRef<'_>,
    ends: [BodyId; 2],
    state: &State,
    since: &mut Option<u64>,
    findings: &mut Findings,
) {
    let size = smaller(look, ends);
    if !is_sprung(&joint.def().kind) || !size.is_finite() {
        return;
    }
    // What it has turned moves the far end of the smaller body.
    let turned = state.coordinate.map_or(0.0, |(angle, _)| angle.abs() * size);
    let (gap, bound) = (state.gap.max(turned), SAG * size);
    if gap < bound {
        *since = None;
        return;
    }
    let first = *since.get_or_insert(look.step);
    if (look.step - first) as f32 * look.dt > LASTING {
        report_stretch(look, joint, ends, [gap, bound], Severity::Note, findings);
    }
}

/// Does it turn or push from the second of `ends` to the first? Lengths between two bodies have no first.
fn swaps(joint: &JointRef<'_>, ends: [BodyId; 2]) -> bool {
    joint.bodies().0 != ends[0] && !matches!(joint.def().kind, JointKind::Distance { .. })
}

/// Do two motors between the same bodies want different speeds, so that one of them never gets its own?
fn check_rival_motor(
    look: &Look<'_>,
    joint: &JointRef<'_>,
    ends: [BodyId; 2],
    since: &mut Option<u64>,
    findings: &mut Findings,
) {
    // Its speed as one from the first of `ends` to the second.
    let works = |joint: &JointRef<'_>| {
        let motor = motor(&joint.def().kind).filter(|motor| joint.def().enabled && motor.max > 0.0);
        let speed = |motor: Motor| if swaps(joint, ends) { -motor.speed } else { motor.speed };
        motor.map(speed)
    };
    let body = ends.iter().filter_map(|&id| look.world.body(id));
    let rival = works(joint).and_then(|mine| {
        let mut others = body.flat_map(|body| body.joints()).filter_map(|id| look.world.joint(id));
        let same = |other: &JointRef<'_>| {
            let (a, b) = other.bodies();
            other.id() != joint.id() && ends.contains(&a) && ends.contains(&b)
        };
        let differ = |other: &JointRef<'_>| {
            works(other).is_some_and(|its| (its - mine).abs() > 0.2 * mine.abs())
        };
        others.find(|other| same(other) && differ(other)).map(|other| (mine, other))
    });
    let Some((mine, rival)) = rival else {
        *since = None;
        return;
    };
    let seconds = (look.step - *since.get_or_insert(look.step)) as f32 * look.dt;
    if seconds < 0.75 {
        return;
    }
    let its = works(&rival).unwrap_or_default();
    let (apart, bound) = ((its - mine).abs(), 0.2 * mine.abs());
    let figure = figure("speeds apart", apart, bound, "/s");
    let seen = Sighting::new(Code::JointFight, Severity::Warning, About::Joint(joint.id()), figure);
    findings.add(look, seen, || Words {
        what: format!("the motors of {} and {} want different speeds", joint.id(), rival.id()),
        advice: "leave one of them: two motors between the same bodies only heat each other",
        bodies: ends.to_vec(),
        joints: vec![joint.id(), rival.id()],
        ..Words::default()
    });
}

/// Do its bodies stand still under a load that their weight does not explain? A limit that is overrun, and a pin that was made
/// soft, explain it.
fn is_strained(look: &Look<'_>, joint: &JointRef<'_>, ends: [BodyId; 2], state: &State) -> bool {
    let limits = state.limits.zip(state.coordinate);
    let overrun = limits.is_some_and(|(limits, (at, turns))| {
        turned(at, turns, limits) > if turns { OVERRUN[1] } else { OVERRUN[0] * look.unit }
    });
    if overrun || joint.def().softness.is_some_and(|softness| softness.hertz < SOFT) {
        return false;
    }
    let bodies = ends.map(|id| look.world.body(id));
    let still = bodies.iter().flatten().all(|body| {
        body.velocity().length() < 0.2 * look.unit && body.angular_velocity().abs() < 0.5
    });
    let weight: f32 =
        bodies.iter().flatten().map(|body| body.mass()).sum::<f32>() * look.world.gravity.length();
    still
        && (joint.force().length() > 5.0 * weight
            || joint.torque().abs() > 5.0 * weight * size(look, ends[1]))
}

fn report_fight(
    look: &Look<'_>,
    joint: &JointRef<'_>,
    ends: [BodyId; 2],
    [gap, bound]: [f32; 2],
    findings: &mut Findings,
) {
    let figure = figure("apart", gap, bound, " m");
    let seen = Sighting::new(Code::JointFight, Severity::Warning, About::Joint(joint.id()), figure);
    let rivals: Vec<JointId> = ends
        .iter()
        .filter_map(|&id| look.world.body(id))
        .flat_map(|body| body.joints())
        .filter(|&id| id != joint.id())
        .take(3)
        .collect();
    findings.add(look, seen, || Words {
        what: match rivals.first() {
            Some(rival) => format!("{} and {rival} exclude each other: both cannot hold", joint.id()),
            None => format!("{} cannot hold: a contact or something that does not move is in its way", joint.id()),
        },
        advice: "remove one of the joints, or give it a spring; two hinges between two bodies are a weld",
        bodies: ends.to_vec(),
        joints: core::iter::once(joint.id()).chain(rivals).collect(),
        ..Words::default()
    });
}

fn report_stretch(
    look: &Look<'_>,
    joint: &JointRef<'_>,
    ends: [BodyId; 2],
    [gap, bound]: [f32; 2],
    severity: Severity,
    findings: &mut Findings,
) {
    let figure = figure("apart", gap, bound, " m");
    let seen = Sighting::new(Code::JointStretch, severity, About::Joint(joint.id()), figure);
    let led = ends
        .iter()
        .filter_map(|&id| look.world.body(id))
        .any(|body| body.kind() == BodyKind::Kinematic && body.velocity().length() > 0.0);
    let masses = ends.map(|id| look.world.body(id).map_or(0.0, |body| body.mass()));
    let soft = joint.def().softness.is_some_and(|spring| spring.hertz < SOFT);
    findings.add(look, seen, || Words {
        what: format!("{} is apart by {gap:.3} m", joint.id()),
        advice: if is_sprung(&joint.def().kind) {
            "the spring of the weld is too soft for its load: raise its hertz, or leave it out"
        } else if soft {
            "its softness makes it give way: leave it out, or raise its hertz"
        } else if led {
            "one of its bodies goes where it is led, and the other one cannot follow: lead it by forces, or let the joint break"
        } else if masses[0].min(masses[1]) > 0.0
            && masses[0].max(masses[1]) > 20.0 * masses[0].min(masses[1])
        {
            "bring the masses of its bodies closer together, or add a rope from end to end"
        } else {
            "put its anchors together when you add it; raise substeps; look for what pulls at it"
        },
        bodies: ends.to_vec(),
        joints: vec![joint.id()],
        ..Words::default()
    });
}

/// How far a coordinate is outside its limits; negative inside.
fn overrun(coordinate: f32, limits: Limits) -> f32 {
    (limits.lower - coordinate).max(coordinate - limits.upper)
}

fn check_limits(
    look: &Look<'_>,
    joint: &JointRef<'_>,
    ends: [BodyId; 2],
    state: &State,
    since: &mut Option<u64>,
    findings: &mut Findings,
) {
    let (Some((coordinate, turns)), Some(limits)) = (state.coordinate, state.limits) else {
        return;
    };
    let bound = if turns { OVERRUN[1] } else { OVERRUN[0] * look.unit };
    let over = turned(coordinate, turns, limits);
    if over < bound {
        *since = None;
        return;
    }
    // By a little it may be knocked for a moment.
    if *since.get_or_insert(look.step) == look.step && over < 3.0 * bound {
        return;
    }
    let figure = figure("beyond its limit", over, bound, if turns { " rad" } else { " m" });
    let seen =
        Sighting::new(Code::LimitOverrun, Severity::Warning, About::Joint(joint.id()), figure);
    findings.add(look, seen, || Words {
        what: format!("{} is {over:.3} {} beyond its limits", joint.id(), if turns { "rad" } else { "m" }),
        advice: "add the joint with its bodies inside the limits; look for a motor or load that is too strong for bodies so light",
        bodies: ends.to_vec(),
        joints: vec![joint.id()],
        ..Words::default()
    });
}

/// Overrun of an angle in the turn in which it is least, or of a distance.
fn turned(coordinate: f32, turns: bool, limits: Limits) -> f32 {
    let whole = core::f32::consts::TAU;
    if turns {
        [coordinate - whole, coordinate, coordinate + whole]
            .into_iter()
            .map(|angle| overrun(angle, limits))
            .fold(f32::INFINITY, f32::min)
    } else {
        overrun(coordinate, limits)
    }
}

fn check_motor(
    look: &Look<'_>,
    joint: &JointRef<'_>,
    ends: [BodyId; 2],
    state: &State,
    since: &mut Option<u64>,
    findings: &mut Findings,
) {
    let pushes = || {
        let (coordinate, _) = state.coordinate?;
        let (limits, motor) = (state.limits?, motor(&joint.def().kind)?);
        let near = 0.02 * (limits.upper - limits.lower).max(0.1);
        let at_end = if motor.speed > 0.0 {
            coordinate > limits.upper - near
        } else {
            coordinate < limits.lower + near
        };
        (motor.max > 0.0 && motor.speed != 0.0 && at_end).then_some(())
    };
    if pushes().is_none() {
        *since = None;
        return;
    }
    let seconds = (look.step - *since.get_or_insert(look.step)) as f32 * look.dt;
    if seconds < 0.3 {
        return;
    }
    let figure = figure("at its end for", seconds, 0.3, " s");
    let seen = Sighting::new(Code::MotorAtLimit, Severity::Note, About::Joint(joint.id()), figure);
    findings.add(look, seen, || Words {
        what: format!("the motor of {} pushes into its limit", joint.id()),
        advice: "turn the motor off where it has arrived, or let it hold with little force",
        bodies: ends.to_vec(),
        joints: vec![joint.id()],
        ..Words::default()
    });
}

fn check_ratio(look: &Look<'_>, joint: &JointRef<'_>, ends: [BodyId; 2], findings: &mut Findings) {
    if matches!(joint.def().kind, JointKind::Filter | JointKind::Mouse { .. }) {
        return;
    }
    let [a, b] = ends.map(|id| look.world.body(id).filter(|body| body.kind() == BodyKind::Dynamic));
    let (Some(a), Some(b)) = (a, b) else { return };
    let (light, heavy) = if a.mass() < b.mass() { (a, b) } else { (b, a) };
    let way: Vec2 = heavy.center().relative_to(light.center());
    // What hangs on a light body, or stands on it: not a small thing on a large one.
    let carries = way.dot(look.down()) > 0.0 && light.joints().count() > 1;
    if carries {
        let ratio = heavy.mass() / light.mass().max(f32::MIN_POSITIVE);
        super::scale::report_ratio(
            look,
            [light.id(), heavy.id()],
            ratio,
            Some(joint.id()),
            findings,
        );
    }
}
