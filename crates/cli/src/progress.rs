//! How far a run is.

use indicatif::{ProgressBar, ProgressStyle};
use std::io::{IsTerminal, stderr};
use std::time::{Duration, Instant};

/// A progress bar that appears on a terminal when a run takes longer than a moment.
pub struct Progress {
    bar: ProgressBar,
    start: Instant,
    allowed: bool,
}

impl Progress {
    const PATIENCE: Duration = Duration::from_millis(700);

    /// For so many steps.
    pub fn new(steps: u32) -> Self {
        let style = ProgressStyle::with_template("{bar:40} {pos}/{len} steps, {eta} left");
        let bar = ProgressBar::new(u64::from(steps));
        bar.set_draw_target(indicatif::ProgressDrawTarget::hidden());
        if let Ok(style) = style {
            bar.set_style(style);
        }
        Self { bar, start: Instant::now(), allowed: stderr().is_terminal() }
    }

    /// A step has been made.
    pub fn at(&self, step: u32) {
        if !self.allowed || self.start.elapsed() < Self::PATIENCE {
            return;
        }
        if self.bar.is_hidden() {
            self.bar.set_draw_target(indicatif::ProgressDrawTarget::stderr());
        }
        self.bar.set_position(u64::from(step) + 1);
    }

    /// The end.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}
