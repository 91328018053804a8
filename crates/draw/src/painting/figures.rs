//! Moving bodies.

use super::cast::{Cast, Figure, Look};
use super::{Easel, Painting};
use crate::outline;
use crate::paths::polyline;
use tiny_physics::{Color, Vec2};
use tiny_skia::{PathBuilder, Stroke, StrokeDash};

/// Squares of fewer pixels have no plank inside their outline.
const PANEL: f32 = 11.0;

impl Easel<'_> {
    pub(super) fn figures(&mut self, cast: &Cast) {
        cast.figures.iter().for_each(|figure| self.figure(figure));
    }

    fn figure(&mut self, figure: &Figure) {
        let (color, outline) = (figure.color, self.theme.outline(figure.color));
        if figure.is_small() {
            self.fill(&figure.path, color);
            return;
        }
        if let Look::Link { a, b, radius, even } = figure.look {
            return self.link([a, b], radius, even);
        }
        let width = self.pixels(0.05, 1.0, 2.2);
        for line in &figure.lines {
            self.stroke(line, 3.0 * width, color);
        }
        // Half of the stroke is hidden by the inside, and with it the seams between shapes.
        self.stroke(&figure.path, 2.0 * width, outline);
        self.fill(&figure.path, color);
        match figure.look {
            Look::Ball { center, radius, angle } => self.ball(center, radius - width, angle, color),
            Look::Crate { corners } => self.panel(corners, color),
            Look::Somebody { eyes, apart, look } => self.eyes(eyes, apart, look),
            Look::Plain | Look::Link { .. } => {}
        }
    }

    /// One half of a ball is darker, so that one sees it roll.
    fn ball(&mut self, center: Vec2, radius: f32, angle: f32, color: Color) {
        if radius < 3.0 {
            return;
        }
        let (sin, cos) = angle.sin_cos();
        let way = Vec2::new(cos, sin) * radius;
        let dark = color.mix(self.theme.shade, 0.2);
        if let Some(half) = outline::half_disk(center, way) {
            self.fill(&half, dark);
        }
        if radius > 9.0 {
            self.dot(center - way.perp() * 0.5, 0.16 * radius, color.mix(Color::WHITE, 0.5));
        }
    }

    /// A lighter square inside a crate.
    fn panel(&mut self, corners: [Vec2; 4], color: Color) {
        let (side, other) = (corners[1] - corners[0], corners[3] - corners[0]);
        let (shorter, longer) =
            (side.length().min(other.length()), side.length().max(other.length()));
        if shorter < PANEL || longer > 3.0 * shorter {
            return;
        }
        let (x, y) = (side.normalized(), other.normalized());
        let inset = 0.2 * shorter;
        let signs = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
        let inner: Vec<Vec2> = corners
            .iter()
            .zip(signs)
            .map(|(corner, (along, up))| *corner + x * (inset * along) + y * (inset * up))
            .collect();
        if let Some(path) = outline::rounded(&inner, 0.0) {
            self.fill(&path, color.mix(Color::WHITE, 0.2));
        }
    }

    fn eyes(&mut self, eyes: Vec2, apart: f32, look: f32) {
        for side in [-1.0, 1.0] {
            let eye = eyes + Vec2::new((side + 0.5 * look) * apart, 0.0);
            self.dot(eye, 0.62 * apart, Color::WHITE);
            self.dot(eye + Vec2::new(0.26 * look * apart, 0.0), 0.32 * apart, self.theme.shade);
        }
    }

    /// A ring, or a bar where the link is seen from its edge.
    fn link(&mut self, [a, b]: [Vec2; 2], radius: f32, even: bool) {
        let (metal, outline) = (self.theme.metal, self.theme.outline(self.theme.metal));
        let wire = (0.75 * radius).max(1.0);
        if even || radius < 1.6 {
            if let Some(path) = polyline(&[a, b]) {
                let width = if even { 1.5 * wire } else { 2.0 * wire };
                self.stroke(&path, width + 1.6, outline);
                self.stroke(&path, width, metal);
            }
        } else if let Some(path) = outline::rounded(&[a, b], 1.15 * radius) {
            self.stroke(&path, wire + 1.6, outline);
            self.stroke(&path, wire, metal);
        }
    }

    /// Sensors: a breath of colour with a dashed outline.
    pub(super) fn sensors(&mut self, cast: &Cast, painting: &Painting) {
        let surface = |y: f64| {
            let center = self.camera.center;
            self.camera.to_pixels(Vec2::new(0.0, (y - center.y) as f32)).y
        };
        let surfaces: Vec<f32> =
            painting.waters.iter().map(|water| surface(water.surface)).collect();
        for path in &cast.sensors {
            // One that stands for the water is seen already.
            if surfaces.iter().any(|y| (path.bounds().top() - y).abs() < 1.0) {
                continue;
            }
            self.fill(path, self.theme.sensor.with_alpha(20));
            let stroke = Stroke {
                width: 1.2,
                dash: StrokeDash::new(vec![5.0, 5.0], 0.0),
                ..Stroke::default()
            };
            let color = crate::canvas::paint(self.theme.sensor.with_alpha(150));
            let identity = tiny_skia::Transform::identity();
            self.canvas.pixmap.stroke_path(path, &color, &stroke, identity, None);
        }
    }

    /// A small ring where a joint turns, well inside of a body of a half width in pixels.
    pub(super) fn pin(&mut self, p: Vec2, room: f32) {
        let radius = self.pixels(0.09, 1.4, 4.0).min(0.4 * room);
        if radius < 1.3 {
            return;
        }
        self.dot(p, radius + 1.0, self.theme.shade.with_alpha(150));
        self.dot(p, radius, self.theme.metal.mix(Color::WHITE, 0.45));
    }

    /// A zigzag between two points.
    pub(super) fn coil(&mut self, a: Vec2, b: Vec2) {
        const TURNS: usize = 14;
        let way = b - a;
        let side = way.normalized().perp() * self.pixels(0.16, 2.0, 9.0);
        let mut path = PathBuilder::new();
        path.move_to(a.x, a.y);
        for i in 1..TURNS {
            let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
            let p = a + way * (i as f32 / TURNS as f32) + side * sign;
            path.line_to(p.x, p.y);
        }
        path.line_to(b.x, b.y);
        if let Some(path) = path.finish() {
            let width = self.pixels(0.05, 1.2, 2.4);
            self.stroke(&path, width, self.theme.metal);
        }
    }
}
