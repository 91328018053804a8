//! The engine's own world as a host of scenes.

use peers_worker::{BodyState, Engine, Host, Setup, Subject, Summary, best_ms};
use std::hint::black_box;
use tiny_physics::{
    Aabb, BodyId, BodyKind, DVec2, JointDef, JointId, QueryFilter, RigidBody, Rot, Shape,
    SimdLevel, Transform, Vec2, World,
};

/// A world and the handles of what a scene put into it.
pub struct Ours {
    world: World,
    bodies: Vec<BodyId>,
    joints: Vec<Option<JointId>>,
}

impl Engine for Ours {
    fn create(setup: &Setup<'_>) -> Result<Self, String> {
        // The scene's settings are this engine's defaults, or what the scene says instead.
        let mut world = World::with_settings(setup.gravity, *setup.settings);
        world.set_threads(setup.threads);
        if !setup.setting.is_empty() {
            let level: SimdLevel = setup.setting.parse()?;
            world.set_simd(level).map_err(|error| error.to_string())?;
        }
        Ok(Self { world, bodies: Vec::new(), joints: Vec::new() })
    }

    fn save(&self) -> Option<Vec<u8>> {
        Some(self.world.to_bytes())
    }

    fn restore(&mut self, bytes: &[u8]) -> Result<(), String> {
        self.world.restore_bytes(bytes).map_err(|error| error.to_string())
    }

    fn clone_ms(&self) -> Option<f64> {
        let mut frame = self.world.clone();
        Some(best_ms(|| frame.clone_from(black_box(&self.world))))
    }

    fn summary(&self) -> Summary {
        let ids = self.world.body_ids();
        let states = ids.filter_map(|id| self.world.body(id)).map(|body| {
            let (v, w) = (body.velocity(), body.angular_velocity());
            BodyState {
                dynamic: body.kind() == BodyKind::Dynamic,
                awake: body.is_awake(),
                height: body.center().y,
                mass: body.mass().into(),
                inertia: body.inertia().into(),
                speed_sq: v.length_sq().into(),
                spin: w.into(),
            }
        });
        Summary {
            joints: self.world.joint_count(),
            contacts: self.contact_count(),
            overlap: self.world.max_penetration().into(),
            ..Summary::of_bodies(states)
        }
    }

    fn name() -> String {
        "tiny-physics".into()
    }

    fn build(&self) -> String {
        let level = self.world.simd();
        format!("plain target, {level} at run time, {} lanes", level.lane_count())
    }
}

impl Ours {
    /// Contacts that touch, those of sleeping bodies with them: the other engines count these, too.
    fn contact_count(&self) -> usize {
        let mut world = self.world.clone();
        for &body in &self.bodies {
            if let Some(mut body) = world.body_mut(body) {
                body.wake();
            }
        }
        world.contact_count()
    }
}

impl Subject for Ours {
    fn angle(&self, body: usize) -> f64 {
        self.world.body(self.bodies[body]).map_or(0.0, |body| {
            let rotation = body.rotation();
            f64::from(rotation.s).atan2(f64::from(rotation.c))
        })
    }

    fn angular_velocity(&self, body: usize) -> f32 {
        self.world.body(self.bodies[body]).map_or(0.0, |body| body.angular_velocity())
    }
}

impl Host for Ours {
    fn add_body(&mut self, body: &RigidBody) -> usize {
        let id = self.world.add_body(body.clone()).expect("the scene is valid");
        self.bodies.push(id);
        self.bodies.len() - 1
    }

    fn remove_body(&mut self, body: usize) {
        let _ = self.world.remove_body(self.bodies[body]);
    }

    fn add_joint(&mut self, a: usize, b: usize, def: &JointDef) -> usize {
        let id = self.world.add_joint(self.bodies[a], self.bodies[b], *def);
        self.joints.push(id.ok());
        self.joints.len() - 1
    }

    fn remove_joint(&mut self, joint: usize) {
        if let Some(id) = self.joints[joint].take() {
            // It may have gone with one of its bodies.
            let _ = self.world.remove_joint(id);
        }
    }

    fn position(&self, body: usize) -> DVec2 {
        self.world.body(self.bodies[body]).map_or(DVec2::ZERO, |body| body.position_f64())
    }

    fn velocity(&self, body: usize) -> Vec2 {
        self.world.body(self.bodies[body]).map_or(Vec2::ZERO, |body| body.velocity())
    }

    fn set_velocity(&mut self, body: usize, velocity: Vec2) {
        if let Some(mut body) = self.world.body_mut(self.bodies[body]) {
            body.set_velocity(velocity);
        }
    }

    fn set_angular_velocity(&mut self, body: usize, radians_per_second: f32) {
        if let Some(mut body) = self.world.body_mut(self.bodies[body]) {
            body.set_angular_velocity(radians_per_second);
        }
    }

    fn apply_force(&mut self, body: usize, newtons: Vec2) {
        if let Some(mut body) = self.world.body_mut(self.bodies[body]) {
            body.apply_force_to_center(newtons);
        }
    }

    fn is_awake(&self, body: usize) -> bool {
        self.world.body(self.bodies[body]).is_some_and(|body| body.is_awake())
    }

    fn wake(&mut self, body: usize) {
        if let Some(mut body) = self.world.body_mut(self.bodies[body]) {
            body.wake();
        }
    }

    fn step(&mut self, dt: f32) {
        self.world.step(dt);
    }

    fn ray_cast(&mut self, origin: Vec2, translation: Vec2, mask: u64) -> Option<f32> {
        let filter = QueryFilter::default().mask(mask);
        self.world.ray_cast(origin, translation, &filter).map(|hit| hit.fraction)
    }

    fn circle_cast(
        &mut self,
        center: Vec2,
        radius: f32,
        translation: Vec2,
        mask: u64,
    ) -> Option<f32> {
        let (shape, filter) = (Shape::Circle { radius }, QueryFilter::default().mask(mask));
        let pose = Transform::new(center, Rot::IDENTITY);
        self.world.cast_shape(&shape, pose, translation, &filter).map(|hit| hit.fraction)
    }

    fn count_overlaps(&mut self, lower: Vec2, upper: Vec2, mask: u64) -> usize {
        let filter = QueryFilter::default().mask(mask);
        self.world.overlap_aabb(Aabb { min: lower, max: upper }, &filter).len()
    }
}
