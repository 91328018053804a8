//! What there is in a world, as rows of numbers.

use crate::handles::Handle;
use crate::outcome::{Outcome, words};
use crate::session::Session;
use crate::views::{Views, state};
use crate::with;
use tiny_physics::{
    Body, BodyId, BodyKind, ContactBegin, DVec2, Error, JointId, SensorBegin, ShapeId, UserData,
    World,
};

/// Brings the rows of all bodies up to date, between the start (`alpha` 0) and the end (1) of the last step. The numbers
/// are how many there are, and the addresses of handles, poses, velocities and states.
#[unsafe(no_mangle)]
pub extern "C" fn tp_bodies(session: u32, alpha: f32) -> bool {
    with(session, |session, shelf| {
        let mut views = core::mem::take(&mut session.views);
        views.refresh(session.world(), alpha);
        session.views = views;
        let Views { ids, poses, velocities, states, count, .. } = &session.views;
        let places = [ids.as_ptr() as usize, poses.as_ptr() as usize, velocities.as_ptr() as usize];
        let places = places.into_iter().chain([states.as_ptr() as usize]);
        shelf.count([*count].into_iter().chain(places).map(|place| place as f64));
        Ok(())
    })
}

fn body_of(session: &Session, body: f64) -> Outcome<Body<'_>> {
    let id = BodyId::of(body);
    session.world().body(id).ok_or_else(|| words(Error::from(id)))
}

/// Numbers of a body: x, y, angle, velocity, angular velocity, mass, inertia, centre, state, gravity scale, damping
/// (2), locks, sleep speed, can it sleep, user data.
#[unsafe(no_mangle)]
pub extern "C" fn tp_body(session: u32, body: f64) -> bool {
    with(session, |session, shelf| {
        let body = body_of(session, body)?;
        let (p, velocity, center) = (body.position_f64(), body.velocity(), body.center());
        let (linear, angular) = body.damping();
        let locks = body.locks();
        let locks = u8::from(locks.x) | u8::from(locks.y) << 1 | u8::from(locks.rotation) << 2;
        let motion = [body.angle(), velocity.x, velocity.y, body.angular_velocity()];
        let rest = [body.gravity_scale(), linear, angular, f32::from(locks), body.sleep_speed()];
        let numbers = [p.x, p.y].into_iter().chain(motion.map(f64::from));
        let numbers =
            numbers.chain([body.mass().into(), body.inertia().into(), center.x, center.y]);
        let numbers = numbers.chain([state(&body).into()]).chain(rest.map(f64::from));
        shelf.count(numbers.chain([f64::from(body.can_sleep()), body.user_data() as f64]));
        Ok(())
    })
}

/// Handles of the shapes of a body.
#[unsafe(no_mangle)]
pub extern "C" fn tp_body_shapes(session: u32, body: f64) -> bool {
    with(session, |session, shelf| {
        shelf.count(body_of(session, body)?.shapes().map(Handle::number));
        Ok(())
    })
}

/// Handles of its joints.
#[unsafe(no_mangle)]
pub extern "C" fn tp_body_joints(session: u32, body: f64) -> bool {
    with(session, |session, shelf| {
        shelf.count(body_of(session, body)?.joints().map(Handle::number));
        Ok(())
    })
}

/// The description of a shape as text, and its body as number.
#[unsafe(no_mangle)]
pub extern "C" fn tp_shape(session: u32, shape: f64) -> bool {
    with(session, |session, shelf| {
        let id = ShapeId::of(shape);
        let shape = session.world().shape(id).ok_or_else(|| words(Error::from(id)))?;
        shelf.say(serde_json::to_vec(&shape.describe()).map_err(words)?);
        shelf.count([shape.body().number()]);
        Ok(())
    })
}

/// The description of a joint as text; the numbers are its bodies, anchors (world), force and torque on B.
#[unsafe(no_mangle)]
pub extern "C" fn tp_joint(session: u32, joint: f64) -> bool {
    with(session, |session, shelf| {
        let id = JointId::of(joint);
        let joint = session.world().joint(id).ok_or_else(|| words(Error::from(id)))?;
        shelf.say(serde_json::to_vec(joint.def()).map_err(words)?);
        let ((a, b), anchors, force) = (joint.bodies(), joint.anchors(), joint.force());
        let points = [anchors.0, anchors.1].into_iter().flat_map(|point| [point.x, point.y]);
        let load = [force.x, force.y, joint.torque()].map(f64::from);
        shelf.count([a.number(), b.number()].into_iter().chain(points).chain(load));
        Ok(())
    })
}

/// Settings of the world as text, and gravity as numbers.
#[unsafe(no_mangle)]
pub extern "C" fn tp_settings(session: u32) -> bool {
    with(session, |session, shelf| {
        let world = session.world();
        shelf.say(serde_json::to_vec(&world.settings).map_err(words)?);
        shelf.count([world.gravity.x, world.gravity.y].map(f64::from));
        Ok(())
    })
}

/// Numbers of the world: bodies, awake ones, shapes, joints, contacts, steps, deepest overlap, kinetic and potential
/// energy, momentum (2).
#[unsafe(no_mangle)]
pub extern "C" fn tp_counts(session: u32) -> bool {
    with(session, |session, shelf| {
        let world = session.world();
        let counts = [
            world.body_count(),
            world.awake_body_count(),
            world.shape_count(),
            world.joint_count(),
            world.contact_count(),
        ];
        let sums = [world.step_count() as f64, world.max_penetration().into()];
        shelf.count(counts.map(|count| count as f64).into_iter().chain(sums).chain(motion(world)));
        Ok(())
    })
}

/// Kinetic energy, potential energy in the world's gravity, momentum.
fn motion(world: &World) -> [f64; 4] {
    let mut sums = [world.kinetic_energy(), 0.0, 0.0, 0.0];
    for body in world.body_ids().filter_map(|id| world.body(id)) {
        if body.kind() != BodyKind::Dynamic {
            continue;
        }
        let (mass, center, velocity) = (f64::from(body.mass()), body.center(), body.velocity());
        let (x, y) = (f64::from(world.gravity.x), f64::from(world.gravity.y));
        let along = x * center.x + y * center.y;
        sums[1] -= mass * f64::from(body.gravity_scale()) * along;
        sums[2] += mass * f64::from(velocity.x);
        sums[3] += mass * f64::from(velocity.y);
    }
    sums
}

/// What two shapes of an event are: they, their bodies, the user's numbers of shape and body of the first and of the second.
type Pair = ([ShapeId; 2], [BodyId; 2], [UserData; 2]);

fn touch(e: ContactBegin) -> Pair {
    ([e.shape_a, e.shape_b], [e.body_a, e.body_b], [e.user_data_a, e.user_data_b])
}

fn sight(e: SensorBegin) -> Pair {
    ([e.sensor, e.visitor], [e.sensor_body, e.visitor_body], [e.sensor_data, e.visitor_data])
}

fn note(numbers: &mut Vec<f64>, (shapes, bodies, data): Pair) {
    numbers.extend(shapes.map(Handle::number));
    numbers.extend(bodies.map(Handle::number));
    data.iter().for_each(|data| numbers.extend([data.shape as f64, data.body as f64]));
}

/// Events of the last step: 0 contact begin, 1 contact end, 2 hits, 3 sensor begin, 4 sensor end, 5 joint breaks, 6 woke,
/// 7 fell asleep. A row is: two shapes, their bodies, the user's numbers of shape, body, shape and body (0 to 4), and then of hits
/// point, normal, speed, impulse and masses; the joint, force, torque, user data, bodies (5); the body (6, 7).
#[unsafe(no_mangle)]
pub extern "C" fn tp_events(session: u32, which: u32) -> bool {
    with(session, |session, shelf| {
        let events = session.world().events();
        shelf.numbers.clear();
        let numbers = &mut shelf.numbers;
        let mut pairs =
            |pairs: &mut dyn Iterator<Item = Pair>| pairs.for_each(|pair| note(numbers, pair));
        match which {
            0 => pairs(&mut events.contact_begin().iter().map(|&e| touch(e))),
            1 => pairs(&mut events.contact_end().iter().map(|&e| touch(e.into()))),
            3 => pairs(&mut events.sensor_begin().iter().map(|&e| sight(e))),
            4 => pairs(&mut events.sensor_end().iter().map(|&e| sight(e.into()))),
            2 => events.hits().iter().for_each(|e| {
                let data = [e.user_data_a, e.user_data_b];
                note(numbers, ([e.shape_a, e.shape_b], [e.body_a, e.body_b], data));
                let rest = [e.normal.x, e.normal.y, e.speed, e.impulse, e.mass_a, e.mass_b];
                numbers.extend([e.position.x, e.position.y]);
                numbers.extend(rest.map(f64::from));
            }),
            5 => events.joint_breaks().iter().for_each(|e| {
                numbers.push(e.joint.number());
                numbers.extend([e.force.x, e.force.y, e.torque].map(f64::from));
                numbers.extend([e.user_data as f64, e.body_a.number(), e.body_b.number()]);
            }),
            6 => numbers.extend(events.woke().iter().map(|id| id.number())),
            7 => numbers.extend(events.fell_asleep().iter().map(|id| id.number())),
            _ => return Err("there are no such events".to_owned()),
        }
        Ok(())
    })
}

/// All contact points: shapes and bodies, normal, point, separation, normal and tangent impulse.
#[unsafe(no_mangle)]
pub extern "C" fn tp_contacts(session: u32) -> bool {
    with(session, |session, shelf| {
        shelf.numbers.clear();
        for contact in session.world().contacts() {
            let (shapes, bodies) = (
                [contact.shape_a.number(), contact.shape_b.number()],
                [contact.body_a.number(), contact.body_b.number()],
            );
            for point in contact.points() {
                let place = point.position;
                let normal = contact.normal;
                let strength = [point.separation, point.normal_impulse, point.tangent_impulse];
                shelf.numbers.extend(shapes.iter().chain(&bodies));
                shelf.numbers.extend([normal.x.into(), normal.y.into(), place.x, place.y]);
                shelf.numbers.extend(strength.map(f64::from));
            }
        }
        Ok(())
    })
}

/// Handles of all shapes (0), joints (1) or tile grids (2).
#[unsafe(no_mangle)]
pub extern "C" fn tp_ids(session: u32, which: u32) -> bool {
    with(session, |session, shelf| {
        let world = session.world();
        match which {
            0 => shelf.count(world.shape_ids().map(Handle::number)),
            1 => shelf.count(world.joint_ids().map(Handle::number)),
            _ => shelf.count(world.tile_grid_ids().map(Handle::number)),
        }
        Ok(())
    })
}

/// What a sensor sees: handles of shapes.
#[unsafe(no_mangle)]
pub extern "C" fn tp_sensor_overlaps(session: u32, sensor: f64) -> bool {
    with(session, |session, shelf| {
        shelf.count(session.world().sensor_overlaps(ShapeId::of(sensor)).map(Handle::number));
        Ok(())
    })
}

/// Are the world's data sound? For tests.
#[unsafe(no_mangle)]
pub extern "C" fn tp_validate(session: u32) -> bool {
    with(session, |session, _| session.world().validate())
}

/// A point's numbers.
pub(crate) fn point(point: DVec2) -> [f64; 2] {
    [point.x, point.y]
}
