//! Coefficients of springs and of what is held rigid, for a substep length.

use crate::describe::{JointDef, Spring};
use crate::dynamics::SoftLanes;
use crate::stages::contact_solver::Softness;
use core::cell::Cell;

/// `push`, `mass_scale`, `impulse_scale` and `ease` of [`SoftLanes`].
pub(super) type Coefficients = [f32; 4];

/// Stiffness of what joints hold rigid, hertz; at most a quarter of the substep rate.
const RIGID_HERTZ: f32 = 60.0;
/// Its damping ratio.
const RIGID_DAMPING_RATIO: f32 = 2.0;
/// Springs and rigid parts act as if at most this fraction of the substep rate, whatever softness is asked for: at 0.3 trusses shake
/// for ever, at 0.4 three welds in a row do.
pub(super) const MAX_RATE_FRACTION: f32 = 0.25;
/// What joints hold rigid to a body that does not move, as a fraction of the substep rate.
const ANCHORED_RATE_FRACTION: f32 = 1.5;
/// In [`SoftLanes::rigid`], what is held as softly as the user asks.
pub(super) const ASKED: f32 = 2.0;
/// Damping ratios beyond act as this one: the rest is rounding.
const MAX_DAMPING_RATIO: f32 = 1.0e4;

/// What descriptions have to know of the step.
pub(super) struct Rates {
    /// Substep length, seconds.
    pub(super) h: f32,
    /// Relax passes in it: a power of two.
    rounds: u32,
    rigid: Coefficients,
    /// Hertz that what is held rigid has at most.
    stiffest: f32,
    /// How many springs like those of the joint at hand act on its bodies.
    pub(super) crowd: Cell<f32>,
    /// The spring that was asked for last, in such a crowd: neighbours are often alike, and exponentials are dear.
    last: Cell<Option<(Spring, f32, Coefficients)>>,
}

impl Rates {
    pub(super) fn new(h: f32, rounds: u32) -> Self {
        Self::with(h, rounds, RIGID_HERTZ, MAX_RATE_FRACTION / h)
    }

    /// The same for joints of which one body does not move: no other joint can be in their way at that
    /// end, and pendulums keep their height.
    pub(super) fn anchored(h: f32, rounds: u32) -> Self {
        Self::with(h, rounds, f32::INFINITY, ANCHORED_RATE_FRACTION / h)
    }

    fn with(h: f32, rounds: u32, hertz: f32, stiffest: f32) -> Self {
        let spring = Spring { hertz: hertz.min(stiffest), damping_ratio: RIGID_DAMPING_RATIO };
        let (crowd, last) = (Cell::new(1.0), Cell::new(None));
        Self { h, rounds, rigid: softness(spring, h), stiffest, crowd, last }
    }

    /// Of what a joint holds rigid.
    pub(super) fn rigid(&self, def: &JointDef) -> Coefficients {
        def.softness.map_or(self.rigid, |spring| {
            softness(Spring { hertz: spring.hertz.min(self.stiffest), ..spring }, self.h)
        })
    }

    /// Of a spring; zeros for none.
    pub(super) fn spring(&self, spring: Option<Spring>) -> Coefficients {
        let Some(spring) = spring else { return [0.0; 4] };
        let crowd = self.crowd.get();
        match self.last.get() {
            Some((last, among, known)) if last == spring && among == crowd => known,
            _ => {
                let found = coefficients(spring, self.h, self.rounds, crowd);
                self.last.set(Some((spring, crowd, found)));
                found
            }
        }
    }

    /// Writes a rigid part or, if there is one, the spring in its place.
    pub(super) fn write(
        &self,
        def: &JointDef,
        spring: Option<Spring>,
        soft: &mut SoftLanes,
        lane: usize,
    ) {
        soft.write(lane, if spring.is_some() { self.spring(spring) } else { self.rigid(def) });
        let held = if def.softness.is_some() { ASKED } else { 1.0 };
        soft.rigid[lane] = if spring.is_some() { 0.0 } else { held };
    }
}

impl SoftLanes {
    pub(super) fn write(
        &mut self,
        lane: usize,
        [push, mass_scale, impulse_scale, ease]: Coefficients,
    ) {
        self.push[lane] = push;
        self.mass_scale[lane] = mass_scale;
        self.impulse_scale[lane] = impulse_scale;
        self.ease[lane] = ease;
    }
}

/// By implicit Euler: it damps more than asked, which suits a constraint that should not swing.
fn softness(spring: Spring, h: f32) -> Coefficients {
    let soft = Softness::new(spring.hertz, spring.damping_ratio.min(MAX_DAMPING_RATIO), h);
    [soft.bias_rate * soft.mass_scale, soft.mass_scale, soft.impulse_scale, 1.0]
}

/// The largest part of its way by which a substep pushes a spring back, `h b`: that of an undamped one of a seventh of the substeps'
/// rate. Nets of 4 and of 8 springs a knot and side rest with it; with 1 they swing up within seconds, with 2 within steps.
const MOST_CHANGE: f64 = 0.7;
/// From so much on it is damped more than asked.
const EASY: f64 = 0.4;
/// The same of all springs on a body together, and the largest part of its speed that they take before the way. Without the damping
/// bodies on many undamped springs gain up to half of their energy for a while.
const MOST_TOGETHER: f64 = 1.5;
const EASY_TOGETHER: f64 = 1.0;

/// A spring with the exact frequency and decay.
///
/// A substep of the damped spring, `v' = a v - b x; x' = x + h v'; v'' = (1 - e) v'`, has the characteristic polynomial
/// `z^2 - (1 + a (1 - e) - h b) z + a (1 - e)`. The motion `exp((-zeta +- i sqrt(1 - zeta^2)) w t)` sampled every h has
/// roots with product `P = exp(-2 zeta w h)` and sum `T = 2 exp(-zeta w h) cos(sqrt(1 - zeta^2) w h)` (cosh beyond
/// critical damping). So `a (1 - e) = P`, `h b = 1 - T + P`; in terms of the soft constraint `impulse_scale = a`,
/// `mass_scale = 1 - a`, `push = b`. Implicit Euler, which the field uses, damps a spring of 1 hertz and damping
/// ratio 0.1 by 13 % too much at 240 substeps a second.
///
/// `a = h b / (w h)^2` lets a constant load rest where it should. It is about half of the damping that so comes before
/// the way and half after it, which makes slow and fast swings of many springs right to second order: of a cloth of
/// 30 x 30 springs of 8 hertz that falls for half a minute the middle is within 0.1 m of where it should be; with all of
/// the damping before the way it was off by 5 m, and springs that bear something were too stiff by `zeta w h`.
///
/// The push follows the way at the start of the substep: with N equal springs on a body it is N times as large, which swings up where
/// `h b (1 - a^N) / (1 - a) > 2 (1 + a^N)`. So stiff springs are damped more than asked, from `h b = 0.4` on (a tenth of the
/// substeps' rate, without damping): with `1 - a = h b / 2` no number of them on one body swings up, and nets want half as much again.
/// Beyond [`MOST_CHANGE`] they swing up all the same. A single spring of an eighth of the rate so loses a quarter of its speed in a
/// substep; by implicit Euler it would lose a fifth.
///
/// Springs that do not act along one line take from each other what they keep from the substep before, and so swing up what no line of
/// springs would: eight of a sixth of the rate over half a turn by half in a substep. So all on a body together, of which each knows how
/// many there are, neither push nor damp by more than [`MOST_TOGETHER`]; what is left of the damping goes to the relax pass.
pub(super) fn coefficients(spring: Spring, h: f32, rounds: u32, crowd: f32) -> Coefficients {
    let hertz = spring.hertz.min(MAX_RATE_FRACTION / h);
    let zeta = f64::from(spring.damping_ratio.min(MAX_DAMPING_RATIO));
    let w = core::f64::consts::TAU * f64::from(hertz) * f64::from(h);
    let product = exp_minus(2.0 * zeta * w);
    let sum = if zeta < 1.0 {
        2.0 * exp_minus(zeta * w) * cos((1.0 - zeta * zeta).sqrt() * w)
    } else {
        let root = (zeta * zeta - 1.0).sqrt();
        // zeta - root without cancellation.
        exp_minus(w / (zeta + root)) + exp_minus(w * (zeta + root))
    };
    let asked = (1.0 - sum + product).min(MOST_CHANGE);
    let crowd = f64::from(crowd);
    let most = MOST_TOGETHER / crowd;
    let change = asked.min(most);
    let push = if change > 0.0 { change / f64::from(h) } else { 0.0 };
    let exact = asked / (w * w);
    let calm = 1.0 - (0.75 * change).min(2.5 * (asked - EASY.min(EASY_TOGETHER / crowd)));
    let kept = exact.clamp(product, 1.0).min(calm).max(1.0 - most);
    let product = product.min(kept);
    let eased = (0..rounds.ilog2()).fold(product / kept, |eased, _| eased.sqrt());
    [push as f32, (1.0 - kept) as f32, kept as f32, (1.0 - eased) as f32]
}

/// exp(-x) for x >= 0, by a series after halving; the same bits everywhere.
fn exp_minus(x: f64) -> f64 {
    const HALVINGS: i32 = 10;
    if x > 700.0 {
        return 0.0;
    }
    let y = -x / f64::from(1 << HALVINGS);
    let mut sum = 1.0;
    for k in (1..=12).rev() {
        sum = 1.0 + y / f64::from(k) * sum;
    }
    for _ in 0..HALVINGS {
        sum *= sum;
    }
    sum
}

/// cos(x) for x in [0, pi / 2].
fn cos(x: f64) -> f64 {
    let z = x * x;
    let mut sum = 1.0;
    for k in (1..=12).rev() {
        let k = f64::from(2 * k);
        sum = 1.0 - z / (k * (k - 1.0)) * sum;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_agree_with_the_platform() {
        for i in 0..=1000 {
            let x = f64::from(i) * 0.001 * core::f64::consts::FRAC_PI_2;
            assert!((cos(x) - x.cos()).abs() < 1e-14);
            let x = f64::from(i) * 0.05;
            assert!((exp_minus(x) / (-x).exp() - 1.0).abs() < 1e-12, "{x}");
        }
        assert_eq!(exp_minus(1e6), 0.0);
    }

    #[test]
    fn extreme_springs_stay_finite() {
        for hertz in [1e-30, 1e-3, 1.0, 1e3, f32::MAX] {
            for damping_ratio in [0.0, 0.3, 1.0, 10.0, f32::MAX] {
                for h in [1e-5, 1.0 / 240.0, 0.1] {
                    let spring = Spring { hertz, damping_ratio };
                    let def = JointDef::weld().softness(hertz, damping_ratio);
                    for value in coefficients(spring, h, 1, 1.0)
                        .into_iter()
                        .chain(Rates::new(h, 1).rigid(&def))
                    {
                        assert!(value.is_finite() && value >= 0.0, "{spring:?} {h}: {value}");
                    }
                }
            }
        }
    }
}
