//! Tasks for agents.

use crate::convert::{self, batch_error, locked};
use crate::draw::{Picture, View};
use crate::handles::World;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3, PyArrayMethods};
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use tiny_physics_batch::tasks::{BipedalWalker, Driving, LunarLander, Ragdoll, Stacking};
use tiny_physics_batch::{self as engine, Autoreset, BatchError, Task, Tasks};

/// Episodes of a task in many worlds, stepped at once on all cores: what the environments stand on.
///
/// task: "lunar_lander", "bipedal_walker", "driving", "stacking" or "ragdoll". count: worlds. threads: 0 is one a
/// core; results do not depend on it. autoreset: "next_step", "same_step" or "disabled", as in Gymnasium.
/// Options: continuous, gravity, wind_power, turbulence_power (lunar_lander), hardcore (bipedal_walker).
///
/// Raises ValueError where a name or an option is unknown or a number makes no sense.
#[pyclass(module = "tiny_physics")]
pub struct TaskBatch {
    inner: Box<dyn Tasks>,
    observations: Py<PyArray2<f32>>,
}

/// Options by name; each is taken once, what is left is unknown.
struct Options<'py>(Bound<'py, PyDict>);

impl<'py> Options<'py> {
    fn take<T>(&self, name: &str, other: T) -> PyResult<T>
    where
        T: for<'a> FromPyObject<'a, 'py, Error = PyErr>,
    {
        let Some(value) = self.0.get_item(name)? else { return Ok(other) };
        self.0.del_item(name)?;
        value.extract()
    }

    fn end(&self) -> PyResult<()> {
        match self.0.keys().iter().next() {
            None => Ok(()),
            Some(key) => Err(PyValueError::new_err(format!("there is no option {key}"))),
        }
    }
}

fn boxed<T: Task + 'static>(
    task: Result<T, BatchError>,
    (count, threads, mode): (usize, usize, Autoreset),
) -> PyResult<Box<dyn Tasks>> {
    let batch = engine::TaskBatch::new(task.map_err(batch_error)?, count, threads, mode);
    Ok(Box::new(batch.map_err(batch_error)?))
}

fn build(
    task: &str,
    options: &Options<'_>,
    form: (usize, usize, Autoreset),
) -> PyResult<Box<dyn Tasks>> {
    let batch = match task {
        "lunar_lander" => {
            let (continuous, gravity) =
                (options.take("continuous", false)?, options.take("gravity", -10.0)?);
            let wind = options.take("enable_wind", false)?;
            let force = options.take("wind_power", 15.0)?;
            let torque = options.take("turbulence_power", 1.5)?;
            boxed(LunarLander::new(continuous, gravity, wind.then_some((force, torque))), form)
        }
        "bipedal_walker" => boxed(BipedalWalker::new(options.take("hardcore", false)?), form),
        "driving" => boxed(Driving::new(), form),
        "stacking" => boxed(Stacking::new(), form),
        "ragdoll" => boxed(Ragdoll::new(), form),
        _ => Err(PyValueError::new_err(format!("there is no task \"{task}\""))),
    }?;
    options.end()?;
    Ok(batch)
}

fn mode(name: &str) -> PyResult<Autoreset> {
    Ok(match name {
        "next_step" => Autoreset::NextStep,
        "same_step" => Autoreset::SameStep,
        "disabled" => Autoreset::Disabled,
        _ => return Err(PyValueError::new_err(format!("there is no autoreset \"{name}\""))),
    })
}

/// Rewards, terminations and truncations, shape (worlds,) each.
type Results<'py> =
    (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<bool>>, Bound<'py, PyArray1<bool>>);

#[pymethods]
impl TaskBatch {
    #[new]
    #[pyo3(signature = (task, count, threads=0, autoreset="next_step", **options))]
    fn new(
        py: Python<'_>,
        task: &str,
        count: usize,
        threads: usize,
        autoreset: &str,
        options: Option<Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let options = Options(options.unwrap_or_else(|| PyDict::new(py)));
        let inner = build(task, &options, (count, threads, mode(autoreset)?))?;
        let width = inner.spec().observation;
        let observations = PyArray2::zeros(py, [count, width], false).unbind();
        let batch = Self { inner, observations };
        batch.show(py)?;
        Ok(batch)
    }

    fn __len__(&self) -> usize {
        self.inner.len()
    }

    /// Its form: "observation" and "action" (numbers of each), "choices" (None: numbers from -1 to 1), "time_limit"
    /// (steps), "dt" (seconds), "names" (of the numbers of an observation).
    #[getter]
    fn spec<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (spec, found) = (self.inner.spec(), PyDict::new(py));
        found.set_item("observation", spec.observation)?;
        found.set_item("action", spec.action)?;
        found.set_item("choices", spec.choices)?;
        found.set_item("time_limit", spec.time_limit)?;
        found.set_item("dt", spec.dt)?;
        found.set_item("names", self.inner.names())?;
        Ok(found)
    }

    /// What the worlds show now, float32, shape (worlds, numbers). Always the same array: the next step or reset writes
    /// over it; copy what you keep.
    #[getter]
    fn observations<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f32>> {
        self.observations.bind(py).clone()
    }

    /// Gives world i the random numbers of seeds[i]; its next episode draws from them.
    fn seed(&mut self, seeds: Vec<u64>) -> PyResult<()> {
        self.inner.seed(&seeds).map_err(batch_error)
    }

    /// Begins new episodes: everywhere, or where `mask` (bool, shape (worlds,)) says so.
    #[pyo3(signature = (mask=None))]
    fn reset(&mut self, py: Python<'_>, mask: Option<Vec<bool>>) -> PyResult<()> {
        let inner = &mut self.inner;
        py.detach(|| inner.reset(mask.as_deref())).map_err(batch_error)?;
        self.show(py)
    }

    /// Does the actions (float32, shape (worlds, numbers of an action), or all in one row, world after world) and moves all worlds on by one step. Gives rewards (float64),
    /// terminations and truncations (bool), shape (worlds,) each. Other Python threads run meanwhile.
    ///
    /// Raises ValueError where an action is not finite or no choice of the task, or an episode is over and nothing
    /// resets it; nothing has changed then.
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        actions: &Bound<'py, PyAny>,
    ) -> PyResult<Results<'py>> {
        // A copy: they may be part of what is written afterwards.
        let copy = convert::actions(actions, self.inner.len(), self.inner.spec().action)?;
        let inner = &mut self.inner;
        py.detach(|| inner.step(&copy)).map_err(batch_error)?;
        self.show(py)?;
        let outcomes = || (0..self.inner.len()).filter_map(|i| self.inner.outcome(i));
        let rewards: Vec<f64> = outcomes().map(|(outcome, _)| outcome.reward.into()).collect();
        let ends: Vec<bool> = outcomes().map(|(outcome, _)| outcome.terminated).collect();
        let cuts: Vec<bool> = outcomes().map(|(_, truncated)| truncated).collect();
        Ok((rewards.into_pyarray(py), ends.into_pyarray(py), cuts.into_pyarray(py)))
    }

    /// The last observation of the last episode that ended in a world; None where none has. Only with "same_step".
    fn final_observation<'py>(
        &self,
        py: Python<'py>,
        index: usize,
    ) -> Option<Bound<'py, PyArray1<f32>>> {
        self.inner.final_observation(index).map(|last| PyArray1::from_slice(py, last))
    }

    /// A copy of a world.
    fn world(&self, index: usize) -> PyResult<World> {
        let world = self.inner.world(index);
        Ok(World { inner: world.ok_or_else(|| missing(index))?.clone() })
    }

    /// The state hash of each world, uint64, shape (worlds,).
    fn state_hashes<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u64>> {
        self.inner.state_hashes().into_pyarray(py)
    }

    /// Bytes that the worlds hold in memory.
    #[getter]
    fn memory(&self) -> usize {
        self.inner.memory()
    }

    /// A picture of a world as an array of bytes, shape (height, width, 3), red, green, blue.
    #[pyo3(signature = (index=0, width=600, height=400))]
    fn draw<'py>(
        &self,
        py: Python<'py>,
        index: usize,
        width: u32,
        height: u32,
    ) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let (world, view) = (self.inner.world(index), self.inner.view(index));
        let (world, view) = world.zip(view).ok_or_else(|| missing(index))?;
        let view = View { min: view.min, max: view.max };
        Picture::of(world, width, height, Some(view))?.to_array(py)
    }

    /// Everything that the next steps depend on, as bytes.
    fn to_bytes<'py>(&mut self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let inner = &mut self.inner;
        Ok(PyBytes::new(py, &py.detach(|| inner.to_bytes()).map_err(batch_error)?))
    }

    /// Goes back to what was saved by a batch of the same task and as many worlds.
    ///
    /// Raises ValueError where the bytes are no such save; nothing has changed then.
    fn restore_bytes(&mut self, py: Python<'_>, bytes: &[u8]) -> PyResult<()> {
        let inner = &mut self.inner;
        py.detach(|| inner.restore_bytes(bytes)).map_err(batch_error)?;
        self.show(py)
    }
}

impl TaskBatch {
    /// Brings the array that Python sees up to date.
    fn show(&self, py: Python<'_>) -> PyResult<()> {
        let mut out = self.observations.bind(py).try_readwrite().map_err(locked)?;
        out.as_slice_mut()?.copy_from_slice(self.inner.observations());
        Ok(())
    }
}

fn missing(index: usize) -> PyErr {
    PyIndexError::new_err(format!("there is no world {index}"))
}
