//! Forces of places: an explosion, wind, water, a zone of attraction, a conveyor belt.
//! `cargo run -p tiny-physics --example forces`

use tiny_physics::{
    BodyId, Error, Explosion, ForceZone, Pose, QueryFilter, RigidBody, Rot, Shape, ShapeDef, Vec2,
    Water, Wind, World, ZoneForce,
};

const DT: f32 = 1.0 / 60.0;

fn ball(world: &mut World, x: f32, y: f32, density: f32) -> Result<BodyId, Error> {
    let shape = ShapeDef::new(Shape::circle(0.5)?).density(density);
    world.add_body(RigidBody::dynamic().position(Vec2::new(x, y)).shape(shape))
}

/// Runs the example.
pub fn main() -> Result<(), Error> {
    // An explosion is an impulse, once: the nearer and the wider, the more.
    let mut world = World::new(Vec2::ZERO);
    let (near, far) = (ball(&mut world, 2.0, 0.0, 1.0)?, ball(&mut world, 6.0, 0.0, 1.0)?);
    let blast =
        Explosion { center: Vec2::ZERO.into(), radius: 2.0, falloff: 5.0, impulse_per_metre: 10.0 };
    world.explode(&blast, &QueryFilter::new());
    let speed = |world: &World, body| world.body(body).unwrap().velocity().x;
    println!("blown away at {:.1} and {:.1} m/s", speed(&world, near), speed(&world, far));
    assert!(speed(&world, near) > speed(&world, far) && speed(&world, far) > 0.0);

    // Wind drags at the width that a body shows, up to its own speed. Call it before every step.
    let leaf = ball(&mut world, 0.0, 10.0, 1.0)?;
    let wind = Wind { velocity: Vec2::new(8.0, 0.0), ..Wind::default() };
    for _ in 0..600 {
        world.body_mut(leaf).unwrap().apply_wind(&wind, DT);
        world.step(DT);
    }
    println!("the leaf drifts at {:.2} m/s", speed(&world, leaf));
    assert!((6.0..8.0).contains(&speed(&world, leaf)));

    // Water carries what is lighter, and a belt carries what lies on it.
    let mut world = World::new(Vec2::new(0.0, -10.0));
    let (cork, stone) = (ball(&mut world, 0.0, 2.0, 250.0)?, ball(&mut world, 3.0, 2.0, 2500.0)?);
    let belt = ShapeDef::new(Shape::rect(5.0, 0.5)?).tangent_speed(2.0);
    world.add_body(RigidBody::fixed().position(Vec2::new(20.0, 1.0)).shape(belt))?;
    let parcel = RigidBody::dynamic().position(Vec2::new(16.0, 2.0)).shape(Shape::rect(0.5, 0.5)?);
    let parcel = world.add_body(parcel)?;
    for _ in 0..120 {
        world.apply_water(&Water::default(), &QueryFilter::new(), DT);
        world.step(DT);
    }
    let height = |body| world.body(body).unwrap().position().y;
    println!(
        "cork at {:.2} m, stone at {:.2} m, parcel at {:.2} m/s",
        height(cork),
        height(stone),
        speed(&world, parcel)
    );
    assert!(height(cork) > 0.0 && height(stone) < -1.0);
    assert!((speed(&world, parcel) - 2.0).abs() < 0.01);

    // A planet: an area that pulls towards its middle, here to a round orbit (v^2 = a r).
    let mut space = World::new(Vec2::ZERO);
    let moon = RigidBody::dynamic().position(Vec2::new(5.0, 0.0)).velocity(Vec2::new(0.0, 5.0));
    let moon = space.add_body(moon.shape(Shape::circle(0.1)?))?;
    let pull = ZoneForce::Attraction { center: Vec2::ZERO.into(), acceleration: 5.0 };
    let pose = Pose::new(Vec2::ZERO.into(), Rot::IDENTITY);
    let planet = ForceZone { shape: Shape::circle(8.0)?, pose, force: pull, wakes: true };
    for _ in 0..1200 {
        space.apply_zone(&planet, &QueryFilter::new(), DT);
        space.step(DT);
    }
    let distance = space.body(moon).unwrap().position().length();
    println!("after three rounds the moon is {distance:.2} m away");
    assert!((4.5..6.0).contains(&distance), "it does not fall and does not leave");
    Ok(())
}
