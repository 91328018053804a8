//! Shapes.

use crate::convert::{StaleHandleError, error, read, read_over, write};
use crate::handles::{Body, Shape};
use pyo3::prelude::*;
use tiny_physics::{self as engine, Filter, Material};

impl Shape {
    fn stale(&self) -> PyErr {
        StaleHandleError::new_err(format!("{} has been removed or was never here", self.id))
    }

    fn get<T>(&self, py: Python<'_>, get: impl FnOnce(engine::ShapeRef<'_>) -> T) -> PyResult<T> {
        let world = self.world.try_borrow(py)?;
        world.inner.shape(self.id).map(get).ok_or_else(|| self.stale())
    }

    fn set<T>(&self, py: Python<'_>, set: impl FnOnce(engine::ShapeMut<'_>) -> T) -> PyResult<T> {
        let mut world = self.world.try_borrow_mut(py)?;
        world.inner.shape_mut(self.id).map(set).ok_or_else(|| self.stale())
    }
}

#[pymethods]
impl Shape {
    /// Is it still in the world?
    #[getter]
    fn is_valid(&self, py: Python<'_>) -> PyResult<bool> {
        Ok(self.world.try_borrow(py)?.inner.shape(self.id).is_some())
    }

    /// Dense index: small, used again after removal.
    #[getter]
    fn index(&self) -> usize {
        self.id.index()
    }

    /// Its body.
    #[getter]
    fn body(&self, py: Python<'_>) -> PyResult<Body> {
        let id = self.get(py, |shape| shape.body())?;
        Ok(Body { world: self.world.clone_ref(py), id })
    }

    /// Its geometry, as in scene files: {"circle": {"radius": 0.5}}. Metres, the shape's frame.
    #[getter]
    fn geometry<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        write(py, &self.get(py, |shape| *shape.shape())?)
    }

    #[setter]
    fn set_geometry(&self, py: Python<'_>, value: &Bound<'_, PyAny>) -> PyResult<()> {
        let geometry: engine::Shape = read(value)?;
        self.set(py, |mut shape| shape.set_shape(geometry))?.map_err(error)
    }

    /// (x, y, angle) of its frame in the world: metres, radians.
    #[getter]
    fn pose(&self, py: Python<'_>) -> PyResult<(f64, f64, f32)> {
        self.get(py, |shape| (shape.pose().p.x, shape.pose().p.y, shape.pose().q.angle()))
    }

    /// (x, y, angle) of its frame in its body's frame: metres, radians.
    #[getter]
    fn local_pose(&self, py: Python<'_>) -> PyResult<(f32, f32, f32)> {
        self.get(py, |shape| (shape.local().p.x, shape.local().p.y, shape.local().q.angle()))
    }

    /// Density, friction, restitution and so on, as a dictionary. What one that is set does not have stays as it is.
    #[getter]
    fn material<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        write(py, &self.get(py, |shape| shape.material())?)
    }

    #[setter]
    fn set_material(&self, py: Python<'_>, value: &Bound<'_, PyAny>) -> PyResult<()> {
        let material: Material = read_over(&self.get(py, |shape| shape.material())?, value)?;
        self.set(py, |mut shape| shape.set_material(material))?.map_err(error)
    }

    /// Category, mask and group, as a dictionary. What one that is set does not have stays as it is.
    #[getter]
    fn filter<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        write(py, &self.get(py, |shape| shape.filter())?)
    }

    #[setter]
    fn set_filter(&self, py: Python<'_>, value: &Bound<'_, PyAny>) -> PyResult<()> {
        let filter: Filter = read_over(&self.get(py, |shape| shape.filter())?, value)?;
        self.set(py, |mut shape| shape.set_filter(filter))
    }

    /// Does it only sense?
    #[getter]
    fn sensor(&self, py: Python<'_>) -> PyResult<bool> {
        self.get(py, |shape| shape.is_sensor())
    }

    #[setter]
    fn set_sensor(&self, py: Python<'_>, value: bool) -> PyResult<()> {
        self.set(py, |mut shape| shape.set_sensor(value))
    }

    /// A whole number that is yours.
    #[getter]
    fn user_data(&self, py: Python<'_>) -> PyResult<u64> {
        self.get(py, |shape| shape.user_data())
    }

    #[setter]
    fn set_user_data(&self, py: Python<'_>, value: u64) -> PyResult<()> {
        self.set(py, |mut shape| shape.set_user_data(value))
    }

    /// What overlaps this sensor.
    fn overlaps(&self, py: Python<'_>) -> PyResult<Vec<Shape>> {
        let world = self.world.try_borrow(py)?;
        let shape = |id| Shape { world: self.world.clone_ref(py), id };
        Ok(world.inner.sensor_overlaps(self.id).map(shape).collect())
    }

    /// Switches contact and hit events on or off.
    #[pyo3(signature = (contact=true, hit=false))]
    fn set_events(&self, py: Python<'_>, contact: bool, hit: bool) -> PyResult<()> {
        self.set(py, |mut shape| shape.set_events(contact, hit))
    }

    /// Removes it from its body.
    fn remove(&self, py: Python<'_>) -> PyResult<()> {
        self.world.try_borrow_mut(py)?.inner.remove_shape(self.id).map_err(error)
    }

    fn __repr__(&self) -> String {
        format!("<Shape {}>", self.id.index())
    }
}
