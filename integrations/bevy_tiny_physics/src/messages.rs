//! What is told: events of a step, with entities.

use bevy_ecs::prelude::*;
use tiny_physics::{Error, UserData};

/// A component asked for something that cannot be. The entity is left as it was, and tried again when the component changes. It is logged, too.
///
/// A body, a character or ground that was refused altogether is tried again when any of its components changes or goes, or its place does,
/// and told again only if something else is wrong then.
#[derive(Message, Clone, PartialEq, Debug)]
pub struct PhysicsProblem {
    /// The entity; `None` where it is about the whole world.
    pub entity: Option<Entity>,
    /// What was being done: "collider", "joint", ...
    pub what: &'static str,
    /// What was wrong.
    pub error: Error,
}

/// Declares a message about two colliders. Entities are as they were when it came about, whatever has been despawned since.
macro_rules! pair_message {
    ($(#[$meta:meta])* $name:ident { $($(#[$field_meta:meta])* $field:ident: $type:ty,)* }) => {
        $(#[$meta])*
        #[derive(Message, Clone, Copy, PartialEq, Debug)]
        pub struct $name {
            /// The first collider.
            pub collider_a: Entity,
            /// The second collider.
            pub collider_b: Entity,
            /// Its body: the same entity, or one above it.
            pub body_a: Entity,
            /// Body of the second.
            pub body_b: Entity,
            /// The user's numbers of the first.
            pub data_a: UserData,
            /// The user's numbers of the second.
            pub data_b: UserData,
            $($(#[$field_meta])* pub $field: $type,)*
        }

        impl $name {
            /// The other body, if `body` is one of the two.
            pub fn other(&self, body: Entity) -> Option<Entity> {
                match body {
                    _ if body == self.body_a => Some(self.body_b),
                    _ if body == self.body_b => Some(self.body_a),
                    _ => None,
                }
            }
        }
    };
}

pair_message! {
    /// Two colliders began to touch; asked for by [`CollisionEvents`](crate::CollisionEvents).
    CollisionStarted {}
}
pair_message! {
    /// Two colliders touch no longer, or one of them is gone.
    CollisionEnded {}
}
pair_message! {
    /// Two colliders hit each other fast; asked for by [`HitEvents`](crate::HitEvents). Loudness and damage go by the impulse.
    Hit {
        /// Where: world, metres.
        point: bevy_math::Vec2,
        /// Unit, from A to B.
        normal: bevy_math::Vec2,
        /// Approach speed, metres a second.
        speed: f32,
        /// Newton seconds.
        impulse: f32,
        /// Mass of body A, kilograms; 0 where it is not dynamic.
        mass_a: f32,
        /// Mass of body B.
        mass_b: f32,
    }
}

/// A collider came into a sensor.
#[derive(Message, Clone, Copy, PartialEq, Debug)]
pub struct SensorEntered {
    /// The sensor's collider.
    pub sensor: Entity,
    /// The collider that it sees.
    pub visitor: Entity,
    /// Body of the sensor.
    pub sensor_body: Entity,
    /// Body of the visitor.
    pub visitor_body: Entity,
}

/// A collider is in a sensor no longer, or one of both is gone.
#[derive(Message, Clone, Copy, PartialEq, Debug)]
pub struct SensorLeft {
    /// The sensor's collider.
    pub sensor: Entity,
    /// The collider that it saw.
    pub visitor: Entity,
    /// Body of the sensor.
    pub sensor_body: Entity,
    /// Body of the visitor.
    pub visitor_body: Entity,
}

/// A joint bore more than it can. The [`Joint`](crate::Joint) has been taken off its entity.
#[derive(Message, Clone, Copy, PartialEq, Debug)]
pub struct JointBroke {
    /// Entity of the joint.
    pub joint: Entity,
    /// Its body A.
    pub body_a: Entity,
    /// Its body B.
    pub body_b: Entity,
    /// Greatest force in the step, newtons.
    pub force: f32,
    /// Greatest torque, newton metres.
    pub torque: f32,
}

/// A body woke.
#[derive(Message, Clone, Copy, PartialEq, Eq, Debug)]
pub struct BodyWoke(pub Entity);

/// A body fell asleep.
#[derive(Message, Clone, Copy, PartialEq, Eq, Debug)]
pub struct BodyFellAsleep(pub Entity);
