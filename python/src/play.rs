//! What is built on worlds: forces.

use crate::convert::{Pair, heard, read};
use crate::handles::{Body, World};
use crate::query::filter;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tiny_physics::{Aabb, DVec2, Explosion, ForceZone, Pose, Rot, Vec2, Water, Wind};

#[pymethods]
impl World {
    /// Sets off an explosion: every dynamic shape in reach gets an impulse away from the centre (world, metres), in
    /// proportion to its width as seen from there.
    ///
    /// radius: up to here it has its full strength, metres. falloff: metres further to where it ends. impulse_per_metre: newton
    /// seconds for each metre of width. mask: categories that it reaches, as bits. exclude: a body that it leaves alone.
    ///
    /// Raises ValueError where a number makes no sense.
    #[pyo3(signature = (center, radius, falloff=0.0, impulse_per_metre=1.0, mask=u64::MAX, exclude=None))]
    fn explode(
        slf: &Bound<'_, Self>,
        center: Pair,
        radius: f32,
        falloff: f32,
        impulse_per_metre: f32,
        mask: u64,
        exclude: Option<&Body>,
    ) -> PyResult<()> {
        let filter = filter(slf, mask, exclude, false)?;
        let center = DVec2::from(center);
        let explosion = Explosion { center, radius, falloff, impulse_per_metre };
        heard(&mut slf.try_borrow_mut()?.inner, |world| world.explode(&explosion, &filter))
    }

    /// Lets water carry and slow what is in it during the next step, which is `dt` seconds long: call it before each.
    ///
    /// surface: a point of the surface, (0, 0) where left out. normal: out of the water, (0, 1). density: 1000 kilograms a square
    /// metre; what is lighter floats. flow: velocity of the water, metres a second. linear_drag, angular_drag: 2 a second. area:
    /// ((left, bottom), (right, top)) of all that is water. mask, exclude: as for `explode`.
    ///
    /// Raises ValueError where a field is unknown or a number makes no sense.
    #[pyo3(signature = (dt=1.0 / 60.0, area=None, mask=u64::MAX, exclude=None, **fields))]
    fn apply_water(
        slf: &Bound<'_, Self>,
        dt: f32,
        area: Option<(Pair, Pair)>,
        mask: u64,
        exclude: Option<&Body>,
        fields: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<()> {
        let filter = filter(slf, mask, exclude, false)?;
        let said: Water = match fields {
            Some(fields) => read(fields)?,
            None => Water::default(),
        };
        let area = area.map(|(min, max)| Aabb::new(Vec2::from(min), Vec2::from(max)));
        let water = Water { area, ..said };
        heard(&mut slf.try_borrow_mut()?.inner, |world| world.apply_water(&water, &filter, dt))
    }

    /// Lets a force act on what overlaps an area during the next step, which is `dt` seconds long: call it before each.
    ///
    /// geometry: as {"circle": {"radius": 2}}, at position, turned by angle. force: {"acceleration": (0, 5)}, {"attraction": {"center":
    /// (0, 0), "acceleration": 5}}, {"wind": {"velocity": (5, 0), "density": 1.2, "drag": 1}} or {"damping": {"linear": 2,
    /// "angular": 2}}. wakes: does it wake what sleeps? mask, exclude: as for `explode`.
    ///
    /// Raises ValueError where a field is unknown or a number makes no sense.
    #[pyo3(signature = (
        geometry, force, position=Pair(0.0, 0.0), angle=0.0, wakes=false, dt=1.0 / 60.0, mask=u64::MAX, exclude=None
    ))]
    #[expect(clippy::too_many_arguments, reason = "they have names in Python")]
    fn apply_zone(
        slf: &Bound<'_, Self>,
        geometry: &Bound<'_, PyAny>,
        force: &Bound<'_, PyAny>,
        position: Pair,
        angle: f32,
        wakes: bool,
        dt: f32,
        mask: u64,
        exclude: Option<&Body>,
    ) -> PyResult<()> {
        let filter = filter(slf, mask, exclude, false)?;
        let pose = Pose::new(DVec2::from(position), Rot::from_angle(angle));
        let zone = ForceZone { shape: read(geometry)?, pose, force: read(force)?, wakes };
        heard(&mut slf.try_borrow_mut()?.inner, |world| world.apply_zone(&zone, &filter, dt))
    }
}

#[pymethods]
impl Body {
    /// Lets moving air act on its shapes during the next step, which is `dt` seconds long: call it before each. velocity: metres a
    /// second. density: kilograms a square metre. drag: about 1 for blunt shapes.
    #[pyo3(signature = (velocity, density=1.2, drag=1.0, dt=1.0 / 60.0))]
    fn apply_wind(
        &self,
        py: Python<'_>,
        velocity: Pair,
        density: f32,
        drag: f32,
        dt: f32,
    ) -> PyResult<()> {
        let wind = Wind { velocity: Vec2::from(velocity), density, drag };
        self.set(py, |mut body| body.apply_wind(&wind, dt))
    }
}
