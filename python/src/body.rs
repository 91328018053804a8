//! Bodies.

use crate::convert::{Pair, StaleHandleError, error, heard, place, read, tuple, write};
use crate::handles::{Body, Joint, Shape, World};
use pyo3::prelude::*;
use tiny_physics::{self as engine, BodyKind, DVec2, Locks, Pose, Rot, ShapeDef, Vec2};

impl Body {
    fn stale(&self) -> PyErr {
        StaleHandleError::new_err(format!("{} has been removed or was never here", self.id))
    }

    /// Reads it.
    fn get<T>(&self, py: Python<'_>, get: impl FnOnce(engine::Body<'_>) -> T) -> PyResult<T> {
        let world = self.world.try_borrow(py)?;
        world.inner.body(self.id).map(get).ok_or_else(|| self.stale())
    }

    /// Changes it. Raises ValueError where the engine refuses a number.
    pub(crate) fn set<T>(
        &self,
        py: Python<'_>,
        set: impl FnOnce(engine::BodyMut<'_>) -> T,
    ) -> PyResult<T> {
        let mut world = self.world.try_borrow_mut(py)?;
        heard(&mut world.inner, |world| world.body_mut(self.id).map(set))?
            .ok_or_else(|| self.stale())
    }

    /// Where a force acts: the given point, else the centre of mass.
    fn point(&self, py: Python<'_>, point: Option<Pair>) -> PyResult<DVec2> {
        point.map_or_else(|| self.get(py, |body| body.center()), |point| Ok(DVec2::from(point)))
    }
}

#[pymethods]
impl Body {
    /// Is it still in the world?
    #[getter]
    fn is_valid(&self, py: Python<'_>) -> PyResult<bool> {
        Ok(self.world.try_borrow(py)?.inner.body(self.id).is_some())
    }

    /// Dense index: small, used again after removal.
    #[getter]
    fn index(&self) -> usize {
        self.id.index()
    }

    /// Its world.
    #[getter]
    fn world(&self, py: Python<'_>) -> Py<World> {
        self.world.clone_ref(py)
    }

    /// Origin of its frame: (x, y), world, metres.
    #[getter]
    fn position(&self, py: Python<'_>) -> PyResult<(f64, f64)> {
        self.get(py, |body| place(body.position_f64()))
    }

    #[setter]
    fn set_position(&self, py: Python<'_>, value: Pair) -> PyResult<()> {
        self.set(py, |mut body| body.set_position(DVec2::from(value)))
    }

    /// Radians, -pi to pi.
    #[getter]
    fn angle(&self, py: Python<'_>) -> PyResult<f32> {
        self.get(py, |body| body.angle())
    }

    #[setter]
    fn set_angle(&self, py: Python<'_>, value: f32) -> PyResult<()> {
        self.set(py, |mut body| body.set_angle(value))
    }

    /// Cosine and sine of the angle.
    #[getter]
    fn rotation(&self, py: Python<'_>) -> PyResult<(f32, f32)> {
        self.get(py, |body| (body.rotation().c, body.rotation().s))
    }

    /// Centre of mass: (x, y), world, metres.
    #[getter]
    fn center(&self, py: Python<'_>) -> PyResult<(f64, f64)> {
        self.get(py, |body| place(body.center()))
    }

    /// Centre of mass: (x, y), body's frame, metres.
    #[getter]
    fn local_center(&self, py: Python<'_>) -> PyResult<(f32, f32)> {
        self.get(py, |body| tuple(body.local_center()))
    }

    /// Velocity of the centre of mass: (x, y), metres a second.
    #[getter]
    fn velocity(&self, py: Python<'_>) -> PyResult<(f32, f32)> {
        self.get(py, |body| tuple(body.velocity()))
    }

    #[setter]
    fn set_velocity(&self, py: Python<'_>, value: Pair) -> PyResult<()> {
        self.set(py, |mut body| body.set_velocity(Vec2::from(value)))
    }

    /// Radians a second, anticlockwise.
    #[getter]
    fn angular_velocity(&self, py: Python<'_>) -> PyResult<f32> {
        self.get(py, |body| body.angular_velocity())
    }

    #[setter]
    fn set_angular_velocity(&self, py: Python<'_>, value: f32) -> PyResult<()> {
        self.set(py, |mut body| body.set_angular_velocity(value))
    }

    /// Kilograms; 0 where it is not dynamic.
    #[getter]
    fn mass(&self, py: Python<'_>) -> PyResult<f32> {
        self.get(py, |body| body.mass())
    }

    /// Moment of inertia about the centre of mass, kilogram square metres.
    #[getter]
    fn inertia(&self, py: Python<'_>) -> PyResult<f32> {
        self.get(py, |body| body.inertia())
    }

    /// "static", "kinematic" or "dynamic".
    #[getter]
    fn kind(&self, py: Python<'_>) -> PyResult<&'static str> {
        self.get(py, |body| match body.kind() {
            BodyKind::Static => "static",
            BodyKind::Kinematic => "kinematic",
            BodyKind::Dynamic => "dynamic",
        })
    }

    #[setter]
    fn set_kind(&self, py: Python<'_>, value: &Bound<'_, PyAny>) -> PyResult<()> {
        let kind: BodyKind = read(value)?;
        self.set(py, |mut body| body.set_kind(kind))
    }

    /// Is it awake?
    #[getter]
    fn awake(&self, py: Python<'_>) -> PyResult<bool> {
        self.get(py, |body| body.is_awake())
    }

    #[setter]
    fn set_awake(&self, py: Python<'_>, value: bool) -> PyResult<()> {
        self.set(py, |mut body| if value { body.wake() } else { body.sleep() })
    }

    /// Does it take part?
    #[getter]
    fn enabled(&self, py: Python<'_>) -> PyResult<bool> {
        self.get(py, |body| body.is_enabled())
    }

    #[setter]
    fn set_enabled(&self, py: Python<'_>, value: bool) -> PyResult<()> {
        self.set(py, |mut body| body.set_enabled(value))
    }

    /// Directions in which it cannot move, as a dictionary: {"x": False, "y": False, "rotation": True}. Set it with those
    /// that are to be locked.
    #[getter]
    fn locks<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        write(py, &self.get(py, |body| body.locks())?)
    }

    #[setter]
    fn set_locks(&self, py: Python<'_>, value: &Bound<'_, PyAny>) -> PyResult<()> {
        let locks: Locks = read(value)?;
        self.set(py, |mut body| body.set_locks(locks))
    }

    /// May it fall asleep?
    #[getter]
    fn can_sleep(&self, py: Python<'_>) -> PyResult<bool> {
        self.get(py, |body| body.can_sleep())
    }

    #[setter]
    fn set_can_sleep(&self, py: Python<'_>, value: bool) -> PyResult<()> {
        self.set(py, |mut body| body.set_can_sleep(value))
    }

    /// A flag that is kept and given back; it changes nothing: whatever is fast is looked out for, moving or not.
    #[getter]
    fn bullet(&self, py: Python<'_>) -> PyResult<bool> {
        self.get(py, |body| body.is_bullet())
    }

    #[setter]
    fn set_bullet(&self, py: Python<'_>, value: bool) -> PyResult<()> {
        self.set(py, |mut body| body.set_bullet(value))
    }

    /// Factor on the world's gravity.
    #[getter]
    fn gravity_scale(&self, py: Python<'_>) -> PyResult<f32> {
        self.get(py, |body| body.gravity_scale())
    }

    #[setter]
    fn set_gravity_scale(&self, py: Python<'_>, value: f32) -> PyResult<()> {
        self.set(py, |mut body| body.set_gravity_scale(value))
    }

    /// Linear and angular damping, 1/s.
    #[getter]
    fn damping(&self, py: Python<'_>) -> PyResult<(f32, f32)> {
        self.get(py, |body| body.damping())
    }

    #[setter]
    fn set_damping(&self, py: Python<'_>, value: Pair) -> PyResult<()> {
        self.set(py, |mut body| body.set_damping(value.0 as f32, value.1 as f32))
    }

    /// A whole number that is yours.
    #[getter]
    fn user_data(&self, py: Python<'_>) -> PyResult<u64> {
        self.get(py, |body| body.user_data())
    }

    #[setter]
    fn set_user_data(&self, py: Python<'_>, value: u64) -> PyResult<()> {
        self.set(py, |mut body| body.set_user_data(value))
    }

    /// Its shapes.
    #[getter]
    fn shapes(&self, py: Python<'_>) -> PyResult<Vec<Shape>> {
        let ids: Vec<_> = self.get(py, |body| body.shapes().collect())?;
        Ok(ids.into_iter().map(|id| Shape { world: self.world.clone_ref(py), id }).collect())
    }

    /// Its joints.
    #[getter]
    fn joints(&self, py: Python<'_>) -> PyResult<Vec<Joint>> {
        let ids: Vec<_> = self.get(py, |body| body.joints().collect())?;
        Ok(ids.into_iter().map(|id| Joint { world: self.world.clone_ref(py), id }).collect())
    }

    /// Velocity of a point that moves with it: (x, y), metres a second. `point`: world, metres.
    fn velocity_at(&self, py: Python<'_>, point: Pair) -> PyResult<(f32, f32)> {
        self.get(py, |body| tuple(body.velocity_at(DVec2::from(point))))
    }

    /// A point of its frame in the world. Both metres.
    fn to_world(&self, py: Python<'_>, point: Pair) -> PyResult<(f64, f64)> {
        self.get(py, |body| place(body.pose().apply(Vec2::from(point))))
    }

    /// A point of the world in its frame. Both metres.
    fn to_local(&self, py: Python<'_>, point: Pair) -> PyResult<(f32, f32)> {
        self.get(py, |body| tuple(body.pose().unapply(DVec2::from(point))))
    }

    /// A force for the next step, newtons. `point`: world, metres; the centre of mass where it is left out.
    #[pyo3(signature = (force, point=None))]
    fn apply_force(&self, py: Python<'_>, force: Pair, point: Option<Pair>) -> PyResult<()> {
        let point = self.point(py, point)?;
        self.set(py, |mut body| body.apply_force(Vec2::from(force), point))
    }

    /// A torque for the next step, newton metres.
    fn apply_torque(&self, py: Python<'_>, torque: f32) -> PyResult<()> {
        self.set(py, |mut body| body.apply_torque(torque))
    }

    /// An impulse, newton seconds. `point`: world, metres; the centre of mass where it is left out.
    #[pyo3(signature = (impulse, point=None))]
    fn apply_impulse(&self, py: Python<'_>, impulse: Pair, point: Option<Pair>) -> PyResult<()> {
        let point = self.point(py, point)?;
        self.set(py, |mut body| body.apply_impulse(Vec2::from(impulse), point))
    }

    /// An angular impulse, newton metre seconds.
    fn apply_angular_impulse(&self, py: Python<'_>, impulse: f32) -> PyResult<()> {
        self.set(py, |mut body| body.apply_angular_impulse(impulse))
    }

    /// Sets both velocities so that a step of `dt` seconds takes it to a place (its origin; world, metres) and an angle
    /// (radians): for kinematic bodies, which push what is in their way. Call it before each such step.
    #[pyo3(signature = (position, angle=0.0, dt=1.0 / 60.0))]
    fn set_target(&self, py: Python<'_>, position: Pair, angle: f32, dt: f32) -> PyResult<()> {
        let target = Pose::new(DVec2::from(position), Rot::from_angle(angle));
        self.set(py, |mut body| body.set_target(target, dt))
    }

    /// Adds a shape from its description, as `tiny_physics.circle(0.5)` gives one.
    ///
    /// Raises ValueError where a number of it makes no sense.
    fn add_shape(&self, py: Python<'_>, shape: &Bound<'_, PyAny>) -> PyResult<Shape> {
        let def: ShapeDef = read(shape)?;
        let mut world = self.world.try_borrow_mut(py)?;
        let id = world.inner.add_shape(self.id, def).map_err(error)?;
        Ok(Shape { world: self.world.clone_ref(py), id })
    }

    /// Removes it with its shapes and joints.
    fn remove(&self, py: Python<'_>) -> PyResult<()> {
        self.world.try_borrow_mut(py)?.inner.remove_body(self.id).map_err(error)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let described = self.get(py, |body| {
            let (p, kind) = (body.position(), body.kind());
            format!("<Body {} {kind:?} at ({:.3}, {:.3})>", self.id.index(), p.x, p.y)
        });
        Ok(described.unwrap_or_else(|_| format!("<Body {} removed>", self.id.index())))
    }
}
