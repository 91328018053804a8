//! Joints as what they would be made of: ropes, rods, springs, pins.

use super::Easel;
use super::cast::{Cast, Held};
use tiny_physics::{DVec2, JointKind, Vec2};
use tiny_skia::PathBuilder;

impl Easel<'_> {
    /// What lies behind the bodies.
    pub(super) fn ropes(&mut self, cast: &Cast) {
        cast.joints.iter().for_each(|held| self.rope_of(held));
    }

    fn rope_of(&mut self, held: &Held) {
        let [a, b] = held.anchors;
        match held.kind {
            JointKind::Distance { spring: Some(_), .. } => self.coil(a, b),
            JointKind::Distance { limits: Some(limits), motor: None, .. } => {
                self.rope(a, b, limits.upper * self.camera.scale);
            }
            JointKind::Distance { .. } => self.rod(a, b),
            JointKind::Mouse { target, .. } => {
                let target = self.pixel(target);
                self.rope(b, target, 0.0);
            }
            JointKind::Pulley { ground_a, ground_b, .. } => {
                let [over_a, over_b] = [ground_a, ground_b].map(|p| self.pixel(p));
                for (from, to) in [(a, over_a), (over_a, over_b), (over_b, b)] {
                    self.rope(from, to, 0.0);
                }
            }
            JointKind::Motor { linear_spring: Some(_), .. } => self.coil(a, b),
            JointKind::Prismatic { .. } => {
                let color = self.theme.metal.with_alpha(120);
                let width = self.pixels(0.08, 1.2, 3.0);
                self.canvas.line(a, b, width, color);
            }
            _ => {}
        }
    }

    /// What lies on top of them.
    pub(super) fn pins(&mut self, cast: &Cast) {
        for held in cast.joints.iter().filter(|held| !held.in_chain) {
            let [a, b] = held.anchors;
            match held.kind {
                JointKind::Revolute { .. } | JointKind::Wheel { .. } => self.pin(b, held.room),
                JointKind::Distance { .. } => {
                    self.pin(a, held.room);
                    self.pin(b, held.room);
                }
                JointKind::Pulley { ground_a, ground_b, .. } => {
                    for p in [ground_a, ground_b] {
                        let p = self.pixel(p);
                        self.pin(p, f32::INFINITY);
                    }
                }
                _ => {}
            }
        }
    }

    fn pixel(&self, point: DVec2) -> Vec2 {
        self.camera.to_pixels(point.relative_to(self.camera.center))
    }

    fn rod(&mut self, a: Vec2, b: Vec2) {
        let width = self.pixels(0.07, 1.4, 3.5);
        self.canvas.line(a, b, width, self.theme.metal);
    }

    /// A rope of a length in pixels: slack where that is longer than the way.
    fn rope(&mut self, a: Vec2, b: Vec2, length: f32) {
        let way = a.distance(b);
        // A flat arc over the way w that sags by s is longer by 8 s^2 / (3 w); its control point lies twice as deep.
        let slack = (length - way).clamp(0.0, 2.0 * length);
        let sag = (0.375 * slack * way.max(0.3 * length)).sqrt();
        let middle = (a + b) * 0.5 + Vec2::new(0.0, 2.0 * sag);
        let mut path = PathBuilder::new();
        path.move_to(a.x, a.y);
        path.quad_to(middle.x, middle.y, b.x, b.y);
        if let Some(path) = path.finish() {
            let width = self.pixels(0.07, 1.4, 3.2);
            let rope = self.theme.rope;
            self.stroke(&path, width + 1.2, self.theme.outline(rope));
            self.stroke(&path, width, rope);
        }
    }
}
