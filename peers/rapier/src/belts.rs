//! Surfaces that run, through Rapier's hook for contacts: it has them nowhere else.

use rapier2d::prelude::*;
use std::collections::HashMap;

/// Surface speeds of colliders, metres a second, positive clockwise round the shape.
#[derive(Default)]
pub struct Belts {
    speeds: HashMap<ColliderHandle, f32>,
}

impl Belts {
    /// A collider's surface runs; the collider must have [`ActiveHooks::MODIFY_SOLVER_CONTACTS`].
    pub fn add(&mut self, collider: ColliderHandle, speed: f32) {
        self.speeds.insert(collider, speed);
    }
}

impl PhysicsHooks for Belts {
    fn modify_solver_contacts(&self, context: &mut ContactModificationContext) {
        let speed = |collider| self.speeds.get(&collider).copied().unwrap_or_default();
        // Seen from the other side of the contact the other surface runs the other way: the two add up.
        let speed = speed(context.collider1) + speed(context.collider2);
        if let Some(manifold) = context.rigid_mut() {
            let n = *manifold.normal;
            for contact in manifold.solver_contacts.iter_mut() {
                contact.tangent_velocity = Vector::new(n.y, -n.x) * speed;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::world::Rapier;
    use peers_worker::{Engine, Host, Setup, Tuning};
    use tiny_physics::{Polygon, RigidBody, Settings, Shape, ShapeDef, Vec2};

    #[test]
    fn a_belt_with_a_positive_speed_carries_to_the_right() {
        for belt_first in [true, false] {
            let mut world = Rapier::create(&Setup {
                gravity: Vec2::new(0.0, -10.0),
                settings: &Settings::default(),
                tuning: Tuning::Own,
                threads: 1,
                setting: "",
            })
            .expect("one thread and no setting");
            let rect = |w, h| -> Shape { Polygon::rect(w, h).expect("positive sizes").into() };
            let belt = ShapeDef::new(rect(50.0, 1.0)).tangent_speed(2.0);
            let belt = RigidBody::fixed().shape(belt).position(Vec2::new(0.0, -1.0));
            let load = RigidBody::dynamic().shape(rect(0.5, 0.5)).position(Vec2::new(0.0, 0.5));
            let load = if belt_first {
                world.add_body(&belt);
                world.add_body(&load)
            } else {
                let load = world.add_body(&load);
                world.add_body(&belt);
                load
            };
            (0..180).for_each(|_| world.step(1.0 / 60.0));
            let speed = world.velocity(load).x;
            assert!((speed - 2.0).abs() < 0.01, "{speed}, belt first: {belt_first}");
        }
    }
}
