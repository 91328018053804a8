//! Wheels, pulleys, gears, racks and mice against their formulas.

use super::*;

/// A car on a suspension: two wheels, motor drives it along.
#[test]
fn motors_turn_wheels() {
    let mut rig = swing(4, 0.0, JointDef::wheel(Vec2::new(0.0, 1.0)).motor(-5.0, 2.0));
    rig.run(2.0);
    assert_near("spin", rig.bodies.angular_velocity(1).into(), -5.0, 1e-3);
    assert_near("place", rig.position(1).y, 0.0, 1e-6);
}

/// Atwood's machine with a block and tackle: m a = T - m g on A, M b = ratio T - M g on B, a = -ratio b.
#[test]
fn pulleys_keep_their_ratio() {
    for ratio in [1.0_f32, 2.0] {
        let mut rig = Rig::new();
        let a = rig.body(-1.0, 0.0, 1.0, 1.0);
        let b = rig.body(1.0, 0.0, 4.0, 1.0);
        let grounds = (DVec2::new(-1.0, 5.0), DVec2::new(1.0, 5.0));
        let length = 5.0 + 5.0 * ratio;
        let joint = rig.joint(a, b, JointDef::pulley(grounds.0, grounds.1, length).ratio(ratio));
        rig.run(0.5);
        let (m, big) = (1.0, 4.0);
        let acceleration = G * (big - ratio * m) / (big + ratio * ratio * m);
        let (va, vb) = (rig.bodies.velocity(a).y, rig.bodies.velocity(b).y);
        assert_near("speed", vb.into(), (-0.5 * acceleration).into(), 0.01);
        assert_near("ratio", va.into(), (-ratio * vb).into(), 1e-4);
        let rope = (5.0 - rig.position(a).y) + f64::from(ratio) * (5.0 - rig.position(b).y);
        assert_near("length", rope, length.into(), 0.001);
        let tension = big * (G - acceleration) / ratio;
        assert_near("force", rig.load(joint).force.y.into(), (tension * ratio).into(), 0.05);
    }
}

#[test]
fn ropes_of_pulleys_do_not_push() {
    let mut rig = Rig::new();
    let (a, b) = (rig.cube(-1.0, 0.0), rig.cube(1.0, 0.0));
    rig.joint(a, b, JointDef::pulley(DVec2::new(-1.0, 5.0), DVec2::new(1.0, 5.0), 20.0));
    rig.run(0.5);
    assert_near("free fall", rig.bodies.velocity(a).y.into(), (-0.5 * G).into(), 1e-4);
}

#[test]
fn gears_keep_their_ratio_over_many_turns() {
    for ratio in [1.0_f32, -3.0, 0.5] {
        let mut rig = Rig::new();
        let (a, b) = (rig.cube(0.0, 0.0), rig.cube(2.0, 0.0));
        rig.joint(0, a, JointDef::revolute().motor(10.0, 100.0));
        rig.joint(0, b, JointDef::revolute().anchors(Vec2::new(2.0, 0.0), Vec2::ZERO));
        rig.joint(a, b, JointDef::gear(ratio));
        rig.run(60.0);
        let (wa, wb) = (rig.bodies.angular_velocity(a), rig.bodies.angular_velocity(b));
        assert_near("speed", wa.into(), 10.0, 0.01);
        assert_near("ratio", wa.into(), (-ratio * wb).into(), 1e-3);
        let expected = f64::from(rig.angle(a)) / f64::from(-ratio);
        let off = f64::from(rig.angle(b)) - expected;
        // A's angle is known but for whole turns.
        let turn = TAU / f64::from(ratio.abs());
        let off = off - (off / turn).round() * turn;
        let off = off - (off / TAU).round() * TAU;
        println!("gear {ratio}: {off:.6} rad off after 95 turns");
        assert_near("angle", off, 0.0, 0.01);
    }
}

/// A rack: torque T on a pinion of gear radius r lifts a weight.
#[test]
fn racks_lift() {
    let mut rig = Rig::new();
    let (rack, pinion) = (rig.cube(0.0, 0.0), rig.cube(2.0, 0.0));
    let up = Vec2::new(0.0, 1.0);
    rig.joint(0, rack, JointDef::prismatic(up));
    let anchor = Vec2::new(2.0, 0.0);
    rig.joint(0, pinion, JointDef::revolute().anchors(anchor, Vec2::ZERO).motor(-2.0, 100.0));
    let kind = JointKind::Gear { ratio: 0.25, slide_a: Some(up), slide_b: None };
    let gear = rig.joint(rack, pinion, JointDef::new(kind));
    rig.run(4.0);
    assert_near("height", rig.position(rack).y, 2.0, 0.01);
    assert_near("torque", rig.load(gear).torque.into(), (0.25 * G).into(), 0.01);
}

/// What is dragged turns by `w' = -2 w`, about its middle and under a force elsewhere alike.
#[test]
fn mice_slow_the_turning() {
    let mut rig = swing(4, 0.0, JointDef::mouse(DVec2::ZERO, 100.0));
    rig.bodies.rows[1][Slot::W] = 3.0;
    rig.run(1.0);
    assert_near("spin", rig.bodies.angular_velocity(1).into(), 3.0 * (-2.0_f64).exp(), 0.005);
    let mut rig = swing(4, 0.0, JointDef::mouse(DVec2::ZERO, 0.0));
    rig.bodies.rows[1][Slot::VX] = 1.0;
    rig.run(1.0);
    assert_near("no force", rig.bodies.velocity(1).x.into(), 1.0, 1e-5);
    // A plank that is held at its end comes to hang straight down.
    let mut rig = Rig::new();
    let plank = rig.body(1.0, 0.0, 1.0, 1.0 / 3.0);
    let hold = Vec2::new(-1.0, 0.0);
    rig.joint(0, plank, JointDef::mouse(DVec2::ZERO, 1000.0).anchors(Vec2::ZERO, hold));
    rig.run(20.0);
    assert_near("angle", rig.angle(plank).into(), -TAU / 4.0, 0.03);
}

/// Far from the origin, with a bounded force.
#[test]
fn mice_drag_to_their_target() {
    let mut rig = Rig::new();
    let (x, y) = (1.0e6, -2.0e6);
    let body = rig.cube(x, y);
    let target = DVec2::new(x + 2.0, y + 1.0);
    let corner = Vec2::ZERO;
    let joint = rig.joint(0, body, JointDef::mouse(target, 100.0).anchors(Vec2::ZERO, corner));
    rig.step();
    assert!(rig.load(joint).force.length() <= 100.01);
    rig.run(20.0);
    let anchor = rig.bodies.poses[body as usize].apply(corner);
    let omega = TAU * 5.0;
    assert_near("x", anchor.x - x, 2.0, 0.001);
    assert_near("y", anchor.y - y, 1.0 - 10.0 / (omega * omega), 0.002);
    rig.update(joint, JointDef::mouse(DVec2::new(x, y), 100.0).anchors(Vec2::ZERO, corner));
    rig.run(20.0);
    let anchor = rig.bodies.poses[body as usize].apply(corner);
    assert_near("x", anchor.x - x, 0.0, 0.001);
}
