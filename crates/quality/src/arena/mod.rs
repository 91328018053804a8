//! The arena: random worlds, each drawn from its seed, and measures that any engine can be held against.
//!
//! [`draw`] makes a world of a seed; [`play`] plays it in an engine and gives its [`Findings`]; [`shrink`] makes a world
//! smaller as long as it shows the same. A world is a scene, so it can be saved, looked at and played by anything.

mod judge;
mod parts;
mod shapes;
mod shrink;
mod topology;
mod worlds;

pub use judge::{Claim, Findings, play};
pub use shrink::shrink;
pub use worlds::{STEPS, draw};

use tiny_physics::SimdLevel;
use tiny_physics_scenes::{Run, Scene};

/// Plays a world at the plainest and the best SIMD level, and on three threads: the hashes after its last step, and whether the world
/// then is sound.
///
/// # Errors
/// What the world refuses, or finds unsound.
pub fn bits(scene: &Scene) -> Result<[u64; 3], String> {
    let play = |level: SimdLevel, threads: usize| {
        let mut run = Run::start(scene).map_err(|error| error.to_string())?;
        run.world_mut().set_simd(level).map_err(|error| error.to_string())?;
        run.world_mut().set_threads(threads);
        while !run.is_done() {
            run.step();
        }
        run.world().validate()?;
        Ok::<u64, String>(run.world().state_hash())
    };
    let best = SimdLevel::detect();
    Ok([play(SimdLevel::Scalar, 1)?, play(best, 1)?, play(best, 3)?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{our_engine, still};

    #[test]
    fn a_seed_is_a_world_that_can_be_read_again() {
        for seed in 0..200 {
            let scene = draw(seed);
            assert_eq!(scene, draw(seed));
            let text = scene.to_json().unwrap_or_else(|error| panic!("seed {seed}: {error}"));
            assert_eq!(Scene::from_json(&text).expect("it was written just now"), scene);
        }
    }

    #[test]
    fn nothing_is_found_in_a_world_that_stands_still() {
        for seed in 0..20 {
            let found = play(&draw(seed), &still, &|| 0.0);
            assert_eq!((found.not_finite, found.passed), (0, 0), "seed {seed}");
        }
    }

    #[test]
    fn what_rolls_is_at_rest_and_what_slides_is_not() {
        use tiny_physics::{RigidBody, Shape, ShapeDef, Vec2};
        let found = |shape: Shape| {
            let mut scene = draw(1);
            (scene.bodies, scene.joints, scene.script) = (Vec::new(), Vec::new(), None);
            scene.steps = 120;
            let ground = Shape::rect(100.0, 1.0).expect("a ground");
            scene.body(RigidBody::fixed().position(Vec2::new(0.0, -1.0)).shape(ground));
            let friction = if matches!(shape, Shape::Circle { .. }) { 0.6 } else { 0.0 };
            let body = RigidBody::dynamic().position(Vec2::new(0.0, 0.5));
            let body = body.velocity(Vec2::new(1.0, 0.0)).angular_velocity(-2.0);
            scene.body(body.shape(ShapeDef::new(shape).friction(friction)));
            let found = play(&scene, &our_engine, &|| 0.0);
            (found.restless.expect("it should rest"), found.asleep.expect("it should sleep"))
        };
        let (restless, asleep) = found(Shape::Circle { radius: 0.5 });
        assert!(restless < 0.01 && asleep < 0.1, "a ball: {restless} m/s, {asleep} s");
        let (restless, asleep) = found(Shape::rect(0.5, 0.5).expect("a crate"));
        assert!(restless > 0.5 && asleep > 2.0, "a crate: {restless} m/s, {asleep} s");
    }

    /// Where nothing falls, crates that overlap by the last digit of their places drift apart by nanometres a second.
    #[test]
    fn rounding_is_no_energy() {
        for seed in [906, 987, 1059] {
            let found = play(&draw(seed), &our_engine, &|| 0.0);
            assert!(found.gain.expect("nothing adds any") < 1e-6, "seed {seed}: {:?}", found.gain);
        }
    }

    #[test]
    fn what_swings_need_not_rest() {
        use tiny_physics::{JointDef, RigidBody, Shape, Vec2};
        for joined in [true, false] {
            let mut scene = draw(1);
            (scene.bodies, scene.joints, scene.script) = (Vec::new(), Vec::new(), None);
            scene.steps = 120;
            scene.gravity = Vec2::new(0.0, -10.0);
            let origin = scene.body(RigidBody::fixed());
            let body = RigidBody::dynamic().position(Vec2::new(2.0, 0.0));
            let body = scene.body(body.shape(Shape::rect(0.5, 0.5).expect("a crate")));
            if joined {
                scene.joint(
                    origin,
                    body,
                    JointDef::revolute().anchors(Vec2::ZERO, Vec2::new(-2.0, 0.0)),
                );
            }
            let found = play(&scene, &our_engine, &|| 0.0);
            let restless = found.restless.expect("it should rest");
            assert_eq!(restless < 0.01, joined, "{restless} m/s, joined: {joined}");
        }
    }

    #[test]
    fn a_ball_that_flies_through_a_wall_is_seen() {
        use tiny_physics::{RigidBody, Shape, Vec2};
        let mut scene = draw(1);
        (scene.bodies, scene.joints, scene.script) = (Vec::new(), Vec::new(), None);
        scene.gravity = Vec2::ZERO;
        scene.steps = 30;
        // A sensor-less wall that is a bullet's neighbour only: swept bodies stop, so the wall is put in their way by hand.
        scene.settings.continuous = false;
        scene.body(RigidBody::fixed().shape(shapes::rect(0.05, 2.0)));
        let ball = RigidBody::dynamic()
            .position(Vec2::new(-4.0, 0.0))
            .shape(Shape::Circle { radius: 0.1 });
        scene.body(ball.velocity(Vec2::new(390.0, 0.0)));
        assert_eq!(play(&scene, &our_engine, &|| 0.0).passed, 1);
    }

    #[test]
    fn what_is_not_solid_for_each_other_passes() {
        use tiny_physics::{Filter, RigidBody, ShapeDef, Vec2};
        let mut scene = draw(1);
        (scene.bodies, scene.joints, scene.script) = (Vec::new(), Vec::new(), None);
        scene.gravity = Vec2::ZERO;
        scene.steps = 30;
        // A body and another's ghostly part: the solid parts pass far above each other.
        let ghost =
            ShapeDef::new(shapes::rect(0.2, 0.2)).filter(Filter { mask: 0, ..Filter::default() });
        let high =
            ShapeDef { offset: Vec2::new(0.0, 3.0), ..ShapeDef::new(shapes::rect(0.2, 0.2)) };
        scene.body(RigidBody::fixed().shape(shapes::rect(0.2, 0.2)));
        let body =
            RigidBody::dynamic().position(Vec2::new(-1.0, 0.0)).velocity(Vec2::new(5.0, 0.0));
        scene.body(body.shape(ghost).shape(high));
        let found = play(&scene, &our_engine, &|| 0.0);
        assert_eq!((found.passed, found.deepest), (0, 0.0));
    }

    #[test]
    fn shrinking_keeps_what_is_asked_for() {
        let scene = draw(3);
        let balls =
            |scene: &Scene| scene.bodies.iter().filter(|body| body.shapes.len() == 1).count();
        let least = shrink(&scene, 200, &mut |smaller| balls(smaller) >= 3);
        assert_eq!((balls(&least), least.bodies.len()), (3, 3));
    }
}
