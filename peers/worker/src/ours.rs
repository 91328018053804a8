//! This engine's own world as a worker: the host of scenes that everything else here plays on, too.

use crate::engine::{BodyState, Engine, Setup, Summary};
use crate::frames::best_ms;
use std::hint::black_box;
use tiny_physics::{BodyKind, SimdLevel, World};
use tiny_physics_scenes::WorldHost;

impl Engine for WorldHost {
    fn create(setup: &Setup<'_>) -> Result<Self, String> {
        // The scene's settings are this engine's defaults, or what the scene says instead.
        let mut host = Self::new(setup.gravity, *setup.settings);
        host.world_mut().set_threads(setup.threads);
        if !setup.setting.is_empty() {
            let level: SimdLevel = setup.setting.parse()?;
            host.world_mut().set_simd(level).map_err(|error| error.to_string())?;
        }
        Ok(host)
    }

    fn save(&self) -> Option<Vec<u8>> {
        Some(self.world().to_bytes())
    }

    fn restore(&mut self, bytes: &[u8]) -> Result<(), String> {
        self.world_mut().restore_bytes(bytes).map_err(|error| error.to_string())
    }

    fn clone_ms(&self) -> Option<f64> {
        let mut frame = self.world().clone();
        Some(best_ms(|| frame.clone_from(black_box(self.world()))))
    }

    fn summary(&self) -> Summary {
        let world = self.world();
        let states = world.body_ids().filter_map(|id| world.body(id)).map(|body| BodyState {
            dynamic: body.kind() == BodyKind::Dynamic,
            awake: body.is_awake(),
            height: body.center().y,
            mass: body.mass().into(),
            inertia: body.inertia().into(),
            speed_sq: body.velocity().length_sq().into(),
            spin: body.angular_velocity().into(),
        });
        Summary {
            joints: world.joint_count(),
            contacts: contact_count(world),
            overlap: world.max_penetration().into(),
            ..Summary::of_bodies(states)
        }
    }

    fn name() -> String {
        "tiny-physics".into()
    }

    fn build(&self) -> String {
        let level = self.world().simd();
        format!("plain target, {level} at run time, {} lanes", level.lane_count())
    }
}

/// Contacts that touch, those of sleeping bodies with them: the other engines count these, too.
fn contact_count(world: &World) -> usize {
    let mut awake = world.clone();
    for body in world.body_ids() {
        if let Some(mut body) = awake.body_mut(body) {
            body.wake();
        }
    }
    awake.contact_count()
}
