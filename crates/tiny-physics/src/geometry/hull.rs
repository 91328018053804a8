//! Convex hull of points in the plane.
//!
//! Andrew's monotone chain ("Another efficient algorithm for convex hulls in two dimensions", 1979) with
//! turns in 64 bits, then corners that are no corners within a tolerance are taken out, the flattest first.

use super::edges::least_by;
use crate::error::Error;
use crate::math::Vec2;

/// Points closer than this are one, metres.
const WELD: f32 = 1.0e-4;
/// As [`WELD`], as a part of the largest coordinate: 32 steps of a 32-bit number.
const WELD_RELATIVE: f32 = 4.0e-6;

/// Twice the signed area of the triangle, positive where it goes round anticlockwise.
#[inline]
pub(super) fn turn(a: Vec2, b: Vec2, c: Vec2) -> f64 {
    let [ax, ay, bx, by] = [a.x, a.y, b.x, b.y].map(f64::from);
    let [cx, cy] = [c.x, c.y].map(f64::from);
    (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
}

/// Corners of the hull, anticlockwise from the leftmost (the lowest of several). The points must be finite.
pub(super) fn convex_hull(points: &[Vec2]) -> Result<Vec<Vec2>, Error> {
    // Adding zero turns -0 into 0, so that sorting and equality agree.
    let mut sorted: Vec<Vec2> = points.iter().map(|p| *p + Vec2::ZERO).collect();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    sorted.dedup();
    let mut corners = monotone_chain(&sorted);
    remove_flat_corners(&mut corners, tolerance(&sorted));
    if corners.len() < 3 {
        let reason = "hull needs 3 points that are apart and not on one line";
        return Err(Error::BadPoints { reason, index: corners.len() });
    }
    Ok(corners)
}

fn tolerance(points: &[Vec2]) -> f32 {
    let mut largest = 0.0;
    for value in points.iter().flat_map(|p| [p.x.abs(), p.y.abs()]) {
        if value > largest {
            largest = value;
        }
    }
    let relative = largest * WELD_RELATIVE;
    if relative > WELD { relative } else { WELD }
}

fn monotone_chain(sorted: &[Vec2]) -> Vec<Vec2> {
    let mut chain = half_chain(sorted.iter());
    let upper = half_chain(sorted.iter().rev());
    chain.extend(upper);
    chain
}

/// One side of the hull, without its last point.
fn half_chain<'a>(points: impl Iterator<Item = &'a Vec2>) -> Vec<Vec2> {
    let mut chain: Vec<Vec2> = Vec::new();
    for point in points {
        while let [.., a, b] = chain[..]
            && turn(a, b, *point) <= 0.0
        {
            chain.pop();
        }
        chain.push(*point);
    }
    chain.pop();
    chain
}

/// Takes out the flattest corner until all stand out by more than the tolerance.
fn remove_flat_corners(corners: &mut Vec<Vec2>, tolerance: f32) {
    while corners.len() >= 3 {
        let (index, height) = flattest(corners);
        if height > tolerance {
            return;
        }
        corners.remove(index);
    }
}

/// The corner that stands out least from the line between its neighbours, and by how much. A corner next
/// to a coincident one stands out by the distance between the two at most.
fn flattest(corners: &[Vec2]) -> (usize, f32) {
    let count = corners.len();
    least_by(count, |i| {
        let (before, after) = (corners[(i + count - 1) % count], corners[(i + 1) % count]);
        let base = before.distance(after);
        let area = turn(before, corners[i], after) as f32;
        let gap = corners[i].distance(after);
        let height = if base > 0.0 { area / base } else { 0.0 };
        if gap < height { gap } else { height }
    })
}

#[cfg(test)]
mod tests {
    use super::super::Polygon;
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn points_inside_and_on_edges_are_left_out() {
        let points = [
            (0.0, 0.0),
            (2.0, 0.0),
            (2.0, 2.0),
            (0.0, 2.0),
            (1.0, 1.0),
            (1.0, 0.0),
            (2.0, 1.00001),
            (2.00003, 2.0),
            (0.0, 0.00002),
            (-0.0, 0.0),
        ]
        .map(Vec2::from);
        assert_eq!(Polygon::hull(&points).unwrap().vertices().len(), 4);
    }

    #[test]
    fn degenerate_points_are_errors() {
        let line: Vec<_> = (0..10).map(|i| Vec2::new(i as f32, 2.0 * i as f32)).collect();
        let nearly: Vec<_> = (0..10).map(|i| Vec2::new(i as f32, 3e-5 * (i % 2) as f32)).collect();
        let round: Vec<_> =
            (0..20).map(|i| crate::math::Rot::from_angle(i as f32 * 0.314).x_axis()).collect();
        assert!(Polygon::hull(&[]).is_err());
        assert!(Polygon::hull(&[Vec2::X; 5]).is_err());
        assert!(Polygon::hull(&line).is_err());
        assert!(Polygon::hull(&nearly).is_err());
        assert!(Polygon::hull(&round).is_err());
        assert!(Polygon::hull(&[Vec2::ZERO, Vec2::X, Vec2::new(0.0, f32::NAN)]).is_err());
        assert!(Polygon::hull(&[Vec2::ZERO, Vec2::X, Vec2::new(0.0, f32::INFINITY)]).is_err());
    }

    proptest! {
        #[test]
        fn hulls_are_convex_and_hold_their_points(
            raw in prop::collection::vec((-5.0_f32..5.0, -5.0_f32..5.0), 3..9),
        ) {
            let points: Vec<Vec2> = raw.into_iter().map(Vec2::from).collect();
            let Ok(hull) = Polygon::hull(&points) else { return Ok(()) };
            let vertices = hull.vertices();
            for (i, normal) in hull.normals().iter().enumerate() {
                prop_assert!((normal.length() - 1.0).abs() < 1e-6);
                for point in &points {
                    prop_assert!(normal.dot(*point - vertices[i]) < 2.0 * WELD);
                }
            }
            prop_assert!(vertices.iter().all(|v| points.contains(v)));
            prop_assert_eq!(Polygon::hull(vertices).unwrap(), hull);
            prop_assert_eq!(Polygon::convex(vertices).unwrap(), hull);
            let mut reversed = points.clone();
            reversed.reverse();
            prop_assert_eq!(Polygon::hull(&reversed).unwrap(), hull);
        }
    }
}
