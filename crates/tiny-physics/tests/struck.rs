//! What is hit goes elsewhere than it would have gone, and goes into nothing there: not into the ground, not into what lies
//! beyond its neighbour, and nothing goes into it that counted on its going on. Families over phases; what failed before is said
//! at each.

mod common;

use common::{DT, circle, rect, upright};
use tiny_physics::{BodyId, RigidBody, Shape, Vec2, World, collide};

/// Nothing may go deeper into anything, metres.
const LITTLE: f32 = 0.04;
const PHASES: usize = 24;

/// A world without gravity, and what is in it.
struct Scene {
    world: World,
    bodies: Vec<(BodyId, Shape)>,
}

impl Scene {
    fn new() -> Self {
        Self { world: World::new(Vec2::ZERO), bodies: Vec::new() }
    }

    /// Adds a body at a place and with a velocity.
    fn add(&mut self, shape: Shape, (x, y): (f32, f32), (vx, vy): (f32, f32)) {
        let body = RigidBody::dynamic().position(Vec2::new(x, y));
        self.put(body.velocity(Vec2::new(vx, vy)), shape);
    }

    fn put(&mut self, body: RigidBody, shape: Shape) {
        let id = self.world.add_body(body.shape(shape)).expect("a sound body");
        self.bodies.push((id, shape));
    }

    /// The deepest overlap of any two over some steps, metres, as their places say.
    fn deepest(mut self, steps: usize) -> f32 {
        let mut deepest = 0.0_f32;
        for _ in 0..steps {
            self.world.step(DT);
            let pose = |id| self.world.body(id).expect("it is there").pose();
            for (k, (a, shape_a)) in self.bodies.iter().enumerate() {
                for (b, shape_b) in &self.bodies[..k] {
                    let manifold = collide(shape_a, shape_b, pose(*b).relative_to(pose(*a)), 0.0);
                    deepest = manifold.points().iter().fold(deepest, |d, p| d.max(-p.separation));
                }
            }
        }
        deepest
    }
}

/// Plays a scene for each phase of a step, as a part of it, and counts those in which something goes too deep.
fn too_deep(scene: impl Fn(f32) -> Scene) -> Vec<f32> {
    let depths = (0..PHASES).map(|i| scene(i as f32 / PHASES as f32).deepest(30));
    depths.filter(|&depth| depth > LITTLE).collect()
}

/// A ball at rest over the ground is hit from above: 13 of 24 went into the ground, by up to
/// 12 cm.
#[test]
fn what_is_struck_stops_at_the_ground() {
    let deep = too_deep(|phase| {
        let mut scene = Scene::new();
        scene.put(RigidBody::fixed(), rect(10.0, 1.0));
        scene.add(circle(0.7), (0.0, 1.75), (0.0, 0.0));
        scene.add(circle(0.7), (0.0, 3.2 + 20.0 * DT * phase), (0.0, -20.0));
        scene
    });
    assert!(deep.is_empty(), "{} of {PHASES}: {deep:.3?}", deep.len());
}

/// Two crates lie against each other, a third a little further off. The first is hit: 8 of 24 went into the third, by up to
/// 8 cm.
#[test]
fn what_is_struck_through_another_stops_at_a_third() {
    let deep = too_deep(|phase| {
        let mut scene = Scene::new();
        let crate_ = upright(0.5, 0.5);
        scene.add(crate_, (0.0, 0.0), (0.0, 0.0));
        scene.add(crate_, (1.0, 0.0), (0.0, 0.0));
        scene.add(crate_, (2.03, 0.0), (0.0, 0.0));
        scene.add(crate_, (-1.5 - 14.0 * DT * phase, 0.0), (14.0, 0.0));
        scene
    });
    assert!(deep.is_empty(), "{} of {PHASES}: {deep:.3?}", deep.len());
}

/// Two crates fly one behind the other. The first comes down on the ground, and rubs: 15 of 24 were run into, by up to 13 cm.
/// What comes down as a step ends rubs in the next, which nobody foresees: 6.
#[test]
fn what_rubs_is_not_run_into() {
    let deep = too_deep(|phase| {
        let mut scene = Scene::new();
        scene.put(RigidBody::fixed(), rect(20.0, 1.0));
        let crate_ = upright(0.5, 0.5);
        scene.add(crate_, (0.0, 1.6 + 15.0 * DT * phase), (20.0, -15.0));
        scene.add(crate_, (-1.03, 1.9 + 15.0 * DT * phase), (20.0, 0.0));
        scene
    });
    assert!(deep.len() <= 6, "{} of {PHASES}: {deep:.3?}", deep.len());
}
