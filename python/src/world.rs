//! Worlds.

use crate::convert::{Pair, error, locked, place, read, tuple, write};
use crate::draw::{Picture, View};
use crate::handles::{Body, Joint, Shape, World};
use numpy::{PyArray2, PyArray3, PyArrayMethods, PyReadwriteArray2, PyUntypedArrayMethods};
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use tiny_physics::{self as engine, ChainDef, JointDef, RigidBody, Settings, Stage, Vec2};
use tiny_physics_scenes::{Scene, WorldHost};

impl World {
    fn body(slf: &Bound<'_, Self>, id: engine::BodyId) -> Body {
        Body { world: slf.clone().unbind(), id }
    }

    fn shape(slf: &Bound<'_, Self>, id: engine::ShapeId) -> Shape {
        Shape { world: slf.clone().unbind(), id }
    }
}

/// Refuses a body of another world, whose handle would mean something else here.
pub fn own(slf: &Bound<'_, World>, body: &Body) -> PyResult<()> {
    if body.world.is(slf) {
        return Ok(());
    }
    Err(PyValueError::new_err("this body belongs to another world"))
}

#[pymethods]
impl World {
    #[new]
    #[pyo3(signature = (gravity=Pair(0.0, -9.8), settings=None))]
    fn new(gravity: Pair, settings: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let settings: Settings = settings.map_or_else(|| Ok(Settings::default()), read)?;
        settings.validate().map_err(error)?;
        Ok(Self { inner: engine::World::with_settings(Vec2::from(gravity), settings) })
    }

    /// A world as a scene file says, before its first step; what a script does to it is left out.
    ///
    /// Raises ValueError with line, column and field where the file is bad.
    #[staticmethod]
    fn from_scene(path: std::path::PathBuf) -> PyResult<Self> {
        Self::of(&Scene::load(path).map_err(|error| PyValueError::new_err(error.to_string()))?)
    }

    /// A world from the text of a scene file.
    #[staticmethod]
    fn from_scene_json(text: &str) -> PyResult<Self> {
        Self::of(&Scene::from_json(text).map_err(|error| PyValueError::new_err(error.to_string()))?)
    }

    /// A built-in scene by its name, as `tiny-physics list` shows them.
    #[staticmethod]
    fn scene(name: &str) -> PyResult<Self> {
        let entry = tiny_physics_scenes::find(name);
        let entry = entry.map_err(|error| PyValueError::new_err(error.to_string()))?;
        Self::of(&entry.build(tiny_physics_scenes::Options::default()))
    }

    /// (x, y), metres a second squared.
    #[getter]
    fn gravity(&self) -> (f32, f32) {
        tuple(self.inner.gravity)
    }

    #[setter]
    fn set_gravity(&mut self, value: Pair) {
        self.inner.gravity = Vec2::from(value);
    }

    /// Substeps, thresholds and so on, as a dictionary. Set it with what is to differ from the defaults.
    #[getter]
    fn settings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        write(py, &self.inner.settings)
    }

    #[setter]
    fn set_settings(&mut self, value: &Bound<'_, PyAny>) -> PyResult<()> {
        let settings: Settings = read(value)?;
        settings.validate().map_err(error)?;
        self.inner.settings = settings;
        Ok(())
    }

    /// Threads that a step may use. Results do not depend on it.
    #[getter]
    fn threads(&self) -> usize {
        self.inner.threads()
    }

    #[setter]
    fn set_threads(&mut self, value: usize) {
        self.inner.set_threads(value);
    }

    /// Steps made so far.
    #[getter]
    fn step_count(&self) -> u64 {
        self.inner.step_count()
    }

    /// Adds a body.
    ///
    /// shapes: one description or a list of them, as `tiny_physics.circle(0.5)` gives.
    /// Other fields as in scene files: kind ("dynamic", "static", "kinematic"), position, angle, velocity,
    /// angular_velocity, mass, linear_damping, angular_damping, gravity_scale, locks, can_sleep, awake, bullet,
    /// enabled, user_data.
    ///
    /// Raises ValueError where a field is unknown or a number makes no sense.
    #[pyo3(signature = (shapes=None, **fields))]
    fn add_body<'py>(
        slf: &Bound<'py, Self>,
        shapes: Option<Bound<'py, PyAny>>,
        fields: Option<Bound<'py, PyDict>>,
    ) -> PyResult<Body> {
        let fields = fields.unwrap_or_else(|| PyDict::new(slf.py()));
        if let Some(shapes) = shapes {
            let one = shapes.is_instance_of::<PyDict>();
            fields.set_item(
                "shapes",
                if one { vec![shapes].into_pyobject(slf.py())? } else { shapes },
            )?;
        }
        let body: RigidBody = read(fields.as_any())?;
        let id = slf.try_borrow_mut()?.inner.add_body(body).map_err(error)?;
        Ok(Self::body(slf, id))
    }

    /// Adds a chain of segments to a body: ground without bumps. Outside is the right of the way along the points.
    ///
    /// points: (x, y) each, body's frame, metres. Other fields as in scene files.
    #[pyo3(signature = (body, points, closed=false, friction=None))]
    fn add_chain(
        slf: &Bound<'_, Self>,
        body: &Body,
        points: Vec<Pair>,
        closed: bool,
        friction: Option<f32>,
    ) -> PyResult<Vec<Shape>> {
        own(slf, body)?;
        let points: Vec<Vec2> = points.into_iter().map(Vec2::from).collect();
        let mut chain = if closed { ChainDef::closed(&points) } else { ChainDef::open(&points) };
        if let Some(friction) = friction {
            chain = chain.friction(friction);
        }
        let ids = slf.try_borrow_mut()?.inner.add_chain(body.id, &chain).map_err(error)?;
        Ok(ids.iter().map(|id| Self::shape(slf, *id)).collect())
    }

    /// Joins two bodies of this world by a description, as `tiny_physics.revolute()` gives one.
    ///
    /// Raises StaleHandleError where a body is gone, ValueError where a number makes no sense.
    fn add_joint(
        slf: &Bound<'_, Self>,
        a: &Body,
        b: &Body,
        joint: &Bound<'_, PyAny>,
    ) -> PyResult<Joint> {
        own(slf, a)?;
        own(slf, b)?;
        let def: JointDef = read(joint)?;
        let id = slf.try_borrow_mut()?.inner.add_joint(a.id, b.id, def).map_err(error)?;
        Ok(Joint { world: slf.clone().unbind(), id })
    }

    /// Its bodies, in index order.
    #[getter]
    fn bodies(slf: &Bound<'_, Self>) -> PyResult<Vec<Body>> {
        Ok(slf.try_borrow()?.inner.body_ids().map(|id| Self::body(slf, id)).collect())
    }

    /// Its joints, in index order.
    #[getter]
    fn joints(slf: &Bound<'_, Self>) -> PyResult<Vec<Joint>> {
        let joint = |id| Joint { world: slf.clone().unbind(), id };
        Ok(slf.try_borrow()?.inner.joint_ids().map(joint).collect())
    }

    /// Bodies in the world.
    #[getter]
    fn body_count(&self) -> usize {
        self.inner.body_count()
    }

    /// Dynamic and kinematic bodies that are awake.
    #[getter]
    fn awake_body_count(&self) -> usize {
        self.inner.awake_body_count()
    }

    /// Moves the world on by `dt` seconds, `steps` times. Other Python threads run meanwhile.
    ///
    /// Raises ValueError where dt is not above 0 or gravity or a setting makes no sense.
    #[pyo3(signature = (dt=1.0 / 60.0, steps=1))]
    fn step(&mut self, py: Python<'_>, dt: f32, steps: u32) -> PyResult<()> {
        let inner = &mut self.inner;
        py.detach(|| (0..steps).try_for_each(|_| inner.try_step(dt))).map_err(error)
    }

    /// What happened in the last step: lists "contact_begin", "contact_end", "sensor_begin", "sensor_end" of
    /// pairs of shapes, "hits", "joint_breaks" of (joint, force, torque), "woke", "fell_asleep" of bodies.
    ///
    /// A hit is (shape, shape, point, normal, speed, impulse, mass, mass): metres a second along the normal, newton seconds
    /// that the step pushed the second away from the first (loudness and damage go by it), and the kilograms of their bodies, 0
    /// where they are not dynamic.
    fn events<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyDict>> {
        let (world, found) = (slf.try_borrow()?, PyDict::new(slf.py()));
        let events = world.inner.events();
        let pair = |a, b| (Self::shape(slf, a), Self::shape(slf, b));
        let begin = events.contact_begin().iter().map(|e| pair(e.shape_a, e.shape_b));
        found.set_item("contact_begin", begin.collect::<Vec<_>>())?;
        let end = events.contact_end().iter().map(|e| pair(e.shape_a, e.shape_b));
        found.set_item("contact_end", end.collect::<Vec<_>>())?;
        let begin = events.sensor_begin().iter().map(|e| pair(e.sensor, e.visitor));
        found.set_item("sensor_begin", begin.collect::<Vec<_>>())?;
        let end = events.sensor_end().iter().map(|e| pair(e.sensor, e.visitor));
        found.set_item("sensor_end", end.collect::<Vec<_>>())?;
        let hits = events.hits().iter().map(|hit| {
            let (a, b) = pair(hit.shape_a, hit.shape_b);
            let (at, normal, masses) =
                (place(hit.position), tuple(hit.normal), (hit.mass_a, hit.mass_b));
            (a, b, at, normal, hit.speed, hit.impulse, masses.0, masses.1)
        });
        found.set_item("hits", hits.collect::<Vec<_>>())?;
        let joint = |id| Joint { world: slf.clone().unbind(), id };
        let breaks = events.joint_breaks().iter();
        let breaks = breaks.map(|e| (joint(e.joint), tuple(e.force), e.torque));
        found.set_item("joint_breaks", breaks.collect::<Vec<_>>())?;
        for (name, ids) in [("woke", events.woke()), ("fell_asleep", events.fell_asleep())] {
            let bodies: Vec<Body> = ids.iter().map(|&id| Self::body(slf, id)).collect();
            found.set_item(name, bodies)?;
        }
        Ok(found)
    }

    /// Touching pairs: dictionaries with "shapes", "bodies", "normal" (from the first to the second) and "points"
    /// of (position, separation, normal impulse, tangent impulse): metres, newton seconds.
    fn contacts<'py>(slf: &Bound<'py, Self>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let world = slf.try_borrow()?;
        let contact = |view: engine::ContactView| {
            let contact = PyDict::new(slf.py());
            let shapes = (Self::shape(slf, view.shape_a), Self::shape(slf, view.shape_b));
            contact.set_item("shapes", shapes)?;
            let bodies = (Self::body(slf, view.body_a), Self::body(slf, view.body_b));
            contact.set_item("bodies", bodies)?;
            contact.set_item("normal", tuple(view.normal))?;
            let points = view.points().iter();
            let points = points
                .map(|p| (place(p.position), p.separation, p.normal_impulse, p.tangent_impulse));
            contact.set_item("points", points.collect::<Vec<_>>())?;
            Ok(contact)
        };
        world.inner.contacts().map(contact).collect()
    }

    /// A hash of all that the next step depends on: equal worlds have equal hashes, on every platform.
    fn state_hash(&self) -> u64 {
        self.inner.state_hash()
    }

    /// Kinetic energy, joules.
    fn kinetic_energy(&self) -> f64 {
        self.inner.kinetic_energy()
    }

    /// Bytes that the world holds, and seconds of each stage of the last step, as a dictionary. The seconds are 0: stages are timed
    /// by programs in Rust alone.
    fn stats<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (stats, found) = (self.inner.stats(), PyDict::new(py));
        for stage in Stage::ALL {
            found.set_item(stage.name(), stats.seconds(stage))?;
        }
        found.set_item("total", stats.total_seconds())?;
        found.set_item("bytes", self.inner.memory().total().held)?;
        Ok(found)
    }

    /// State of all bodies in index order, float64: x, y, angle, vx, vy, angular velocity. Shape (bodies, 6).
    ///
    /// out: an array to write into, of that shape, its rows one after another in memory (order C); a new one where it
    /// is left out.
    #[pyo3(signature = (out=None))]
    fn states<'py>(
        &self,
        py: Python<'py>,
        out: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let count = self.inner.body_count();
        let form =
            || PyValueError::new_err(format!("out must have the shape ({count}, 6), of float64"));
        let out = match out {
            Some(out) => out.cast_into::<PyArray2<f64>>().map_err(|_| form())?,
            None => PyArray2::zeros(py, [count, 6], false),
        };
        let mut rows: PyReadwriteArray2<'_, f64> = out.try_readwrite().map_err(locked)?;
        if rows.shape() != [count, 6] {
            return Err(form());
        }
        if !rows.is_c_contiguous() {
            return Err(PyValueError::new_err("out must be in order C"));
        }
        let rows = rows.as_slice_mut()?;
        for (row, id) in rows.chunks_mut(6).zip(self.inner.body_ids()) {
            let Some(body) = self.inner.body(id) else { continue };
            let (p, v) = (body.position_f64(), body.velocity());
            let (angle, spin) = (body.angle().into(), body.angular_velocity().into());
            row.copy_from_slice(&[p.x, p.y, angle, v.x.into(), v.y.into(), spin]);
        }
        Ok(out)
    }

    /// A copy with the same future.
    fn copy(&self) -> Self {
        Self { inner: self.inner.clone() }
    }

    fn __copy__(&self) -> Self {
        self.copy()
    }

    fn __deepcopy__(&self, _memo: &Bound<'_, PyAny>) -> Self {
        self.copy()
    }

    /// Goes back to a copy made before, in place; handles that were valid then are valid again.
    fn restore(&mut self, source: &Bound<'_, Self>) -> PyResult<()> {
        self.inner.clone_from(&source.try_borrow()?.inner);
        Ok(())
    }

    /// The world as bytes: the same on every platform.
    fn to_bytes<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.inner.to_bytes())
    }

    /// A world from its bytes.
    ///
    /// Raises ValueError where they are no saved world.
    #[staticmethod]
    fn from_bytes(bytes: &[u8]) -> PyResult<Self> {
        Ok(Self { inner: engine::World::from_bytes(bytes).map_err(error)? })
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyBytes>,))> {
        let make = slf.get_type().getattr("from_bytes")?;
        Ok((make, (slf.try_borrow()?.to_bytes(slf.py()),)))
    }

    /// The body of a handle of another copy of this world; None where it is not in this one.
    fn same(slf: &Bound<'_, Self>, body: &Body) -> PyResult<Option<Body>> {
        let here = slf.try_borrow()?.inner.body(body.id).is_some();
        Ok(here.then(|| Self::body(slf, body.id)))
    }

    /// A body by its index.
    fn body_at(slf: &Bound<'_, Self>, index: usize) -> PyResult<Body> {
        let found = slf.try_borrow()?.inner.body_ids().find(|id| id.index() == index);
        let missing = || PyIndexError::new_err(format!("no body has index {index}"));
        found.map(|id| Self::body(slf, id)).ok_or_else(missing)
    }

    /// A picture of the world as an array of bytes, shape (height, width, 3), red, green, blue.
    ///
    /// width, height: pixels, 16 to 16384. view: ((left, bottom), (right, top)), world, metres; all bodies where it
    /// is left out.
    #[pyo3(signature = (width=640, height=400, view=None))]
    fn draw<'py>(
        &self,
        py: Python<'py>,
        width: u32,
        height: u32,
        view: Option<(Pair, Pair)>,
    ) -> PyResult<Bound<'py, PyArray3<u8>>> {
        Picture::of(&self.inner, width, height, view.map(View::from))?.to_array(py)
    }

    /// A picture of the world as a PNG file.
    #[pyo3(signature = (width=640, height=400, view=None))]
    fn to_png<'py>(
        &self,
        py: Python<'py>,
        width: u32,
        height: u32,
        view: Option<(Pair, Pair)>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        Picture::of(&self.inner, width, height, view.map(View::from))?.to_png(py)
    }

    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        self.to_png(py, 640, 400, None)
    }

    fn __repr__(&self) -> String {
        let (bodies, awake) = (self.inner.body_count(), self.inner.awake_body_count());
        format!(
            "<World of {bodies} bodies, {awake} awake, after {} steps>",
            self.inner.step_count()
        )
    }
}

impl World {
    fn of(scene: &Scene) -> PyResult<Self> {
        let run = tiny_physics_scenes::Run::start(scene).map_err(error)?;
        let host: WorldHost = run.into_host();
        Ok(Self { inner: host.into_world() })
    }
}
