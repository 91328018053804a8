//! What stands still: one piece, whatever it is made of, with an upper edge of its own colour.

use super::cast::{Cast, Line};
use super::{Easel, merged};
use crate::canvas::paint;
use crate::paths::polyline;
use tiny_physics::Vec2;
use tiny_skia::{FillRule, Mask, Path, PathBuilder, Rect, Transform as Placement};

/// Metres that filled ground goes on beyond the ends of its line.
const RIM: f32 = 0.4;

impl Easel<'_> {
    pub(super) fn ground(&mut self, cast: &Cast) {
        let mut bare = Vec::new();
        let mut filled = Vec::new();
        for line in &cast.lines {
            match self.below(line) {
                Some(path) => filled.push(path),
                None => bare.push(line),
            }
        }
        let floor = self.down_from(&cast.ground);
        for path in filled.iter().chain(&merged(cast.ground.iter().chain(&floor))) {
            self.solid(path);
        }
        let width = self.pixels(0.14, 2.5, 6.0);
        for line in bare {
            let points: Vec<_> = line.points.iter().map(|p| self.camera.to_pixels(*p)).collect();
            if let Some(path) = polyline(&points).filter(is_near) {
                self.stroke(&path, width + 1.5, self.theme.ground[1]);
                self.stroke(&path, width, self.theme.ground[0]);
            }
        }
    }

    /// What lies below the lowest ground, where that goes from edge to edge of the picture.
    fn down_from(&self, ground: &[Path]) -> Option<Path> {
        let (width, height) = (self.canvas.width() as f32, self.canvas.height() as f32);
        let bounds = ground.iter().map(Path::bounds);
        let bottom = bounds.clone().map(|b| b.bottom()).max_by(f32::total_cmp)?;
        let low = bounds.filter(|b| b.bottom() > bottom - 1.0);
        let lowest = low.max_by(|a, b| a.width().total_cmp(&b.width()))?;
        let across = lowest.left() <= 0.0 && lowest.right() >= width;
        let below = Rect::from_ltrb(0.0, lowest.bottom() - 1.0, width, height);
        below.filter(|_| across).map(PathBuilder::from_rect)
    }

    /// The colour of the edge, and on it the ground itself, a little lower, so that the edge shows above it alone.
    fn solid(&mut self, path: &Path) {
        let [ground, edge] = self.theme.ground;
        let (width, height) = (self.canvas.width(), self.canvas.height());
        let Some(mut mask) = Mask::new(width, height) else { return };
        mask.fill_path(path, FillRule::Winding, true, Placement::identity());
        self.fill(path, edge);
        let place = Placement::from_translate(0.0, self.pixels(0.12, 1.5, 5.0));
        let color = paint(ground);
        self.canvas.pixmap.fill_path(path, &color, FillRule::Winding, place, Some(&mask));
    }

    /// A line of ground with all that lies below it; `None` where it is no ground but a wall, a wire or a ceiling.
    fn below(&self, line: &Line) -> Option<Path> {
        let points = &line.points;
        let (first, last) = (*points.first()?, *points.last()?);
        let steps = points.windows(2).map(|pair| (pair[1].x - pair[0].x).abs());
        let (net, total) = (last.x - first.x, steps.sum::<f32>());
        let solid_above = line.one_sided && net > 0.0;
        if points.len() < 5 || net.abs() < 0.6 * total || solid_above {
            return None;
        }
        let lowest = points.iter().fold(f32::INFINITY, |low, p| low.min(p.y));
        let view = self.camera.view();
        let bottom = (lowest - (0.12 * net.abs()).max(1.5)).max(view.min.y.min(lowest) - 1.0);
        let out = RIM * net.signum();
        let seen = |p: &Vec2| p.x.abs() < 4.0 * view.max.x;
        let (start, end) = (points.iter().position(seen)?, points.iter().rposition(seen)? + 1);
        let (first, last) = (points[start], points[end - 1]);
        let ends = [
            Vec2::new(last.x + out, last.y),
            Vec2::new(last.x + out, bottom),
            Vec2::new(first.x - out, bottom),
            Vec2::new(first.x - out, first.y),
        ];
        let mut path = PathBuilder::new();
        for (i, p) in points[start..end].iter().chain(&ends).enumerate() {
            let p = self.camera.to_pixels(*p);
            if i == 0 { path.move_to(p.x, p.y) } else { path.line_to(p.x, p.y) }
        }
        path.close();
        path.finish().filter(is_near)
    }
}

/// Is a path within the rasteriser's numbers?
fn is_near(path: &Path) -> bool {
    let (bounds, far) = (path.bounds(), 1.0e5);
    bounds.left() > -far && bounds.right() < far && bounds.top() > -far && bounds.bottom() < far
}
