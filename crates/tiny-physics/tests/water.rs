//! Things in water: that what is light floats quietly.

use tiny_physics::{QueryFilter, RigidBody, Shape, ShapeDef, Vec2, Water, World};

const DT: f32 = 1.0 / 60.0;

/// Planks and logs of default density, a thousandth of the water's, float on it, however thin they are and however they
/// fall in: they were thrown out of it, by up to 28 m/s and 37 m high.
#[test]
fn what_is_light_floats_quietly() {
    let forms = [(0.38, 0.1), (0.5, 0.05), (1.0, 0.02), (0.3, 0.3), (1.0, 0.5), (0.2, 0.0)];
    let falls =
        [(0.1, 0.0, 1.0), (0.5, 0.3, 1.0), (2.0, 1.3, 1.0), (0.1, -0.2, 5.0), (1.0, 0.7, 20.0)];
    for ((x, y), (drop, angle, density)) in
        forms.into_iter().flat_map(|form| falls.map(|fall| (form, fall)))
    {
        for dt in [DT, 0.5 * DT] {
            let mut world = World::new(Vec2::new(0.0, -10.0));
            let shape = if y > 0.0 { Shape::rect(x, y) } else { Shape::circle(x) };
            let plank = RigidBody::dynamic().position(Vec2::new(0.0, x + y + drop)).angle(angle);
            let shape = ShapeDef::new(shape.unwrap()).density(density);
            let plank = world.add_body(plank.shape(shape)).unwrap();
            let name = format!("{x} by {y} from {drop} m at {angle}, {density} kg/m2, {dt} s");
            let most = (20.0_f32 * (drop + x + y) + 1.0).sqrt().max(5.5);
            let (mut speed, mut late) = (0.0, 0.0_f32);
            for step in 0..(12.0 / dt) as u32 {
                world.apply_water(&Water::default(), &QueryFilter::new(), dt);
                world.step(dt);
                speed = world.body(plank).unwrap().velocity().length();
                assert!(speed < most, "{name}: {speed} m/s in step {step}");
                late = if step as f32 * dt > 10.0 { late.max(speed) } else { 0.0 };
            }
            assert!(late < 1.0, "{name}: {late} m/s at last");
            let deep = (1.0 - density / 500.0) * y;
            let off = (world.body(plank).unwrap().position().y - deep).abs();
            let lies = x > 1.5 * y && y > 0.0 && angle < 1.0 && speed < 0.01;
            assert!(!lies || off < 0.002, "{name}: {off} m off");
        }
    }
}
