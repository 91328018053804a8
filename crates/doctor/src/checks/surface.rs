//! What happens where a body meets a surface: bumps at seams, bounces that do not come.

use crate::look::{About, Findings, Look, Sighting, Touch, Words, figure};
use crate::track::Track;
use crate::{Code, Severity};
use tiny_physics::geometry::Ray;
use tiny_physics::{Body, BodyKind, ShapeId, ShapeRef, Vec2};

/// Metres a second, by the length unit, lost at least in a bump.
const BUMP: f32 = 0.3;

pub(crate) fn check(
    look: &Look<'_>,
    body: &Body<'_>,
    track: &Track,
    touches: &[Touch],
    findings: &mut Findings,
) {
    near_miss(look, track, touches, findings);
    ghost_bump(look, track, touches, findings);
    for touch in touches {
        restitution(look, body, track, touch, findings);
    }
    if body.kind() == BodyKind::Dynamic {
        mass_ratio(look, body, track, touches, findings);
    }
}

/// Was it stopped by something thinner than its step is long?
fn near_miss(look: &Look<'_>, track: &Track, touches: &[Touch], findings: &mut Findings) {
    let step = track.before.length() * look.dt;
    if step < 0.05 * look.unit {
        return;
    }
    for touch in touches {
        let Some(other) = look.world.shape(touch.shape) else { continue };
        let thickness = 2.0 * track.thin + 2.0 * other.shape().inner_radius();
        let head_on = -track.before.dot(touch.normal) > 0.7 * track.before.length();
        if !head_on || step <= thickness {
            continue;
        }
        let figure = figure("step", step, thickness, " m");
        let seen = Sighting::new(Code::NearMiss, Severity::Note, About::Body(track.id), figure);
        findings.add(look, seen, || Words {
            what: format!("{} came at {} by {step:.2} m a step, more than both are thick: only the sweep stopped it", track.id, touch.body),
            advice: "keep Settings::continuous on; a shorter step or thicker walls leave more room",
            bodies: vec![track.id, touch.body],
            shapes: vec![touch.shape],
            ..Words::default()
        });
    }
}

/// Did it lose speed where two shapes meet?
fn ghost_bump(look: &Look<'_>, track: &Track, touches: &[Touch], findings: &mut Findings) {
    let lost = (track.before - track.velocity).length();
    if touches.len() < 2 || lost < BUMP * look.unit {
        return;
    }
    let fixed = || touches.iter().filter(|touch| is_fixed(look, touch));
    for floor in fixed() {
        // Along the surface that it slides on.
        let up = floor.normal;
        let (along, speed) = (track.before - up * track.before.dot(up)).direction_and_length();
        let lost = speed - track.velocity.dot(along);
        // What lands is slowed by friction.
        let landing = (-track.before.dot(up)).max(0.0);
        let bound = (0.03 * speed).max(BUMP * look.unit) + 1.5 * look.pull * look.dt + landing;
        if speed < 1.0 * look.unit || lost < bound {
            continue;
        }
        // What it runs into by itself stops it without a seam.
        let run_into = |touch: &Touch| !is_fixed(look, touch) && touch.normal.dot(along) < -0.2;
        if touches.iter().any(run_into) {
            continue;
        }
        let meets = |step: &&Touch| step.shape != floor.shape && step.normal.dot(along) < -0.2;
        let Some((step, ledge)) = fixed()
            .filter(meets)
            .find_map(|step| Some((step, ledge(look, track, floor, step, along)?)))
        else {
            continue;
        };
        return report_bump(look, track, [floor, step], [lost, speed, bound, ledge], findings);
    }
}

/// By how much a shape stands out ahead of a surface that it goes on with, metres; `None` where it is a wall or a slope.
fn ledge(look: &Look<'_>, track: &Track, floor: &Touch, step: &Touch, along: Vec2) -> Option<f32> {
    let up = floor.normal;
    let height = |shape: ShapeId, at: Vec2| {
        let shape = look.world.shape(shape)?;
        let (pose, from) = (shape.pose(), track.center + at);
        let ray = Ray::new(pose.unapply(from), pose.q.unrotate(up * (-3.0 * track.size)));
        let hit = shape.shape().ray_cast(&ray).filter(|hit| hit.fraction > 0.0)?;
        let level = pose.q.rotate(hit.normal).dot(up) > 0.98;
        level.then_some(-3.0 * track.size * hit.fraction)
    };
    let places = |sign: f32| [1.05, 0.7, 0.35, 0.0].map(|part| along * (sign * part * track.size));
    let ahead = places(1.0).into_iter().find_map(|at| height(step.shape, at))?;
    let behind = places(-1.0).into_iter().rev().find_map(|at| height(floor.shape, at))?;
    let ledge = ahead - behind;
    (ledge.abs() < 0.2 * track.size).then_some(ledge)
}

fn report_bump(
    look: &Look<'_>,
    track: &Track,
    [floor, step]: [&Touch; 2],
    [lost, speed, bound, ledge]: [f32; 4],
    findings: &mut Findings,
) {
    let seen = figure("speed lost", lost, bound, " m/s");
    let seen = Sighting::new(Code::GhostBump, Severity::Warning, About::Body(track.id), seen);
    findings.add(look, seen, || Words {
        what: format!(
            "{} lost {lost:.1} of {speed:.1} m/s where {} and {} meet, {:.1} mm apart in height",
            track.id,
            floor.shape,
            step.shape,
            1000.0 * ledge
        ),
        advice: "let the surfaces be level and leave no slit: chains and tile grids have no seams; round the mover's corners (a capsule)",
        bodies: vec![track.id],
        shapes: vec![floor.shape, step.shape],
        figures: vec![figure("ledge", ledge.abs(), 0.2 * track.size, " m")],
        ..Words::default()
    });
}

/// Is it part of the level: static, or a body that is led and stands still?
fn is_fixed(look: &Look<'_>, touch: &Touch) -> bool {
    look.world.body(touch.body).is_some_and(|body| match body.kind() {
        BodyKind::Static => true,
        BodyKind::Kinematic => body.velocity() == Vec2::ZERO && body.angular_velocity() == 0.0,
        BodyKind::Dynamic => false,
    })
}

/// Should it have bounced?
fn restitution(
    look: &Look<'_>,
    body: &Body<'_>,
    track: &Track,
    touch: &Touch,
    findings: &mut Findings,
) {
    let world = look.world;
    let approach = -track.before.dot(touch.normal);
    if approach < 0.5 * look.unit || body.kind() != BodyKind::Dynamic {
        return;
    }
    let restitution =
        |shape: Option<ShapeRef<'_>>| shape.map_or(0.0, |shape| shape.material().restitution);
    let (own, other) = (restitution(world.shape(touch.own)), restitution(world.shape(touch.shape)));
    let (most, mixed) = (own.max(other), world.settings.restitution_mix.apply(own, other));
    if most < 0.2 || own < most {
        return;
    }
    let threshold = world.settings.restitution_threshold * look.unit;
    let by_mix = mixed < 0.34 * most;
    let by_speed = !by_mix
        && approach < threshold
        && track.flew > 0.03
        && approach * approach > 0.4 * look.pull * track.size;
    if !by_mix && !by_speed {
        return;
    }
    let figure = figure("restitution asked for", most, 0.2, "");
    let seen = Sighting::new(Code::RestitutionLost, Severity::Note, About::Body(track.id), figure);
    findings.add(look, seen, || Words {
        what: if by_mix {
            format!(
                "{} has restitution {own:.2}, but with {} ({other:.2}) the mix is {mixed:.2}",
                track.id, touch.shape
            )
        } else {
            format!(
                "{} hits at {approach:.2} m/s, below the restitution threshold of {threshold:.2}",
                track.id
            )
        },
        advice: if by_mix {
            "give both materials a restitution, or set Settings::restitution_mix to Mix::Max"
        } else {
            "lower Settings::restitution_threshold, or set length_unit to the size of a usual body"
        },
        bodies: vec![track.id, touch.body],
        shapes: vec![touch.own, touch.shape],
        ..Words::default()
    });
}

/// Does it carry something much heavier?
fn mass_ratio(
    look: &Look<'_>,
    body: &Body<'_>,
    track: &Track,
    touches: &[Touch],
    findings: &mut Findings,
) {
    // The other one lies on it: its normal, out of the other one, points down.
    let down = look.down();
    for touch in touches.iter().filter(|touch| touch.normal.dot(down) > 0.5) {
        // The mass of what is not dynamic is 0. What joints hold need not be carried.
        let heavy = look.world.body(touch.body).filter(|other| other.joints().next().is_none());
        let heavy = heavy.map_or(0.0, |other| other.mass());
        let ratio = heavy / body.mass().max(f32::MIN_POSITIVE);
        super::scale::report_ratio(look, [track.id, touch.body], ratio, None, findings);
    }
}
