//! Convex pieces of an outline, as polygons and as the shapes of a body.
//!
//! For every decision corners are rounded to a grid of 2^24 steps, where turns are exact in whole numbers; the
//! pieces have the corners as they were given. Ears are cut off, the roundest first (G. Meisters,
//! *Polygons have ears*, 1975); then pieces are joined again over cuts that are not needed, the longest first
//! (S. Hertel, K. Mehlhorn, *Fast triangulation of simple polygons*, 1983): but for the limit of 8 corners that
//! makes at most four times as many pieces as there must be.

use crate::geometry::{MAX_VERTICES, check_point};
use crate::{BodyId, Error, Polygon, RigidBody, ShapeDef, ShapeId, Vec2, World};

/// Steps of the grid from 0 to the largest coordinate: 32-bit numbers have as many.
const STEPS: f64 = 16_777_216.0;

type Corner = [i64; 2];

impl Polygon {
    /// Cuts the area within an outline into convex polygons of up to 8 corners. The outline may be concave and
    /// go round either way; a last point that repeats the first is left out.
    ///
    /// The corners of the pieces are points of the outline. Pieces thinner than the tolerance of
    /// [`Polygon::hull`] are left out. Work grows with the square of the number of points.
    ///
    /// ```
    /// use tiny_physics::{Polygon, Vec2};
    /// let arrow = [(0.0, 0.0), (2.0, 1.0), (0.0, 2.0), (0.5, 1.0)].map(|(x, y)| Vec2::new(x, y));
    /// assert_eq!(Polygon::decompose(&arrow)?.len(), 2);
    /// # Ok::<(), tiny_physics::Error>(())
    /// ```
    ///
    /// # Errors
    /// Fewer than 3 points that are apart and not on one line; a coordinate that is not finite or beyond 1e6;
    /// edges that cross or touch each other (a ring with a hole is two outlines).
    pub fn decompose(outline: &[Vec2]) -> Result<Vec<Self>, Error> {
        for point in outline {
            check_point("outline point", *point)?;
        }
        let ring = Ring::new(outline)?;
        let (mut pieces, cuts) = cut_ears(&ring.corners)
            .ok_or(Error::BadPoints { reason: "the outline crosses itself", index: 0 })?;
        join(&ring.corners, &mut pieces, cuts);
        let hull = |piece: Vec<usize>| {
            let points: Vec<Vec2> = piece.into_iter().map(|i| outline[ring.points[i]]).collect();
            Self::hull(&points).ok()
        };
        let polygons: Vec<Self> = pieces.into_iter().filter_map(hull).collect();
        if polygons.is_empty() { Err(no_area(outline.len())) } else { Ok(polygons) }
    }
}

impl ShapeDef {
    /// Copies of this description with the convex pieces of an outline for shapes: what it says of place,
    /// material, filter and events holds for each of them.
    ///
    /// # Errors
    /// Those of [`Polygon::decompose`].
    pub fn pieces(&self, outline: &[Vec2]) -> Result<Vec<Self>, Error> {
        let pieces = Polygon::decompose(outline)?;
        Ok(pieces.into_iter().map(|piece| Self { shape: piece.into(), ..self.clone() }).collect())
    }
}

impl RigidBody {
    /// Adds the convex pieces of an outline, which may be concave, as copies of a shape: see
    /// [`ShapeDef::pieces`].
    ///
    /// ```
    /// use tiny_physics::{RigidBody, Shape, ShapeDef, Vec2};
    /// let boomerang = [(0.0, 0.0), (2.0, 1.0), (0.0, 2.0), (0.5, 1.0)].map(|(x, y)| Vec2::new(x, y));
    /// let material = ShapeDef::new(Shape::circle(1.0)?).friction(0.3);
    /// let body = RigidBody::dynamic().outline(&boomerang, &material)?;
    /// assert_eq!(body.shapes.len(), 2);
    /// # Ok::<(), tiny_physics::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Polygon::decompose`](crate::Polygon::decompose).
    pub fn outline(mut self, outline: &[Vec2], like: &ShapeDef) -> Result<Self, Error> {
        self.shapes.extend(like.pieces(outline)?);
        Ok(self)
    }
}

impl World {
    /// Adds the convex pieces of an outline, which may be concave, to a body as copies of a shape: see
    /// [`ShapeDef::pieces`]. Gives their handles.
    ///
    /// # Errors
    /// The handle is stale, or the points make no outline. Nothing has been added then.
    pub fn add_outline(
        &mut self,
        body: BodyId,
        outline: &[Vec2],
        like: &ShapeDef,
    ) -> Result<Vec<ShapeId>, Error> {
        self.add_shapes(body, &like.pieces(outline)?)
    }
}

fn no_area(index: usize) -> Error {
    let reason = "an outline needs 3 points that are apart and not on one line";
    Error::BadPoints { reason, index }
}

/// An outline that crosses itself nowhere, anticlockwise, without straight corners.
struct Ring {
    corners: Vec<Corner>,
    /// Which point of the outline each corner is.
    points: Vec<usize>,
}

impl Ring {
    fn new(outline: &[Vec2]) -> Result<Self, Error> {
        let grid = to_grid(outline);
        let mut points: Vec<usize> = (0..outline.len()).collect();
        remove_straight(&grid, &mut points)?;
        if points.len() < 3 {
            return Err(no_area(points.len()));
        }
        if area(&grid, &points) < 0 {
            points.reverse();
        }
        let corners: Vec<Corner> = points.iter().map(|&i| grid[i]).collect();
        let ring = Self { corners, points };
        match ring.crossing() {
            None => Ok(ring),
            Some(i) => {
                let reason = "edges of the outline cross or touch";
                Err(Error::BadPoints { reason, index: ring.points[i] })
            }
        }
    }

    /// The first edge that shares a point with one that is not next to it.
    fn crossing(&self) -> Option<usize> {
        let count = self.corners.len();
        let edge = |i: usize| [self.corners[i], self.corners[(i + 1) % count]];
        (0..count).find(|&i| {
            let last = if i == 0 { count - 1 } else { count };
            (i + 2..last).any(|k| share_point(edge(i), edge(k)))
        })
    }
}

/// The points on the grid.
fn to_grid(outline: &[Vec2]) -> Vec<Corner> {
    let numbers = || outline.iter().flat_map(|p| [p.x, p.y]).map(|x| f64::from(x.abs()));
    let largest = numbers().fold(0.0, |a, b| if b > a { b } else { a });
    // A power of two, so that numbers between half of it and itself stay as they are.
    let mut size = 1.0;
    while size < largest {
        size *= 2.0;
    }
    while size > 1.0e-6 && size * 0.5 >= largest {
        size *= 0.5;
    }
    let step = |x: f32| (f64::from(x) * (STEPS / size)) as i64;
    outline.iter().map(|p| [step(p.x), step(p.y)]).collect()
}

/// Takes out points that repeat the one before and points on the line between their neighbours.
fn remove_straight(grid: &[Corner], points: &mut Vec<usize>) -> Result<(), Error> {
    let mut i = 0;
    let mut unchanged = 0;
    while points.len() >= 3 && unchanged < points.len() {
        let count = points.len();
        i %= count;
        let [a, b, c] = [i + count - 1, i, i + 1].map(|k| grid[points[k % count]]);
        if a == b || (turn(a, b, c) == 0 && ahead(a, b, c) >= 0) {
            points.remove(i);
            unchanged = 0;
            i = (i + count - 2) % (count - 1);
        } else if turn(a, b, c) == 0 {
            let reason = "the outline runs back on itself";
            return Err(Error::BadPoints { reason, index: points[i] });
        } else {
            unchanged += 1;
            i += 1;
        }
    }
    Ok(())
}

/// Twice the area of the triangle, positive where it goes round anticlockwise: at most 2^51.
fn turn(a: Corner, b: Corner, c: Corner) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Above 0 where the way from B to C goes on in the direction from A to B.
fn ahead(a: Corner, b: Corner, c: Corner) -> i64 {
    (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1])
}

fn length_sq(a: Corner, b: Corner) -> i64 {
    let [x, y] = [b[0] - a[0], b[1] - a[1]];
    x * x + y * y
}

/// Twice the area, positive where the points go round anticlockwise.
fn area(grid: &[Corner], points: &[usize]) -> i128 {
    let first = grid[points[0]];
    points.windows(2).map(|w| i128::from(turn(first, grid[w[0]], grid[w[1]]))).sum()
}

/// Do two segments with ends that differ have a point in common?
fn share_point([a, b]: [Corner; 2], [c, d]: [Corner; 2]) -> bool {
    let apart = |k: usize| a[k].max(b[k]) < c[k].min(d[k]) || c[k].max(d[k]) < a[k].min(b[k]);
    if apart(0) || apart(1) {
        return false;
    }
    let sides = |a, b, c, d| turn(a, b, c).signum() * turn(a, b, d).signum();
    sides(a, b, c, d) <= 0 && sides(c, d, a, b) <= 0
}

/// Triangles by their corners, and the cuts between them. `None` where no ear is left, which only an outline
/// that crosses itself can bring about.
type Triangles = (Vec<Vec<usize>>, Vec<[usize; 2]>);

fn cut_ears(corners: &[Corner]) -> Option<Triangles> {
    let mut left: Vec<usize> = (0..corners.len()).collect();
    let (mut pieces, mut cuts) = (Vec::new(), Vec::new());
    let mut ears: Vec<Option<f64>> = (0..left.len()).map(|k| ear(corners, &left, k)).collect();
    while left.len() > 3 {
        let k = roundest(&ears)?;
        let count = left.len();
        let [a, b, c] = [k + count - 1, k, k + 1].map(|k| left[k % count]);
        pieces.push(vec![a, b, c]);
        cuts.push([a, c]);
        let [before, after] = [(k + count - 1) % count, (k + 1) % count];
        let reflex = |left: &[usize], k: usize| turn_at(corners, left, k) <= 0;
        let were = [reflex(&left, before), reflex(&left, after)];
        left.remove(k);
        ears.remove(k);
        let shifted = [before, after].map(|i| if i > k { i - 1 } else { i });
        if shifted.map(|i| reflex(&left, i)) == were {
            shifted.into_iter().for_each(|i| ears[i] = ear(corners, &left, i));
        } else {
            // A corner that is no longer reflex does not stand in the way of other ears.
            ears = (0..left.len()).map(|k| ear(corners, &left, k)).collect();
        }
    }
    pieces.push(left);
    Some((pieces, cuts))
}

/// The first of the ears that are worth most.
fn roundest(ears: &[Option<f64>]) -> Option<usize> {
    let mut best: Option<(usize, f64)> = None;
    for (k, worth) in ears.iter().enumerate() {
        if let Some(worth) = worth
            && best.is_none_or(|(_, most)| *worth > most)
        {
            best = Some((k, *worth));
        }
    }
    best.map(|(k, _)| k)
}

fn turn_at(corners: &[Corner], left: &[usize], k: usize) -> i64 {
    let count = left.len();
    let [a, b, c] = [k + count - 1, k, k + 1].map(|k| corners[left[k % count]]);
    turn(a, b, c)
}

/// How round the ear at a corner is, if there is one: area over the square of the longest side. Only
/// corners that are not convex can lie in its triangle first.
fn ear(corners: &[Corner], left: &[usize], k: usize) -> Option<f64> {
    let count = left.len();
    let around = [k + count - 1, k, k + 1].map(|k| k % count);
    let [a, b, c] = around.map(|k| corners[left[k]]);
    let area = turn(a, b, c);
    if area <= 0 {
        return None;
    }
    let inside = |p: Corner| turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
    let free = (0..count)
        .all(|m| around.contains(&m) || !inside(corners[left[m]]) || turn_at(corners, left, m) > 0);
    let longest = length_sq(a, b).max(length_sq(b, c)).max(length_sq(c, a));
    free.then_some(area as f64 / longest as f64)
}

/// Joins pieces over cuts where the result is convex and has no more than 8 corners.
fn join(corners: &[Corner], pieces: &mut Vec<Vec<usize>>, mut cuts: Vec<[usize; 2]>) {
    cuts.sort_by_key(|&[a, b]| core::cmp::Reverse(length_sq(corners[a], corners[b])));
    for [a, b] in cuts {
        let find = |from: usize, to: usize| {
            pieces.iter().enumerate().find_map(|(i, piece)| {
                let next = |k: usize| piece[(k + 1) % piece.len()];
                let at = piece.iter().position(|&corner| corner == from)?;
                (next(at) == to).then_some((i, at))
            })
        };
        let (Some((one, at_one)), Some((two, at_two))) = (find(a, b), find(b, a)) else { continue };
        // From B to before A round the one, from A to before B round the other.
        let round = |piece: &[usize], at: usize| {
            let count = piece.len();
            (0..count - 1).map(|k| piece[(at + 1 + k) % count]).collect::<Vec<usize>>()
        };
        let mut joined = round(&pieces[one], at_one);
        joined.extend(round(&pieces[two], at_two));
        let turns = || (0..joined.len()).map(|k| turn_at(corners, &joined, k));
        let real = turns().filter(|&turn| turn > 0).count();
        if turns().all(|turn| turn >= 0) && real <= MAX_VERTICES {
            pieces[one] = joined;
            pieces.remove(two);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Rot, Shape};
    use proptest::prelude::*;

    fn points(list: &[(f32, f32)]) -> Vec<Vec2> {
        list.iter().copied().map(Vec2::from).collect()
    }

    /// Area within an outline, positive where it goes round anticlockwise.
    fn area_of(outline: &[Vec2]) -> f64 {
        let next = |i: usize| outline[(i + 1) % outline.len()];
        let cross =
            |a: Vec2, b: Vec2| f64::from(a.x) * f64::from(b.y) - f64::from(a.y) * f64::from(b.x);
        0.5 * (0..outline.len()).map(|i| cross(outline[i], next(i))).sum::<f64>()
    }

    /// Is a point within an outline (crossing number), and how far is it from the outline?
    fn place(outline: &[Vec2], point: Vec2) -> (bool, f32) {
        let (mut inside, mut distance) = (false, f32::MAX);
        for (i, &a) in outline.iter().enumerate() {
            let b = outline[(i + 1) % outline.len()];
            if (a.y > point.y) != (b.y > point.y)
                && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)
            {
                inside = !inside;
            }
            let (way, t) = (b - a, (point - a).dot(b - a) / (b - a).length_sq());
            distance = distance.min(point.distance(a + way * t.clamp(0.0, 1.0)));
        }
        (inside, distance)
    }

    /// Pieces are corners of the outline, convex (by construction of [`Polygon`]), fill its area, and
    /// hold the same points.
    fn check(outline: &[Vec2]) -> Vec<Polygon> {
        let pieces = Polygon::decompose(outline).unwrap();
        let area: f64 = pieces.iter().map(|piece| area_of(piece.vertices())).sum();
        let expected = area_of(outline).abs();
        assert!((area - expected).abs() < 1e-3 * expected + 1e-3, "{area} of {expected}");
        for piece in &pieces {
            assert!(piece.vertices().iter().all(|v| outline.contains(v)));
            assert_eq!(Polygon::convex(piece.vertices()).unwrap(), *piece);
        }
        let shapes: Vec<Shape> = pieces.iter().map(|p| (*p).into()).collect();
        let size = outline.iter().map(|p| p.length()).fold(0.0, f32::max);
        for i in 0..200 {
            let spread = |step: f32| (i as f32 * step).fract() * 2.0 - 1.0;
            let point = Vec2::new(spread(0.618_034), spread(0.754_877_7)) * size;
            let (inside, distance) = place(outline, point);
            if distance > 1e-3 * size {
                let found = shapes.iter().filter(|shape| shape.contains(point)).count();
                assert_eq!(found > 0, inside, "{point:?} is in {found} pieces");
            }
        }
        pieces
    }

    #[test]
    fn known_outlines_have_few_pieces() {
        let square = points(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
        assert_eq!(check(&square).len(), 1);
        let angle = [(0.0, 0.0), (3.0, 0.0), (3.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)];
        assert_eq!(check(&points(&angle)).len(), 2);
        let mut clockwise = points(&angle);
        clockwise.reverse();
        assert_eq!(check(&clockwise).len(), 2);
        let closed: Vec<Vec2> = clockwise.iter().chain(&clockwise[..1]).copied().collect();
        assert_eq!(check(&closed).len(), 2);
        let cross: Vec<Vec2> = (0..4)
            .flat_map(|i| {
                let turn = Rot::from_angle(i as f32 * core::f32::consts::FRAC_PI_2);
                points(&[(3.0, -1.0), (3.0, 1.0), (1.0, 1.0)])
                    .into_iter()
                    .map(move |p| turn.rotate(p))
            })
            .collect();
        assert!(check(&cross).len() <= 5);
        let straight =
            points(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (0.0, 1.0)]);
        assert_eq!(check(&straight).len(), 1);
    }

    #[test]
    fn round_outlines_keep_to_eight_corners() {
        let circle: Vec<Vec2> = (0..64)
            .map(|i| Rot::from_angle(i as f32 / 64.0 * core::f32::consts::TAU).x_axis() * 3.0)
            .collect();
        let pieces = check(&circle);
        assert!((62_usize.div_ceil(6)..=30).contains(&pieces.len()), "{} pieces", pieces.len());
    }

    #[test]
    fn combs_and_spirals() {
        let mut comb = points(&[(40.0, -1.0), (0.0, -1.0)]);
        for i in 0..20 {
            comb.extend(points(&[(2.0 * i as f32, 3.0), (2.0 * i as f32 + 1.0, 0.0)]));
        }
        comb.pop();
        assert!(check(&comb).len() <= 40);
        let arm = |radius: f32| {
            (0..60).map(move |i| {
                let angle = 0.2 * i as f32;
                Rot::from_angle(angle).x_axis() * (radius + 0.2 * angle)
            })
        };
        let spiral: Vec<Vec2> = arm(1.0).chain(arm(0.6).rev()).collect();
        check(&spiral);
        let far: Vec<Vec2> = spiral.iter().map(|p| *p + Vec2::new(500.0, -300.0)).collect();
        assert_eq!(
            Polygon::decompose(&far).unwrap().len(),
            Polygon::decompose(&spiral).unwrap().len()
        );
    }

    #[test]
    fn what_is_no_outline_is_refused() {
        let bad = [
            points(&[]),
            points(&[(0.0, 0.0), (1.0, 0.0)]),
            points(&[(1.0, 1.0); 6]),
            points(&[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0), (5.0, 5.0)]),
            // Crosses itself; touches itself; runs back.
            points(&[(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0)]),
            points(&[(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (2.0, 0.0), (0.0, 3.0)]),
            points(&[(0.0, 0.0), (4.0, 0.0), (2.0, 0.0), (2.0, 3.0)]),
            points(&[(0.0, 0.0), (1.0, f32::NAN), (0.0, 1.0)]),
            points(&[(0.0, 0.0), (1.0e7, 0.0), (0.0, 1.0)]),
            points(&[(0.0, 0.0), (1.0e-9, 0.0), (0.0, 1.0e-9)]),
        ];
        for outline in bad {
            assert!(Polygon::decompose(&outline).is_err(), "{outline:?}");
        }
        let bow = points(&[(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0)]);
        let error = Polygon::decompose(&bow).unwrap_err().to_string();
        assert_eq!(error, "edges of the outline cross or touch (at point 0)");
    }

    proptest! {
        #[test]
        fn stars_of_any_shape(
            radii in prop::collection::vec(0.3_f32..4.0, 3..40),
            reversed: bool,
        ) {
            let count = radii.len() as f32;
            let mut star: Vec<Vec2> = radii
                .iter()
                .enumerate()
                .map(|(i, radius)| {
                    Rot::from_angle(i as f32 / count * core::f32::consts::TAU).x_axis() * *radius
                })
                .collect();
            if reversed {
                star.reverse();
            }
            let pieces = check(&star);
            // Each reflex corner needs at most two cuts, and eight corners are the limit.
            let reflex = (0..star.len()).filter(|&i| {
                let [a, b, c] = [i + star.len() - 1, i, i + 1].map(|k| star[k % star.len()]);
                ((b - a).cross(c - b) > 0.0) == reversed
            });
            let most = (2 * reflex.count() + 1).max(star.len().div_ceil(3));
            prop_assert!(pieces.len() <= most, "{} pieces", pieces.len());
        }

        /// Random loops cross themselves or are cut up properly.
        #[test]
        fn any_points_are_cut_up_or_refused(
            raw in prop::collection::vec((-4_i8..4, -4_i8..4), 3..9),
            scale in 0.01_f32..100.0,
        ) {
            let outline: Vec<Vec2> =
                raw.iter().map(|&(x, y)| Vec2::new(f32::from(x), f32::from(y)) * scale).collect();
            if Polygon::decompose(&outline).is_ok() && area_of(&outline).abs() > 0.1 {
                check(&outline);
            }
        }
    }
}
