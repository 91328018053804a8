//! The plugin: which systems run when.

use crate::sync::{
    bodies, characters, colliders, copies, forces, joints, removal, step, tiles, write,
};
use crate::{PhysicsWorld, components::*, messages::*};
use bevy_app::prelude::*;
use bevy_ecs::intern::Interned;
use bevy_ecs::prelude::*;
use bevy_ecs::schedule::ScheduleLabel;
use bevy_math::Vec2;
use tiny_physics::Settings;

/// Physics in a fixed schedule: by default [`FixedUpdate`], with the time step of Bevy's fixed clock, and drawn between steps.
#[derive(Clone, Debug)]
pub struct PhysicsPlugin {
    gravity: Vec2,
    settings: Settings,
    schedule: Interned<dyn ScheduleLabel>,
    dt: Option<f32>,
    interpolate: bool,
    threads: usize,
}

impl Default for PhysicsPlugin {
    fn default() -> Self {
        Self {
            gravity: Vec2::new(0.0, -9.8),
            settings: Settings::default(),
            schedule: FixedUpdate.intern(),
            dt: None,
            interpolate: true,
            threads: 1,
        }
    }
}

impl PhysicsPlugin {
    /// Sets gravity, metres a second squared; (0, -9.8) without this.
    pub fn gravity(mut self, gravity: Vec2) -> Self {
        self.gravity = gravity;
        self
    }

    /// Sets the engine's settings. For a world in pixels set [`Settings::length_unit`] to the pixels of a metre.
    pub fn settings(mut self, settings: Settings) -> Self {
        self.settings = settings;
        self
    }

    /// Steps in another schedule, as those of rollback have, by `dt` seconds, and draws what each step left.
    pub fn in_schedule(mut self, schedule: impl ScheduleLabel, dt: f32) -> Self {
        (self.schedule, self.dt, self.interpolate) = (schedule.intern(), Some(dt), false);
        self
    }

    /// Steps by so many seconds whatever the clock says. Without this a step is as long as the schedule's clock says.
    pub fn dt(mut self, dt: f32) -> Self {
        self.dt = Some(dt);
        self
    }

    /// Shows bodies where the last step left them, not between the last two steps.
    pub fn without_interpolation(mut self) -> Self {
        self.interpolate = false;
        self
    }

    /// Sets the number of threads of a step; more than 1 needs the feature `parallel`. Results do not depend on it.
    pub fn threads(mut self, threads: usize) -> Self {
        self.threads = threads;
        self
    }
}

/// What happens in a step, in this order. What moves bodies belongs before [`PhysicsSystems::Read`], what reads messages after
/// [`PhysicsSystems::Write`].
#[derive(SystemSet, Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum PhysicsSystems {
    /// Components go into the world.
    Read,
    /// The world moves on by a step.
    Step,
    /// Messages are sent, components follow the world.
    Write,
}

impl Plugin for PhysicsPlugin {
    fn build(&self, app: &mut App) {
        let gravity = engine(self.gravity);
        let mut world = tiny_physics::World::with_settings(gravity, self.settings);
        world.set_threads(self.threads);
        app.insert_resource(PhysicsWorld::new(world)).insert_resource(step::StepLength(self.dt));
        add_messages(app);
        removal::watch(app);
        app.configure_sets(
            self.schedule,
            (PhysicsSystems::Read, PhysicsSystems::Step, PhysicsSystems::Write).chain(),
        );
        let read = (
            removal::remove_gone,
            copies::take_over,
            tiles::read,
            bodies::add,
            characters::add,
            colliders::read,
            bodies::read,
            joints::read,
            forces::apply,
        );
        app.add_systems(self.schedule, read.chain().in_set(PhysicsSystems::Read));
        app.add_systems(
            self.schedule,
            (step::step, characters::walk).chain().in_set(PhysicsSystems::Step),
        );
        let write = (
            step::tell,
            joints::take_off_broken,
            write::transforms,
            write::velocities,
            characters::tell,
        );
        app.add_systems(self.schedule, write.chain().in_set(PhysicsSystems::Write));
        #[cfg(feature = "doctor")]
        app.add_systems(
            self.schedule,
            crate::doctor::watch
                .run_if(resource_exists::<crate::PhysicsDoctor>)
                .after(PhysicsSystems::Write),
        );
        if self.interpolate {
            app.init_resource::<write::Interpolated>();
            app.add_systems(FixedFirst, write::exact_places);
            let after = RunFixedMainLoopSystems::AfterFixedMainLoop;
            app.add_systems(RunFixedMainLoop, write::interpolate.in_set(after));
        }
    }
}

fn add_messages(app: &mut App) {
    app.add_message::<PhysicsProblem>()
        .add_message::<CollisionStarted>()
        .add_message::<CollisionEnded>()
        .add_message::<Hit>()
        .add_message::<SensorEntered>()
        .add_message::<SensorLeft>()
        .add_message::<JointBroke>()
        .add_message::<BodyWoke>()
        .add_message::<BodyFellAsleep>();
}
