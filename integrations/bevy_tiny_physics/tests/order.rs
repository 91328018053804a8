//! The same level gives the same bits, whoever was spawned first.

mod common;
use bevy_app::App;
use bevy_ecs::prelude::*;
use bevy_tiny_physics::prelude::*;
use bevy_transform::prelude::Transform;
use common::*;

/// Some component of the game's, which moves entities to another archetype.
#[derive(Component)]
struct Tag;

/// Spawns a piece of a level; `at` says which, `variant` with how many components that physics does not know.
fn spawn(app: &mut App, at: usize, variant: usize) {
    let (x, y) = ((at % 7) as f32 * 0.9 - 3.0, 1.0 + (at / 7) as f32 * 1.1);
    let at_xy = Transform::from_xyz(x, y, variant as f32);
    let entity = match at % 3 {
        0 => app.world_mut().spawn((RigidBody::Dynamic, Collider::circle(0.4), at_xy)).id(),
        1 => app
            .world_mut()
            .spawn((RigidBody::Dynamic, Collider::rect(0.4, 0.3), Velocity::default(), at_xy))
            .id(),
        _ => {
            let body = app.world_mut().spawn((RigidBody::Dynamic, at_xy)).id();
            let sides = if variant == 0 { [-0.2, 0.2] } else { [0.2, -0.2] };
            for side in sides {
                app.world_mut().spawn((
                    Collider::circle(0.25),
                    Transform::from_xyz(side, 0.0, 0.0),
                    ChildOf(body),
                ));
            }
            body
        }
    };
    if variant > 0 && at.is_multiple_of(2) {
        app.world_mut().entity_mut(entity).insert(Tag);
    }
}

fn hash_of(order: impl Iterator<Item = usize>, variant: usize) -> Vec<u64> {
    let mut app = app();
    if variant > 0 {
        for _ in 0..17 {
            app.world_mut().spawn(Tag);
        }
    }
    for at in order {
        spawn(&mut app, at, variant);
    }
    let walls = [(0.0, -1.0, 10.0, 1.0), (-5.0, 5.0, 1.0, 10.0), (5.0, 5.0, 1.0, 10.0)];
    for (x, y, w, h) in walls {
        app.world_mut().spawn((Collider::rect(w, h), Transform::from_xyz(x, y, 0.0)));
    }
    (0..6)
        .map(|_| {
            steps(&mut app, 40);
            physics(&app).world.state_hash()
        })
        .collect()
}

#[test]
fn spawn_order_and_archetypes_do_not_matter() {
    let forward = hash_of(0..70, 0);
    assert_eq!(forward, hash_of((0..70).rev(), 0), "backwards");
    assert_eq!(
        forward,
        hash_of((0..70).map(|at| at * 37 % 70), 1),
        "shuffled, in other archetypes"
    );
    assert_ne!(forward, hash_of(0..69, 0), "a hash that tells");
}

#[test]
fn joints_and_removals_keep_the_order() {
    let run = |backwards: bool| {
        let mut app = app();
        ground(&mut app);
        let mut places: Vec<usize> = (0..12).collect();
        if backwards {
            places.reverse();
        }
        let mut balls: Vec<(usize, Entity)> = places
            .iter()
            .map(|at| (*at, ball(&mut app, *at as f32 * 1.5, 1.0 + *at as f32)))
            .collect();
        balls.sort_by_key(|(at, _)| *at);
        let pairs: Vec<_> = balls.windows(2).map(|pair| (pair[0].1, pair[1].1)).collect();
        for at in places.iter().copied().filter(|at| *at < 11) {
            let (a, b) = pairs[at];
            app.world_mut().spawn(Joint::new(a, b, JointDef::rope(2.0)));
        }
        steps(&mut app, 30);
        for at in places.iter().filter(|at| *at % 3 == 0) {
            app.world_mut().despawn(balls[*at].1);
        }
        steps(&mut app, 1);
        for at in places.iter().filter(|at| *at % 4 == 0) {
            ball(&mut app, *at as f32, 20.0);
        }
        steps(&mut app, 60);
        physics(&app).world.state_hash()
    };
    assert_eq!(run(false), run(true));
}

#[test]
fn body_order_goes_before_place() {
    let first = |orders: [u64; 2]| {
        let mut app = app();
        let balls = [ball(&mut app, 0.0, 0.0), ball(&mut app, 5.0, 0.0)];
        for (ball, order) in balls.iter().zip(orders) {
            app.world_mut().entity_mut(*ball).insert(BodyOrder(order));
        }
        steps(&mut app, 1);
        balls.map(|ball| physics(&app).body_id(ball).unwrap())
    };
    let ([a, b], [c, d]) = (first([1, 2]), first([2, 1]));
    assert!(a < b && d < c);
}
