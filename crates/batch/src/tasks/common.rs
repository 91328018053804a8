//! What several tasks need.

use tiny_physics::{BodyId, DVec2, Error, RigidBody, Rot, Shape, ShapeDef, Vec2, World};

use crate::task::View;

/// A body that a task asks after every step what it touches.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub(super) body: BodyId,
}

impl Part {
    /// Adds a body.
    pub(super) fn add(world: &mut World, body: RigidBody) -> Result<Self, Error> {
        world.add_body(body).map(|body| Self { body })
    }

    /// Brings the number of contacts of this part up to date. Events would tell of what is about to touch, too, up to 2 cm away.
    pub(super) fn count_touches(&self, world: &World, touches: &mut u32) {
        let Some(body) = world.body(self.body).filter(|body| body.is_awake()) else { return };
        let touching = body.contacts().filter(|contact| {
            contact
                .points()
                .iter()
                .any(|point| point.separation <= 0.0 || point.normal_impulse > 0.0)
        });
        *touches = touching.count() as u32;
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
    fn what_is_close_does_not_touch() {
        let mut world = World::new(Vec2::ZERO);
        let square = || Shape::rect(0.5, 0.5).unwrap();
        world.add_body(RigidBody::fixed().shape(square())).unwrap();
        let above = RigidBody::dynamic().position((0.0, 1.01)).shape(square());
        let part = Part::add(&mut world, above).unwrap();
        let mut touches = 0;
        for _ in 0..5 {
            world.step(0.02);
            part.count_touches(&world, &mut touches);
            assert_eq!((touches, world.contact_count()), (0, 1));
        }
        world.gravity = Vec2::new(0.0, -10.0);
        (0..10).for_each(|_| world.step(0.02));
        part.count_touches(&world, &mut touches);
        assert_eq!(touches, 1);
        world.gravity = Vec2::new(0.0, 20.0);
        (0..10).for_each(|_| world.step(0.02));
        part.count_touches(&world, &mut touches);
        assert_eq!(touches, 0);
    }

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
