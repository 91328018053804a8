//! What several tasks need.

use tiny_physics::{BodyId, DVec2, Error, RigidBody, Rot, Shape, ShapeDef, ShapeId, Vec2, World};

use crate::task::View;

/// A body of one shape that a task asks after every step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub(super) body: BodyId,
    pub(super) shape: ShapeId,
}

impl Part {
    /// Adds a body whose shape tells of its contacts.
    pub(super) fn add(world: &mut World, body: RigidBody) -> Result<Self, Error> {
        let body = world.add_body(body)?;
        let found = world.body(body).and_then(|body| body.shapes().next());
        let shape = found.ok_or(Error::Unsupported { reason: "a part needs a shape" })?;
        if let Some(mut shape) = world.shape_mut(shape) {
            shape.set_events(true, false);
        }
        Ok(Self { body, shape })
    }

    /// Brings the number of contacts of this part up to date with the events of the last step.
    pub(super) fn count_touches(&self, world: &World, touches: &mut u32) {
        let events = world.events();
        let mine = |a: ShapeId, b: ShapeId| a == self.shape || b == self.shape;
        let began = events.contact_begin().iter().filter(|e| mine(e.shape_a, e.shape_b)).count();
        let ended = events.contact_end().iter().filter(|e| mine(e.shape_a, e.shape_b)).count();
        *touches = (*touches + began as u32).saturating_sub(ended as u32);
    }
}

/// A convex polygon from whole numbers of pixels.
pub(super) fn pixels(points: &[(i16, i16)], scale: f32) -> Result<ShapeDef, Error> {
    let point = |&(x, y): &(i16, i16)| Vec2::new(f32::from(x) / scale, f32::from(y) / scale);
    let points: Vec<Vec2> = points.iter().map(point).collect();
    Ok(ShapeDef::new(Shape::hull(&points)?))
}

/// An angle that goes on counting turns: the one nearest to `before` that is that of `now`, radians.
pub(super) fn unwind(before: f32, now: Rot) -> f32 {
    before + now.angle_from(Rot::from_angle(before))
}

/// The smaller and larger end of what a number may be.
pub(super) fn clamp(x: f32, low: f32, high: f32) -> f32 {
    if x < low {
        low
    } else if x > high {
        high
    } else {
        x
    }
}

/// A view of a width and height around a point.
pub(super) fn view_around(center: DVec2, width: f32, height: f32) -> View {
    let half = Vec2::new(0.5 * width, 0.5 * height);
    View { min: center - half, max: center + half }
}

/// The same on every platform, unlike the standard library's: to 1e-6 for numbers from -20 to 20.
pub(super) fn tanh(x: f32) -> f32 {
    let e = exp(2.0 * f64::from(clamp(x, -20.0, 20.0)));
    ((e - 1.0) / (e + 1.0)) as f32
}

/// By its series for x / 64, six times squared.
fn exp(x: f64) -> f64 {
    let r = x / 64.0;
    let mut sum = 1.0;
    for k in (1..=12).rev() {
        sum = 1.0 + sum * r / f64::from(k);
    }
    (0..6).fold(sum, |e, _| e * e)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tanh_is_the_hyperbolic_tangent() {
        for i in -200..=200 {
            let x = i as f32 * 0.1;
            assert!((f64::from(tanh(x)) - f64::from(x).tanh()).abs() < 1e-6, "{x}");
        }
    }

    #[test]
    fn angles_go_on_counting() {
        let mut angle = 0.0;
        for i in 1..=100 {
            angle = unwind(angle, Rot::from_angle(i as f32 * 0.2));
        }
        assert!((angle - 20.0).abs() < 1e-3);
    }
}
