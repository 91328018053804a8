//! What bounces does so where it is by then.
//!
//! The arms of a contact are those of the start of the step or of its time of impact. When it bounces, its bodies have gone on by
//! some `e` against each other, so the impulse `P` and its opposite would act at two points and make a torque `P x e` out of
//! nothing. So the arms are made to meet in one point: between two disks the normal turns along with the line between them, which
//! gives no spin; a disk keeps its arm at anything else, and the rest share the way.

use crate::dynamics::{Bodies, Bucket, Shapes, Slot};
use crate::geometry::Shape;
use crate::math::Vec2;
use crate::simd::{BLOCK, Row};
use crate::stages::effective_mass::{changes, effective_mass};

/// Brings a contact of two bodies that move freely up to where they are now.
pub(super) fn bring_up(bodies: &mut Bodies, bucket: &mut Bucket, shapes: &Shapes, slot: usize) {
    let (block, lane) = (slot / BLOCK, slot % BLOCK);
    let (constraint, known) = (&mut bucket.constraints[block], &bucket.manifolds[block]);
    let both = [known.body_a[lane], known.body_b[lane]];
    let rows = both.map(|body| bodies.rows[body as usize]);
    let there = constraint.points.iter().find(|point| point.normal_mass[lane] > 0.0);
    // Trees take contacts out of their lanes.
    let is_own = [constraint.body_a[lane], constraint.body_b[lane]] == both;
    let (Some(point), true) = (there, is_own && rows.iter().all(|row| row[Slot::INV_MASS] > 0.0))
    else {
        return;
    };
    let [place_a, place_b] = both.map(|body| bodies.poses[body as usize].p);
    let [way_a, way_b] = rows.map(|row: Row| Vec2::new(row[Slot::DX], row[Slot::DY]));
    let way = way_b - way_a;
    let between = place_b.relative_to(place_a) + way;
    let old = Vec2::new(constraint.normal_x[lane], constraint.normal_y[lane]);
    let across = point.normal_arm_a[lane] - point.normal_arm_b[lane];
    let along = point.tangent_arm_b[lane] - point.tangent_arm_a[lane];
    let disks = [known.shape_a[lane], known.shape_b[lane]]
        .map(|shape| matches!(shapes.records[shape as usize].shape, Shape::Circle { .. }));
    let off = between.dot(-old.perp()) - across;
    let apart = between.dot(old);
    let turns = disks == [true; 2] && off.abs() < apart;
    let ahead = if turns { old - old.perp() * (off / apart) } else { old };
    let normal = ahead * (1.0 / ahead.length());
    let off = [if turns { 0.0 } else { off }, between.dot(normal) - along];
    let share = if disks[0] == disks[1] { 0.5 } else { f32::from(u8::from(disks[1])) };
    let shares = [share, share - 1.0];
    let before = changes(&rows, constraint, lane);
    (constraint.normal_x[lane], constraint.normal_y[lane]) = (normal.x, normal.y);
    let [[mass_a, turn_a], [mass_b, turn_b]] =
        rows.map(|row| [row[Slot::INV_MASS], row[Slot::INV_INERTIA]]);
    let inverses = [mass_a + mass_b, turn_a, turn_b];
    for point in constraint.points.iter_mut().filter(|point| point.normal_mass[lane] > 0.0) {
        let normal_arms = [point.normal_arm_a[lane], point.normal_arm_b[lane]];
        let tangent_arms = [point.tangent_arm_a[lane], point.tangent_arm_b[lane]];
        let arms = [0, 1].map(|k| normal_arms[k] + shares[k] * off[0]);
        let tangents = [0, 1].map(|k| tangent_arms[k] - shares[k] * off[1]);
        let turned = |k: usize| (arms[k] - normal_arms[k]) * rows[k][Slot::DA];
        point.separation[lane] += (old - normal).dot(way) - (turned(1) - turned(0));
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
