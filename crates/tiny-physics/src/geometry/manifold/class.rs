//! Which kernel a pair belongs to, and shapes as rounded boxes.

use crate::geometry::{Polygon, Shape, turned_box};
use crate::math::{Rot, Transform, Vec2};

/// A shape as the kernels see it, in rising order of rank: a pair is stored with the higher rank as A.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Hash)]
#[repr(u8)]
pub(crate) enum ShapeClass {
    /// A point and a radius.
    Circle,
    /// A segment and a radius, which may be 0.
    Capsule,
    /// A box, rounded or not, anywhere in its body's frame.
    Box,
    /// Any other convex polygon.
    General,
}

impl ShapeClass {
    /// The class of a shape.
    pub fn of(shape: &Shape) -> Self {
        match shape {
            Shape::Circle { .. } => Self::Circle,
            Shape::Capsule { .. } | Shape::Segment { .. } => Self::Capsule,
            Shape::Aabb { .. } => Self::Box,
            Shape::Polygon(polygon) if polygon.as_rect().is_some() => Self::Box,
            Shape::Polygon(_) => Self::General,
        }
    }
}

/// The kernel of a pair: pairs of one class are collided together, in lanes.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Hash)]
#[repr(u8)]
pub(crate) enum PairClass {
    /// Boxes and capsules: the core of a capsule is a box without height.
    BoxBox,
    /// Box as A, circle as B.
    BoxCircle,
    /// Capsule as A, circle as B.
    CapsuleCircle,
    /// Circle and circle.
    CircleCircle,
    /// At least one general polygon.
    General,
}

impl PairClass {
    /// Number of classes.
    pub const COUNT: usize = Self::ALL.len();
    /// Every class, in the order of their numbers.
    pub const ALL: [Self; 5] =
        [Self::BoxBox, Self::BoxCircle, Self::CapsuleCircle, Self::CircleCircle, Self::General];

    /// Greatest number of contact points of a pair: 1 where a circle takes part.
    pub const fn max_points(self) -> usize {
        match self {
            Self::BoxCircle | Self::CapsuleCircle | Self::CircleCircle => 1,
            Self::BoxBox | Self::General => 2,
        }
    }

    /// The class of two shapes, in either order. The one with the higher [`ShapeClass`] is A.
    pub fn of(a: ShapeClass, b: ShapeClass) -> Self {
        let (high, low) = if a < b { (b, a) } else { (a, b) };
        match (high, low) {
            (ShapeClass::General, _) => Self::General,
            (ShapeClass::Box, ShapeClass::Circle) => Self::BoxCircle,
            (ShapeClass::Capsule, ShapeClass::Circle) => Self::CapsuleCircle,
            (ShapeClass::Box | ShapeClass::Capsule, _) => Self::BoxBox,
            (ShapeClass::Circle, _) => Self::CircleCircle,
        }
    }
}

/// All points within `radius` of a box, which may have no width or no height or neither.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(crate) struct RoundedBox {
    /// The box's own frame, its centre at the origin, in the shape's frame.
    pub frame: Transform,
    /// Half width and half height, metres, 0 or more.
    pub half_extents: Vec2,
    /// Metres, 0 or more.
    pub radius: f32,
}

impl RoundedBox {
    /// The shape as a rounded box; that around a [`ShapeClass::General`], which it does not turn against.
    pub fn of(shape: &Shape) -> Self {
        match *shape {
            Shape::Circle { radius } => Self { radius, ..Self::default() },
            Shape::Aabb { half_extents } => Self { half_extents, ..Self::default() },
            Shape::Capsule { a, b, radius } => Self::capsule(a, b, radius),
            Shape::Segment { a, b } => Self::capsule(a, b, 0.0),
            Shape::Polygon(ref polygon) => Self::polygon(polygon),
        }
    }

    /// The x axis from `a` to `b`; a capsule without length keeps the frame unturned.
    fn capsule(a: Vec2, b: Vec2, radius: f32) -> Self {
        let (direction, length) = (b - a).direction_and_length();
        let turned = direction != Vec2::ZERO;
        let q = if turned { Rot { c: direction.x, s: direction.y } } else { Rot::IDENTITY };
        let half = if turned { 0.5 * length } else { 0.0 };
        Self { frame: Transform::new((a + b) * 0.5, q), half_extents: Vec2::new(half, 0.0), radius }
    }

    fn polygon(polygon: &Polygon) -> Self {
        let (half_extents, frame) = polygon.as_rect().unwrap_or_else(|| {
            let bounds = turned_box(polygon.vertices(), Rot::IDENTITY);
            (bounds.half_extents(), Transform::new(bounds.center(), Rot::IDENTITY))
        });
        Self { frame, half_extents, radius: polygon.radius() }
    }

    /// Half extents and radius as the kernels take them.
    #[inline]
    pub fn extents(&self) -> [f32; 3] {
        [self.half_extents.x, self.half_extents.y, self.radius]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_rectangle_is_a_box_in_its_frame() {
        let center = Vec2::new(0.3, -0.7);
        for k in 0..12 {
            let q = Rot::from_angle(k as f32 * 0.5);
            let polygon = Polygon::turned_rect(2.0, 0.5, center, q).unwrap();
            let rounded = RoundedBox::of(&polygon.into());
            assert!((rounded.frame.p - center).length() < 1e-6);
            assert!(rounded.frame.q.angle_from(q).abs() < 1e-6);
            assert!((rounded.half_extents - Vec2::new(2.0, 0.5)).length() < 1e-6);
        }
    }

    #[test]
    fn a_capsule_without_length_is_a_circle() {
        let point = Vec2::new(1.0, 2.0);
        let rounded = RoundedBox::of(&Shape::Capsule { a: point, b: point, radius: 0.5 });
        assert_eq!(rounded.frame, Transform::new(point, Rot::IDENTITY));
        assert_eq!(rounded.half_extents, Vec2::ZERO);
    }

    #[test]
    fn the_class_of_a_pair_does_not_depend_on_order() {
        use ShapeClass::{Box, Capsule, Circle, General};
        let mut seen = Vec::new();
        for a in [Circle, Capsule, Box, General] {
            for b in [Circle, Capsule, Box, General] {
                assert_eq!(PairClass::of(a, b), PairClass::of(b, a));
                if !seen.contains(&PairClass::of(a, b)) {
                    seen.push(PairClass::of(a, b));
                }
            }
        }
        assert_eq!(seen.len(), PairClass::COUNT);
    }
}
