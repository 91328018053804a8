//! Every pair of shapes against an oracle in 64 bits, and the properties that a solver relies on.

use super::collide::collide_as;
use super::*;
use crate::geometry::{Polygon, Shape};
use crate::math::{Rot, Transform, Vec2};
use crate::simd::{BLOCK, LaneKernel, Lanes, SimdLevel, dispatch};

/// Uniform numbers from a 64-bit xorshift.
pub(super) struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 40) as f32 / 16_777_216.0
    }

    pub fn range(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.next()
    }

    pub fn vec(&mut self, reach: f32) -> Vec2 {
        Vec2::new(self.range(-reach, reach), self.range(-reach, reach))
    }

    pub fn rot(&mut self) -> Rot {
        match (self.next() * 4.0) as u32 {
            0 => Rot::from_angle((self.next() * 8.0).floor() * core::f32::consts::FRAC_PI_4),
            1 => Rot::from_angle(self.range(-1.0e-3, 1.0e-3)),
            _ => Rot::from_angle(self.range(-core::f32::consts::PI, core::f32::consts::PI)),
        }
    }
}

pub(super) type Point = [f64; 2];

fn sub(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// A shape for the oracle: core points and a radius.
fn core(shape: &Shape, frame: Transform) -> (Vec<Point>, f64) {
    let (points, radius) = match *shape {
        Shape::Circle { radius } => (vec![Vec2::ZERO], radius),
        Shape::Aabb { half_extents: Vec2 { x, y } } => {
            (vec![Vec2::new(-x, -y), Vec2::new(x, -y), Vec2::new(x, y), Vec2::new(-x, y)], 0.0)
        }
        Shape::Capsule { a, b, radius } => (vec![a, b], radius),
        Shape::Segment { a, b } => (vec![a, b], 0.0),
        Shape::Polygon(ref polygon) => (polygon.vertices().to_vec(), polygon.radius()),
    };
    let (c, s) = (f64::from(frame.q.c), f64::from(frame.q.s));
    let place = |v: Vec2| {
        let (x, y) = (f64::from(v.x), f64::from(v.y));
        [c * x - s * y + f64::from(frame.p.x), s * x + c * y + f64::from(frame.p.y)]
    };
    (points.into_iter().map(place).collect(), f64::from(radius))
}

/// Separation of two shapes: the distance, or minus the least shift that parts them.
pub(super) fn oracle(a: &Shape, b: &Shape, b_in_a: Transform) -> f64 {
    let (a, radius_a) = core(a, Transform::IDENTITY);
    let (b, radius_b) = core(b, b_in_a);
    oracle_of_points(&a, &b) - radius_a - radius_b
}

/// The same of two convex hulls: separating axes while they overlap, else all distances.
fn oracle_of_points(a: &[Point], b: &[Point]) -> f64 {
    let mut axes = Vec::new();
    for points in [a, b] {
        for i in 0..points.len() {
            let edge = sub(points[(i + 1) % points.len()], points[i]);
            let length = dot(edge, edge).sqrt();
            if length > 1e-9 {
                let edge = [edge[0] / length, edge[1] / length];
                axes.extend([[edge[1], -edge[0]], [-edge[1], edge[0]]]);
                if points.len() == 2 {
                    axes.extend([edge, [-edge[0], -edge[1]]]);
                }
            }
        }
    }
    let gap = |axis: &Point| {
        let low = b.iter().map(|&p| dot(p, *axis)).fold(f64::INFINITY, f64::min);
        let high = a.iter().map(|&p| dot(p, *axis)).fold(f64::NEG_INFINITY, f64::max);
        low - high
    };
    let best = axes.iter().map(gap).fold(f64::NEG_INFINITY, f64::max);
    if best > 0.0 || axes.is_empty() { distance(a, b) } else { best }
}

fn distance(a: &[Point], b: &[Point]) -> f64 {
    let mut best = f64::INFINITY;
    for (points, edges) in [(a, b), (b, a)] {
        for &p in points {
            for i in 0..edges.len() {
                let (start, end) = (edges[i], edges[(i + 1) % edges.len()]);
                let edge = sub(end, start);
                let length_sq = dot(edge, edge);
                let t = if length_sq > 0.0 { dot(sub(p, start), edge) / length_sq } else { 0.0 };
                let t = t.clamp(0.0, 1.0);
                let line = sub(p, [start[0] + t * edge[0], start[1] + t * edge[1]]);
                best = best.min(dot(line, line).sqrt());
            }
        }
    }
    best
}

/// One or more of each variant, sharp and flat ones too.
fn shapes(random: &mut Random) -> Vec<Shape> {
    let mut size = || random.range(0.1, 1.5);
    let (r, w, h, l) = (size(), size(), size(), size());
    let mut shapes = vec![
        Shape::Circle { radius: r },
        Shape::Aabb { half_extents: Vec2::new(w, h) },
        Shape::Aabb { half_extents: Vec2::new(1.0, 1.0) },
    ];
    let (a, b) = (random.vec(l), random.vec(l));
    shapes.push(Shape::Capsule { a, b, radius: 0.5 * r });
    shapes.push(Shape::Capsule { a, b: a, radius: r });
    shapes.push(Shape::Segment { a, b });
    let (center, rotation) = (random.vec(0.5), random.rot());
    shapes.push(Polygon::turned_rect(w, h, center, rotation).unwrap().into());
    shapes.push(Polygon::rect(4.0 * w, 0.2 * h).unwrap().into());
    shapes.push(Polygon::rect(w, h).unwrap().rounded(0.4 * r).unwrap().into());
    shapes.push(Polygon::regular(3 + (w * 3.0) as usize, h).unwrap().rounded(0.1).unwrap().into());
    let sharp = [Vec2::ZERO, Vec2::new(1.0, 0.05), Vec2::new(2.0, 0.3)];
    shapes.push(Shape::hull(&sharp).unwrap());
    shapes
}

fn reach(shape: &Shape) -> f32 {
    let (points, radius) = core(shape, Transform::IDENTITY);
    (points.iter().map(|&p| dot(p, p).sqrt()).fold(0.0, f64::max) + radius) as f32
}

/// Calls `check` with pairs of shapes that overlap, touch or are near.
fn for_random_pairs(rounds: u32, mut check: impl FnMut(&Shape, &Shape, Transform, &mut Random)) {
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    for _ in 0..rounds {
        let (list_a, list_b) = (shapes(&mut random), shapes(&mut random));
        for a in &list_a {
            for b in &list_b {
                let away = 1.2 * (reach(a) + reach(b));
                let b_in_a = Transform::new(random.vec(away * 0.7), random.rot());
                check(a, b, b_in_a, &mut random);
            }
        }
    }
}

/// What the bias of an axis may cost, and rounding.
const TOLERANCE: f64 = 3.0e-3;
const FAR: f32 = 100.0;

fn separation(manifold: &Manifold) -> f64 {
    f64::from(manifold.deepest().map_or(f32::NAN, |point| point.separation))
}

#[test]
fn separations_are_those_of_the_oracle() {
    for_random_pairs(300, |a, b, b_in_a, _| {
        let manifold = collide(a, b, b_in_a, FAR);
        let (found, expected) = (separation(&manifold), oracle(a, b, b_in_a));
        assert!(
            (found - expected).abs() < TOLERANCE,
            "{found} is not {expected}: {a:?} {b:?} {b_in_a:?} {manifold:?}"
        );
        assert!((manifold.normal.length() - 1.0).abs() < 1e-5);
    });
}

#[test]
fn moving_along_the_normal_makes_shapes_just_touch() {
    for_random_pairs(300, |a, b, b_in_a, _| {
        let manifold = collide(a, b, b_in_a, FAR);
        let shift = manifold.normal * -(separation(&manifold) as f32);
        let moved = Transform::new(b_in_a.p + shift, b_in_a.q);
        let left = oracle(a, b, moved);
        assert!(left.abs() < TOLERANCE, "{left}: {a:?} {b:?} {b_in_a:?} {manifold:?}");
    });
}

#[test]
fn the_general_path_agrees_with_the_oracle_too() {
    for_random_pairs(300, |a, b, b_in_a, _| {
        let manifold = collide_as(PairClass::General, [a, b], b_in_a, FAR);
        let (found, expected) = (separation(&manifold), oracle(a, b, b_in_a));
        assert!(
            (found - expected).abs() < TOLERANCE,
            "{found} is not {expected}: {a:?} {b:?} {b_in_a:?} {manifold:?}"
        );
    });
}

#[test]
fn points_lie_midway_between_the_surfaces() {
    for_random_pairs(100, |a, b, b_in_a, _| {
        let manifold = collide(a, b, b_in_a, FAR);
        let deepest = *manifold.deepest().unwrap();
        let probe = Shape::Circle { radius: 1.0e-6 };
        let at = Transform::new(deepest.point, Rot::IDENTITY);
        let to_a = oracle(a, &probe, at);
        let to_b = oracle(b, &probe, at.relative_to(b_in_a));
        let half = 0.5 * f64::from(deepest.separation);
        if half > 0.0 {
            assert!((to_a - half).abs() < TOLERANCE && (to_b - half).abs() < TOLERANCE);
        } else {
            // Inside both, unless their cores cross so deeply that no point is.
            assert!(to_a < -half + TOLERANCE && to_b < -half + TOLERANCE);
        }
    });
}

#[test]
fn swapping_the_shapes_turns_the_normal() {
    for_random_pairs(200, |a, b, b_in_a, _| {
        let forth = collide(a, b, b_in_a, FAR);
        let back = collide(b, a, b_in_a.inverse(), FAR);
        assert!((separation(&forth) - separation(&back)).abs() < TOLERANCE);
        if separation(&forth) > 0.1 {
            let turned = -b_in_a.q.rotate(back.normal);
            assert!((forth.normal - turned).length() < 0.05, "{a:?} {b:?} {b_in_a:?}");
        }
    });
}

#[test]
fn a_small_motion_changes_the_separation_little() {
    for_random_pairs(100, |a, b, b_in_a, random| {
        let step = 1.0e-3;
        let before = separation(&collide(a, b, b_in_a, FAR));
        let q = Rot::from_angle(random.range(-step, step)).compose(b_in_a.q);
        let moved = Transform::new(b_in_a.p + random.vec(step), q);
        let after = separation(&collide(a, b, moved, FAR));
        let most = f64::from(step) * (1.5 + f64::from(reach(b))) + TOLERANCE;
        assert!((before - after).abs() < most, "{before} {after} {a:?} {b:?} {b_in_a:?}");
    });
}

#[test]
fn points_beyond_the_margin_are_left_out() {
    for_random_pairs(50, |a, b, b_in_a, _| {
        let all = collide(a, b, b_in_a, FAR);
        let near = collide(a, b, b_in_a, 0.02);
        let kept = all.points().iter().filter(|point| point.separation <= 0.02);
        assert!(near.points().len() == kept.clone().count());
        assert!(near.points().iter().zip(kept).all(|(x, y)| x.id == y.id));
        if near.points().is_empty() {
            assert_eq!(near, Manifold::EMPTY);
        }
    });
}

fn boxed(hx: f32, hy: f32) -> Shape {
    Polygon::rect(hx, hy).unwrap().into()
}

fn at(x: f32, y: f32, angle: f32) -> Transform {
    Transform::from_angle(Vec2::new(x, y), angle)
}

#[test]
fn a_resting_box_keeps_two_points_and_their_ids() {
    for (wide, narrow) in [(boxed(10.0, 1.0), boxed(0.5, 0.5)), (boxed(0.5, 0.5), boxed(0.5, 0.5))]
    {
        for (a, b) in [(wide, narrow), (narrow, wide)] {
            let height = 1.0 + if a == wide && wide != narrow { 0.5 } else { 0.0 };
            let height = if b == wide && wide != narrow { 1.5 } else { height };
            let first = collide(&a, &b, at(0.1, height, 0.0), 0.02);
            assert_eq!(first.points().len(), 2);
            assert_ne!(first.points()[0].id, first.points()[1].id);
            for k in -20..=20 {
                let k = k as f32;
                let next = collide(&a, &b, at(0.1, height + k * 1e-5, -k * 1e-5), 0.02);
                assert_eq!(next.points().len(), 2, "{k}");
                for (x, y) in first.points().iter().zip(next.points()) {
                    assert_eq!(x.id, y.id);
                    assert!((x.point - y.point).length() < 2e-3, "{k} {x:?} {y:?}");
                }
                assert!((next.normal - Vec2::Y).length() < 1e-3);
            }
        }
    }
}

#[test]
fn side_by_side_capsules_touch_in_two_points_and_crossed_ones_in_one() {
    let capsule = Shape::Capsule { a: -Vec2::X, b: Vec2::X, radius: 0.25 };
    let beside = collide(&capsule, &capsule, at(0.5, 0.5, 0.0), 0.02);
    let x: Vec<f32> = beside.points().iter().map(|point| point.point.x).collect();
    assert_eq!(x, [1.0, -0.5]);
    assert!(beside.points().iter().all(|point| point.separation.abs() < 1e-6));
    let end_to_end = collide(&capsule, &capsule, at(2.5, 0.0, 0.0), 0.02);
    assert_eq!((end_to_end.points().len(), end_to_end.normal), (1, Vec2::X));
    let upright = collide(&capsule, &capsule, at(0.25, 1.4, 1.6), 0.02);
    assert_eq!(upright.points().len(), 1);
    assert!((upright.normal - Vec2::Y).length() < 1e-6);
    let crossed = collide(&capsule, &capsule, at(0.5, 0.25, core::f32::consts::FRAC_PI_2), 0.02);
    assert!((crossed.normal - Vec2::X).length() < 1e-6, "leaves by the nearer end: {crossed:?}");
    assert!((separation(&crossed) + 1.0).abs() < 1e-5);
}

#[test]
fn round_corners_are_round() {
    // Cores of half extent 0.5 with radius 0.25, corner to corner along the diagonal.
    let pair = |gap: f32| LanePair {
        p: [1.0 + gap, 1.0 + gap],
        q: [1.0, 0.0],
        a: [0.5, 0.5, 0.25],
        b: [0.5, 0.5, 0.25],
    };
    let near = Manifold::from(box_box((), &pair(0.4), 1.0));
    let diagonal = 0.4 * core::f32::consts::SQRT_2;
    assert!((near.normal - Vec2::new(1.0, 1.0).normalized()).length() < 1e-6);
    assert!((separation(&near) - f64::from(diagonal - 0.5)).abs() < 1e-6);
    assert!((near.points()[0].point - Vec2::splat(0.7)).length() < 1e-6);
    assert_eq!(Manifold::from(box_box((), &pair(0.4), 0.0)), Manifold::EMPTY);
}

#[test]
fn a_corner_direction_is_continuous_with_the_face_direction() {
    let mut last = Vec2::Y;
    for k in 0..4000 {
        let x = k as f32 * 1.0e-3;
        let pair = LanePair { p: [x, 1.5], q: [1.0, 0.0], a: [0.5, 0.5, 0.3], b: [0.5, 0.5, 0.3] };
        let found = Vec2::from(box_box((), &pair, 100.0).normal);
        assert!((found - last).length() < 3.0e-3, "{x}: {last} {found}");
        last = found;
    }
}

/// Pairs by how many half extents their shapes have: two of a box, one of a capsule, none of a circle.
const PAIRS: [[usize; 2]; 6] = [[2, 2], [2, 1], [2, 0], [1, 1], [1, 0], [0, 0]];

/// Polygons of 3 to 8 corners, in turn.
fn polygons() -> [Shape; BLOCK + 1] {
    core::array::from_fn(|i| Polygon::regular(3 + i * 5 % 6, 0.5 + 0.1 * i as f32).unwrap().into())
}

/// Sixteen pairs in structure-of-arrays form: ten rows of numbers.
type Rows = [[f32; BLOCK]; 10];

/// Runs a class over sixteen pairs; ten rows come out.
struct CollideBlock<'a> {
    class: PairClass,
    rows: &'a Rows,
    /// For pairs of general polygons: of shapes A, and from the second one on of shapes B.
    polygons: &'a [Shape; BLOCK + 1],
    max_separation: f32,
}

impl LaneKernel for CollideBlock<'_> {
    type Output = [[f32; BLOCK]; 10];

    #[inline(always)]
    fn run<L: Lanes>(self, token: L::Token) -> Self::Output {
        let mut out = [[0.0; BLOCK]; 10];
        let outlines: [_; BLOCK + 1] = core::array::from_fn(|i| {
            let class = if i % 3 == 0 { ShapeClass::Box } else { ShapeClass::General };
            let middle = Vec2::new(0.1 * i as f32, -0.2);
            Outline::of(&self.polygons[i], class, middle, Vec2::new(0.7, 0.0))
        });
        for i in (0..BLOCK).step_by(L::WIDTH) {
            let r = self.rows;
            let pair = LanePair {
                p: [L::load(token, &r[0][i..]), L::load(token, &r[1][i..])],
                q: [L::load(token, &r[2][i..]), L::load(token, &r[3][i..])],
                a: [
                    L::load(token, &r[4][i..]),
                    L::load(token, &r[5][i..]),
                    L::load(token, &r[6][i..]),
                ],
                b: [
                    L::load(token, &r[7][i..]),
                    L::load(token, &r[8][i..]),
                    L::load(token, &r[9][i..]),
                ],
            };
            let most = L::splat(token, self.max_separation);
            let m = match self.class {
                PairClass::BoxBox => box_box(token, &pair, most),
                PairClass::BoxCircle => box_circle(token, &pair, most),
                PairClass::CapsuleCircle => capsule_circle(token, &pair, most),
                PairClass::CircleCircle => circle_circle(token, &pair, most),
                PairClass::General => {
                    let outlines = [&outlines[i..], &outlines[i + 1..]];
                    general(token, &pair, outlines, most)
                }
            };
            let [[ax, ay], [bx, by]] = m.points;
            let values = [
                m.normal[0],
                m.normal[1],
                ax,
                ay,
                bx,
                by,
                m.separation[0],
                m.separation[1],
                m.id[0],
                m.id[1],
            ];
            for (row, value) in out.iter_mut().zip(values) {
                value.store(&mut row[i..]);
            }
        }
        out
    }
}

/// A pair whose shapes have so many half extents.
fn fill(rows: &mut Rows, lane: usize, [a, b]: [usize; 2], value: &mut impl FnMut() -> f32) {
    for (row, target) in rows.iter_mut().enumerate() {
        let sized = match row {
            0..=3 => true,
            4 | 5 => row - 4 < a,
            7 | 8 => row - 7 < b,
            _ => true,
        };
        let number = value();
        let number = if row >= 4 { number.abs() } else { number };
        target[lane] = if sized { number } else { 0.0 };
    }
}

fn for_random_blocks(rounds: u32, mut check: impl FnMut(PairClass, &Rows)) {
    const HOSTILE: [f32; 12] = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.5,
        1.0e-30,
        1.0e-42,
        3.0e19,
        -1.0e30,
        f32::MAX,
        f32::INFINITY,
        f32::NAN,
    ];
    let mut random = Random(77);
    for round in 0..rounds {
        for extents in PAIRS {
            let [a, b] =
                extents.map(|n| [ShapeClass::Circle, ShapeClass::Capsule, ShapeClass::Box][n]);
            let class = if round % 3 == 0 { PairClass::General } else { PairClass::of(a, b) };
            let mut rows = [[0.0; BLOCK]; 10];
            for lane in 0..BLOCK {
                let hostile = round % 2 == 1;
                fill(&mut rows, lane, extents, &mut || {
                    let pick = (random.next() * HOSTILE.len() as f32) as usize;
                    if hostile && random.next() < 0.5 {
                        HOSTILE[pick]
                    } else {
                        random.range(-2.0, 2.0)
                    }
                });
                let q = random.rot();
                (rows[2][lane], rows[3][lane]) = (q.c, q.s);
            }
            check(class, &rows);
        }
    }
}

#[test]
fn every_level_gives_the_same_bits() {
    for_random_blocks(200, |class, rows| {
        let polygons = &polygons();
        let kernel = || CollideBlock { class, rows, polygons, max_separation: 0.3 };
        let expected = kernel().run::<f32>(());
        for level in SimdLevel::available() {
            let found = dispatch(level, kernel());
            for (x, y) in expected.iter().flatten().zip(found.iter().flatten()) {
                let same = x.to_bits() == y.to_bits() || (x.is_nan() && y.is_nan());
                assert!(same, "{level} {class:?}: {x} is not {y} in {rows:?}");
            }
        }
    });
}

#[test]
fn hostile_input_gives_a_unit_normal_and_no_nan() {
    for_random_blocks(2000, |class, rows| {
        let polygons = &polygons();
        let out = CollideBlock { class, rows, polygons, max_separation: 0.3 }.run::<f32>(());
        for lane in 0..BLOCK {
            let normal = Vec2::new(out[0][lane], out[1][lane]);
            let input: Vec<f32> = rows.iter().map(|row| row[lane]).collect();
            assert!((normal.length() - 1.0).abs() < 1e-4, "{class:?} {normal} from {input:?}");
            let finite = input.iter().all(|x| x.abs() < 1.0e15);
            for row in &out[2..] {
                assert!(!finite || row[lane].is_finite(), "{class:?} {input:?}");
            }
            assert!(!out[6][lane].is_nan() && !out[7][lane].is_nan());
        }
    });
}
