//! Joints.

use crate::convert::{StaleHandleError, error, place, read, tuple, write};
use crate::handles::{Body, Joint};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use tiny_physics::{self as engine, JointDef, JointKind, Motor};

impl Joint {
    fn get<T>(&self, py: Python<'_>, get: impl FnOnce(engine::JointRef<'_>) -> T) -> PyResult<T> {
        let world = self.world.try_borrow(py)?;
        let stale = || StaleHandleError::new_err(format!("{} has been removed", self.id));
        world.inner.joint(self.id).map(get).ok_or_else(stale)
    }

    fn set(&self, py: Python<'_>, def: JointDef) -> PyResult<()> {
        self.world.try_borrow_mut(py)?.inner.set_joint(self.id, def).map_err(error)
    }
}

#[pymethods]
impl Joint {
    /// Is it still in the world?
    #[getter]
    fn is_valid(&self, py: Python<'_>) -> PyResult<bool> {
        Ok(self.world.try_borrow(py)?.inner.joint(self.id).is_some())
    }

    /// Dense index: small, used again after removal.
    #[getter]
    fn index(&self) -> usize {
        self.id.index()
    }

    /// Its two bodies.
    #[getter]
    fn bodies(&self, py: Python<'_>) -> PyResult<(Body, Body)> {
        let (a, b) = self.get(py, |joint| joint.bodies())?;
        let body = |id| Body { world: self.world.clone_ref(py), id };
        Ok((body(a), body(b)))
    }

    /// Its description, in the form of scene files.
    #[getter]
    fn description<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        write(py, &self.get(py, |joint| *joint.def())?)
    }

    #[setter]
    fn set_description(&self, py: Python<'_>, value: &Bound<'_, PyAny>) -> PyResult<()> {
        let def: JointDef = read(value)?;
        self.set(py, def)
    }

    /// Its anchors on both bodies: ((x, y), (x, y)), world, metres.
    #[getter]
    fn anchors(&self, py: Python<'_>) -> PyResult<((f64, f64), (f64, f64))> {
        self.get(py, |joint| (place(joint.anchors().0), place(joint.anchors().1)))
    }

    /// Angle of body B against A as the joint counts it, radians anticlockwise, -pi to pi: that of B and `angle_b`, less
    /// that of A and `angle_a`. Limits and targets of hinges are such angles.
    #[getter]
    fn angle(&self, py: Python<'_>) -> PyResult<f32> {
        self.get(py, |joint| joint.angle())
    }

    /// How fast `angle` grows, radians a second: what the motor of a hinge or wheel drives.
    #[getter]
    fn angular_speed(&self, py: Python<'_>) -> PyResult<f32> {
        self.get(py, |joint| joint.angular_speed())
    }

    /// Of a slider or wheel, how far the anchor on B is from that on A along the joint's direction, metres; of others the
    /// distance of the anchors.
    #[getter]
    fn translation(&self, py: Python<'_>) -> PyResult<f32> {
        self.get(py, |joint| joint.translation())
    }

    /// How fast `translation` grows, metres a second: what the motor of a slider or rod drives.
    #[getter]
    fn speed(&self, py: Python<'_>) -> PyResult<f32> {
        self.get(py, |joint| joint.speed())
    }

    /// Force (newtons) or torque (newton metres) that the motor exerted on B in the last step, positive the way that
    /// positive speeds go; 0 without a motor and while it sleeps.
    #[getter]
    fn motor_load(&self, py: Python<'_>) -> PyResult<f32> {
        self.get(py, |joint| joint.motor_load())
    }

    /// Force on body B in the last step: (x, y), newtons.
    #[getter]
    fn force(&self, py: Python<'_>) -> PyResult<(f32, f32)> {
        self.get(py, |joint| tuple(joint.force()))
    }

    /// Torque on body B in the last step, newton metres.
    #[getter]
    fn torque(&self, py: Python<'_>) -> PyResult<f32> {
        self.get(py, |joint| joint.torque())
    }

    /// Drives it at a speed (metres or radians a second) with at most `max` newtons or newton metres.
    ///
    /// Raises ValueError where a number makes no sense or the kind has no motor.
    fn set_motor(&self, py: Python<'_>, speed: f32, max: f32) -> PyResult<()> {
        let mut def = self.get(py, |joint| *joint.def())?;
        match &mut def.kind {
            JointKind::Distance { motor, .. }
            | JointKind::Revolute { motor, .. }
            | JointKind::Prismatic { motor, .. }
            | JointKind::Wheel { motor, .. } => *motor = Some(Motor { speed, max }),
            _ => return Err(PyValueError::new_err("this kind of joint has no motor")),
        }
        self.set(py, def)
    }

    /// Removes it. Its bodies wake.
    fn remove(&self, py: Python<'_>) -> PyResult<()> {
        self.world.try_borrow_mut(py)?.inner.remove_joint(self.id).map_err(error)
    }

    fn __repr__(&self) -> String {
        format!("<Joint {}>", self.id.index())
    }
}
