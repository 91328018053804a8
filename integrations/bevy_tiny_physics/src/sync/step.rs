//! The step itself, and telling what happened in it.

use super::problems::Problems;
use crate::PhysicsWorld;
use crate::messages::*;
use bevy_ecs::prelude::*;
use bevy_ecs::system::SystemParam;
use bevy_math::Vec2;
use bevy_time::Time;
use tiny_physics::{BodyId, JointId, ShapeId};

/// Length of a step where no clock says.
#[derive(Resource, Clone, Copy, Debug)]
pub(crate) struct StepLength(pub Option<f32>);

/// How long a step is.
#[derive(SystemParam)]
pub(crate) struct Clock<'w> {
    length: Res<'w, StepLength>,
    time: Option<Res<'w, Time>>,
}

impl Clock<'_> {
    /// As the plugin was told, else as the clock of the schedule says.
    pub fn seconds(&self) -> f32 {
        self.length
            .0
            .unwrap_or_else(|| self.time.as_ref().map_or(1.0 / 64.0, |time| time.delta_secs()))
    }
}

/// Moves the world on.
pub(crate) fn step(mut physics: ResMut<PhysicsWorld>, clock: Clock, mut problems: Problems) {
    let result = physics.world.try_step(clock.seconds());
    physics.stepped = result.is_ok();
    physics.fresh = false;
    if let Err(error) = result {
        problems.report(None, "step", error);
    }
}

/// Everything that messages are written to.
#[derive(SystemParam)]
pub(crate) struct Writers<'w> {
    started: MessageWriter<'w, CollisionStarted>,
    ended: MessageWriter<'w, CollisionEnded>,
    hits: MessageWriter<'w, Hit>,
    entered: MessageWriter<'w, SensorEntered>,
    left: MessageWriter<'w, SensorLeft>,
    broke: MessageWriter<'w, JointBroke>,
    woke: MessageWriter<'w, BodyWoke>,
    slept: MessageWriter<'w, BodyFellAsleep>,
}

/// Sends the events of the step, with entities.
pub(crate) fn tell(mut physics: ResMut<PhysicsWorld>, mut writers: Writers) {
    if !physics.stepped {
        return;
    }
    let names = Names(&physics);
    let events = physics.world.events();
    tell_collisions(&names, &mut writers);
    for event in events.sensor_begin() {
        let (sensor_body, visitor_body) =
            (names.body(event.sensor_body), names.body(event.visitor_body));
        let sensor = names.shape(event.sensor, event.sensor_body);
        let visitor = names.shape(event.visitor, event.visitor_body);
        writers.entered.write(SensorEntered { sensor, visitor, sensor_body, visitor_body });
    }
    for event in events.sensor_end() {
        let (sensor_body, visitor_body) =
            (names.body(event.sensor_body), names.body(event.visitor_body));
        let sensor = names.shape(event.sensor, event.sensor_body);
        let visitor = names.shape(event.visitor, event.visitor_body);
        writers.left.write(SensorLeft { sensor, visitor, sensor_body, visitor_body });
    }
    for event in events.joint_breaks() {
        writers.broke.write(JointBroke {
            joint: names.joint(event.joint),
            body_a: names.body(event.body_a),
            body_b: names.body(event.body_b),
            force: event.force.length(),
            torque: event.torque,
        });
    }
    writers
        .woke
        .write_batch(events.woke().iter().filter_map(|id| physics.body_entity(*id)).map(BodyWoke));
    writers.slept.write_batch(
        events.fell_asleep().iter().filter_map(|id| physics.body_entity(*id)).map(BodyFellAsleep),
    );
    let maps = &mut physics.maps;
    for handles in [&mut maps.body_entities, &mut maps.shape_entities, &mut maps.joint_entities] {
        handles.forget_removed();
    }
}

fn tell_collisions(names: &Names, writers: &mut Writers) {
    let events = names.0.world.events();
    macro_rules! pair {
        ($name:ident, $event:ident { $($field:ident: $value:expr),* }) => {
            $name {
                collider_a: names.shape($event.shape_a, $event.body_a),
                collider_b: names.shape($event.shape_b, $event.body_b),
                body_a: names.body($event.body_a),
                body_b: names.body($event.body_b),
                data_a: $event.user_data_a,
                data_b: $event.user_data_b,
                $($field: $value),*
            }
        };
    }
    for event in events.contact_begin() {
        writers.started.write(pair!(CollisionStarted, event {}));
    }
    for event in events.contact_end() {
        writers.ended.write(pair!(CollisionEnded, event {}));
    }
    for event in events.hits() {
        writers.hits.write(pair!(
            Hit,
            event {
                point: Vec2::new(event.position.x as f32, event.position.y as f32),
                normal: Vec2::new(event.normal.x, event.normal.y),
                speed: event.speed,
                impulse: event.impulse,
                mass_a: event.mass_a,
                mass_b: event.mass_b
            }
        ));
    }
}

/// Entities of handles; a placeholder for what no entity made.
struct Names<'a>(&'a PhysicsWorld);

impl Names<'_> {
    /// That of a shape, which may be gone. Characters and tile maps are known by their bodies.
    fn shape(&self, id: ShapeId, body: BodyId) -> Entity {
        self.0.collider_entity(id).unwrap_or_else(|| self.body(body))
    }

    fn body(&self, id: BodyId) -> Entity {
        self.0.body_entity(id).unwrap_or(Entity::PLACEHOLDER)
    }

    fn joint(&self, id: JointId) -> Entity {
        self.0.joint_entity(id).unwrap_or(Entity::PLACEHOLDER)
    }
}
