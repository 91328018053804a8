//! Contacts against one chosen face, and what a neighbour covers: for surfaces made of several shapes.

use super::{Manifold, ManifoldPoint};
use crate::geometry::{Core, least_by, segment_fraction};
use crate::math::Vec2;
use core::ops::Range;

/// Ids of these points begin here, above those of every other kernel.
const FIRST_ID: u16 = 4096;

/// What is narrower than this part of both sides is one point.
const NARROW: f32 = 1.0e-5;

/// Signed distance of a point from the surface of a core, metres; beyond a corner of a polygon it is
/// less than the true distance.
pub(crate) fn point_gap(core: &Core, point: Vec2) -> f32 {
    if core.count <= 2 {
        let (a, b) = (core.points[0], core.points[core.count - 1]);
        let nearest = a + (b - a) * segment_fraction(a, b, point);
        return (point - nearest).length() - core.radius;
    }
    let mut gap = f32::NEG_INFINITY;
    for i in 0..core.count {
        let height = core.normal(i).dot(point - core.points[i]);
        gap = if height > gap { height } else { gap };
    }
    gap - core.radius
}

/// Height of the farthest point of a core along a unit direction, metres.
pub(crate) fn support_height(core: &Core, direction: Vec2) -> f32 {
    core.points[core.support(direction)].dot(direction) + core.radius
}

/// Index of the face with this normal, if there is one.
pub(crate) fn face_of(core: &Core, normal: Vec2) -> Option<usize> {
    (0..core.edge_count()).find(|&i| core.normal(i).dot(normal) > 1.0 - 1.0e-6)
}

/// Index of the core point closest to `point`; the first of equals.
pub(crate) fn nearest_vertex(core: &Core, point: Vec2) -> usize {
    least_by(core.count, |i| (core.points[i] - point).length_sq()).0
}

/// Where `other` touches one face of `core`, both in the frame of `core`; the normal is the face's. Empty
/// where the side of `other` that looks at the face lies beside it or too high above. The face counts as so much longer `beyond`
/// its start and its end.
pub(crate) fn collide_face(
    core: &Core,
    face: usize,
    beyond: [f32; 2],
    other: &Core,
    max_separation: f32,
) -> Manifold {
    let ((start, end), normal) = (core.edge(face), core.normal(face));
    let along = normal.perp();
    let length = along.dot(end - start);
    let (edge, (low, high)) = facing_edge(other, normal);
    let place = |p: Vec2| {
        let height = normal.dot(p - start) - core.radius - other.radius;
        (along.dot(p - start), height)
    };
    let ends = [place(low), place(high)];
    let mut manifold = Manifold { normal, ..Manifold::EMPTY };
    let narrow = NARROW * (length + (ends[0].0 - ends[1].0).abs());
    let Some(ends) = clip(ends, -beyond[0]..length + beyond[1]) else { return Manifold::EMPTY };
    let single = (ends[0].0 - ends[1].0).abs() <= narrow;
    let first = usize::from(single && ends[1].1 < ends[0].1);
    let count = if single { 1 } else { 2 };
    for (i, &(across, height)) in ends[first..].iter().take(count).enumerate() {
        if height <= max_separation {
            let point = start + along * across + normal * (core.radius + 0.5 * height);
            let id = FIRST_ID + (face * 32 + edge * 2 + i) as u16;
            manifold.push(ManifoldPoint { point, separation: height, id });
        }
    }
    if manifold.count == 0 { Manifold::EMPTY } else { manifold }
}

/// The edge most opposed to a direction, by its index; a single point is an edge without length.
fn facing_edge(core: &Core, direction: Vec2) -> (usize, (Vec2, Vec2)) {
    if core.count < 2 {
        return (0, (core.points[0], core.points[0]));
    }
    let (facing, _) = least_by(core.edge_count(), |i| core.normal(i).dot(direction));
    (facing, core.edge(facing))
}

/// The part of a line between (across, height) points that lies over a range.
fn clip(ends: [(f32, f32); 2], over: Range<f32>) -> Option<[(f32, f32); 2]> {
    let [(u, h), (v, k)] = ends;
    let (low, high) = if u < v { (u, v) } else { (v, u) };
    if high < over.start || low > over.end {
        return None;
    }
    let at = |across: f32, own: f32| {
        let limited = if across < over.start {
            over.start
        } else if across > over.end {
            over.end
        } else {
            return (across, own);
        };
        (limited, h + (k - h) * ((limited - u) / (v - u)))
    };
    Some([at(u, h), at(v, k)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Shape;
    use crate::math::{Rot, Transform};

    fn at(shape: Shape, x: f32, y: f32) -> Core {
        shape.core().transformed(Transform::new(Vec2::new(x, y), Rot::IDENTITY))
    }

    #[test]
    fn a_box_on_a_face_is_cut_off_at_its_end() {
        let tile = Shape::rect(0.5, 0.5).unwrap().core();
        let crate_ = at(Shape::rect(0.5, 0.5).unwrap(), 0.25, 0.99);
        let top = face_of(&tile, Vec2::Y).unwrap();
        let manifold = collide_face(&tile, top, [0.0; 2], &crate_, 0.02);
        assert_eq!((manifold.count, manifold.normal), (2, Vec2::Y));
        let mut across = [manifold.points[0].point.x, manifold.points[1].point.x];
        across.sort_by(f32::total_cmp);
        assert_eq!(across, [-0.25, 0.5]);
        assert!(manifold.points().iter().all(|p| (p.separation + 0.01).abs() < 1e-6));
        let beside = at(Shape::circle(0.2).unwrap(), 0.51, 0.7);
        assert_eq!(collide_face(&tile, top, [0.0; 2], &beside, 0.02), Manifold::EMPTY);
        // Unless the face goes on there; the point is then beyond its end, too.
        let longer = collide_face(&tile, top, [0.02; 2], &beside, 0.02);
        assert_eq!((longer.count, longer.points[0].point.x), (1, 0.51));
        let above = at(Shape::circle(0.2).unwrap(), 0.49, 0.71);
        assert_eq!(collide_face(&tile, top, [0.0; 2], &above, 0.02).count, 1);
    }

    #[test]
    fn gaps_are_signed() {
        let tile = Shape::rect(0.5, 0.5).unwrap().core();
        assert_eq!(point_gap(&tile, Vec2::new(0.75, 0.0)), 0.25);
        assert_eq!(point_gap(&tile, Vec2::new(0.25, 0.0)), -0.25);
        let line = Shape::segment(Vec2::ZERO, Vec2::X).unwrap().core();
        assert_eq!(point_gap(&line, Vec2::new(2.0, 0.0)), 1.0);
        assert_eq!(support_height(&tile, Vec2::X), 0.5);
        assert_eq!(nearest_vertex(&tile, Vec2::new(1.0, 1.0)), 2);
    }
}
