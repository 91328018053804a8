//! What happens where a body meets a surface: bumps at seams, bounces that do not come.

use crate::look::{About, Findings, Look, Sighting, Touch, Words, figure};
use crate::track::Track;
use crate::{Code, Severity};
use tiny_physics::{Body, BodyKind, ShapeId, ShapeRef};

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
    for touch in touches {
        let Some(other) = look.world.shape(touch.shape) else { continue };
        let thickness = 2.0 * track.thin + 2.0 * other.shape().inner_radius();
        let head_on = -track.before.dot(touch.normal) > 0.7 * track.before.length();
        if !head_on || step <= thickness || step < 0.05 * look.unit {
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
    let (before, after) = (track.before, track.velocity);
    let (way, speed) = before.direction_and_length();
    let kept = after.dot(way);
    let friction = 1.5 * look.world.gravity.length() * look.dt;
    let lost = speed - kept;
    let bound = (0.03 * speed).max(BUMP * look.unit) + friction;
    if speed < 1.0 * look.unit || lost < bound || kept < 0.3 * speed {
        return;
    }
    let fixed: Vec<&Touch> = touches.iter().filter(|touch| is_static(look, touch)).collect();
    // It slides along one of them, and another meets that one.
    let Some(floor) = fixed.iter().find(|touch| touch.normal.dot(way).abs() < 0.1) else { return };
    let top = |touch: &Touch| top_of(look, touch.shape);
    let Some(step) = fixed.iter().find(|touch| {
        let level = (top(touch) - top(floor)).abs() < 0.2 * track.size;
        touch.shape != floor.shape && touch.normal.dot(way) < 0.0 && level
    }) else {
        return;
    };
    let figure = figure("speed lost", lost, bound, " m/s");
    let seen = Sighting::new(Code::GhostBump, Severity::Warning, About::Body(track.id), figure);
    findings.add(look, seen, || Words {
        what: format!("{} lost {lost:.1} of {speed:.1} m/s where {} and {} meet", track.id, floor.shape, step.shape),
        advice: "let the surfaces be level and leave no slit: chains and tile grids have no seams; round the mover's corners (a capsule)",
        bodies: vec![track.id],
        shapes: vec![floor.shape, step.shape],
        ..Words::default()
    });
}

/// How high a shape reaches against gravity, metres.
fn top_of(look: &Look<'_>, shape: ShapeId) -> f32 {
    let bounds = look.world.shape(shape).and_then(|shape| shape.fat_aabb());
    let up = -look.down();
    bounds.map_or(0.0, |bounds| {
        let half = bounds.half_extents();
        bounds.center().dot(up) + half.x * up.x.abs() + half.y * up.y.abs()
    })
}

fn is_static(look: &Look<'_>, touch: &Touch) -> bool {
    look.world.body(touch.body).is_some_and(|body| body.kind() == BodyKind::Static)
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
    let restitution =
        |shape: Option<ShapeRef<'_>>| shape.map_or(0.0, |shape| shape.material().restitution);
    let (own, other) = (restitution(world.shape(touch.own)), restitution(world.shape(touch.shape)));
    let (most, mixed) = (own.max(other), world.settings.restitution_mix.apply(own, other));
    let approach = -track.before.dot(touch.normal);
    if most < 0.2 || own < most || approach < 0.5 * look.unit || body.kind() != BodyKind::Dynamic {
        return;
    }
    let threshold = world.settings.restitution_threshold * look.unit;
    let by_mix = mixed < 0.34 * most;
    let by_speed = !by_mix
        && approach < threshold
        && track.free > 0.1
        && approach * approach > 2.0 * world.gravity.length() * track.size;
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
    for touch in touches {
        let Some(other) =
            look.world.body(touch.body).filter(|other| other.kind() == BodyKind::Dynamic)
        else {
            continue;
        };
        let ratio = other.mass() / body.mass().max(f32::MIN_POSITIVE);
        // The other one lies on it: its normal, out of the other one, points down.
        if touch.normal.dot(look.down()) > 0.5 {
            super::scale::report_ratio(look, [track.id, touch.body], ratio, None, findings);
        }
    }
}
