//! Random worlds, each from its seed: the same for the same seed, on every platform.

use super::parts;
use super::shapes::{rect, shape};
use tiny_physics::{RigidBody, Shape, Vec2};
use tiny_physics_scenes::{Act, Deed, Random, Scene, Script, Timeline, When};

/// Steps of every world: ten seconds.
pub const STEPS: u32 = 600;

/// Draws a world: ground, and one to three parts beside or over each other, and now and then deeds.
pub fn draw(seed: u64) -> Scene {
    let mut random = Random::new(seed ^ 0x61_7265_6e61);
    let mut scene = Scene::new(format!("arena_{seed}"), String::new());
    scene.gravity = Vec2::new(0.0, if random.below(12) == 0 { 0.0 } else { -10.0 });
    scene.steps = STEPS;
    let mut words = vec![ground(&mut random, &mut scene).to_owned()];
    let parts = 1 + random.below(3);
    for i in 0..parts {
        let place = Vec2::new(9.0 * (i as f32 - 0.5 * (parts - 1) as f32), 0.3);
        words.push(parts::add(&mut random, &mut scene, place));
    }
    if let Some(word) = deeds(&mut random, &mut scene) {
        words.push(word);
    }
    scene.description = words.join(", ");
    scene
}

/// What everything stands on, its surface near y = 0, walls around it.
fn ground(random: &mut Random, scene: &mut Scene) -> &'static str {
    for side in [-1.0, 1.0] {
        let wall = RigidBody::fixed().position(Vec2::new(22.0 * side, 15.0));
        scene.body(wall.shape(rect(1.0, 17.0)));
    }
    match random.below(4) {
        0 => {
            for i in 0..44 {
                let place = Vec2::new(i as f32 - 21.5, -0.5);
                scene.body(RigidBody::fixed().position(place).shape(rect(0.5, 0.5)));
            }
            "tiles"
        }
        1 => {
            // Gentle hills of segments: without thickness.
            let mut body = RigidBody::fixed();
            let height = |i: i32| 0.4 * tiny_physics::math::sin(0.9 * i as f32) - 0.4;
            for i in -15..15 {
                let (a, b) = (1.5 * i as f32, 1.5 * (i + 1) as f32);
                let (a, b) = (Vec2::new(a, height(i)), Vec2::new(b, height(i + 1)));
                body = body.shape(Shape::Segment { a, b });
            }
            scene.body(body);
            "hills of segments"
        }
        2 => {
            scene.body(RigidBody::fixed().position(Vec2::new(0.0, -0.05)).shape(rect(23.0, 0.05)));
            "thin floor"
        }
        _ => {
            scene.body(RigidBody::fixed().position(Vec2::new(0.0, -2.0)).shape(rect(23.0, 2.0)));
            "thick floor"
        }
    }
}

/// Things that happen on the way: bodies come, go, and are pushed.
fn deeds(random: &mut Random, scene: &mut Scene) -> Option<String> {
    let movable: Vec<usize> = (0..scene.bodies.len())
        .filter(|&body| scene.bodies[body].kind == tiny_physics::BodyKind::Dynamic)
        .collect();
    let mut acts = match scene.script.take() {
        Some(Script::Timeline(line)) => line.acts,
        _ => Vec::new(),
    };
    let machines = !acts.is_empty();
    let mut words = Vec::new();
    if random.below(4) == 0 {
        for _ in 0..1 + random.below(4) {
            let body = movable[random.below(movable.len() as u32) as usize];
            acts.push(Act { when: When::At(60 + random.below(240)), deed: Deed::Remove { body } });
        }
        words.push("removed");
    }
    if random.below(4) == 0 {
        for _ in 0..1 + random.below(4) {
            let place = Vec2::new(random.range(-15.0, 15.0), random.range(8.0, 14.0));
            let thing = shape(random, 0.5);
            let body = RigidBody::dynamic().position(place).shape(thing);
            acts.push(Act {
                when: When::At(60 + random.below(240)),
                deed: Deed::Add { new: Box::new(body) },
            });
        }
        words.push("added");
    }
    if random.below(5) == 0 {
        let body = movable[random.below(movable.len() as u32) as usize];
        let velocity = Vec2::new(random.range(-30.0, 30.0), random.range(0.0, 20.0));
        let deed = Deed::SetVelocity { body, velocity, angular_velocity: random.range(-9.0, 9.0) };
        acts.push(Act { when: When::At(90 + random.below(200)), deed });
        words.push("pushed");
    }
    if machines || !acts.is_empty() {
        scene.script = Some(Script::Timeline(Timeline { acts }));
    }
    (!words.is_empty()).then(|| words.join(" and "))
}
