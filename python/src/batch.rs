//! Batches of worlds.

use crate::convert::{self, Pair, batch_error, locked};
use crate::handles::Body;
use crate::handles::Joint;
use crate::handles::World;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyTuple};
use tiny_physics::{BodyId, JointId, QueryFilter, Vec2};
use tiny_physics_batch::{Actuator, Reading, Sight, WorldBatch as Inner};

/// Many copies of worlds, stepped at once on all cores.
///
/// templates: a world or a list of them; world i is a copy of template i % len(templates).
/// count: worlds. threads: 0 is one a core; results do not depend on it.
/// actuators: what the numbers of an action do: ("force_x", body), "force_y", "torque", "impulse_x", "impulse_y",
/// "thrust", "velocity_x", "velocity_y", "angular_velocity", "position_x", "position_y", "angle" with a body;
/// "motor_speed", "motor_max" with a joint; ("gravity_y",).
/// readings: what the numbers of an observation are: ("position_x", body), "position_y", "angle", "velocity_x",
/// "velocity_y", "angular_velocity", "awake", "touching" with a body; "joint_angle", "joint_speed", "joint_holds" with a joint;
/// ("ray", body, (offset x, y), (translation x, y)) or with a mask after it. Bodies and joints are those of a template.
/// A joint that has broken in a world heeds no action there, its angle and speed are 0, and "joint_holds" is 0 in place of 1.
///
/// Raises ValueError where there is no template or a name is unknown.
#[pyclass(module = "tiny_physics")]
pub struct WorldBatch {
    inner: Inner,
    actuators: Vec<Actuator>,
    readings: Vec<Reading>,
    observations: Py<PyArray2<f32>>,
}

/// What stands in a tuple after its name.
struct Named<'py> {
    name: String,
    rest: Bound<'py, PyTuple>,
}

impl<'py> Named<'py> {
    fn new(value: &Bound<'py, PyAny>) -> PyResult<Self> {
        let tuple = value.cast::<PyTuple>().map_err(|_| {
            PyValueError::new_err("actuators and readings are tuples: (\"force_x\", body)")
        })?;
        let name = tuple.get_item(0)?.extract()?;
        Ok(Self { name, rest: tuple.get_slice(1, tuple.len()) })
    }

    fn body(&self) -> PyResult<BodyId> {
        Ok(self.rest.get_item(0)?.cast::<Body>()?.get().id)
    }

    fn joint(&self) -> PyResult<JointId> {
        Ok(self.rest.get_item(0)?.cast::<Joint>()?.get().id)
    }

    fn unknown(&self, what: &str) -> PyErr {
        PyValueError::new_err(format!("there is no {what} \"{}\"", self.name))
    }

    fn actuator(&self) -> PyResult<Actuator> {
        Ok(match self.name.as_str() {
            "force_x" => Actuator::ForceX(self.body()?),
            "force_y" => Actuator::ForceY(self.body()?),
            "torque" => Actuator::Torque(self.body()?),
            "impulse_x" => Actuator::ImpulseX(self.body()?),
            "impulse_y" => Actuator::ImpulseY(self.body()?),
            "thrust" => Actuator::Thrust(self.body()?),
            "velocity_x" => Actuator::VelocityX(self.body()?),
            "velocity_y" => Actuator::VelocityY(self.body()?),
            "angular_velocity" => Actuator::AngularVelocity(self.body()?),
            "position_x" => Actuator::PositionX(self.body()?),
            "position_y" => Actuator::PositionY(self.body()?),
            "angle" => Actuator::Angle(self.body()?),
            "motor_speed" => Actuator::MotorSpeed(self.joint()?),
            "motor_max" => Actuator::MotorMax(self.joint()?),
            "gravity_y" => Actuator::GravityY,
            _ => return Err(self.unknown("actuator")),
        })
    }

    fn reading(&self) -> PyResult<Reading> {
        Ok(match self.name.as_str() {
            "position_x" => Reading::PositionX(self.body()?),
            "position_y" => Reading::PositionY(self.body()?),
            "angle" => Reading::Angle(self.body()?),
            "velocity_x" => Reading::VelocityX(self.body()?),
            "velocity_y" => Reading::VelocityY(self.body()?),
            "angular_velocity" => Reading::AngularVelocity(self.body()?),
            "awake" => Reading::Awake(self.body()?),
            "touching" => Reading::Touching(self.body()?),
            "joint_angle" => Reading::JointAngle(self.joint()?),
            "joint_speed" => Reading::JointSpeed(self.joint()?),
            "joint_holds" => Reading::JointHolds(self.joint()?),
            "ray" => Reading::Ray(self.sight()?),
            _ => return Err(self.unknown("reading")),
        })
    }

    fn sight(&self) -> PyResult<Sight> {
        let pair =
            |i: usize| -> PyResult<Vec2> { Ok(self.rest.get_item(i)?.extract::<Pair>()?.into()) };
        let mask = self.rest.get_item(3).map_or(Ok(u64::MAX), |mask| mask.extract())?;
        Ok(Sight { body: self.body()?, offset: pair(1)?, translation: pair(2)?, mask })
    }
}

fn actuators(list: &[Bound<'_, PyAny>]) -> PyResult<Vec<Actuator>> {
    list.iter().map(|item| Named::new(item)?.actuator()).collect()
}

fn readings(list: &[Bound<'_, PyAny>]) -> PyResult<Vec<Reading>> {
    list.iter().map(|item| Named::new(item)?.reading()).collect()
}

#[pymethods]
impl WorldBatch {
    #[new]
    #[pyo3(signature = (templates, count, threads=0, actuators=Vec::new(), readings=Vec::new()))]
    fn new(
        py: Python<'_>,
        templates: Bound<'_, PyAny>,
        count: usize,
        threads: usize,
        actuators: Vec<Bound<'_, PyAny>>,
        readings: Vec<Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let templates: Vec<Bound<'_, World>> = match templates.cast::<World>() {
            Ok(world) => vec![world.clone()],
            Err(_) => templates.extract()?,
        };
        let worlds: Vec<_> =
            templates.iter().map(|w| Ok(w.try_borrow()?.inner.clone())).collect::<PyResult<_>>()?;
        let inner = py.detach(|| Inner::new(&worlds, count, threads)).map_err(batch_error)?;
        Self::with(py, inner, self::actuators(&actuators)?, self::readings(&readings)?)
    }

    fn __len__(&self) -> usize {
        self.inner.len()
    }

    /// Threads that it steps on.
    #[getter]
    fn threads(&self) -> usize {
        self.inner.threads()
    }

    #[setter]
    fn set_threads(&mut self, value: usize) -> PyResult<()> {
        self.inner.set_threads(value).map_err(batch_error)
    }

    /// What the worlds show now, float32, shape (worlds, readings). Always the same array: the next step or reset
    /// writes over it; copy what you keep.
    #[getter]
    fn observations<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f32>> {
        self.observations.bind(py).clone()
    }

    /// Does the actions in every step and moves all worlds on by `dt` seconds, `steps` times; gives `observations`.
    /// Other Python threads run meanwhile.
    ///
    /// actions: float32, shape (worlds, actuators), or (worlds * actuators,), world after world; what NumPy makes floats of is
    /// rounded to that. May be left out where nothing is to be done.
    ///
    /// Raises ValueError where the shape is another, a number is not finite, or `dt` is not above 0; nothing has changed
    /// then. Raises it, too, where a body does not take a number, and says in which world; the others have had their actions then.
    #[pyo3(signature = (actions=None, dt=1.0 / 60.0, steps=1))]
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        actions: Option<&Bound<'py, PyAny>>,
        dt: f32,
        steps: u32,
    ) -> PyResult<Bound<'py, PyArray2<f32>>> {
        if !(dt.is_finite() && dt > 0.0) {
            return Err(PyValueError::new_err(format!("dt is {dt}; allowed is above 0")));
        }
        let (worlds, each) = (self.inner.len(), self.actuators.len());
        let actions = actions.map(|actions| convert::actions(actions, worlds, each)).transpose()?;
        let Self { inner, actuators, .. } = self;
        py.detach(|| {
            for _ in 0..steps {
                if let Some(actions) = &actions {
                    inner.apply(actuators, actions)?;
                }
                inner.step(dt)?;
            }
            Ok(())
        })
        .map_err(batch_error)?;
        self.observe(py)?;
        Ok(self.observations(py))
    }

    /// Makes worlds copies of their templates again: all, or those of `indices`, or where a mask of a bool for each world
    /// says so.
    ///
    /// Raises IndexError where a world is not there, ValueError where a mask has another length; nothing has changed then.
    #[pyo3(signature = (indices=None))]
    fn reset(&mut self, py: Python<'_>, indices: Option<Vec<Bound<'_, PyAny>>>) -> PyResult<()> {
        let indices = self.indices(indices, true)?;
        self.inner.reset(&indices).map_err(batch_error)?;
        self.observe(py)
    }

    /// Gives world i the random numbers of seeds[i]: whole numbers, shape (worlds,).
    fn seed(&mut self, seeds: Vec<u64>) -> PyResult<()> {
        self.inner.seed(&seeds).map_err(batch_error)
    }

    /// Does to each of the worlds what random numbers say, drawn evenly from `low` to `high`, one for each actuator, from
    /// the world's own generator.
    #[pyo3(signature = (actuators, low, high, indices=None))]
    fn scatter(
        &mut self,
        py: Python<'_>,
        actuators: Vec<Bound<'_, PyAny>>,
        low: Vec<f32>,
        high: Vec<f32>,
        indices: Option<Vec<Bound<'_, PyAny>>>,
    ) -> PyResult<()> {
        let indices = self.indices(indices, false)?;
        let actuators = self::actuators(&actuators)?;
        self.inner.scatter(&indices, &actuators, &low, &high).map_err(batch_error)?;
        self.observe(py)
    }

    /// Casts the same rays in every world. rays: float64, shape (n, 4): origin x, y, translation x, y, metres. Gives
    /// the fraction of each until it enters a shape, float32, shape (worlds, n); 1 where it meets nothing.
    #[pyo3(signature = (rays, mask=u64::MAX))]
    fn ray_casts<'py>(
        &mut self,
        py: Python<'py>,
        rays: &Bound<'py, PyAny>,
        mask: u64,
    ) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let (count, rays) = (self.inner.len(), convert::rays(rays)?);
        let all = rays.repeat(count);
        let (inner, mut hits) = (&mut self.inner, Vec::new());
        py.detach(|| inner.ray_casts(&all, &QueryFilter::new().mask(mask), &mut hits))
            .map_err(batch_error)?;
        let fractions: Vec<f32> =
            hits.into_iter().map(|hit| hit.map_or(1.0, |hit| hit.fraction)).collect();
        fractions.into_pyarray(py).reshape([count, rays.len()])
    }

    /// The state hash of each world, uint64, shape (worlds,).
    fn state_hashes<'py>(&mut self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<u64>>> {
        let inner = &mut self.inner;
        Ok(py.detach(|| inner.state_hashes()).map_err(batch_error)?.into_pyarray(py))
    }

    /// A copy of a world of the batch.
    fn world(&self, index: usize) -> PyResult<World> {
        let missing = || PyIndexError::new_err(format!("there is no world {index}"));
        Ok(World { inner: self.inner.world(index).ok_or_else(missing)?.clone() })
    }

    /// Puts a copy of a world in the place of one of the batch.
    fn set_world(&mut self, py: Python<'_>, index: usize, world: &World) -> PyResult<()> {
        let missing = || PyIndexError::new_err(format!("there is no world {index}"));
        self.inner.world_mut(index).ok_or_else(missing)?.clone_from(&world.inner);
        self.observe(py)
    }

    /// Bytes that the worlds hold in memory.
    #[getter]
    fn memory(&self) -> usize {
        self.inner.memory()
    }

    /// The whole batch as bytes: worlds, templates, generators; not actuators and readings.
    fn to_bytes<'py>(&mut self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let inner = &mut self.inner;
        Ok(PyBytes::new(py, &py.detach(|| inner.to_bytes()).map_err(batch_error)?))
    }

    /// Goes back to what was saved.
    ///
    /// Raises ValueError where the bytes are no saved batch of as many worlds; nothing has changed then.
    fn restore_bytes(&mut self, py: Python<'_>, bytes: &[u8]) -> PyResult<()> {
        let count = self.inner.len();
        let saved = py.detach(|| Inner::from_bytes(bytes, 1)).map_err(batch_error)?;
        if saved.len() != count {
            let reason = format!("{} worlds were saved, this batch has {count}", saved.len());
            return Err(PyValueError::new_err(reason));
        }
        let threads = self.inner.threads();
        self.inner = saved;
        self.inner.set_threads(threads).map_err(batch_error)?;
        self.observe(py)
    }

    fn __repr__(&self) -> String {
        format!("<WorldBatch of {} worlds on {} threads>", self.inner.len(), self.inner.threads())
    }
}

impl WorldBatch {
    fn with(
        py: Python<'_>,
        inner: Inner,
        actuators: Vec<Actuator>,
        readings: Vec<Reading>,
    ) -> PyResult<Self> {
        let observations = PyArray2::zeros(py, [inner.len(), readings.len()], false).unbind();
        let mut batch = Self { inner, actuators, readings, observations };
        batch.observe(py)?;
        Ok(batch)
    }

    /// The worlds that are meant: all where nothing is said. Python takes bools for the numbers 0 and 1; here they are a mask.
    fn indices(
        &self,
        given: Option<Vec<Bound<'_, PyAny>>>,
        may_be_mask: bool,
    ) -> PyResult<Vec<usize>> {
        let Some(given) = given else { return Ok((0..self.inner.len()).collect()) };
        let mask: Vec<bool> = given.iter().map_while(|item| item.extract().ok()).collect();
        let any_bool = given.iter().any(|item| item.extract::<bool>().is_ok());
        if !any_bool {
            return given.iter().map(|item| item.extract()).collect();
        }
        let (count, worlds) = (given.len(), self.inner.len());
        if !may_be_mask {
            return Err(PyValueError::new_err("indices are whole numbers, and no bools"));
        }
        if mask.len() != count || count != worlds {
            let words = format!("a mask is a bool for each of the {worlds} worlds; got {count}");
            return Err(PyValueError::new_err(words));
        }
        Ok((0..worlds).filter(|&i| mask[i]).collect())
    }

    /// Reads all worlds into the array that Python sees.
    fn observe(&mut self, py: Python<'_>) -> PyResult<()> {
        let mut out = self.observations.bind(py).try_readwrite().map_err(locked)?;
        let (out, inner, readings) = (out.as_slice_mut()?, &mut self.inner, &self.readings);
        py.detach(|| inner.read(readings, out)).map_err(batch_error)
    }
}
