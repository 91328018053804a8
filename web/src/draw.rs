//! What is to be drawn of a world, as rows that WebGL takes as they are. Places are relative to the camera.

use crate::picture::Picture;
use crate::session::Session;
use crate::with;
use tiny_physics::record::Command;
use tiny_physics::{
    Aabb, Body, BodyKind, Color, DVec2, DebugDraw, DebugDrawOptions, ForceZone, Palette, Polygon,
    Pose, Rot, Shape, ShapeRef, Transform, Vec2, Water, World,
};

/// Numbers of a row.
const CORNERS: usize = 8;
/// Numbers of a water.
const WATER: usize = 8;
/// Of a style: what bodies go through.
const SENSOR: u8 = 8;
/// The index of no body.
const NOBODY: usize = 1 << 24;
/// Radians of a wave a metre, and a second.
const WAVES: f64 = 1.9;
const WAVE_RATE: f64 = 1.4;
/// Width of a hook, pixels.
const HOOK: f32 = 9.0;

/// What is drawn besides shapes.
mod show {
    pub(super) const JOINTS: u32 = 1;
    pub(super) const CONTACTS: u32 = 2;
    pub(super) const IMPULSES: u32 = 4;
    pub(super) const BOUNDS: u32 = 8;
    pub(super) const MASS: u32 = 16;
    pub(super) const VELOCITIES: u32 = 32;
    pub(super) const DEPTH: u32 = 64;
    pub(super) const ISLANDS: u32 = 128;
    pub(super) const LOAD: u32 = 256;
    /// On a light ground.
    pub(super) const LIGHT: u32 = 512;
}

/// Draws the world as seen from a camera at a point: bodies between the start (`alpha` 0) and the end (1) of the last step,
/// and what `shown` says. The numbers are address and length of the rows of boxes, polygons, lines and waters, and how many
/// numbers of the boxes and of the polygons are of what stands still.
#[unsafe(no_mangle)]
pub extern "C" fn tp_draw(session: u32, x: f64, y: f64, alpha: f32, shown: u32) -> bool {
    with(session, |session, shelf| {
        let mut picture = core::mem::take(&mut session.picture);
        let places = crate::places::now(session.world(), &session.places, session.commands());
        picture.draw(session.world(), &places, DVec2::new(x, y), alpha, shown);
        let lists = [&picture.boxes, &picture.polygons, &picture.lines, &picture.waters];
        let lists = lists.iter().flat_map(|list| [list.as_ptr() as usize, list.len()]);
        shelf.count(lists.chain(picture.still).map(|number| number as f64));
        session.picture = picture;
        Ok(())
    })
}

/// The box around all that is not too large to be seen whole: left, bottom, right, top; and the same of what moves.
#[unsafe(no_mangle)]
pub extern "C" fn tp_bounds(session: u32) -> bool {
    with(session, |session, shelf| {
        shelf.count(bounds(session));
        Ok(())
    })
}

fn bounds(session: &Session) -> Vec<f64> {
    let world = session.world();
    let mut boxes = [[f64::MAX, f64::MAX, f64::MIN, f64::MIN]; 2];
    for shape in world.shape_ids().filter_map(|id| world.shape(id)) {
        let Some(body) = world.body(shape.body()) else { continue };
        let pose = body.pose();
        let around = shape.shape().aabb(Transform::new(Vec2::ZERO, pose.q).compose(shape.local()));
        let (p, [min, max]) = (pose.p, [around.min, around.max]);
        let sides = [p.x + f64::from(min.x), p.y + f64::from(min.y)];
        let sides = [sides[0], sides[1], p.x + f64::from(max.x), p.y + f64::from(max.y)];
        let moves = usize::from(body.kind() != BodyKind::Static);
        grow(&mut boxes[moves], sides);
    }
    // What hangs swings to the other side.
    for joint in world.joint_ids().filter_map(|id| world.joint(id)) {
        let (a, b) = joint.bodies();
        let [a, b] = [a, b].map(|id| world.body(id).filter(|body| body.kind() != BodyKind::Static));
        if let (Some(body), None) | (None, Some(body)) = (a, b) {
            let (pivot, center) = (joint.anchors().0, body.center());
            let reach = f64::from(center.relative_to(pivot).length());
            grow(&mut boxes[1], [pivot.x - reach, pivot.y - reach, pivot.x + reach, pivot.y]);
        }
    }
    boxes.concat()
}

/// Makes a box large enough for another.
fn grow(own: &mut [f64; 4], [left, bottom, right, top]: [f64; 4]) {
    *own = [own[0].min(left), own[1].min(bottom), own[2].max(right), own[3].max(top)];
}

impl Picture {
    fn draw(&mut self, world: &World, places: &[Command], camera: DVec2, alpha: f32, shown: u32) {
        self.boxes.clear();
        self.polygons.clear();
        self.lines.clear();
        self.waters.clear();
        self.tints.clear();
        self.places(world, places, camera);
        if shown & show::DEPTH != 0 {
            self.tint_by_depth(world);
        } else if shown & show::ISLANDS != 0 {
            self.tint_by_island(world);
        }
        for fixed in [true, false] {
            for shape in world.shape_ids().filter_map(|id| world.shape(id)) {
                let Some(body) = world.body(shape.body()) else { continue };
                if (body.kind() == BodyKind::Static) == fixed {
                    let frame = frame(body.interpolated_pose(alpha), camera);
                    if shape.is_sensor() && self.is_water(&shape, frame) {
                        continue;
                    }
                    let style = style(&shape, body.kind(), body.is_awake());
                    let frame = frame.compose(shape.local());
                    self.shape(shape.shape(), frame, style, body.id().index());
                }
            }
            if fixed {
                self.still = [self.boxes.len(), self.polygons.len()];
            }
        }
        if shown & show::JOINTS != 0 {
            self.hooks(world, camera, shown & show::LIGHT != 0);
        }
        let mut palette = Palette::default();
        if shown & show::LIGHT != 0 {
            palette.joint = Color::rgb(104, 116, 139);
            palette.mass = Color::rgb(30, 36, 48);
            palette.velocity = Color::rgb(20, 150, 90);
            palette.bounds = Color::rgb(120, 120, 150).with_alpha(160);
        }
        let options = DebugDrawOptions {
            shapes: false,
            joints: shown & show::JOINTS != 0 && shown & show::LOAD == 0,
            bounds: shown & show::BOUNDS != 0,
            mass: shown & show::MASS != 0,
            contacts: shown & show::CONTACTS != 0,
            normals: false,
            velocities: shown & show::VELOCITIES != 0,
            depth_tint: false,
            origin: camera,
            palette,
            ..DebugDrawOptions::default()
        };
        world.debug_draw(self, &options);
        if shown & show::IMPULSES != 0 {
            self.impulses(world, camera);
        }
        if shown & show::LOAD != 0 {
            self.loads(world, camera);
        }
    }

    /// Waters, and areas in which forces act, which look like sensors.
    fn places(&mut self, world: &World, places: &[Command], camera: DVec2) {
        for place in places {
            match place {
                Command::ApplyWater(water, ..) => self.water(world, water, camera),
                Command::ApplyZone(zone, ..) if !is_shown(world, zone) => {
                    let frame = frame(zone.pose, camera);
                    self.shape(&zone.shape, frame, f32::from(SENSOR), NOBODY);
                }
                _ => {}
            }
        }
    }

    /// Does a sensor stand for water, which is seen already?
    fn is_water(&self, shape: &ShapeRef<'_>, frame: Transform) -> bool {
        let top = shape.shape().aabb(frame.compose(shape.local())).max.y;
        self.waters.chunks_exact(WATER).any(|water| (water[0] - top).abs() < 0.01)
    }

    fn water(&mut self, world: &World, water: &Water, camera: DVec2) {
        const ALL: f32 = 1.0e9;
        let normal = water.normal.normalized();
        let [x, y] = [normal.x, normal.y].map(f64::from);
        let deep = (water.surface.x - camera.x) * x + (water.surface.y - camera.y) * y;
        // Waves run along the surface; a length fits in a number of few digits however far away one is.
        let along = camera.x * y - camera.y * x;
        let phase =
            (WAVES * along + WAVE_RATE * world.step_count() as f64 / 60.0) % core::f64::consts::TAU;
        self.waters.extend([deep as f32, normal.x, normal.y, phase as f32]);
        let mut area = water.area.map_or([-ALL, -ALL, ALL, ALL], |area| {
            let [min, max] = [area.min, area.max].map(|p| DVec2::from(p).relative_to(camera));
            [min.x, min.y, max.x, max.y]
        });
        // It is not seen below the ground that holds it.
        let grounds = world.shapes().filter(|shape| is_static(world, shape)).map(|shape| {
            let pose = shape.pose();
            shape.shape().aabb(frame(pose, camera))
        });
        let below = |ground: &Aabb| {
            ground.min.x < area[2] && ground.max.x > area[0] && ground.min.y < deep as f32
        };
        let floor = grounds.filter(below).fold(f32::MAX, |floor, ground| floor.min(ground.min.y));
        if normal == Vec2::Y && floor < f32::MAX {
            area[1] = area[1].max(floor);
        }
        self.waters.extend(area);
    }

    /// A dot where a joint holds on to a body that never moves and has no shape there to be seen.
    fn hooks(&mut self, world: &World, camera: DVec2, light: bool) {
        let color = if light { Color::rgb(169, 180, 196) } else { Color::rgb(74, 85, 104) };
        for joint in world.joints().filter(|joint| joint.is_enabled()) {
            let (a, b) = joint.bodies();
            let (at_a, at_b) = joint.anchors();
            for (body, anchor) in [(a, at_a), (b, at_b)] {
                let bare = |body: &Body<'_>| {
                    body.kind() == BodyKind::Static && body.shapes().next().is_none()
                };
                if world.body(body).is_some_and(|body| bare(&body)) {
                    let anchor = anchor.relative_to(camera);
                    self.line(anchor, anchor, HOOK, color);
                }
            }
        }
    }

    fn shape(&mut self, shape: &Shape, frame: Transform, style: f32, body: usize) {
        let tint = self.tints.get(body).copied().unwrap_or(-1.0);
        let body = body as f32;
        let mut rounded = |place: Vec2, q: Rot, half: Vec2, radius: f32| {
            let row = [place.x, place.y, q.c, q.s, half.x, half.y, radius, style, body, tint];
            self.boxes.extend(row);
        };
        let mut along = |a: Vec2, b: Vec2, radius: f32| {
            let (a, b) = (frame.apply(a), frame.apply(b));
            let (way, middle) = (b - a, (a + b) * 0.5);
            let length = way.length();
            let q = if length > 0.0 {
                Rot { c: way.x / length, s: way.y / length }
            } else {
                Rot::IDENTITY
            };
            rounded(middle, q, Vec2::new(0.5 * length, 0.0), radius);
        };
        match shape {
            Shape::Circle { radius } => rounded(frame.p, frame.q, Vec2::ZERO, *radius),
            Shape::Aabb { half_extents } => rounded(frame.p, frame.q, *half_extents, 0.0),
            Shape::Capsule { a, b, radius } => along(*a, *b, *radius),
            Shape::Segment { a, b } => along(*a, *b, 0.0),
            Shape::Polygon(polygon) => match polygon.as_rect() {
                Some((half, local)) => {
                    let frame = frame.compose(local);
                    rounded(frame.p, frame.q, half, polygon.radius());
                }
                None => self.polygon_row(polygon, frame, [style, body, tint]),
            },
        }
    }

    fn polygon_row(&mut self, polygon: &Polygon, frame: Transform, [style, body, tint]: [f32; 3]) {
        let corners = polygon.vertices();
        let (p, q) = (frame.p, frame.q);
        self.polygons.extend([p.x, p.y, q.c, q.s, polygon.radius(), corners.len() as f32]);
        self.polygons.extend([style, body, tint]);
        let last = corners.last().copied().unwrap_or(Vec2::ZERO);
        for i in 0..CORNERS {
            let corner = corners.get(i).copied().unwrap_or(last);
            self.polygons.extend([corner.x, corner.y]);
        }
    }

    fn line(&mut self, a: Vec2, b: Vec2, width: f32, color: Color) {
        let color = [color.r, color.g, color.b, color.a].map(|part| f32::from(part) / 255.0);
        self.lines.extend([a.x, a.y, b.x, b.y, width]);
        self.lines.extend(color);
    }

    /// Metres of the deepest overlap.
    fn tint_by_depth(&mut self, world: &World) {
        for contact in world.contacts() {
            for point in contact.points() {
                for body in [contact.body_a, contact.body_b] {
                    let tint = place(&mut self.tints, body.index(), 0.0);
                    *tint = tint.max(-point.separation / world.settings.length_unit);
                }
            }
        }
    }

    /// 1 and up: what touches or is joined has the same number; -1 for what stands by itself.
    fn tint_by_island(&mut self, world: &World) {
        let mut roots: Vec<usize> = Vec::new();
        let moves = |id| world.body(id).is_some_and(|body| body.kind() == BodyKind::Dynamic);
        let contacts = world.contacts().map(|contact| (contact.body_a, contact.body_b));
        let joints = world.joint_ids().filter_map(|id| Some(world.joint(id)?.bodies()));
        for (a, b) in contacts.chain(joints).filter(|(a, b)| moves(*a) && moves(*b)) {
            let (a, b) = (root(&mut roots, a.index()), root(&mut roots, b.index()));
            // The smaller index is the root, so that an island keeps its colour.
            roots[a.max(b)] = a.min(b);
        }
        for body in world.body_ids().filter(|id| moves(*id)) {
            let root = root(&mut roots, body.index());
            *place(&mut self.tints, body.index(), -1.0) = 1.0 + root as f32;
        }
    }

    /// Lines along the normals, as long as the impulse is large for what it acts on.
    fn impulses(&mut self, world: &World, camera: DVec2) {
        let color = Color::rgb(255, 196, 64);
        for contact in world.contacts() {
            let masses =
                [contact.body_a, contact.body_b].map(|id| world.body(id).map_or(0.0, |b| b.mass()));
            let mass = masses.into_iter().filter(|mass| *mass > 0.0).fold(f32::MAX, f32::min);
            for point in contact.points() {
                let from = point.position.relative_to(camera);
                // A body at rest on one point gets an arrow of half a metre.
                let length = point.normal_impulse / mass * 10.0 * world.settings.length_unit;
                let length = length.min(3.0 * world.settings.length_unit);
                self.line(from, from + contact.normal * length, 2.0, color);
                self.line(from, from - contact.normal * length, 2.0, color);
            }
        }
    }

    /// Joints coloured by their load beside the weight of what they hold, from green to red.
    fn loads(&mut self, world: &World, camera: DVec2) {
        for joint in world.joint_ids().filter_map(|id| world.joint(id)) {
            let (a, b) = joint.bodies();
            let (from, to) = joint.anchors();
            let force = joint.force().length();
            let masses = [a, b].map(|id| world.body(id).map_or(0.0, |body| body.mass()));
            let weight = (masses[0] + masses[1]) * world.gravity.length().max(1.0);
            let strain =
                joint.def().break_at.map_or(force / (8.0 * weight), |limit| force / limit.force);
            let strain = strain.clamp(0.0, 1.0);
            let color = Color::rgb(80, 220, 120).mix(Color::rgb(255, 60, 50), strain);
            let (from, to) = (from.relative_to(camera), to.relative_to(camera));
            for (body, anchor) in [(a, from), (b, to)] {
                if let Some(body) = world.body(body).filter(|body| body.kind() != BodyKind::Static)
                {
                    self.line(body.center().relative_to(camera), anchor, 2.0 + 3.0 * strain, color);
                }
            }
            self.line(from, to, 7.0, color);
        }
    }
}

impl DebugDraw for Picture {
    fn polygon(&mut self, _: &Transform, _: &[Vec2], _: f32, _: Color) {}
    fn circle(&mut self, _: &Transform, _: f32, _: Color) {}
    fn capsule(&mut self, _: Vec2, _: Vec2, _: f32, _: Color) {}
    fn segment(&mut self, a: Vec2, b: Vec2, color: Color) {
        self.line(a, b, 1.5, color);
    }
    fn point(&mut self, p: Vec2, size: f32, color: Color) {
        self.line(p, p, size, color);
    }
    fn text(&mut self, _: Vec2, _: &str, _: Color) {}
}

/// Does a sensor of the world stand for an area of force?
fn is_shown(world: &World, zone: &ForceZone) -> bool {
    let stands_for = |shape: ShapeRef<'_>| {
        let off = shape.pose().p.relative_to(zone.pose.p).length();
        shape.is_sensor() && *shape.shape() == zone.shape && off < 0.01
    };
    world.shapes().any(stands_for)
}

fn is_static(world: &World, shape: &ShapeRef<'_>) -> bool {
    world.body(shape.body()).is_some_and(|body| body.kind() == BodyKind::Static)
}

fn frame(pose: Pose, camera: DVec2) -> Transform {
    Transform::new(pose.p.relative_to(camera), pose.q)
}

/// The kind of the body, 4 where it is awake, 8 for a sensor, 16 for a circle, whose turning is shown by a line.
fn style(shape: &ShapeRef<'_>, kind: BodyKind, awake: bool) -> f32 {
    let kind = match kind {
        BodyKind::Static => 0,
        BodyKind::Kinematic => 1,
        BodyKind::Dynamic => 2,
    };
    let round = matches!(shape.shape(), Shape::Circle { .. });
    let sensor = if shape.is_sensor() { SENSOR } else { 0 };
    f32::from(kind | u8::from(awake) << 2 | sensor | u8::from(round) << 4)
}

/// The place of an index in a list that grows as it needs to.
fn place(list: &mut Vec<f32>, index: usize, empty: f32) -> &mut f32 {
    if list.len() <= index {
        list.resize(index + 1, empty);
    }
    &mut list[index]
}

/// The root of a body, with shorter ways behind it.
fn root(roots: &mut Vec<usize>, mut body: usize) -> usize {
    while roots.len() <= body {
        roots.push(roots.len());
    }
    while roots[body] != body {
        roots[body] = roots[roots[body]];
        body = roots[body];
    }
    body
}
