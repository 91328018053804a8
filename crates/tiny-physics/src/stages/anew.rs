//! A contact found anew within a step, for where its bodies will be some time later.

use super::effective_mass::{changes, draw_near, inverses_along, lever, straight};
use crate::dynamics::{Bodies, ConstraintBlock, ManifoldBlock, Shapes, Slot};
use crate::geometry::manifold::{self, Manifold};
use crate::math::{Transform, Vec2};
use crate::simd::Row;

/// What finding contacts needs beyond the stores.
#[derive(Clone, Copy)]
pub(crate) struct Scope<'a> {
    pub(crate) shapes: &'a Shapes,
    /// Points up to this far apart are contacts already, metres.
    pub(crate) reach: f32,
}

/// Is a shape one-way, or a link of a chain?
pub(super) fn has_rules(shapes: &Shapes, shape: u32) -> bool {
    let record = &shapes.records[shape as usize];
    record.one_way.is_some() || record.link.is_some()
}

/// The two bodies of a contact: how they have moved since the start of the step, up to some time from now.
pub(super) struct Course {
    bodies: [u32; 2],
    rows: [Row; 2],
    /// From the centre of mass of A to that of B, and how that has changed.
    between: Vec2,
    motion: Vec2,
    turns: [f32; 2],
    /// How far points may come nearer in a substep.
    way: f32,
}

impl Course {
    /// Up to a `time` from now, in a substep of `h` seconds.
    pub(super) fn new(bodies: &Bodies, both: [u32; 2], time: f32, h: f32) -> Self {
        let rows = both.map(|body| bodies.rows[body as usize]);
        let [velocity_a, velocity_b] = rows.map(|row| Vec2::new(row[Slot::VX], row[Slot::VY]));
        let [moved_a, moved_b] = rows.map(|row| Vec2::new(row[Slot::DX], row[Slot::DY]));
        let velocity = velocity_b - velocity_a;
        let motion = moved_b - moved_a + velocity * time;
        let [a, b] = both.map(|body| bodies.poses[body as usize].p);
        let rim = |k: usize| rows[k][Slot::W].abs() * bodies.infos[both[k] as usize].max_extent;
        Self {
            bodies: both,
            rows,
            between: b.relative_to(a) + motion,
            motion,
            turns: rows.map(|row| row[Slot::DA] + row[Slot::W] * time),
            way: (velocity.length() + rim(0) + rim(1)) * h,
        }
    }

    /// The frame of shape A, seen from its body's centre of mass, and the manifold in it.
    pub(super) fn collide(
        &self,
        bodies: &Bodies,
        scope: Scope<'_>,
        shapes: [u32; 2],
    ) -> (Transform, Manifold) {
        let [a, b] = shapes.map(|shape| &scope.shapes.records[shape as usize]);
        let [turned_a, turned_b] =
            [0, 1].map(|k| bodies.poses[self.bodies[k] as usize].q.integrate(self.turns[k]));
        let frame_a = Transform::new(Vec2::ZERO, turned_a).compose(a.central);
        let frame_b = Transform::new(self.between, turned_b).compose(b.central);
        let reach = if self.way > scope.reach { self.way } else { scope.reach };
        let b_in_a = frame_b.relative_to(frame_a);
        let mut found = manifold::collide(&a.shape, &b.shape, b_in_a, reach);
        draw_near(&mut found, bodies, self.bodies, scope.reach);
        (frame_a, found)
    }

    /// Puts a manifold in the place of what the lane has; impulses go to the points of the same name.
    pub(super) fn write(
        &self,
        bodies: &mut Bodies,
        (constraint, known, lane): (&mut ConstraintBlock, &mut ManifoldBlock, usize),
        frame: Transform,
        found: &Manifold,
    ) {
        let before = changes(&self.rows, constraint, lane);
        let normal = frame.q.rotate(found.normal);
        let linear = self.rows.map(|row| inverses_along(&row, normal)[0]);
        let [x, y] = straight::<f32>((), [normal.x, normal.y], linear[0] + linear[1]);
        let normal = Vec2::new(x, y);
        (constraint.normal_x[lane], constraint.normal_y[lane]) = (normal.x, normal.y);
        let name = |k: usize| found.points().get(k).map_or(-1.0, |point| f32::from(point.id));
        let (old, new) = ([known.id_1[lane], known.id_2[lane]], [name(0), name(1)]);
        (known.id_1[lane], known.id_2[lane]) = (new[0], new[1]);
        let impulses = constraint.points.each_ref().map(|point| {
            [point.normal_impulse[lane], point.tangent_impulse[lane], point.load[lane]]
        });
        let impulses = carry(old, new, impulses);
        for (k, (point, impulses)) in constraint.points.iter_mut().zip(impulses).enumerate() {
            [point.normal_impulse[lane], point.tangent_impulse[lane], point.load[lane]] = impulses;
            let Some(place) = found.points().get(k) else {
                (point.normal_mass[lane], point.tangent_mass[lane]) = (0.0, 0.0);
                continue;
            };
            let arm = frame.apply(place.point);
            let arms = |axis: Vec2| [arm.cross(axis), (arm - self.between).cross(axis)];
            let (along, across) = (arms(normal), arms(-normal.perp()));
            let turned = along[1] * self.turns[1] - along[0] * self.turns[0];
            point.separation[lane] = place.separation - normal.dot(self.motion) - turned;
            [point.normal_arm_a[lane], point.normal_arm_b[lane]] = along;
            [point.tangent_arm_a[lane], point.tangent_arm_b[lane]] = across;
            point.normal_mass[lane] = self.mass(normal, [along, across]);
            point.tangent_mass[lane] = self.mass(normal.perp(), [across, along]);
        }
        let after = changes(&self.rows, constraint, lane);
        // The next substep adds what the impulses have done in this one: now that of the new arms.
        for (k, body) in self.bodies.into_iter().enumerate() {
            let start = &mut bodies.starts[body as usize];
            (0..3).for_each(|i| start[i] += before[k][i] - after[k][i]);
        }
    }

    /// How fast a point comes together, its arm from the centre of mass of A, along the normal.
    pub(super) fn closing(&self, arm: Vec2, normal: Vec2) -> f32 {
        let [a, b] = self.rows;
        let way = Vec2::new(a[Slot::VX] - b[Slot::VX], a[Slot::VY] - b[Slot::VY]);
        normal.dot(way) + arm.cross(normal) * a[Slot::W]
            - (arm - self.between).cross(normal) * b[Slot::W]
    }

    /// Effective mass along an axis, with the arms along it and across.
    fn mass(&self, axis: Vec2, [arms, across]: [[f32; 2]; 2]) -> f32 {
        let inverses = self.rows.map(|row| inverses_along(&row, axis));
        let all = inverses[0][0] + inverses[1][0];
        let [a, b] = [0, 1].map(|k| {
            let ([linear, turn], arm) = (inverses[k], lever::<f32>((), arms[k], across[k], all));
            linear + turn * arm * arm
        });
        if a + b > 0.0 { 1.0 / (a + b) } else { 0.0 }
    }
}

/// What old points carry, for the new ones: that of the same name, or a point that has none, or the first.
fn carry(old: [f32; 2], new: [f32; 2], values: [[f32; 3]; 2]) -> [[f32; 3]; 2] {
    let mut carried = [[0.0; 3]; 2];
    for (name, values) in old.into_iter().zip(values) {
        let same = new.iter().position(|&other| other == name && name >= 0.0);
        let fresh = || new.iter().position(|other| *other >= 0.0 && !old.contains(other));
        let to = &mut carried[same.or_else(fresh).unwrap_or(0)];
        to.iter_mut().zip(values).for_each(|(to, value)| *to += value);
    }
    carried
}
