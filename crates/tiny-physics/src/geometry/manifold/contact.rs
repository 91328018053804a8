//! Contacts in the plainest form: a normal, a depth and a point, for shapes placed in the world.
//!
//! For debugging, games without bodies, and reading a frame's contacts with `{:?}`. They come from the
//! same kernels as everything else.

use super::{Manifold, collide};
use crate::geometry::Shape;
use crate::math::{Aabb, Pose, Transform, Vec2};

/// How two shapes overlap.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Contact {
    /// Unit, from A to B, in the world.
    pub normal: Vec2,
    /// How far to move B along the normal until they only touch, metres, 0 or more.
    pub depth: f32,
    /// The middle of the overlap, metres in the world.
    pub point: Vec2,
}

impl Contact {
    /// Two circles by centre and radius. Coincident centres give the normal (0, 1).
    pub fn circle_circle(
        center_a: Vec2,
        radius_a: f32,
        center_b: Vec2,
        radius_b: f32,
    ) -> Option<Contact> {
        let (a, b) = (Shape::Circle { radius: radius_a }, Shape::Circle { radius: radius_b });
        between(&a, center_a, &b, center_b)
    }

    /// A circle (A) and a box (B). A centre inside the box leaves along the axis of least overlap.
    pub fn circle_box(center: Vec2, radius: f32, aabb: &Aabb) -> Option<Contact> {
        let b = Shape::Aabb { half_extents: aabb.half_extents() };
        between(&Shape::Circle { radius }, center, &b, aabb.center())
    }

    /// Two boxes that do not turn. The normal is the axis of least overlap; a tie takes the x axis.
    pub fn box_box(a: &Aabb, b: &Aabb) -> Option<Contact> {
        let shape_a = Shape::Aabb { half_extents: a.half_extents() };
        let shape_b = Shape::Aabb { half_extents: b.half_extents() };
        between(&shape_a, a.center(), &shape_b, b.center())
    }

    /// The deepest point of a manifold, whose points lie in `frame`; two equal depths give the point
    /// between them.
    fn of(manifold: &Manifold, frame: Transform) -> Option<Self> {
        let deepest = manifold.deepest()?;
        let point = match manifold.points() {
            [a, b] if a.separation == b.separation => (a.point + b.point) * 0.5,
            _ => deepest.point,
        };
        Some(Self {
            normal: frame.q.rotate(manifold.normal),
            // `0.0 - x`, so that touching is 0 and not -0.
            depth: 0.0 - deepest.separation,
            point: frame.apply(point),
        })
    }
}

/// Two shapes anywhere in the world; `None` where they are apart. Touching is a contact of depth 0.
///
/// ```
/// use tiny_physics::{Pose, Shape, Vec2, contact};
/// let ball = Shape::Circle { radius: 1.0 };
/// let at = |x: f32| Pose { p: Vec2::new(x, 0.0).into(), ..Pose::default() };
/// let found = contact(&ball, &at(0.0), &ball, &at(1.5)).unwrap();
/// assert_eq!((found.normal, found.depth), (Vec2::X, 0.5));
/// assert_eq!(contact(&ball, &at(0.0), &ball, &at(2.5)), None);
/// ```
pub fn contact(a: &Shape, pose_a: &Pose, b: &Shape, pose_b: &Pose) -> Option<Contact> {
    Contact::of(&collide(a, b, pose_b.relative_to(*pose_a), 0.0), pose_a.to_transform())
}

fn between(a: &Shape, center_a: Vec2, b: &Shape, center_b: Vec2) -> Option<Contact> {
    let b_in_a = Transform { p: center_b - center_a, ..Transform::IDENTITY };
    let frame = Transform { p: center_a, ..Transform::IDENTITY };
    Contact::of(&collide(a, b, b_in_a, 0.0), frame)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn circles_overlap_touch_and_part() {
        let found = Contact::circle_circle(Vec2::ZERO, 1.0, Vec2::new(1.5, 0.0), 1.0).unwrap();
        assert_eq!(found, Contact { normal: Vec2::X, depth: 0.5, point: Vec2::new(0.75, 0.0) });
        let touching = Contact::circle_circle(Vec2::ZERO, 1.0, Vec2::new(0.0, 2.0), 1.0).unwrap();
        assert_eq!((touching.normal, touching.depth), (Vec2::Y, 0.0));
        assert_eq!(Contact::circle_circle(Vec2::ZERO, 1.0, Vec2::new(2.01, 0.0), 1.0), None);
    }

    #[test]
    fn coincident_centres_have_a_fixed_normal() {
        let found = Contact::circle_circle(Vec2::splat(3.0), 1.0, Vec2::splat(3.0), 0.5).unwrap();
        assert_eq!((found.normal, found.depth), (Vec2::Y, 1.5));
        assert!(found.point.is_finite());
    }

    #[test]
    fn a_circle_meets_a_box_at_its_face_its_corner_and_inside() {
        let aabb = Aabb::new(Vec2::new(-1.0, -1.0), Vec2::new(1.0, 1.0));
        let face = Contact::circle_box(Vec2::new(0.25, 1.25), 0.5, &aabb).unwrap();
        assert_eq!((face.normal, face.depth), (-Vec2::Y, 0.25));
        let corner = Contact::circle_box(Vec2::new(1.3, 1.4), 0.75, &aabb).unwrap();
        assert!((corner.normal - Vec2::new(-0.6, -0.8)).length() < 1e-6);
        assert!((corner.depth - 0.25).abs() < 1e-6);
        let inside = Contact::circle_box(Vec2::new(-0.75, 0.5), 0.5, &aabb).unwrap();
        assert_eq!((inside.normal, inside.depth), (Vec2::X, 0.75));
        assert_eq!(Contact::circle_box(Vec2::new(1.5, 1.5), 0.7, &aabb), None);
        let center = Contact::circle_box(Vec2::ZERO, 0.5, &aabb).unwrap();
        assert_eq!((center.normal.y, center.depth), (0.0, 1.5), "a tie takes the x axis");
    }

    #[test]
    fn boxes_part_along_the_axis_of_least_overlap() {
        let a = Aabb::new(Vec2::new(0.0, 0.0), Vec2::new(2.0, 2.0));
        let right =
            Contact::box_box(&a, &Aabb::new(Vec2::new(1.75, 0.5), Vec2::new(3.75, 2.5))).unwrap();
        assert_eq!((right.normal, right.depth), (Vec2::X, 0.25));
        assert_eq!(right.point, Vec2::new(1.875, 1.25));
        let below =
            Contact::box_box(&a, &Aabb::new(Vec2::new(0.5, -1.75), Vec2::new(2.5, 0.25))).unwrap();
        assert_eq!((below.normal, below.depth), (-Vec2::Y, 0.25));
        assert_eq!(
            Contact::box_box(&a, &Aabb::new(Vec2::new(2.5, 0.0), Vec2::new(3.0, 1.0))),
            None
        );
    }

    #[test]
    fn a_tie_of_boxes_always_takes_the_x_axis() {
        let a = Aabb::new(Vec2::ZERO, Vec2::splat(2.0));
        for step in -3..=3 {
            // Rounding on either side of the tie does not flip the normal.
            let nudge = step as f32 * 1.0e-7;
            let low = Vec2::new(1.5 + nudge, 1.5 - nudge);
            let b = Aabb::new(low, low + Vec2::splat(2.0));
            assert_eq!(Contact::box_box(&a, &b).unwrap().normal, Vec2::X);
        }
        let same = Contact::box_box(&a, &a).unwrap();
        assert_eq!((same.normal, same.depth), (Vec2::X, 2.0));
    }

    #[test]
    fn contacts_print() {
        let found = Contact::circle_circle(Vec2::ZERO, 1.0, Vec2::new(1.5, 0.0), 1.0).unwrap();
        assert_eq!(
            format!("{found:?}"),
            "Contact { normal: (1.0, 0.0), depth: 0.5, point: (0.75, 0.0) }"
        );
    }
}
