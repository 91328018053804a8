//! Outlines of rounded convex polygons as paths in pixels.

use tiny_physics::Vec2;
use tiny_skia::{Path, PathBuilder};

/// The outline of the convex polygon `points` (in order, pixels), pushed out by `radius` pixels. Two
/// points give a capsule. `None` where there is nothing to draw. All go round in the same sense, that of circles.
pub fn rounded(points: &[Vec2], radius: f32) -> Option<Path> {
    let mut path = PathBuilder::new();
    let turned: Vec<Vec2>;
    let points = if turn_of(points) < 0.0 {
        turned = points.iter().rev().copied().collect();
        &turned
    } else {
        points
    };
    if points.len() < 2 || radius <= 0.0 {
        for (i, p) in points.iter().enumerate() {
            if i == 0 { path.move_to(p.x, p.y) } else { path.line_to(p.x, p.y) }
        }
    } else {
        let side = turn_of(points);
        let mut before = edge_normal(points, points.len() - 1, side);
        for (i, corner) in points.iter().enumerate() {
            let after = edge_normal(points, i, side);
            let start = *corner + before * radius;
            if i == 0 {
                path.move_to(start.x, start.y)
            } else {
                path.line_to(start.x, start.y)
            }
            arc(&mut path, *corner, radius, before, after);
            before = after;
        }
    }
    path.close();
    path.finish()
}

/// The half of a disk that lies on the right of `way` (on a screen, y down), which is as long as the radius.
pub fn half_disk(center: Vec2, way: Vec2) -> Option<Path> {
    let (from, radius) = (way.normalized(), way.length());
    let mut path = PathBuilder::new();
    path.move_to(center.x + way.x, center.y + way.y);
    arc(&mut path, center, radius, from, from.perp());
    arc(&mut path, center, radius, from.perp(), -from);
    path.close();
    path.finish()
}

/// +1 or -1: the side on which the outside lies, from the sign of the area.
fn turn_of(points: &[Vec2]) -> f32 {
    let mut area = 0.0;
    for (i, p) in points.iter().enumerate() {
        area += p.cross(points[(i + 1) % points.len()]);
    }
    if area < 0.0 { -1.0 } else { 1.0 }
}

/// Outward unit normal of the edge that starts at point `i`.
fn edge_normal(points: &[Vec2], i: usize, side: f32) -> Vec2 {
    let edge = points[(i + 1) % points.len()] - points[i];
    -edge.normalized().perp() * side
}

/// A circular arc around `center` from direction `from` to `to`, by cubics of at most a quarter turn.
fn arc(path: &mut PathBuilder, center: Vec2, radius: f32, from: Vec2, to: Vec2) {
    let cos = from.dot(to);
    if cos < -0.01 {
        let sum = from + to;
        let turn = if from.cross(to) < 0.0 { -1.0 } else { 1.0 };
        let middle = if sum.length() > 1e-3 { sum.normalized() } else { from.perp() * turn };
        arc(path, center, radius, from, middle);
        arc(path, center, radius, middle, to);
        return;
    }
    // Length of the handles of a cubic arc of angle t: 4/3 tan(t/4), by the half-angle formulas.
    let cos_half = (0.5 * (1.0 + cos)).max(0.0).sqrt();
    let sin_half = (0.5 * (1.0 - cos)).max(0.0).sqrt();
    let handle = 4.0 / 3.0 * sin_half / (1.0 + cos_half) * radius;
    let turn = if from.cross(to) < 0.0 { -1.0 } else { 1.0 };
    let (start, end) = (center + from * radius, center + to * radius);
    let (c1, c2) = (start + from.perp() * (turn * handle), end - to.perp() * (turn * handle));
    path.cubic_to(c1.x, c1.y, c2.x, c2.y, end.x, end.y);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_capsule_is_as_wide_as_its_radius_says() {
        for points in [[Vec2::ZERO, Vec2::new(10.0, 0.0)], [Vec2::new(10.0, 0.0), Vec2::ZERO]] {
            let bounds = rounded(&points, 3.0).unwrap().compute_tight_bounds().unwrap();
            assert!((bounds.left() + 3.0).abs() < 0.02 && (bounds.right() - 13.0).abs() < 0.02);
            assert!((bounds.top() + 3.0).abs() < 0.02 && (bounds.bottom() - 3.0).abs() < 0.02);
        }
    }

    #[test]
    fn where_outlines_overlap_there_is_no_hole() {
        let circle = PathBuilder::from_circle(20.0, 20.0, 8.0).unwrap();
        let mut corners = [
            Vec2::new(12.0, 12.0),
            Vec2::new(34.0, 12.0),
            Vec2::new(34.0, 34.0),
            Vec2::new(12.0, 34.0),
        ];
        let capsule = rounded(&[Vec2::new(10.0, 20.0), Vec2::new(30.0, 20.0)], 4.0).unwrap();
        for _ in 0..2 {
            corners.reverse();
            let square = rounded(&corners, 0.0).unwrap();
            for other in [&circle, &capsule] {
                let mut both = PathBuilder::new();
                both.push_path(&square);
                both.push_path(other);
                let mut mask = tiny_skia::Mask::new(40, 40).unwrap();
                let identity = tiny_skia::Transform::identity();
                let rule = tiny_skia::FillRule::Winding;
                mask.fill_path(&both.finish().unwrap(), rule, true, identity);
                assert_eq!(mask.data()[20 * 40 + 20], 255);
            }
        }
    }

    #[test]
    fn both_turns_are_rounded_outwards() {
        let mut square =
            [Vec2::new(0.0, 0.0), Vec2::new(4.0, 0.0), Vec2::new(4.0, 4.0), Vec2::new(0.0, 4.0)];
        for _ in 0..2 {
            let bounds = rounded(&square, 1.0).unwrap().compute_tight_bounds().unwrap();
            assert!((bounds.left() + 1.0).abs() < 1e-3 && (bounds.bottom() - 5.0).abs() < 1e-3);
            square.reverse();
        }
    }
}
