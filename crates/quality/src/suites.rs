//! Both suites, and how rows are found.

use crate::hard::hard_rows;
use crate::row::Row;
use crate::rows::rows;
use std::collections::BTreeSet;

/// The rows of both suites.
pub fn all_rows() -> impl Iterator<Item = &'static Row> {
    rows().iter().chain(hard_rows())
}

/// The row of a name or number, of either suite.
pub fn find(name: &str) -> Option<&'static Row> {
    all_rows().find(|row| row.id.eq_ignore_ascii_case(name) || row.name == name)
}

/// The rows that the words of a command line stand for, each once: numbers, names, or the letter of a family of the hard suite.
/// `hard` alone is all of that; no words are the first suite.
///
/// # Errors
/// The first word that means nothing.
pub fn resolve(words: &[String]) -> Result<Vec<&'static Row>, &str> {
    if words.is_empty() {
        return Ok(rows().iter().collect());
    }
    if words.iter().all(|word| word == "hard") {
        return Ok(hard_rows().iter().collect());
    }
    let mut found: Vec<&Row> = Vec::new();
    for word in words.iter().filter(|word| *word != "hard") {
        let before = found.len();
        match word.as_str() {
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
    let mut seen = BTreeSet::new();
    found.retain(|row| seen.insert(row.id));
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
        assert_eq!(ids(&["hard", "C8", "c8", "C2"]), Some(vec!["C8", "C2"]));
        assert_eq!(ids(&["stack", "piramid"]), None);
    }
}
