//! The rasteriser.

use crate::camera::Camera;
use crate::error::DrawError;
use crate::font;
use crate::paths::polyline;
use tiny_physics::{Color, DebugDraw, Layer, Transform, Vec2};
use tiny_skia::{
    FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Rect, Stroke,
    Transform as Placement,
};

/// An anti-aliased picture of RGB pixels that implements [`DebugDraw`].
///
/// A frame: [`Canvas::begin`] with a camera, let the world draw itself with the camera's centre as
/// its origin, then [`Canvas::status`] and [`Canvas::legend`] on top.
#[derive(Clone, Debug)]
pub struct Canvas {
    pub(crate) pixmap: Pixmap,
    camera: Camera,
    layer: Layer,
    /// Paper and ink of notes.
    pub(crate) note: [Color; 2],
    /// Height of the strip with the status, pixels.
    pub(crate) strip: i32,
}

/// Widths in pixels.
const OUTLINE_WIDTH: f32 = 1.4;
const LINE_WIDTH: f32 = 1.6;
/// Paper and ink of notes beside debug drawings.
const NOTE: [Color; 2] = [Color::rgb(30, 34, 43), Color::rgb(226, 230, 238)];
/// Shapes smaller than this many pixels are plain squares: an outline would hide them.
const TINY: f32 = 2.5;

impl Canvas {
    /// The colour of empty space.
    pub const BACKGROUND: Color = Color::rgb(18, 21, 27);

    /// An empty picture.
    ///
    /// # Errors
    /// Width and height must be 16 to 16384 pixels.
    pub fn new(width: u32, height: u32) -> Result<Self, DrawError> {
        let size = DrawError::Size { width, height };
        let allowed = 16..=16384;
        if !allowed.contains(&width) || !allowed.contains(&height) {
            return Err(size);
        }
        let pixmap = Pixmap::new(width, height).ok_or(size)?;
        let camera = Camera { center: tiny_physics::DVec2::ZERO, scale: 1.0, width, height };
        Ok(Self { pixmap, camera, layer: Layer::Awake, note: NOTE, strip: 0 })
    }

    /// A picture of given pixels: red, green and blue, row by row from the top.
    ///
    /// # Errors
    /// Width and height must be 16 to 16384 pixels, and as many pixels be there.
    pub fn from_rgb(width: u32, height: u32, pixels: &[[u8; 3]]) -> Result<Self, DrawError> {
        let mut canvas = Self::new(width, height)?;
        if pixels.len() != canvas.pixmap.pixels().len() {
            return Err(DrawError::Size { width, height });
        }
        for (pixel, &[r, g, b]) in canvas.pixmap.pixels_mut().iter_mut().zip(pixels) {
            *pixel = tiny_skia::ColorU8::from_rgba(r, g, b, 255).premultiply();
        }
        Ok(canvas)
    }

    /// Width in pixels.
    pub fn width(&self) -> u32 {
        self.pixmap.width()
    }

    /// Height in pixels.
    pub fn height(&self) -> u32 {
        self.pixmap.height()
    }

    /// Wipes the picture and takes a camera. The camera's size is taken to be the canvas's.
    pub fn begin(&mut self, camera: &Camera) {
        self.camera = Camera { width: self.width(), height: self.height(), ..*camera };
        self.pixmap.fill(skia_color(Self::BACKGROUND));
        (self.note, self.strip) = (NOTE, 0);
    }

    /// The camera of the frame.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// The picture as a PNG file.
    ///
    /// # Errors
    /// The encoder's, in words.
    pub fn to_png(&self) -> Result<Vec<u8>, DrawError> {
        self.pixmap.encode_png().map_err(|error| DrawError::Encode(error.to_string()))
    }

    /// Red, green and blue of every pixel, row by row from the top.
    pub fn rgb(&self) -> impl ExactSizeIterator<Item = [u8; 3]> + '_ {
        self.pixmap.pixels().iter().map(|p| [p.red(), p.green(), p.blue()])
    }

    /// The pixels as `0x00RRGGBB`, as windows want them.
    pub fn copy_to_window(&self, buffer: &mut Vec<u32>) {
        buffer.clear();
        buffer.extend(self.rgb().map(|[r, g, b]| u32::from_be_bytes([0, r, g, b])));
    }

    pub(crate) fn fill_path(&mut self, path: &Path, color: Color) {
        let identity = Placement::identity();
        self.pixmap.fill_path(path, &paint(color), FillRule::Winding, identity, None);
    }

    pub(crate) fn fill_rect(&mut self, x: f32, y: f32, width: f32, height: f32, color: Color) {
        if let Some(rect) = Rect::from_xywh(x, y, width, height) {
            self.pixmap.fill_rect(rect, &paint(color), Placement::identity(), None);
        }
    }

    pub(crate) fn stroke_path(&mut self, path: &Path, width: f32, color: Color) {
        let stroke = Stroke {
            width,
            line_cap: LineCap::Round,
            line_join: LineJoin::Round,
            ..Stroke::default()
        };
        self.pixmap.stroke_path(path, &paint(color), &stroke, Placement::identity(), None);
    }

    pub(crate) fn line(&mut self, a: Vec2, b: Vec2, width: f32, color: Color) {
        if let Some(path) = polyline(&[a, b]) {
            self.stroke_path(&path, width, color);
        }
    }

    /// A body: its inside dimmed, so that overlaps and contacts show, and its outline in full colour.
    fn body(&mut self, path: Option<Path>, color: Color) {
        let Some(path) = path else { return };
        let bounds = path.bounds();
        if bounds.width() < TINY && bounds.height() < TINY {
            let size = bounds.width().max(bounds.height()).max(1.0);
            self.fill_rect(bounds.left(), bounds.top(), size, size, color);
            return;
        }
        let depth = match self.layer {
            Layer::Static => 0.62,
            Layer::Asleep => 0.55,
            Layer::Sensor => 0.85,
            _ => 0.42,
        };
        let inside = color.mix(Self::BACKGROUND.with_alpha(color.a), depth);
        self.fill_path(&path, inside.with_alpha(inside.a.saturating_sub(25)));
        let small = bounds.width().min(bounds.height()) < 8.0;
        self.stroke_path(&path, if small { 1.0 } else { OUTLINE_WIDTH }, color);
    }
}

impl DebugDraw for Canvas {
    fn layer(&mut self, layer: Layer) {
        self.layer = layer;
    }

    fn polygon(&mut self, pose: &Transform, vertices: &[Vec2], radius: f32, color: Color) {
        self.body(self.camera.polygon_path(pose, vertices, radius), color);
    }

    fn circle(&mut self, pose: &Transform, radius: f32, color: Color) {
        let Some(path) = self.camera.circle_path(pose, radius) else { return };
        self.body(Some(path), color);
        let size = radius * self.camera.scale;
        if size > 3.0 && size <= self.width().max(self.height()) as f32 {
            let rim = self.camera.to_pixels(pose.apply(Vec2::new(radius, 0.0)));
            self.line(self.camera.to_pixels(pose.p), rim, 1.0, color);
        }
    }

    fn capsule(&mut self, a: Vec2, b: Vec2, radius: f32, color: Color) {
        self.body(self.camera.capsule_path(a, b, radius), color);
    }

    fn segment(&mut self, a: Vec2, b: Vec2, color: Color) {
        if let Some(path) = self.camera.line_path(a, b) {
            self.stroke_path(&path, LINE_WIDTH, color);
        }
    }

    fn point(&mut self, p: Vec2, size_px: f32, color: Color) {
        if self.camera.unseen(p, size_px / self.camera.scale) {
            return;
        }
        let p = self.camera.to_pixels(p);
        if let Some(path) = PathBuilder::from_circle(p.x, p.y, 0.5 * size_px) {
            self.fill_path(&path, color);
        }
    }

    fn text(&mut self, p: Vec2, text: &str, color: Color) {
        if !self.camera.unseen(p, 0.0) {
            let p = self.camera.to_pixels(p);
            font::draw(&mut self.pixmap, p.x as i32 + 4, p.y as i32 - 8, text, color);
        }
    }
}

pub fn skia_color(color: Color) -> tiny_skia::Color {
    tiny_skia::Color::from_rgba8(color.r, color.g, color.b, color.a)
}

pub fn paint(color: Color) -> Paint<'static> {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color(skia_color(color));
    paint
}

#[cfg(test)]
mod tests {
    use super::*;
    use tiny_physics::{DVec2, Rot};

    fn canvas() -> Canvas {
        let mut canvas = Canvas::new(200, 100).unwrap();
        canvas.begin(&Camera { center: DVec2::ZERO, scale: 10.0, width: 200, height: 100 });
        canvas
    }

    fn pixel(canvas: &Canvas, x: usize, y: usize) -> [u8; 3] {
        canvas.rgb().nth(y * 200 + x).unwrap()
    }

    #[test]
    fn a_circle_is_where_the_camera_puts_it() {
        let mut canvas = canvas();
        let red = Color::rgb(255, 0, 0);
        canvas.circle(&Transform::new(Vec2::new(5.0, 2.0), Rot::IDENTITY), 1.0, red);
        assert!(pixel(&canvas, 148, 32)[0] > 100);
        assert_eq!(pixel(&canvas, 50, 70)[0], Canvas::BACKGROUND.r);
    }

    #[test]
    fn nonsense_and_giants_do_no_harm() {
        let mut canvas = canvas();
        let white = Color::WHITE;
        for huge in [f32::NAN, f32::INFINITY, 1.0e30, -1.0e30, 1.0e9] {
            let pose = Transform::new(Vec2::new(huge, 0.0), Rot::IDENTITY);
            canvas.circle(&pose, 1.0, white);
            canvas.circle(&Transform::IDENTITY, huge, white);
            canvas.capsule(Vec2::new(huge, 1.0), Vec2::ZERO, 1.0, white);
            canvas.capsule(Vec2::ZERO, Vec2::ZERO, huge, white);
            canvas.segment(Vec2::new(huge, 1.0), Vec2::new(-huge, 1.0), white);
            let corners = [Vec2::new(-huge, -2.0), Vec2::new(huge, -2.0), Vec2::new(0.0, -1.0)];
            canvas.polygon(&Transform::IDENTITY, &corners, 0.0, white);
            canvas.polygon(&Transform::IDENTITY, &corners, huge, white);
            canvas.point(Vec2::splat(huge), 5.0, white);
            canvas.text(Vec2::splat(huge), "x", white);
        }
    }

    #[test]
    fn a_ground_box_wider_than_any_picture_still_shows() {
        let mut canvas = canvas();
        let corners = [
            Vec2::new(-1.0e6, -3.0),
            Vec2::new(1.0e6, -3.0),
            Vec2::new(1.0e6, -1.0),
            Vec2::new(-1.0e6, -1.0),
        ];
        canvas.polygon(&Transform::IDENTITY, &corners, 0.0, Color::rgb(0, 255, 0));
        assert!(pixel(&canvas, 100, 70)[1] > 80);
        assert!(pixel(&canvas, 3, 70)[1] > 80);
    }

    #[test]
    fn sizes_out_of_range_are_errors() {
        assert!(matches!(Canvas::new(0, 10), Err(DrawError::Size { .. })));
        assert!(matches!(Canvas::new(100, 100_000), Err(DrawError::Size { .. })));
    }
}
