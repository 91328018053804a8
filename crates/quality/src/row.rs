//! A row of a suite.

use crate::lab::{Lab, MakeSubject, Variant};
use crate::report::{Measure, Report};

/// A list of rows.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Suite {
    /// Scenes that any engine is tried with: numbers 1 to 26.
    First,
    /// Scenes in which engines fail: a letter for the family, and a number.
    Hard,
}

/// One row of a suite.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Its number, or its family's letter and a number.
    pub id: &'static str,
    /// Short name.
    pub name: &'static str,
    /// The suite that it is of.
    pub suite: Suite,
    /// Why other engines are not asked, where it is about something that only this engine has.
    pub alone: Option<&'static str>,
    pub(crate) play: fn(&mut Lab<'_>) -> Vec<Measure>,
}

/// `row_list![suite; "id" "name" function, "id" "name" function alone "reason", ...]`
macro_rules! row_list {
    ($suite:expr; $($id:literal $name:literal $play:path $(, alone $alone:literal)?);* $(;)?) => {
        &[$(Row {
            id: $id,
            name: $name,
            suite: $suite,
            alone: row_list!(@alone $($alone)?),
            play: $play,
        }),*]
    };
    (@alone) => { None };
    (@alone $alone:literal) => { Some($alone) };
}
pub(crate) use row_list;

impl Row {
    /// Plays the row. `awake` forbids all sleep: harder than an engine's defaults. `progress` is told of
    /// steps done and steps expected, now and then.
    ///
    /// In the hard suite the other variant may use up twice the target.
    pub fn run(
        &self,
        make: MakeSubject<'_>,
        variant: Variant,
        awake: bool,
        progress: &mut dyn FnMut(u64, u64),
    ) -> Report {
        let mut lab = Lab::new(make, (variant, awake), progress);
        let mut measures = (self.play)(&mut lab);
        if (self.suite, variant) == (Suite::Hard, Variant::Other) {
            measures = measures.into_iter().map(Measure::with_twice_the_target).collect();
        }
        Report::new(self.id, self.name, measures)
    }
}
