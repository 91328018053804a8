//! Bodies on the move: through things, put elsewhere, too fast, gone.

use crate::look::{About, Findings, Look, Sighting, Words, figure};
use crate::track::{Before, Track};
use crate::{Code, Severity};
use tiny_physics::geometry::Ray;
use tiny_physics::{
    Aabb, Body, BodyId, BodyKind, DVec2, Pose, QueryFilter, ShapeId, ShapeRef, Vec2, World, contact,
};

/// Radians of a turn that are looked at as straight.
const BEND: f32 = 0.2;
/// Radii that a jump through others is far: nobody walks so by setting positions.
const FAR: f32 = 16.0;

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

/// How many ways are looked at: each takes a query. Where more bodies are fast for long, each is looked at in some steps only.
#[derive(Default, Debug, Clone)]
pub(crate) struct Ways {
    wanted: usize,
    every: u64,
}

impl Ways {
    /// Ways looked at in a step for long, and one more of each [`Self::ONE_IN`] bodies that are awake.
    const SOME: usize = 1;
    const ONE_IN: usize = 32;

    pub(crate) fn begin(&mut self, look: &Look<'_>) {
        let most = Self::SOME + look.world.awake_body_count() / Self::ONE_IN;
        self.every = core::mem::take(&mut self.wanted).div_ceil(most).max(1) as u64;
    }

    /// Is it this one's turn?
    fn take(&mut self, look: &Look<'_>, id: BodyId) -> bool {
        self.wanted += 1;
        (look.step + id.index() as u64).is_multiple_of(self.every)
    }
}

/// Checks a body that moves. Says whether the user has put it somewhere else.
pub(crate) fn glance(
    look: &Look<'_>,
    body: &Body<'_>,
    before: &Before,
    track: &mut Track,
    (ground, ways): (&Ground, &mut Ways),
    findings: &mut Findings,
) -> bool {
    let speed = track.velocity.length();
    if speed > 10.0 * look.unit {
        check_speed(look, track.id, speed, findings);
        check_fall(look, body, track, ground, findings);
    }
    let way = track.center.relative_to(before.center).length();
    let time = (look.step - before.glance) as f32 * look.dt;
    let reach = (speed.max(before.velocity.length()) * 1.5 + look.pull * time) * time;
    // What has not been looked at for long may have been hit meanwhile.
    // What moved and was not looked at may have been hit meanwhile. What is pushed out of others moves a little further than it is fast; kinematic bodies do not.
    let room = || if body.kind() == BodyKind::Dynamic { 0.05 * track.size } else { 0.0 };
    let seen = before.glance + 1 == look.step || before.rested && look.step - before.glance <= 3;
    let placed = seen
        && way > reach
        && way > reach + room().max(0.002 * look.unit)
        && check_teleport(look, body, before, track, findings);
    if placed {
        track.placed = Some(look.step);
    }
    let turning = body.angular_velocity().abs() * track.size;
    let fast = track.thin > 0.0 && (speed + turning) * look.dt > track.thin;
    if fast && ways.take(look, track.id) {
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
    if speed < 10.0 * look.unit || track.free < 0.5 || body.kind() != BodyKind::Dynamic {
        return;
    }
    if body.gravity_scale() <= 0.0 || body.joints().next().is_some() {
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
    before: &Before,
    track: &Track,
    findings: &mut Findings,
) -> bool {
    let start = body.interpolated_pose(0.0);
    let from = before.center;
    let to = start.apply(body.local_center());
    let way = to.relative_to(from);
    let bound = 0.02 * track.size + 0.002 * look.unit;
    if way.length() <= bound {
        return false;
    }
    let Some(own) = first_solid(look.world, body) else { return true };
    let filter = QueryFilter { filter: own.filter(), ..QueryFilter::new() }.exclude(track.id);
    let into = entered(look, &own, -way, start, &filter);
    let meets = |id: ShapeId| look.world.shape(id).is_some_and(|s| collide(look.world, &own, &s));
    let through = look.world.ray_cast(from, way, &filter.predicate(&meets));
    let Some(hit) = into.or(through.map(|hit| hit.shape)) else { return true };
    let word = if into.is_some() { "into" } else { "through" };
    // One that comes to a free place far away is let in anew.
    let far = into.is_none() && way.length() > FAR * track.size;
    let severity = if far { Severity::Note } else { Severity::Warning };
    let figure = figure("jump", way.length(), bound, " m");
    let seen = Sighting::new(Code::Teleport, severity, About::Body(track.id), figure);
    findings.add(look, seen, || Words {
        what: format!(
            "{} was put {:.2} m away, {word} {hit}, which it collides with",
            track.id,
            way.length(),
        ),
        advice: "a position that is set touches nothing on the way: use set_velocity, set_target or forces, or ask overlap_shape whether there is room",
        bodies: vec![track.id],
        shapes: vec![hit],
        ..Words::default()
    });
    true
}

/// What a shape overlaps at a place, and more so than where it came from.
fn entered(
    look: &Look<'_>,
    own: &ShapeRef<'_>,
    back: Vec2,
    start: Pose,
    filter: &QueryFilter<'_>,
) -> Option<ShapeId> {
    let at = start.compose(own.local());
    let bound = (0.02 * look.unit).min(0.2 * own.shape().inner_radius());
    let found = look.world.overlap_shape(own.shape(), at, filter);
    found.into_iter().take(8).find(|&id| {
        let Some(other) = look.world.shape(id) else { return false };
        let [before, after] = [back, Vec2::ZERO].map(|way| {
            let pose = Pose::new(at.p + way, at.q);
            contact(own.shape(), &pose, other.shape(), &other.pose()).map_or(0.0, |c| c.depth)
        });
        after > bound && after > before + 0.5 * bound && collide(look.world, own, &other)
    })
}

fn first_solid<'a>(world: &'a World, body: &Body<'_>) -> Option<ShapeRef<'a>> {
    body.shapes().filter_map(|id| world.shape(id)).find(|shape| !shape.is_sensor())
}

/// The motion of a body in the step.
struct Motion<'a> {
    body: &'a Body<'a>,
    from: Pose,
    /// Radians that it turned, about.
    turn: f32,
}

impl<'a> Motion<'a> {
    fn of(look: &Look<'_>, body: &'a Body<'a>) -> Self {
        let still = body.kind() == BodyKind::Static;
        let from = if still { body.pose() } else { body.interpolated_pose(0.0) };
        Self { body, from, turn: body.angular_velocity().abs() * look.dt }
    }

    /// Its frame when a part of the step had passed.
    fn at(&self, part: f32) -> Pose {
        match part {
            _ if part <= 0.0 => self.from,
            _ if part >= 1.0 => self.body.pose(),
            _ => self.body.interpolated_pose(part),
        }
    }

    fn center_at(&self, part: f32) -> DVec2 {
        self.at(part).apply(self.body.local_center())
    }

    /// Where a shape of the body was at the start.
    fn start_of(&self, shape: &ShapeRef<'_>) -> Pose {
        self.from.compose(shape.local())
    }
}

/// Did it go through something in this step, or something through it?
fn check_way(look: &Look<'_>, body: &Body<'_>, track: &Track, findings: &mut Findings) {
    let world = look.world;
    let Some(own) = first_solid(world, body) else { return };
    let motion = Motion::of(look, body);
    let way = track.center.relative_to(motion.center_at(0.0));
    let (to, radius) = (track.center.to_vec2(), Vec2::splat(track.size));
    let from = to - way;
    let swept = Aabb::new(from.min(to) - radius, from.max(to) + radius);
    let mine = |shape: ShapeId| world.shape(shape).is_some_and(|s| collide(world, &own, &s));
    let filter = QueryFilter { filter: own.filter(), ..QueryFilter::new() };
    let filter = filter.exclude(track.id).predicate(&mine);
    let bound = 0.2 * track.thin;
    for shape in world.overlap_aabb(swept, &filter).into_iter().take(16) {
        let Some(other) = world.shape(shape) else { continue };
        let Some(partner) = world.body(other.body()) else { continue };
        let theirs = Motion::of(look, &partner);
        let through = passage(&motion, &theirs, &other).or_else(|| passage(&theirs, &motion, &own));
        let through = through.filter(|length| *length >= bound);
        let Some(length) = through else { continue };
        // What was inside before has not come through in this step.
        let [mine, its] =
            [(&motion, &own), (&theirs, &other)].map(|(motion, shape)| motion.start_of(shape));
        let inside = contact(own.shape(), &mine, other.shape(), &its).map_or(0.0, |c| c.depth);
        if inside < 0.5 * bound + 0.01 * look.unit {
            report_passage(look, track, &other, length, bound, findings);
        }
    }
}

/// May two shapes meet?
pub(crate) fn collide(world: &World, own: &ShapeRef<'_>, other: &ShapeRef<'_>) -> bool {
    let (a, b) = (own.body(), other.body());
    let kinds = [a, b].map(|id| world.body(id).map(|body| body.kind()));
    let some_dynamic = kinds.contains(&Some(BodyKind::Dynamic));
    let joined = world.body(a).is_some_and(|body| {
        body.joints().filter_map(|id| world.joint(id)).any(|joint| {
            joint.def().enabled
                && !joint.def().collide_connected
                && [joint.bodies().0, joint.bodies().1].contains(&b)
        })
    });
    some_dynamic && !joined && other.one_way().is_none() && own.filter().collides(&other.filter())
}

/// How far the centre of a body went through a shape of another, from one face to the opposite one, seen from that shape, metres;
/// `None` where it did not.
fn passage(body: &Motion<'_>, other: &Motion<'_>, shape: &ShapeRef<'_>) -> Option<f32> {
    let seen = |part: f32| {
        let place = other.at(part).unapply(body.center_at(part));
        shape.local().unapply(place)
    };
    let geometry = shape.shape();
    let thickness = 2.0 * geometry.inner_radius();
    let (start, end) = (seen(0.0), seen(1.0));
    // Seen from what turns, ways are bent.
    let pieces = (other.turn / BEND).ceil().clamp(1.0, 16.0) as usize;
    if pieces == 1 && (end - start).length() < 0.5 * thickness {
        return None;
    }
    let (mut enters, mut length) = (None, 0.0);
    let mut from = start;
    for piece in 1..=pieces {
        let to = if piece == pieces { end } else { seen(piece as f32 / pieces as f32) };
        let way = to - from;
        let mut inside = way.length();
        if enters.is_none() {
            let hit = geometry.ray_cast(&Ray::new(from, way)).filter(|hit| hit.fraction > 0.0);
            enters = hit.map(|hit| (hit.normal, hit.normal.dot(way.normalized()) < -0.2));
            inside *= 1.0 - hit.map_or(1.0, |hit| hit.fraction);
        }
        if let Some((normal, straight)) = enters {
            let back = geometry.ray_cast(&Ray::new(to, -way)).filter(|hit| hit.fraction > 0.0);
            if let Some(leaves) = back {
                length += inside - way.length() * leaves.fraction;
                // Parallel to the surface is grazing, and a corner is cut by bodies that turn aside.
                let through = straight && leaves.normal.dot(normal) < -0.5;
                return (through && length >= 0.5 * thickness).then_some(length.max(thickness));
            }
            length += inside;
        }
        from = to;
    }
    None
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
            (true, true) => "shorten the step, make the bodies thicker or slower, or bring their masses nearer to each other",
            (true, false) => "shorten the step or make the wall thicker, and send us the scene: this should not happen",
        },
        bodies: vec![track.id, partner],
        shapes: vec![other.id()],
        ..Words::default()
    });
}
