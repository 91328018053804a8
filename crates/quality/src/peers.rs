//! What other engines made of the rows: figures that `peers` has measured and written to `peers.json`.

use crate::{Measure, Report, Variant, all_rows};
use core::fmt;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

/// The command that measures the figures and writes them to `peers.json`, in the repository's root.
pub const COMMAND: &str = "cargo run --release --manifest-path peers/Cargo.toml -- quality --write";

/// What an engine made of one number of a row. In JSON a number or a text.
#[derive(Clone, PartialEq, Debug)]
pub enum Figure {
    /// The number.
    Value(f64),
    /// The scene fell apart: bodies were flung away or their numbers were none any more.
    Fell,
    /// The engine ended in the middle of it; how.
    Crashed(String),
    /// The engine cannot express the scene; why.
    Cannot(String),
}

const CRASHED: &str = "crashed: ";
const CANNOT: &str = "cannot: ";

impl Figure {
    /// The figure of a measured value, which is not finite where the scene fell apart.
    pub fn of(value: f64) -> Self {
        if value.is_finite() { Self::Value(value) } else { Self::Fell }
    }

    /// The value to hold against a target: infinite where there is none.
    pub fn value(&self) -> f64 {
        if let Self::Value(value) = *self { value } else { f64::INFINITY }
    }

    /// For a column of a table: five digits that matter, or a word.
    pub fn short(&self) -> String {
        match self {
            Self::Value(value) => digits(*value),
            Self::Fell => "fell".into(),
            Self::Crashed(_) => "crashed".into(),
            Self::Cannot(_) => "-".into(),
        }
    }
}

/// A number with the digits that matter.
pub fn digits(value: f64) -> String {
    match value.abs() {
        0.0 => "0".into(),
        size if size >= 10_000.0 => format!("{value:.0}"),
        size if size >= 1.0 => format!("{value:.3}"),
        size if size >= 0.000_1 => format!("{value:.5}"),
        _ => format!("{value:.1e}"),
    }
}

impl fmt::Display for Figure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Value(value) => write!(f, "{value}"),
            Self::Fell => f.write_str("fell"),
            Self::Crashed(how) => write!(f, "{CRASHED}{how}"),
            Self::Cannot(why) => write!(f, "{CANNOT}{why}"),
        }
    }
}

impl Serialize for Figure {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Value(value) => serializer.serialize_f64(*value),
            other => serializer.collect_str(other),
        }
    }
}

impl<'de> Deserialize<'de> for Figure {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum Cell {
            Number(f64),
            Text(String),
        }
        let text = match Cell::deserialize(deserializer)? {
            Cell::Number(value) => return Ok(Self::Value(value)),
            Cell::Text(text) => text,
        };
        if text == "fell" {
            Ok(Self::Fell)
        } else if let Some(how) = text.strip_prefix(CRASHED) {
            Ok(Self::Crashed(how.into()))
        } else if let Some(why) = text.strip_prefix(CANNOT) {
            Ok(Self::Cannot(why.into()))
        } else {
            Err(de::Error::custom(format!("'{text}' is no figure")))
        }
    }
}

/// What the other engines made of all rows.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Peers {
    /// Box2D's version.
    pub box2d: String,
    /// Rapier's version.
    pub rapier: String,
    /// The rows at their usual sizes.
    pub usual: Vec<PeerRow>,
    /// The rows in their other variant.
    pub other: Vec<PeerRow>,
}

/// One row.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct PeerRow {
    /// The row.
    pub id: String,
    /// Its numbers, in the order of the report.
    pub measures: Vec<PeerMeasure>,
}

/// One number of a row.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct PeerMeasure {
    /// What was measured.
    pub metric: String,
    /// What Box2D made of it, in the unit of the report.
    pub box2d: Figure,
    /// What Rapier made of it.
    pub rapier: Figure,
}

impl PeerMeasure {
    /// Is the number of a report as good as the better of the two? Yes where neither can play it.
    pub fn as_good(&self, ours: &Measure) -> bool {
        [&self.box2d, &self.rapier]
            .iter()
            .all(|theirs| ours.target.as_good(ours.value, theirs.value()))
    }
}

impl Peers {
    /// The figures in `peers.json`, as of when this was built.
    ///
    /// # Errors
    /// The file does not have this form.
    pub fn recorded() -> Result<Self, serde_json::Error> {
        serde_json::from_str(include_str!("../peers.json"))
    }

    /// The rows of a variant.
    pub fn rows(&self, variant: Variant) -> &[PeerRow] {
        match variant {
            Variant::Usual => &self.usual,
            Variant::Other => &self.other,
        }
    }

    /// Puts a row's figures in place of what is recorded of it.
    pub fn record(&mut self, variant: Variant, row: PeerRow) {
        let rows = match variant {
            Variant::Usual => &mut self.usual,
            Variant::Other => &mut self.other,
        };
        match rows.iter_mut().find(|known| known.id == row.id) {
            Some(known) => *known = row,
            None => rows.push(row),
        }
        let place = |row: &PeerRow| all_rows().position(|known| known.id == row.id);
        rows.sort_by_key(|row| place(row).unwrap_or(usize::MAX));
    }

    /// The figures that stand beside a report's numbers, in their order; `None` for a number that has none.
    pub fn beside(&self, variant: Variant, report: &Report) -> Vec<Option<&PeerMeasure>> {
        let row = self.rows(variant).iter().find(|row| row.id == report.id);
        let known = row.map_or(&[][..], |row| &row.measures);
        let of = |metric: &String| known.iter().find(|measure| measure.metric == *metric);
        report.measures.iter().map(|measure| of(&measure.metric)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{find, rows, still};

    #[test]
    fn the_record_has_the_numbers_of_every_row_in_both_variants() {
        let peers = Peers::recorded().expect("peers.json has the form of `Peers`");
        for variant in [Variant::Usual, Variant::Other] {
            let reports: Vec<Report> =
                rows().iter().map(|row| row.run(&still, variant, false, &mut |_, _| {})).collect();
            for report in &reports {
                assert!(
                    peers.beside(variant, report).iter().all(Option::is_some),
                    "{variant:?}, row {}; measure anew: {COMMAND}",
                    report.id
                );
            }
        }
    }

    #[test]
    fn what_is_recorded_is_of_a_row() {
        let peers = Peers::recorded().expect("peers.json has the form of `Peers`");
        for variant in [Variant::Usual, Variant::Other] {
            for recorded in peers.rows(variant) {
                let row = find(&recorded.id).expect("a row of that number");
                let report = row.run(&still, variant, false, &mut |_, _| {});
                let metrics = report.measures.iter().map(|measure| &measure.metric);
                assert!(
                    metrics.eq(recorded.measures.iter().map(|measure| &measure.metric)),
                    "{variant:?}, row {}; measure anew: {COMMAND}",
                    recorded.id
                );
            }
        }
    }

    #[test]
    fn figures_survive_json() {
        let figures = [
            Figure::Value(-0.125),
            Figure::Fell,
            Figure::Crashed("signal 11".into()),
            Figure::Cannot("no belts".into()),
        ];
        let text = serde_json::to_string(&figures).unwrap();
        assert_eq!(text, r#"[-0.125,"fell","crashed: signal 11","cannot: no belts"]"#);
        assert_eq!(serde_json::from_str::<[Figure; 4]>(&text).unwrap(), figures);
        assert!(serde_json::from_str::<Figure>("\"rose\"").is_err());
    }

    #[test]
    fn only_numbers_can_pass() {
        assert_eq!(Figure::of(f64::NAN), Figure::Fell);
        assert_eq!(Figure::of(2.0).value(), 2.0);
        assert_eq!(Figure::Fell.value(), f64::INFINITY);
        assert_eq!([Figure::Cannot(String::new()).short(), digits(0.000_02)], ["-", "2.0e-5"]);
    }
}
