//! The extension module `tiny_physics._native`: worlds, batches and tasks for Python.
//!
//! Descriptions (bodies, shapes, joints, settings) come as dictionaries in the form of scene files; the Python side
//! of the package has functions that make them.

use pyo3::prelude::*;

mod batch;
mod body;
mod character;
mod convert;
mod draw;
mod handles;
mod joint;
mod play;
mod query;
mod shape;
mod tasks;
mod tiles;
mod world;

#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("StaleHandleError", module.py().get_type::<convert::StaleHandleError>())?;
    module.add_class::<handles::World>()?;
    module.add_class::<handles::Body>()?;
    module.add_class::<handles::Shape>()?;
    module.add_class::<handles::Joint>()?;
    module.add_class::<handles::Tiles>()?;
    module.add_class::<character::Character>()?;
    module.add_class::<batch::WorldBatch>()?;
    module.add_class::<tasks::TaskBatch>()?;
    module.add_function(wrap_pyfunction!(draw::gif, module)?)?;
    Ok(())
}
