//! One thing that is wrong.

use crate::{Code, Severity};
use core::fmt;
use serde::{Serialize, Serializer};
use tiny_physics::{BodyId, JointId, ShapeId};

/// A body, shape or joint that a finding is about.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Who<T: fmt::Display> {
    /// Its handle; stale where it has been removed since.
    #[serde(serialize_with = "as_text")]
    pub id: T,
    /// The user's number.
    pub user_data: u64,
}

impl<T: fmt::Display> fmt::Display for Who<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.id.fmt(f)?;
        if self.user_data == 0 { Ok(()) } else { write!(f, " (user data {})", self.user_data) }
    }
}

/// What was measured, beside the bound that it passed.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Figure {
    /// What it is.
    pub name: &'static str,
    /// What was measured.
    pub value: f64,
    /// From where on it is a finding.
    pub threshold: f64,
    /// Unit of both.
    pub unit: &'static str,
}

impl fmt::Display for Figure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, value, threshold, unit } = self;
        write!(f, "{name} {}{unit} (bound {}{unit})", Short(*value), Short(*threshold))
    }
}

/// A number in three digits.
pub(crate) struct Short(pub(crate) f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.abs();
        match size {
            _ if size == 0.0 => f.write_str("0"),
            _ if !(0.001..1.0e6).contains(&size) => write!(f, "{:.2e}", self.0),
            _ if size >= 100.0 => write!(f, "{:.0}", self.0),
            _ if size >= 10.0 => write!(f, "{:.1}", self.0),
            _ => write!(f, "{:.3}", self.0),
        }
    }
}

/// Something that is wrong, or may be.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Finding {
    /// What kind.
    pub code: Code,
    /// How bad.
    pub severity: Severity,
    /// Step in which it was first seen.
    pub first_step: u64,
    /// Step in which it was last seen.
    pub last_step: u64,
    /// How often it was seen.
    pub count: u64,
    /// The same about other bodies or joints.
    pub others: u64,
    /// Bodies, the one that it is most about first.
    pub bodies: Vec<Who<BodyId>>,
    /// Shapes.
    pub shapes: Vec<Who<ShapeId>>,
    /// Joints.
    pub joints: Vec<Who<JointId>>,
    /// What was measured when it was worst.
    pub figures: Vec<Figure>,
    /// What is wrong, in one sentence.
    pub what: String,
    /// What to change.
    pub advice: String,
    /// Where the guide says more.
    pub page: &'static str,
}

impl Finding {
    /// Severity, code and sentence: all that fits into a line.
    pub fn line(&self) -> String {
        let Self { severity, code, what, others, .. } = self;
        let more =
            if *others > 0 { format!(" (and {others} more like it)") } else { String::new() };
        format!("{}: {code}: {what}{more}", severity.name())
    }

    /// Are both about one body?
    pub(crate) fn shares_with(&self, other: &Self) -> bool {
        self.bodies.iter().any(|who| other.bodies.iter().any(|its| its.id == who.id))
    }

    /// Bytes that it holds, its own among them.
    pub(crate) fn memory(&self) -> usize {
        size_of::<(u64, Self)>()
            + self.bodies.capacity() * size_of::<Who<BodyId>>()
            + self.shapes.capacity() * size_of::<Who<ShapeId>>()
            + self.joints.capacity() * size_of::<Who<JointId>>()
            + self.figures.capacity() * size_of::<Figure>()
            + self.what.capacity()
            + self.advice.capacity()
    }

    /// The measured figure by which findings of one code are compared.
    pub(crate) fn weight(&self) -> f64 {
        self.figures.first().map_or(0.0, |figure| {
            if figure.threshold > 0.0 { figure.value / figure.threshold } else { figure.value }
        })
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}\n    steps {} to {}, seen {} times",
            self.line(),
            self.first_step,
            self.last_step,
            self.count
        )?;
        for figure in &self.figures {
            write!(f, "; {figure}")?;
        }
        write!(f, "\n    do: {}\n    see: {}", self.advice, self.page)
    }
}

fn as_text<T: fmt::Display, S: Serializer>(id: &T, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(id)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let texts = [0.0, 0.00012, 0.0456, 3.0, 12.34, 1234.4, 5.0e7].map(|n| Short(n).to_string());
        assert_eq!(texts, ["0", "1.20e-4", "0.046", "3.000", "12.3", "1234", "5.00e7"]);
    }
}
