//! Shapes of the world as paths in pixels, cut to what a picture can show: huge coordinates would overflow the
//! rasteriser's numbers.

use crate::camera::Camera;
use crate::outline;
use tiny_physics::{Shape, Transform, Vec2};
use tiny_skia::{Path, PathBuilder};

impl Camera {
    /// A shape in its frame (relative to the camera's centre); `None` where nothing of it can be seen. A segment is a line
    /// without width.
    pub(crate) fn path(&self, shape: &Shape, pose: &Transform) -> Option<Path> {
        match shape {
            Shape::Circle { radius } => self.circle_path(pose, *radius),
            Shape::Aabb { half_extents: h } => {
                let corners = [-*h, Vec2::new(h.x, -h.y), *h, Vec2::new(-h.x, h.y)];
                self.polygon_path(pose, &corners, 0.0)
            }
            Shape::Capsule { a, b, radius } => {
                self.capsule_path(pose.apply(*a), pose.apply(*b), *radius)
            }
            Shape::Segment { a, b } => self.line_path(pose.apply(*a), pose.apply(*b)),
            Shape::Polygon(polygon) => {
                self.polygon_path(pose, polygon.vertices(), polygon.radius())
            }
        }
    }

    pub(crate) fn polygon_path(
        &self,
        pose: &Transform,
        vertices: &[Vec2],
        radius: f32,
    ) -> Option<Path> {
        let reach = vertices.iter().fold(0.0_f32, |reach, v| reach.max(v.length())) + radius;
        if self.unseen(pose.p, reach) {
            return None;
        }
        let points = self.cut_polygon(vertices.iter().map(|v| pose.apply(*v)).collect());
        let points: Vec<_> = points.iter().map(|p| self.to_pixels(*p)).collect();
        self.near(outline::rounded(&points, radius * self.scale))
    }

    pub(crate) fn circle_path(&self, pose: &Transform, radius: f32) -> Option<Path> {
        if self.unseen(pose.p, radius) {
            return None;
        }
        let (center, size) = (self.to_pixels(pose.p), radius * self.scale);
        if size <= self.width.max(self.height) as f32 {
            return self.near(PathBuilder::from_circle(center.x, center.y, size));
        }
        // As a polygon it can be cut.
        const CORNERS: usize = 720;
        let step = core::f32::consts::TAU / CORNERS as f32;
        let corner = |i: usize| Transform::from_angle(Vec2::ZERO, i as f32 * step).q.x_axis();
        let corners: Vec<_> = (0..CORNERS).map(|i| corner(i) * radius).collect();
        self.polygon_path(pose, &corners, 0.0)
    }

    pub(crate) fn capsule_path(&self, a: Vec2, b: Vec2, radius: f32) -> Option<Path> {
        let (a, b) = self.cut_line(a, b).or((a == b).then_some((a, b)))?;
        if self.unseen((a + b) * 0.5, radius + a.distance(b)) {
            return None;
        }
        let points = [self.to_pixels(a), self.to_pixels(b)];
        let size = radius * self.scale;
        self.near(if a == b {
            PathBuilder::from_circle(points[0].x, points[0].y, size)
        } else {
            outline::rounded(&points, size)
        })
    }

    pub(crate) fn line_path(&self, a: Vec2, b: Vec2) -> Option<Path> {
        let (a, b) = self.cut_line(a, b)?;
        polyline(&[self.to_pixels(a), self.to_pixels(b)])
    }

    /// Is a disk of `radius` metres around `p` out of the picture, or not a number?
    pub(crate) fn unseen(&self, p: Vec2, radius: f32) -> bool {
        let half = self.view().half_extents() + Vec2::splat(radius);
        let seen = p.x.abs() <= half.x && p.y.abs() <= half.y;
        !seen
    }

    /// Only a path that is not far outside of the picture.
    fn near(&self, path: Option<Path>) -> Option<Path> {
        let far = 4.0 * self.width.max(self.height) as f32;
        path.filter(|path| {
            let bounds = path.bounds();
            let near = bounds.left() > -far && bounds.top() > -far;
            near && bounds.right() < far && bounds.bottom() < far
        })
    }

    /// A line of the world cut to what the picture can show. `None` where nothing is left.
    fn cut_line(&self, a: Vec2, b: Vec2) -> Option<(Vec2, Vec2)> {
        if !a.is_finite() || !b.is_finite() {
            return None;
        }
        let half = self.view().half_extents() * 1.1;
        let (mut enter, mut leave) = (0.0_f32, 1.0_f32);
        let way = b - a;
        for axis in 0..2 {
            for (distance, speed) in
                [(half[axis] - a[axis], way[axis]), (half[axis] + a[axis], -way[axis])]
            {
                if speed == 0.0 {
                    if distance < 0.0 {
                        return None;
                    }
                } else if speed > 0.0 {
                    leave = leave.min(distance / speed);
                } else {
                    enter = enter.max(distance / speed);
                }
            }
        }
        (enter < leave).then(|| (a.lerp(b, enter), a.lerp(b, leave)))
    }

    /// Cuts a convex polygon to a box somewhat larger than the picture (Sutherland-Hodgman).
    pub(crate) fn cut_polygon(&self, points: Vec<Vec2>) -> Vec<Vec2> {
        let half = self.view().half_extents() * 1.5;
        let sides = [(Vec2::X, half.x), (-Vec2::X, half.x), (Vec2::Y, half.y), (-Vec2::Y, half.y)];
        let inside_all = points.iter().all(|p| p.x.abs() <= half.x && p.y.abs() <= half.y);
        if inside_all {
            return points;
        }
        sides.into_iter().fold(points, |points, (normal, offset)| {
            let mut kept = Vec::with_capacity(points.len() + 2);
            for (i, &p) in points.iter().enumerate() {
                let q = points[(i + 1) % points.len()];
                let (out_p, out_q) = (p.dot(normal) - offset, q.dot(normal) - offset);
                if out_p <= 0.0 {
                    kept.push(p);
                }
                if (out_p < 0.0) != (out_q < 0.0) && out_p != out_q {
                    kept.push(p.lerp(q, (out_p / (out_p - out_q)).clamp(0.0, 1.0)));
                }
            }
            kept
        })
    }
}

/// Lines through points in pixels.
pub fn polyline(points: &[Vec2]) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (i, p) in points.iter().enumerate() {
        if i == 0 { path.move_to(p.x, p.y) } else { path.line_to(p.x, p.y) }
    }
    path.finish()
}
