//! Rows of the quality suite on an engine at its own defaults.

use crate::clock::process_cpu_s;
use crate::protocol::{Measured, Played, Tape};
use crate::tape::Recorder;
use crate::{Engine, QualityJob, Setup, Tuning};
use std::cell::RefCell;
use std::rc::Rc;
use tiny_physics_quality::arena::{self, Findings};
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
        match E::create(&own_setup(scene)) {
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

/// Plays a world of the arena in the engine `E`; `None` where it cannot express the world.
///
/// # Errors
/// An engine that must not be measured.
pub fn fight<E: Engine + 'static>(scene: &Scene) -> Result<Option<Findings>, String> {
    if E::lacks(scene).is_some() {
        return Ok(None);
    }
    let failed = RefCell::new(None);
    let make = |scene: &Scene| -> Box<dyn Subject> {
        match E::create(&own_setup(scene)) {
            Ok(engine) => Box::new(engine),
            Err(message) => {
                *failed.borrow_mut() = Some(message);
                still(scene)
            }
        }
    };
    let found = arena::play(scene, &make, &process_cpu_s);
    failed.take().map_or(Ok(Some(found)), Err)
}

/// A world at the engine's own defaults.
fn own_setup(scene: &Scene) -> Setup<'_> {
    let (gravity, settings) = (scene.gravity, &scene.settings);
    Setup { gravity, settings, tuning: Tuning::Own, threads: 1, setting: "" }
}
