//! Boxes that follow their shapes: tight ones at once, fat ones where they were left.

use crate::broad_phase::BroadPhase;
use crate::dynamics::{Bodies, Shapes, guard};
use crate::geometry::{Polygon, Shape, turned_box};
use crate::math::{Aabb, Pose, Vec2};
use crate::simd::Row;
use crate::threads::SharedSlice;

/// Shapes that left their fat boxes, and the new ones.
pub(crate) type Moved = Vec<(u32, Aabb)>;

/// The boxes of all shapes, for members of a team that each have bodies of their own.
#[derive(Clone, Copy)]
pub(crate) struct Boxes<'a> {
    shapes: &'a Shapes,
    tight: SharedSlice<'a, Aabb>,
    broad_phase: &'a BroadPhase,
}

/// Shares the boxes out for as long as `work` lasts.
pub(crate) fn share<R>(
    shapes: &mut Shapes,
    broad_phase: &BroadPhase,
    work: impl FnOnce(Boxes<'_>) -> R,
) -> R {
    // Out of the shapes, which are read meanwhile.
    let mut tight = core::mem::take(&mut shapes.tight);
    let result = work(Boxes { shapes, tight: SharedSlice::new(&mut tight), broad_phase });
    shapes.tight = tight;
    result
}

impl Boxes<'_> {
    /// Brings the tight boxes of a body's shapes to its pose, and notes which of them have left their fat boxes.
    /// `motion` is that of the last step, metres: the best guess of the next.
    #[inline]
    pub(crate) fn follow(self, first_shape: u32, pose: Pose, motion: Vec2, moved: &mut Moved) {
        let Self { shapes, tight: tight_boxes, .. } = self;
        for shape in shapes.of_body(first_shape) {
            let tight = shape_box(shapes, shape, pose);
            tight_boxes.write(shape, tight);
            self.hold(shape, &tight, motion, moved);
        }
    }

    /// Notes a larger fat box where a shape's own does not hold a box.
    #[inline]
    fn hold(self, shape: u32, aabb: &Aabb, motion: Vec2, moved: &mut Moved) {
        if !self.shapes.fat[shape as usize].contains(aabb) {
            let fat = self.broad_phase.needed_fat_aabb(self.shapes.proxy(shape), *aabb, motion);
            moved.extend(fat.map(|fat| (shape, fat)));
        }
    }

    /// As [`Boxes::follow`] for a body that is fast: the fat boxes hold all that `next` would take it through.
    pub(crate) fn lead(self, first_shape: u32, next: &Way, ahead: Vec2, moved: &mut Moved) {
        let Self { shapes, tight: tight_boxes, .. } = self;
        for shape in shapes.of_body(first_shape) {
            let tight = shape_box(shapes, shape, next.start);
            tight_boxes.write(shape, tight);
            self.hold(shape, &next.turned(shapes, shape, tight).swept(next.motion), ahead, moved);
        }
    }

    /// Lets the fat boxes of a body's shapes hold all that a step to come takes them through, and the tight ones all
    /// that they turn through at its start. Notes how far each shape goes. `anew`: the tight ones have been grown before.
    pub(crate) fn reach(
        self,
        (first_shape, anew): (u32, bool),
        way: &Way,
        moved: &mut Moved,
        ways: &mut Vec<(u32, Vec2)>,
    ) {
        let Self { shapes, tight: tight_boxes, .. } = self;
        for shape in shapes.of_body(first_shape) {
            let still =
                if anew { shape_box(shapes, shape, way.start) } else { tight_boxes.read(shape) };
            let tight = way.turned(shapes, shape, still);
            tight_boxes.write(shape, tight);
            ways.push((shape, way.motion));
            self.hold(shape, &tight.swept(way.motion), Vec2::ZERO, moved);
        }
    }
}

/// How a body goes through a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Way {
    pub(crate) start: Pose,
    /// Metres and radians over the step.
    pub(crate) motion: Vec2,
    pub(crate) turn: f32,
}

impl Way {
    /// A box around a shape, grown by what turning takes it through.
    fn turned(&self, shapes: &Shapes, shape: u32, tight: Aabb) -> Aabb {
        // No chord is longer than two radii.
        tight.grown(self.turn.abs().min(2.0) * shapes.arm(shape))
    }

    /// A box around all that a shape goes through.
    pub(crate) fn swept_box(&self, shapes: &Shapes, shape: u32) -> Aabb {
        self.turned(shapes, shape, shape_box(shapes, shape, self.start)).swept(self.motion)
    }
}

/// Gives shapes the fat boxes that they need.
pub(crate) fn take_over(shapes: &mut Shapes, broad_phase: &mut BroadPhase, moved: &[(u32, Aabb)]) {
    for &(shape, fat) in moved {
        broad_phase.set_fat_aabb(shapes.proxy(shape), fat);
        shapes.fat[shape as usize] = fat;
    }
}

/// Brings all boxes of a body to its pose; see [`Boxes::follow`].
pub(crate) fn update(
    bodies: &Bodies,
    shapes: &mut Shapes,
    broad_phase: &mut BroadPhase,
    index: u32,
) {
    let (first_shape, pose) =
        (bodies.infos[index as usize].first_shape, bodies.poses[index as usize]);
    let mut moved = Moved::new();
    share(shapes, broad_phase, |boxes| boxes.follow(first_shape, pose, Vec2::ZERO, &mut moved));
    take_over(shapes, broad_phase, &moved);
}

/// The box of a shape on a body whose centre of mass has this pose.
pub(crate) fn shape_box(shapes: &Shapes, shape: u32, pose: Pose) -> Aabb {
    let row = &shapes.rows[shape as usize];
    if guard::exact(row[7]) != 1.0 {
        let record = &shapes.records[shape as usize];
        if let Shape::Polygon(polygon) = &record.shape {
            return polygon_box(polygon, pose.compose(record.central));
        }
    }
    rounded_box(row, pose)
}

/// The box of a polygon.
fn polygon_box(polygon: &Polygon, pose: Pose) -> Aabb {
    let turned = turned_box(polygon.vertices(), pose.q).grown(polygon.radius());
    let near = pose.p.to_vec2();
    let slack = (near.abs() + turned.min.abs().max(turned.max.abs())) * ROUNDING;
    Aabb::new(near + turned.min - slack, near + turned.max + slack)
}

/// Rounding 64 bits to 32 and adding takes at most three halves of a last place; this is four.
const ROUNDING: f32 = 2.0 * f32::EPSILON;

/// The box of a rounded box.
#[inline]
fn rounded_box(row: &Row, pose: Pose) -> Aabb {
    let center = pose.apply(Vec2::new(row[0], row[1]));
    let (c, s) = (pose.q.c * row[2] - pose.q.s * row[3], pose.q.s * row[2] + pose.q.c * row[3]);
    let (c, s) = (c.abs(), s.abs());
    let extent = Vec2::new(c * row[4] + s * row[5] + row[6], s * row[4] + c * row[5] + row[6]);
    let near = center.to_vec2();
    let slack = (near.abs() + extent) * ROUNDING;
    Aabb::new(near - extent - slack, near + extent + slack)
}
