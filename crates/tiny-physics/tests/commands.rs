//! Random commands: whatever a user does to a world, in whatever order, its data stay sound.

mod common;

use common::*;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use tiny_physics::{BodyId, BodyKind, DVec2, JointDef, RigidBody, ShapeDef, Vec2, World};

/// One thing a user can do. Handles are picked by a number modulo how many there are, counting those
/// of bodies that are gone.
#[derive(Clone, Debug)]
enum Command {
    AddBody { kind: u8, shape: u8, x: f32, y: f32, angle: f32, size: f32 },
    RemoveBody(usize),
    AddShape { body: usize, shape: u8, size: f32, offset: f32 },
    RemoveShape(usize),
    AddJoint { a: usize, b: usize, kind: u8, anchor: f32, value: f32 },
    RemoveJoint(usize),
    Teleport { body: usize, x: f32, y: f32 },
    Turn { body: usize, angle: f32 },
    SetVelocity { body: usize, x: f32, y: f32, turning: f32 },
    Impulse { body: usize, x: f32, y: f32, at: f32 },
    Force { body: usize, x: f32, y: f32, at: f32 },
    Wake(usize),
    Sleep(usize),
    Tune { body: usize, value: f32 },
    Gravity { x: f32, y: f32 },
    Step { dt: f32, count: u8 },
    Save,
    Restore,
}

/// Mostly sensible, now and then hostile.
fn number() -> impl Strategy<Value = f32> {
    prop_oneof![
        12 => -8.0_f32..8.0,
        1 => prop::sample::select(vec![
            0.0, -0.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN_POSITIVE, 1.0e-20, -1.0e20,
        ]),
    ]
}

fn command() -> impl Strategy<Value = Command> {
    let n = number;
    let which = || 0..64_usize;
    prop_oneof![
        6 => (0..6_u8, 0..5_u8, n(), n(), n(), n()).prop_map(|(kind, shape, x, y, angle, size)| {
            Command::AddBody { kind, shape, x, y, angle, size }
        }),
        2 => which().prop_map(Command::RemoveBody),
        1 => (which(), 0..5_u8, n(), n()).prop_map(|(body, shape, size, offset)| {
            Command::AddShape { body, shape, size, offset }
        }),
        1 => which().prop_map(Command::RemoveShape),
        3 => (which(), which(), 0..JOINT_KINDS, n(), n()).prop_map(|(a, b, kind, anchor, value)| {
            Command::AddJoint { a, b, kind, anchor, value }
        }),
        1 => which().prop_map(Command::RemoveJoint),
        2 => (which(), n(), n()).prop_map(|(body, x, y)| Command::Teleport { body, x, y }),
        1 => (which(), n()).prop_map(|(body, angle)| Command::Turn { body, angle }),
        2 => (which(), n(), n(), n()).prop_map(|(body, x, y, turning)| {
            Command::SetVelocity { body, x, y, turning }
        }),
        2 => (which(), n(), n(), n()).prop_map(|(body, x, y, at)| Command::Impulse { body, x, y, at }),
        1 => (which(), n(), n(), n()).prop_map(|(body, x, y, at)| Command::Force { body, x, y, at }),
        1 => which().prop_map(Command::Wake),
        1 => which().prop_map(Command::Sleep),
        1 => (which(), n()).prop_map(|(body, value)| Command::Tune { body, value }),
        1 => (n(), n()).prop_map(|(x, y)| Command::Gravity { x, y }),
        1 => n().prop_map(|dt| Command::Step { dt, count: 1 }),
        6 => (1..40_u8).prop_map(|count| Command::Step { dt: DT, count }),
        1 => Just(Command::Save),
        1 => Just(Command::Restore),
    ]
}

/// A world and every handle that it ever gave out.
struct Player {
    world: World,
    ids: Vec<BodyId>,
    saved: World,
}

impl Player {
    fn new() -> Self {
        let world = world_with_floor();
        Self { ids: world.body_ids().collect(), saved: world.clone(), world }
    }

    fn pick(&self, which: usize) -> BodyId {
        self.ids[which % self.ids.len()]
    }

    fn play(&mut self, command: &Command) {
        match *command {
            Command::AddBody { kind, shape, x, y, angle, size } => {
                let kind = match kind {
                    0 => BodyKind::Static,
                    1 => BodyKind::Kinematic,
                    _ => BodyKind::Dynamic,
                };
                let body = RigidBody { kind, angle, ..RigidBody::default() }
                    .position(Vec2::new(x, y))
                    .shape(shape_of(shape, size));
                self.ids.extend(self.world.add_body(body));
            }
            Command::RemoveBody(which) => drop(self.world.remove_body(self.pick(which))),
            Command::AddShape { body, shape, size, offset } => {
                let shape = shape_of(shape, size).offset(Vec2::new(offset, 0.0));
                let _ = self.world.add_shape(self.pick(body), shape);
            }
            Command::RemoveShape(which) => {
                let shapes: Vec<_> = self.world.shape_ids().collect();
                if !shapes.is_empty() {
                    self.world.remove_shape(shapes[which % shapes.len()]).unwrap();
                }
            }
            Command::AddJoint { a, b, kind, anchor, value } => {
                let joint = joint_of(kind, anchor, value);
                let _ = self.world.add_joint(self.pick(a), self.pick(b), joint);
            }
            Command::RemoveJoint(which) => {
                let joints: Vec<_> = self.world.joint_ids().collect();
                if !joints.is_empty() {
                    self.world.remove_joint(joints[which % joints.len()]).unwrap();
                }
            }
            Command::Gravity { x, y } => self.world.gravity = Vec2::new(x, y),
            Command::Step { dt, count } => (0..count).for_each(|_| self.world.step(dt)),
            Command::Save => self.saved = self.world.clone(),
            Command::Restore => self.world.clone_from(&self.saved),
            ref told => self.tell(told),
        }
    }

    /// Commands to one body.
    fn tell(&mut self, command: &Command) {
        let (Command::Teleport { body, .. }
        | Command::Turn { body, .. }
        | Command::SetVelocity { body, .. }
        | Command::Impulse { body, .. }
        | Command::Force { body, .. }
        | Command::Tune { body, .. }
        | Command::Wake(body)
        | Command::Sleep(body)) = *command
        else {
            return;
        };
        let id = self.pick(body);
        let Some(mut body) = self.world.body_mut(id) else { return };
        match *command {
            Command::Teleport { x, y, .. } => body.set_position(Vec2::new(x, y)),
            Command::Turn { angle, .. } => body.set_angle(angle),
            Command::SetVelocity { x, y, turning, .. } => {
                body.set_velocity(Vec2::new(x, y));
                body.set_angular_velocity(turning);
            }
            Command::Impulse { x, y, at, .. } => {
                body.apply_impulse(Vec2::new(x, y), Vec2::new(at, 0.0));
            }
            Command::Force { x, y, at, .. } => body.apply_force(Vec2::new(x, y), Vec2::new(at, at)),
            Command::Tune { value, .. } => {
                body.set_gravity_scale(value);
                body.set_damping(value, value);
                body.set_bullet(value > 0.0);
            }
            Command::Wake(_) => body.wake(),
            Command::Sleep(_) => body.sleep(),
            _ => {}
        }
    }

    /// The first thing that is wrong.
    fn check(&self) -> Result<(), String> {
        self.world.validate()?;
        for id in self.world.body_ids() {
            let body = self.world.body(id).ok_or("a listed body is not there")?;
            let finite = body.position_f64().is_finite()
                && body.angle().is_finite()
                && body.velocity().is_finite()
                && body.angular_velocity().is_finite();
            if !finite {
                return Err(format!("{id} is not finite"));
            }
        }
        for contact in self.world.contacts() {
            let finite = contact.normal.is_finite()
                && contact.points().iter().all(|p| {
                    p.separation.is_finite()
                        && p.normal_impulse.is_finite()
                        && p.tangent_impulse.is_finite()
                });
            if !finite {
                return Err(format!("not finite: {contact:?}"));
            }
        }
        Ok(())
    }
}

fn shape_of(shape: u8, size: f32) -> ShapeDef {
    // Sensible sizes lie around half a metre; hostile ones go in as they are.
    let size = if size.abs() < 8.0 && size.abs() > 0.01 { 0.1 + 0.1 * size.abs() } else { size };
    ShapeDef::new(match shape {
        0 => circle(size),
        1 => upright(size, 0.4),
        2 => capsule(0.3, size),
        3 => capsule(size, 0.2),
        _ => match tiny_physics::Polygon::rect(size, 0.3) {
            Ok(rect) => rect.into(),
            Err(_) => circle(size),
        },
    })
}

/// Kinds that [`joint_of`] knows.
const JOINT_KINDS: u8 = 13;

fn joint_of(kind: u8, anchor: f32, value: f32) -> JointDef {
    let anchors = (Vec2::new(0.1 * anchor, 0.0), Vec2::new(0.0, 0.1 * anchor));
    let (x, up) = (Vec2::new(1.0, 0.0), DVec2::new(0.0, 9.0));
    let joint = match kind {
        0 => JointDef::distance(value),
        1 => JointDef::revolute(),
        2 => JointDef::revolute().motor(value, 100.0),
        3 => JointDef::revolute().limits(-0.5, value).spring(value, 0.5),
        4 => JointDef::prismatic(x).limits(-1.0, value),
        5 => JointDef::weld(),
        6 => JointDef::wheel(x).motor(value, 50.0),
        7 => JointDef::friction(value, 1.0),
        8 => JointDef::mouse(DVec2::new(f64::from(value), f64::from(anchor)), 100.0),
        9 => JointDef::pulley(up, up, value),
        10 => JointDef::gear(value),
        11 => JointDef::weld().break_at(value, value),
        _ => JointDef::filter(),
    };
    joint.anchors(anchors.0, anchors.1)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, max_shrink_iters: 20_000, failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() })]

    /// 100 worlds with 100 commands each, on average.
    #[test]
    fn any_commands_leave_the_world_sound(commands in prop::collection::vec(command(), 1..=200)) {
        let mut player = Player::new();
        for (i, command) in commands.iter().enumerate() {
            player.play(command);
            let sound = player.check();
            prop_assert!(sound.is_ok(), "after command {i}, {command:?}: {}", sound.unwrap_err());
        }
    }

    /// Two worlds that are told the same stay the same.
    #[test]
    fn the_same_commands_make_the_same_world(commands in prop::collection::vec(command(), 1..=100)) {
        let (mut a, mut b) = (Player::new(), Player::new());
        b.world.set_simd(tiny_physics::SimdLevel::Scalar).unwrap();
        b.saved = b.world.clone();
        for (i, command) in commands.iter().enumerate() {
            a.play(command);
            b.play(command);
            prop_assert!(a.world.state_hash() == b.world.state_hash(), "after command {i}, {command:?}");
        }
    }

    /// Whatever state it is in, a world comes back from its bytes, with its hash and its future.
    #[test]
    fn any_world_comes_back_from_bytes(commands in prop::collection::vec(command(), 1..=60)) {
        let mut player = Player::new();
        for (i, command) in commands.iter().enumerate() {
            player.play(command);
            let bytes = player.world.to_bytes();
            let copy = World::from_bytes(&bytes);
            prop_assert!(copy.is_ok(), "after command {i}, {command:?}: {}", copy.unwrap_err());
            let (mut copy, mut world) = (copy.unwrap(), player.world.clone());
            prop_assert!(copy.to_bytes() == bytes, "after command {i}, {command:?}");
            for step in 0..4 {
                prop_assert!(copy.state_hash() == world.state_hash(), "step {step} after {i}, {command:?}");
                copy.step(DT);
                world.step(DT);
            }
        }
    }
}
