use super::*;
use crate::{Explosion, ForceZone, JointDef, Mix, Water, Wind, ZoneForce};
use core::f32::consts::PI;

#[test]
fn an_explosion_falls_off_and_spares_what_is_far() {
    let mut world = World::new(Vec2::ZERO);
    let ball = |world: &mut World, x: f32| add(world, x, 0.0, circle(0.5));
    let (near, half, far) = (ball(&mut world, 2.5), ball(&mut world, -3.5), ball(&mut world, 9.0));
    let wall = world.add_body(RigidBody::fixed().position(Vec2::new(0.0, 3.0)).shape(circle(0.5)));
    let blast =
        Explosion { center: DVec2::ZERO, radius: 2.0, falloff: 2.0, impulse_per_metre: 3.0 };
    world.explode(&blast, &QueryFilter::new());
    let mass = PI * 0.25;
    let speed = |body| world.body(body).unwrap().velocity();
    // Width 1 m, so 3 Ns at full strength.
    assert!((speed(near) - Vec2::new(3.0 / mass, 0.0)).length() < 1e-4);
    assert!((speed(half) - Vec2::new(-1.5 / mass, 0.0)).length() < 1e-4);
    assert_eq!(speed(far), Vec2::ZERO);
    assert_eq!(speed(wall.unwrap()), Vec2::ZERO);
}

#[test]
fn an_explosion_without_sense_does_nothing() {
    let mut world = World::new(Vec2::ZERO);
    let ball = add(&mut world, 1.0, 0.0, circle(0.5));
    let blast =
        Explosion { center: DVec2::ZERO, radius: 2.0, falloff: 2.0, impulse_per_metre: 3.0 };
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for blast in [
            Explosion { radius: bad, ..blast },
            Explosion { falloff: bad, ..blast },
            Explosion { impulse_per_metre: bad, ..blast },
        ] {
            world.explode(&blast, &QueryFilter::new());
            assert_eq!(world.body(ball).unwrap().velocity(), Vec2::ZERO, "{blast:?}");
        }
    }
    assert_eq!(world.stats().refused_numbers, 9);
}

#[test]
fn an_explosion_inside_a_body_pushes_its_center() {
    let mut world = World::new(Vec2::ZERO);
    let crate_ = add(&mut world, 0.5, 0.0, rect(1.0, 1.0));
    let blast =
        Explosion { center: DVec2::ZERO, radius: 1.0, falloff: 0.0, impulse_per_metre: 2.0 };
    world.explode(&blast, &QueryFilter::new());
    let body = world.body(crate_).unwrap();
    assert!((body.velocity() - Vec2::new(1.0, 0.0)).length() < 1e-5);
    assert_eq!(body.angular_velocity(), 0.0);
}

#[test]
fn a_fall_in_air_reaches_its_terminal_speed() {
    let mut world = world();
    let ball = add(&mut world, 0.0, 0.0, circle(0.5).density(2.0));
    let air = Wind { density: 1.2, drag: 0.8, ..Wind::default() };
    for _ in 0..600 {
        world.body_mut(ball).unwrap().apply_wind(&air, DT);
        world.step(DT);
    }
    // m g = 1/2 rho c w v^2.
    let mass = 2.0 * PI * 0.25;
    let expected = (mass * 10.0 / (0.5 * 1.2 * 0.8)).sqrt();
    let speed = -world.body(ball).unwrap().velocity().y;
    assert!((speed / expected - 1.0).abs() < 0.02, "{speed} {expected}");
}

#[test]
fn no_wind_is_too_strong_for_a_step() {
    let mut world = World::new(Vec2::ZERO);
    let leaf = add(&mut world, 0.0, 0.0, rect(0.5, 0.01).density(0.01));
    let storm = Wind { velocity: Vec2::new(0.0, 100.0), density: 1.2, drag: 1.0 };
    for _ in 0..120 {
        world.body_mut(leaf).unwrap().apply_wind(&storm, DT);
        world.step(DT);
        assert!((0.0..=100.0).contains(&world.body(leaf).unwrap().velocity().y));
    }
    assert!(world.body(leaf).unwrap().velocity().y > 95.0);
}

#[test]
fn wood_floats_at_the_depth_of_its_density() {
    for density in [200.0, 500.0, 800.0] {
        let mut world = world();
        // Wide: a square of about half the water's density tips over to float on its corner.
        let crate_ = add(&mut world, 0.0, 0.2, rect(1.0, 0.5).density(density));
        let water = Water { surface: DVec2::new(0.0, 1.0), ..Water::default() };
        for _ in 0..900 {
            world.apply_water(&water, &QueryFilter::new(), DT);
            world.step(DT);
        }
        // Its lower edge is at 1 - density / 1000 * height.
        let expected = 1.0 - density / 1000.0 + 0.5;
        assert!((y(&world, crate_) - expected).abs() < 0.01, "{density} {}", y(&world, crate_));
        // What floats at rest may sleep, and stays there.
        assert!(!world.body(crate_).unwrap().is_awake(), "{density}");
    }
}

#[test]
fn small_floats_come_to_rest() {
    for (radius, density, dt) in [(0.1, 200.0, DT), (0.05, 300.0, DT), (0.1, 300.0, 2.0 * DT)] {
        let mut world = world();
        let cork = add(&mut world, 0.0, 0.2, circle(radius).density(density));
        world.body_mut(cork).unwrap().set_can_sleep(false);
        for _ in 0..1200 {
            world.apply_water(&Water::default(), &QueryFilter::new(), dt);
            world.step(dt);
        }
        let speed = world.body(cork).unwrap().velocity().length();
        assert!(speed < 0.001, "{radius} {density}: {speed}");
    }
}

#[test]
fn a_stream_carries_what_swims_and_iron_sinks() {
    let mut world = world();
    let cork = add(&mut world, 0.0, 0.0, circle(0.3).density(300.0));
    let iron = add(&mut world, 5.0, 0.0, circle(0.3).density(7800.0));
    let flow = Vec2::new(1.5, 0.0);
    for _ in 0..600 {
        world.apply_water(&Water { flow, ..Water::default() }, &QueryFilter::new(), DT);
        world.step(DT);
    }
    assert!((world.body(cork).unwrap().velocity().x - 1.5).abs() < 0.02);
    assert!(y(&world, iron) < -20.0);
}

#[test]
fn zones_act_inside_alone() {
    let mut world = World::new(Vec2::ZERO);
    let (inside, outside) =
        (add(&mut world, 0.0, 0.0, circle(0.3)), add(&mut world, 9.0, 0.0, circle(0.3)));
    let mut zone = ForceZone {
        shape: Shape::rect(2.0, 2.0).unwrap(),
        pose: at(0.0, 0.0).into(),
        force: ZoneForce::Acceleration(Vec2::new(0.0, 3.0)),
        wakes: true,
    };
    for _ in 0..30 {
        world.apply_zone(&zone, &QueryFilter::new(), DT);
        world.step(DT);
    }
    assert!((world.body(inside).unwrap().velocity().y - 1.5).abs() < 1e-4);
    assert_eq!(world.body(outside).unwrap().velocity(), Vec2::ZERO);
    zone.force = ZoneForce::Damping { linear: 2.0, angular: 2.0 };
    zone.shape = Shape::rect(20.0, 20.0).unwrap();
    for _ in 0..60 {
        world.apply_zone(&zone, &QueryFilter::new(), DT);
        world.step(DT);
    }
    // 1.5 exp(-2).
    assert!((world.body(inside).unwrap().velocity().y - 0.203).abs() < 0.01);
}

/// On a circle, whatever the substeps: with the direction of the step's start, which holds for all of them, it grew by 13 % in five turns.
#[test]
fn what_a_zone_attracts_stays_in_its_orbit() {
    for substeps in [1, 2, 4, 8] {
        let mut world = World::new(Vec2::ZERO);
        world.settings.substeps = substeps;
        let moon = add(&mut world, 5.0, 0.0, circle(0.2));
        world.body_mut(moon).unwrap().set_velocity(Vec2::new(0.0, 5.0));
        let zone = ForceZone {
            shape: Shape::circle(20.0).unwrap(),
            pose: at(0.0, 0.0).into(),
            force: ZoneForce::Attraction { center: DVec2::ZERO, acceleration: 5.0 },
            wakes: true,
        };
        for step in 0..1885 {
            world.apply_zone(&zone, &QueryFilter::new(), DT);
            world.step(DT);
            let radius = world.body(moon).unwrap().position().length();
            assert!((radius - 5.0).abs() < 0.05, "{substeps} substeps, step {step}: {radius}");
        }
    }
}

#[test]
fn a_belt_brings_a_box_to_its_speed() {
    // The belt is shape A of the contact with a box or capsule, and B of that with a hexagon.
    let capsule = Shape::capsule(-Vec2::X, Vec2::X, 0.5).unwrap();
    let hexagon = Shape::regular(6, 0.57).unwrap();
    for shape in [rect(0.5, 0.5), ShapeDef::new(capsule), ShapeDef::new(hexagon)] {
        let mut world = world();
        let belt = rect(50.0, 5.0).tangent_speed(2.0);
        world.add_body(RigidBody::fixed().position(Vec2::new(0.0, -5.0)).shape(belt)).unwrap();
        let box_ = add(&mut world, 0.0, 0.5, shape);
        // The hexagon tips at first: the friction of the belt is more than its foot is wide for.
        run(&mut world, 240);
        let velocity = world.body(box_).unwrap().velocity();
        assert!((velocity.x - 2.0).abs() < 0.02, "{velocity:?}");
    }
}

/// The limit is on the speed, not on where it goes: the difference is no impulse that would be carried on.
#[test]
fn what_is_faster_than_the_limit_goes_on_at_the_limit() {
    for substeps in [1, 2, 4, 8] {
        for speed in [440.0, 500.0, 900.0, 1.0e6, 1.0e15] {
            let mut world = World::new(Vec2::ZERO);
            world.settings.substeps = substeps;
            let most = world.settings.max_speed;
            let body = add(&mut world, 0.0, 0.0, circle(0.5));
            world.body_mut(body).unwrap().set_velocity(Vec2::new(0.6 * speed, 0.8 * speed));
            world.step(DT);
            let now = world.body(body).unwrap();
            let off = (now.velocity() - Vec2::new(0.6, 0.8) * most).length();
            assert!(off < 1.0e-3 * most, "{substeps} {speed}: {:?}", now.velocity());
            let way = now.position() - Vec2::new(0.6, 0.8) * (most * DT);
            assert!(way.length() < 0.01, "{substeps} {speed}: {:?}", now.position());
        }
    }
    let mut world = World::new(Vec2::ZERO);
    let lift = world.add_body(RigidBody::kinematic().shape(rect(1.0, 1.0))).unwrap();
    world.body_mut(lift).unwrap().set_target(at(10.0, 0.0), DT);
    world.step(DT);
    let now = world.body(lift).unwrap().velocity();
    assert!((now.x - world.settings.max_speed).abs() < 0.1, "{now:?}");
}

#[test]
fn what_turns_faster_than_the_limit_goes_on_at_the_limit() {
    let mut world = World::new(Vec2::ZERO);
    let body = add(&mut world, 0.0, 0.0, circle(0.5));
    world.body_mut(body).unwrap().set_angular_velocity(5.0e4);
    world.step(DT);
    let most = 8.0 * core::f32::consts::TAU / (DT / world.settings.substeps as f32);
    let now = world.body(body).unwrap().angular_velocity();
    assert!((now - most).abs() < 1.0e-3 * most, "{now}");
}

/// Drag may stop a body within a step, but never throws it back, of however many shapes it is.
#[test]
fn no_drag_of_water_is_too_strong_for_a_step() {
    for pieces in [1, 2, 4, 8] {
        for (density, drag) in [(500.0, 300.0), (10.0, 3.0)] {
            let mut world = World::new(Vec2::ZERO);
            let mut raft = RigidBody::dynamic().velocity(Vec2::new(3.0, 0.0)).angular_velocity(2.0);
            for i in 0..pieces {
                let x = i as f32 - 0.5 * (pieces - 1) as f32;
                raft = raft.shape(rect(0.5, 0.5).offset(Vec2::new(x, 0.0)).density(density));
            }
            let raft = world.add_body(raft).unwrap();
            let surface = DVec2::new(0.0, 50.0);
            let water =
                Water { surface, linear_drag: drag, angular_drag: drag, ..Water::default() };
            for _ in 0..20 {
                let before = world.body(raft).unwrap();
                let (v, w) = (before.velocity(), before.angular_velocity());
                world.apply_water(&water, &QueryFilter::new(), DT);
                world.step(DT);
                let now = world.body(raft).unwrap();
                let (slower, turns) = (now.velocity(), now.angular_velocity());
                assert!(
                    slower.x >= -1.0e-4 && slower.x <= v.x + 1.0e-4,
                    "{pieces}: {v:?} {slower:?}"
                );
                assert!(turns >= -1.0e-4 && turns <= w + 1.0e-4, "{pieces}: {w} {turns}");
            }
        }
    }
}

/// The outline says how a mass is spread, whatever density it has.
#[test]
fn a_mass_given_to_shapes_without_density_turns() {
    for shape in [circle(0.4), rect(0.5, 0.2)] {
        let inertia = |density: f32| {
            let mut world = World::new(Vec2::ZERO);
            let shape = shape.clone().density(density).offset(Vec2::new(0.3, 0.0));
            let body = world.add_body(RigidBody::dynamic().shape(shape).mass(2.0)).unwrap();
            let body = world.body(body).unwrap();
            (body.mass(), body.inertia(), body.center().x)
        };
        let (none, some) = (inertia(0.0), inertia(3.0));
        assert!(none.1 > 0.01 && (none.1 - some.1).abs() < 1.0e-4, "{none:?} {some:?}");
        assert!(none.0 == some.0 && (none.2 - some.2).abs() < 1.0e-5);
    }
}

/// As large as numbers go: it holds, and is a number.
#[test]
fn endless_friction_holds() {
    let materials: [fn(ShapeDef) -> ShapeDef; 3] = [
        |shape| shape.friction(f32::MAX),
        |shape| shape.rolling_resistance(f32::MAX),
        |shape| shape.friction(1.0e30).rolling_resistance(1.0e30),
    ];
    for (i, material) in materials.into_iter().enumerate() {
        for mix in [Mix::GeometricMean, Mix::Average, Mix::Multiply, Mix::Max] {
            let mut world = world();
            world.settings.friction_mix = mix;
            let ground = RigidBody::fixed().position(Vec2::new(0.0, -1.0));
            world.add_body(ground.shape(material(rect(50.0, 1.0)))).unwrap();
            let low = add(&mut world, 0.0, 2.0, material(circle(1.5)));
            let high = add(&mut world, 5.0, 3.0, material(rect(0.5, 0.5)));
            run(&mut world, 180);
            assert_eq!(world.stats().frozen_bodies, 0, "{i} {mix:?}");
            assert!((y(&world, low) - 1.5).abs() < 0.02, "{i} {mix:?}: {}", y(&world, low));
            assert!((y(&world, high) - 0.5).abs() < 0.02, "{i} {mix:?}: {}", y(&world, high));
        }
    }
}

/// A thing of default density, a thousandth of the water's, rises as fast as the drag lets it: by g / drag, and no more, from the first step on.
#[test]
fn what_is_light_is_not_shot_out_of_water() {
    for density in [1.0, 20.0, 100.0] {
        let mut world = world();
        let water = Water::default();
        let ball = add(&mut world, 0.0, -40.0, circle(0.5).density(density));
        let still = 9.8 * (water.density - density) / (water.density * water.linear_drag);
        let mut speed = 0.0;
        for _ in 0..120 {
            world.apply_water(&water, &QueryFilter::new(), DT);
            world.step(DT);
            speed = world.body(ball).unwrap().velocity().y;
            assert!(speed < 1.05 * still, "density {density}: {speed} m/s for {still}");
        }
        assert!(speed > 0.95 * still, "density {density}: {speed} m/s for {still}");
    }
}

/// Under a load, or on a rope, what is light has all of its lift, whatever the length of the step.
#[test]
fn what_is_held_down_keeps_its_lift() {
    for (density, half, load) in [(1.0, 0.5, 1000.0), (100.0, 0.25, 1000.0)] {
        for dt in [DT, 2.0 * DT] {
            let mut world = world();
            let raft = add(&mut world, 0.0, 0.0, rect(2.0, half).density(density));
            let crate_ = ShapeDef::new(Shape::rect(1.5, 0.1).unwrap());
            let crate_ = RigidBody::dynamic().position((0.0, f64::from(half) + 0.1)).shape(crate_);
            world.add_body(crate_.mass(load)).unwrap();
            // It bobs for long: of the drag of a light hull little is left in a step.
            for _ in 0..6000 {
                world.apply_water(&Water::default(), &QueryFilter::new(), dt);
                world.step(dt);
            }
            let deep = (load + 8.0 * half * density) / 4000.0;
            let low = half - y(&world, raft);
            assert!(
                (low - deep).abs() < 0.02,
                "density {density}, {dt} s: {low} m deep for {deep}"
            );
        }
    }
    let mut world = world();
    world.settings.sleep = false;
    let ground = world.add_body(RigidBody::fixed().position((0.0, -5.0))).unwrap();
    let buoy = add(&mut world, 0.0, -3.0, circle(0.5).density(1.0));
    let rope = world.add_joint(ground, buoy, JointDef::rope(2.0)).unwrap();
    for _ in 0..300 {
        world.apply_water(&Water::default(), &QueryFilter::new(), DT);
        world.step(DT);
    }
    let (pull, lift) = (world.joint(rope).unwrap().force().length(), 999.0 * PI * 0.25 * 10.0);
    assert!((pull / lift - 1.0).abs() < 0.01, "{pull} N for {lift}");
}

/// Nor are light things that are joined, that lie on each other, or that have a joint that does nothing.
#[test]
fn light_things_rise_together_as_their_drag_lets_them() {
    let still = 10.0 * 999.0 / (1000.0 * Water::default().linear_drag);
    for case in 0..4 {
        let mut world = world();
        let ball = |world: &mut World, y: f32| add(world, 0.0, y, circle(0.5).density(1.0));
        let all: Vec<BodyId> = (0..3).map(|k| ball(&mut world, -40.0 + 1.01 * k as f32)).collect();
        let ground = world.add_body(RigidBody::fixed().position((0.0, -50.0))).unwrap();
        for pair in all.windows(2).take(if case < 2 { 2 } else { 0 }) {
            let joint = if case == 0 { JointDef::weld() } else { JointDef::revolute() };
            let [a, b] = [0, 1].map(|k| world.body(pair[k]).unwrap().position_f64());
            world.add_joint(pair[0], pair[1], joint.anchor_at(a.lerp(b, 0.5))).unwrap();
        }
        if case == 3 {
            world.add_joint(ground, all[0], JointDef::filter()).unwrap();
        }
        let (mut fastest, mut speed) = (0.0_f32, 0.0);
        for _ in 0..240 {
            world.apply_water(&Water::default(), &QueryFilter::new(), DT);
            world.step(DT);
            speed = world.body(all[0]).unwrap().velocity().y;
            fastest = fastest.max(speed);
        }
        assert!(fastest < 1.3 * still, "case {case}: {fastest} m/s for {still}");
        assert!(speed > 0.7 * still, "case {case}: {speed} m/s for {still}");
    }
}
