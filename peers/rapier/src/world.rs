//! Rapier's world as a host of scenes.
//!
//! For timing, everything is set to what the description says; what it does not say, and how stiff contacts are, stays at Rapier's defaults:
//! 4 solver iterations (its substeps) with one pass each, contact recycling on, automatic continuous
//! collision against fixed colliders. For quality, so do the solver and sleeping: [`Tuning`].

use crate::belts::Belts;
use crate::filters::Filters;
use crate::joints::joint;
use crate::queries;
use crate::shapes::{collider, vector};
use peers_worker::{BodyState, Engine, Host, Scene, Setup, Subject, Summary, Tuning};
use rapier2d::prelude::*;
use tiny_physics::{BodyKind, DVec2, JointDef, Settings, Shape, Vec2};

/// A Rapier world and the handles of what a scene put into it.
pub struct Rapier {
    world: PhysicsWorld,
    settings: Settings,
    tuning: Tuning,
    filters: Filters,
    belts: Belts,
    bodies: Vec<RigidBodyHandle>,
    joints: Vec<Option<ImpulseJointHandle>>,
    /// Bodies with forces of the step to come.
    pushed: Vec<usize>,
}

impl Engine for Rapier {
    fn create(setup: &Setup<'_>) -> Result<Self, String> {
        if !setup.setting.is_empty() {
            return Err(format!("Rapier has no setting {}", setup.setting));
        }
        let mut world = PhysicsWorld::new();
        world.gravity = vector(setup.gravity);
        if setup.tuning == Tuning::Scene {
            world.integration_parameters = parameters(setup.settings);
        }
        set_threads(&mut world, setup.threads)?;
        Ok(Self {
            world,
            settings: *setup.settings,
            tuning: setup.tuning,
            filters: Filters::default(),
            belts: Belts::default(),
            bodies: Vec::new(),
            joints: Vec::new(),
            pushed: Vec::new(),
        })
    }

    fn lacks(scene: &Scene) -> Option<String> {
        let mut shapes = scene.bodies.iter().flat_map(|body| &body.shapes);
        if shapes.any(|shape| shape.material.rolling_resistance != 0.0) {
            return Some("Rapier has no rolling resistance".into());
        }
        let strange =
            scene.joints.iter().find(|joint| crate::joints::joint(&joint.def).is_none())?;
        Some(format!("joint not translated to Rapier: {:?}", strange.def.kind))
    }

    #[cfg(feature = "frames")]
    fn save(&self) -> Option<Vec<u8>> {
        bincode::serialize(&self.world).ok()
    }

    #[cfg(feature = "frames")]
    fn restore(&mut self, bytes: &[u8]) -> Result<(), String> {
        self.world = bincode::deserialize(bytes).map_err(|error| error.to_string())?;
        Ok(())
    }

    fn summary(&self) -> Summary {
        let (mut contacts, mut overlap) = (0, 0.0_f32);
        for pair in self.world.narrow_phase.contact_pairs() {
            contacts += usize::from(pair.has_any_active_contact());
            overlap = pair.find_deepest_contact().map_or(overlap, |(_, c)| overlap.max(-c.dist));
        }
        let overlap = overlap.into();
        let joints = self.world.impulse_joints.len();
        let bodies = self.world.bodies.iter().map(|(_, body)| body_state(body));
        Summary { contacts, joints, overlap, ..Summary::of_bodies(bodies) }
    }

    fn name() -> String {
        "Rapier 0.36.1".into()
    }

    fn build(&self) -> String {
        let lanes = if cfg!(feature = "simd8") { 8 } else { 4 };
        let target = if cfg!(target_feature = "avx2") { "x86-64-v3" } else { "baseline" };
        let threads = if cfg!(feature = "parallel") { ", parallel" } else { "" };
        format!("{target}, {lanes} lanes{threads}")
    }
}

impl Subject for Rapier {
    fn angle(&self, body: usize) -> f64 {
        let body = self.world.bodies.get(self.bodies[body]);
        body.map_or(0.0, |body| body.rotation().angle().into())
    }

    fn angular_velocity(&self, body: usize) -> f32 {
        self.world.bodies.get(self.bodies[body]).map_or(0.0, RigidBody::angvel)
    }
}

impl Host for Rapier {
    fn add_body(&mut self, body: &tiny_physics::RigidBody) -> usize {
        let handle = self.world.insert_body(rigid_body(body, &self.settings, self.tuning));
        let mut colliders = Vec::new();
        let mut speeds = Vec::new();
        for def in &body.shapes {
            let builder = collider(def, &self.settings).zip(self.filters.groups(def.filter));
            let Some((builder, groups)) = builder else {
                eprintln!("a shape is left out: degenerate, or the 33rd distinct filter");
                continue;
            };
            let speed = def.material.tangent_speed;
            let mut collider = builder.collision_groups(groups).build();
            if speed != 0.0 {
                collider.set_active_hooks(ActiveHooks::MODIFY_SOLVER_CONTACTS);
            }
            colliders.push(collider);
            speeds.push(speed);
        }
        if let Some(mass) = body.mass {
            scale_mass(&mut colliders, mass);
        }
        for (collider, speed) in colliders.into_iter().zip(speeds) {
            let collider = self.world.insert_collider(collider, Some(handle));
            if speed != 0.0 {
                self.belts.add(collider, speed);
            }
        }
        self.bodies.push(handle);
        self.bodies.len() - 1
    }

    fn remove_body(&mut self, body: usize) {
        self.world.remove_body(self.bodies[body]);
    }

    fn add_joint(&mut self, a: usize, b: usize, def: &JointDef) -> usize {
        let (a, b) = (self.bodies[a], self.bodies[b]);
        self.joints.push(joint(def).map(|joint| self.world.insert_impulse_joint(a, b, joint)));
        self.joints.len() - 1
    }

    fn remove_joint(&mut self, joint: usize) {
        if let Some(handle) = self.joints[joint].take() {
            self.world.remove_impulse_joint(handle);
        }
    }

    fn velocity(&self, body: usize) -> Vec2 {
        let body = self.world.bodies.get(self.bodies[body]);
        body.map_or(Vec2::ZERO, |body| Vec2::new(body.linvel().x, body.linvel().y))
    }

    fn set_velocity(&mut self, body: usize, velocity: Vec2) {
        if let Some(body) = self.world.bodies.get_mut(self.bodies[body]) {
            body.set_linvel(vector(velocity), true);
        }
    }

    fn set_angular_velocity(&mut self, body: usize, radians_per_second: f32) {
        if let Some(body) = self.world.bodies.get_mut(self.bodies[body]) {
            body.set_angvel(radians_per_second, true);
        }
    }

    fn apply_force(&mut self, body: usize, newtons: Vec2) {
        self.pushed.push(body);
        if let Some(body) = self.world.bodies.get_mut(self.bodies[body]) {
            body.add_force(vector(newtons), true);
        }
    }

    fn position(&self, body: usize) -> DVec2 {
        let body = self.world.bodies.get(self.bodies[body]);
        body.map_or(DVec2::ZERO, |body| {
            DVec2::new(body.translation().x.into(), body.translation().y.into())
        })
    }

    fn is_awake(&self, body: usize) -> bool {
        let body = self.world.bodies.get(self.bodies[body]);
        body.is_some_and(|body| !body.is_sleeping())
    }

    fn wake(&mut self, body: usize) {
        self.world.wake_up(self.bodies[body], true);
    }

    fn step(&mut self, dt: f32) {
        self.world.integration_parameters.dt = dt;
        self.world.step_with_events(&self.belts, &());
        // Forces here are of one step, Rapier's until they are reset.
        for body in self.pushed.drain(..) {
            if let Some(body) = self.world.bodies.get_mut(self.bodies[body]) {
                body.reset_forces(false);
            }
        }
    }

    fn ray_cast(&mut self, origin: Vec2, translation: Vec2, mask: u64) -> Option<f32> {
        queries::ray_cast(&self.world, origin, translation, self.filters.query(mask))
    }

    fn circle_cast(
        &mut self,
        center: Vec2,
        radius: f32,
        translation: Vec2,
        mask: u64,
    ) -> Option<f32> {
        queries::circle_cast(&self.world, center, radius, translation, self.filters.query(mask))
    }

    fn count_overlaps(&mut self, lower: Vec2, upper: Vec2, mask: u64) -> usize {
        queries::count_overlaps(&self.world, lower, upper, self.filters.query(mask))
    }
}

fn parameters(settings: &Settings) -> IntegrationParameters {
    IntegrationParameters {
        num_solver_iterations: settings.substeps as usize,
        normalized_max_linear_velocity: settings.max_speed,
        max_ccd_substeps: usize::from(settings.continuous),
        ..IntegrationParameters::default()
    }
}

#[cfg(feature = "parallel")]
fn set_threads(world: &mut PhysicsWorld, threads: usize) -> Result<(), String> {
    let pool = world.physics_pipeline.configure_thread_pool(threads);
    pool.map_err(|error| format!("no thread pool: {error}"))
}

#[cfg(not(feature = "parallel"))]
fn set_threads(_: &mut PhysicsWorld, threads: usize) -> Result<(), String> {
    if threads == 1 { Ok(()) } else { Err("built without threads".into()) }
}

fn rigid_body(body: &tiny_physics::RigidBody, settings: &Settings, tuning: Tuning) -> RigidBody {
    let kind = match body.kind {
        BodyKind::Static => RigidBodyType::Fixed,
        BodyKind::Kinematic => RigidBodyType::KinematicVelocityBased,
        BodyKind::Dynamic => RigidBodyType::Dynamic,
    };
    let mut locks = LockedAxes::empty();
    locks.set(LockedAxes::TRANSLATION_LOCKED_X, body.locks.x);
    locks.set(LockedAxes::TRANSLATION_LOCKED_Y, body.locks.y);
    let never_turns = body.shapes.iter().any(|def| matches!(def.shape, Shape::Aabb { .. }));
    locks.set(LockedAxes::ROTATION_LOCKED, body.locks.rotation || never_turns);
    let mut out = RigidBodyBuilder::new(kind)
        .pose(Pose::new(vector(body.position.to_vec2()), body.angle))
        .linvel(vector(body.velocity))
        .angvel(body.angular_velocity)
        .linear_damping(body.linear_damping)
        .angular_damping(body.angular_damping)
        .gravity_scale(body.gravity_scale)
        .locked_axes(locks)
        .can_sleep(settings.sleep && body.can_sleep)
        .sleeping(!body.awake)
        .ccd_enabled(settings.continuous && body.bullet)
        .enabled(body.enabled)
        .build();
    if settings.sleep && body.can_sleep && tuning == Tuning::Scene {
        let activation = out.activation_mut();
        activation.normalized_linear_threshold = body.sleep_speed;
        activation.time_until_sleep = settings.time_to_sleep;
    }
    out
}

/// Scales the densities so that the colliders weigh `mass` together.
fn scale_mass(colliders: &mut [Collider], mass: f32) {
    let total: f32 = colliders.iter().map(Collider::mass).sum();
    if total > 0.0 {
        for collider in colliders {
            collider.set_density(collider.density() * (mass / total));
        }
    }
}

fn body_state(body: &RigidBody) -> BodyState {
    let speed = body.linvel();
    BodyState {
        dynamic: body.is_dynamic(),
        awake: !body.is_sleeping(),
        height: body.center_of_mass().y.into(),
        mass: body.mass().into(),
        inertia: body.mass_properties().local_mprops.principal_inertia().into(),
        speed_sq: (speed.x * speed.x + speed.y * speed.y).into(),
        spin: body.angvel().into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tiny_physics::Vec2;

    #[test]
    fn tells_how_bodies_are_turned() {
        let mut world = Rapier::create(&Setup {
            gravity: Vec2::ZERO,
            settings: &Settings::default(),
            tuning: Tuning::Own,
            threads: 1,
            setting: "",
        })
        .expect("one thread and no setting");
        let own = IntegrationParameters::default();
        assert_eq!(world.world.integration_parameters.contact_softness, own.contact_softness);
        let body = tiny_physics::RigidBody::dynamic()
            .shape(Shape::Circle { radius: 0.5 })
            .angle(0.3)
            .angular_velocity(2.0);
        let body = world.add_body(&body);
        assert!((world.angle(body) - 0.3).abs() < 1e-6);
        world.step(0.1);
        assert!((world.angle(body) - 0.5).abs() < 1e-3, "{}", world.angle(body));
        assert!((world.angular_velocity(body) - 2.0).abs() < 1e-6);
    }
}
