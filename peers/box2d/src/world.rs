//! Box2D's world as a host of scenes.
//!
//! For timing, everything is set to what the description says; what it does not say (contact recycling, joint
//! stiffness) and how stiff contacts are stays at Box2D's defaults. For quality, so does the solver: [`Tuning`].

use crate::joints;
use crate::queries;
use crate::shapes::{Geometry, geometry, rot, shape_def, vec2};
use boxdd_sys::ffi::*;
use peers_worker::{BodyState, Engine, Host, Scene, Setup, Subject, Summary, Tuning};
use tiny_physics::{BodyKind, DVec2, JointDef, JointKind, Mix, RigidBody, Shape, Vec2};

/// A Box2D world and the handles of what a scene put into it.
pub struct Box2d {
    world: b2WorldId,
    bodies: Vec<Option<b2BodyId>>,
    joints: Vec<Option<b2JointId>>,
    substeps: i32,
}

/// What Box2D's manual advises.
const SUBSTEPS: i32 = 4;

impl Engine for Box2d {
    fn create(setup: &Setup<'_>) -> Result<Self, String> {
        if !env!("PEERS_CFLAGS").contains("-DNDEBUG") {
            return Err("Box2D was built with its assertions on: build with CFLAGS=-DNDEBUG".into());
        }
        if !setup.setting.is_empty() {
            return Err(format!("Box2D has no setting {}", setup.setting));
        }
        let def = world_def(setup);
        // SAFETY: `def` began as the default and outlives the call.
        let world = unsafe { b2CreateWorld(&def) };
        if world.index1 == 0 {
            return Err("it holds no more worlds".into());
        }
        let substeps = match setup.tuning {
            Tuning::Scene => setup.settings.substeps as i32,
            Tuning::Own => SUBSTEPS,
        };
        Ok(Self { world, bodies: Vec::new(), joints: Vec::new(), substeps })
    }

    fn lacks(scene: &Scene) -> Option<String> {
        let mut shapes = scene.bodies.iter().flat_map(|body| &body.shapes);
        if shapes.any(|shape| geometry(shape).is_none()) {
            return Some("a polygon too small for Box2D".into());
        }
        let known = |kind: &JointKind| {
            !matches!(
                kind,
                JointKind::Mouse { .. } | JointKind::Pulley { .. } | JointKind::Gear { .. }
            )
        };
        let strange = scene.joints.iter().find(|joint| !known(&joint.def.kind))?;
        Some(format!("joint not translated to Box2D: {:?}", strange.def.kind))
    }

    fn save(&self) -> Option<Vec<u8>> {
        // SAFETY: the world lives until drop; without a buffer the call only tells a size.
        let size = unsafe { b2World_Snapshot(self.world, core::ptr::null_mut(), 0) };
        let mut bytes = vec![0; usize::try_from(size).ok()?];
        // SAFETY: the buffer has `size` bytes.
        let written = unsafe { b2World_Snapshot(self.world, bytes.as_mut_ptr(), size) };
        (written == size && size > 0).then_some(bytes)
    }

    fn restore(&mut self, bytes: &[u8]) -> Result<(), String> {
        let size = i32::try_from(bytes.len()).map_err(|error| error.to_string())?;
        // SAFETY: the world lives until drop, no step is under way, and `bytes` has `size` bytes.
        let done = unsafe { b2World_Restore(self.world, bytes.as_ptr(), size) };
        if done { Ok(()) } else { Err("Box2D refuses the snapshot".into()) }
    }

    fn summary(&self) -> Summary {
        let live = || self.bodies.iter().flatten();
        // SAFETY: the world lives until drop.
        let joints = unsafe { b2World_GetCounters(self.world) }.jointCount as usize;
        let (mut contacts, mut overlap) = (0, 0.0_f32);
        for &body in live() {
            let (count, depth) = contacts_of(body);
            contacts += count;
            overlap = overlap.max(depth);
        }
        // Each contact is on the lists of both of its bodies.
        let (contacts, overlap) = (contacts / 2, overlap.into());
        let bodies = Summary::of_bodies(live().map(|&body| body_state(body)));
        Summary { joints, contacts, overlap, ..bodies }
    }

    fn name() -> String {
        // SAFETY: returns a plain value.
        let version = unsafe { b2GetVersion() };
        let commit = &boxdd_sys::UPSTREAM_SHA[..9];
        format!("Box2D {}.{}.{} ({commit})", version.major, version.minor, version.revision)
    }

    fn build(&self) -> String {
        let lanes = if cfg!(feature = "avx2") { "AVX2, 8 lanes" } else { "SSE2, 4 lanes" };
        format!("{lanes}, {}", env!("PEERS_CFLAGS"))
    }
}

impl Drop for Box2d {
    fn drop(&mut self) {
        // SAFETY: the world was made in `create` and is destroyed only here.
        unsafe { b2DestroyWorld(self.world) }
    }
}

impl Subject for Box2d {
    fn angle(&self, body: usize) -> f64 {
        // SAFETY: the handle is live while it is on the list.
        let q = self.bodies[body].map(|id| unsafe { b2Body_GetRotation(id) });
        q.map_or(0.0, |q| f64::from(q.s).atan2(f64::from(q.c)))
    }

    fn angular_velocity(&self, body: usize) -> f32 {
        // SAFETY: as above.
        self.bodies[body].map_or(0.0, |id| unsafe { b2Body_GetAngularVelocity(id) })
    }
}

impl Host for Box2d {
    fn add_body(&mut self, body: &RigidBody) -> usize {
        let def = body_def(body);
        // SAFETY: `def` began as the default; the world lives until drop.
        let id = unsafe { b2CreateBody(self.world, &def) };
        for shape in &body.shapes {
            add_shape(id, shape);
        }
        if let Some(mass) = body.mass {
            scale_mass(id, mass);
        }
        self.bodies.push(Some(id));
        self.bodies.len() - 1
    }

    fn remove_body(&mut self, body: usize) {
        if let Some(id) = self.bodies[body].take() {
            // SAFETY: the handle was live: it leaves the list here.
            unsafe { b2DestroyBody(id) }
        }
    }

    fn add_joint(&mut self, a: usize, b: usize, joint: &JointDef) -> usize {
        let ends = self.bodies[a].zip(self.bodies[b]);
        let id = ends.and_then(|(a, b)| joints::add_joint(self.world, a, b, joint));
        self.joints.push(id);
        self.joints.len() - 1
    }

    fn remove_joint(&mut self, joint: usize) {
        if let Some(id) = self.joints[joint].take() {
            // SAFETY: the call checks; removing a body took its joints with it.
            unsafe {
                if b2Joint_IsValid(id) {
                    b2DestroyJoint(id, true);
                }
            }
        }
    }

    fn velocity(&self, body: usize) -> Vec2 {
        // SAFETY: the handle is live while it is on the list.
        let v = self.bodies[body].map(|id| unsafe { b2Body_GetLinearVelocity(id) });
        v.map_or(Vec2::ZERO, |v| Vec2::new(v.x, v.y))
    }

    fn set_velocity(&mut self, body: usize, velocity: Vec2) {
        if let Some(id) = self.bodies[body] {
            // SAFETY: as above.
            unsafe { b2Body_SetLinearVelocity(id, vec2(velocity)) }
        }
    }

    fn position(&self, body: usize) -> DVec2 {
        // SAFETY: as above.
        let p = self.bodies[body].map(|id| unsafe { b2Body_GetPosition(id) });
        p.map_or(DVec2::ZERO, |p| DVec2::new(p.x.into(), p.y.into()))
    }

    fn set_angular_velocity(&mut self, body: usize, radians_per_second: f32) {
        if let Some(id) = self.bodies[body] {
            // SAFETY: as above.
            unsafe { b2Body_SetAngularVelocity(id, radians_per_second) }
        }
    }

    fn apply_force(&mut self, body: usize, newtons: Vec2) {
        if let Some(id) = self.bodies[body] {
            // SAFETY: as above.
            unsafe { b2Body_ApplyForceToCenter(id, vec2(newtons), true) }
        }
    }

    fn is_awake(&self, body: usize) -> bool {
        // SAFETY: as above.
        self.bodies[body].is_some_and(|id| unsafe { b2Body_IsAwake(id) })
    }

    fn wake(&mut self, body: usize) {
        if let Some(id) = self.bodies[body] {
            // SAFETY: as above.
            unsafe { b2Body_SetAwake(id, true) }
        }
    }

    fn step(&mut self, dt: f32) {
        // SAFETY: the world lives until drop.
        unsafe { b2World_Step(self.world, dt, self.substeps) }
    }

    fn ray_cast(&mut self, origin: Vec2, translation: Vec2, mask: u64) -> Option<f32> {
        queries::ray_cast(self.world, origin, translation, mask)
    }

    fn circle_cast(
        &mut self,
        center: Vec2,
        radius: f32,
        translation: Vec2,
        mask: u64,
    ) -> Option<f32> {
        queries::circle_cast(self.world, center, radius, translation, mask)
    }

    fn count_overlaps(&mut self, lower: Vec2, upper: Vec2, mask: u64) -> usize {
        queries::count_overlaps(self.world, lower, upper, mask)
    }
}

fn world_def(setup: &Setup<'_>) -> b2WorldDef {
    let settings = setup.settings;
    // SAFETY: returns a plain value.
    let mut def = unsafe { b2DefaultWorldDef() };
    def.gravity = vec2(setup.gravity);
    def.frictionCallback = mix_callback(settings.friction_mix, Mix::GeometricMean);
    def.restitutionCallback = mix_callback(settings.restitution_mix, Mix::Max);
    if setup.tuning == Tuning::Scene {
        def.restitutionThreshold = settings.restitution_threshold;
        def.hitEventThreshold = settings.hit_event_threshold;
        def.maximumLinearSpeed = settings.max_speed;
        def.enableSleep = settings.sleep;
        def.enableContinuous = settings.continuous;
    }
    // More than one starts Box2D's own scheduler.
    def.workerCount = setup.threads as i32;
    def
}

/// Box2D's callback for a mix; none for the mix that it has built in.
fn mix_callback(
    mix: Mix,
    built_in: Mix,
) -> Option<unsafe extern "C" fn(f32, u64, f32, u64) -> f32> {
    extern "C" fn geometric_mean(a: f32, _: u64, b: f32, _: u64) -> f32 {
        Mix::GeometricMean.apply(a, b)
    }
    extern "C" fn average(a: f32, _: u64, b: f32, _: u64) -> f32 {
        Mix::Average.apply(a, b)
    }
    extern "C" fn min(a: f32, _: u64, b: f32, _: u64) -> f32 {
        Mix::Min.apply(a, b)
    }
    extern "C" fn max(a: f32, _: u64, b: f32, _: u64) -> f32 {
        Mix::Max.apply(a, b)
    }
    extern "C" fn multiply(a: f32, _: u64, b: f32, _: u64) -> f32 {
        Mix::Multiply.apply(a, b)
    }
    if mix == built_in {
        return None;
    }
    Some(match mix {
        Mix::GeometricMean => geometric_mean,
        Mix::Average => average,
        Mix::Min => min,
        Mix::Max => max,
        Mix::Multiply => multiply,
    })
}

fn body_def(body: &RigidBody) -> b2BodyDef {
    // SAFETY: returns a plain value.
    let mut def = unsafe { b2DefaultBodyDef() };
    def.type_ = match body.kind {
        BodyKind::Static => b2BodyType_b2_staticBody,
        BodyKind::Kinematic => b2BodyType_b2_kinematicBody,
        BodyKind::Dynamic => b2BodyType_b2_dynamicBody,
    };
    def.position = vec2(body.position.to_vec2());
    def.rotation = rot(body.angle);
    def.linearVelocity = vec2(body.velocity);
    def.angularVelocity = body.angular_velocity;
    def.linearDamping = body.linear_damping;
    def.angularDamping = body.angular_damping;
    def.gravityScale = body.gravity_scale;
    def.sleepThreshold = body.sleep_speed;
    def.motionLocks.linearX = body.locks.x;
    def.motionLocks.linearY = body.locks.y;
    def.motionLocks.angularZ = body.locks.rotation || never_turns(body);
    def.enableSleep = body.can_sleep;
    def.isAwake = body.awake;
    def.isBullet = body.bullet;
    def.isEnabled = body.enabled;
    def
}

/// A body with a never-turning box does not turn.
fn never_turns(body: &RigidBody) -> bool {
    body.shapes.iter().any(|def| matches!(def.shape, Shape::Aabb { .. }))
}

fn add_shape(body: b2BodyId, shape: &tiny_physics::ShapeDef) {
    let Some(geometry) = geometry(shape) else {
        eprintln!("a shape is left out: degenerate");
        return;
    };
    let def = shape_def(shape);
    // SAFETY: `def` began as the default, the geometry outlives the call, the body is live.
    unsafe {
        match geometry {
            Geometry::Circle(circle) => b2CreateCircleShape(body, &def, &circle),
            Geometry::Capsule(capsule) => b2CreateCapsuleShape(body, &def, &capsule),
            Geometry::Segment(segment) => b2CreateSegmentShape(body, &def, &segment),
            Geometry::Polygon(polygon) => b2CreatePolygonShape(body, &def, &polygon),
        };
    }
}

/// Scales mass and moment of inertia so that the mass becomes `mass`.
fn scale_mass(body: b2BodyId, mass: f32) {
    // SAFETY: the body is live.
    let mut data = unsafe { b2Body_GetMassData(body) };
    if data.mass > 0.0 {
        data.rotationalInertia *= mass / data.mass;
        data.mass = mass;
        // SAFETY: the body is live.
        unsafe { b2Body_SetMassData(body, data) }
    }
}

/// Touching contacts of a body, and the depth of the deepest of their points.
fn contacts_of(body: b2BodyId) -> (usize, f32) {
    // SAFETY: the body is live.
    let capacity = unsafe { b2Body_GetContactCapacity(body) };
    let mut data: Vec<b2ContactData> = Vec::with_capacity(capacity as usize);
    // SAFETY: the buffer holds `capacity` elements; the call says how many of them it wrote.
    unsafe {
        let count = b2Body_GetContactData(body, data.as_mut_ptr(), capacity);
        data.set_len(count as usize);
    }
    let (mut touching, mut deepest) = (0, 0.0_f32);
    for contact in &data {
        let points = &contact.manifold.points[..contact.manifold.pointCount as usize];
        touching += usize::from(!points.is_empty());
        deepest = points.iter().fold(deepest, |depth, point| depth.max(-point.separation));
    }
    (touching, deepest)
}

fn body_state(body: b2BodyId) -> BodyState {
    // SAFETY: the body is live.
    unsafe {
        let v = b2Body_GetLinearVelocity(body);
        BodyState {
            dynamic: b2Body_GetType(body) == b2BodyType_b2_dynamicBody,
            awake: b2Body_IsAwake(body),
            height: b2Body_GetWorldCenter(body).y.into(),
            mass: b2Body_GetMass(body).into(),
            inertia: b2Body_GetRotationalInertia(body).into(),
            speed_sq: (v.x * v.x + v.y * v.y).into(),
            spin: b2Body_GetAngularVelocity(body).into(),
        }
    }
}
