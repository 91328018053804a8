//! A shape moved along a straight line against another that stands still.
//!
//! Conservative advancement (Mirtich 1996; van den Bergen 2003, section 4.3): the gap along the closest
//! normal cannot close faster than the motion along it, so moving on by gap / speed never goes too far.

use super::distance::core_distance;
use super::{Core, Shape};
use crate::math::{Rot, Transform, Vec2};

/// Limit of the search: 64 shortens the gap by far more than 32 bits hold, grazing rays excepted.
const MAX_ITERATIONS: u32 = 64;
/// Shapes closer than this touch, metres.
const TOUCH: f32 = 1.0e-4;

/// Where a moved shape first touches another. In the frame of shape A.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct CastHit {
    /// Part of the translation until the hit, 0 to 1; 0 where they overlap at the start.
    pub fraction: f32,
    /// Unit normal from A to B there.
    pub normal: Vec2,
    /// The place of the hit on the surface of A, metres.
    pub point: Vec2,
    /// Did the search end by itself? `false`: by its limit; the shapes are close and the hit is early.
    pub converged: bool,
}

/// Moves B from `b_in_a` (its frame seen in the frame of A) by `translation` (in the frame of A, metres) and
/// finds where it first comes within 0.1 mm of A. `None` where it does not, or where the translation is
/// not finite. Shapes that overlap at the start are a hit at fraction 0 even where they part.
pub fn shape_cast(a: &Shape, b: &Shape, b_in_a: Transform, translation: Vec2) -> Option<CastHit> {
    if !translation.is_finite() || !b_in_a.is_finite() {
        return None;
    }
    core_cast(&a.core(), &b.core().transformed(b_in_a), translation)
}

fn core_cast(a: &Core, b: &Core, translation: Vec2) -> Option<CastHit> {
    let mut fraction = 0.0;
    let mut last = None;
    for _ in 0..MAX_ITERATIONS {
        let way = translation * fraction;
        let touch = TOUCH + rounding(a, b, way);
        let moved = b.transformed(Transform::new(way, Rot::IDENTITY));
        let gap = core_distance(a, &moved);
        let hit = CastHit { fraction, normal: gap.normal, point: gap.point_a, converged: true };
        if gap.separation <= touch {
            return Some(hit);
        }
        let speed = -gap.normal.dot(translation);
        if speed <= 0.0 {
            return None;
        }
        fraction += (gap.separation - 0.5 * touch) / speed;
        if fraction > 1.0 {
            return None;
        }
        last = Some(hit);
    }
    last.map(|hit| CastHit { converged: false, ..hit })
}

/// What rounding makes of a gap between cores of this size after such a way, metres.
fn rounding(a: &Core, b: &Core, way: Vec2) -> f32 {
    1.0e-6 * (a.reach(Vec2::ZERO) + b.reach(Vec2::ZERO) + way.length())
}

#[cfg(test)]
mod tests {
    use super::super::tests::{any_frame, any_shape, any_vec};
    use super::super::{Ray, distance};
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn known_casts() {
        let at = |x, y| Transform::new(Vec2::new(x, y), Rot::IDENTITY);
        let (rect, circle) = (Shape::rect(1.0, 1.0).unwrap(), Shape::circle(0.5).unwrap());
        let hit = shape_cast(&rect, &circle, at(5.0, 0.0), Vec2::new(-7.0, 0.0)).unwrap();
        assert!((hit.fraction - 0.5).abs() < 1e-4 && hit.normal == Vec2::X);
        assert!((hit.point - Vec2::X).length() < 1e-4);
        assert_eq!(shape_cast(&rect, &circle, at(5.0, 0.0), Vec2::new(7.0, 0.0)), None);
        assert_eq!(shape_cast(&rect, &circle, at(5.0, 0.0), Vec2::new(-3.0, 0.0)), None);
        assert_eq!(shape_cast(&rect, &circle, at(5.0, 0.0), Vec2::ZERO), None);
        assert_eq!(shape_cast(&rect, &circle, at(5.0, 0.0), Vec2::new(f32::NAN, 0.0)), None);
        let inside = shape_cast(&rect, &circle, at(1.2, 0.0), Vec2::X).unwrap();
        assert_eq!((inside.fraction, inside.normal), (0.0, Vec2::X));
    }

    /// How far it would go on says nothing of where it hits, nor of what it passes by.
    #[test]
    fn long_casts_are_as_exact_as_short_ones() {
        let at = |x, y| Transform::new(Vec2::new(x, y), Rot::IDENTITY);
        let (wall, circle) = (Shape::rect(1.0, 20.0).unwrap(), Shape::circle(0.5).unwrap());
        let floor = Shape::rect(20.0, 1.0).unwrap();
        for length in [20.0, 1.0e3, 1.0e5, 1.0e7] {
            let down = Vec2::new(0.0, -length);
            assert_eq!(shape_cast(&wall, &circle, at(1.5 + 0.05, 10.0), down), None, "{length}");
            let hit = shape_cast(&floor, &circle, at(0.0, 11.5), down).unwrap();
            let gap = 10.0 - length * hit.fraction;
            assert!((-1.0e-4..3.0e-4).contains(&gap) && hit.converged, "{length}: {gap}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]
        #[test]
        fn casts_agree_with_sampling(
            a in any_shape(),
            b in any_shape(),
            frame in any_frame(4.0),
            translation in any_vec(8.0),
        ) {
            let hit = shape_cast(&a, &b, frame, translation);
            let gap = |fraction: f32| {
                distance(&a, &b, Transform::new(frame.p + translation * fraction, frame.q)).separation
            };
            let end = hit.map_or(1.0, |hit| hit.fraction);
            for k in 0..200 {
                prop_assert!(end == 0.0 || gap(end * k as f32 / 200.0) > 0.0);
            }
            if let Some(hit) = hit {
                prop_assert!(hit.converged);
                prop_assert!(gap(hit.fraction) < 2e-4);
            }
        }

        #[test]
        fn a_cast_circle_agrees_with_the_exact_one(
            a in any_shape(),
            origin in any_vec(4.0),
            translation in any_vec(8.0),
            radius in 0.05_f32..1.0,
        ) {
            let circle = Shape::circle(radius).unwrap();
            let start = Transform::new(origin, Rot::IDENTITY);
            if distance(&a, &circle, start).separation < 1e-3 {
                return Ok(());
            }
            let exact = a.circle_cast(&Ray::new(origin, translation), radius);
            let cast = shape_cast(&a, &circle, start, translation);
            match (exact, cast) {
                (Some(exact), Some(cast)) => {
                    let early = (exact.fraction - cast.fraction) * translation.length();
                    let head_on = -exact.normal.dot(translation.normalized());
                    prop_assert!(early > -1e-4 && early * head_on < 1e-3, "{early} {head_on}");
                }
                (Some(_), None) => prop_assert!(false, "missed"),
                (None, _) => {}
            }
        }
    }
}
