//! Queries of a world.

use crate::convert::{self, Pair, place, read, tuple};
use crate::handles::Body;
use crate::handles::Shape;
use crate::handles::World;
use crate::world::own;
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tiny_physics::{self as engine, Aabb, DVec2, Pose, QueryFilter, Rot, Vec2};

/// What a query of a world sees.
///
/// Raises ValueError where the body that it does not see is of another world.
pub fn filter(
    slf: &Bound<'_, World>,
    mask: u64,
    exclude: Option<&Body>,
    sensors: bool,
) -> PyResult<QueryFilter<'static>> {
    let mut filter = QueryFilter::new().mask(mask);
    if let Some(body) = exclude {
        own(slf, body)?;
        filter = filter.exclude(body.id);
    }
    Ok(if sensors { filter.sensors() } else { filter })
}

fn shapes(slf: &Bound<'_, World>, ids: Vec<engine::ShapeId>) -> Vec<Shape> {
    ids.into_iter().map(|id| Shape { world: slf.clone().unbind(), id }).collect()
}

fn hit<'py>(
    slf: &Bound<'py, World>,
    (shape, body): (engine::ShapeId, engine::BodyId),
    (point, normal, fraction): (DVec2, Vec2, f32),
) -> PyResult<Bound<'py, PyDict>> {
    let found = PyDict::new(slf.py());
    found.set_item("shape", Shape { world: slf.clone().unbind(), id: shape })?;
    found.set_item("body", Body { world: slf.clone().unbind(), id: body })?;
    found.set_item("point", place(point))?;
    found.set_item("normal", tuple(normal))?;
    found.set_item("fraction", fraction)?;
    Ok(found)
}

#[pymethods]
impl World {
    /// The first shape that a ray enters on its way from `origin` along `translation` (metres): a dictionary with
    /// "shape", "body", "point", "normal", "fraction"; None where it meets nothing.
    ///
    /// mask: categories that it sees, as bits. exclude: a body that it does not see.
    #[pyo3(signature = (origin, translation, mask=u64::MAX, exclude=None, sensors=false))]
    fn ray_cast<'py>(
        slf: &Bound<'py, Self>,
        origin: Pair,
        translation: Pair,
        mask: u64,
        exclude: Option<&Body>,
        sensors: bool,
    ) -> PyResult<Option<Bound<'py, PyDict>>> {
        let filter = filter(slf, mask, exclude, sensors)?;
        let world = slf.try_borrow()?;
        let found = world.inner.ray_cast(DVec2::from(origin), Vec2::from(translation), &filter);
        found.map(|h| hit(slf, (h.shape, h.body), (h.point, h.normal, h.fraction))).transpose()
    }

    /// All shapes that a ray enters, nearest first.
    #[pyo3(signature = (origin, translation, mask=u64::MAX, exclude=None, sensors=false))]
    fn ray_cast_all<'py>(
        slf: &Bound<'py, Self>,
        origin: Pair,
        translation: Pair,
        mask: u64,
        exclude: Option<&Body>,
        sensors: bool,
    ) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let filter = filter(slf, mask, exclude, sensors)?;
        let world = slf.try_borrow()?;
        let found = world.inner.ray_cast_all(DVec2::from(origin), Vec2::from(translation), &filter);
        found
            .into_iter()
            .map(|h| hit(slf, (h.shape, h.body), (h.point, h.normal, h.fraction)))
            .collect()
    }

    /// Many ray casts at once. rays: float64, shape (n, 4): origin x, y, translation x, y, metres. Gives the fraction of
    /// each until it enters a shape, float32, shape (n,); 1 where it meets nothing.
    #[pyo3(signature = (rays, mask=u64::MAX))]
    fn ray_casts<'py>(
        &self,
        py: Python<'py>,
        rays: &Bound<'py, PyAny>,
        mask: u64,
    ) -> PyResult<Bound<'py, PyArray1<f32>>> {
        let rays = convert::rays(rays)?;
        let (world, mut hits) = (&self.inner, Vec::new());
        py.detach(|| world.ray_casts(&rays, &QueryFilter::new().mask(mask), &mut hits));
        let fractions = hits.into_iter().map(|hit| hit.map_or(1.0, |hit| hit.fraction));
        Ok(fractions.collect::<Vec<f32>>().into_pyarray(py))
    }

    /// Where a moved shape first touches another: as `ray_cast`. geometry: as {"circle": {"radius": 0.5}}.
    #[pyo3(signature = (geometry, position, angle, translation, mask=u64::MAX, exclude=None))]
    fn cast_shape<'py>(
        slf: &Bound<'py, Self>,
        geometry: &Bound<'py, PyAny>,
        position: Pair,
        angle: f32,
        translation: Pair,
        mask: u64,
        exclude: Option<&Body>,
    ) -> PyResult<Option<Bound<'py, PyDict>>> {
        let geometry: engine::Shape = read(geometry)?;
        let pose = Pose::new(DVec2::from(position), Rot::from_angle(angle));
        let filter = filter(slf, mask, exclude, false)?;
        let world = slf.try_borrow()?;
        let found = world.inner.cast_shape(&geometry, pose, Vec2::from(translation), &filter);
        found.map(|h| hit(slf, (h.shape, h.body), (h.point, h.normal, h.fraction))).transpose()
    }

    /// The shapes that overlap a shape.
    #[pyo3(signature = (geometry, position, angle=0.0, mask=u64::MAX, exclude=None, sensors=false))]
    fn overlap_shape(
        slf: &Bound<'_, Self>,
        geometry: &Bound<'_, PyAny>,
        position: Pair,
        angle: f32,
        mask: u64,
        exclude: Option<&Body>,
        sensors: bool,
    ) -> PyResult<Vec<Shape>> {
        let geometry: engine::Shape = read(geometry)?;
        let pose = Pose::new(DVec2::from(position), Rot::from_angle(angle));
        let filter = filter(slf, mask, exclude, sensors)?;
        let found = slf.try_borrow()?.inner.overlap_shape(&geometry, pose, &filter);
        Ok(shapes(slf, found))
    }

    /// The shapes that overlap a box: lower left and upper right, world, metres.
    #[pyo3(signature = (lower, upper, mask=u64::MAX, exclude=None, sensors=false))]
    fn overlap_box(
        slf: &Bound<'_, Self>,
        lower: Pair,
        upper: Pair,
        mask: u64,
        exclude: Option<&Body>,
        sensors: bool,
    ) -> PyResult<Vec<Shape>> {
        let filter = filter(slf, mask, exclude, sensors)?;
        let area = Aabb::new(Vec2::from(lower), Vec2::from(upper));
        let found = slf.try_borrow()?.inner.overlap_aabb(area, &filter);
        Ok(shapes(slf, found))
    }

    /// The shapes that hold a point: world, metres.
    #[pyo3(signature = (point, mask=u64::MAX, exclude=None, sensors=false))]
    fn overlap_point(
        slf: &Bound<'_, Self>,
        point: Pair,
        mask: u64,
        exclude: Option<&Body>,
        sensors: bool,
    ) -> PyResult<Vec<Shape>> {
        let filter = filter(slf, mask, exclude, sensors)?;
        let found = slf.try_borrow()?.inner.overlap_point(DVec2::from(point), &filter);
        Ok(shapes(slf, found))
    }

    /// The point of any shape that is closest to `point`, within `distance` metres: a dictionary with "shape", "body",
    /// "point" and "distance"; None where there is none.
    #[pyo3(signature = (point, distance=f32::INFINITY, mask=u64::MAX, exclude=None))]
    fn closest_point<'py>(
        slf: &Bound<'py, Self>,
        point: Pair,
        distance: f32,
        mask: u64,
        exclude: Option<&Body>,
    ) -> PyResult<Option<Bound<'py, PyDict>>> {
        let filter = filter(slf, mask, exclude, false)?;
        let world = slf.try_borrow()?;
        let Some(found) = world.inner.closest_point(DVec2::from(point), distance, &filter) else {
            return Ok(None);
        };
        let closest = PyDict::new(slf.py());
        closest.set_item("shape", Shape { world: slf.clone().unbind(), id: found.shape })?;
        closest.set_item("body", Body { world: slf.clone().unbind(), id: found.body })?;
        closest.set_item("point", place(found.point))?;
        closest.set_item("distance", found.distance)?;
        Ok(Some(closest))
    }
}
