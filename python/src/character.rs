//! Characters.

use crate::convert::{Pair, place, read, tuple, write};
use crate::handles::{Body, Shape, World};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tiny_physics::{BodyId, CharacterMover, DVec2, MoverInput, ShapeId, Vec2};

/// A capsule that walks through a world by rules: it climbs slopes and steps, jumps, rides on platforms and pushes things. It
/// is a value beside the world and no body: keep a `copy()` with the world's.
///
/// position: its middle: (x, y), world, metres. height, radius: of the whole capsule, metres. Other fields: max_slope (radians),
/// step_height, snap_distance, skin (metres), push_force (newtons), mass (kilograms), gravity_scale, filter.
///
/// Raises ValueError where a field is unknown.
#[pyclass(module = "tiny_physics", skip_from_py_object)]
#[derive(Clone)]
pub struct Character {
    inner: CharacterMover,
}

/// What it stands on or ran into, as a dictionary.
fn met<'py>(
    world: &Bound<'py, World>,
    (body, shape): (BodyId, ShapeId),
    (point, normal): (DVec2, Vec2),
) -> PyResult<Bound<'py, PyDict>> {
    let met = PyDict::new(world.py());
    met.set_item("shape", Shape { world: world.clone().unbind(), id: shape })?;
    met.set_item("body", Body { world: world.clone().unbind(), id: body })?;
    met.set_item("point", place(point))?;
    met.set_item("normal", tuple(normal))?;
    Ok(met)
}

#[pymethods]
impl Character {
    #[new]
    #[pyo3(signature = (position, height, radius, **fields))]
    fn new(
        py: Python<'_>,
        position: Pair,
        height: f32,
        radius: f32,
        fields: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let mut made = Self { inner: CharacterMover::new(DVec2::from(position), height, radius) };
        if let Some(fields) = fields {
            let said = made.description(py)?;
            said.cast::<PyDict>()?.update(fields.as_mapping())?;
            made.inner = read(&said)?;
        }
        Ok(made)
    }

    /// All that it is, as a dictionary: its settings, and what it remembers.
    #[getter]
    fn description<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        write(py, &self.inner)
    }

    #[setter]
    fn set_description(&mut self, value: &Bound<'_, PyAny>) -> PyResult<()> {
        self.inner = read(value)?;
        Ok(())
    }

    /// Its middle: (x, y), world, metres. Set it to teleport.
    #[getter]
    fn position(&self) -> (f64, f64) {
        place(self.inner.position)
    }

    #[setter]
    fn set_position(&mut self, value: Pair) {
        self.inner.position = DVec2::from(value);
    }

    /// Velocity in the air, on the ground that of the last update: (x, y), metres a second.
    #[getter]
    fn velocity(&self) -> (f32, f32) {
        tuple(self.inner.velocity)
    }

    #[setter]
    fn set_velocity(&mut self, value: Pair) {
        self.inner.velocity = Vec2::from(value);
    }

    /// Of the whole capsule, metres; `resize` changes it.
    #[getter]
    fn height(&self) -> f32 {
        self.inner.height
    }

    /// Metres.
    #[getter]
    fn radius(&self) -> f32 {
        self.inner.radius
    }

    /// Does it stand on something?
    #[getter]
    fn grounded(&self) -> bool {
        self.inner.ground().is_some()
    }

    /// What it stands on: a dictionary with "shape", "body", "point" (world, metres), "normal"; None in the air.
    fn ground<'py>(&self, world: &Bound<'py, World>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let ground = self.inner.ground();
        ground.map(|g| met(world, (g.body, g.shape), (g.point, g.normal))).transpose()
    }

    /// What stopped it in the last update, and in all `move_by` since: dictionaries as of `ground`.
    fn hits<'py>(&self, world: &Bound<'py, World>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let hits = self.inner.hits().iter();
        hits.map(|hit| met(world, (hit.body, hit.shape), (hit.point, hit.normal))).collect()
    }

    /// Gives it a body of its own in the world, which it takes along and does not collide with: a sensor of its form that sees
    /// other sensors, so that "sensor_begin" tells of pickups and doors.
    fn add_body(&mut self, world: &Bound<'_, World>) -> PyResult<Body> {
        let described = self.inner.describe_body();
        let added = world.try_borrow_mut()?.inner.add_body(described);
        let id = added.map_err(crate::convert::error)?;
        self.inner.body = Some(id);
        Ok(Body { world: world.clone().unbind(), id })
    }

    /// Moves it on by `dt` seconds: call it after each `World.step` with the same `dt`.
    ///
    /// walk: metres a second to the right. jump: speed off the ground, metres a second; in the air nothing happens. drop: falls
    /// through the one-way platforms that it stands on.
    ///
    /// Raises ValueError where a number is not finite or dt not above 0.
    #[pyo3(signature = (world, walk=0.0, jump=0.0, drop=false, dt=1.0 / 60.0))]
    fn update(
        &mut self,
        world: &Bound<'_, World>,
        walk: f32,
        jump: f32,
        drop: bool,
        dt: f32,
    ) -> PyResult<()> {
        if !(walk.is_finite() && jump.is_finite() && dt.is_finite() && dt > 0.0) {
            let reason = "walk, jump and dt have to be finite, dt above 0";
            return Err(PyValueError::new_err(reason));
        }
        let input = MoverInput { walk, jump, drop };
        self.inner.update(&mut world.try_borrow_mut()?.inner, input, dt);
        Ok(())
    }

    /// Moves it by (x, y) metres along what is in its way, without gravity, and gives the motion that came of it: for ladders
    /// and dashes, in place of an update. It is at rest afterwards.
    fn move_by(&mut self, world: &Bound<'_, World>, motion: Pair) -> PyResult<(f32, f32)> {
        let mut world = world.try_borrow_mut()?;
        let made = self.inner.move_by(&world.inner, Vec2::from(motion));
        self.inner.lead_body(&mut world.inner);
        Ok(tuple(made))
    }

    /// Makes the next update leave the ground with this velocity: (x, y), metres a second.
    fn launch(&mut self, velocity: Pair) {
        self.inner.launch(Vec2::from(velocity));
    }

    /// Takes another height and radius (metres), with its foot where it is; False where there is no room.
    fn resize(&mut self, world: &World, height: f32, radius: f32) -> bool {
        self.inner.resize(&world.inner, height, radius)
    }

    /// Is it free of everything that it collides with?
    fn fits(&self, world: &World) -> bool {
        self.inner.fits(&world.inner)
    }

    /// Where to draw it between its places before (`alpha` 0) and after (1) the last update: (x, y), metres.
    fn interpolated_position(&self, alpha: f32) -> (f64, f64) {
        place(self.inner.interpolated_position(alpha))
    }

    /// A copy with the same future in a copy of the world.
    fn copy(&self) -> Self {
        self.clone()
    }

    fn __copy__(&self) -> Self {
        self.clone()
    }

    fn __deepcopy__(&self, _memo: &Bound<'_, PyAny>) -> Self {
        self.clone()
    }

    fn __repr__(&self) -> String {
        let (p, stands) = (self.inner.position, self.inner.ground().is_some());
        let how = if stands { "standing" } else { "in the air" };
        format!("<Character at ({:.3}, {:.3}), {how}>", p.x, p.y)
    }
}
