//! Between world and pixels.

use tiny_physics::{Aabb, DVec2, Vec2};

/// What part of the world a picture shows. Pixels count from the upper left corner, y downwards.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Camera {
    /// The world point in the middle of the picture; the origin of everything drawn.
    pub center: DVec2,
    /// Pixels a metre, above 0.
    pub scale: f32,
    /// Width of the picture, pixels.
    pub width: u32,
    /// Height of the picture, pixels.
    pub height: u32,
}

impl Camera {
    /// Part of the picture that [`Camera::fit`] leaves free on each side.
    const MARGIN: f32 = 0.04;

    /// The camera that shows the box from `min` to `max` as large as it fits. A box that is empty or
    /// not finite is taken as the square metre around the origin.
    pub fn fit(min: DVec2, max: DVec2, width: u32, height: u32) -> Self {
        let good = min.is_finite() && max.is_finite() && min.x <= max.x && min.y <= max.y;
        let (min, max) =
            if good { (min, max) } else { (DVec2::new(-0.5, -0.5), DVec2::new(0.5, 0.5)) };
        let size = max.relative_to(min);
        let room = 1.0 - 2.0 * Self::MARGIN;
        let (across, up) = (size.x.max(1.0e-3), size.y.max(1.0e-3));
        let scale = (width as f32 * room / across).min(height as f32 * room / up);
        Self { center: (min + max) * 0.5, scale, width, height }
    }

    /// Like [`Camera::fit`], but leaves pixels free along the upper and the lower edge, for text and a legend.
    pub fn fit_between(
        min: DVec2,
        max: DVec2,
        (width, height): (u32, u32),
        [above, below]: [u32; 2],
    ) -> Self {
        let room = height.saturating_sub(above + below).max(height / 2);
        let mut camera = Self { height, ..Self::fit(min, max, width, room) };
        camera.pan(Vec2::new(0.0, 0.5 * (above as f32 - below as f32)));
        camera
    }

    /// A point relative to the centre, in pixels.
    pub fn to_pixels(&self, p: Vec2) -> Vec2 {
        self.middle() + Vec2::new(p.x, -p.y) * self.scale
    }

    /// The world point under a pixel.
    pub fn to_world(&self, pixel: Vec2) -> DVec2 {
        let p = (pixel - self.middle()) / self.scale;
        self.center + Vec2::new(p.x, -p.y)
    }

    /// The part of the world in view, relative to the centre.
    pub fn view(&self) -> Aabb {
        Aabb::from_center(Vec2::ZERO, self.middle() / self.scale)
    }

    /// Grows (above 1) or shrinks the picture by a factor; the world point under `pixel` stays.
    pub fn zoom(&mut self, factor: f32, pixel: Vec2) {
        let before = self.to_world(pixel);
        self.scale = (self.scale * factor).clamp(1.0e-3, 1.0e5);
        let after = self.to_world(pixel);
        self.center += before - after;
    }

    /// Moves the picture by pixels, as if dragged.
    pub fn pan(&mut self, pixels: Vec2) {
        self.center += Vec2::new(-pixels.x, pixels.y) / self.scale;
    }

    /// The same view for another picture size: the centre stays, the height shows what it showed.
    pub fn resized(self, width: u32, height: u32) -> Self {
        let scale = self.scale * height as f32 / self.height as f32;
        Self { scale, width, height, ..self }
    }

    fn middle(&self) -> Vec2 {
        Vec2::new(self.width as f32, self.height as f32) * 0.5
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_and_world_round_trip_far_away() {
        let far = DVec2::new(1.0e7, -3.0e6);
        let camera = Camera::fit(far, far + Vec2::new(20.0, 10.0), 1280, 720);
        let pixel = Vec2::new(100.0, 650.0);
        let world = camera.to_world(pixel);
        let back = camera.to_pixels(world.relative_to(camera.center));
        assert!((back - pixel).length() < 1e-2, "{back}");
    }

    #[test]
    fn fitting_shows_the_whole_box_and_bears_nonsense() {
        let camera = Camera::fit(DVec2::new(-20.0, -11.0), DVec2::new(20.0, 15.0), 640, 480);
        let view = camera.view();
        assert!(view.contains(&Aabb::from_center(Vec2::ZERO, Vec2::new(20.0, 13.0))));
        let point = Camera::fit(DVec2::ZERO, DVec2::ZERO, 640, 480);
        assert!(point.scale.is_finite());
        let nan = Camera::fit(DVec2::new(f64::NAN, 0.0), DVec2::ZERO, 640, 480);
        assert!(nan.scale > 100.0 && nan.center == DVec2::ZERO);
    }

    #[test]
    fn room_for_a_legend_stays_free() {
        let camera = Camera::fit_between(DVec2::ZERO, DVec2::new(10.0, 10.0), (400, 400), [0, 100]);
        let lower = camera.to_pixels(DVec2::new(5.0, 0.0).relative_to(camera.center));
        let upper = camera.to_pixels(DVec2::new(5.0, 10.0).relative_to(camera.center));
        assert!(lower.y < 300.0 && upper.y > 0.0, "{lower} {upper}");
    }

    #[test]
    fn zooming_keeps_the_point_under_the_mouse() {
        let mut camera = Camera::fit(DVec2::ZERO, DVec2::new(10.0, 10.0), 400, 400);
        let pixel = Vec2::new(50.0, 60.0);
        let before = camera.to_world(pixel);
        camera.zoom(1.5, pixel);
        let moved = (camera.to_world(pixel) - before).to_vec2().length();
        assert!(moved < 1e-4);
    }
}
