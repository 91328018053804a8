//! Who is in a picture, and as what.

use super::{Painting, merged};
use crate::camera::Camera;
use tiny_physics::{
    Body, BodyKind, Color, JointKind, JointRef, Pose, Shape, ShapeRef, Transform, Vec2, World,
};
use tiny_skia::Path;

/// All that is to be painted, in pixels.
pub struct Cast {
    /// Moving bodies, by their index.
    pub figures: Vec<Figure>,
    /// Solid static shapes.
    pub ground: Vec<Path>,
    /// Runs of segments of static bodies, relative to the camera's centre, metres.
    pub lines: Vec<Line>,
    /// Outlines of sensors.
    pub sensors: Vec<Path>,
    /// Joints and where they hold.
    pub joints: Vec<Held>,
}

/// A moving body.
pub struct Figure {
    /// Outlines of all its shapes.
    pub path: Path,
    /// Lines of its segments.
    pub lines: Vec<Path>,
    pub color: Color,
    pub look: Look,
}

/// How a body is painted.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Look {
    Plain,
    /// Middle, radius in pixels, and angle on the screen.
    Ball {
        center: Vec2,
        radius: f32,
        angle: f32,
    },
    /// Corners in pixels.
    Crate {
        corners: [Vec2; 4],
    },
    /// A link of a chain: ends and radius in pixels. `even` links are seen from the side.
    Link {
        a: Vec2,
        b: Vec2,
        radius: f32,
        even: bool,
    },
    /// Somebody: where the eyes are, their distance in pixels, and which way they look (-1 to 1).
    Somebody {
        eyes: Vec2,
        apart: f32,
        look: f32,
    },
}

/// Segments one after the other.
pub struct Line {
    pub points: Vec<Vec2>,
    /// Is it solid from one side only: from the right of the way?
    pub one_sided: bool,
}

/// A joint in pixels.
pub struct Held {
    pub kind: JointKind,
    pub anchors: [Vec2; 2],
    /// Is one of the bodies a link of a chain?
    pub in_chain: bool,
    /// Half of the width of the thinner body where the joint holds, pixels.
    pub room: f32,
}

impl Figure {
    /// Too small for a shadow and an outline of its own?
    pub fn is_small(&self) -> bool {
        let bounds = self.path.bounds();
        bounds.width().max(bounds.height()) < 5.0
    }
}

impl Cast {
    pub fn of(world: &World, camera: &Camera, painting: &Painting) -> Self {
        let mut cast = Self {
            figures: Vec::new(),
            ground: Vec::new(),
            lines: Vec::new(),
            sensors: Vec::new(),
            joints: Vec::new(),
        };
        let groups = Groups::of(world);
        for body in world.bodies().filter(Body::is_enabled) {
            let pose = place(&body, painting.alpha);
            let frame = Transform::new(pose.p.relative_to(camera.center), pose.q);
            if body.kind() == BodyKind::Static {
                cast.add_static(&body, camera, frame);
            } else {
                cast.add_figure(&body, camera, frame, (painting, &groups));
            }
        }
        cast.add_joints(world, camera, painting.alpha);
        cast
    }

    fn add_static(&mut self, body: &Body<'_>, camera: &Camera, frame: Transform) {
        for shape in shapes(body) {
            let frame = frame.compose(shape.local());
            match shape.shape() {
                Shape::Segment { a, b } if !shape.is_sensor() => {
                    let one_sided = shape.link().is_some();
                    self.add_segment(frame.apply(*a), frame.apply(*b), one_sided);
                }
                solid => {
                    let path = camera.path(solid, &frame);
                    let list = if shape.is_sensor() { &mut self.sensors } else { &mut self.ground };
                    list.extend(path);
                }
            }
        }
    }

    /// Goes on with the last line where the segment begins at its end.
    fn add_segment(&mut self, a: Vec2, b: Vec2, one_sided: bool) {
        const NEAR: f32 = 1.0e-3;
        if let Some(line) = self.lines.last_mut() {
            let meets = line.points.last().is_some_and(|end| end.distance(a) < NEAR);
            if meets && line.one_sided == one_sided {
                line.points.push(b);
                return;
            }
        }
        self.lines.push(Line { points: vec![a, b], one_sided });
    }

    fn add_figure(
        &mut self,
        body: &Body<'_>,
        camera: &Camera,
        frame: Transform,
        (painting, groups): (&Painting, &Groups),
    ) {
        let (mut solid, mut lines) = (Vec::new(), Vec::new());
        for shape in shapes(body) {
            let Some(path) = camera.path(shape.shape(), &frame.compose(shape.local())) else {
                continue;
            };
            // The body of a character may well be a sensor alone.
            if shape.is_sensor() && body.shapes().count() > 1 {
                self.sensors.push(path);
            } else if matches!(shape.shape(), Shape::Segment { .. }) {
                lines.push(path);
            } else {
                solid.push(path);
            }
        }
        let Some(path) = merged(solid.iter().chain(&lines)) else { return };
        let path = merged(&solid).unwrap_or(path);
        let look = look(body, camera, frame, groups);
        let theme = &painting.theme;
        let color = match (body.kind(), look) {
            (BodyKind::Kinematic, Look::Somebody { .. }) => theme.bodies[0],
            (BodyKind::Kinematic, _) => theme.kinematic,
            _ => {
                let index = body.id().index();
                let group = groups.root(index);
                theme.body(group, index - group)
            }
        };
        self.figures.push(Figure { path, lines, color, look });
    }

    fn add_joints(&mut self, world: &World, camera: &Camera, alpha: f32) {
        for joint in world.joints().filter(JointRef::is_enabled) {
            let (a, b) = joint.bodies();
            let (Some(a), Some(b)) = (world.body(a), world.body(b)) else { continue };
            let def = joint.def();
            let pixel = |body: &Body<'_>, anchor: Vec2| {
                let pose = place(body, alpha);
                camera.to_pixels(pose.apply(anchor).relative_to(camera.center))
            };
            let anchors = [pixel(&a, def.anchor_a), pixel(&b, def.anchor_b)];
            let in_chain = [&a, &b].into_iter().any(is_link);
            let thin = [&a, &b].into_iter().flat_map(shapes).map(|s| thickness(s.shape()));
            let room = camera.scale * thin.fold(f32::INFINITY, f32::min);
            if anchors.iter().all(|p| p.is_finite() && p.abs().x.max(p.abs().y) < 1.0e5) {
                self.joints.push(Held { kind: def.kind, anchors, in_chain, room });
            }
        }
    }
}

/// Where a body is painted.
fn place(body: &Body<'_>, alpha: f32) -> Pose {
    if alpha == 1.0 { body.pose() } else { body.interpolated_pose(alpha) }
}

fn shapes<'a>(body: &Body<'a>) -> impl Iterator<Item = ShapeRef<'a>> {
    let world = body.world();
    body.shapes().filter_map(|id| world.shape(id))
}

/// The look of a body by its shape, if it has one alone.
fn look(body: &Body<'_>, camera: &Camera, frame: Transform, groups: &Groups) -> Look {
    let mut all = shapes(body);
    let (Some(only), None) = (all.next(), all.next()) else { return Look::Plain };
    let frame = frame.compose(only.local());
    let pixel = |p: Vec2| camera.to_pixels(frame.apply(p));
    match *only.shape() {
        Shape::Circle { radius } => Look::Ball {
            center: camera.to_pixels(frame.p),
            radius: radius * camera.scale,
            angle: 0.0 - frame.q.angle(),
        },
        Shape::Aabb { half_extents: h } => {
            let at = |x: f32, y: f32| pixel(Vec2::new(x, y));
            Look::Crate { corners: [at(-h.x, -h.y), at(h.x, -h.y), at(h.x, h.y), at(-h.x, h.y)] }
        }
        Shape::Capsule { a, b, radius } if is_link(body) => {
            let index = body.id().index();
            let even = (index - groups.root(index)).is_multiple_of(2);
            Look::Link { a: pixel(a), b: pixel(b), radius: radius * camera.scale, even }
        }
        Shape::Capsule { a, b, radius } if body.kind() == BodyKind::Kinematic && a != b => {
            let (a, b) = if pixel(a).y < pixel(b).y { (a, b) } else { (b, a) };
            let way = (a - b).normalized();
            if frame.q.rotate(way).y < 0.9 {
                return Look::Plain;
            }
            let look = (0.6 * body.velocity().x).clamp(-1.0, 1.0);
            Look::Somebody { eyes: pixel(a), apart: 0.42 * radius * camera.scale, look }
        }
        Shape::Polygon(polygon) if polygon.radius() == 0.0 && polygon.as_rect().is_some() => {
            let corners = polygon.vertices();
            Look::Crate { corners: [0, 1, 2, 3].map(|i| pixel(corners[i])) }
        }
        _ => Look::Plain,
    }
}

/// Half of the width of a shape where it is thin, metres.
fn thickness(shape: &Shape) -> f32 {
    match shape {
        Shape::Circle { radius } | Shape::Capsule { radius, .. } => *radius,
        Shape::Segment { .. } => f32::INFINITY,
        Shape::Aabb { half_extents } => half_extents.x.min(half_extents.y),
        Shape::Polygon(polygon) => {
            let size = shape.aabb(Transform::IDENTITY).half_extents();
            polygon.as_rect().map_or(size.x.min(size.y), |(half, _)| half.x.min(half.y))
        }
    }
}

/// A capsule that hangs in plain hinges and nothing else: a link of a chain.
fn is_link(body: &Body<'_>) -> bool {
    let mut all = shapes(body);
    let (Some(only), None) = (all.next(), all.next()) else { return false };
    let Shape::Capsule { a, b, radius } = *only.shape() else { return false };
    let plain = JointKind::Revolute { spring: None, target_angle: 0.0, limits: None, motor: None };
    let world = body.world();
    let mut joints = body.joints().filter_map(|id| world.joint(id)).peekable();
    body.kind() == BodyKind::Dynamic
        && a.distance(b) > 3.0 * radius
        && joints.peek().is_some()
        && joints.all(|joint| joint.def().kind == plain)
}

/// Which bodies are joined together.
struct Groups(Vec<usize>);

impl Groups {
    fn of(world: &World) -> Self {
        let count = world.body_ids().map(|id| id.index() + 1).max().unwrap_or(0);
        let mut groups = Self((0..count).collect());
        for joint in world.joints() {
            let holds = matches!(
                joint.def().kind,
                JointKind::Revolute { .. }
                    | JointKind::Prismatic { .. }
                    | JointKind::Weld { .. }
                    | JointKind::Wheel { .. }
            );
            let (a, b) = joint.bodies();
            let moves = |id| world.body(id).is_some_and(|b| b.kind() == BodyKind::Dynamic);
            if holds && moves(a) && moves(b) {
                let (a, b) = (groups.root(a.index()), groups.root(b.index()));
                groups.0[a.max(b)] = a.min(b);
            }
        }
        // Short ways for those who ask later.
        for i in 0..count {
            groups.0[i] = groups.0[groups.0[i]];
        }
        groups
    }

    /// The least index of those that a body is joined to.
    fn root(&self, mut body: usize) -> usize {
        while self.0[body] != body {
            body = self.0[body];
        }
        body
    }
}
