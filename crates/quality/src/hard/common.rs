//! What rows of several families are made of.

use crate::lab::{Lab, Trial};
use crate::report::Measure;
use crate::scenery::{fixed, rect, scene};
use crate::target::Target;
use tiny_physics::{Filter, RigidBody, Shape, ShapeDef, Vec2};
use tiny_physics_scenes::Scene;

/// Length of a step, seconds.
pub(super) const DT: f64 = 1.0 / 60.0;
/// Meetings of one kind, each at another part of a step's way.
pub(super) const PHASES: usize = 40;

/// A count that has to be 0.
pub(super) fn none(metric: String, count: usize) -> Measure {
    Measure::new(metric, count as f64, "", Target::AtMost(0.0))
}

/// A kinematic body.
pub(super) fn machine(shape: Shape, position: Vec2) -> RigidBody {
    RigidBody::kinematic().can_sleep(false).position(position).shape(shape)
}

/// A shape that collides with nothing.
pub(super) fn ghost(shape: Shape) -> ShapeDef {
    ShapeDef::new(shape).filter(Filter { mask: 0, ..Filter::default() })
}

/// Pairs of bodies, the first to the left of the second: in how many are they the other way round after some seconds?
pub(super) fn passed(lab: &mut Lab<'_>, scene: Scene, seconds: f64) -> usize {
    lab.expect_seconds(seconds, scene.dt);
    let mut trial = lab.build(scene);
    lab.run(&mut trial, seconds, |_| {});
    let is_past = |pair: &usize| !(trial.position(2 * pair).x < trial.position(2 * pair + 1).x);
    (0..trial.len() / 2).filter(is_past).count()
}

/// A floor at y = 0 between two walls.
pub(super) fn pit(width: f32) -> Scene {
    let mut scene = scene("pit");
    scene.body(fixed(rect(width, 1.0), Vec2::new(0.0, -1.0)));
    for side in [-1.0, 1.0] {
        scene.body(fixed(rect(0.5, 60.0), Vec2::new(side * (0.5 * width + 0.5), 58.0)));
    }
    scene
}

/// Seconds until everything sleeps; twice the patience where it does not.
pub(super) fn seconds_until_asleep(lab: &mut Lab<'_>, trial: &mut Trial, patience: f64) -> f64 {
    while trial.time() < patience {
        lab.step(trial);
        if trial.sleeps() {
            return trial.time();
        }
    }
    2.0 * patience
}
