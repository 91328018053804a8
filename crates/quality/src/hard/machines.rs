//! Cars, motors, pendulums and gears.

use super::common::ghost;
use crate::lab::{Lab, greatest};
use crate::report::Measure;
use crate::scenery::{GRAVITY, disk, fixed, moving, rect, scene};
use crate::target::Target;
use core::f64::consts::{FRAC_PI_2, PI, TAU};
use tiny_physics::{JointDef, RigidBody, ShapeDef, Vec2};
use tiny_physics_scenes::Scene;

/// A car on soft springs drives fast over bumps: how far is a wheel off its axis?
pub(super) fn car(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (speed, hertz, bump) = lab.pick((30.0, 5.0, 0.1), (22.0, 4.0, 0.13));
    let mut scene = scene("car");
    scene.body(fixed(rect(200.0, 1.0), Vec2::new(150.0, -1.0)));
    for i in 0..40 {
        let x = 8.0 + 4.1 * i as f32;
        scene.body(fixed(disk(0.5), Vec2::new(x, bump - 0.5)));
    }
    let radius = 0.4;
    let go = |body: RigidBody| body.velocity(Vec2::new(speed, 0.0));
    let chassis = scene.body(go(moving(rect(1.5, 0.3), Vec2::new(0.0, 1.1))));
    let axles = [Vec2::new(-1.1, -0.7), Vec2::new(1.1, -0.7)];
    for axle in axles {
        let tyre = ShapeDef::new(disk(radius)).friction(0.9);
        let wheel = go(moving(tyre, Vec2::new(axle.x, radius))).angular_velocity(-speed / radius);
        let wheel = scene.body(wheel);
        let joint = JointDef::wheel(Vec2::Y).spring(hertz, 0.7).limits(-0.3, 0.3);
        scene.joint(chassis, wheel, joint.anchors(axle, Vec2::ZERO));
    }
    lab.expect_seconds(5.0, scene.dt);
    let mut trial = lab.build(scene);
    let mut worst: f64 = 0.0;
    lab.run(&mut trial, 5.0, |trial| {
        let (s, c) = trial.angle(chassis).sin_cos();
        let off = |i: usize| {
            let (axle, wheel) = (trial.point(chassis, axles[i]), trial.position(chassis + 1 + i));
            (c * (wheel.x - axle.x) + s * (wheel.y - axle.y)).abs()
        };
        worst = greatest([worst, off(0), off(1)].into_iter());
    });
    let metric = format!("{speed} m/s, springs of {hertz} Hz, wheel off its axis");
    vec![Measure::new(metric, worst, "m", Target::AtMost(0.03))]
}

/// A very strong hinge motor drives a light bar against its limit: does it stay there?
pub(super) fn motor_against_limit(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (mass, torque, limit) = lab.pick((0.4, 1e6, 0.5), (0.2, 3e5, 1.0));
    let mut scene = scene("motor against limit");
    let wall = scene.body(RigidBody::fixed());
    let bar = scene.body(moving(ghost(rect(0.5, 0.1)), Vec2::new(0.5, 0.0)).mass(mass));
    let hinge = JointDef::revolute().limits(-limit, limit).motor(10.0, torque);
    scene.joint(wall, bar, hinge.anchors(Vec2::ZERO, Vec2::new(-0.5, 0.0)));
    lab.expect_seconds(4.0, scene.dt);
    let mut trial = lab.build(scene);
    let (mut rattle, mut off) = (0.0_f64, 0.0_f64);
    lab.run(&mut trial, 4.0, |trial| {
        if trial.time() > 1.0 {
            rattle = greatest([rattle, trial.angular_velocity(bar).abs()].into_iter());
            off = greatest([off, (trial.angle(bar) - f64::from(limit)).abs()].into_iter());
        }
    });
    vec![
        Measure::new("turning at the limit", rattle, "rad/s", Target::AtMost(0.01)),
        Measure::new("angle off the limit", off, "rad", Target::AtMost(0.005)),
    ]
}

/// A double pendulum of rods, let go from the horizontal, against its equations of motion.
pub(super) fn double_pendulum(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (length, lower) = lab.pick((1.0, 0.0), (1.4, 0.5));
    let mut scene = double_pendulum_scene(length, lower);
    scene.name = "double pendulum".into();
    lab.expect_seconds(60.0, scene.dt);
    let mut trial = lab.build(scene);
    let lowest = -2.0 * trial.mass(1) * GRAVITY * f64::from(length);
    let start = trial.energy() - lowest;
    lab.run(&mut trial, 1.0, |_| {});
    let angles = rods_after_a_second(f64::from(length), f64::from(lower));
    let error = |rod: usize| {
        let off = trial.angle(rod + 1) + FRAC_PI_2 - angles[rod];
        ((off + PI).rem_euclid(TAU) - PI).abs()
    };
    let errors = [error(0), error(1)];
    let mut gain: f64 = 0.0;
    lab.run(&mut trial, 59.0, |trial| {
        gain = greatest([gain, (trial.energy() - lowest) / start].into_iter());
    });
    let kept = (trial.energy() - lowest) / start;
    let angle = |name: &str, error| Measure::new(name, error, "rad", Target::AtMost(0.002));
    vec![
        angle("upper angle after 1 s, error", errors[0]),
        angle("lower angle after 1 s, error", errors[1]),
        Measure::new(
            "energy after 60 s over that at the start",
            kept,
            "",
            Target::AtLeast { limit: 0.95, ideal: 1.0 },
        ),
        Measure::new("energy on the way at most", gain, "", Target::AtMost(1.01)),
    ]
}

/// Two rods on hinges, the upper one level, the lower one turned up by an angle against it.
pub(super) fn double_pendulum_scene(length: f32, lower: f32) -> Scene {
    let mut scene = scene("double pendulum");
    let post = scene.body(RigidBody::fixed());
    let half = 0.5 * length;
    let rod = || ghost(rect(half, 0.05));
    let (near, far) = (Vec2::new(-half, 0.0), Vec2::new(half, 0.0));
    let upper = scene.body(moving(rod(), far));
    let along = Vec2::new(lower.cos(), lower.sin()) * half;
    let hanging = scene.body(moving(rod(), far * 2.0 + along).angle(lower));
    scene.joint(post, upper, JointDef::revolute().anchors(Vec2::ZERO, near));
    scene.joint(upper, hanging, JointDef::revolute().anchors(far, near));
    scene
}

/// Angles from the vertical of two rods of a length after a second, by Runge and Kutta's fourth order.
fn rods_after_a_second(length: f64, lower: f64) -> [f64; 2] {
    const STEPS: u32 = 20_000;
    let h = 1.0 / f64::from(STEPS);
    let mut state = [FRAC_PI_2, FRAC_PI_2 + lower, 0.0, 0.0];
    let plus = |state: [f64; 4], slope: [f64; 4], h: f64| {
        core::array::from_fn(|i| state[i] + h * slope[i])
    };
    for _ in 0..STEPS {
        let k1 = rod_slope(state, length);
        let k2 = rod_slope(plus(state, k1, 0.5 * h), length);
        let k3 = rod_slope(plus(state, k2, 0.5 * h), length);
        let k4 = rod_slope(plus(state, k3, h), length);
        state = core::array::from_fn(|i| {
            state[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i])
        });
    }
    [state[0], state[1]]
}

/// Lagrange's equations of two equal rods of unit mass, 0.1 m thick: `A q'' = f`.
fn rod_slope([upper, lower, w1, w2]: [f64; 4], l: f64) -> [f64; 4] {
    let inertia = (l * l + 0.01) / 12.0;
    let (s, c) = (upper - lower).sin_cos();
    let (a11, a22, a12) = (inertia + 1.25 * l * l, inertia + 0.25 * l * l, 0.5 * l * l * c);
    let f1 = -0.5 * l * l * s * w2 * w2 - 1.5 * GRAVITY * l * upper.sin();
    let f2 = 0.5 * l * l * s * w1 * w1 - 0.5 * GRAVITY * l * lower.sin();
    let det = a11 * a22 - a12 * a12;
    [w1, w2, (f1 * a22 - f2 * a12) / det, (f2 * a11 - f1 * a12) / det]
}

/// A train of gears, driven and braked by strong motors: does it slip?
pub(super) fn gear_train(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (torque, ratio) = lab.pick((5000.0, 1.0_f32), (3000.0, 2.0));
    let mut scene = scene("gear train");
    let wall = scene.body(RigidBody::fixed());
    for i in 0..4 {
        let place = Vec2::new(2.1 * i as f32, 0.0);
        let wheel = scene.body(moving(ghost(disk(1.0)), place));
        let axle = JointDef::revolute().anchors(place, Vec2::ZERO);
        let axle = match i {
            0 => axle.motor(5.0, torque),
            3 => axle.motor(0.0, 0.8 * torque / ratio.powi(3)),
            _ => axle,
        };
        scene.joint(wall, wheel, axle);
        if i > 0 {
            scene.joint(wheel - 1, wheel, JointDef::gear(ratio));
        }
    }
    lab.expect_seconds(4.0, scene.dt);
    let mut trial = lab.build(scene);
    let mut turned = [0.0_f64; 4];
    let mut slip: f64 = 0.0;
    lab.run(&mut trial, 4.0, |trial| {
        for (wheel, turned) in turned.iter_mut().enumerate() {
            let now = trial.angle(wheel + 1) - *turned;
            *turned += (now + PI).rem_euclid(TAU) - PI;
        }
        let phase = |i: usize| (turned[i] + f64::from(ratio) * turned[i + 1]).abs();
        slip = greatest([slip, phase(0), phase(1), phase(2)].into_iter());
    });
    let metric = format!("motor of {torque} N m, a brake of nearly as much at the end, phase");
    vec![Measure::new(metric, slip, "rad", Target::AtMost(0.01))]
}
