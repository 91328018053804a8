//! [tiny-physics](tiny_physics) for Bevy: 2D rigid bodies that neither tunnel nor jitter, with the same bits everywhere.
//!
//! ```
//! use bevy_app::prelude::*;
//! use bevy_ecs::prelude::*;
//! use bevy_tiny_physics::prelude::*;
//! use bevy_transform::prelude::*;
//!
//! let mut app = App::new();
//! app.add_plugins(PhysicsPlugin::default().dt(1.0 / 60.0));
//! app.world_mut().spawn((RigidBody::Static, Collider::rect(20.0, 1.0), Transform::from_xyz(0.0, -1.0, 0.0)));
//! let ball = (RigidBody::Dynamic, Collider::circle(0.5), Transform::from_xyz(0.0, 4.0, 0.0));
//! let ball = app.world_mut().spawn(ball).id();
//! for _ in 0..180 {
//!     app.world_mut().run_schedule(FixedUpdate);
//! }
//! assert!((app.world().get::<Transform>(ball).unwrap().translation.y - 0.5).abs() < 0.01);
//! ```
//!
//! # Contents
//!
//! | to | use |
//! |---|---|
//! | begin | [`PhysicsPlugin`], [`PhysicsSystems`] |
//! | make bodies | [`RigidBody`], [`Velocity`], [`Damping`], [`GravityScale`], [`LockedAxes`], [`Mass`], [`Enabled`], [`CanSleep`] |
//! | give them shapes | [`Collider`], on the body or below it; [`Friction`], [`Restitution`], [`Density`], [`CollisionFilter`], [`Sensor`], [`OneWay`] |
//! | draw ground | [`TileMap`], [`Collider::chain`] |
//! | push | [`ExternalForce`], [`ExternalImpulse`], [`KinematicTarget`] |
//! | join | [`Joint`] |
//! | let somebody walk | [`Character`], [`CharacterInput`], [`CharacterState`] |
//! | learn what happened | [`CollisionEvents`], [`HitEvents`], and the messages: [`CollisionStarted`], [`Hit`], [`SensorEntered`], [`JointBroke`], ... |
//! | ask what is where | [`PhysicsQuery`] |
//! | go back in time, do what is not listed here | [`PhysicsWorld`] |
//! | learn what is wrong | [`PhysicsProblem`], and [`PhysicsDoctorPlugin`] under the feature `doctor` |
//! | see | [`PhysicsDebugPlugin`] under the feature `gizmos` |
//!
//! # Units and frames
//!
//! Metres, kilograms, seconds, radians; y points up. Bodies work best between 0.1 and 10 m: let the camera scale, not the
//! world (or see [`PhysicsPlugin::settings`] for a world in pixels). Bodies live in the plane: z is left as it is, of a rotation the
//! turn about z counts.
//!
//! # Order and determinism
//!
//! Bodies that are new are handed to the world in an order that follows from what they are: [`BodyOrder`] first, then kind, place, and
//! all the rest. Neither the order in which entities were spawned, nor archetypes, nor entity numbers play a part; two that tie are equal in
//! everything. So the same level gives the same [`state_hash`](tiny_physics::World::state_hash) on every peer.

mod components;
#[cfg(feature = "gizmos")]
mod debug;
#[cfg(feature = "doctor")]
mod doctor;
mod frame;
mod messages;
mod order;
mod plugin;
mod queries;
mod sync;
mod world;

pub use components::*;
#[cfg(feature = "gizmos")]
pub use debug::{PhysicsDebug, PhysicsDebugPlugin};
#[cfg(feature = "doctor")]
pub use doctor::{PhysicsDoctor, PhysicsDoctorPlugin, PhysicsFinding};
pub use messages::*;
pub use plugin::{PhysicsPlugin, PhysicsSystems};
pub use queries::{EntityFilter, EntityHit, PhysicsQuery};
pub use world::PhysicsWorld;

pub use tiny_physics;
#[cfg(feature = "doctor")]
pub use tiny_physics_doctor;

/// What most games need: `use bevy_tiny_physics::prelude::*;`.
pub mod prelude {
    pub use crate::components::*;
    #[cfg(feature = "gizmos")]
    pub use crate::debug::{PhysicsDebug, PhysicsDebugPlugin};
    #[cfg(feature = "doctor")]
    pub use crate::doctor::{PhysicsDoctorPlugin, PhysicsFinding};
    pub use crate::messages::*;
    pub use crate::plugin::{PhysicsPlugin, PhysicsSystems};
    pub use crate::queries::{EntityFilter, PhysicsQuery};
    pub use crate::world::PhysicsWorld;
    pub use tiny_physics::{
        ChainDef, Filter, JointDef, JointKind, Limits, Motor, Shape, ShapeDef, Spring, TileGrid,
    };
}
