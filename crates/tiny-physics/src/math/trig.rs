//! Sine, cosine and arc tangent with the same bits on every platform.
//!
//! The standard library's versions come from the platform and differ in the last bit between
//! x86-64, aarch64 and wasm. These are polynomials over `+ - * /` in `f64`, rounded once to `f32`.
//!
//! Error bounds (checked by the tests below against the platform's `f64` functions): `sin`, `cos`
//! within 1e-7 for |x| <= 1e4 and within 1e-6 for |x| <= 1e6; `atan2` within 3e-7.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

/// Sine and cosine of an angle in radians. Both are 0 and 1 for an angle that is not finite.
#[inline]
pub fn sin_cos(radians: f32) -> (f32, f32) {
    if !radians.is_finite() {
        return (0.0, 1.0);
    }
    let x = f64::from(radians);
    // The remainder is exact by definition, so it too has the same bits everywhere.
    let x = if x.abs() > 1.0e6 { x % TAU } else { x };
    let turns = x * (1.0 / FRAC_PI_2);
    let quadrant = if turns < 0.0 { (turns - 0.5) as i64 } else { (turns + 0.5) as i64 };
    let r = x - quadrant as f64 * FRAC_PI_2;
    let (s, c) = sin_cos_small(r);
    let (s, c) = match quadrant & 3 {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    };
    (s as f32, c as f32)
}

/// Sine of an angle in radians.
#[inline]
pub fn sin(radians: f32) -> f32 {
    sin_cos(radians).0
}

/// Cosine of an angle in radians.
#[inline]
pub fn cos(radians: f32) -> f32 {
    sin_cos(radians).1
}

/// Taylor series on [-pi/4, pi/4]; the first term left out is below 1e-12.
#[inline]
fn sin_cos_small(r: f64) -> (f64, f64) {
    const SIN: [f64; 7] = series(1);
    const COS: [f64; 8] = series(0);
    let z = r * r;
    (r * horner(&SIN, z), horner(&COS, z))
}

/// The factors of r^first, r^(first + 2), ... in the series of sine (1) and cosine (0).
const fn series<const N: usize>(first: u32) -> [f64; N] {
    let mut factors = [1.0; N];
    let (mut i, mut power) = (1, first);
    while i < N {
        power += 2;
        factors[i] = -factors[i - 1] / (power * (power - 1)) as f64;
        i += 1;
    }
    factors
}

#[inline]
fn horner(factors: &[f64], z: f64) -> f64 {
    factors.iter().rev().fold(0.0, |sum, factor| sum * z + factor)
}

/// Angle of the vector (x, y) from the x axis in radians, in [-pi, pi]; 0 for the zero vector and
/// where a part is NaN.
#[inline]
pub fn atan2(y: f32, x: f32) -> f32 {
    let (ax, ay) = (f64::from(x.abs()), f64::from(y.abs()));
    let steep = ay > ax;
    let (small, large) = if steep { (ax, ay) } else { (ay, ax) };
    // Written so that NaN takes the way out too.
    if !(large > 0.0 && small >= 0.0) {
        return 0.0;
    }
    let ratio = if small == large { 1.0 } else { small / large };
    let angle = atan_unit(ratio);
    let angle = if steep { FRAC_PI_2 - angle } else { angle };
    let angle = if x < 0.0 { PI - angle } else { angle };
    (if y < 0.0 { -angle } else { angle }) as f32
}

/// Arc tangent on [0, 1]: halves the range once by the sum formula, then the Gregory series.
#[inline]
fn atan_unit(t: f64) -> f64 {
    const TAN_PI_8: f64 = 0.414_213_562_373_095_03;
    let (base, t) = if t > TAN_PI_8 { (FRAC_PI_4, (t - 1.0) / (t + 1.0)) } else { (0.0, t) };
    let z = t * t;
    let mut sum = 0.0;
    let mut k = 21.0;
    while k > 0.0 {
        sum = 1.0 / k - z * sum;
        k -= 2.0;
    }
    base + t * sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sine_and_cosine_keep_their_bounds() {
        for (range, bound) in [(10.0_f32, 1e-7), (1.0e4, 1e-7), (1.0e6, 1e-6)] {
            for i in -20_000..=20_000 {
                let x = range * i as f32 / 20_000.0;
                let (s, c) = sin_cos(x);
                assert!((f64::from(s) - f64::from(x).sin()).abs() < bound, "sin {x}");
                assert!((f64::from(c) - f64::from(x).cos()).abs() < bound, "cos {x}");
            }
        }
    }

    #[test]
    fn arc_tangent_keeps_its_bound_and_its_quadrants() {
        for i in -200..=200 {
            for j in -200..=200 {
                let (y, x) = (i as f32 * 0.37, j as f32 * 0.53);
                let expected = f64::from(y).atan2(f64::from(x));
                let expected = if i == 0 && j == 0 { 0.0 } else { expected };
                assert!((f64::from(atan2(y, x)) - expected).abs() < 3e-7, "{y} {x}");
            }
        }
    }

    #[test]
    fn hostile_angles_give_finite_answers() {
        for x in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN_POSITIVE] {
            let (s, c) = sin_cos(x);
            assert!(s.is_finite() && c.is_finite());
            assert!(atan2(x, 1.0).is_finite() && atan2(1.0, x).is_finite());
        }
        assert_eq!(atan2(f32::INFINITY, f32::INFINITY), core::f32::consts::FRAC_PI_4);
        assert_eq!(atan2(0.0, 0.0), 0.0);
    }
}
