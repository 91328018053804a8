//! Sensors see what is there and change nothing.

mod common;

use common::{DT, Random, circle, rect, steps, world, world_with_floor};
use tiny_physics::{RigidBody, Shape, ShapeDef, Vec2};

/// Before, no end was told where all slept, until something moved.
#[test]
fn what_a_sensor_saw_ends_when_one_of_them_is_disabled_in_their_sleep() {
    for of_sensor in [false, true] {
        let mut world = world_with_floor();
        let gate =
            RigidBody::fixed().position((0.0, 1.0)).shape(ShapeDef::new(rect(2.0, 2.0)).sensor());
        let gate = world.add_body(gate).expect("a gate");
        let crate_ = RigidBody::dynamic().position((0.0, 0.5)).shape(rect(0.5, 0.5));
        let crate_ = world.add_body(crate_).expect("a crate");
        steps(&mut world, 200);
        let sensor = world.body(gate).and_then(|gate| gate.shapes().next()).expect("a sensor");
        assert_eq!(world.sensor_overlaps(sensor).count(), 1);
        let goes = if of_sensor { gate } else { crate_ };
        world.body_mut(goes).expect("a body").set_enabled(false);
        let mut ends = 0;
        for _ in 0..10 {
            world.step(DT);
            ends += world.events().sensor_end().len();
        }
        assert_eq!((ends, world.sensor_overlaps(sensor).count()), (1, 0), "{of_sensor}");
    }
}

/// A ball in a bowl swings as far with a sensor of no mass about it as without. Before, it came to rest: the sensor counted for how far
/// its rim goes.
#[test]
fn a_sensor_without_mass_brakes_nothing() {
    let mut random = Random::new(7);
    for member in 0..8 {
        let (radius, start) = (random.range(0.6, 3.0), random.range(0.03, 0.2));
        let places = [false, true].map(|sees| {
            let mut world = world();
            let bowl = world.add_body(RigidBody::fixed()).expect("a bowl");
            let points = (0..=80).map(|i| -1.3 + 2.6 * i as f32 / 80.0);
            let at = |angle: f32| Vec2::new(4.0 * angle.sin(), 4.0 - 4.0 * angle.cos());
            let points: Vec<Vec2> = points.map(at).collect();
            for side in points.windows(2) {
                world.add_shape(bowl, Shape::Segment { a: side[0], b: side[1] }).expect("a side");
            }
            let place = Vec2::new(3.5 * start.sin(), 4.0 - 3.5 * start.cos());
            let mut ball = RigidBody::dynamic().position(place).shape(circle(0.5));
            if sees {
                ball = ball.shape(ShapeDef::new(circle(radius)).sensor().density(0.0));
            }
            let ball = world.add_body(ball).expect("a ball");
            steps(&mut world, 600);
            world.body(ball).expect("a ball").position()
        });
        assert_eq!(places[0], places[1], "{member}: {radius}");
    }
}

/// The beam of a lighthouse sees what it passes within a step.
#[test]
fn a_sensor_that_turns_fast_sees_what_it_passes() {
    let mut world = world();
    let beam = ShapeDef::new(rect(2.0, 0.05)).sensor().offset(Vec2::new(2.5, 0.0)).density(0.0);
    let tower = RigidBody::dynamic().shape(circle(0.5)).shape(beam).gravity_scale(0.0);
    let tower = world.add_body(tower.angular_velocity(20.0)).expect("a tower");
    let at = Vec2::new(3.9 * 0.16_f32.cos(), 3.9 * 0.16_f32.sin());
    world.add_body(RigidBody::fixed().position(at).shape(circle(0.05))).expect("a mark");
    steps(&mut world, 1);
    let turned = world.body(tower).expect("a tower").angle();
    assert!(turned > 0.25, "{turned} rad");
    assert_eq!(world.events().sensor_begin().len(), 1);
}
