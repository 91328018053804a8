//! What bounces does so where it is in the moment of the hit.
//!
//! Normal and arms of a contact are those of the start of the step, or of its time of impact as that was foreseen. When it bounces, its
//! bodies have gone on by some `e` against each other, so the impulse `P` and its opposite would act at two points and make a
//! torque `P x e` out of nothing, and the normal of what is round has turned.
//!
//! So the contact of two disks is found anew for the moment when they meet, later in the substep or, where it was not
//! foreseen, up to a step ago. The impulse acts when the substep begins: what it takes two free bodies up to the moment is taken off
//! their places. They end up where they belong, with the angular momentum and the energy that they had.
//!
//! Of what else moves freely the arms are made to meet in one point: a disk keeps its own. Disks were found anew with boxes, too: then 132
//! of 500 showers of boxes and balls on a dull ground went deep.

use crate::dynamics::{Bodies, Bucket, ConstraintBlock, NULL, Slot};
use crate::geometry::Shape;
use crate::math::Vec2;
use crate::simd::{BLOCK, Row};
use crate::stages::anew::{self, Course, Scope};
use crate::stages::effective_mass::{changes, effective_mass};

/// How often the moment is looked for: each time the rest of the way shrinks to about its square.
const LOOKS: usize = 6;
/// The moment is known if it changes by less than this part of the substep.
const KNOWN: f32 = 1e-5;
/// Shapes are looked at that would come together within this time, seconds: what was foreseen along a normal may not meet at all.
const FAR: f32 = 1e3;

/// Brings a contact up to the moment when its shapes meet, as far as it is after that since which its bodies have come as they do and
/// before the end, seconds since the substep began. Gives that moment, 0 where it is not known.
pub(super) fn bring_up(
    bodies: &mut Bodies,
    bucket: &mut Bucket,
    scope: Scope<'_>,
    slot: usize,
    (since, end): (impl FnOnce([u32; 2]) -> f32, f32),
) -> f32 {
    let (block, lane) = (slot / BLOCK, slot % BLOCK);
    let (constraint, known) = (&bucket.constraints[block], &bucket.manifolds[block]);
    let both = [known.body_a[lane], known.body_b[lane]];
    let shapes = [known.shape_a[lane], known.shape_b[lane]];
    // Trees take contacts out of their lanes.
    if [constraint.body_a[lane], constraint.body_b[lane]] != both {
        return 0.0;
    }
    let is_free = both.iter().all(|&body| bodies.rows[body as usize][Slot::INV_MASS] > 0.0);
    let is_joined = is_joined(bodies, both);
    let is_disk =
        |&shape: &u32| matches!(scope.shapes.records[shape as usize].shape, Shape::Circle { .. });
    // Surfaces that go on have rules of their own.
    let goes_on = |&shape: &u32| {
        scope.shapes.guards[shape as usize] != 0 || anew::has_rules(scope.shapes, shape)
    };
    if shapes.iter().all(is_disk) && !shapes.iter().any(goes_on) {
        // What has pushed before has its place by that.
        let is_new = constraint.points[0].normal_impulse[lane] == 0.0;
        let since = if is_joined { 0.0 } else { since(both) };
        let earliest = if is_new { since } else { since.max(0.0) };
        let span = if is_joined { [0.0; 2] } else { [earliest, end] };
        return meet(bodies, bucket, scope, (slot, span));
    }
    if is_free {
        draw_together(bodies, bucket, slot, shapes.each_ref().map(is_disk));
    }
    0.0
}

/// Finds a contact anew for the moment when its shapes meet.
fn meet(
    bodies: &mut Bodies,
    bucket: &mut Bucket,
    scope: Scope<'_>,
    (slot, [before, after]): (usize, [f32; 2]),
) -> f32 {
    let (block, lane) = (slot / BLOCK, slot % BLOCK);
    let (constraint, known) = (&mut bucket.constraints[block], &mut bucket.manifolds[block]);
    let both = [known.body_a[lane], known.body_b[lane]];
    let shapes = [known.shape_a[lane], known.shape_b[lane]];
    let mut time = before.max(0.0);
    for look in 1..=LOOKS {
        let course = Course::new(bodies, both, time, FAR);
        let (frame, found) = course.collide(bodies, scope, shapes);
        let [point, ..] = found.points() else { return 0.0 };
        let closing = course.closing(frame.apply(point.point), frame.q.rotate(found.normal));
        let more = if closing > 0.0 { point.separation / closing } else { 0.0 };
        let next = (time + more).clamp(before, after);
        if look == LOOKS || (next - time).abs() <= KNOWN * after {
            course.write(bodies, (constraint, known, lane), frame, &found);
            break;
        }
        time = next;
    }
    time
}

/// Has two free bodies set out from where they meet: takes off their places what a bounce takes them in the time until then.
pub(super) fn set_out(bodies: &mut Bodies, block: &ConstraintBlock, lane: usize, due: f32) {
    let both = [block.body_a[lane], block.body_b[lane]];
    let rows = both.map(|body| bodies.rows[body as usize]);
    if rows.iter().any(|row| row[Slot::INV_MASS] <= 0.0) || is_joined(bodies, both) {
        return;
    }
    for (body, change) in both.into_iter().zip(changes(&rows, block, lane)) {
        let row = &mut bodies.rows[body as usize];
        for (slot, change) in [Slot::DX, Slot::DY, Slot::DA].into_iter().zip(change) {
            row[slot] -= change * due;
        }
    }
}

fn is_joined(bodies: &Bodies, both: [u32; 2]) -> bool {
    both.iter().any(|&body| bodies.infos[body as usize].first_joint != NULL)
}

/// Makes the arms of a contact of two free bodies meet in one point: a disk keeps its own, and the rest share the way.
fn draw_together(bodies: &mut Bodies, bucket: &mut Bucket, slot: usize, disks: [bool; 2]) {
    let (block, lane) = (slot / BLOCK, slot % BLOCK);
    let (constraint, known) = (&mut bucket.constraints[block], &bucket.manifolds[block]);
    let both = [known.body_a[lane], known.body_b[lane]];
    let rows = both.map(|body| bodies.rows[body as usize]);
    let there = constraint.points.iter().find(|point| point.normal_mass[lane] > 0.0);
    let Some(point) = there else { return };
    let [place_a, place_b] = both.map(|body| bodies.poses[body as usize].p);
    let [way_a, way_b] = rows.map(|row: Row| Vec2::new(row[Slot::DX], row[Slot::DY]));
    let between = place_b.relative_to(place_a) + way_b - way_a;
    let normal = Vec2::new(constraint.normal_x[lane], constraint.normal_y[lane]);
    let across = point.normal_arm_a[lane] - point.normal_arm_b[lane];
    let along = point.tangent_arm_b[lane] - point.tangent_arm_a[lane];
    let off = [between.dot(-normal.perp()) - across, between.dot(normal) - along];
    let share = if disks[0] == disks[1] { 0.5 } else { f32::from(u8::from(disks[1])) };
    let shares = [share, share - 1.0];
    let before = changes(&rows, constraint, lane);
    let [[mass_a, turn_a], [mass_b, turn_b]] =
        rows.map(|row| [row[Slot::INV_MASS], row[Slot::INV_INERTIA]]);
    let inverses = [mass_a + mass_b, turn_a, turn_b];
    for point in constraint.points.iter_mut().filter(|point| point.normal_mass[lane] > 0.0) {
        let normal_arms = [point.normal_arm_a[lane], point.normal_arm_b[lane]];
        let tangent_arms = [point.tangent_arm_a[lane], point.tangent_arm_b[lane]];
        let arms = [0, 1].map(|k| normal_arms[k] + shares[k] * off[0]);
        let tangents = [0, 1].map(|k| tangent_arms[k] - shares[k] * off[1]);
        let turned = |k: usize| (arms[k] - normal_arms[k]) * rows[k][Slot::DA];
        point.separation[lane] -= turned(1) - turned(0);
        [point.normal_arm_a[lane], point.normal_arm_b[lane]] = arms;
        [point.tangent_arm_a[lane], point.tangent_arm_b[lane]] = tangents;
        point.normal_mass[lane] = effective_mass::<f32>((), arms, inverses);
        point.tangent_mass[lane] = effective_mass::<f32>((), tangents, inverses);
    }
    let after = changes(&rows, constraint, lane);
    // The next substep adds what the impulses have done in this one: now that of the new arms.
    for (k, body) in both.into_iter().enumerate() {
        let start = &mut bodies.starts[body as usize];
        (0..3).for_each(|i| start[i] += before[k][i] - after[k][i]);
    }
}
