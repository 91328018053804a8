//! Drawing a world for people who look for trouble.

use super::{Color, DebugDraw, DebugDrawOptions, Layer, depth_color, draw_bounds, draw_shape};
use crate::{
    Aabb, Body, BodyKind, ContactView, DVec2, JointKind, Pose, Rot, ShapeRef, Transform, Vec2,
    World,
};

/// Length of drawn normals, metres at length unit 1.
const NORMAL_LENGTH: f32 = 0.25;
/// Length of the axes at a centre of mass.
const AXIS_LENGTH: f32 = 0.2;
/// The way that a drawn velocity covers in this many seconds.
const VELOCITY_SECONDS: f32 = 0.1;
/// Depth in metres (at length unit 1) up to which bodies keep their colour, and from which they have
/// that of their depth.
const TINT_FROM: f32 = 0.0075;
const TINT_FULL: f32 = 0.02;

impl World {
    /// Draws the world as of the last step: shapes by the kind of their body, sleeping ones dimmed,
    /// and what else the options say. Contacts of sleeping bodies are not drawn.
    pub fn debug_draw(&self, draw: &mut dyn DebugDraw, options: &DebugDrawOptions) {
        let pen = &mut Pen { draw, options, unit: self.settings.length_unit };
        if options.shapes {
            let tints = self.depth_tints(options);
            self.draw_shapes(pen, &tints, true);
            self.draw_shapes(pen, &tints, false);
        }
        if options.joints {
            self.draw_joints(pen);
        }
        if options.bounds {
            self.draw_fat_boxes(pen);
        }
        if options.mass || options.velocities {
            self.body_ids().filter_map(|id| self.body(id)).for_each(|body| pen.motion(&body));
        }
        if options.contacts || options.normals {
            self.contacts().for_each(|contact| pen.contact(&contact));
        }
    }

    /// The deepest penetration of each body by its index, metres; empty where nobody asks.
    fn depth_tints(&self, options: &DebugDrawOptions) -> Vec<f32> {
        let mut depths = Vec::new();
        if !options.depth_tint {
            return depths;
        }
        for contact in self.contacts() {
            for point in contact.points() {
                for body in [contact.body_a, contact.body_b] {
                    if depths.len() <= body.index() {
                        depths.resize(body.index() + 1, 0.0);
                    }
                    let depth: &mut f32 = &mut depths[body.index()];
                    if -point.separation > *depth {
                        *depth = -point.separation;
                    }
                }
            }
        }
        depths
    }

    /// Draws the shapes of static bodies, or of all others.
    fn draw_shapes(&self, pen: &mut Pen<'_>, depths: &[f32], fixed: bool) {
        for shape in self.shape_ids().filter_map(|id| self.shape(id)) {
            let Some(body) = self.body(shape.body()) else { continue };
            if (body.kind() == BodyKind::Static) == fixed {
                let depth = depths.get(body.id().index()).copied().unwrap_or(0.0);
                pen.shape(&body, &shape, depth);
            }
        }
    }

    fn draw_joints(&self, pen: &mut Pen<'_>) {
        pen.draw.layer(Layer::Joint);
        for joint in self.joints().filter(|joint| joint.is_enabled()) {
            let (a, b) = joint.bodies();
            let (Some(a), Some(b)) = (self.body(a), self.body(b)) else { continue };
            let def = joint.def();
            let (pose_a, pose_b) = (pen.pose(&a), pen.pose(&b));
            let (anchor_a, anchor_b) = (pose_a.apply(def.anchor_a), pose_b.apply(def.anchor_b));
            let center = |pose: Pose, body: &Body<'_>| pose.apply(body.local_center());
            let (center_a, center_b) = (center(pose_a, &a), center(pose_b, &b));
            let color = pen.options.palette.joint;
            match def.kind {
                // Pulled to a point of the world, not to A.
                JointKind::Mouse { target, .. } => {
                    pen.line(center_b, anchor_b, color);
                    pen.line(anchor_b, target, color);
                    continue;
                }
                JointKind::Pulley { ground_a, ground_b, .. } => {
                    for (from, to) in
                        [(anchor_a, ground_a), (ground_a, ground_b), (ground_b, anchor_b)]
                    {
                        pen.line(from, to, color);
                    }
                    continue;
                }
                _ => {}
            }
            // The way to static bodies would be a web over the whole picture.
            if a.kind() != BodyKind::Static {
                pen.line(center_a, anchor_a, color);
            }
            if b.kind() != BodyKind::Static {
                pen.line(center_b, anchor_b, color);
            }
            pen.line(anchor_a, anchor_b, color);
            let anchor = pen.local(anchor_a);
            if pen.sees(&Aabb::new(anchor, anchor)) {
                pen.draw.point(anchor, 0.6 * pen.options.point_size, color);
            }
        }
    }

    fn draw_fat_boxes(&self, pen: &mut Pen<'_>) {
        pen.draw.layer(Layer::Bounds);
        let shapes = self.shape_ids().filter_map(|id| self.shape(id));
        for bounds in shapes.filter_map(|shape| shape.fat_aabb()) {
            let (min, max) = (pen.local(bounds.min.into()), pen.local(bounds.max.into()));
            let bounds = Aabb::new(min, max);
            if pen.sees(&bounds) {
                draw_bounds(pen.draw, &bounds, pen.options.palette.bounds);
            }
        }
    }
}

/// A drawer with the options of the moment.
struct Pen<'a> {
    draw: &'a mut dyn DebugDraw,
    options: &'a DebugDrawOptions,
    /// [`Settings::length_unit`](crate::Settings::length_unit).
    unit: f32,
}

impl Pen<'_> {
    /// A world point relative to the drawing's origin.
    fn local(&self, point: DVec2) -> Vec2 {
        point.relative_to(self.options.origin)
    }

    fn frame(&self, pose: Pose) -> Transform {
        Transform::new(self.local(pose.p), pose.q)
    }

    /// Where a body is drawn.
    fn pose(&self, body: &Body<'_>) -> Pose {
        let alpha = self.options.alpha;
        if alpha == 1.0 { body.pose() } else { body.interpolated_pose(alpha) }
    }

    fn sees(&self, bounds: &Aabb) -> bool {
        self.options.clip.is_none_or(|clip| clip.overlaps(bounds))
    }

    fn line(&mut self, from: DVec2, to: DVec2, color: Color) {
        let (from, to) = (self.local(from), self.local(to));
        if self.sees(&Aabb::new(from.min(to), from.max(to))) {
            self.draw.segment(from, to, color);
        }
    }

    fn shape(&mut self, body: &Body<'_>, shape: &ShapeRef<'_>, depth: f32) {
        let frame = self.frame(self.pose(body)).compose(shape.local());
        if !self.sees(&shape.shape().aabb(frame)) {
            return;
        }
        let layer = if shape.is_sensor() {
            Layer::Sensor
        } else {
            Layer::of_body(body.kind(), body.is_awake())
        };
        let own = self.options.palette.color(layer);
        let (from, full) = (TINT_FROM * self.unit, TINT_FULL * self.unit);
        let color = if layer == Layer::Awake && depth > from {
            own.mix(depth_color(depth / self.unit), (depth - from) / (full - from))
        } else {
            own
        };
        self.draw.layer(layer);
        draw_shape(self.draw, shape.shape(), &frame, color);
    }

    /// Centre of mass with the body's axes, and velocity.
    fn motion(&mut self, body: &Body<'_>) {
        if body.kind() == BodyKind::Static {
            return;
        }
        let center = self.local(self.pose(body).apply(body.local_center()));
        let palette = self.options.palette;
        let reach = AXIS_LENGTH * self.unit;
        if !self.sees(&Aabb::from_center(center, Vec2::splat(reach))) {
            return;
        }
        if self.options.mass {
            self.draw.layer(Layer::Mass);
            let rotation: Rot = self.pose(body).q;
            self.draw.segment(center, center + rotation.x_axis() * reach, Color::rgb(240, 90, 90));
            self.draw.segment(center, center + rotation.y_axis() * reach, Color::rgb(90, 220, 90));
            self.draw.point(center, 0.6 * self.options.point_size, palette.mass);
        }
        if self.options.velocities && body.is_awake() {
            self.draw.layer(Layer::Velocity);
            let end = center + body.velocity() * VELOCITY_SECONDS;
            self.draw.segment(center, end, palette.velocity);
        }
    }

    fn contact(&mut self, contact: &ContactView) {
        for point in contact.points() {
            let at = self.local(point.position);
            let end = at + contact.normal * (NORMAL_LENGTH * self.unit);
            if !self.sees(&Aabb::new(at, at)) {
                continue;
            }
            if self.options.normals {
                self.draw.layer(Layer::Normal);
                self.draw.segment(at, end, self.options.palette.normal);
            }
            if self.options.contacts {
                self.draw.layer(Layer::Contact);
                self.draw.point(
                    at,
                    self.options.point_size,
                    depth_color(-point.separation / self.unit),
                );
            }
        }
    }
}
