//! After the substeps: poses take up the motion, boxes follow, rest is timed.

use crate::broad_phase::{BroadPhase, ProxyId};
use crate::describe::BodyKind;
use crate::dynamics::{Bodies, NULL, Shapes, Slot};
use crate::math::{Aabb, DVec2, Pose, Vec2};
use crate::simd::Row;

/// A body that moved so far in one step that it might have jumped over something.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FastBody {
    pub(crate) body: u32,
    /// Pose of the centre of mass at the start of the step.
    pub(crate) start: Pose,
}

/// What [`run`] needs to know of the world's settings.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Options {
    pub(crate) dt: f32,
    pub(crate) continuous: bool,
}

/// Bodies that move less than this fraction of their smallest half width in a step cannot jump.
const SAFE_FRACTION: f32 = 0.5;

/// Takes the motion of the step over into the poses. Fast bodies are listed in `fast`, their boxes
/// left for the continuous stage; bodies whose numbers are no longer finite are listed in `broken`.
pub(crate) fn run(
    bodies: &mut Bodies,
    shapes: &Shapes,
    broad_phase: &mut BroadPhase,
    options: Options,
    fast: &mut Vec<FastBody>,
    broken: &mut Vec<u32>,
) {
    let awake = core::mem::take(&mut bodies.awake);
    for &index in &awake {
        let i = index as usize;
        let row = &mut bodies.rows[i];
        let motion = Vec2::new(row[Slot::DX], row[Slot::DY]);
        let turn = row[Slot::DA];
        if !(motion.is_finite() && turn.is_finite() && row[..3].iter().all(|v| v.is_finite())) {
            broken.push(index);
            continue;
        }
        row[Slot::DX] = 0.0;
        row[Slot::DY] = 0.0;
        row[Slot::DA] = 0.0;
        let start = bodies.poses[i];
        bodies.poses[i] = Pose::new(start.p + motion, start.q.integrate(turn));
        time_rest(bodies, index, options.dt);
        let info = &bodies.infos[i];
        let reach = motion.length() + turn.abs() * info.max_extent;
        if options.continuous
            && info.kind == BodyKind::Dynamic
            && reach > SAFE_FRACTION * info.min_extent
        {
            fast.push(FastBody { body: index, start });
        } else {
            update_boxes(bodies, shapes, broad_phase, index, motion);
        }
    }
    bodies.awake = awake;
}

/// Counts the time that a body has been slower than its sleep speed.
fn time_rest(bodies: &mut Bodies, index: u32, dt: f32) {
    let speed = bodies.velocity(index).length();
    let turn_rate = bodies.angular_velocity(index).abs();
    let info = &mut bodies.infos[index as usize];
    let fastest = speed.max(turn_rate * info.max_extent);
    if !info.can_sleep || fastest > info.sleep_speed {
        info.sleep_time = 0.0;
    } else {
        info.sleep_time += dt;
    }
}

/// Tells the broad phase where the shapes of a body are. `motion` is that of the last step, metres:
/// the best guess of the next.
pub(crate) fn update_boxes(
    bodies: &Bodies,
    shapes: &Shapes,
    broad_phase: &mut BroadPhase,
    index: u32,
    motion: Vec2,
) {
    let pose = bodies.poses[index as usize];
    for shape in shapes.of_body(bodies.infos[index as usize].first_shape) {
        let proxy = shapes.records[shape as usize].proxy;
        if proxy != NULL {
            let tight = shape_box(shapes, shape, pose);
            broad_phase.move_proxy(ProxyId(proxy), tight, motion);
        }
    }
}

/// The box of a shape on a body whose centre of mass has this pose.
pub(crate) fn shape_box(shapes: &Shapes, shape: u32, pose: Pose) -> Aabb {
    let row = &shapes.rows[shape as usize];
    if row[7] == 1.0 {
        rounded_box(row, pose)
    } else {
        let record = &shapes.records[shape as usize];
        record.shape.world_aabb(pose.compose(record.central))
    }
}

/// The box of a rounded box.
#[inline]
fn rounded_box(row: &Row, pose: Pose) -> Aabb {
    let center = pose.apply(Vec2::new(row[0], row[1]));
    let (c, s) = (pose.q.c * row[2] - pose.q.s * row[3], pose.q.s * row[2] + pose.q.c * row[3]);
    let (c, s) = (c.abs(), s.abs());
    let extent = Vec2::new(c * row[4] + s * row[5] + row[6], s * row[4] + c * row[5] + row[6]);
    let extent = DVec2::from(extent);
    Aabb::rounded_out(center - extent, center + extent)
}
