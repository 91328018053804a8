//! Fixed time steps out of uneven frames.

/// Turns real elapsed time into whole steps of one length, so that behaviour does not depend on the
/// frame rate.
///
/// ```
/// use tiny_physics::FixedStep;
/// let mut clock = FixedStep::new(1.0 / 60.0);
/// assert_eq!(clock.advance(0.040), 2);
/// assert!((clock.alpha() - 0.4).abs() < 1e-4);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FixedStep {
    dt: f32,
    max_steps: u32,
    accumulator: f64,
}

impl FixedStep {
    /// A clock with steps of `dt` seconds and at most 8 steps a frame. A `dt` that is not finite or not
    /// above 0 counts as 1/60.
    pub fn new(dt: f32) -> Self {
        let dt = if dt.is_finite() && dt > 0.0 { dt } else { 1.0 / 60.0 };
        Self { dt, max_steps: 8, accumulator: 0.0 }
    }

    /// Allows at most this many steps (at least 1) a frame. Time beyond is dropped: the world slows
    /// down instead of the game spiralling to a halt.
    pub fn max_steps(mut self, max_steps: u32) -> Self {
        self.max_steps = max_steps.max(1);
        self
    }

    /// Length of a step, seconds.
    pub fn dt(&self) -> f32 {
        self.dt
    }

    /// Takes in the seconds since the last call; gives the number of steps to make now. Negative and
    /// non-finite times count as 0.
    pub fn advance(&mut self, elapsed: f32) -> u32 {
        let dt = f64::from(self.dt);
        if elapsed.is_finite() && elapsed > 0.0 {
            self.accumulator += f64::from(elapsed);
        }
        // A millionth of a step of rounding must not cost a step.
        let steps = (self.accumulator / dt + 1.0e-6) as u64;
        let allowed = steps.min(u64::from(self.max_steps));
        if steps > allowed {
            self.accumulator = 0.0;
        } else {
            self.accumulator = (self.accumulator - allowed as f64 * dt).max(0.0);
        }
        allowed as u32
    }

    /// How far the present lies between the last step (0) and the next (1): the factor to
    /// interpolate drawn positions with.
    pub fn alpha(&self) -> f32 {
        ((self.accumulator / f64::from(self.dt)) as f32).min(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_of_steps_does_not_depend_on_the_frame_rate() {
        for frames_per_second in [30, 60, 75, 144, 240] {
            let mut clock = FixedStep::new(1.0 / 60.0);
            let mut steps = 0;
            for _ in 0..frames_per_second * 10 {
                steps += clock.advance(1.0 / frames_per_second as f32);
            }
            assert!((599..=600).contains(&steps), "{frames_per_second}: {steps}");
        }
    }

    #[test]
    fn a_frame_can_have_no_step() {
        let mut clock = FixedStep::new(0.1);
        assert_eq!(clock.advance(0.04), 0);
        assert!((clock.alpha() - 0.4).abs() < 1e-5);
        assert_eq!(clock.advance(0.07), 1);
        assert!((clock.alpha() - 0.1).abs() < 1e-5);
    }

    #[test]
    fn a_long_frame_is_cut() {
        let mut clock = FixedStep::new(0.01).max_steps(5);
        assert_eq!(clock.advance(10.0), 5);
        assert_eq!(clock.advance(0.0), 0);
        assert_eq!(clock.alpha(), 0.0);
    }

    #[test]
    fn hostile_times_count_as_nothing() {
        let mut clock = FixedStep::new(f32::NAN);
        assert_eq!(clock.dt(), 1.0 / 60.0);
        for elapsed in [f32::NAN, f32::INFINITY, -1.0] {
            assert_eq!(clock.advance(elapsed), 0);
        }
    }
}
