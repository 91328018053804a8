//! Two shapes, one manifold: the public entry, and the scalar form of the kernels.

use super::{
    LanePair, Manifold, Outline, PairClass, RoundedBox, ShapeClass, box_box, box_circle,
    capsule_circle, circle_circle, general,
};
use crate::geometry::Shape;
use crate::math::Transform;

/// Collides two shapes: points no further apart than `max_separation` metres, which is 0 or more.
///
/// `b_in_a` is the frame of `b` as seen from that of `a`; the result is in the frame of `a`. The
/// shapes are taken to be valid; input that is not finite gives no points.
///
/// ```
/// use tiny_physics::{Shape, Transform, Vec2, collide};
/// let (ball, floor) = (
///     Shape::Circle { radius: 0.5 },
///     Shape::Aabb { half_extents: Vec2::new(10.0, 1.0) },
/// );
/// let ball_in_floor = Transform { p: Vec2::new(3.0, 1.25), ..Transform::IDENTITY };
/// let manifold = collide(&floor, &ball, ball_in_floor, 0.0);
/// assert_eq!(manifold.normal, Vec2::Y);
/// assert_eq!(manifold.points()[0].separation, -0.25);
/// ```
pub fn collide(a: &Shape, b: &Shape, b_in_a: Transform, max_separation: f32) -> Manifold {
    let (class_a, class_b) = (ShapeClass::of(a), ShapeClass::of(b));
    let class = PairClass::of(class_a, class_b);
    if class_a < class_b {
        collide_as(class, [b, a], b_in_a.inverse(), max_separation).swapped(b_in_a)
    } else {
        collide_as(class, [a, b], b_in_a, max_separation)
    }
}

/// The one-lane instance of the kernel of a class, which has to take the two shapes.
pub(super) fn collide_as(
    class: PairClass,
    shapes: [&Shape; 2],
    b_in_a: Transform,
    max_separation: f32,
) -> Manifold {
    let [a, b] = shapes.map(RoundedBox::of);
    let relative = b_in_a.compose(b.frame).relative_to(a.frame);
    let pair = LanePair {
        p: relative.p.into(),
        q: [relative.q.c, relative.q.s],
        a: a.extents(),
        b: b.extents(),
    };
    let manifold = match class {
        PairClass::BoxBox => box_box((), &pair, max_separation),
        PairClass::BoxCircle => box_circle((), &pair, max_separation),
        PairClass::CapsuleCircle => capsule_circle((), &pair, max_separation),
        PairClass::CircleCircle => circle_circle((), &pair, max_separation),
        PairClass::General => {
            let outline = |shape, RoundedBox { frame, half_extents, .. }| {
                [Outline::of(shape, ShapeClass::of(shape), frame.p, half_extents)]
            };
            general((), &pair, [&outline(shapes[0], a), &outline(shapes[1], b)], max_separation)
        }
    };
    Manifold::from(manifold).moved(a.frame)
}
