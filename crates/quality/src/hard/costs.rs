//! Costs that must grow no faster than what is paid for.

use crate::lab::Lab;
use crate::report::Measure;
use crate::scenery::{disk, rect};
use crate::target::Target;
use std::time::Instant;
use tiny_physics::{BodyId, Error, JointDef, RigidBody, ShapeDef, TileGrid, Vec2, World};

/// How often everything is done; the least time counts.
const TIMES: usize = 3;

/// Seconds that something takes, the least of several times.
fn least(mut what: impl FnMut()) -> f64 {
    let once = |_| {
        let start = Instant::now();
        what();
        start.elapsed().as_secs_f64()
    };
    (0..TIMES).map(once).fold(f64::INFINITY, f64::min)
}

/// How many times as long a piece of work takes by item when there are `more` items in place of `few`.
fn growth(few: usize, more: usize, mut work: impl FnMut(usize)) -> f64 {
    let mut by_item = |count: usize| least(|| work(count)) / count as f64;
    1.0 / by_item(few) * by_item(more)
}

/// How many times as long one piece of work takes as another.
fn ratio(mut with: impl FnMut(), mut without: impl FnMut()) -> f64 {
    let (with, without) = (least(&mut with), least(&mut without));
    with / without
}

fn times(metric: String, value: f64, limit: f64) -> Measure {
    Measure::new(metric, value, "times", Target::AtMost(limit))
}

/// A world with gravity, or one that is empty where something was refused: the numbers show it.
fn world_of(build: impl FnOnce(&mut World) -> Result<(), Error>) -> World {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    if build(&mut world).is_err() {
        world = World::new(Vec2::ZERO);
    }
    world
}

/// A level of boxes on one body.
fn level(world: &mut World, count: usize) -> Result<BodyId, Error> {
    let body = world.add_body(RigidBody::fixed())?;
    for i in 0..count {
        let place = Vec2::new((i % 100) as f32, (i / 100) as f32);
        world.add_shape(body, ShapeDef::new(rect(0.5, 0.5)).offset(place))?;
    }
    Ok(body)
}

/// Shapes added to one body, one by one; a checkerboard of tiles.
pub(super) fn many_shapes(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (few, more) = lab.pick((500, 4000), (300, 3000));
    let shapes = |count: usize| drop(world_of(|world| level(world, count).map(drop)));
    let (side, wide) = lab.pick((32, 96), (24, 72));
    let tiles = |count: usize| {
        let row = |y: usize| {
            (0..count / side).map(move |x| if (x + y).is_multiple_of(2) { '#' } else { '.' })
        };
        let rows: Vec<String> = (0..side).map(|y| row(y).collect()).collect();
        let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
        drop(world_of(|world| {
            TileGrid::parse(1.0, &rows).and_then(|grid| world.add_tiles(grid)).map(drop)
        }));
    };
    vec![
        times(format!("time a shape, {more} shapes against {few}"), growth(few, more, shapes), 2.0),
        times(
            format!("time a tile, {side} x {wide} tiles against {side} x {side}"),
            growth(side * side, side * wide, tiles),
            2.0,
        ),
    ]
}

/// Steps a world some times.
fn step(world: &mut World, steps: u32) {
    (0..steps).for_each(|_| world.step(1.0 / 60.0));
}

/// Fast balls in free flight, and one sensor far away.
pub(super) fn one_sensor(lab: &mut Lab<'_>) -> Vec<Measure> {
    let count = lab.pick(2000, 1200);
    let flight = |sensor: bool| {
        world_of(|world| {
            world.gravity = Vec2::ZERO;
            if sensor {
                let eye = ShapeDef::new(rect(1.0, 1.0)).sensor();
                world.add_body(RigidBody::fixed().position(Vec2::new(0.0, -500.0)).shape(eye))?;
            }
            for i in 0..count {
                let place = Vec2::new(3.0 * (i % 50) as f32, 3.0 * (i / 50) as f32);
                let ball = RigidBody::dynamic().position(place).shape(disk(0.2));
                world.add_body(ball.velocity(Vec2::new(60.0, 0.0)).can_sleep(false))?;
            }
            Ok(())
        })
    };
    let (with, without) = (flight(true), flight(false));
    let run = |world: &World| step(&mut world.clone(), 20);
    let value = ratio(|| run(&with), || run(&without));
    vec![times(format!("step of {count} fast balls with a sensor far away"), value, 1.1)]
}

/// Pairs of bodies on hinges that may break, but do not.
pub(super) fn breakable_joints(lab: &mut Lab<'_>) -> Vec<Measure> {
    let count = lab.pick(5000, 3000);
    let pairs = |breakable: bool| {
        world_of(|world| {
            world.gravity = Vec2::ZERO;
            for i in 0..count {
                let place = Vec2::new(4.0 * (i % 80) as f32, 4.0 * (i / 80) as f32);
                let part = |x: f32| {
                    let body = RigidBody::dynamic().position(place + Vec2::new(x, 0.0));
                    body.shape(disk(0.3)).can_sleep(false)
                };
                let (a, b) = (world.add_body(part(0.0))?, world.add_body(part(1.0))?);
                let hinge = JointDef::revolute().anchors(Vec2::new(0.5, 0.0), Vec2::new(-0.5, 0.0));
                let hinge = if breakable { hinge.break_at(1e9, 1e9) } else { hinge };
                world.add_joint(a, b, hinge)?;
            }
            Ok(())
        })
    };
    let (with, without) = (pairs(true), pairs(false));
    let run = |world: &World| step(&mut world.clone(), 20);
    let value = ratio(|| run(&with), || run(&without));
    vec![times(format!("step of {count} joints that may break"), value, 1.2)]
}

/// A joint to the body of a large level, added and removed.
pub(super) fn joint_to_a_level(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (few, more) = lab.pick((500, 8000), (300, 5000));
    let remove = |count: usize| {
        let mut made = None;
        let mut world = world_of(|world| {
            let ground = level(world, count)?;
            let ball = RigidBody::dynamic().position(Vec2::new(0.0, -9.0)).shape(disk(0.2));
            made = Some((ground, world.add_body(ball)?));
            Ok(())
        });
        let Some((ground, ball)) = made else { return f64::NAN };
        least(|| {
            for _ in 0..200 {
                let joint = world.add_joint(ground, ball, JointDef::rope(50.0));
                // It was made just now.
                let _ = joint.and_then(|joint| world.remove_joint(joint));
            }
        })
    };
    let value = remove(more) / remove(few);
    vec![times(format!("time a joint to a body of {more} shapes against {few}"), value, 2.0)]
}

/// Balls that rest apart on a floor.
fn rows_of_balls(count: usize) -> (World, Vec<BodyId>) {
    let mut balls = Vec::new();
    let world = world_of(|world| {
        let long = count as f32;
        world.add_body(
            RigidBody::fixed().position(Vec2::new(long, -1.0)).shape(rect(long + 9.0, 1.0)),
        )?;
        for i in 0..count {
            let ball =
                RigidBody::dynamic().position(Vec2::new(2.0 * i as f32, 0.3)).shape(disk(0.3));
            balls.push(world.add_body(ball)?);
        }
        Ok(())
    });
    (world, balls)
}

/// Bodies put to sleep one by one.
pub(super) fn put_to_sleep(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (few, more) = lab.pick((300, 3000), (200, 2500));
    let sleep = |count: usize| {
        let (world, balls) = rows_of_balls(count);
        let mut asleep = world.clone();
        let all = least(|| {
            asleep.clone_from(&world);
            for &ball in &balls {
                if let Some(mut ball) = asleep.body_mut(ball) {
                    ball.sleep();
                }
            }
        });
        all / count as f64
    };
    let value = sleep(more) / sleep(few);
    vec![times(format!("time a body, {more} bodies against {few}"), value, 2.0)]
}

/// The slowest of the steps of a calm world over the one in the middle, each the least of some runs. Memory grows in
/// the first run alone.
fn slowest_step(world: &World, steps: usize) -> f64 {
    let mut least = vec![f64::INFINITY; steps];
    let mut run = world.clone();
    for _ in 0..TIMES {
        run.clone_from(world);
        for least in &mut least {
            let start = Instant::now();
            run.step(1.0 / 60.0);
            *least = least.min(start.elapsed().as_secs_f64());
        }
    }
    least.sort_by(f64::total_cmp);
    least[steps - 1 - steps / 50] / least[steps / 2]
}

/// A world nearly all asleep in which a few bodies move, which land one after the other: steps that look at all of it.
pub(super) fn steps_that_survey(lab: &mut Lab<'_>) -> Vec<Measure> {
    let count = lab.pick(6000, 4000);
    let (mut world, _) = rows_of_balls(count);
    step(&mut world, 120);
    for i in 0..20 {
        let place = Vec2::new(20.0 * i as f32, 3.0 + 0.3 * i as f32);
        let ball = RigidBody::dynamic().position(place).shape(disk(0.3));
        // What is refused leaves a world at rest, whose steps are all alike.
        let _ = world.add_body(ball.velocity(Vec2::new(3.0, 0.0)).can_sleep(false));
    }
    vec![times(
        format!("{count} sleepers, 98th percentile of a step over the median"),
        slowest_step(&world, 100),
        2.0,
    )]
}

/// A pile that falls: the trees are rebuilt on the way.
pub(super) fn steps_that_rebuild(lab: &mut Lab<'_>) -> Vec<Measure> {
    let count = lab.pick(6000, 4000);
    let world = world_of(|world| {
        for i in 0..count {
            let place = Vec2::new(1.1 * (i % 100) as f32, 1.1 * (i / 100) as f32);
            let ball = RigidBody::dynamic().position(place).shape(disk(0.4)).can_sleep(false);
            world.add_body(ball.velocity(Vec2::new((i % 7) as f32 - 3.0, 0.0)))?;
        }
        Ok(())
    });
    vec![times(
        format!("{count} balls, 98th percentile of a step over the median"),
        slowest_step(&world, 100),
        2.0,
    )]
}

/// One joint more in a world with one tall stack.
pub(super) fn a_joint_beside_a_stack(lab: &mut Lab<'_>) -> Vec<Measure> {
    let height = lab.pick(12, 8);
    let stack = |joined: bool| {
        let mut world = world_of(|world| {
            world.add_body(
                RigidBody::fixed().position(Vec2::new(0.0, -1.0)).shape(rect(20.0, 1.0)),
            )?;
            for i in 0..height {
                let place = Vec2::new(0.0, 0.5 + i as f32);
                world.add_body(
                    RigidBody::dynamic().position(place).shape(rect(0.5, 0.5)).can_sleep(false),
                )?;
            }
            let part = |x: f32| {
                RigidBody::dynamic().position(Vec2::new(x, 0.3)).shape(disk(0.3)).can_sleep(false)
            };
            let (a, b) = (world.add_body(part(6.0))?, world.add_body(part(7.0))?);
            if joined {
                world.add_joint(a, b, JointDef::distance(1.0))?;
            }
            Ok(())
        });
        step(&mut world, 60);
        world
    };
    let (with, without) = (stack(true), stack(false));
    let run = |world: &World| step(&mut world.clone(), 300);
    let value = ratio(|| run(&with), || run(&without));
    vec![times(format!("a stack of {height}, and a rod beside it, over no rod"), value, 1.5)]
}

/// Balls in a kinematic ring of many pieces, over the same ring in fewer.
pub(super) fn ring_of_pieces(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (few, more) = lab.pick((12, 96), (16, 64));
    let balls = lab.pick(1500, 1000);
    let ring = |pieces: usize| {
        let mut world = world_of(|world| {
            let radius = 16.0_f32;
            let mut ring = RigidBody::kinematic().can_sleep(false).angular_velocity(0.3);
            let turn = core::f32::consts::TAU / pieces as f32;
            for i in 0..pieces {
                let angle = turn * i as f32;
                let place = Vec2::new(angle.cos(), angle.sin()) * (radius + 1.0);
                let half = (radius + 2.0) * (0.5 * turn).tan();
                ring = ring.shape(ShapeDef::new(rect(1.0, half)).offset(place).angle(angle));
            }
            world.add_body(ring)?;
            for i in 0..balls {
                let place = Vec2::new((i % 40) as f32 - 19.5, (i / 40) as f32 - 19.0) * 0.52;
                world.add_body(
                    RigidBody::dynamic().position(place).shape(disk(0.25)).can_sleep(false),
                )?;
            }
            Ok(())
        });
        step(&mut world, 60);
        world
    };
    let (many, plain) = (ring(more), ring(few));
    let run = |world: &World| step(&mut world.clone(), 10);
    let value = ratio(|| run(&many), || run(&plain));
    vec![times(format!("ring of {more} pieces with {balls} balls, over {few} pieces"), value, 1.5)]
}

/// A world of joints stepped by a dt that changes, over one that does not.
pub(super) fn changing_step(lab: &mut Lab<'_>) -> Vec<Measure> {
    let count = lab.pick(3000, 2000);
    let world = world_of(|world| {
        world.gravity = Vec2::ZERO;
        for i in 0..count {
            let place = Vec2::new(4.0 * (i % 80) as f32, 4.0 * (i / 80) as f32);
            let part = |x: f32| {
                let body = RigidBody::dynamic().position(place + Vec2::new(x, 0.0));
                body.shape(disk(0.3)).can_sleep(false)
            };
            let (a, b) = (world.add_body(part(0.0))?, world.add_body(part(1.0))?);
            world.add_joint(a, b, JointDef::distance(1.0).spring(3.0, 0.5))?;
        }
        Ok(())
    });
    let run = |changes: bool| {
        let mut world = world.clone();
        for i in 0..20 {
            let slower = if changes && i % 2 == 0 { 1.02 } else { 1.0 };
            world.step(slower / 60.0);
        }
    };
    let value = ratio(|| run(true), || run(false));
    vec![times(format!("step of {count} springs when dt changes"), value, 1.2)]
}

/// A heavy plate on very many balls.
pub(super) fn many_contacts(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (few, more) = lab.pick((20, 400), (16, 300));
    let plate = |count: usize| {
        let mut world = world_of(|world| {
            let half = 0.3 * count as f32;
            world.add_body(
                RigidBody::fixed().position(Vec2::new(0.0, -1.0)).shape(rect(half + 5.0, 1.0)),
            )?;
            for i in 0..count {
                let place = Vec2::new(0.6 * i as f32 - half + 0.3, 0.25);
                world.add_body(
                    RigidBody::dynamic().position(place).shape(disk(0.25)).can_sleep(false),
                )?;
            }
            let plate = RigidBody::dynamic().position(Vec2::new(0.0, 0.75)).shape(rect(half, 0.25));
            world.add_body(plate.can_sleep(false)).map(drop)
        });
        step(&mut world, 60);
        least(|| step(&mut world.clone(), 50)) / count as f64
    };
    let value = plate(more) / plate(few);
    vec![times(format!("step by contact of a plate on {more} balls against {few}"), value, 1.5)]
}
