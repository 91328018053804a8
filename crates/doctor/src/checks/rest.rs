//! Bodies that should be at rest: jitter, and what keeps them awake.

use crate::finding::Figure;
use crate::look::{About, Findings, Look, Sighting, Touch, Words, figure};
use crate::track::{SHAKING, Track, VISIBLE};
use crate::{Code, Severity};
use tiny_physics::{Body, BodyKind, JointRef};

/// Seconds of shaking before it is called jitter.
const JITTER: f32 = 1.5;
/// Seconds at one place and awake.
const AWAKE: f32 = 5.0;
/// Wakings at one place.
const WAKINGS: u32 = 10;

/// Does a body call for a thorough look?
pub(crate) fn calls(look: &Look<'_>, body: &Body<'_>, track: &Track) -> bool {
    let bound = 1.0 * look.unit + 3.0 * look.pull * look.dt;
    if (track.velocity - track.before).length_sq() > bound * bound {
        return true;
    }
    let turn = look.step + track.id.index() as u64;
    if !turn.is_multiple_of(4) {
        return false;
    }
    let young = look.step - track.since < 6;
    let falling = track.free > 0.2 && track.velocity.length_sq() > look.unit * look.unit;
    let restless = track.still > AWAKE && turn.is_multiple_of(32);
    track.shaking > JITTER
        || track.deep_since.is_some()
        || young
        || restless
        || falling && body.joints().next().is_none()
}

pub(crate) fn check(
    look: &Look<'_>,
    body: &Body<'_>,
    track: &mut Track,
    touches: &[Touch],
    findings: &mut Findings,
) {
    note_normal(track, touches);
    let shaking = track.shaking > JITTER;
    if shaking && !touches_moved(look, touches) {
        jitter(look, body, track, touches, findings);
    } else if track.still > AWAKE {
        never_sleeps(look, body, track, touches, findings);
    }
}

/// Counts how often the normal of its deepest contact, if that is with the same shape, has turned by over 20 degrees.
fn note_normal(track: &mut Track, touches: &[Touch]) {
    let deepest = touches.iter().max_by(|a, b| a.overlap.total_cmp(&b.overlap));
    let now = deepest.map(|touch| (touch.shape, touch.normal));
    if let (Some((shape, normal)), Some((before, old))) = (now, track.normal) {
        track.normal_flips += u32::from(shape == before && normal.dot(old) < 0.94);
    }
    track.normal = now;
    if track.still == 0.0 {
        track.normal_flips = 0;
    }
}

fn touches_moved(look: &Look<'_>, touches: &[Touch]) -> bool {
    touches.iter().filter_map(|touch| look.world.body(touch.body)).any(|other| {
        other.kind() == BodyKind::Kinematic
            && (other.velocity().length() > 0.0 || other.angular_velocity() != 0.0)
    })
}

/// A joint of the body with a motor that is at work.
fn motor_of<'a>(look: &Look<'a>, body: &Body<'a>) -> Option<JointRef<'a>> {
    let joints = body.joints().filter_map(|id| look.world.joint(id));
    joints.into_iter().find(|joint| super::joints::is_driven(joint.def()))
}

fn jitter(
    look: &Look<'_>,
    body: &Body<'_>,
    track: &Track,
    touches: &[Touch],
    findings: &mut Findings,
) {
    let figure = figure("speed at rest", track.speed, SHAKING * look.unit, " m/s");
    // A pile that settles may shake for a while.
    let lasts = track.shaking > 2.0 * JITTER;
    let severity = if lasts { Severity::Warning } else { Severity::Note };
    let seen = Sighting::new(Code::Jitter, severity, About::Body(track.id), figure);
    let motor = motor_of(look, body);
    findings.add(look, seen, || {
        let (why, advice) = if let Some(joint) = &motor {
            (format!("; {} drives it", joint.id()), "lower the motor's greatest force, or turn the motor off at its limit")
        } else if body.joints().next().is_some() {
            (", and joints hold it".to_owned(), "look for joints that exclude each other or are too stiff; add damping or joint friction")
        } else if track.normal_flips > 2 {
            ("; the normal of a contact flips".to_owned(), "it lies on a corner or between two faces: give it room or a rounder shape, and look at --trace")
        } else if look.pushed {
            (", and the program pushes bodies in every step".to_owned(), "a force or velocity that is set in each step overshoots: leave a range in which nothing is set, or damp it")
        } else if track.size < 0.05 * look.unit {
            ("; it is very small".to_owned(), "set Settings::length_unit to the size of a usual body")
        } else if touches.is_empty() {
            (", though it touches nothing".to_owned(), "something is set in each step: a force, a velocity or a position")
        } else {
            (String::new(), "look for a force, velocity or position that is set in each step; else make overlap at the start, mass ratios and restitution smaller")
        };
        Words {
            what: format!("{} is at rest and yet shakes at {:.2} m/s{why}", track.id, track.speed),
            advice,
            bodies: vec![track.id],
            figures: vec![stroke(look, track)],
            joints: motor.iter().map(|joint| joint.id()).collect(),
            ..Words::default()
        }
    });
}

fn stroke(look: &Look<'_>, track: &Track) -> Figure {
    figure("to and fro by", track.stroke(look), VISIBLE * look.unit, " m")
}

fn never_sleeps(
    look: &Look<'_>,
    body: &Body<'_>,
    track: &Track,
    touches: &[Touch],
    findings: &mut Findings,
) {
    if track.speed > 2.0 * body.sleep_speed().max(0.05) * look.unit {
        return;
    }
    let figure = figure("awake at rest for", track.still, AWAKE, " s");
    let (why, advice, severity) = what_keeps_awake(look, body, track, touches);
    let severity = if track.still > 3.0 * AWAKE { severity } else { Severity::Note };
    let seen = Sighting::new(Code::NeverSleeps, severity, About::Body(track.id), figure);
    findings.add(look, seen, || Words {
        what: format!("{} is at rest and stays awake: {why}", track.id),
        advice,
        bodies: vec![track.id],
        ..Words::default()
    });
}

/// It has woken once more.
pub(crate) fn woke(look: &Look<'_>, track: &mut Track, findings: &mut Findings) {
    track.wakings += 1;
    if track.wakings < WAKINGS {
        return;
    }
    let figure = figure("woken", track.wakings as f32, WAKINGS as f32, " times");
    let seen = Sighting::new(Code::NeverSleeps, Severity::Note, About::Body(track.id), figure);
    findings.add(look, seen, || Words {
        what: format!("{} is at rest and was woken {} times", track.id, track.wakings),
        advice: "call wake, set_velocity, apply_force, set_position and the like only where something has to change",
        bodies: vec![track.id],
        ..Words::default()
    });
}

fn what_keeps_awake(
    look: &Look<'_>,
    body: &Body<'_>,
    track: &Track,
    touches: &[Touch],
) -> (String, &'static str, Severity) {
    let world = look.world;
    if !world.settings.sleep {
        return (
            "sleep is off".to_owned(),
            "turn Settings::sleep on if bodies at rest shall cost nothing",
            Severity::Note,
        );
    }
    let neighbours = || touches.iter().filter_map(|touch| world.body(touch.body));
    if !body.can_sleep() {
        return ("it is told never to sleep".to_owned(), "set can_sleep(true)", Severity::Note);
    }
    if let Some(other) =
        neighbours().find(|other| !other.can_sleep() && other.kind() == BodyKind::Dynamic)
    {
        return (
            format!("{}, which it touches, is told never to sleep", other.id()),
            "set can_sleep(true) there",
            Severity::Note,
        );
    }
    if touches_moved(look, touches) {
        return (
            "it lies on a body that is moved".to_owned(),
            "let the moved body stand still when it has arrived (velocity 0)",
            Severity::Note,
        );
    }
    if let Some(joint) = motor_of(look, body) {
        return (
            format!("the motor of {} is at work", joint.id()),
            "turn motors off that have arrived",
            Severity::Note,
        );
    }
    if touches.iter().any(|touch| belt(look, touch)) {
        return (
            "a belt runs under it".to_owned(),
            "stop belts that nobody looks at",
            Severity::Note,
        );
    }
    if track.speed > body.sleep_speed() * look.unit {
        return (
            "it never gets slow enough".to_owned(),
            "raise sleep_speed for it, or find what shakes it",
            Severity::Warning,
        );
    }
    if look.pushed {
        return (
            "the program pushes bodies in every step".to_owned(),
            "call apply_force, set_velocity and the like only where something has to change",
            Severity::Warning,
        );
    }
    let advice = "a call in each step keeps it awake (apply_force, set_velocity, wake), or its island holds something restless";
    ("nothing that can be seen moves it".to_owned(), advice, Severity::Warning)
}

fn belt(look: &Look<'_>, touch: &Touch) -> bool {
    look.is_belt(touch.own) || look.is_belt(touch.shape)
}
