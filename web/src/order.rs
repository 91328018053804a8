//! What is done to a world: any command as JSON, and those to bodies as numbers.

use crate::handles::Handle;
use crate::outcome::Outcome;
use crate::shelf::Shelf;
use crate::{with, with_shelf};
use tiny_physics::record::{BodyCommand, Command, Made};
use tiny_physics::{BodyId, BodyKind, CharacterMover, DVec2, Locks, Pose, Rot, Vec2};

/// Does the command in the input, written as JSON. The numbers are the handles of what it made; a character is text.
#[unsafe(no_mangle)]
pub extern "C" fn tp_apply(session: u32) -> bool {
    with(session, |session, shelf| {
        let made = session.order(shelf.read()?)?;
        answer(&made, shelf)
    })
}

/// A new character as text: where its middle is, its height and radius.
#[unsafe(no_mangle)]
pub extern "C" fn tp_character(x: f64, y: f64, height: f32, radius: f32) -> bool {
    with_shelf(|shelf| {
        let character = CharacterMover::new(DVec2::new(x, y), height, radius);
        answer(&Made::Character(character), shelf).is_ok()
    })
}

fn answer(made: &Made, shelf: &mut Shelf) -> Outcome {
    shelf.numbers.clear();
    match made {
        Made::Body(id) => shelf.count([id.number()]),
        Made::Shape(id) => shelf.count([id.number()]),
        Made::Shapes(ids) => shelf.count(ids.iter().map(|id| id.number())),
        Made::Joint(id) => shelf.count([id.number()]),
        Made::TileGrid(id) => shelf.count([id.number()]),
        Made::Character(character) => {
            shelf.say(serde_json::to_vec(character).map_err(crate::outcome::words)?);
        }
        _ => {}
    }
    Ok(())
}

/// Does something to a body: which of [`body_command`]'s, and up to four numbers.
#[unsafe(no_mangle)]
pub extern "C" fn tp_body_command(
    session: u32,
    body: f64,
    which: u32,
    a: f64,
    b: f64,
    c: f64,
    d: f64,
) -> bool {
    with(session, |session, _| {
        let command = body_command(which, [a, b, c, d]).ok_or("there is no such command")?;
        session.order(Command::Body(BodyId::of(body), command)).map(drop)
    })
}

fn body_command(which: u32, [a, b, c, d]: [f64; 4]) -> Option<BodyCommand> {
    let (x, y) = (a as f32, b as f32);
    let (vector, point) = (Vec2::new(x, y), DVec2::new(c, d));
    let pose = || Pose::new(DVec2::new(a, b), Rot::from_angle(c as f32));
    let flag = a != 0.0;
    Some(match which {
        0 => BodyCommand::SetPosition(DVec2::new(a, b)),
        1 => BodyCommand::SetAngle(x),
        2 => BodyCommand::SetPose(pose()),
        3 => BodyCommand::SetVelocity(vector),
        4 => BodyCommand::SetAngularVelocity(x),
        5 => BodyCommand::SetTarget(pose(), d as f32),
        6 => BodyCommand::ApplyForce(vector, point),
        7 => BodyCommand::ApplyForceToCenter(vector),
        8 => BodyCommand::ApplyTorque(x),
        9 => BodyCommand::ApplyImpulse(vector, point),
        10 => BodyCommand::ApplyImpulseToCenter(vector),
        11 => BodyCommand::ApplyAngularImpulse(x),
        12 => BodyCommand::Wake,
        13 => BodyCommand::Sleep,
        14 => BodyCommand::SetKind(match a as u32 {
            0 => BodyKind::Static,
            1 => BodyKind::Kinematic,
            2 => BodyKind::Dynamic,
            _ => return None,
        }),
        15 => BodyCommand::SetEnabled(flag),
        16 => BodyCommand::SetLocks(Locks { x: flag, y: b != 0.0, rotation: c != 0.0 }),
        17 => BodyCommand::SetMass((a != 0.0).then_some(x)),
        18 => BodyCommand::SetGravityScale(x),
        19 => BodyCommand::SetDamping(x, y),
        20 => BodyCommand::SetCanSleep(flag),
        21 => BodyCommand::SetSleepSpeed(x),
        22 => BodyCommand::SetBullet(flag),
        23 => BodyCommand::SetUserData(a as u64),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use tiny_physics::record::FilterData;
    use tiny_physics::{Explosion, RigidBody, Shape};

    fn input(text: String) {
        with_shelf(|shelf| shelf.input = text.into_bytes());
    }

    fn said() -> String {
        with_shelf(|shelf| String::from_utf8_lossy(&shelf.text).into_owned())
    }

    /// What JavaScript is told of a command; nothing where it was done.
    fn told(session: u32, command: Command) -> Option<String> {
        input(serde_json::to_string(&command).unwrap());
        (!tp_apply(session)).then(said)
    }

    #[test]
    fn what_the_engine_refuses_is_said() {
        input("{}".to_owned());
        let session = crate::session::tp_new();
        let ball = RigidBody::dynamic().shape(Shape::circle(1.0).unwrap());
        assert_eq!(told(session, Command::AddBody(ball)), None);
        let body = with_shelf(|shelf| shelf.numbers[0]);
        let lead = |dt| {
            let pose = Pose::new(DVec2::new(1.0, 0.0), Rot::IDENTITY);
            Command::Body(BodyId::of(body), BodyCommand::SetTarget(pose, dt))
        };
        let blast = |radius| {
            let explosion =
                Explosion { center: DVec2::ZERO, radius, falloff: 1.0, impulse_per_metre: 1.0 };
            Command::Explode(explosion, FilterData::default())
        };
        for done in [lead(1.0), blast(2.0)] {
            assert_eq!(told(session, done), None);
        }
        for refused in [lead(0.0), blast(-1.0)] {
            let words = told(session, refused);
            assert!(words.as_ref().is_some_and(|w| w.contains("makes no sense")), "{words:?}");
        }
        assert!(!tp_body_command(session, body, 5, 1.0, 0.0, 0.0, 0.0));
        assert!(said().contains("makes no sense"), "{}", said());
    }
}
