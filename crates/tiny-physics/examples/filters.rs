//! Who collides with whom: categories, groups, a filter of your own, and a hook before the solver.
//! `cargo run -p tiny-physics --example filters`

use tiny_physics::{BodyId, Error, Filter, RigidBody, Shape, ShapeDef, Vec2, World};

const GROUND: u64 = 1;
const PLAYER: u64 = 1 << 1;
const GHOST: u64 = 1 << 2;

fn drop_ball(world: &mut World, x: f32, filter: Filter, number: u64) -> Result<BodyId, Error> {
    let shape = ShapeDef::new(Shape::circle(0.3)?).filter(filter).user_data(number);
    world.add_body(RigidBody::dynamic().position(Vec2::new(x, 1.5)).shape(shape))
}

/// Runs the example.
pub fn main() -> Result<(), Error> {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    let floor = Filter { category: GROUND, mask: GROUND | PLAYER, group: 0 };
    let floor = ShapeDef::new(Shape::rect(20.0, 0.5)?).filter(floor);
    world.add_body(RigidBody::fixed().shape(floor))?;

    let player = Filter { category: PLAYER, ..Filter::default() };
    let ghost = Filter { category: GHOST, ..Filter::default() };
    let lands = drop_ball(&mut world, -4.0, player, 0)?;
    let falls = drop_ball(&mut world, -2.0, ghost, 0)?;
    // A negative group never collides among itself, whatever the masks say: two limbs of one figure.
    let limb = Filter { group: -1, ..player };
    let (arm, leg) = (drop_ball(&mut world, 0.0, limb, 0)?, drop_ball(&mut world, 0.1, limb, 0)?);
    // Numbers 7 and 8: the functions below know them.
    let (seven, second_seven) =
        (drop_ball(&mut world, 4.0, player, 7)?, drop_ball(&mut world, 4.1, player, 7)?);
    let phantom = drop_ball(&mut world, 8.0, player, 8)?;

    // Asked once for every pair of boxes that come to overlap.
    world.set_pair_filter(|pair| !(pair.user_data_a == 7 && pair.user_data_b == 7));
    // Asked in every step for every contact that touches, on any thread.
    world.set_pre_solve(|world, contact, rules| {
        let number = |shape| world.shape(shape).map_or(0, |shape| shape.user_data());
        rules.enabled = number(contact.shape_a) != 8 && number(contact.shape_b) != 8;
    });
    for _ in 0..120 {
        world.step(1.0 / 60.0);
    }

    let place = |body| world.body(body).unwrap().position();
    for (name, body) in [("player", lands), ("ghost", falls), ("arm", arm), ("phantom", phantom)] {
        println!("{name:8} at height {:.2}", place(body).y);
    }
    let on_floor = |body| (place(body).y - 0.8).abs() < 0.02;
    assert!([lands, arm, leg, seven, second_seven].into_iter().all(on_floor));
    assert!((place(leg).x - place(arm).x - 0.1).abs() < 1e-4, "they lie in each other");
    assert!((place(second_seven).x - place(seven).x - 0.1).abs() < 1e-4);
    assert!(place(falls).y < -5.0 && place(phantom).y < -5.0);
    Ok(())
}
