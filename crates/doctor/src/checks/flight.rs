//! Bodies on the move: through things, put elsewhere, too fast, gone.

use crate::look::{About, Findings, Look, Sighting, Words, figure};
use crate::track::Track;
use crate::{Code, Severity};
use tiny_physics::geometry::Ray;
use tiny_physics::{
    Aabb, Body, BodyId, BodyKind, Pose, QueryFilter, ShapeId, ShapeRef, Vec2, World,
};

/// What is lowest of all that stands.
#[derive(Default, Debug, Clone)]
pub(crate) struct Ground {
    shapes: usize,
    gravity: Vec2,
    /// Furthest down, along gravity, metres.
    lowest: Option<f64>,
}

impl Ground {
    /// Looks anew where shapes have come or gone.
    pub(crate) fn check(&mut self, look: &Look<'_>) {
        let world = look.world;
        if self.shapes == world.shape_count() && self.gravity == world.gravity {
            return;
        }
        (self.shapes, self.gravity) = (world.shape_count(), world.gravity);
        let down = look.down();
        let fixed = world.shape_ids().filter_map(|id| world.shape(id)).filter(|shape| {
            !shape.is_sensor()
                && world.body(shape.body()).is_some_and(|body| body.kind() == BodyKind::Static)
        });
        let lowest = fixed.filter_map(|shape| shape.fat_aabb()).map(|bounds| {
            let (center, half) = (bounds.center(), bounds.half_extents());
            f64::from(center.dot(down) + half.x * down.x.abs() + half.y * down.y.abs())
        });
        self.lowest = lowest.reduce(f64::max);
    }
}

/// Checks a body that moves. Says whether the user has put it somewhere else.
pub(crate) fn glance(
    look: &Look<'_>,
    body: &Body<'_>,
    before: &Track,
    track: &mut Track,
    ground: &Ground,
    findings: &mut Findings,
) -> bool {
    let speed = track.velocity.length();
    check_speed(look, track.id, speed, findings);
    if body.kind() == BodyKind::Dynamic {
        check_fall(look, body, track, ground, findings);
    }
    if before.glance + 1 != look.step {
        return false;
    }
    let way = track.center.relative_to(before.center).length();
    let reach = (speed.max(before.velocity.length()) * 1.5 + look.world.gravity.length() * look.dt)
        * look.dt;
    let placed = way > reach + 0.05 * track.size && check_teleport(look, body, before, findings);
    if placed {
        track.placed = Some(look.step);
    }
    let turning = body.angular_velocity().abs() * track.size;
    if (speed + turning) * look.dt > 0.5 * track.thin.max(0.01 * look.unit) {
        check_way(look, body, track, findings);
    }
    placed
}

fn check_speed(look: &Look<'_>, id: BodyId, speed: f32, findings: &mut Findings) {
    let limit = look.world.settings.max_speed * look.unit;
    if speed < 0.98 * limit {
        return;
    }
    let figure = figure("speed", speed, 0.98 * limit, " m/s");
    let seen = Sighting::new(Code::SpeedLimit, Severity::Note, About::Body(id), figure);
    findings.add(look, seen, || Words {
        what: format!("{id} moves at the world's speed limit"),
        advice: "raise Settings::max_speed if it shall be that fast; else look for the force, and for units that are too small",
        bodies: vec![id],
        ..Words::default()
    });
}

fn check_fall(
    look: &Look<'_>,
    body: &Body<'_>,
    track: &Track,
    ground: &Ground,
    findings: &mut Findings,
) {
    let down = look.down();
    let speed = track.velocity.dot(down);
    let held = body.gravity_scale() <= 0.0 || body.joints().next().is_some();
    if speed < 10.0 * look.unit || held || track.free < 0.5 {
        return;
    }
    let depth = track.center.x * f64::from(down.x) + track.center.y * f64::from(down.y);
    let margin = 30.0 * look.unit + 10.0 * track.size;
    let below = ground.lowest.map(|lowest| (depth - lowest) as f32);
    if below.is_none_or(|below| below < margin) && track.free < 8.0 {
        return;
    }
    let figure = match below {
        Some(below) if below >= margin => figure("below the lowest ground", below, margin, " m"),
        _ => figure("falling for", track.free, 8.0, " s"),
    };
    let seen = Sighting::new(Code::FellOut, Severity::Note, About::Body(track.id), figure);
    findings.add(look, seen, || Words {
        what: format!("{} has left the level and falls for ever at {speed:.0} m/s", track.id),
        advice: "close the level, or remove bodies that are below it: each costs time in every step",
        bodies: vec![track.id],
        ..Words::default()
    });
}

/// Has the user put it somewhere else? And through something?
fn check_teleport(
    look: &Look<'_>,
    body: &Body<'_>,
    before: &Track,
    findings: &mut Findings,
) -> bool {
    let start = body.interpolated_pose(0.0);
    let from = before.center;
    let to = start.apply(body.local_center());
    let way = to.relative_to(from);
    let bound = 0.02 * before.size + 0.002 * look.unit;
    if way.length() <= bound {
        return false;
    }
    let Some(own) = first_solid(look.world, body) else { return true };
    let filter = QueryFilter { filter: own.filter(), ..QueryFilter::new() }.exclude(track_id(body));
    let through = look.world.ray_cast(from, way, &filter);
    let inside = look.world.overlap_point(to, &filter).first().copied();
    let Some(hit) = through.map(|hit| hit.shape).or(inside) else { return true };
    let figure = figure("jump", way.length(), bound, " m");
    let seen = Sighting::new(Code::Teleport, Severity::Warning, About::Body(before.id), figure);
    findings.add(look, seen, || Words {
        what: format!(
            "{} was put {:.2} m away, {} {hit}, which it collides with",
            before.id,
            way.length(),
            if inside.is_some() { "into" } else { "through" }
        ),
        advice: "a position that is set touches nothing on the way: use set_velocity, set_target or forces, or ask overlap_shape whether there is room",
        bodies: vec![before.id],
        shapes: vec![hit],
        ..Words::default()
    });
    true
}

fn track_id(body: &Body<'_>) -> BodyId {
    body.id()
}

fn first_solid<'a>(world: &'a World, body: &Body<'_>) -> Option<ShapeRef<'a>> {
    body.shapes().filter_map(|id| world.shape(id)).find(|shape| !shape.is_sensor())
}

/// Did it go through something in this step, or something through it?
fn check_way(look: &Look<'_>, body: &Body<'_>, track: &Track, findings: &mut Findings) {
    let world = look.world;
    let Some(own) = first_solid(world, body) else { return };
    let start = body.interpolated_pose(0.0).apply(body.local_center());
    let way = track.center.relative_to(start);
    let (to, radius) = (track.center.to_vec2(), Vec2::splat(track.size));
    let from = to - way;
    let swept = Aabb::new(from.min(to) - radius, from.max(to) + radius);
    let mine = |shape: ShapeId| world.shape(shape).is_some_and(|s| collide(world, &own, &s));
    let filter = QueryFilter::new().exclude(track.id).predicate(&mine);
    for shape in world.overlap_aabb(swept, &filter).into_iter().take(16) {
        let Some(other) = world.shape(shape) else { continue };
        let Some(partner) = world.body(other.body()) else { continue };
        let through = passage(body, &partner, &other).or_else(|| passage(&partner, body, &own));
        let bound = 0.2 * track.thin;
        if let Some(length) = through.filter(|length| *length >= bound) {
            report_passage(look, track, &other, length, bound, findings);
        }
    }
}

/// May two shapes meet?
fn collide(world: &World, own: &ShapeRef<'_>, other: &ShapeRef<'_>) -> bool {
    let (a, b) = (own.body(), other.body());
    let kinds = [a, b].map(|id| world.body(id).map(|body| body.kind()));
    let some_dynamic = kinds.contains(&Some(BodyKind::Dynamic));
    let joined = world.body(a).is_some_and(|body| {
        body.joints().filter_map(|id| world.joint(id)).any(|joint| {
            !joint.def().collide_connected && [joint.bodies().0, joint.bodies().1].contains(&b)
        })
    });
    some_dynamic && !joined && other.one_way().is_none() && own.filter().collides(&other.filter())
}

/// How far the centre of a body went through a shape of another, seen from that one, metres; `None` where it did
/// not come out again.
fn passage(body: &Body<'_>, other: &Body<'_>, shape: &ShapeRef<'_>) -> Option<f32> {
    let centers: [(Pose, Pose); 2] =
        [(body.interpolated_pose(0.0), other.interpolated_pose(0.0)), (body.pose(), other.pose())];
    let [from, to] = centers
        .map(|(pose, frame)| shape.local().unapply(frame.unapply(pose.apply(body.local_center()))));
    let way = to - from;
    let geometry = shape.shape();
    let enters = geometry.ray_cast(&Ray::new(from, way))?;
    let leaves = geometry.ray_cast(&Ray::new(to, -way))?;
    // Parallel to the surface is grazing.
    let straight = enters.normal.dot(way.normalized()) < -0.2;
    let length = (1.0 - leaves.fraction - enters.fraction) * way.length();
    let thickness = 2.0 * geometry.inner_radius();
    (straight && (length >= 0.5 * thickness)).then_some(length.max(thickness))
}

fn report_passage(
    look: &Look<'_>,
    track: &Track,
    other: &ShapeRef<'_>,
    length: f32,
    bound: f32,
    findings: &mut Findings,
) {
    let world = look.world;
    let partner = other.body();
    let moving = world.body(partner).is_some_and(|body| body.kind() != BodyKind::Static);
    let figure = figure("went through", length.max(bound), bound, " m");
    let seen = Sighting::new(Code::Tunnelling, Severity::Error, About::Body(track.id), figure);
    let step = track.velocity.length() * look.dt;
    findings.add(look, seen, || Words {
        what: format!("{} went through {} of {partner} in one step of {step:.2} m", track.id, other.id()),
        advice: match (world.settings.continuous, moving) {
            (false, _) => "turn Settings::continuous on: without it fast bodies are not swept",
            (true, true) => "shorten the step, make the bodies thicker or slower, or mark the fast one as RigidBody::bullet",
            (true, false) => "shorten the step or make the wall thicker, and send us the scene: this should not happen",
        },
        bodies: vec![track.id, partner],
        shapes: vec![other.id()],
        ..Words::default()
    });
}
