//! Fast bodies, and seams that nobody should notice.

use crate::lab::{Lab, greatest};
use crate::report::Measure;
use crate::scenery::{disk, moving, rect, scene, weightless};
use crate::target::Target;
use tiny_physics::{RigidBody, Shape, ShapeDef, Vec2};

/// Shots at a wall without thickness, and pairs of bodies that fly at each other: how many get through?
///
/// Disks of 0.1 to 0.3 m and boxes, each second one turned and spinning; head on, both are bullets.
pub(super) fn thin_wall(lab: &mut Lab<'_>) -> Vec<Measure> {
    let shots = lab.pick(200, 130);
    lab.expect_seconds(2.0, 1.0 / 60.0);
    let speed = |i: i32| 50.0 + 340.0 * i as f32 / (shots - 1) as f32;
    let mut scene = weightless("thin wall");
    let far = 20.0 * shots as f32;
    let wall = Shape::Segment { a: Vec2::new(0.0, -20.0), b: Vec2::new(0.0, far) };
    scene.body(RigidBody::fixed().shape(wall));
    for i in 0..shots {
        // Not all start at the same part of a step's way.
        let x = -10.0 - 0.037 * (i * 17 % 100) as f32;
        scene.body(shot(i, Vec2::new(x, 20.0 * i as f32), speed(i)));
    }
    let bodies = 1..scene.bodies.len();
    let mut trial = lab.build(scene);
    lab.run(&mut trial, 1.0, |_| {});
    let through = bodies.filter(|&body| trial.position(body).x > 0.0).count();

    let mut scene = weightless("head on");
    for i in 0..shots {
        let (gap, y) = (10.0 + 0.053 * (i * 17 % 100) as f32, 20.0 * i as f32);
        // Square on: what is hit askew goes past by right.
        let straight = |body: RigidBody| body.angle(0.0).angular_velocity(0.0).bullet();
        scene.body(straight(shot(i, Vec2::new(-gap, y), speed(i))));
        scene.body(straight(shot(i, Vec2::new(gap, y), -speed(shots - 1 - i))));
    }
    let mut trial = lab.build(scene);
    lab.run(&mut trial, 1.0, |_| {});
    let passed = (0..shots as usize)
        .filter(|&i| trial.position(2 * i).x > trial.position(2 * i + 1).x)
        .count();
    vec![
        Measure::new(
            format!("{shots} shots at a segment, through"),
            through as f64,
            "",
            Target::AtMost(0.0),
        ),
        Measure::new(
            format!("{shots} pairs head on, past each other"),
            passed as f64,
            "",
            Target::AtMost(0.0),
        ),
    ]
}

fn shot(i: i32, position: Vec2, speed: f32) -> RigidBody {
    let size = 0.1 + 0.05 * (i % 5) as f32;
    let shape = if i % 2 == 0 { disk(size) } else { rect(size, 0.5 * size) };
    let spin = if i % 4 == 1 { 20.0 } else { 0.0 };
    moving(ShapeDef::new(shape).friction(0.0), position)
        .velocity(Vec2::new(speed, 0.0))
        .angle(0.3 * (i % 4) as f32)
        .angular_velocity(spin)
}

/// A box without friction slides over a floor of tiles: what speed it keeps, and how high it hops.
pub(super) fn tiles(lab: &mut Lab<'_>) -> Vec<Measure> {
    const SECONDS: f64 = 5.0;
    let (speed, size) = lab.pick((10.0, 0.5), (20.0, 0.4));
    lab.expect_seconds(3.0 * SECONDS, 1.0 / 60.0);
    let mut measures = Vec::new();
    for (floor, tiles_a_body) in [("separate boxes", 1), ("one body", 1000), ("several bodies", 10)]
    {
        let mut scene = scene("tiles");
        add_tiles(&mut scene, tiles_a_body);
        let start = Vec2::new(0.3, size);
        let slider = moving(ShapeDef::new(rect(size, size)).friction(0.0), start);
        let slider = scene.body(slider.velocity(Vec2::new(speed, 0.0)));
        let mut trial = lab.build(scene);
        let mut highest: f64 = 0.0;
        lab.run(&mut trial, SECONDS, |trial| {
            highest = greatest([highest, trial.moved(slider).y].into_iter());
        });
        let kept = f64::from(trial.velocity(slider).x / speed);
        measures.push(Measure::new(
            format!("{floor}, speed kept"),
            kept,
            "",
            Target::AtLeast { limit: 0.999, ideal: 1.0 },
        ));
        measures.push(Measure::new(
            format!("{floor}, greatest hop"),
            1000.0 * highest,
            "mm",
            Target::AtMost(1.0),
        ));
    }
    measures
}

/// Tiles of 1 m, their tops on y = 0, some of them on each body.
fn add_tiles(scene: &mut tiny_physics_scenes::Scene, tiles_a_body: usize) {
    const COUNT: usize = 130;
    let tiles: Vec<usize> = (0..COUNT).collect();
    for chunk in tiles.chunks(tiles_a_body) {
        let first = chunk[0] as f32;
        let mut body = RigidBody::fixed().position(Vec2::new(first, -0.5));
        for &tile in chunk {
            let place = Vec2::new(tile as f32 - first, 0.0);
            body = body.shape(ShapeDef::new(rect(0.5, 0.5)).offset(place).friction(0.0));
        }
        scene.body(body);
    }
}
