//! What is wrong with the world, in words.

use crate::PhysicsWorld;
use bevy_app::prelude::*;
use bevy_ecs::prelude::*;
use tiny_physics_doctor::{Code, Doctor, Finding};

/// Watches the world and says what is wrong with it, once for each thing: as a [`PhysicsFinding`] and in the log. It looks after each step, in
/// the schedule of [`PhysicsPlugin`](crate::PhysicsPlugin), and costs a few per cent of a step; for development.
#[derive(Clone, Copy, Debug, Default)]
pub struct PhysicsDoctorPlugin;

/// The doctor, with all that was found.
#[derive(Resource, Clone, Debug, Default)]
pub struct PhysicsDoctor(pub Doctor);

/// Something is wrong: with what, why, and what to change.
#[derive(Message, Clone, Debug)]
pub struct PhysicsFinding {
    /// Entities that it is about, the most important first.
    pub entities: Vec<Entity>,
    /// The finding.
    pub finding: Finding,
}

impl Plugin for PhysicsDoctorPlugin {
    fn build(&self, app: &mut App) {
        app.init_resource::<PhysicsDoctor>().add_message::<PhysicsFinding>();
    }
}

/// Steps between two looks at the report.
const REPORT_EVERY: u64 = 16;

/// Looks at what the step left. The plugin that steps knows when.
pub(crate) fn watch(
    physics: Res<PhysicsWorld>,
    mut doctor: ResMut<PhysicsDoctor>,
    mut told: Local<Vec<(Code, u64)>>,
    mut findings: MessageWriter<PhysicsFinding>,
) {
    doctor.0.watch(&physics.world);
    if !physics.world.step_count().is_multiple_of(REPORT_EVERY) {
        return;
    }
    for finding in doctor.0.report().findings {
        let key = (finding.code, finding.first_step);
        if told.contains(&key) {
            continue;
        }
        told.push(key);
        let entities: Vec<_> =
            finding.bodies.iter().filter_map(|who| physics.body_entity(who.id)).collect();
        let names: Vec<_> = entities.iter().map(Entity::to_string).collect();
        log::warn!("physics: entity {}: {} {}", names.join(", "), finding.line(), finding.advice);
        findings.write(PhysicsFinding { entities, finding });
    }
}
