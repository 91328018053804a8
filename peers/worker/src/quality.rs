//! Rows of the quality suite on an engine at its own defaults.

use crate::protocol::{Measured, Played, Tape};
use crate::tape::Recorder;
use crate::{Engine, QualityJob, Setup, Tuning};
use std::cell::RefCell;
use std::rc::Rc;
use tiny_physics_quality::{Subject, Variant, find, still};
use tiny_physics_scenes::Scene;

/// Plays a row in the engine `E`.
///
/// A row with a scene that the engine cannot express gives the reason and no numbers.
///
/// # Errors
/// No such row, or an engine that must not be measured.
pub fn play<E: Engine + 'static>(job: &QualityJob) -> Result<Played, String> {
    let row = find(&job.row).ok_or_else(|| format!("there is no row {}", job.row))?;
    let cannot = RefCell::new(None);
    let failed = RefCell::new(None);
    let tapes: Rc<RefCell<Vec<Tape>>> = Rc::default();
    let make = |scene: &Scene| -> Box<dyn Subject> {
        if let Some(reason) = E::lacks(scene) {
            *cannot.borrow_mut() = Some(reason);
            return still(scene);
        }
        let setup = Setup {
            gravity: scene.gravity,
            settings: &scene.settings,
            tuning: Tuning::Own,
            threads: 1,
            setting: "",
        };
        match E::create(&setup) {
            Ok(engine) => match job.tape {
                Some(every) => Box::new(Recorder::new(engine, scene, every, tapes.clone())),
                None => Box::new(engine),
            },
            Err(message) => {
                *failed.borrow_mut() = Some(message);
                still(scene)
            }
        }
    };
    let variant = if job.other { Variant::Other } else { Variant::Usual };
    let report = row.run(&make, variant, false, &mut |_, _| {});
    if let Some(message) = failed.take() {
        return Err(message);
    }
    let measured = |measure: &tiny_physics_quality::Measure| Measured {
        metric: measure.metric.clone(),
        value: measure.value.is_finite().then_some(measure.value),
    };
    Ok(Played {
        engine: E::name(),
        measures: report.measures.iter().map(measured).collect(),
        cannot: cannot.take(),
        tapes: tapes.take(),
    })
}
