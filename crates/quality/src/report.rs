//! What came of a row.

use crate::target::Target;
use serde::{Serialize, Serializer};

/// One measured number of a row.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Measure {
    /// What was measured.
    pub metric: String,
    /// The number; not finite where the scene fell apart.
    #[serde(serialize_with = "finite")]
    pub value: f64,
    /// Its unit; empty for plain numbers.
    pub unit: &'static str,
    /// What it has to be.
    #[serde(serialize_with = "as_text")]
    pub target: Target,
    /// Is it?
    pub pass: bool,
}

impl Measure {
    /// A number and what it has to be.
    pub fn new(metric: impl Into<String>, value: f64, unit: &'static str, target: Target) -> Self {
        let pass = target.use_of(value) <= 1.0;
        Self { metric: metric.into(), value, unit, target, pass }
    }

    /// The same number where only twice the target has to be met.
    pub(crate) fn with_twice_the_target(self) -> Self {
        Self::new(self.metric, self.value, self.unit, self.target.doubled())
    }

    /// How much of what is allowed it uses up; up to 1 passes.
    pub fn use_of_target(&self) -> f64 {
        self.target.use_of(self.value)
    }
}

/// What came of a row: the number that is furthest from its target stands for it.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Report {
    /// Number of the row, or its family's letter and a number.
    #[serde(serialize_with = "number_or_text")]
    pub id: &'static str,
    /// Its short name.
    pub name: &'static str,
    /// What was measured.
    pub metric: String,
    /// The number; not finite where the scene fell apart.
    #[serde(serialize_with = "finite")]
    pub value: f64,
    /// Its unit.
    pub unit: &'static str,
    /// What it has to be.
    #[serde(serialize_with = "as_text")]
    pub target: Target,
    /// Do all numbers of the row meet their targets?
    pub pass: bool,
    /// All numbers of the row.
    pub measures: Vec<Measure>,
}

impl Report {
    /// The report of a row with at least one number.
    pub(crate) fn new(id: &'static str, name: &'static str, measures: Vec<Measure>) -> Self {
        let worst = measures
            .iter()
            .reduce(|a, b| if b.use_of_target() > a.use_of_target() { b } else { a })
            .cloned()
            .unwrap_or_else(|| Measure::new("nothing", f64::NAN, "", Target::AtMost(0.0)));
        Self {
            id,
            name,
            metric: worst.metric,
            value: worst.value,
            unit: worst.unit,
            target: worst.target,
            pass: worst.pass,
            measures,
        }
    }

    /// The report of the same row with other values for its numbers, in their order.
    pub fn with_values(mut self, values: &[f64]) -> Self {
        for (measure, &value) in self.measures.iter_mut().zip(values) {
            measure.value = value;
            measure.pass = measure.use_of_target() <= 1.0;
        }
        Self::new(self.id, self.name, self.measures)
    }

    /// How much of its targets the row uses up at worst; up to 1 passes.
    pub fn use_of_target(&self) -> f64 {
        self.target.use_of(self.value)
    }
}

/// JSON has no infinity: `null` stands for a scene that fell apart.
fn finite<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    value.is_finite().then_some(*value).serialize(serializer)
}

/// Numbers of rows are numbers in JSON.
fn number_or_text<S: Serializer>(id: &str, serializer: S) -> Result<S::Ok, S::Error> {
    match id.parse::<u32>() {
        Ok(number) => number.serialize(serializer),
        Err(_) => id.serialize(serializer),
    }
}

fn as_text<S: Serializer>(target: &Target, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(target)
}
