//! Every kind of shape, several shapes on one body, a hull with an error that names the point, and a chain to
//! land on. `cargo run -p tiny-physics --example shapes`

use tiny_physics::{ChainDef, Error, Polygon, RigidBody, Shape, ShapeDef, Vec2, World};

/// Runs the example.
pub fn main() -> Result<(), Error> {
    let mut world = World::new(Vec2::new(0.0, -10.0));

    // A valley, drawn from right to left: the right of the way is outside, here above.
    let valley: Vec<Vec2> =
        (-20..=20).rev().map(|i| Vec2::new(i as f32, 0.02 * (i * i) as f32)).collect();
    world.add_body(RigidBody::fixed().chain(&ChainDef::open(&valley))?)?;

    let points = [(0.0, 0.6), (-0.5, -0.3), (0.5, -0.3), (0.0, 0.0)].map(|(x, y)| Vec2::new(x, y));
    let shapes = [
        ("circle", Shape::circle(0.5)?),
        ("box", Shape::rect(0.5, 0.3)?),
        ("box that never turns", Shape::aabb_box(Vec2::new(0.4, 0.4))?),
        ("capsule", Shape::capsule(Vec2::new(-0.4, 0.0), Vec2::new(0.4, 0.0), 0.25)?),
        ("hull of four points", Shape::hull(&points)?),
        ("regular hexagon", Shape::regular(6, 0.5)?),
        ("rounded box", Polygon::rect(0.4, 0.2)?.rounded(0.1)?.into()),
    ];
    let mut bodies = Vec::new();
    for (i, (name, shape)) in shapes.into_iter().enumerate() {
        let place = Vec2::new(1.5 * i as f32 - 4.5, 4.0);
        bodies.push((name, world.add_body(RigidBody::dynamic().position(place).shape(shape))?));
    }

    // A dumb-bell: mass and centre follow from the densities of its shapes.
    let rod = ShapeDef::new(Shape::rect(0.8, 0.05)?).density(0.5);
    let light = ShapeDef::new(Shape::circle(0.2)?).offset(Vec2::new(-0.8, 0.0));
    let heavy = ShapeDef::new(Shape::circle(0.2)?).offset(Vec2::new(0.8, 0.0)).density(3.0);
    let dumb_bell = RigidBody::dynamic().position(Vec2::new(0.0, 6.0));
    let dumb_bell = world.add_body(dumb_bell.shape(rod).shape(light).shape(heavy))?;
    bodies.push(("dumb-bell", dumb_bell));
    assert!(
        world.body(dumb_bell).unwrap().local_center().x > 0.3,
        "its centre is on the heavy side"
    );

    for _ in 0..600 {
        world.step(1.0 / 60.0);
    }
    for (name, body) in bodies {
        let body = world.body(body).unwrap();
        let place = body.position();
        println!("{name:22} {:.2} kg, lies at ({:.2}, {:.2})", body.mass(), place.x, place.y);
        assert!(place.y > 0.02 * place.x * place.x - 0.01, "nothing fell through");
    }

    // Bad points are refused with the reason and the place.
    let refused = Shape::hull(&[Vec2::ZERO, Vec2::X, Vec2::new(2.0, 0.0)]).unwrap_err();
    println!("three points on a line: {refused}");
    Ok(())
}
