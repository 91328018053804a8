//! What happened in a step: contacts, hits with their speed, sensors, bodies that moved and fell asleep. Removing
//! things while going through the events is safe. `cargo run -p tiny-physics --example events`

use tiny_physics::{Error, RigidBody, Shape, ShapeDef, Vec2, World};

/// Runs the example.
pub fn main() -> Result<(), Error> {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    let floor =
        world.add_body(RigidBody::fixed().shape(Shape::rect(10.0, 0.5)?).restitution(0.5))?;
    let gate = ShapeDef::new(Shape::rect(10.0, 0.2)?).sensor().offset(Vec2::new(0.0, 3.0));
    let gate = world.add_shape(floor, gate)?;
    for i in 0..4 {
        // Events of a shape are off unless it asks for them.
        let shape = ShapeDef::new(Shape::circle(0.3)?).restitution(0.5).events().user_data(i);
        let place = Vec2::new(2.0 * i as f32 - 3.0, 4.0 + 2.0 * i as f32);
        world.add_body(RigidBody::dynamic().position(place).shape(shape))?;
    }

    let (mut begins, mut passed, mut moved, mut slept, mut burst) = (0, 0, 0, 0, 0);
    for step in 0..600 {
        world.step(1.0 / 60.0);
        begins += world.events().contact_begin().len();
        passed += world.events().sensor_begin().iter().filter(|event| event.sensor == gate).count();
        moved += world.moved_bodies().len();
        slept += world.events().fell_asleep().len();
        // The slices stay as they are while the world changes; a copy lets us change it.
        for hit in world.events().hits().to_vec() {
            let (number, impulse) = (hit.user_data_b.shape, hit.impulse);
            println!("step {step:3}: ball {number} hits at {:.1} m/s, {impulse:.1} Ns", hit.speed);
            if hit.speed > 13.0 {
                world.remove_body(hit.body_b)?;
                burst += 1;
            }
        }
    }
    println!(
        "{begins} contacts, {passed} through the gate, {moved} moves, {slept} fell asleep, {burst} burst"
    );
    assert!((4..=8).contains(&passed), "each falls through, some bounce up to it");
    assert_eq!(burst, 1, "only the highest comes down faster than 13 m/s");
    assert_eq!(slept, 3);
    assert!(begins > 4 && moved > 200);
    assert_eq!(world.moved_bodies().len(), 0);
    Ok(())
}
