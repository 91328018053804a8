//! Bodies whose numbers stopped being finite.

use super::World;
use crate::dynamics::SavedPoint;
use crate::math::Vec2;

impl World {
    /// Stops a body where it last was, and lets all that acts on it start anew: what has been gathered there may
    /// not be finite either and would come back in the next step.
    pub(super) fn freeze(&mut self, index: u32) {
        self.state.bodies.stop(index);
        let info = &mut self.state.bodies.infos[index as usize];
        info.force = Vec2::ZERO;
        info.torque = 0.0;
        self.forget_joint_impulses(index);
        self.forget_contact_impulses(index);
        // They reached as far as it would have gone.
        self.update_boxes(index);
    }

    fn forget_joint_impulses(&mut self, index: u32) {
        for (joint, _) in self.joints_and_partners(index) {
            self.state.displace_joint(joint);
            self.state.joints.records[joint as usize].saved = Default::default();
            self.state.place_joint(joint);
        }
    }

    fn forget_contact_impulses(&mut self, index: u32) {
        for contact in self.contacts_where(index, |_| true) {
            self.state.displace_contact(contact);
            self.state.contacts.records[contact as usize].saved = [SavedPoint::NONE; 2];
            self.state.place_contact(contact);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{JointDef, RigidBody, Shape, SimdLevel};

    /// Poison in one box of a heap: the step reports it, nothing is NaN afterwards, what is far away has
    /// not noticed, and the heap comes to rest again.
    #[test]
    fn poison_does_not_spread() {
        let build = |poison: f32| {
            let mut world = World::new(Vec2::new(0.0, -9.8));
            let ground = RigidBody::fixed().shape(Shape::rect(40.0, 1.0).unwrap());
            world.add_body(ground).unwrap();
            let mut ids = Vec::new();
            for i in 0..20 {
                let place = Vec2::new((i % 4) as f32 * 0.9, 1.6 + (i / 4) as f32 * 1.1);
                let shape = Shape::rect(0.5, 0.5).unwrap();
                let body = RigidBody::dynamic().position(place).shape(shape);
                ids.push(world.add_body(body).unwrap());
            }
            let ball = RigidBody::dynamic().position(Vec2::new(30.0, 9.0));
            let far = world.add_body(ball.shape(Shape::circle(0.5).unwrap())).unwrap();
            world.add_joint(ids[3], ids[7], JointDef::revolute()).unwrap();
            (0..30).for_each(|_| world.step(1.0 / 60.0));
            let row = &mut world.state.bodies.rows[ids[6].index()];
            row[0] += poison;
            world.step(1.0 / 60.0);
            (world, ids, far)
        };
        let (clean, _, clean_far) = build(0.0);
        for poison in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let (mut world, ids, far) = build(poison);
            assert!(world.stats().frozen_bodies > 0 && clean.stats().frozen_bodies == 0);
            world.validate().unwrap();
            let place = |world: &World, id| world.body(id).unwrap().position();
            assert_eq!(place(&world, far), place(&clean, clean_far));
            world.step(1.0 / 60.0);
            assert_eq!(world.stats().frozen_bodies, 0);
            (0..300).for_each(|_| world.step(1.0 / 60.0));
            world.validate().unwrap();
            for id in ids {
                let body = world.body(id).unwrap();
                assert!(body.position().y < 8.0 && body.velocity().length() < 0.5);
            }
        }
    }

    /// A world of absurd masses, speeds, joints and forces after some steps.
    fn blown_up(seed: u32, level: SimdLevel, threads: usize) -> (World, u64) {
        let mut state = seed.wrapping_mul(747_796_405).wrapping_add(1);
        let mut random = |low: f32, high: f32| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            low + (high - low) * ((state >> 8) as f32 / (1 << 24) as f32)
        };
        let mut world = World::new(Vec2::new(0.0, -10.0));
        world.set_simd(level).unwrap();
        world.set_threads(threads);
        let floor = RigidBody::fixed().position(Vec2::new(0.0, -1.0));
        world.add_body(floor.shape(Shape::rect(20.0, 1.0).unwrap())).unwrap();
        let masses = [1.0e-9, 1.0e-6, 1.0e-3, 1.0, 1.0e3, 1.0e9, 1.0e12];
        let mut bodies: Vec<crate::BodyId> = Vec::new();
        for i in 0..40 {
            let place = Vec2::new(random(-5.0, 5.0), random(0.0, 6.0));
            let shape = match i % 3 {
                0 => Shape::rect(0.5, 0.3).unwrap(),
                1 => Shape::circle(0.4).unwrap(),
                _ => Shape::from(crate::Polygon::regular(5, 0.4).unwrap()),
            };
            let mass = masses[random(0.0, 6.99) as usize];
            let body = RigidBody::dynamic().position(place).shape(shape).mass(mass);
            let fast = Vec2::new(random(-1.0e18, 1.0e18), random(-1.0e18, 1.0e18));
            let body = if i % 5 == 0 { body.velocity(fast).angular_velocity(1.0e18) } else { body };
            let id = world.add_body(body).unwrap();
            if let (Some(&other), 0) = (bodies.last(), i % 2) {
                let anchor = Vec2::new(random(-9.0, 9.0), random(-9.0, 9.0));
                let def = match i % 8 {
                    0 => JointDef::revolute().motor(1.0e9, 1.0e30),
                    2 => JointDef::distance(1.0e6).spring(1.0e6, 1.0e6),
                    4 => JointDef::weld(),
                    _ => JointDef::prismatic(Vec2::X).motor(-1.0e12, 1.0e30),
                };
                // Trees bear all this; soft joints are solved in lanes.
                let def = def.softness(500.0, 1.0).anchors(anchor, Vec2::ZERO);
                world.add_joint(other, id, def).unwrap();
            }
            bodies.push(id);
        }
        let mut frozen = 0;
        for step in 0..120 {
            let mut body = world.body_mut(bodies[step % 40]).unwrap();
            body.apply_force_to_center(Vec2::new(1.0e15, -1.0e15));
            body.apply_torque(1.0e15);
            world.step(1.0 / 60.0);
            frozen += world.stats().frozen_bodies as u64;
        }
        (world, frozen)
    }

    #[test]
    fn blown_up_worlds_have_the_same_bits() {
        let mut frozen = 0;
        for seed in 0..16 {
            let (expected, count) = blown_up(seed, SimdLevel::detect(), 1);
            expected.validate().unwrap();
            frozen += count;
            let others = SimdLevel::available().map(|level| (level, 1));
            for (level, threads) in others.chain([(SimdLevel::detect(), 3)]) {
                let (world, _) = blown_up(seed, level, threads);
                let same = world.state_hash() == expected.state_hash();
                assert!(same, "seed {seed}: {level} on {threads} threads differs");
                assert!(world.to_bytes() == expected.to_bytes(), "seed {seed}: bytes of {level}");
            }
        }
        assert!(frozen > 100, "{frozen} bodies were frozen: these worlds do not blow up");
    }
}
