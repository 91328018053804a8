//! What the doctor says of a run, for the playground.

use crate::handles::Handle;
use crate::outcome::words;
use crate::with;
use serde::Serialize;
use tiny_physics_doctor::{Doctor, Figure, Finding};

/// A finding for JavaScript.
#[derive(Serialize)]
struct Row<'a> {
    code: &'static str,
    severity: &'static str,
    first_step: u64,
    last_step: u64,
    count: u64,
    others: u64,
    what: &'a str,
    advice: &'a str,
    page: &'static str,
    figures: &'a [Figure],
    bodies: Vec<f64>,
}

impl<'a> From<&'a Finding> for Row<'a> {
    fn from(finding: &'a Finding) -> Self {
        Self {
            code: finding.code.name(),
            severity: finding.severity.name(),
            first_step: finding.first_step,
            last_step: finding.last_step,
            count: finding.count,
            others: finding.others,
            what: &finding.what,
            advice: &finding.advice,
            page: finding.page,
            figures: &finding.figures,
            bodies: finding.bodies.iter().map(|who| who.id.number()).collect(),
        }
    }
}

/// Lets the doctor look at the world as it is; one who has seen nothing yet where `anew`.
#[unsafe(no_mangle)]
pub extern "C" fn tp_watch(session: u32, anew: bool) -> bool {
    with(session, |session, _| {
        let mut doctor = if anew { Doctor::new() } else { core::mem::take(&mut session.doctor) };
        doctor.watch(session.world());
        session.doctor = doctor;
        Ok(())
    })
}

/// All that the doctor has found, worst first, as text.
#[unsafe(no_mangle)]
pub extern "C" fn tp_findings(session: u32) -> bool {
    with(session, |session, shelf| {
        let report = session.doctor.report();
        let rows: Vec<Row<'_>> = report.findings.iter().map(Row::from).collect();
        shelf.say(serde_json::to_vec(&rows).map_err(words)?);
        Ok(())
    })
}
