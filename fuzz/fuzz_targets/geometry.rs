//! Hulls, distances, times of impact and manifolds of any shapes in any places.
#![no_main]

use arbitrary::{Arbitrary, Unstructured};
use libfuzzer_sys::fuzz_target;
use tiny_physics::geometry::{Sweep, distance, time_of_impact};
use tiny_physics::{Polygon, Shape, Transform, Vec2, collide};

/// Mostly a sensible number, so that most shapes are sound; now and then any bits.
#[derive(Clone, Copy, Debug)]
struct Number(f32);

impl<'a> Arbitrary<'a> for Number {
    fn arbitrary(u: &mut Unstructured<'a>) -> arbitrary::Result<Self> {
        let tag: u8 = u.arbitrary()?;
        Ok(Self(match tag {
            0..=9 => u.arbitrary()?,
            10..=19 => f32::from(u.arbitrary::<i8>()?) * 1.0e-4,
            20..=99 => f32::from(u.arbitrary::<i8>()?) * 0.125,
            _ => f32::from(u.arbitrary::<i16>()?) / 4096.0,
        }))
    }
}

#[derive(Arbitrary, Debug)]
struct Input {
    points: [Vec<(Number, Number)>; 2],
    radius: [Number; 2],
    kind: [u8; 2],
    place: (Number, Number, Number),
    motion: (Number, Number, Number),
}

fn shape(kind: u8, points: &[(Number, Number)], radius: f32) -> Option<Shape> {
    let radius = if kind & 64 == 0 { radius.abs() } else { radius };
    let points: Vec<Vec2> = points.iter().map(|&(x, y)| Vec2::new(x.0, y.0)).collect();
    let at = |i: usize| points.get(i).copied().unwrap_or(Vec2::X);
    match kind % 6 {
        0 => Shape::circle(radius).ok(),
        1 => Shape::capsule(at(0), at(1), radius).ok(),
        2 => Shape::segment(at(0), at(1)).ok(),
        3 => Shape::rect(at(0).x.abs(), at(0).y.abs()).ok(),
        4 => Polygon::hull(&points).and_then(|p| p.rounded(radius)).ok().map(Shape::Polygon),
        _ => Shape::regular(usize::from(kind / 6), radius).ok(),
    }
}

fuzz_target!(|input: Input| {
    let [Some(a), Some(b)] =
        [0, 1].map(|i| shape(input.kind[i], &input.points[i], input.radius[i].0))
    else {
        return;
    };
    assert!(a.validate().is_ok() && b.validate().is_ok());
    let (Number(x), Number(y), Number(angle)) = input.place;
    if ![x, y, angle].iter().all(|v| v.abs() < 1.0e6) {
        return;
    }
    let place = Transform::from_angle(Vec2::new(x, y), angle);
    let gap = distance(&a, &b, place);
    assert!(gap.separation.is_finite(), "{gap:?}");
    let manifold = collide(&a, &b, place, 0.1);
    assert!(manifold.normal.is_finite());
    for point in &manifold.points[..usize::from(manifold.count)] {
        assert!(point.point.is_finite() && point.separation <= 0.1, "{manifold:?}");
    }
    let (Number(x), Number(y), Number(turn)) = input.motion;
    if [x, y, turn].iter().all(|v| v.abs() < 1.0e4) {
        let still = Sweep::fixed(Transform::IDENTITY);
        let moving = Sweep::new(place, Vec2::ZERO, Vec2::new(x, y), turn);
        let toi = time_of_impact(&a, &still, &b, &moving, 1.0);
        assert!((0.0..=1.0).contains(&toi.fraction), "{toi:?}");
    }
});
