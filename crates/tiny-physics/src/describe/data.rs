//! Descriptions as data of a saved frame.

use super::{
    BodyKind, Break, ChainDef, ChainLink, Filter, JointDef, JointKind, Limits, Locks, Material,
    Mix, Motor, RigidBody, Settings, ShapeDef, Spring, Tile, TileForm, TileGrid,
};
use crate::codec::{data, data_enum};

data_enum!(BodyKind { 0 => Static, 1 => Kinematic, 2 => Dynamic });
data!(Locks { x, y, rotation });
data!(Filter { category, mask, group });
data!(Material {
    density,
    friction,
    restitution,
    rolling_resistance,
    tangent_speed,
    friction_mix,
    restitution_mix,
});
data_enum!(Mix { 0 => GeometricMean, 1 => Average, 2 => Min, 3 => Max, 4 => Multiply });
data!(Settings {
    substeps,
    iterations,
    refine_up_to,
    length_unit,
    contact_hertz,
    contact_damping_ratio,
    push_speed,
    restitution_threshold,
    hit_event_threshold,
    max_speed,
    sleep,
    time_to_sleep,
    continuous,
    friction_mix,
    restitution_mix,
});
data!(ShapeDef {
    shape,
    offset,
    angle,
    material,
    filter,
    sensor,
    sees_sensors,
    one_way,
    contact_events,
    hit_events,
    user_data,
    link
});
data!(RigidBody {
    kind,
    position,
    angle,
    velocity,
    angular_velocity,
    linear_damping,
    angular_damping,
    gravity_scale,
    locks,
    shapes,
    mass,
    center,
    inertia,
    can_sleep,
    awake,
    sleep_speed,
    bullet,
    enabled,
    user_data
});
data!(Spring { hertz, damping_ratio });
data!(Motor { speed, max });
data!(Limits { lower, upper });
data!(Break { force, torque });
data_enum!(JointKind {
    0 => Distance { length, spring, limits, motor },
    1 => Revolute { spring, target_angle, limits, motor },
    2 => Prismatic { spring, target, limits, motor },
    3 => Weld { linear, angular },
    4 => Wheel { spring, limits, motor },
    5 => Motor {
        velocity,
        max_force,
        angular_velocity,
        max_torque,
        linear_spring,
        max_spring_force,
        angular_spring,
        max_spring_torque,
    },
    6 => Mouse { target, spring, max_force },
    7 => Filter,
    8 => Pulley { ground_a, ground_b, length, ratio },
    9 => Gear { ratio, slide_a, slide_b },
});
data!(JointDef {
    kind,
    anchor_a,
    anchor_b,
    angle_a,
    angle_b,
    collide_connected,
    softness,
    break_at,
    anchors_at,
    enabled,
    user_data,
});
data!(ChainLink { previous, next });
data!(ChainDef { points, closed, materials, filter, user_data });
data_enum!(TileForm { 0 => Full, 1 => Half, 2 => Side, 3 => Slope, 4 => GentleLow, 5 => GentleHigh });
data!(Tile { form, mirror_x, mirror_y, material, filter, one_way, user_data });
data!(TileGrid { position, angle, cell_size, width, height, palette, cells });
