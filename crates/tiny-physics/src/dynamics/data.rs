//! Records and blocks as data of a saved frame.

use super::blocks::{
    BlockHead, ConstraintBlock, ManifoldBlock, PointLanes, SurfaceBlock, save_blocks,
};
use super::bodies::{BodyInfo, Motion};
use super::contacts::{Contact, Place, SavedPoint};
use super::graph::Bucket;
use super::joint_blocks::*;
use super::joint_graph::{JointBucket, JointColour};
use super::joints::{JointPlace, JointRecord};
use super::shapes::ShapeRecord;
use crate::codec::{Data, Reader, Sink, data, data_enum};
use crate::error::Error;

data!(Motion { gain, factor });
data!(BodyInfo { kind, alive, enabled, awake, bullet, can_sleep, never_turns, pace, locks, force, torque, gravity_scale, linear_damping, angular_damping, sleep_time, sleep_speed, min_extent, max_extent, first_shape, first_joint, local_center, mass, inertia, fixed_mass, shape_count, first_contact, contact_colours, joint_colours, island_next, user_data } apart { generation });
data!(ShapeRecord { body, next, proxy, class, alive, sensor, contact_events, hit_events, filter, material, local, central, box_frame, one_way, link, user_data, shape } apart { generation });
data!(SavedPoint { id, normal_impulse, tangent_impulse });
data_enum!(Place { 0 => Asleep, 1 => Graph { colour, slot } });
data!(Contact {
    alive,
    touching,
    events,
    hit_events,
    class,
    place,
    shape_a,
    shape_b,
    body_a,
    body_b,
    friction,
    restitution,
    rolling_resistance,
    tangent_speed,
    saved,
    links
});
data_enum!(JointPlace { 0 => Asleep, 1 => Graph { colour, slot } });
data!(JointRecord { alive, body_a, body_b, def, place, saved, links } apart { generation });
data!(ManifoldBlock { body_a, body_b, shape_a, shape_b, id_1, id_2, friction });
data!(PointLanes {
    separation,
    normal_arm_a,
    normal_arm_b,
    tangent_arm_a,
    tangent_arm_b,
    normal_mass,
    tangent_mass,
    normal_impulse,
    tangent_impulse,
    load
});
data!(SurfaceBlock {
    restitution,
    rolling_resistance,
    tangent_speed,
    rolling_impulse,
    approach_1,
    approach_2,
    peak_1,
    peak_2,
});
data!(ConstraintBlock { body_a, body_b, normal_x, normal_y, friction, points });
data!(BlockHead { touching, flags, jointed_a, jointed_b });
data!(FrameLanes {
    body_a,
    body_b,
    local_a_x,
    local_a_y,
    local_b_x,
    local_b_y,
    a_x,
    a_y,
    b_x,
    b_y,
    between_x,
    between_y
});
data!(SoftLanes { push, mass_scale, impulse_scale, rigid });
data!(PointLanes2 { impulse_x, impulse_y });
data!(RodLanes { impulse });
data!(AngleLanes { turn_c, turn_s, start });
data!(DirectionLanes { local_x, local_y, x, y, now_x, now_y });
data!(AxisLanes {
    used,
    push,
    mass_scale,
    impulse_scale,
    rest,
    target,
    motor_speed,
    motor_max,
    lower,
    upper,
    spring,
    motor,
    lower_impulse,
    upper_impulse
});
data!(MotorLanes { speed, max, impulse });
data!(LengthLanes { length, now_x, now_y });
data!(DriveLanes {
    target_x,
    target_y,
    mouse,
    velocity_x,
    velocity_y,
    velocity_max,
    spring_max,
    angular_velocity,
    angular_max,
    twist_max,
    velocity_impulse_x,
    velocity_impulse_y,
    angular_impulse
});
data!(RopeLanes {
    ground_a_x,
    ground_a_y,
    ground_b_x,
    ground_b_y,
    arm_a_x,
    arm_a_y,
    arm_b_x,
    arm_b_y,
    ratio,
    length,
    now_x,
    now_y
});
data!(GearLanes { slide_a_x, slide_a_y, spin_a, slide_b_x, slide_b_y, spin_b, impulse, error });
data!(DistanceBlock { frame, soft, rod, axis, length });
data!(RevoluteBlock { frame, soft, point, angle, axis });
data!(PrismaticBlock { frame, soft, rigid, angle, direction, axis });
data!(WeldBlock { frame, linear, angular, point, twist, angle });
data!(WheelBlock { frame, soft, rod, direction, motor, axis });
data!(DriveBlock { frame, linear, angular, point, twist, angle, drive });
data!(PulleyBlock { frame, soft, rod, rope });
data!(GearBlock { frame, soft, gear });
data!(JointColour { distance, revolute, prismatic, weld, wheel, drive, pulley, gear });

impl Data for Bucket {
    fn save(&self, sink: &mut impl Sink) {
        let Self { contacts, manifolds, constraints, surfaces, heads } = self;
        contacts.save(sink);
        save_blocks(manifolds, contacts.len(), sink);
        save_blocks(constraints, contacts.len(), sink);
        save_blocks(surfaces, contacts.len(), sink);
        heads.save(sink);
    }
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        Ok(Self {
            contacts: Data::load(reader)?,
            manifolds: Data::load(reader)?,
            constraints: Data::load(reader)?,
            surfaces: Data::load(reader)?,
            heads: Data::load(reader)?,
        })
    }
}

impl<B: JointLanes + Data> Data for JointBucket<B> {
    fn save(&self, sink: &mut impl Sink) {
        let Self { joints, blocks, stale } = self;
        joints.save(sink);
        save_blocks(blocks, joints.len(), sink);
        stale.save(sink);
    }
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        Ok(Self {
            joints: Data::load(reader)?,
            blocks: Data::load(reader)?,
            stale: Data::load(reader)?,
        })
    }
}
