//! What is built on worlds: forces.

use crate::convert::{Pair, heard};
use crate::handles::{Body, World};
use crate::query::filter;
use pyo3::prelude::*;
use tiny_physics::{DVec2, Explosion};

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
}
