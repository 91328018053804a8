//! Bodies inside each other: from the start, deep, stuck, sinking; and those that never meet.

use crate::look::{About, Findings, Look, Sighting, Touch, Words, figure};
use crate::track::Track;
use crate::{Code, Severity};
use tiny_physics::{
    Body, BodyId, BodyKind, JointRef, QueryFilter, ShapeId, ShapeRef, World, contact,
};

/// Length units: what is less deep is never called deep.
const DEEP: f32 = 0.04;
/// Length units by which overlap has to grow to be sinking.
const SINKING: f32 = 0.01;
/// Seconds for which a hard hit may press bodies into each other, beyond the time in which that is pushed out.
const PASSING: f32 = 0.25;
/// Steps between two looks, of which nobody knows whether the overlap was there all the time.
const GAP: u64 = 16;
/// Length units a second at which overlap is pushed out at the defaults.
const PUSH: f32 = 0.4;
/// Seconds in its place after which a body has settled.
const SETTLED: f32 = 0.7;
/// Seconds after which overlap is no longer from the start.
const START: f32 = 1.0;

/// Looks at how deep its contacts are.
pub(crate) fn check(
    look: &Look<'_>,
    body: &Body<'_>,
    track: &mut Track,
    touches: &[Touch],
    findings: &mut Findings,
) {
    if body.kind() != BodyKind::Dynamic {
        return;
    }
    let deepest = touches.iter().copied().reduce(|a, b| if b.overlap > a.overlap { b } else { a });
    check_sinking(look, track, deepest.as_ref(), findings);
    if let Some(touch) = deepest.filter(|touch| touch.overlap > bound(look, touch)) {
        if look.step - track.deep_seen > GAP {
            (track.deep_since, track.deepest, track.crushed) = (None, 0.0, None);
        }
        track.deep_seen = look.step;
        let since = *track.deep_since.get_or_insert(look.step);
        track.deepest = track.deepest.max(touch.overlap);
        let age = (look.step - track.since) as f32 * look.dt;
        if age < START && track.placed.is_none() {
            at_start(look, body, track, &touch, findings);
        } else if since < look.step && !findings.has(Code::Sinking, About::Body(track.id)) {
            deep(look, body, track, touches, &touch, findings);
        }
    } else {
        (track.deep_since, track.deepest, track.crushed) = (None, 0.0, None);
    }
    track.overlap = deepest.map_or(0.0, |touch| touch.overlap);
}

/// Overlap of two shapes before the step, metres.
fn depth_before(look: &Look<'_>, body: &Body<'_>, touch: &Touch) -> f32 {
    let world = look.world;
    let shapes = world.shape(touch.own).zip(world.shape(touch.shape));
    let Some(((own, other), partner)) = shapes.zip(world.body(touch.body)) else { return 0.0 };
    let [mine, its] = [(body, &own), (&partner, &other)]
        .map(|(body, shape)| body.interpolated_pose(0.0).compose(shape.local()));
    contact(own.shape(), &mine, other.shape(), &its).map_or(0.0, |contact| contact.depth)
}

/// From which overlap on a contact is deep, metres.
fn bound(look: &Look<'_>, touch: &Touch) -> f32 {
    let thin = |id| look.world.shape(id).map_or(0.0, |shape| shape.shape().inner_radius());
    // A line has no thickness of its own.
    let (a, b) = (thin(touch.own), thin(touch.shape));
    let thinner = if a > 0.0 && (b == 0.0 || a < b) { a } else { b };
    (0.2 * thinner).max(DEEP * look.unit)
}

/// Was it inside something before its first step?
fn at_start(
    look: &Look<'_>,
    body: &Body<'_>,
    track: &Track,
    touch: &Touch,
    findings: &mut Findings,
) {
    // What locks hold there is told as stuck.
    let (locks, normal) = (body.locks(), touch.normal.abs());
    if locks.x && normal.x > 0.5 || locks.y && normal.y > 0.5 {
        return;
    }
    let known = findings.has(Code::OverlapAtStart, About::Body(track.id));
    let first = track.since == look.step && depth_before(look, body, touch) > bound(look, touch);
    if !first && !known {
        return;
    }
    let figure = figure("overlap", touch.overlap, bound(look, touch), " m");
    let seen =
        Sighting::new(Code::OverlapAtStart, Severity::Warning, About::Body(track.id), figure);
    findings.add(look, seen, || Words {
        what: format!("{} was created {:.3} m inside {} of {}", track.id, touch.overlap, touch.shape, touch.body),
        advice: "let bodies touch or leave a gap at the start: overlap is pushed apart, and piles jump or wedge",
        bodies: vec![track.id, touch.body],
        shapes: vec![touch.own, touch.shape],
        ..Words::default()
    });
}

fn deep(
    look: &Look<'_>,
    body: &Body<'_>,
    track: &mut Track,
    touches: &[Touch],
    touch: &Touch,
    findings: &mut Findings,
) {
    let cause = cause(look, body, track, touches, touch, findings);
    track.crushed = track.crushed.or(if let Cause::Crushed(by) = cause { Some(by) } else { None });
    // What it overlapped with from the start is told as that.
    let started = findings.has(Code::OverlapAtStart, About::Body(track.id));
    let inside = touch.overlap > 0.5 * track.thin && track.thin > 0.0;
    let seconds = seconds_deep(look, track);
    if track.still > 0.5 && seconds > 0.5 && inside && matches!(cause, Cause::Push) {
        report_stuck(look, body, track, touch, findings);
    } else if !started {
        report_deep(look, track, touch, &cause, findings);
    }
}

fn seconds_deep(look: &Look<'_>, track: &Track) -> f32 {
    track.deep_since.map_or(0.0, |since| (look.step - since) as f32 * look.dt)
}

/// It has fallen asleep: is it inside something?
pub(crate) fn slept(look: &Look<'_>, track: &Track, findings: &mut Findings) {
    let (bound, within) = (0.5 * track.thin, track.overlap);
    let sinks = findings.has(Code::Sinking, About::Body(track.id));
    let seen = track.deep_since.is_some() && look.step - track.deep_seen <= GAP;
    if sinks || track.crushed.is_some() || !seen || within < bound || bound == 0.0 {
        return;
    }
    let figure = figure("overlap", within, bound, " m");
    let seen = Sighting::new(Code::Stuck, Severity::Error, About::Body(track.id), figure);
    findings.add(look, seen, || Words {
        what: format!("{} fell asleep {within:.2} m inside another body", track.id),
        advice: "put it where there is room (overlap_shape tells); locks may keep it from being pushed out",
        bodies: vec![track.id],
        ..Words::default()
    });
}

/// Is it inside something that it collides with, and yet has no contact? Nothing pushes it then: level shapes that cover each
/// other have no surface there.
pub(crate) fn check_swallowed(
    look: &Look<'_>,
    body: &Body<'_>,
    track: &Track,
    findings: &mut Findings,
) {
    let own = body.shapes().filter_map(|id| look.world.shape(id)).find(|own| !own.is_sensor());
    let Some(own) = own.filter(|_| body.kind() == BodyKind::Dynamic && body.is_enabled()) else {
        return;
    };
    // Moving things may be let through by a hook of the program.
    let solid = |id: ShapeId| {
        look.world.shape(id).is_some_and(|other| {
            let partner = look.world.body(other.body());
            partner.is_some_and(|partner| partner.kind() == BodyKind::Static)
                && super::flight::collide(look.world, &own, &other)
        })
    };
    let filter = QueryFilter { filter: own.filter(), ..QueryFilter::new() };
    let filter = filter.exclude(track.id).predicate(&solid);
    let Some(&shape) = look.world.overlap_point(track.center, &filter).first() else { return };
    let Some(other) = look.world.shape(shape) else { return };
    let depth = contact(own.shape(), &own.pose(), other.shape(), &other.pose());
    let figure = figure("overlap", depth.map_or(0.0, |c| c.depth), 0.5 * track.thin, " m");
    let seen = Sighting::new(Code::Stuck, Severity::Error, About::Body(track.id), figure);
    findings.add(look, seen, || Words {
        what: format!(
            "the middle of {} is inside {}, and no contact pushes it out",
            track.id,
            other.body()
        ),
        advice: "put it where there is room (overlap_shape tells) before it may collide again",
        bodies: vec![track.id, other.body()],
        shapes: vec![own.id(), shape],
        ..Words::default()
    });
}

fn report_stuck(
    look: &Look<'_>,
    body: &Body<'_>,
    track: &Track,
    touch: &Touch,
    findings: &mut Findings,
) {
    let figure = figure("overlap", touch.overlap, 0.5 * track.thin, " m");
    let seen = Sighting::new(Code::Stuck, Severity::Error, About::Body(track.id), figure);
    let locks = body.locks();
    let locked = locks.x || locks.y;
    findings.add(look, seen, || Words {
        what: format!("{} is {:.2} m inside {} and does not come out", track.id, touch.overlap, touch.body),
        advice: if locked {
            "its locks keep it from being pushed out: unlock the axis, or put it elsewhere"
        } else if look.world.settings.push_speed * look.unit < 0.05 {
            "Settings::push_speed is so small that overlap is hardly pushed out: use the default"
        } else {
            "put it where there is room (overlap_shape tells), or make the gap that it is wedged in wider"
        },
        bodies: vec![track.id, touch.body],
        shapes: vec![touch.own, touch.shape],
        ..Words::default()
    });
}

/// Why a contact is deep.
enum Cause {
    Crushed(BodyId),
    Placed,
    Weight(f32),
    Push,
}

fn cause(
    look: &Look<'_>,
    body: &Body<'_>,
    track: &Track,
    touches: &[Touch],
    touch: &Touch,
    findings: &Findings,
) -> Cause {
    let world = look.world;
    let mut others = touches.iter().map(|touch| touch.body).chain([track.id]);
    let crusher = others.find(|&id| is_driven(look, id, track));
    if let Some(crusher) = track.crushed.or(crusher) {
        return Cause::Crushed(crusher);
    }
    let placed = track.placed.is_some_and(|step| look.step - step < 120);
    if placed || findings.has(Code::Teleport, About::Body(touch.body)) {
        return Cause::Placed;
    }
    let masses =
        touches.iter().filter_map(|touch| world.body(touch.body)).map(|other| other.mass());
    let heaviest = masses.fold(0.0, f32::max);
    let ratio = heaviest / body.mass().max(f32::MIN_POSITIVE);
    if ratio > 10.0 { Cause::Weight(ratio) } else { Cause::Push }
}

/// Does nothing stop a body: a kinematic one on its way, or one that a motor drives?
fn is_driven(look: &Look<'_>, id: BodyId, track: &Track) -> bool {
    let Some(body) = look.world.body(id) else { return false };
    let speed = body.velocity().length() + body.angular_velocity().abs() * track.size;
    let mut joints = body.joints().filter_map(|id| look.world.joint(id));
    match body.kind() {
        BodyKind::Kinematic => speed > 0.0,
        BodyKind::Dynamic => joints.any(|joint| super::joints::is_driven(joint.def())),
        BodyKind::Static => false,
    }
}

fn report_deep(
    look: &Look<'_>,
    track: &Track,
    touch: &Touch,
    cause: &Cause,
    findings: &mut Findings,
) {
    let figure = figure("overlap", touch.overlap, bound(look, touch), " m");
    // What is driven in is not pushed out.
    let pushed = matches!(cause, Cause::Push | Cause::Weight(_));
    let passes = PASSING + if pushed { track.deepest / (PUSH * look.unit) } else { 0.0 };
    let lasts = seconds_deep(look, track) > passes;
    let severity = if lasts { Severity::Warning } else { Severity::Note };
    let seen = Sighting::new(Code::DeepOverlap, severity, About::Body(track.id), figure);
    findings.add(look, seen, || {
        let start = format!("{} is {:.3} m inside {}", track.id, touch.overlap, touch.body);
        let (what, advice) = match cause {
            Cause::Crushed(by) => (
                if *by == track.id {
                    format!("{start}: a motor drives it there")
                } else {
                    format!("{start}: {by}, which nothing can stop, pushes it against something else")
                },
                "let the moved body stop or turn back when it meets resistance: make it dynamic and drive it by a motor of bounded force",
            ),
            Cause::Placed => (
                format!("{start}: it was put there"),
                "ask overlap_shape whether there is room before setting a position",
            ),
            Cause::Weight(ratio) => (
                format!("{start}: what presses on it is {ratio:.0} times as heavy"),
                "bring the masses closer together, or give the world more substeps",
            ),
            Cause::Push => (
                format!("{start} and is only slowly pushed out"),
                "raise Settings::push_speed, or look for what pushes it in: forces in each step, a joint, a crowd that does not fit",
            ),
        };
        Words { what, advice, bodies: vec![track.id, touch.body], shapes: vec![touch.own, touch.shape], ..Words::default() }
    });
}

fn check_sinking(
    look: &Look<'_>,
    track: &mut Track,
    deepest: Option<&Touch>,
    findings: &mut Findings,
) {
    let lies = |touch: &&Touch| track.still > SETTLED && touch.normal.dot(look.down()) < -0.5;
    let Some(touch) = deepest.filter(lies) else {
        track.resting_overlap = None;
        return;
    };
    let sunk = touch.overlap - *track.resting_overlap.get_or_insert(touch.overlap);
    let bound = SINKING * look.unit;
    track.sunk = if sunk < bound { 0 } else { track.sunk + 1 };
    if track.sunk < 3 {
        return;
    }
    let figure = figure("sunk by", sunk, bound, " m");
    let seen = Sighting::new(Code::Sinking, Severity::Warning, About::Body(track.id), figure);
    findings.add(look, seen, || Words {
        what: format!("{} rests, and yet it sinks into {}", track.id, touch.body),
        advice: "its contacts are too soft for the load: raise Settings::contact_hertz and substeps, or make what lies on it lighter",
        bodies: vec![track.id, touch.body],
        shapes: vec![touch.own, touch.shape],
        ..Words::default()
    });
}

/// Is it inside something that it never meets?
pub(crate) fn check_unmet(
    look: &Look<'_>,
    body: &Body<'_>,
    track: &Track,
    findings: &mut Findings,
) {
    if !body.is_awake() && body.is_enabled() {
        return;
    }
    let world = look.world;
    for own in body.shapes().filter_map(|id| world.shape(id)) {
        let never = |id: ShapeId| {
            let other = world.shape(id).and_then(|other| Some((world.body(other.body())?, other)));
            other.is_some_and(|(partner, other)| {
                obstacle(world, [body, &partner], [&own, &other]).is_some()
            })
        };
        let filter = QueryFilter::new().sensors().exclude(track.id).predicate(&never);
        for shape in world.overlap_shape(own.shape(), own.pose(), &filter).into_iter().take(8) {
            let Some(other) = world.shape(shape) else { continue };
            let Some(partner) = world.body(other.body()) else { continue };
            let depth = contact(own.shape(), &own.pose(), other.shape(), &other.pose())
                .map_or(0.0, |c| c.depth);
            let bound = 0.3 * thinner(&own, &other);
            if depth > bound {
                report_unmet(
                    look,
                    [body, &partner],
                    track,
                    [&own, &other],
                    [depth, bound],
                    findings,
                );
            }
        }
    }
}

fn thinner(a: &ShapeRef<'_>, b: &ShapeRef<'_>) -> f32 {
    let (a, b) = (a.shape().inner_radius(), b.shape().inner_radius());
    if a > 0.0 && (b == 0.0 || a < b) { a } else { b }
}

/// Why two shapes never meet.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Obstacle {
    Disabled,
    Sensor,
    Kinds,
    Joint,
    Group,
    OneMask,
    BothMasks,
}

fn obstacle(
    world: &World,
    [body, partner]: [&Body<'_>; 2],
    [own, other]: [&ShapeRef<'_>; 2],
) -> Option<Obstacle> {
    let (a, b) = (own.filter(), other.filter());
    let collides = a.collides(&b);
    if own.one_way().is_some() || other.one_way().is_some() {
        return None;
    }
    if !body.is_enabled() || !partner.is_enabled() {
        return Some(Obstacle::Disabled);
    }
    if own.is_sensor() || other.is_sensor() {
        return Some(Obstacle::Sensor);
    }
    if body.kind() != BodyKind::Dynamic && partner.kind() != BodyKind::Dynamic {
        return Some(Obstacle::Kinds);
    }
    if !collides {
        return Some(match (a.mask & b.category != 0, b.mask & a.category != 0) {
            _ if a.group == b.group && a.group < 0 => Obstacle::Group,
            (false, false) => Obstacle::BothMasks,
            _ => Obstacle::OneMask,
        });
    }
    let mut joints = body.joints().filter_map(|id| world.joint(id));
    let apart = joints.any(|joint| {
        joint.def().enabled
            && !joint.def().collide_connected
            && [joint.bodies().0, joint.bodies().1].contains(&partner.id())
            && !is_pinned(&joint, [own, other])
    });
    apart.then_some(Obstacle::Joint)
}

/// Is the pin of a joint in one of two shapes? They have to overlap then.
fn is_pinned(joint: &JointRef<'_>, shapes: [&ShapeRef<'_>; 2]) -> bool {
    let (a, b) = joint.anchors();
    shapes
        .iter()
        .any(|shape| [a, b].iter().any(|&pin| shape.shape().contains(shape.pose().unapply(pin))))
}

impl Obstacle {
    /// The reason, and what to do.
    fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Disabled => ("one of the bodies is not enabled", "call set_enabled(true)"),
            Self::Sensor => (
                "the falling shape is a sensor",
                "leave out `sensor`, or give the body a solid shape beside it",
            ),
            Self::Kinds => (
                "neither body is dynamic",
                "kinematic and static bodies never collide: make one dynamic, or lead it by cast_shape",
            ),
            Self::Joint => ("a joint connects them", "set JointDef::collide_connected"),
            Self::Group => ("both are in one negative group", "give one another group, or 0"),
            Self::OneMask => (
                "the mask of only one of them excludes the other",
                "each one's mask needs a bit of the other's category",
            ),
            Self::BothMasks => (
                "their masks exclude each other",
                "each one's mask needs a bit of the other's category",
            ),
        }
    }
}

fn report_unmet(
    look: &Look<'_>,
    [body, partner]: [&Body<'_>; 2],
    track: &Track,
    [own, other]: [&ShapeRef<'_>; 2],
    [depth, bound]: [f32; 2],
    findings: &mut Findings,
) {
    let Some(obstacle) = obstacle(look.world, [body, partner], [own, other]) else { return };
    let speed = track.velocity.dot(look.down());
    let falls = body.kind() == BodyKind::Dynamic && speed > 1.0 * look.unit || !body.is_enabled();
    let wide = other.shape().bounding_radius() > 4.0 * own.shape().bounding_radius();
    let ground = partner.kind() == BodyKind::Static && falls && wide;
    // Zones are meant to be entered; ground that one falls through is not.
    let zone = obstacle == Obstacle::Sensor && (!ground || other.is_sensor());
    if zone {
        return;
    }
    let meant = matches!(obstacle, Obstacle::Kinds | Obstacle::Joint);
    let severity = if ground && !meant { Severity::Warning } else { Severity::Note };
    let (why, advice) = obstacle.words();
    let figure = figure("overlap", depth, bound, " m");
    let seen = Sighting::new(Code::Filter, severity, About::Body(track.id), figure);
    findings.add(look, seen, || Words {
        what: format!("{} and {} overlap and never meet: {why}", track.id, partner.id()),
        advice,
        bodies: vec![track.id, partner.id()],
        shapes: vec![own.id(), other.id()],
        ..Words::default()
    });
}
