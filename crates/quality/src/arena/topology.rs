//! Who is on which side of whom: has a body gone into the middle of another, or through it?
//!
//! Every shape has a spine, points deep inside it. A point of a spine that comes into another body's shape, or
//! whose way over a step leads through it, has passed its surface by half a thickness at least. The way is seen from
//! the other body, over quarters of a step, so that turning bodies do not seem to cut corners.

use crate::lab::Trial;
use tiny_physics::geometry::Ray;
use tiny_physics::{BodyKind, Shape, ShapeDef, Transform, Vec2};

/// Where a body is: position, metres, and angle.
type Place = (f64, f64, f64);

/// A point of a polygon's spine has so much of the thinner half of its box around it.
const DEEP: f32 = 0.3;

/// Looks at all pairs after each step.
pub(super) struct Sides {
    last: Vec<Option<Place>>,
    /// By pair, the greater body's row first: has one passed the other, or were they within each other at the start?
    seen: Vec<Vec<bool>>,
    passed: usize,
}

/// Parts of a step that ways are straight over.
const PARTS: usize = 4;

impl Sides {
    pub(super) fn new(trial: &Trial) -> Self {
        let mut sides = Self { last: Vec::new(), seen: Vec::new(), passed: 0 };
        sides.grow(trial);
        sides
    }

    /// Notes bodies that have come, and what is within each other from the start.
    pub(super) fn grow(&mut self, trial: &Trial) {
        for body in self.last.len()..trial.len() {
            self.last.push(place(trial, body));
            let within =
                |other: usize| !trial.collides(body, other) || trial.overlap(body, other) > 0.02;
            self.seen.push((0..body).map(within).collect());
        }
    }

    /// Pairs that have passed each other so far.
    pub(super) fn look(&mut self, trial: &Trial) -> usize {
        let now: Vec<Option<Place>> = (0..trial.len()).map(|body| place(trial, body)).collect();
        for a in 0..now.len() {
            for b in 0..a {
                if self.seen[a][b] {
                    continue;
                }
                let (Some(a0), Some(b0), Some(a1), Some(b1)) =
                    (self.last[a], self.last[b], now[a], now[b])
                else {
                    continue;
                };
                if near(trial, (a, a0, a1), (b, b0, b1))
                    && (goes_into(trial, (a, a0, a1), (b, b0, b1))
                        || goes_into(trial, (b, b0, b1), (a, a0, a1)))
                {
                    self.seen[a][b] = true;
                    self.passed += 1;
                }
            }
        }
        self.last = now;
        self.passed
    }
}

fn place(trial: &Trial, body: usize) -> Option<Place> {
    let p = trial.position(body);
    trial.is_there(body).then(|| (p.x, p.y, trial.angle(body)))
}

/// Can their ways over the step meet?
fn near(
    trial: &Trial,
    (a, a0, a1): (usize, Place, Place),
    (b, b0, b1): (usize, Place, Place),
) -> bool {
    let moved = ((a1.0 - a0.0) - (b1.0 - b0.0)).hypot((a1.1 - a0.1) - (b1.1 - b0.1));
    (a1.0 - b1.0).hypot(a1.1 - b1.1) < trial.reach(a) + trial.reach(b) + moved
}

/// Does a point of the first body's spine get into the second body's shapes on the way?
fn goes_into(
    trial: &Trial,
    (a, a0, a1): (usize, Place, Place),
    (b, b0, b1): (usize, Place, Place),
) -> bool {
    if trial.scene().bodies[a].kind == BodyKind::Static {
        return false;
    }
    trial.solid_pairs(a, b).any(|(own, other)| {
        spine(own).into_iter().any(|point| {
            let seen = |i: usize| {
                let share = i as f64 / PARTS as f64;
                local(between(b0, b1, share), world(between(a0, a1, share), point))
            };
            (0..PARTS).any(|i| crosses(other, seen(i), seen(i + 1)))
        })
    })
}

/// Does a way lead into a shape, both in the frame of the shape's body?
fn crosses(def: &ShapeDef, from: Vec2, to: Vec2) -> bool {
    let frame = Transform::from_angle(def.offset, def.angle);
    let (from, to) = (frame.unapply(from), frame.unapply(to));
    def.shape.contains(to) || def.shape.ray_cast(&Ray::new(from, to - from)).is_some()
}

/// A part of the way, turned the short way round.
fn between(from: Place, to: Place, share: f64) -> Place {
    use core::f64::consts::{PI, TAU};
    let turn = (to.2 - from.2 + PI).rem_euclid(TAU) - PI;
    (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1), from.2 + share * turn)
}

fn world((x, y, angle): Place, point: Vec2) -> (f64, f64) {
    let (s, c) = angle.sin_cos();
    let (px, py) = (f64::from(point.x), f64::from(point.y));
    (x + c * px - s * py, y + s * px + c * py)
}

fn local((x, y, angle): Place, (px, py): (f64, f64)) -> Vec2 {
    let (s, c) = angle.sin_cos();
    let (dx, dy) = (px - x, py - y);
    Vec2::new((c * dx + s * dy) as f32, (c * dy - s * dx) as f32)
}

/// Points deep inside a shape, in its body's frame; none of a segment, which has no inside.
fn spine(def: &ShapeDef) -> Vec<Vec2> {
    let points = match &def.shape {
        Shape::Circle { .. } => vec![Vec2::ZERO],
        Shape::Capsule { a, b, .. } => vec![*a, (*a + *b) * 0.5, *b],
        Shape::Segment { .. } => Vec::new(),
        other => {
            let bounds = other.aabb(Transform::IDENTITY);
            let (center, half) = ((bounds.min + bounds.max) * 0.5, (bounds.max - bounds.min) * 0.5);
            let out = match half {
                h if h.x > 1.5 * h.y => Vec2::new(h.x - h.y, 0.0),
                h if h.y > 1.5 * h.x => Vec2::new(0.0, h.y - h.x),
                _ => Vec2::ZERO,
            };
            // Corners of a triangle are not boxes' corners: only what is deep inside counts.
            let deep = DEEP * half.x.min(half.y);
            let around = [Vec2::X, -Vec2::X, Vec2::Y, -Vec2::Y];
            [center, center + out, center - out]
                .into_iter()
                .filter(|&p| around.iter().all(|&way| other.contains(p + way * deep)))
                .collect()
        }
    };
    let frame = Transform::from_angle(def.offset, def.angle);
    points.into_iter().map(|point| frame.apply(point)).collect()
}
