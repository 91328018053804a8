//! Time of impact of two shapes that move and turn.
//!
//! Conservative advancement (Mirtich 1996; van den Bergen 2003) with a bound of second order. At time t the
//! closest normal n separates the shapes. For the core point i of A and j of B let g be the gap along n
//! minus the target, and c the speed at which it closes now. Turning changes that speed by no more
//! than K = wa^2 Ra + wb^2 Rb (w turn over the step, R reach of the core from its centre of mass), so
//!
//! ```text
//! g(t + h) >= g - c h - K h^2 / 2   >= 0   for   h <= 2 g / (c + sqrt(c^2 + 2 K g))
//! ```
//!
//! The smallest such h over all pairs of points is safe: nothing can be passed, however thin or fast, and
//! it homes in as Newton's method does. The bound of first order, g / (n . (va - vb) + wa Ra + wb Rb), is
//! taken where it is larger: shapes that spin very fast.

use super::distance::{Closest, Distance, distance, distance_from};
use super::polygon::MAX_VERTICES;
use super::{Core, Shape, Sweep};
use crate::math::Vec2;

/// Limit of the search. Of a million random pairs that fly up to 8 m and turn up to 4 radians, 99.9 % ended
/// within 18 rounds and 23 took more than 64: shapes that graze each other while they spin.
const MAX_ITERATIONS: u32 = 128;
/// So many searches, one after the other, follow a cast.
const MAX_SEARCHES: u32 = 32;
/// Overlap that resting contacts keep, metres.
pub const LINEAR_SLOP: f32 = 0.005;
/// Closer to the target than this part of the slop is a hit.
const TOLERANCE: f32 = 0.1;
/// What comes no nearer than this part of the slop passes by.
const GRAZE: f32 = 0.1;
/// Rounding counts up to so many tolerances: ground of a hundred kilometres is not touched from ten centimetres away.
const ROUNDED: f32 = 4.0;

/// How a search for an impact ended.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ToiState {
    /// The shapes stay apart up to the greatest fraction.
    Separated,
    /// They come as close as the target at the fraction.
    Hit,
    /// They are as close already at the start: the contact solver's affair. The fraction is 0.
    Touching,
    /// The limit of the search, or sweeps that are not finite. Up to the fraction they stay apart; beyond it
    /// nothing is known.
    Limit,
}

/// When two moving shapes meet.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Toi {
    /// How the search ended.
    pub state: ToiState,
    /// Part of the step for which the shapes are known to stay apart, 0 to the greatest fraction.
    pub fraction: f32,
    /// Unit normal from A to B at the fraction, in the common frame of the sweeps.
    pub normal: Vec2,
    /// Middle between the closest points at the fraction, metres in the common frame.
    pub point: Vec2,
    /// Rounds that the search took, at most 128.
    pub iterations: u32,
}

/// The separation at which two shapes meet, metres: an overlap by the slop, as resting contacts have, where
/// the radii allow that; sharp shapes stop one slop apart, so that there is always a normal.
pub fn toi_target(a: &Shape, b: &Shape, slop: f32) -> f32 {
    target_of(a.core().radius + b.core().radius, slop)
}

fn target_of(radii: f32, slop: f32) -> f32 {
    let target = slop - radii;
    if target > -slop { target } else { -slop }
}

/// A separation that [`impact_within`] takes for a hit of shapes with such radii together, but for rounding.
pub(crate) fn hit_at(radii: f32, slop: f32) -> f32 {
    target_of(radii, slop) + 0.9 * TOLERANCE * slop
}

/// When two moving shapes meet, up to `max_fraction` of the step: [`time_of_impact_to`] with the target of
/// [`toi_target`] for [`LINEAR_SLOP`].
pub fn time_of_impact(
    a: &Shape,
    sweep_a: &Sweep,
    b: &Shape,
    sweep_b: &Sweep,
    max_fraction: f32,
) -> Toi {
    time_of_impact_to(a, sweep_a, b, sweep_b, max_fraction, toi_target(a, b, LINEAR_SLOP))
}

/// The same in another unit of length, to a tenth of the slop; none where they stay apart. The search begins at the
/// fraction `from`, up to where they are known to.
pub(crate) fn impact_within(
    a: &Shape,
    sweep_a: &Sweep,
    b: &Shape,
    sweep_b: &Sweep,
    (from, max_fraction): (f32, f32),
    slop: f32,
) -> Option<Toi> {
    let goal = Goal { max_fraction, target: toi_target(a, b, slop), tolerance: TOLERANCE * slop };
    let toi = search(&Moving::new(a, sweep_a), &Moving::new(b, sweep_b), goal, from);
    (toi.state != ToiState::Separated).then_some(toi)
}

/// Do two shapes stay apart between two fractions of the step, however closely they pass?
pub(crate) fn pass_by(
    [a, b]: [&Shape; 2],
    [sweep_a, sweep_b]: [&Sweep; 2],
    range: (f32, f32),
    slop: f32,
) -> bool {
    let (end, slop) = (range.1, GRAZE * slop);
    // Most do not, which their end shows.
    distance(a, b, sweep_b.at(end).relative_to(sweep_a.at(end))).separation > toi_target(a, b, slop)
        && impact_within(a, sweep_a, b, sweep_b, range, slop).is_none()
}

/// When two moving shapes come within `target` metres (separation, negative is overlap), up to
/// `max_fraction` of the step.
///
/// The target must be above minus the sum of the corner radii: deeper than that, a thin shape can be passed.
pub fn time_of_impact_to(
    a: &Shape,
    sweep_a: &Sweep,
    b: &Shape,
    sweep_b: &Sweep,
    max_fraction: f32,
    target: f32,
) -> Toi {
    let goal = Goal { max_fraction, target, tolerance: TOLERANCE * LINEAR_SLOP };
    search(&Moving::new(a, sweep_a), &Moving::new(b, sweep_b), goal, 0.0)
}

/// The same over the whole step, with as many rounds as a blade needs that turns closely by; none where they stay apart.
pub(crate) fn touch_within(
    a: &Shape,
    sweep_a: &Sweep,
    b: &Shape,
    sweep_b: &Sweep,
    target: f32,
) -> Option<Toi> {
    let goal = Goal { max_fraction: 1.0, target, tolerance: TOLERANCE * LINEAR_SLOP };
    let (a, b) = (Moving::new(a, sweep_a), Moving::new(b, sweep_b));
    let mut toi = search(&a, &b, goal, 0.0);
    for _ in 1..MAX_SEARCHES {
        if toi.state == ToiState::Limit {
            toi = search(&a, &b, goal, toi.fraction);
        }
    }
    (toi.state != ToiState::Separated).then_some(toi)
}

/// What is looked for: the first time, up to a fraction, at which a separation is the target's or closer to it than
/// the tolerance.
#[derive(Clone, Copy)]
struct Goal {
    max_fraction: f32,
    target: f32,
    tolerance: f32,
}

impl Goal {
    /// The separation that is a hit, as far as rounding can tell.
    fn touch(&self, a: &Moving<'_>, b: &Moving<'_>) -> f32 {
        let rounding = a.rounding() + b.rounding();
        let most = ROUNDED * self.tolerance;
        self.target + self.tolerance + if rounding < most { rounding } else { most }
    }

    fn is_finite(&self, a: &Moving<'_>, b: &Moving<'_>) -> bool {
        a.sweep.is_finite() && b.sweep.is_finite() && self.target.is_finite()
    }
}

fn search(a: &Moving<'_>, b: &Moving<'_>, goal: Goal, from: f32) -> Toi {
    let Goal { max_fraction, target, .. } = goal;
    let finite = goal.is_finite(a, b);
    let touch = goal.touch(a, b);
    let mut fraction = from;
    let mut closest = Closest::default();
    for iteration in 1..=MAX_ITERATIONS {
        let (core_a, core_b) = (a.at(fraction), b.at(fraction));
        let gap = distance_from(&core_a, &core_b, &mut closest);
        let end = |state, fraction| Toi::new(state, fraction, &gap, iteration);
        if !finite {
            return end(ToiState::Limit, 0.0);
        }
        if gap.separation <= touch {
            let state = if fraction == 0.0 { ToiState::Touching } else { ToiState::Hit };
            return end(state, fraction);
        }
        let step = safe_step(
            &a.along(&core_a, fraction, gap.normal),
            &b.along(&core_b, fraction, gap.normal),
            target,
            max_fraction - fraction,
        );
        if fraction + step >= max_fraction {
            return end(ToiState::Separated, max_fraction);
        }
        if iteration == MAX_ITERATIONS {
            return end(ToiState::Limit, fraction);
        }
        fraction += step;
    }
    unreachable!("the last round returns")
}

impl Toi {
    fn new(state: ToiState, fraction: f32, gap: &Distance, iterations: u32) -> Self {
        let point = (gap.point_a + gap.point_b) * 0.5;
        Self { state, fraction, normal: gap.normal, point, iterations }
    }
}

/// A core on its way.
struct Moving<'a> {
    core: Core,
    sweep: &'a Sweep,
    /// Greatest distance of a core point from the centre of mass.
    reach: f32,
}

impl<'a> Moving<'a> {
    fn new(shape: &Shape, sweep: &'a Sweep) -> Self {
        let core = shape.core();
        Self { core, sweep, reach: core.reach(sweep.local_center) }
    }

    fn at(&self, fraction: f32) -> Core {
        self.core.transformed(self.sweep.at(fraction))
    }

    /// What rounding makes of a place on this core, metres.
    fn rounding(&self) -> f32 {
        let start = self.sweep.start.abs();
        1.0e-6 * (self.reach + start.x + start.y + self.sweep.translation().length())
    }

    /// Places and speeds of the core points along the normal at a fraction of the step.
    fn along(&self, core: &Core, fraction: f32, normal: Vec2) -> Along {
        let center = self.sweep.start + self.sweep.translation() * fraction;
        let speed = normal.dot(self.sweep.translation());
        let mut along = Along {
            places: [0.0; MAX_VERTICES],
            speeds: [0.0; MAX_VERTICES],
            count: core.count,
            radius: core.radius,
            speed,
            turn_speed: self.sweep.angle.abs() * self.reach,
            turn_acceleration: self.sweep.angle * self.sweep.angle * self.reach,
        };
        for (i, point) in core.points().iter().enumerate() {
            along.places[i] = normal.dot(*point);
            along.speeds[i] = speed + self.sweep.angle * normal.dot((*point - center).perp());
        }
        along
    }
}

/// A moving core seen along a normal; speeds are metres a whole step.
struct Along {
    places: [f32; MAX_VERTICES],
    speeds: [f32; MAX_VERTICES],
    count: usize,
    radius: f32,
    /// Of the centre of mass.
    speed: f32,
    /// Greatest speed that turning adds to a point.
    turn_speed: f32,
    /// Greatest acceleration of a point by turning.
    turn_acceleration: f32,
}

/// Part of the step, at least `rest` where it is that, for which the gap along the normal certainly stays above the
/// target; see the top of the file.
fn safe_step(a: &Along, b: &Along, target: f32, rest: f32) -> f32 {
    let k = a.turn_acceleration + b.turn_acceleration;
    let offset = a.radius + b.radius + target;
    let (mut second_order, mut least_gap) = (rest, f32::INFINITY);
    for i in 0..a.count {
        for j in 0..b.count {
            let gap = b.places[j] - a.places[i] - offset;
            let closing = a.speeds[i] - b.speeds[j];
            // Most pairs of points are still apart by then.
            if gap <= 0.0 || gap < (closing + 0.5 * k * second_order) * second_order {
                second_order = time_to_close(gap, closing, k);
            }
            if gap < least_gap {
                least_gap = gap;
            }
        }
    }
    let first_order =
        time_to_close(least_gap, a.speed - b.speed + a.turn_speed + b.turn_speed, 0.0);
    if first_order > second_order { first_order } else { second_order }
}

/// The positive h of gap - closing h - k h^2 / 2 = 0; infinite where there is none, 0 where the gap is closed.
#[inline]
fn time_to_close(gap: f32, closing: f32, k: f32) -> f32 {
    if gap <= 0.0 {
        return 0.0;
    }
    let divisor = closing + (closing * closing + 2.0 * k * gap).sqrt();
    if divisor > 0.0 { 2.0 * gap / divisor } else { f32::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{any_frame, any_shape, any_vec};
    use super::super::{Polygon, distance};
    use super::*;
    use crate::math::{Rot, Transform};
    use proptest::prelude::*;

    fn moving(x: f32, y: f32, dx: f32, dy: f32, angle: f32) -> Sweep {
        let frame = Transform::new(Vec2::new(x, y), Rot::IDENTITY);
        Sweep::new(frame, Vec2::ZERO, Vec2::new(dx, dy), angle)
    }

    /// Smallest separation over the sweep, up to `end`, at evenly spaced times.
    fn least_gap(pair: [(&Shape, &Sweep); 2], end: f32, samples: usize) -> f32 {
        let [(a, sweep_a), (b, sweep_b)] = pair;
        (0..=samples)
            .map(|k| {
                let t = end * k as f32 / samples as f32;
                distance(a, b, sweep_b.at(t).relative_to(sweep_a.at(t))).separation
            })
            .fold(f32::INFINITY, f32::min)
    }

    #[test]
    fn a_ball_meets_a_wall() {
        let (ball, wall) =
            (Shape::circle(0.1).unwrap(), Shape::segment(-Vec2::Y, Vec2::Y).unwrap());
        let still = Sweep::default();
        let toi = time_of_impact(&wall, &still, &ball, &moving(-3.1, 0.0, 6.0, 0.0, 0.0), 1.0);
        assert_eq!((toi.state, toi.normal), (ToiState::Hit, -Vec2::X));
        assert!((toi.fraction - 0.5).abs() < 2e-3, "{toi:?}");
        assert!(toi.iterations <= 3);
        let past = time_of_impact(&wall, &still, &ball, &moving(-3.1, 0.0, -6.0, 0.0, 0.0), 1.0);
        assert_eq!((past.state, past.fraction), (ToiState::Separated, 1.0));
        let early = time_of_impact(&wall, &still, &ball, &moving(-3.1, 0.0, 6.0, 0.0, 0.0), 0.4);
        assert_eq!((early.state, early.fraction), (ToiState::Separated, 0.4));
        let inside = time_of_impact(&wall, &still, &ball, &moving(0.05, 0.0, 6.0, 0.0, 0.0), 1.0);
        assert_eq!((inside.state, inside.fraction), (ToiState::Touching, 0.0));
    }

    #[test]
    fn hostile_sweeps_end_at_once() {
        let ball = Shape::circle(0.1).unwrap();
        for bad in [f32::NAN, f32::INFINITY] {
            let toi = time_of_impact(
                &ball,
                &Sweep::default(),
                &ball,
                &moving(3.0, 0.0, bad, 0.0, 0.0),
                1.0,
            );
            assert_eq!((toi.state, toi.fraction), (ToiState::Limit, 0.0));
        }
    }

    #[test]
    fn fast_shots_never_pass_a_thin_wall() {
        let wall = Shape::segment(Vec2::new(0.0, -2.0), Vec2::new(0.0, 2.0)).unwrap();
        let shapes = [
            Shape::circle(0.002).unwrap(),
            Shape::circle(0.1).unwrap(),
            Shape::rect(0.1, 0.05).unwrap(),
            Shape::from(Polygon::rect(0.1, 0.02).unwrap().rounded(0.03).unwrap()),
            Shape::capsule(-Vec2::X * 0.2, Vec2::X * 0.2, 0.01).unwrap(),
            Shape::segment(-Vec2::X * 0.2, Vec2::X * 0.2).unwrap(),
        ];
        let (mut most, mut shots) = (0, 0);
        for shape in &shapes {
            for speed in 1..=40 {
                for spin in [-60.0, -7.0, 0.0, 0.5, 25.0] {
                    let (dx, angle) = (speed as f32 * 10.0 / 60.0, spin / 60.0);
                    let start = -0.25 - 0.37 * (dx - 0.5) * (dx > 1.0) as u8 as f32;
                    let shot = moving(start, 0.1, dx, 0.03 * dx, angle);
                    let toi = time_of_impact(&wall, &Sweep::default(), shape, &shot, 1.0);
                    shots += 1;
                    most = if toi.iterations > most { toi.iterations } else { most };
                    let reaches = start + dx > 0.0;
                    assert!(!reaches || toi.state == ToiState::Hit, "{shape:?} {shot:?} {toi:?}");
                }
            }
        }
        assert!(most <= 16, "{most} of {shots}");
    }

    fn any_sweep() -> impl Strategy<Value = Sweep> {
        (any_frame(2.5), any_vec(0.3), any_vec(6.0), -4.0_f32..4.0).prop_map(
            |(frame, center, translation, angle)| Sweep::new(frame, center, translation, angle),
        )
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]
        #[test]
        fn impacts_agree_with_fine_steps(
            a in any_shape(),
            b in any_shape(),
            sweep_a in any_sweep(),
            sweep_b in any_sweep(),
        ) {
            let target = toi_target(&a, &b, LINEAR_SLOP);
            let toi = time_of_impact(&a, &sweep_a, &b, &sweep_b, 1.0);
            match impact_within(&a, &sweep_a, &b, &sweep_b, (0.0, 1.0), LINEAR_SLOP) {
                Some(impact) => prop_assert_eq!(impact, toi),
                None => prop_assert!(matches!(toi.state, ToiState::Separated | ToiState::Limit)),
            }
            let pair = [(&a, &sweep_a), (&b, &sweep_b)];
            prop_assert!(toi.fraction >= 0.0 && toi.fraction <= 1.0);
            if toi.state != ToiState::Touching {
                prop_assert!(least_gap(pair, toi.fraction, 300) > target - 1e-4, "{toi:?}");
            }
            if toi.state == ToiState::Hit {
                let (fa, fb) = (sweep_a.at(toi.fraction), sweep_b.at(toi.fraction));
                let gap = distance(&a, &b, fb.relative_to(fa)).separation;
                prop_assert!((gap - target).abs() < 2.0 * TOLERANCE * LINEAR_SLOP, "{gap} {toi:?}");
            }
            if toi.state == ToiState::Limit {
                prop_assert!(least_gap(pair, toi.fraction, 300) < 0.02, "{toi:?}");
            }
        }
    }
}
