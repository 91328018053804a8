//! Recording what is done to a world, playing it again with a check of every step, going to any step, and
//! finding where two runs part. `cargo run -p tiny-physics --example recording`

use tiny_physics::record::{BodyCommand, Command, Made, Player, Recorder, Recording};
use tiny_physics::{Error, RigidBody, Shape, Vec2, World};

/// Fifty steps with a kick of some strength after thirty.
fn play(kick: f32) -> Result<Recording, Error> {
    let mut recorder = Recorder::new(World::new(Vec2::new(0.0, -10.0)));
    recorder.apply(Command::AddBody(RigidBody::fixed().shape(Shape::rect(20.0, 0.5)?)))?;
    let ball = RigidBody::dynamic().position(Vec2::new(0.0, 1.0)).shape(Shape::circle(0.5)?);
    let Made::Body(ball) = recorder.apply(Command::AddBody(ball))? else { unreachable!() };
    for step in 0..50 {
        if step == 30 {
            let push = BodyCommand::ApplyImpulseToCenter(Vec2::new(kick, 0.0));
            recorder.apply(Command::Body(ball, push))?;
        }
        recorder.step(1.0 / 60.0);
    }
    Ok(recorder.finish().1)
}

/// Runs the example.
pub fn main() -> Result<(), Error> {
    let run = play(1.0)?;
    let bytes = run.to_bytes();
    println!("{} steps in {} bytes", run.len(), bytes.len());

    // Play it again from the file; a step whose bits differ would be an error.
    let run = Recording::from_bytes(&bytes)?;
    let mut player = Player::new(&run)?;
    while player.step()? {}
    assert_eq!(player.at(), 50);

    // Scrub: back to before the kick, then after it.
    let body = player.world().body_ids().nth(1).unwrap();
    player.seek(30)?;
    assert_eq!(player.world().body(body).unwrap().velocity().x, 0.0);
    player.seek(31)?;
    assert!(player.world().body(body).unwrap().velocity().x > 0.5);

    // Two players' machines do not agree: since when?
    let other = play(1.0001)?;
    println!("the runs part in step {:?}", run.first_difference(&other));
    assert_eq!(run.first_difference(&other), Some(31));
    assert_eq!(run.first_difference(&play(1.0)?), None);
    Ok(())
}
