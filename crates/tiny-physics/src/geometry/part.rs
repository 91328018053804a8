//! The part of a shape on one side of a line, and the width of a shape: for water, wind and blasts.

use super::{Core, Shape};
use crate::math::{Rot, Vec2, atan2};

/// Corners of the outline that stands for a rounded shape: with 16 to a half circle its area is 0.6 % short.
const ARC_POINTS: usize = 32;
/// Most points of an outline.
const MAX_POINTS: usize = ARC_POINTS + 2 * super::MAX_VERTICES;

/// An area and its centre.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct AreaPart {
    /// Square metres.
    pub area: f32,
    /// Centre of the area, metres in the shape's frame; the origin where the area is zero.
    pub center: Vec2,
}

impl Shape {
    /// The part of the shape below a line: all points p with `normal . p <= height`. `normal` is a unit vector;
    /// everything in the shape's frame, metres. Exact for circles and sharp shapes; round corners count as
    /// polygons, whose area is up to 0.6 % of the round part short.
    ///
    /// ```
    /// use tiny_physics::{Shape, Vec2};
    /// let crate_ = Shape::rect(1.0, 0.5)?;
    /// let sunk = crate_.part_below(Vec2::Y, 0.25);
    /// assert_eq!((sunk.area, sunk.center), (1.5, Vec2::new(0.0, -0.125)));
    /// # Ok::<(), tiny_physics::Error>(())
    /// ```
    pub fn part_below(&self, normal: Vec2, height: f32) -> AreaPart {
        match self {
            Self::Circle { radius } => disk_below(*radius, normal, height),
            Self::Aabb { .. } | Self::Capsule { .. } | Self::Segment { .. } | Self::Polygon(_) => {
                Outline::of(&self.core()).below(normal, height)
            }
        }
    }

    /// Width of the shape across a direction (a unit vector in the shape's frame), metres: what wind from
    /// there meets.
    pub fn width_across(&self, direction: Vec2) -> f32 {
        let (core, across) = (self.core(), direction.perp());
        let (mut least, mut most) = (f32::INFINITY, f32::NEG_INFINITY);
        for point in core.points() {
            let place = point.dot(across);
            least = if place < least { place } else { least };
            most = if place > most { place } else { most };
        }
        most - least + 2.0 * core.radius
    }
}

/// A segment of a disk: with d the distance of the line from the centre, area = r^2 (pi - acos(d / r)) +
/// d sqrt(r^2 - d^2), and its moment about the centre is -2/3 (r^2 - d^2)^(3/2) along the normal.
fn disk_below(radius: f32, normal: Vec2, d: f32) -> AreaPart {
    let full = core::f32::consts::PI * radius * radius;
    if d >= radius {
        return AreaPart { area: full, center: Vec2::ZERO };
    }
    if d <= -radius || d.is_nan() {
        return AreaPart::default();
    }
    let half_chord = (radius * radius - d * d).sqrt();
    let angle = core::f32::consts::PI - atan2(half_chord, d);
    let area = radius * radius * angle + d * half_chord;
    if area <= 0.0 {
        return AreaPart::default();
    }
    let moment = 2.0 / 3.0 * half_chord * half_chord * half_chord;
    AreaPart { area, center: normal * (-moment / area) }
}

/// A polygon, anticlockwise.
struct Outline {
    points: [Vec2; MAX_POINTS],
    count: usize,
}

impl Outline {
    fn of(core: &Core) -> Self {
        let mut outline = Self { points: [Vec2::ZERO; MAX_POINTS], count: 0 };
        if core.radius == 0.0 || core.count < 2 {
            core.points().iter().for_each(|&point| outline.push(point));
            return outline;
        }
        let pieces = ARC_POINTS / core.count;
        for i in 0..core.count {
            let before = core.normal((i + core.count - 1) % core.count);
            let after = core.normal(i);
            let turn = if core.count == 2 {
                core::f32::consts::PI
            } else {
                atan2(before.cross(after), before.dot(after))
            };
            for k in 0..=pieces {
                let turned = Rot::from_angle(turn * k as f32 / pieces as f32).rotate(before);
                outline.push(core.points[i] + turned * core.radius);
            }
        }
        outline
    }

    fn push(&mut self, point: Vec2) {
        self.points[self.count] = point;
        self.count += 1;
    }

    /// Clips the outline (Sutherland and Hodgman 1974) and adds up the triangles of what is left.
    fn below(&self, normal: Vec2, height: f32) -> AreaPart {
        let mut sum = Triangles::default();
        for i in 0..self.count {
            let (start, end) = (self.points[i], self.points[(i + 1) % self.count]);
            let (a, b) = (normal.dot(start) - height, normal.dot(end) - height);
            if a <= 0.0 {
                sum.next(start);
            }
            if (a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0) {
                sum.next(start + (end - start) * (a / (a - b)));
            }
        }
        sum.part()
    }
}

/// The fan of triangles of a polygon whose points come one by one.
#[derive(Default)]
struct Triangles {
    first: Option<Vec2>,
    last: Vec2,
    area: f32,
    moment: Vec2,
}

impl Triangles {
    fn next(&mut self, point: Vec2) {
        let Some(first) = self.first else {
            (self.first, self.last) = (Some(point), point);
            return;
        };
        let (u, v) = (self.last - first, point - first);
        let area = 0.5 * u.cross(v);
        self.area += area;
        self.moment += (u + v) * (area / 3.0);
        self.last = point;
    }

    fn part(&self) -> AreaPart {
        match self.first {
            Some(first) if self.area > 0.0 => {
                AreaPart { area: self.area, center: first + self.moment * (1.0 / self.area) }
            }
            _ => AreaPart::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{any_shape, any_vec};
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn parts_agree_with_a_grid(shape in any_shape(), way in any_vec(1.0), height in -1.5_f32..1.5) {
            let normal = way.normalized();
            if normal == Vec2::ZERO {
                return Ok(());
            }
            let (mut area, mut moment) = (0.0, Vec2::ZERO);
            // Fine enough for a box along the axes, a whole row of which may be missed on each side.
            const CELLS: i32 = 300;
            let size = 3.2 / CELLS as f32;
            for (i, k) in (0..CELLS).flat_map(|i| (0..CELLS).map(move |k| (i, k))) {
                let p = Vec2::new(i as f32 + 0.5, k as f32 + 0.5) * size - Vec2::splat(1.6);
                if normal.dot(p) <= height && !matches!(shape, Shape::Segment { .. }) && shape.contains(p) {
                    area += size * size;
                    moment += p * (size * size);
                }
            }
            let part = shape.part_below(normal, height);
            prop_assert!((part.area - area).abs() < 0.04 + 0.01 * area, "{part:?} {area}");
            if area > 0.2 {
                prop_assert!((part.center - moment * (1.0 / area)).length() < 0.06, "{part:?}");
            }
        }
    }

    #[test]
    fn whole_shapes_have_their_whole_area() {
        for shape in [
            Shape::circle(0.7).unwrap(),
            Shape::rect(0.5, 2.0).unwrap(),
            Shape::capsule(-Vec2::X, Vec2::X, 0.5).unwrap(),
        ] {
            let area = shape.part_below(Vec2::Y, 10.0).area;
            assert!((area / shape.area() - 1.0).abs() < 0.003, "{area} {}", shape.area());
            assert_eq!(shape.part_below(Vec2::Y, -10.0).area, 0.0);
        }
        let half = Shape::circle(2.0).unwrap().part_below(-Vec2::X, 0.0);
        assert!((half.area - 2.0 * core::f32::consts::PI).abs() < 1e-5);
        assert!((half.center.x - 4.0 * 2.0 / (3.0 * core::f32::consts::PI)).abs() < 1e-5);
    }

    #[test]
    fn widths() {
        let capsule = Shape::capsule(-Vec2::X, Vec2::X, 0.25).unwrap();
        assert_eq!(capsule.width_across(Vec2::X), 0.5);
        assert_eq!(capsule.width_across(Vec2::Y), 2.5);
    }
}
