//! Two shapes, one manifold: the public entry, and the scalar form of the kernels.

use super::lane::ABSENT;
use super::{LaneManifold, LanePair, PairClass, RoundedBox, ShapeClass, general};
use crate::geometry::Shape;
use crate::math::{Transform, Vec2};

/// Where two shapes touch: a normal and up to two points, all in the frame of shape A.
///
/// [`Manifold::points()`] is the slice of those that are there; what lies beyond is zero.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Manifold {
    /// Unit, from A to B; zero where there are no points.
    pub normal: Vec2,
    /// How many of `points` are there: 0, 1 or 2.
    pub count: u8,
    /// The points, in no order of depth.
    pub points: [ManifoldPoint; 2],
}

/// One point of a [`Manifold`].
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct ManifoldPoint {
    /// Midway between the two surfaces, metres in the frame of shape A.
    pub point: Vec2,
    /// Distance of the surfaces along the normal, metres; negative is overlap.
    pub separation: f32,
    /// Names the features that face each other: the same from step to step while they do.
    pub id: u16,
}

impl Manifold {
    /// The shapes are further apart than was asked for.
    pub const EMPTY: Self = Self {
        normal: Vec2::ZERO,
        points: [ManifoldPoint { point: Vec2::ZERO, separation: 0.0, id: 0 }; 2],
        count: 0,
    };

    /// The points that are there.
    #[inline]
    pub fn points(&self) -> &[ManifoldPoint] {
        &self.points[..usize::from(self.count).min(2)]
    }

    /// The point with the least separation; the first of two equal ones.
    pub fn deepest(&self) -> Option<&ManifoldPoint> {
        match self.points() {
            [] => None,
            [first, second] if second.separation < first.separation => Some(second),
            [first, ..] => Some(first),
        }
    }

    /// Adds a point; a third one is dropped.
    pub(super) fn push(&mut self, point: ManifoldPoint) {
        if let Some(slot) = self.points.get_mut(usize::from(self.count)) {
            *slot = point;
            self.count += 1;
        }
    }

    /// The manifold of the pair the other way round: from B's frame into A's, and the normal turned.
    fn swapped(mut self, b_in_a: Transform) -> Self {
        self.normal = -b_in_a.q.rotate(self.normal);
        for point in &mut self.points[..usize::from(self.count)] {
            point.point = b_in_a.apply(point.point);
        }
        self
    }

    /// From the frame of a rounded box into that of its shape.
    fn moved(mut self, frame: Transform) -> Self {
        self.normal = frame.q.rotate(self.normal);
        for point in &mut self.points[..usize::from(self.count)] {
            point.point = frame.apply(point.point);
        }
        self
    }
}

impl From<LaneManifold<f32>> for Manifold {
    fn from(lane: LaneManifold<f32>) -> Self {
        let mut manifold = Self::EMPTY;
        for i in 0..2 {
            if lane.separation[i] < ABSENT {
                manifold.normal = Vec2::from(lane.normal);
                manifold.push(ManifoldPoint {
                    point: Vec2::from(lane.points[i]),
                    separation: lane.separation[i],
                    id: lane.id[i] as u16,
                });
            }
        }
        manifold
    }
}

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
    let (Some(box_a), Some(box_b)) = (RoundedBox::of(a), RoundedBox::of(b)) else {
        return general::collide_general(a, b, b_in_a, max_separation);
    };
    let (class_a, class_b) = (ShapeClass::of(a), ShapeClass::of(b));
    let class = PairClass::of(class_a, class_b);
    if class_a < class_b {
        let a_in_b = b_in_a.inverse();
        collide_boxes(class, &box_b, &box_a, a_in_b, max_separation).swapped(b_in_a)
    } else {
        collide_boxes(class, &box_a, &box_b, b_in_a, max_separation)
    }
}

/// The one-lane instance of the kernel of a class.
fn collide_boxes(
    class: PairClass,
    a: &RoundedBox,
    b: &RoundedBox,
    b_in_a: Transform,
    max_separation: f32,
) -> Manifold {
    let relative = b_in_a.compose(b.frame).relative_to(a.frame);
    let pair = LanePair {
        p: relative.p.into(),
        q: [relative.q.c, relative.q.s],
        a: a.extents(),
        b: b.extents(),
    };
    Manifold::from(class.collide((), &pair, max_separation)).moved(a.frame)
}
