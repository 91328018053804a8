//! A row of a suite, and how rows are found.

use crate::lab::{Lab, MakeSubject, Variant};
use crate::report::{Measure, Report};
use crate::{hard_rows, rows};

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

/// The rows of both suites.
pub fn all_rows() -> impl Iterator<Item = &'static Row> {
    rows().iter().chain(hard_rows())
}

/// The row of a name or number, of either suite.
pub fn find(name: &str) -> Option<&'static Row> {
    all_rows().find(|row| row.id.eq_ignore_ascii_case(name) || row.name == name)
}

/// The rows that the words of a command line stand for: numbers, names, `hard` for the hard suite, or the letter of one of
/// its families. No words are the first suite.
///
/// # Errors
/// The first word that means nothing.
pub fn resolve(words: &[String]) -> Result<Vec<&'static Row>, &str> {
    if words.is_empty() {
        return Ok(rows().iter().collect());
    }
    let mut found = Vec::new();
    for word in words {
        let before = found.len();
        match word.as_str() {
            "hard" => found.extend(hard_rows()),
            letter if letter.len() == 1 && letter.as_bytes()[0].is_ascii_alphabetic() => found
                .extend(hard_rows().iter().filter(|row| {
                    row.id.as_bytes()[0].eq_ignore_ascii_case(&letter.as_bytes()[0])
                })),
            _ => found.extend(find(word)),
        }
        if found.len() == before {
            return Err(word);
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_numbered_in_order_and_found() {
        for (i, row) in rows().iter().enumerate() {
            assert_eq!(row.id, (i + 1).to_string());
        }
        assert_eq!(rows().len(), 26);
        for row in all_rows() {
            assert_eq!(find(row.name).map(|row| row.id), Some(row.id), "names are told apart");
            assert_eq!(find(row.id).map(|row| row.name), Some(row.name));
        }
        assert!(find("no such row").is_none());
    }

    #[test]
    fn words_stand_for_rows() {
        let ids = |words: &[&str]| {
            let words: Vec<String> = words.iter().map(|&word| word.into()).collect();
            resolve(&words).map(|rows| rows.iter().map(|row| row.id).collect::<Vec<_>>()).ok()
        };
        assert_eq!(ids(&[]).map(|ids| ids.len()), Some(26));
        assert_eq!(ids(&["hard"]).map(|ids| ids.len()), Some(hard_rows().len()));
        assert_eq!(ids(&["m1", "stack"]), Some(vec!["M1", "6"]));
        assert!(ids(&["J"]).is_some_and(|ids| ids.iter().all(|id| id.starts_with('J'))));
        assert_eq!(ids(&["stack", "piramid"]), None);
    }
}
