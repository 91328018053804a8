//! Sky, hills far away, and water.

use super::{Easel, Painting, Water};
use crate::canvas::skia_color;
use tiny_physics::{Color, Vec2, World};
use tiny_skia::{
    FillRule, GradientStop, LinearGradient, Paint, Path, PathBuilder, Point, SpreadMode,
    Transform as Placement,
};

/// Pixels between the points of a wave.
const WAVE_STEP: f32 = 6.0;

impl Easel<'_> {
    /// Sky, and hills where there is an up and a down.
    pub(super) fn backdrop(&mut self, world: &World) {
        let [above, below] = self.theme.sky;
        let height = self.canvas.height() as f32;
        self.fill_down(None, (0.0, above), (height, below));
        if world.gravity.y >= 0.0 {
            return self.stars();
        }
        for (i, color) in self.theme.hills.into_iter().enumerate() {
            let depth = i as f32;
            // What is far away moves less than the camera.
            let shift = (self.camera.center.x * f64::from(self.camera.scale)) as f32;
            let shift = shift * (0.06 + 0.08 * depth);
            let line = |x: f32| {
                let x = (x + shift) / height;
                let hills = (2.1 * x + 1.7 * depth).sin() + 0.45 * (5.3 * x + 4.0 * depth).sin();
                height * (0.66 + 0.11 * depth - 0.05 * hills)
            };
            if let Some(path) = self.up_to(line, 0.0, self.canvas.width() as f32) {
                self.fill(&path, color);
            }
        }
    }

    /// Where there is no down there is space, which is dark at least by night.
    fn stars(&mut self) {
        const STARS: u32 = 90;
        let [above, below] = self.theme.sky.map(|c| u32::from(c.r) + u32::from(c.g));
        if above > below {
            return;
        }
        let (width, height) = (self.canvas.width() as f32, self.canvas.height() as f32);
        // The golden ratio and its like spread points evenly (Roberts 2018, R2 sequence).
        let spread = |i: u32, by: f64| (f64::from(i) * by).fract() as f32;
        for i in 1..=STARS {
            let p = Vec2::new(width * spread(i, 0.754_877_67), height * spread(i, 0.569_840_29));
            let size = 0.5 + 0.9 * spread(i, 0.618_034);
            self.dot(p, size, Color::WHITE.with_alpha(if i % 3 == 0 { 200 } else { 110 }));
        }
    }

    /// Water behind what is in it, or in front of it.
    pub(super) fn waters(&mut self, painting: &Painting, world: &World, front: bool) {
        let time = world.step_count() as f32 / 60.0;
        for water in &painting.waters {
            self.water(water, time, front);
        }
    }

    fn water(&mut self, water: &Water, time: f32, front: bool) {
        let center = self.camera.center;
        let pixel = |x: f64, y: f64| {
            self.camera.to_pixels(Vec2::new((x - center.x) as f32, (y - center.y) as f32))
        };
        let ends = water.between.map(|(left, right)| [left, right].map(|x| pixel(x, 0.0).x));
        let width = self.canvas.width() as f32;
        let [left, right] = ends.unwrap_or([0.0, width]).map(|x| x.clamp(0.0, width));
        let level = pixel(center.x, water.surface).y;
        let swell = self.pixels(0.05, 0.8, 3.0);
        let metre = self.camera.scale;
        let line = |x: f32| level + swell * ((x / metre) * 1.9 + 1.4 * time).sin();
        let Some(path) = self.up_to(line, left, right) else { return };
        let color = self.theme.water;
        let deep = color.mix(self.theme.shade, 0.45);
        let height = self.canvas.height() as f32;
        let (light, dark) = if front { (90, 130) } else { (130, 170) };
        let bottom = (height, deep.with_alpha(dark));
        self.fill_down(Some(&path), (level, color.with_alpha(light)), bottom);
        if front {
            let points: Vec<_> = wave(left, right).map(|x| Vec2::new(x, line(x))).collect();
            if let Some(path) = crate::paths::polyline(&points) {
                self.stroke(&path, 1.8, color.mix(Color::WHITE, 0.65));
            }
        }
    }

    /// The part of the picture below a line in pixels.
    fn up_to(&self, line: impl Fn(f32) -> f32, left: f32, right: f32) -> Option<Path> {
        let bottom = self.canvas.height() as f32;
        let mut path = PathBuilder::new();
        path.move_to(left, bottom);
        for x in wave(left, right) {
            path.line_to(x, line(x).clamp(-10.0, bottom));
        }
        path.line_to(right, bottom);
        path.close();
        path.finish()
    }

    /// Fills a path, or the picture, with one colour at a height that goes over into another.
    fn fill_down(
        &mut self,
        path: Option<&Path>,
        (top, above): (f32, Color),
        (bottom, below): (f32, Color),
    ) {
        let stops = [above, below].map(skia_color);
        let stops = vec![GradientStop::new(0.0, stops[0]), GradientStop::new(1.0, stops[1])];
        let (from, to) = (Point::from_xy(0.0, top), Point::from_xy(0.0, bottom));
        let identity = Placement::identity();
        let shader = LinearGradient::new(from, to, stops, SpreadMode::Pad, identity);
        let Some(shader) = shader else { return };
        let paint = Paint { shader, anti_alias: true, ..Paint::default() };
        let (width, height) = (self.canvas.width() as f32, self.canvas.height() as f32);
        if let Some(path) = path {
            self.canvas.pixmap.fill_path(path, &paint, FillRule::Winding, identity, None);
        } else if let Some(all) = tiny_skia::Rect::from_xywh(0.0, 0.0, width, height) {
            self.canvas.pixmap.fill_rect(all, &paint, identity, None);
        }
    }
}

/// Places from left to right, both ends included.
fn wave(left: f32, right: f32) -> impl Iterator<Item = f32> {
    let count = ((right - left).max(0.0) / WAVE_STEP).ceil() as usize;
    (0..=count).map(move |i| (left + i as f32 * WAVE_STEP).min(right))
}
