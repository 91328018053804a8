//! Any sequence of commands on a world, checked after each step, with a frame to go back to.
#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use tiny_physics::{BodyId, JointDef, RigidBody, Shape, Vec2, World};

#[derive(Arbitrary, Debug)]
enum Command {
    Add { kind: u8, shape: u8, size: f32, x: i8, y: i8, flags: u8 },
    Remove(u8),
    AddShape(u8, f32),
    RemoveShape(u8),
    Join { a: u8, b: u8, kind: u8, value: f32 },
    Part(u8),
    Push(u8, f32, f32),
    Speed(u8, f32, f32),
    Place(u8, f32, f32),
    Sleep(u8),
    Step(u8),
    Save,
    Back,
    Bytes,
}

fn pick(world: &World, which: u8) -> Option<BodyId> {
    let ids: Vec<BodyId> = world.body_ids().collect();
    (!ids.is_empty()).then(|| ids[usize::from(which) % ids.len()])
}

fn shape(shape: u8, size: f32) -> Result<Shape, tiny_physics::Error> {
    match shape % 5 {
        0 => Shape::circle(size),
        1 => Shape::rect(size, 0.5),
        2 => Shape::capsule(Vec2::ZERO, Vec2::new(size, 0.0), 0.2),
        3 => Shape::regular(usize::from(shape) % 9, size),
        _ => Ok(Shape::Aabb { half_extents: Vec2::new(size, 0.3) }),
    }
}

fn joint(kind: u8, value: f32) -> JointDef {
    match kind % 8 {
        0 => JointDef::revolute(),
        1 => JointDef::distance(value),
        2 => JointDef::weld(),
        3 => JointDef::prismatic(Vec2::new(value, 1.0)),
        4 => JointDef::wheel(Vec2::Y),
        5 => JointDef::gear(value),
        6 => JointDef::revolute().break_at(value, value),
        _ => JointDef::filter(),
    }
}

fn play(world: &mut World, frame: &mut World, command: &Command) -> Option<()> {
    match *command {
        Command::Add { kind, shape: which, size, x, y, flags } => {
            let body = match kind % 4 {
                0 => RigidBody::fixed(),
                1 => RigidBody { bullet: true, ..RigidBody::dynamic() },
                _ => RigidBody::dynamic(),
            };
            let mut def = tiny_physics::ShapeDef::new(shape(which, size).ok()?);
            (def.contact_events, def.hit_events) = (flags & 1 != 0, flags & 2 != 0);
            def.sensor = flags & 12 == 12;
            let place = Vec2::new(f32::from(x) * 0.2, f32::from(y) * 0.2);
            if world.body_count() < 40 {
                world.add_body(body.position(place).shape(def)).ok()?;
            }
        }
        Command::Remove(which) => world.remove_body(pick(world, which)?).ok()?,
        Command::AddShape(which, size) => {
            world.add_shape(pick(world, which)?, shape(which, size).ok()?).ok()?;
        }
        Command::RemoveShape(which) => {
            let ids: Vec<_> = world.shape_ids().collect();
            world.remove_shape(*ids.get(usize::from(which))?).ok()?;
        }
        Command::Join { a, b, kind, value } => {
            world.add_joint(pick(world, a)?, pick(world, b)?, joint(kind, value)).ok()?;
        }
        Command::Part(which) => {
            let ids: Vec<_> = world.joint_ids().collect();
            world.remove_joint(*ids.get(usize::from(which))?).ok()?;
        }
        Command::Push(which, x, y) => {
            let id = pick(world, which)?;
            world.body_mut(id)?.apply_impulse_to_center(Vec2::new(x, y));
        }
        Command::Speed(which, x, w) => {
            let id = pick(world, which)?;
            world.body_mut(id)?.set_velocity(Vec2::new(x, 0.0));
            world.body_mut(id)?.set_angular_velocity(w);
        }
        Command::Place(which, x, y) => {
            let id = pick(world, which)?;
            world.body_mut(id)?.set_position(Vec2::new(x, y));
        }
        Command::Sleep(which) => {
            let id = pick(world, which)?;
            world.body_mut(id)?.sleep();
        }
        Command::Step(count) => (0..=count % 8).for_each(|_| world.step(1.0 / 60.0)),
        Command::Save => frame.clone_from(world),
        Command::Back => world.clone_from(frame),
        Command::Bytes => {
            let hash = world.state_hash();
            *world = World::from_bytes(&world.to_bytes()).expect("bytes of a world");
            assert_eq!(world.state_hash(), hash);
        }
    }
    Some(())
}

fuzz_target!(|commands: Vec<Command>| {
    let mut world = World::new(Vec2::new(0.0, -9.8));
    let ground = RigidBody::fixed().shape(Shape::rect(30.0, 1.0).expect("a box"));
    world.add_body(ground).expect("ground");
    let mut frame = world.clone();
    for command in commands.iter().take(60) {
        play(&mut world, &mut frame, command);
        if let Err(reason) = world.validate() {
            panic!("{reason} after {command:?}");
        }
    }
});
