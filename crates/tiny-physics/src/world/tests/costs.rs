//! How costs grow, in steps along lists: twice as much in the world is no more than about twice the work.

use super::*;
use crate::broad_phase::DynamicTree;
use crate::describe::{JointDef, Locks, Tile, TileForm, TileGrid};
use crate::work::counted;
use crate::{CharacterMover, Explosion, ForceZone, MoverInput, Water, ZoneForce};

/// Checks that work in proportion to `n` at most stays so from `n` to `8 n`.
fn grows_in_proportion(what: &str, mut work: impl FnMut(u32) -> u64) {
    let (few, many) = (work(100), work(800));
    assert!(many <= 12 * few.max(50), "{what}: {few} steps for 100, {many} for 800");
}

/// Checks that work does not depend on `n`.
fn stays_equal(what: &str, mut work: impl FnMut(u32) -> u64) {
    let (few, many) = (work(100), work(800));
    assert!(many <= 2 * few.max(20), "{what}: {few} steps among 100, {many} among 800");
}

/// A fixed body with so many boxes in a row.
fn level(world: &mut World, count: u32) -> BodyId {
    let body = world.add_body(RigidBody::fixed()).unwrap();
    for i in 0..count {
        world.add_shape(body, rect(0.5, 0.5).offset(Vec2::new(i as f32, -0.5))).unwrap();
    }
    body
}

#[test]
fn shapes_of_a_level() {
    grows_in_proportion("one by one", |count| {
        let mut world = world();
        counted(|| _ = level(&mut world, count))
    });
    grows_in_proportion("tiles in a checkerboard", |count| {
        let mut world = world();
        let mut grid = TileGrid::new(1.0, count, 8, vec![Tile::new(TileForm::Full)]);
        (0..count).flat_map(|x| (0..8).map(move |y| (x, y))).for_each(|(x, y)| {
            grid.set(x, y, u16::from((x + y) % 2 == 0)).unwrap();
        });
        counted(|| _ = world.add_tiles(grid.clone()).unwrap())
    });
}

/// What is added one by one is what is added at once.
#[test]
fn shapes_added_later_are_as_those_of_the_start() {
    let shapes = [
        rect(0.5, 0.25).sensor(),
        ShapeDef::new(Shape::Aabb { half_extents: Vec2::new(2.0, 0.1) }),
        circle(0.3).offset(Vec2::new(4.0, 0.0)),
    ];
    for kind in [BodyKind::Static, BodyKind::Kinematic, BodyKind::Dynamic] {
        let def = RigidBody { kind, ..RigidBody::default() };
        let (mut once, mut later) = (world(), world());
        let all = shapes.iter().fold(def.clone(), |body, shape| body.shape(shape.clone()));
        once.add_body(all).unwrap();
        let body = later.add_body(def).unwrap();
        // The list begins with what came last.
        shapes.iter().rev().for_each(|shape| _ = later.add_shape(body, shape.clone()).unwrap());
        let facts = |world: &World| {
            let info = &world.state.bodies.infos[1];
            (info.min_extent, info.max_extent, info.mass, info.inertia, info.never_turns)
        };
        assert_eq!(facts(&once), facts(&later), "{kind:?}");
        assert!(facts(&later).0 > 0.0);
    }
}

#[test]
fn a_joint_to_a_large_level() {
    stays_equal("joints made and removed", |count| {
        let mut world = world();
        let ground = level(&mut world, count);
        let balls: Vec<_> =
            (0..count).map(|i| add(&mut world, i as f32, 0.25, circle(0.25))).collect();
        run(&mut world, 2);
        counted(|| {
            for [a, b] in [[balls[0], ground], [ground, balls[1]]] {
                let joint = world.add_joint(a, b, JointDef::revolute()).unwrap();
                world.remove_joint(joint).unwrap();
            }
        })
    });
}

#[test]
fn a_motor_on_ground_that_much_lies_on() {
    stays_equal("speeds set", |count| {
        let mut world = world();
        let ground = add_ground(&mut world);
        for i in 0..count {
            add(&mut world, 0.1 * i as f32 - 40.0, 0.04, circle(0.04));
        }
        let arms = [45.0, 47.0].map(|x| {
            let arm = add(&mut world, x, 3.0, rect(0.5, 0.1));
            let hinge = JointDef::revolute().anchor_at(Vec2::new(x, 3.0)).motor(1.0, 9.0);
            let hinge = JointDef { collide_connected: x > 46.0, ..hinge };
            world.add_joint(ground, arm, hinge).unwrap()
        });
        run(&mut world, 2);
        counted(|| {
            for arm in arms {
                world.joint_mut(arm).unwrap().set_motor_speed(2.0).unwrap();
            }
        })
    });
}

#[test]
fn one_body_put_to_sleep_among_many() {
    stays_equal("sleep", |count| {
        let mut world = world();
        add_ground(&mut world);
        let balls: Vec<_> =
            (0..count).map(|i| add(&mut world, i as f32 * 0.1 - 40.0, 2.0, circle(0.02))).collect();
        run(&mut world, 2);
        counted(|| world.body_mut(balls[7]).unwrap().sleep())
    });
}

/// Pieces that leave their fat boxes look at the contacts of their body once, not once each.
#[test]
fn a_moving_ring_of_many_pieces() {
    grows_in_proportion("pieces and contacts", |count| {
        let mut world = World::new(Vec2::ZERO);
        let mut ring = RigidBody::kinematic();
        for i in 0..count / 10 {
            ring = ring.shape(rect(0.5, 0.5).offset(Vec2::new(i as f32, 0.0)));
        }
        let ring = world.add_body(ring).unwrap();
        for i in 0..count {
            add(&mut world, i as f32 * 0.1, 0.51, circle(0.02));
        }
        // Many more that rest, so that the ring is a small part of all.
        for i in 0..8 * count {
            add(&mut world, i as f32, -20.0, rect(0.5, 0.5));
        }
        world.step(DT);
        world.body_mut(ring).unwrap().set_position(Vec2::new(0.0, 0.2));
        counted(|| world.step(DT))
    });
}

/// One sensor far away does not make a fast body look at all that it flies past.
#[test]
fn a_fast_body_and_a_sensor_elsewhere() {
    stays_equal("shapes on the way", |count| {
        let mut world = World::new(Vec2::ZERO);
        let fly = RigidBody::dynamic().shape(circle(0.5)).velocity(Vec2::new(300.0, 0.0));
        let fly = world.add_body(fly).unwrap();
        for i in 0..count {
            let x = 5.0 * i as f32 / count as f32;
            world
                .add_body(RigidBody::fixed().position(Vec2::new(x, 0.7)).shape(circle(0.15)))
                .unwrap();
        }
        let sensor = RigidBody::fixed().position(Vec2::new(1000.0, 0.0));
        world.add_body(sensor.shape(circle(1.0).sensor())).unwrap();
        world.step(DT);
        world.body_mut(fly).unwrap().set_position(Vec2::ZERO);
        counted(|| world.step(DT))
    });
}

#[test]
fn chains_that_go() {
    let heights = |count: u32| -> Vec<f32> { (0..count).map(|i| (i % 7) as f32).collect() };
    grows_in_proportion("removed", |count| {
        let mut world = world();
        let ground = world.add_body(RigidBody::fixed()).unwrap();
        let chain = crate::ChainDef::heights(1.0, &heights(count));
        let chain = world.add_chain(ground, &chain).unwrap();
        counted(|| chain.remove(&mut world).unwrap())
    });
}

/// Whether two bodies are joined is looked for in the list of the one that has fewer joints.
#[test]
fn partners_of_a_hub_of_many_joints() {
    stays_equal("one pair", |count| {
        let mut world = world();
        let hub = add(&mut world, 0.0, 0.0, circle(0.5));
        let spokes: Vec<_> = (0..count)
            .map(|i| {
                let spoke = add(&mut world, 3.0 + i as f32, 0.0, circle(0.2));
                world.add_joint(hub, spoke, JointDef::distance(3.0)).unwrap();
                spoke
            })
            .collect();
        let [hub, spoke] = [hub, spokes[0]].map(|body| world.body_index(body).unwrap());
        let State { bodies, joints, .. } = &world.state;
        counted(|| {
            assert!(!joints.may_collide(bodies, hub, spoke));
            assert!(!joints.may_collide(bodies, spoke, hub));
        })
    });
}

/// Only what has moved on rails is looked at by each of many characters.
#[test]
fn characters_among_many_bodies() {
    stays_equal("ten of them", |count| {
        let mut world = World::new(Vec2::ZERO);
        for i in 0..count {
            add(&mut world, 2.0 * i as f32, 9.0, circle(0.5));
            world.add_body(RigidBody::kinematic().position(at(2.0 * i as f32, 20.0).p)).unwrap();
        }
        let lift = RigidBody::kinematic().shape(rect(1.0, 0.1)).velocity(Vec2::Y);
        world.add_body(lift).unwrap();
        world.step(DT);
        let mut hero = CharacterMover::new(Vec2::new(0.0, 2.0), 1.8, 0.3);
        hero.update(&mut world, MoverInput::default(), DT);
        let mut others = vec![hero; 10];
        counted(|| {
            others.iter_mut().for_each(|one| one.update(&mut world, MoverInput::default(), DT))
        })
    });
}

#[test]
fn what_is_set_to_what_it_is() {
    stays_equal("setters", |count| {
        let mut world = world();
        let ground = add_ground(&mut world);
        for i in 0..count {
            add(&mut world, 0.1 * i as f32 - 40.0, 0.04, circle(0.04));
        }
        let body = add(&mut world, 45.0, 0.5, rect(0.5, 0.5));
        while world.awake_body_count() > 0 {
            world.step(DT);
        }
        let work = counted(|| {
            for body in [ground, body] {
                let shape = shape_of(&world, body);
                let view = world.shape(shape).unwrap();
                let (local, material) = (view.local(), view.material());
                let mut shape = world.shape_mut(shape).unwrap();
                shape.set_filter(crate::Filter::default());
                shape.set_sensor(false);
                shape.set_one_way(None).unwrap();
                shape.set_local(local.p, local.q.angle()).unwrap();
                shape.set_material(material).unwrap();
                shape.set_friction(material.friction).unwrap();
                shape.set_restitution(material.restitution).unwrap();
                shape.set_density(material.density).unwrap();
                let mut body = world.body_mut(body).unwrap();
                body.set_gravity_scale(1.0);
                body.set_damping(0.0, -1.0);
                body.set_locks(Locks::default());
                body.set_can_sleep(true);
                body.set_sleep_speed(body.as_ref().sleep_speed());
                body.set_mass(None).unwrap();
                body.set_center(None).unwrap();
                body.set_inertia(None).unwrap();
            }
        });
        assert_eq!(world.awake_body_count(), 0);
        world.shape_mut(shape_of(&world, ground)).unwrap().set_friction(0.1).unwrap();
        assert_eq!(world.awake_body_count(), count as usize + 1);
        work
    });
}

/// What moves alone joins no surface: nobody looks at those that it passes.
#[test]
fn platforms_and_sensors_put_along_a_level() {
    stays_equal("put along", |count| {
        let mut world = world();
        level(&mut world, count);
        let long = || rect(count as f32, 0.2).offset(Vec2::new(count as f32, 0.3));
        let movers = [
            RigidBody::kinematic().shape(long()),
            RigidBody::kinematic().shape(long().sensor()),
            RigidBody::fixed().shape(long().sensor()),
        ];
        let movers = movers.map(|body| world.add_body(body).unwrap());
        world.step(DT);
        counted(|| {
            movers.iter().for_each(|body| world.body_mut(*body).unwrap().set_position(Vec2::Y));
            world.refresh_surfaces();
        })
    });
}

#[test]
fn the_closest_of_many_far_away() {
    stays_equal("shapes measured", |count| {
        let mut world = world();
        level(&mut world, count);
        for i in 0..count {
            add(&mut world, i as f32, 0.5, rect(0.5, 0.5));
        }
        let filter = crate::QueryFilter::new();
        counted(|| {
            for [x, y] in [[-30.0, 70.0], [-900.0, 0.5], [5000.0, 5000.0], [50.0, 2.5]] {
                world.closest_point(Vec2::new(x, y), f32::INFINITY, &filter).unwrap();
            }
        })
    });
}

#[test]
fn many_sensors_that_go_at_once() {
    grows_in_proportion("overlaps ended", |count| {
        let mut world = world();
        let level = world.add_body(RigidBody::fixed()).unwrap();
        let body = world.add_body(RigidBody::fixed()).unwrap();
        add(&mut world, 0.0, 0.0, circle(1.0));
        let coin = || rect(0.5, 0.5).sensor();
        let mut coins = Vec::new();
        let added =
            counted(|| coins.extend((0..count).map(|_| world.add_shape(level, coin()).unwrap())));
        assert!(added < 100 * u64::from(count), "{added} for {count}");
        (0..count).for_each(|_| _ = world.add_shape(body, coin()).unwrap());
        world.step(DT);
        assert_eq!(world.state.sensors.overlaps.len(), 2 * count as usize);
        let work = counted(|| {
            world.remove_shapes(&coins).unwrap();
            world.remove_body(body).unwrap();
        });
        world.step(DT);
        assert_eq!(world.events().sensor_end().len(), 2 * count as usize);
        work
    });
}

/// Few boxes with large numbers are few boxes.
#[test]
fn a_tree_of_few_among_many() {
    stays_equal("built anew", |count| {
        let mut tree = DynamicTree::new();
        for id in [3, count, 100 * count] {
            tree.insert(id, crate::Aabb::from_center(Vec2::ZERO, Vec2::splat(id as f32)), 1);
        }
        let work = counted(|| tree.rebuild());
        assert_eq!((tree.len(), tree.get(count).unwrap().max.x), (3, count as f32));
        work
    });
}

/// Blasts, water and zones do not measure the level in which they act.
#[test]
fn forces_in_a_large_level() {
    stays_equal("shapes measured", |count| {
        let mut world = world();
        level(&mut world, count);
        let ball = add(&mut world, 5.0, 0.5, circle(0.5));
        world.step(DT);
        let filter = crate::QueryFilter::new();
        let area = Some(crate::Aabb::from_center(Vec2::ZERO, Vec2::splat(1000.0)));
        let zone = ForceZone {
            shape: Shape::rect(1000.0, 1000.0).unwrap(),
            pose: Default::default(),
            force: ZoneForce::Acceleration(Vec2::X),
            wakes: true,
        };
        let blast =
            Explosion { center: DVec2::ZERO, radius: 1000.0, falloff: 0.0, impulse_per_metre: 1.0 };
        let work = counted(|| {
            world.explode(&blast, &filter);
            world.apply_zone(&zone, &filter, DT);
            world.apply_water(&Water { area, ..Water::default() }, &filter, DT);
            world.apply_water(&Water::default(), &filter, DT);
        });
        assert!(world.body(ball).unwrap().velocity().x > 0.0);
        work
    });
}

/// What moves on rails and meets nothing is integrated once a step, whatever else is solved finely.
#[test]
fn platforms_beside_a_refined_island() {
    let mut world = world();
    add_ground(&mut world);
    add(&mut world, 0.0, 0.5, rect(0.5, 0.5));
    let heavy = rect(0.5, 0.5).density(1000.0);
    add(&mut world, 0.0, 1.5, heavy);
    for i in 0..100 {
        let lift = RigidBody::kinematic().position(at(3.0 * i as f32, 50.0).p);
        world.add_body(lift.shape(rect(0.5, 0.5)).velocity(Vec2::Y)).unwrap();
    }
    run(&mut world, 10);
    assert!(world.state.bodies.any_refined());
    let State { bodies, .. } = &world.state;
    let listed = |pace| {
        let mut listed = Vec::new();
        counted(|| crate::stages::paces::list_bodies(bodies, pace, &mut listed))
    };
    let integrated: u64 = (0..crate::dynamics::PACES).map(listed).sum();
    assert_eq!(integrated, 102);
}

/// One shape of many that changes costs what it is near, one that goes a walk along the list.
#[test]
fn one_shape_of_a_large_level() {
    stays_equal("a shape changed", |count| {
        let mut world = world();
        let ground = level(&mut world, count);
        let shapes: Vec<ShapeId> = world.body(ground).unwrap().shapes().collect();
        world.step(DT);
        let going = counted(|| world.remove_shape(shapes[20]).unwrap());
        assert!(going < u64::from(count) + 10, "{going} steps to remove one of {count}");
        counted(|| {
            let mut shape = world.shape_mut(shapes[40]).unwrap();
            shape.set_local(Vec2::new(30.0, 0.5), 0.3).unwrap();
            shape.set_one_way(Some(Vec2::Y)).unwrap();
            shape.set_sensor(true);
            shape.set_sensor(false);
            shape.set_shape(Shape::circle(0.7).unwrap()).unwrap();
        })
    });
}

/// What is known of a body whose shapes change and go is what counting them anew gives.
#[test]
fn shapes_that_change_leave_what_all_of_them_say() {
    let mut random = anything::Random(7);
    for kind in [BodyKind::Static, BodyKind::Kinematic] {
        let mut world = world();
        let body = world.add_body(RigidBody { kind, ..RigidBody::default() }).unwrap();
        let shape = |random: &mut anything::Random| match random.below(4) {
            0 => Shape::Aabb { half_extents: Vec2::new(1.0, 0.25 * (1 + random.below(3)) as f32) },
            1 => Shape::rect(1.0, 0.25 * (1 + random.below(3)) as f32).unwrap(),
            _ => Shape::circle(0.25 * (1 + random.below(3)) as f32).unwrap(),
        };
        let mut shapes = Vec::new();
        for case in 0..400 {
            let at = random.below(shapes.len().max(1));
            let place = Vec2::new(random.below(5) as f32, 0.0);
            match random.below(5) {
                _ if shapes.len() < 2 => {
                    shapes.push(world.add_shape(body, shape(&mut random)).unwrap())
                }
                0 => shapes.push(world.add_shape(body, shape(&mut random)).unwrap()),
                1 => world.remove_shape(shapes.swap_remove(at)).unwrap(),
                2 => world.shape_mut(shapes[at]).unwrap().set_shape(shape(&mut random)).unwrap(),
                3 => world.shape_mut(shapes[at]).unwrap().set_local(place, 0.0).unwrap(),
                _ => world.shape_mut(shapes[at]).unwrap().set_sensor(case % 3 == 0),
            }
            let known = world.state.clone();
            world.update_mass(1);
            assert_eq!(known.bodies, world.state.bodies, "{kind:?} {case}");
            assert_eq!(known.shapes, world.state.shapes, "{kind:?} {case}");
        }
    }
}
