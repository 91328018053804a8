//! The picture in letters.

use tiny_physics::{Color, DVec2, DebugDraw, Layer, Transform, Vec2};

/// Draws bodies as letters: `#` static, `o` circle, `[` `]` box, `(` `)` capsule, `<` `>` other
/// polygons, `=` kinematic bodies, `-` segments.
///
/// A letter is taken to be twice as high as wide. Joints, contacts and other overlays are left out.
#[derive(Clone, Debug)]
pub struct TextView {
    columns: usize,
    rows: usize,
    center: DVec2,
    /// Width of a letter, metres.
    column_width: f32,
    layer: Layer,
    cells: Vec<(char, Layer)>,
}

/// Height of a letter over its width.
const ASPECT: f32 = 2.0;

impl TextView {
    /// An empty view, at least one letter wide and high.
    pub fn new(columns: usize, rows: usize) -> Self {
        let (columns, rows) = (columns.clamp(1, 10_000), rows.clamp(1, 10_000));
        Self {
            columns,
            rows,
            center: DVec2::ZERO,
            column_width: 1.0,
            layer: Layer::Awake,
            cells: vec![(' ', Layer::Static); columns * rows],
        }
    }

    /// Wipes the view and shows the world from `min` to `max` as large as it fits. Draw with
    /// [`TextView::center`] as the origin.
    pub fn begin(&mut self, min: DVec2, max: DVec2) {
        self.cells.fill((' ', Layer::Static));
        let size = max.relative_to(min);
        if !(size.x > 0.0 && size.y > 0.0 && size.is_finite() && min.is_finite()) {
            return;
        }
        self.center = (min + max) * 0.5;
        self.column_width =
            (size.x / self.columns as f32).max(size.y / (self.rows as f32 * ASPECT));
    }

    /// The world point in the middle: the origin of what is drawn.
    pub fn center(&self) -> DVec2 {
        self.center
    }

    /// Letters and the layer each belongs to, row by row from the top.
    pub fn cells(&self) -> impl Iterator<Item = &[(char, Layer)]> {
        self.cells.chunks(self.columns)
    }

    /// The rows as text without spaces at their ends, empty rows at the top left out.
    pub fn to_lines(&self) -> Vec<String> {
        let lines = self.cells().map(|row| {
            let line: String = row.iter().map(|(letter, _)| letter).collect();
            line.trim_end().to_owned()
        });
        lines.skip_while(|line| line.is_empty()).collect()
    }

    /// Column and row of a point, not rounded; the middle of the first letter is (0.5, 0.5).
    fn cell_of(&self, p: Vec2) -> Vec2 {
        let middle = Vec2::new(self.columns as f32, self.rows as f32) * 0.5;
        middle + Vec2::new(p.x, -p.y / ASPECT) / self.column_width
    }

    /// The point in the middle of a letter.
    fn point_of(&self, column: usize, row: usize) -> Vec2 {
        let x = column as f32 + 0.5 - self.columns as f32 * 0.5;
        let y = row as f32 + 0.5 - self.rows as f32 * 0.5;
        Vec2::new(x, -y * ASPECT) * self.column_width
    }

    fn put(&mut self, column: usize, row: usize, letter: char) {
        if column < self.columns && row < self.rows {
            self.cells[row * self.columns + column] = (letter, self.layer);
        }
    }

    /// Static and kinematic bodies have one letter whatever their shape.
    fn letters(&self, of_shape: [char; 3]) -> [char; 3] {
        match self.layer {
            Layer::Static => ['#'; 3],
            Layer::Kinematic => ['='; 3],
            _ => of_shape,
        }
    }

    /// Fills every letter whose middle is inside: first, inner, last letter of each row. A shape that
    /// is too thin for any middle still gets the letters at its own middle.
    fn fill(
        &mut self,
        center: Vec2,
        reach: Vec2,
        letters: [char; 3],
        inside: impl Fn(Vec2) -> bool,
    ) {
        let letters = self.letters(letters);
        let (low, high) = (
            self.cell_of(Vec2::new(center.x - reach.x, center.y + reach.y)),
            self.cell_of(Vec2::new(center.x + reach.x, center.y - reach.y)),
        );
        if !(low.is_finite() && high.is_finite()) || high.x < 0.0 || high.y < 0.0 {
            return;
        }
        let mut drawn = false;
        for row in low.y.max(0.0) as usize..(high.y as usize).saturating_add(1).min(self.rows) {
            let columns =
                low.x.max(0.0) as usize..(high.x as usize).saturating_add(1).min(self.columns);
            let mut run = columns.filter(|column| inside(self.point_of(*column, row)));
            if let Some(first) = run.next() {
                self.run(row, first, run.last().unwrap_or(first), letters);
                drawn = true;
            }
        }
        let middle = self.cell_of(center);
        if !drawn && middle.x >= 0.0 && middle.y >= 0.0 {
            let column = middle.x as usize;
            self.run(middle.y as usize, column, column, letters);
        }
    }

    /// One row of a shape. Where both ends look different there is room for both.
    fn run(&mut self, row: usize, first: usize, last: usize, letters: [char; 3]) {
        if row >= self.rows || first >= self.columns {
            return;
        }
        let last = if letters[0] == letters[2] { last } else { last.max(first.saturating_add(1)) };
        for column in first..=last {
            self.put(column, row, letters[1]);
        }
        self.put(last, row, letters[2]);
        self.put(first, row, letters[0]);
    }
}

impl DebugDraw for TextView {
    fn layer(&mut self, layer: Layer) {
        self.layer = layer;
    }

    fn polygon(&mut self, pose: &Transform, vertices: &[Vec2], radius: f32, _: Color) {
        let world: Vec<_> = vertices.iter().map(|v| pose.apply(*v)).collect();
        let Some(first) = world.first() else { return };
        let low = world.iter().fold(*first, |low, v| low.min(*v)) - Vec2::splat(radius);
        let high = world.iter().fold(*first, |high, v| high.max(*v)) + Vec2::splat(radius);
        let letters = if vertices.len() == 4 { ['[', ' ', ']'] } else { ['<', ' ', '>'] };
        self.fill((low + high) * 0.5, (high - low) * 0.5, letters, |p| {
            distance_to_polygon(p, &world) <= radius
        });
    }

    fn circle(&mut self, pose: &Transform, radius: f32, _: Color) {
        let center = pose.p;
        self.fill(center, Vec2::splat(radius), ['o'; 3], |p| p.distance(center) <= radius);
    }

    fn capsule(&mut self, a: Vec2, b: Vec2, radius: f32, _: Color) {
        let reach = (b - a).abs() * 0.5 + Vec2::splat(radius);
        let letters = ['(', ' ', ')'];
        self.fill((a + b) * 0.5, reach, letters, |p| distance_to_segment(p, a, b) <= radius);
    }

    fn segment(&mut self, a: Vec2, b: Vec2, _: Color) {
        let is_body =
            matches!(self.layer, Layer::Static | Layer::Kinematic | Layer::Awake | Layer::Asleep);
        let letter = self.letters(['-'; 3])[0];
        let (from, to) = (self.cell_of(a), self.cell_of(b));
        if !is_body || !from.is_finite() || !to.is_finite() {
            return;
        }
        let steps = ((to - from).abs().x.max((to - from).abs().y) as usize).clamp(1, 20_000);
        for i in 0..=steps {
            let p = from.lerp(to, i as f32 / steps as f32);
            if p.x >= 0.0 && p.y >= 0.0 {
                self.put(p.x as usize, p.y as usize, letter);
            }
        }
    }

    fn point(&mut self, _: Vec2, _: f32, _: Color) {}

    fn text(&mut self, _: Vec2, _: &str, _: Color) {}
}

/// 0 inside; the vertices are anticlockwise.
fn distance_to_polygon(p: Vec2, vertices: &[Vec2]) -> f32 {
    let next = |i: usize| vertices[(i + 1) % vertices.len()];
    let inside = vertices.iter().enumerate().all(|(i, v)| (next(i) - *v).cross(p - *v) >= 0.0);
    if inside {
        return 0.0;
    }
    let edges = vertices.iter().enumerate().map(|(i, v)| distance_to_segment(p, *v, next(i)));
    edges.fold(f32::INFINITY, f32::min)
}

fn distance_to_segment(p: Vec2, a: Vec2, b: Vec2) -> f32 {
    let way = b - a;
    let length_sq = way.length_sq();
    let t = if length_sq > 0.0 { ((p - a).dot(way) / length_sq).clamp(0.0, 1.0) } else { 0.0 };
    p.distance(a + way * t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use tiny_physics::{Rot, Shape, draw_shape};

    #[test]
    fn the_letters_of_the_article() {
        let mut view = TextView::new(20, 5);
        view.begin(DVec2::new(0.0, 0.0), DVec2::new(10.0, 5.0));
        let origin = view.center();
        let at =
            |x: f64, y: f64| Transform::new(DVec2::new(x, y).relative_to(origin), Rot::IDENTITY);
        let rect = |x, y| Shape::Aabb { half_extents: Vec2::new(x, y) };
        view.layer(Layer::Static);
        draw_shape(&mut view, &rect(5.0, 0.5), &at(5.0, 0.5), Color::WHITE);
        view.layer(Layer::Awake);
        draw_shape(&mut view, &rect(0.5, 0.5), &at(2.0, 1.5), Color::WHITE);
        draw_shape(&mut view, &rect(0.2, 0.2), &at(6.3, 1.5), Color::WHITE);
        draw_shape(&mut view, &Shape::Circle { radius: 0.5 }, &at(8.0, 3.5), Color::WHITE);
        let ball = Shape::Capsule { a: -Vec2::X, b: Vec2::X, radius: 0.3 };
        draw_shape(&mut view, &ball, &at(4.0, 3.5), Color::WHITE);
        let expected = ["     (    )    oo", "", "   []       []", "####################"];
        assert_eq!(view.to_lines(), expected);
    }

    #[test]
    fn nonsense_does_no_harm() {
        let mut view = TextView::new(0, 0);
        view.begin(DVec2::ZERO, DVec2::new(f64::NAN, 1.0));
        for huge in [f32::NAN, f32::INFINITY, 1.0e30, -1.0e30] {
            let pose = Transform::new(Vec2::splat(huge), Rot::IDENTITY);
            view.circle(&pose, huge, Color::WHITE);
            view.polygon(&pose, &[Vec2::splat(huge), Vec2::ZERO, Vec2::X], huge, Color::WHITE);
            view.capsule(Vec2::splat(huge), Vec2::ZERO, huge, Color::WHITE);
            view.segment(Vec2::splat(huge), Vec2::splat(-huge), Color::WHITE);
            view.polygon(&pose, &[], 0.0, Color::WHITE);
        }
        assert_eq!(view.cells().count(), 1);
    }
}
