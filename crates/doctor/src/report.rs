//! All that is wrong, worst first.

use crate::{Code, Finding, Severity};
use core::fmt;
use serde::Serialize;

/// What the doctor has found.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub struct Report {
    /// Steps watched.
    pub steps: u64,
    /// Bodies in the world when it was last watched.
    pub bodies: usize,
    /// The worst first, but causes before what they bring about.
    pub findings: Vec<Finding>,
}

impl Report {
    pub(crate) fn sorted(mut self) -> Self {
        self.findings.sort_by(|a, b| {
            let by_severity = b.severity.cmp(&a.severity);
            by_severity.then(a.code.cmp(&b.code)).then(b.weight().total_cmp(&a.weight()))
        });
        self
    }

    /// Moves what brings others about before them, however mild it looks by itself.
    pub(crate) fn put_causes_first(&mut self, brings_about: impl Fn(Code, Code) -> bool) {
        // Each cause moves at most once: what it brings about never brings it about.
        for place in 1..self.findings.len() {
            let code = self.findings[place].code;
            let first = self.findings[..place].iter().position(|f| brings_about(code, f.code));
            if let Some(first) = first {
                self.findings[first..=place].rotate_right(1);
            }
        }
    }

    /// Is there nothing worse than a note?
    pub fn is_healthy(&self) -> bool {
        self.findings.iter().all(|finding| finding.severity == Severity::Note)
    }

    /// The first finding of a kind.
    pub fn find(&self, code: Code) -> Option<&Finding> {
        self.findings.iter().find(|finding| finding.code == code)
    }

    /// The report as JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self)
            .unwrap_or_else(|error| format!("{{\"error\": \"{error}\"}}"))
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { steps, bodies, findings } = self;
        if findings.is_empty() {
            return write!(f, "healthy: nothing found in {steps} steps of {bodies} bodies");
        }
        let count = |severity| findings.iter().filter(|f| f.severity == severity).count();
        let (errors, warnings) = (count(Severity::Error), count(Severity::Warning));
        let notes = count(Severity::Note);
        let health = if self.is_healthy() { "healthy" } else { "ill" };
        write!(
            f,
            "{health}: errors {errors}, warnings {warnings}, notes {notes}; {steps} steps of {bodies} bodies"
        )?;
        findings.iter().try_for_each(|finding| write!(f, "\n\n{finding}"))
    }
}
