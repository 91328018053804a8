//! Pictures of worlds.

use crate::convert::{Pair, numbers};
use numpy::{PyArray1, PyArray3, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use tiny_physics::{DVec2, DebugDrawOptions, Shape, Vec2, World};
use tiny_physics_draw::{Animation, Camera, Canvas, DrawError};

/// What to show: lower left and upper right, world, metres.
pub struct View {
    pub min: DVec2,
    pub max: DVec2,
}

impl From<(Pair, Pair)> for View {
    fn from((min, max): (Pair, Pair)) -> Self {
        Self { min: min.into(), max: max.into() }
    }
}

/// A world that has been drawn.
pub struct Picture(Canvas);

pub fn draw_error(error: DrawError) -> PyErr {
    PyValueError::new_err(error.to_string())
}

impl Picture {
    /// Draws a world.
    pub fn of(world: &World, width: u32, height: u32, view: Option<View>) -> PyResult<Self> {
        let mut canvas = Canvas::new(width, height).map_err(draw_error)?;
        let View { min, max } = view.unwrap_or_else(|| whole(world));
        let camera = Camera::fit(min, max, width, height);
        let options = DebugDrawOptions {
            origin: camera.center,
            contacts: false,
            normals: false,
            ..DebugDrawOptions::default()
        };
        canvas.begin(&camera);
        world.debug_draw(&mut canvas, &options);
        Ok(Self(canvas))
    }

    /// Its pixels, shape (height, width, 3).
    pub fn to_array<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let (width, height) = (self.0.width() as usize, self.0.height() as usize);
        let bytes: Vec<u8> = self.0.rgb().flatten().collect();
        PyArray1::from_vec(py, bytes).reshape([height, width, 3])
    }

    /// A PNG file.
    pub fn to_png<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        Ok(PyBytes::new(py, &self.0.to_png().map_err(draw_error)?))
    }
}

/// All bodies that are no ground, with some room; else everything.
fn whole(world: &World) -> View {
    let mut view = View {
        min: DVec2::new(f64::INFINITY, f64::INFINITY),
        max: DVec2::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
    };
    for id in world.shape_ids() {
        let Some(shape) = world.shape(id) else { continue };
        let pose = shape.pose();
        let (points, radius) = core(shape.shape());
        let radius = f64::from(radius);
        points.into_iter().map(|point| pose.apply(point)).for_each(|p| {
            view.min = DVec2::new(view.min.x.min(p.x - radius), view.min.y.min(p.y - radius));
            view.max = DVec2::new(view.max.x.max(p.x + radius), view.max.y.max(p.y + radius));
        });
    }
    view
}

/// Points of a shape, and how far it reaches around them.
fn core(shape: &Shape) -> (Vec<Vec2>, f32) {
    match *shape {
        Shape::Circle { radius } => (vec![Vec2::ZERO], radius),
        Shape::Aabb { half_extents } => (vec![-half_extents, half_extents], 0.0),
        Shape::Capsule { a, b, radius } => (vec![a, b], radius),
        Shape::Segment { a, b } => (vec![a, b], 0.0),
        Shape::Polygon(polygon) => (polygon.vertices().to_vec(), polygon.radius()),
    }
}

/// Frames as a GIF animation. frames: arrays of bytes, shape (height, width, 3) each. ms: milliseconds a frame.
///
/// Raises ValueError where there is no frame or one has another size than the first.
#[pyfunction]
#[pyo3(signature = (frames, ms=40))]
pub fn gif<'py>(
    py: Python<'py>,
    frames: Vec<Bound<'py, PyAny>>,
    ms: u32,
) -> PyResult<Bound<'py, PyBytes>> {
    let mut animation = Animation::new(Vec::new(), ms);
    for frame in &frames {
        let fits = |shape: &[usize]| matches!(shape, [_, _, 3]);
        let (bytes, shape) = numbers::<u8>(frame, ["a frame", "(height, width, 3)"], fits)?;
        let pixels: Vec<[u8; 3]> =
            bytes.chunks_exact(3).map(|rgb| [rgb[0], rgb[1], rgb[2]]).collect();
        let canvas = Canvas::from_rgb(shape[1] as u32, shape[0] as u32, &pixels);
        animation.add(&canvas.map_err(draw_error)?).map_err(draw_error)?;
    }
    if frames.is_empty() {
        return Err(PyValueError::new_err("there are no frames"));
    }
    Ok(PyBytes::new(py, &animation.finish().map_err(draw_error)?))
}
