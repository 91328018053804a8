//! What the last step did and how long it took.

/// The stages of a step that are timed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Stage {
    /// Finding pairs whose boxes overlap, creating and dropping contacts.
    Pairs,
    /// Computing manifolds and contact constraints.
    NarrowPhase,
    /// Contacts that begin and end; waking.
    Touching,
    /// Integrating and solving, all substeps.
    Solve,
    /// Taking motion over into poses and boxes.
    Finalize,
    /// Sweeping fast bodies.
    Continuous,
    /// Sensors and sleep.
    Sleep,
}

impl Stage {
    /// All stages in their order in a step.
    pub const ALL: [Self; 7] = [
        Self::Pairs,
        Self::NarrowPhase,
        Self::Touching,
        Self::Solve,
        Self::Finalize,
        Self::Continuous,
        Self::Sleep,
    ];

    /// The name used in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pairs => "pairs",
            Self::NarrowPhase => "narrow_phase",
            Self::Touching => "touching",
            Self::Solve => "solve",
            Self::Finalize => "finalize",
            Self::Continuous => "continuous",
            Self::Sleep => "sleep",
        }
    }
}

/// Times and counts of the last step. Not part of the world's state: never saved, hashed or
/// compared.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Stats {
    pub(crate) timed: bool,
    pub(crate) seconds: [f64; Stage::ALL.len()],
    /// Length of the last step, seconds.
    pub dt: f32,
    /// Pairs of shapes that came near and became contacts.
    pub candidate_pairs: usize,
    /// Shapes that left their fat boxes.
    pub moved_shapes: usize,
    /// Contacts that began touching.
    pub contacts_begun: usize,
    /// Contacts that were made before the shapes met, because they close in fast.
    pub predicted_contacts: usize,
    /// Light bodies that heavy ones pressed against what nothing moves, or lay on: in the last step they counted as half as heavy
    /// as those, and so do the impulses of their contacts.
    pub squeezed_bodies: usize,
    /// Contacts that ended.
    pub contacts_ended: usize,
    /// Bodies that were swept because they moved fast.
    pub fast_bodies: usize,
    /// Energy that joints and contacts would have added in the last step out of nothing, joules: it was withheld. More than
    /// crumbs, step after step, say that joints are asked for more than can be solved.
    pub withheld_energy: f64,
    /// Bodies whose numbers stopped being finite: they were stopped where they had last been.
    pub frozen_bodies: usize,
    /// Steps refused because the time step was not a positive finite number, since the world was made.
    pub refused_steps: u64,
    /// Forces, impulses and velocities that the user gave to bodies, and joints that were changed, since the world was made.
    pub pushes: u64,
    /// Calls that changed nothing because a number was not finite or beyond all measure, since the world was made:
    /// those that give no [`Error`](crate::Error).
    pub refused_numbers: u64,
    /// Bodies, shapes and joints that were asked for to be changed and are gone, since the world was made.
    pub stale_handles: u64,
}

impl Stats {
    /// Of a step in which nothing moved.
    pub(crate) fn rest(&mut self) {
        let Self { timed, dt, refused_steps, pushes, refused_numbers, stale_handles, .. } = *self;
        let counted = Self { timed, dt, refused_steps, pushes, refused_numbers, ..Self::default() };
        *self = Self { stale_handles, ..counted };
    }

    /// Seconds that a stage took; 0 where no clock is available, or [`World::time_stages`](super::World::time_stages) has
    /// not been asked for.
    pub fn seconds(&self, stage: Stage) -> f64 {
        self.seconds[stage as usize]
    }

    /// Seconds that the whole step took.
    pub fn total_seconds(&self) -> f64 {
        self.seconds.iter().sum()
    }
}

/// Measures stages where that has been asked for and there is a clock (not in wasm): reading it eight times takes a
/// fifth of a microsecond, which is a part of a small world's step.
pub(crate) struct Stopwatch {
    #[cfg(not(target_arch = "wasm32"))]
    last: Option<std::time::Instant>,
}

impl Stopwatch {
    #[allow(unused_variables, reason = "without a clock there is nothing to start")]
    pub(crate) fn start(stats: &Stats) -> Self {
        Self {
            #[cfg(not(target_arch = "wasm32"))]
            last: stats.timed.then(std::time::Instant::now),
        }
    }

    /// Books the time since the last call on a stage.
    #[allow(unused_variables, reason = "without a clock there is nothing to book")]
    pub(crate) fn lap(&mut self, stats: &mut Stats, stage: Stage) {
        #[cfg(not(target_arch = "wasm32"))]
        if let Some(last) = &mut self.last {
            let now = std::time::Instant::now();
            stats.seconds[stage as usize] = (now - *last).as_secs_f64();
            *last = now;
        }
    }
}
