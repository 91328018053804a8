//! Going through all that a world holds, and printing it.

use super::{
    Body, BodyId, BodyMut, JointId, JointMut, JointRef, ShapeId, ShapeMut, ShapeRef, World,
};
use crate::describe::{BodyKind, Filter, JointDef, Locks, Material, RigidBody};
use crate::geometry::Shape;
use crate::math::{Aabb, DVec2, Pose, Rot, Vec2};
use crate::stages::finalize::FastBody;
use crate::work;
use core::fmt;

impl World {
    /// All bodies, in index order.
    ///
    /// ```
    /// use tiny_physics::prelude::*;
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let mut world = World::new((0.0, -10.0));
    /// for x in 0..3 {
    ///     world.add_body(RigidBody::dynamic().position((f64::from(x), 5.0)).shape(Shape::circle(0.3)?))?;
    /// }
    /// world.step(1.0 / 60.0);
    /// assert!(world.bodies().all(|body| body.position().y < 5.0));
    /// # Ok(())
    /// # }
    /// ```
    pub fn bodies(&self) -> impl Iterator<Item = Body<'_>> {
        self.body_ids().filter_map(|id| self.body(id))
    }

    /// Kinematic bodies that the last step moved, in index order.
    pub(crate) fn machines(&self) -> impl Iterator<Item = Body<'_>> {
        let machines = self.moved_lists()[1].iter().inspect(|_| work::note());
        machines.filter_map(|&id| self.body(id))
    }

    /// All shapes, in index order.
    pub fn shapes(&self) -> impl Iterator<Item = ShapeRef<'_>> {
        self.shape_ids().filter_map(|id| self.shape(id))
    }

    /// All joints, in index order.
    pub fn joints(&self) -> impl Iterator<Item = JointRef<'_>> {
        self.joint_ids().filter_map(|id| self.joint(id))
    }
}

impl Body<'_> {
    /// May any point of it have been in a box during the last step?
    pub(crate) fn went_through(&self, bounds: &Aabb) -> bool {
        !FastBody::of_step(&self.world.state.bodies, self.index).misses(self.info(), bounds)
    }

    /// The body as it is now, as a description: for copies, prefabs, editors. Added to a world it is the same body, but
    /// for the last bits of its angle, forces that wait for the next step, and what joints and others do to it.
    ///
    /// ```
    /// use tiny_physics::prelude::*;
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let mut world = World::new((0.0, -10.0));
    /// let barrel = RigidBody::dynamic().shape(Shape::circle(0.4)?).friction(0.3).user_data(7);
    /// let barrel = world.add_body(barrel)?;
    /// world.step(1.0 / 60.0);
    /// let copy = world.body(barrel).unwrap().describe().position((3.0, 0.0));
    /// let copy = world.add_body(copy)?;
    /// assert_eq!(world.body(copy).unwrap().velocity(), world.body(barrel).unwrap().velocity());
    /// # Ok(())
    /// # }
    /// ```
    pub fn describe(&self) -> RigidBody {
        let info = self.info();
        let shapes = self.shapes().filter_map(|id| self.world.shape(id));
        info.tell(RigidBody {
            position: self.position_f64(),
            angle: self.angle(),
            velocity: self.velocity(),
            angular_velocity: self.angular_velocity(),
            shapes: shapes.map(|shape| shape.describe()).collect(),
            mass: info.fixed_mass.get(),
            center: info.fixed_center.get(),
            inertia: info.fixed_inertia.get(),
            awake: info.awake || info.kind == BodyKind::Static,
            ..RigidBody::default()
        })
    }
}

impl fmt::Debug for Body<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut out = f.debug_struct("Body");
        out.field("id", &self.id()).field("kind", &self.kind());
        out.field("position", &self.position_f64()).field("angle", &self.angle());
        if self.kind() != BodyKind::Static {
            out.field("velocity", &self.velocity());
            out.field("angular_velocity", &self.angular_velocity());
            out.field("awake", &self.is_awake());
        }
        out.finish_non_exhaustive()
    }
}

impl fmt::Debug for ShapeRef<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut out = f.debug_struct("Shape");
        out.field("id", &self.id()).field("body", &self.body()).field("shape", self.shape());
        out.field("sensor", &self.is_sensor()).finish_non_exhaustive()
    }
}

impl fmt::Debug for JointRef<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut out = f.debug_struct("Joint");
        out.field("id", &self.id()).field("bodies", &self.bodies()).field("kind", &self.def().kind);
        out.finish_non_exhaustive()
    }
}

/// What a body, shape or joint tells is told by one that may be changed, too: here what is read from the world, then under
/// `also` what has a function of its own.
macro_rules! told_by_both {
    (
        $view:ident $changed:ident ($this:ident) { $($(#[doc = $doc:literal])+ $name:ident: $out:ty = $told:expr;)+ }
        also { $($(#[doc = $own_doc:literal])+ $own:ident: $own_out:ty;)* }
    ) => {
        impl $view<'_> {
            $($(#[doc = $doc])+
            pub fn $name(&self) -> $out {
                let $this = self;
                $told
            })+
        }

        impl $changed<'_> {
            $($(#[doc = $doc])+
            pub fn $name(&self) -> $out {
                self.as_ref().$name()
            })+
            $($(#[doc = $own_doc])+
            pub fn $own(&self) -> $own_out {
                self.as_ref().$own()
            })*
        }

        impl fmt::Debug for $changed<'_> {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                self.as_ref().fmt(f)
            }
        }
    };
}

told_by_both! {
    Body BodyMut (body) {
        /// Its handle.
        id: BodyId = body.world.body_id(body.index);
        /// Origin of its frame: world, metres.
        position: Vec2 = body.position_f64().to_vec2();
        /// Origin of its frame in 64 bits: world, metres.
        position_f64: DVec2 = body.pose().p;
        /// Frame of the body in the world.
        pose: Pose = body.world.state.bodies.origin_pose(body.index);
        /// Rotation of its frame.
        rotation: Rot = body.pose().q;
        /// Angle of its frame, radians in [-pi, pi].
        angle: f32 = body.rotation().angle();
        /// Centre of mass: world, metres.
        center: DVec2 = body.world.state.bodies.poses[body.index as usize].p;
        /// Centre of mass in the body's frame, metres.
        local_center: Vec2 = body.info().local_center;
        /// Velocity of the centre of mass, metres a second.
        velocity: Vec2 = body.world.state.bodies.velocity(body.index);
        /// Radians a second, anticlockwise.
        angular_velocity: f32 = body.world.state.bodies.angular_velocity(body.index);
        /// Kilograms; 0 for bodies that are not dynamic.
        mass: f32 = body.info().mass;
        /// Moment of inertia about the centre of mass, kilogram square metres; 0 for bodies that are not
        /// dynamic.
        inertia: f32 = body.info().inertia;
        /// What moves it.
        kind: BodyKind = body.info().kind;
        /// Is it simulated at the moment? Static bodies never are.
        is_awake: bool = body.info().awake;
        /// Directions in which it cannot move.
        locks: Locks = body.info().locks;
        /// May its island fall asleep?
        can_sleep: bool = body.info().can_sleep;
        /// Speed below which it counts as at rest, metres a second.
        sleep_speed: f32 = body.info().sleep_speed;
        /// Factor on the world's gravity.
        gravity_scale: f32 = body.info().gravity_scale;
        /// Linear and angular damping, 1/s.
        damping: (f32, f32) = (body.info().linear_damping, body.info().angular_damping);
        /// A flag that changes nothing: see [`RigidBody::bullet`](crate::RigidBody::bullet).
        is_bullet: bool = body.info().bullet;
        /// Does it take part?
        is_enabled: bool = body.info().enabled;
        /// The user's number.
        user_data: u64 = body.info().user_data;
    }
    also {}
}

told_by_both! {
    ShapeRef ShapeMut (shape) {
        /// Its handle.
        id: ShapeId = shape.world.shape_id(shape.index);
        /// The body it hangs on.
        body: BodyId = shape.world.body_id(shape.record.body);
        /// Surface and stuff.
        material: Material = shape.record.material;
        /// What it collides with.
        filter: Filter = shape.record.filter;
        /// Is it a sensor?
        is_sensor: bool = shape.record.sensor;
        /// Its frame in the world.
        pose: Pose = shape.world.state.bodies.poses[shape.record.body as usize].compose(shape.record.central);
        /// The user's number.
        user_data: u64 = shape.record.user_data;
    }
    also {
        /// Geometry in the shape's frame.
        shape: &Shape;
    }
}

told_by_both! {
    JointRef JointMut (joint) {
        /// Its handle.
        id: JointId = joint.world.joint_id(joint.index);
        /// Its bodies A and B.
        bodies: (BodyId, BodyId) = (joint.world.body_id(joint.record.body_a), joint.world.body_id(joint.record.body_b));
        /// Does it do anything?
        is_enabled: bool = joint.record.def.enabled;
        /// The user's number.
        user_data: u64 = joint.record.def.user_data;
    }
    also {
        /// What it does.
        def: &JointDef;
        /// Its anchors on A and B: world, metres.
        anchors: (DVec2, DVec2);
        /// B's angle against A's as the joint counts it, radians in [-pi, pi].
        angle: f32;
        /// How fast its angle grows, radians a second.
        angular_speed: f32;
        /// Place along its line, or distance of the anchors, metres.
        translation: f32;
        /// How fast its translation grows, metres a second.
        speed: f32;
        /// Force or torque that the motor exerted in the last step, newtons or newton metres.
        motor_load: f32;
    }
}
