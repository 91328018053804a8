//! Whether it pays to share work out: what the clock says. Results do not depend on it.
//!
//! A colour of a thousand contacts takes a core some microseconds, and handing bodies from one core to the other can take
//! longer than that; how long, only the machine knows. So work that goes on from step to step is now and then done the
//! other way, alone or shared, and from then on the way that took less time.

use super::Team;
use std::time::Instant;

/// Times before the other way is tried first, and again after a change.
const SOON: u32 = 16;
/// If it was slower, it is tried again after so many times as many,
const LATER: u32 = 4;
/// but not after more. So the slowest per cent of steps has few of them.
const LATEST: u32 = 1024;
/// How much of a new time goes into what is remembered.
const SHARE: f32 = 0.25;

/// What some work took lately.
#[derive(Clone, Debug)]
pub(crate) struct Habit {
    /// Nanoseconds for a unit of work, alone and shared; 0 is not known.
    takes: [f32; 2],
    /// Is it shared?
    shared: bool,
    /// Times until the other way is tried, and how many there were.
    left: u32,
    pause: u32,
    /// About how many units the work has had since it was tried first.
    amount: usize,
}

impl Default for Habit {
    fn default() -> Self {
        Self { takes: [0.0; 2], shared: true, left: SOON, pause: SOON, amount: 0 }
    }
}

impl Habit {
    /// Does work of so many units, with the team or without it.
    pub(crate) fn run<R>(
        &mut self,
        team: &Team<'_>,
        amount: usize,
        work: impl FnOnce(&Team<'_>) -> R,
    ) -> R {
        if team.member_count() == 1 || amount == 0 {
            return work(team);
        }
        // What has become twice as much or half is another work.
        if amount > 2 * self.amount || amount < self.amount / 2 {
            (self.amount, self.pause, self.left) = (amount, SOON, self.left.min(SOON));
        }
        let shared = self.next();
        let start = Instant::now();
        let result = if shared { work(team) } else { work(&Team::alone()) };
        self.note(shared, start.elapsed().as_nanos() as f32 / amount as f32);
        result
    }

    /// Is the next one shared?
    fn next(&mut self) -> bool {
        if self.left == 0 { !self.shared } else { self.shared }
    }

    /// Learns what a unit took.
    fn note(&mut self, shared: bool, took: f32) {
        let known = &mut self.takes[usize::from(shared)];
        let is_trial = shared != self.shared;
        *known = if is_trial || *known == 0.0 { took } else { *known + SHARE * (took - *known) };
        if !is_trial {
            self.left -= 1;
            return;
        }
        if took < self.takes[usize::from(self.shared)] {
            (self.shared, self.pause) = (shared, SOON);
        } else {
            self.pause = (self.pause * LATER).min(LATEST);
        }
        self.left = self.pause;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How many of so many times are shared, if alone and shared take so long.
    fn shared(habit: &mut Habit, times: u32, takes: [f32; 2]) -> u32 {
        (0..times).fold(0, |count, _| {
            let shared = habit.next();
            habit.note(shared, takes[usize::from(shared)]);
            count + u32::from(shared)
        })
    }

    #[test]
    fn what_takes_less_time_becomes_the_habit() {
        let mut habit = Habit::default();
        // Tried after 16, 64, 256 and 1024 more.
        assert_eq!(shared(&mut habit, 1000, [2.0, 1.0]), 997);
        // One that has become slower is given up at the next trial.
        assert_eq!(shared(&mut habit, 1500, [1.0, 2.0]), 364 + 2);
        assert!(!habit.shared);
    }

    #[test]
    fn a_caller_alone_reads_no_clock() {
        let mut habit = Habit::default();
        assert_eq!(habit.run(&Team::alone(), 5, |team| team.member_count()), 1);
        assert_eq!((habit.left, habit.takes), (SOON, [0.0; 2]));
    }
}
