//! A tile map: drawn with letters, run over without a bump, dug up while things lie on it.
//! `cargo run -p tiny-physics --example tile_map`

use tiny_physics::{Error, QueryFilter, RigidBody, Shape, ShapeDef, TileGrid, Vec2, World};

/// Runs the example.
pub fn main() -> Result<(), Error> {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    let level = TileGrid::parse(
        1.0,
        &[
            "......................../", // slopes `/` and `\`, gentle ones `lh` and `HL`
            "......................./#", // `-` is a one-way tile, `_` half a tile
            "....---..............lh##", //
            "#########################",
        ],
    )?;
    let level = world.add_tiles(level)?;

    // A frictionless ball over twenty seams keeps its speed to the last digit.
    let ball = ShapeDef::new(Shape::circle(0.4)?).friction(0.0);
    let ball = RigidBody::dynamic()
        .position(Vec2::new(1.0, 1.4))
        .velocity(Vec2::new(10.0, 0.0))
        .shape(ball);
    let ball = world.add_body(ball)?;
    for _ in 0..90 {
        world.step(1.0 / 60.0);
    }
    let speed = world.body(ball).unwrap().velocity().x;
    println!("after 15 m of tiles: {speed:.4} m/s");
    assert!((speed - 10.0).abs() < 0.001);

    // Digging takes the ground from under a crate: an edit costs the same in a map of any size.
    let crate_ = RigidBody::dynamic().position(Vec2::new(12.5, 1.4)).shape(Shape::rect(0.4, 0.4)?);
    let crate_ = world.add_body(crate_)?;
    for _ in 0..60 {
        world.step(1.0 / 60.0);
    }
    world.set_tile(level, 12, 0, 0)?;
    for _ in 0..60 {
        world.step(1.0 / 60.0);
    }
    assert!(world.body(crate_).unwrap().position().y < 0.0, "it fell through the hole");

    // From what a query hits back to the cell.
    let down =
        world.ray_cast(Vec2::new(4.5, 3.0), Vec2::new(0.0, -3.0), &QueryFilter::new()).unwrap();
    let grid = world.tiles(world.tiles_of(down.body).unwrap()).unwrap();
    let (x, y) = grid.cell_at(down.point.to_vec2() - 0.01 * Vec2::Y).unwrap();
    println!("below is cell ({x}, {y}), {:?}", grid.tile(x, y).unwrap().one_way);
    assert_eq!((x, y), (4, 1));
    Ok(())
}
