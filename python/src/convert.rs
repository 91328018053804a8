//! Between Python's values and the engine's.

use numpy::{Element, PyArrayDyn, PyArrayMethods, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::create_exception;
use pyo3::exceptions::{PyLookupError, PyRuntimeError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};
use pythonize::{depythonize, pythonize};
use serde::Serialize;
use serde::de::DeserializeOwned;
use tiny_physics::{DVec2, Error, RayCast, Vec2, World};
use tiny_physics_batch::BatchError;

create_exception!(
    tiny_physics,
    StaleHandleError,
    PyLookupError,
    "The body, shape or joint has been removed, or belongs to another world."
);

/// The engine's error as Python's.
pub fn error(error: Error) -> PyErr {
    told(&error, error.to_string())
}

fn told(error: &Error, words: String) -> PyErr {
    match error {
        Error::StaleHandle { .. } => StaleHandleError::new_err(words),
        _ => PyValueError::new_err(words),
    }
}

/// What `change` gives; an error where the engine refused a number, which it does in silence.
pub fn heard<T>(world: &mut World, change: impl FnOnce(&mut World) -> T) -> PyResult<T> {
    let before = world.stats().refused_numbers;
    let done = change(world);
    if world.stats().refused_numbers == before {
        return Ok(done);
    }
    Err(PyValueError::new_err("a number is not finite, or too large"))
}

/// That of an array that cannot be written, or is borrowed elsewhere.
pub fn locked(error: numpy::BorrowError) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// The numbers of an array, row after row however it lies in memory, and its shape; whatever NumPy makes an array of will do, as
/// long as its numbers are of that kind. `wanted` says in words which shape `fits`.
pub fn numbers<T: Element + Copy>(
    given: &Bound<'_, PyAny>,
    [name, wanted]: [&str; 2],
    fits: impl Fn(&[usize]) -> bool,
) -> PyResult<(Vec<T>, Vec<usize>)> {
    let py = given.py();
    let dtype = numpy::dtype::<T>(py);
    let array = match given.cast::<PyArrayDyn<T>>() {
        Ok(array) => array.clone(),
        Err(_) => {
            let numpy = py.import("numpy")?;
            let array = numpy.call_method1("asarray", (given,))?;
            let from = array.getattr("dtype")?;
            if !numpy.call_method1("can_cast", (&from, &dtype, "same_kind"))?.is_truthy()? {
                let words = format!("{name} is of {from}; needed is {wanted} of {dtype}");
                return Err(PyTypeError::new_err(words));
            }
            numpy.call_method1("asarray", (array, &dtype))?.cast_into()?
        }
    };
    if !fits(array.shape()) {
        let shape = array.getattr("shape")?;
        let words = format!("{name} has the shape {shape}; needed is {wanted} of {dtype}");
        return Err(PyValueError::new_err(words));
    }
    let array = array.try_readonly().map_err(locked)?;
    Ok((array.as_array().iter().copied().collect(), array.shape().to_vec()))
}

/// Actions of a batch of worlds: a row for each, or all in one row, world after world.
pub fn actions(given: &Bound<'_, PyAny>, worlds: usize, each: usize) -> PyResult<Vec<f32>> {
    let all = worlds * each;
    let wanted = format!("({worlds}, {each}) or ({all},)");
    let fits = |shape: &[usize]| shape == [worlds, each] || shape == [all];
    Ok(numbers(given, ["actions", &wanted], fits)?.0)
}

/// Rays: origin x, y, translation x, y each.
pub fn rays(given: &Bound<'_, PyAny>) -> PyResult<Vec<RayCast>> {
    let fits = |shape: &[usize]| matches!(shape, [_, 4]);
    let (numbers, _) = numbers::<f64>(given, ["rays", "(n, 4)"], fits)?;
    let ray = |r: &[f64]| RayCast::new(DVec2::new(r[0], r[1]), Vec2::new(r[2] as f32, r[3] as f32));
    Ok(numbers.chunks_exact(4).map(ray).collect())
}

/// The batch's error as Python's.
pub fn batch_error(error: BatchError) -> PyErr {
    match error {
        BatchError::Engine(ref engine) | BatchError::InWorld { error: ref engine, .. } => {
            told(engine, error.to_string())
        }
        BatchError::World { .. } => pyo3::exceptions::PyIndexError::new_err(error.to_string()),
        BatchError::Threads(_) => PyRuntimeError::new_err(error.to_string()),
        _ => PyValueError::new_err(error.to_string()),
    }
}

/// A description from dictionaries, lists and numbers; NumPy's arrays and numbers count as lists and numbers.
pub fn read<T: DeserializeOwned>(value: &Bound<'_, PyAny>) -> PyResult<T> {
    depythonize(&plain(value)?).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// The same, where what is not said stays as it is now.
pub fn read_over<T: Serialize + DeserializeOwned>(
    now: &T,
    value: &Bound<'_, PyAny>,
) -> PyResult<T> {
    let Ok(said) = value.cast::<PyDict>() else { return read(value) };
    let whole = write(value.py(), now)?;
    whole.call_method1("update", (said,))?;
    read(&whole)
}

/// A description as dictionaries, lists and numbers.
pub fn write<'py>(py: Python<'py>, value: &impl Serialize) -> PyResult<Bound<'py, PyAny>> {
    pythonize(py, value).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// The same without NumPy's types, and without what is `None`: that stands for the default.
fn plain<'py>(value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let py = value.py();
    if let Ok(dict) = value.cast::<PyDict>() {
        let copy = PyDict::new(py);
        for (key, value) in dict.iter().filter(|(_, value)| !value.is_none()) {
            copy.set_item(key, plain(&value)?)?;
        }
        return Ok(copy.into_any());
    }
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        let items: PyResult<Vec<_>> = value.try_iter()?.map(|item| plain(&item?)).collect();
        return Ok(PyList::new(py, items?)?.into_any());
    }
    if value.cast::<PyUntypedArray>().is_ok() || value.hasattr("tolist")? {
        return value.call_method0("tolist");
    }
    Ok(value.clone())
}

/// A point or vector: any two numbers, both finite.
#[derive(Clone, Copy)]
pub struct Pair(pub f64, pub f64);

impl<'a, 'py> FromPyObject<'a, 'py> for Pair {
    type Error = PyErr;

    fn extract(value: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let mut numbers = value.try_iter()?;
        let mut next = || -> PyResult<f64> {
            match numbers.next() {
                Some(number) => finite(number?.extract()?),
                None => Err(PyValueError::new_err("two numbers are needed")),
            }
        };
        let pair = Self(next()?, next()?);
        if numbers.next().is_some() {
            return Err(PyValueError::new_err("two numbers are needed, there are more"));
        }
        Ok(pair)
    }
}

fn finite(number: f64) -> PyResult<f64> {
    let refused =
        || PyValueError::new_err(format!("{number} is given, but numbers have to be finite"));
    number.is_finite().then_some(number).ok_or_else(refused)
}

impl From<Pair> for Vec2 {
    fn from(Pair(x, y): Pair) -> Self {
        Self::new(x as f32, y as f32)
    }
}

impl From<Pair> for DVec2 {
    fn from(Pair(x, y): Pair) -> Self {
        Self::new(x, y)
    }
}

/// A vector for Python.
pub fn tuple(v: Vec2) -> (f32, f32) {
    (v.x, v.y)
}

/// A place for Python.
pub fn place(p: DVec2) -> (f64, f64) {
    (p.x, p.y)
}
