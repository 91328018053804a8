//! Random changes of every kind between steps: invariants hold, every end has its begin.

use super::*;
use crate::Explosion;
use crate::describe::{Filter, JointDef, Material, TileGrid};
use std::collections::BTreeSet;

pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn below(&mut self, count: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % count
    }

    pub(super) fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.below(1 << 20) as f32 / (1 << 20) as f32
    }

    fn vec(&mut self, range: f32) -> Vec2 {
        Vec2::new(self.between(-range, range), self.between(-range, range))
    }

    fn shape(&mut self) -> ShapeDef {
        let size = self.between(0.2, 0.6);
        let shape = match self.below(5) {
            0 => Shape::circle(size),
            1 => Shape::rect(size, 0.3),
            2 => Shape::capsule(-Vec2::X * size, Vec2::X * size, 0.2),
            3 => Shape::aabb_box(Vec2::new(size, 0.3)),
            _ => Shape::regular(5, size),
        };
        let mut shape = ShapeDef::new(shape.unwrap()).offset(self.vec(0.2)).events();
        shape.sensor = self.below(6) == 0;
        shape.one_way = (self.below(8) == 0).then_some(Vec2::Y);
        shape.filter.category = 1 << self.below(3);
        shape
    }

    fn joint(&mut self) -> JointDef {
        let def = match self.below(11) {
            0 => JointDef::distance(1.0),
            1 => JointDef::rope(2.0),
            2 => JointDef::prismatic(Vec2::X).limits(-1.0, 1.0),
            3 => JointDef::weld().spring(4.0, 0.5),
            4 => JointDef::wheel(Vec2::Y).spring(4.0, 0.5).motor(3.0, 5.0),
            5 => JointDef::friction(10.0, 5.0),
            6 => JointDef::mouse(self.vec(3.0), 200.0),
            7 => JointDef::filter(),
            8 => JointDef::pulley(self.vec(5.0), self.vec(5.0), 6.0),
            9 => JointDef::gear(2.0),
            _ => JointDef::revolute(),
        };
        def.break_at(500.0, 500.0)
    }

    fn kind(&mut self) -> BodyKind {
        [BodyKind::Static, BodyKind::Kinematic, BodyKind::Dynamic, BodyKind::Dynamic][self.below(4)]
    }

    fn pick<T: Copy>(&mut self, list: &[T]) -> Option<T> {
        (!list.is_empty()).then(|| list[self.below(list.len())])
    }
}

/// One random change.
fn change(world: &mut World, random: &mut Random) {
    let bodies: Vec<BodyId> = world.body_ids().collect();
    let shapes: Vec<ShapeId> = world.shape_ids().collect();
    let joints: Vec<JointId> = world.joint_ids().collect();
    let (body, shape) = (random.pick(&bodies), random.pick(&shapes));
    let choice = random.below(27);
    match (choice, body, shape) {
        (0..5, _, _) if bodies.len() < 60 => {
            let kind = random.kind();
            let mut body = RigidBody { kind, ..RigidBody::default() }.position(random.vec(4.0));
            body.velocity = random.vec(10.0);
            body.bullet = random.below(4) == 0;
            body.enabled = random.below(9) != 0;
            body.awake = random.below(4) != 0;
            for _ in 0..random.below(3) {
                body = body.shape(random.shape());
            }
            world.add_body(body).unwrap();
        }
        (5, Some(body), _) => world.remove_body(body).unwrap(),
        (6, _, Some(shape)) => world.remove_shape(shape).unwrap(),
        (7, Some(body), _) => {
            world.add_shape(body, random.shape()).unwrap();
        }
        (8, Some(a), _) => {
            let b = random.pick(&bodies).unwrap();
            if a != b {
                world.add_joint(a, b, random.joint()).unwrap();
            }
        }
        (9, ..) => {
            if let Some(joint) = random.pick(&joints) {
                world.remove_joint(joint).unwrap();
            }
        }
        (10, Some(body), _) => {
            let kind = random.kind();
            world.body_mut(body).unwrap().set_kind(kind);
        }
        (11, Some(body), _) => {
            let enabled = random.below(3) != 0;
            world.body_mut(body).unwrap().set_enabled(enabled);
        }
        (12, Some(body), _) => world.body_mut(body).unwrap().sleep(),
        (13, Some(body), _) => world.body_mut(body).unwrap().set_position(random.vec(4.0)),
        (14, Some(body), _) => world.body_mut(body).unwrap().set_velocity(random.vec(60.0)),
        (15, _, Some(shape)) => {
            let geometry = random.shape().shape;
            world.shape_mut(shape).unwrap().set_shape(geometry).unwrap();
        }
        (16, _, Some(shape)) => {
            let filter = Filter { mask: random.below(8) as u64, ..Filter::default() };
            world.shape_mut(shape).unwrap().set_filter(filter);
        }
        (17, _, Some(shape)) => {
            let sensor = random.below(3) == 0;
            world.shape_mut(shape).unwrap().set_sensor(sensor);
        }
        (18, _, Some(shape)) => {
            let one_way = (random.below(2) == 0).then_some(Vec2::Y);
            world.shape_mut(shape).unwrap().set_one_way(one_way).unwrap();
        }
        (19, _, Some(shape)) => {
            let restitution = random.between(0.0, 1.0);
            let density = random.between(0.0, 2.0);
            let material = Material { restitution, density, ..Material::default() };
            world.shape_mut(shape).unwrap().set_material(material).unwrap();
        }
        (20, _, Some(shape)) => {
            let events = random.below(4) != 0;
            world.shape_mut(shape).unwrap().set_events(events, events);
        }
        (21, ..) => {
            let blast = Explosion {
                center: random.vec(3.0).into(),
                radius: 1.0,
                falloff: 1.0,
                impulse_per_metre: 3.0,
            };
            world.explode(&blast, &QueryFilter::new());
        }
        (24, ..) => {
            if let Some(joint) = random.pick(&joints) {
                world.set_joint(joint, random.joint()).unwrap();
            }
        }
        (25, ..) => {
            let tiles = world.tile_grid_ids().next();
            if let Some(tiles) = tiles {
                let (x, y) = (random.below(8) as u32, random.below(4) as u32);
                world.set_tile(tiles, x, y, random.below(13) as u16).unwrap();
            }
        }
        (26, ..) if random.below(10) == 0 => {
            let tiles = world.tile_grid_ids().next();
            if let Some(tiles) = tiles {
                world.remove_tiles(tiles).unwrap();
            }
        }
        (22, Some(body), _) => world.body_mut(body).unwrap().set_target(at(0.0, 0.0), DT),
        (23, Some(body), _) => {
            world.body_mut(body).unwrap().set_mass(Some(random.between(0.1, 5.0))).unwrap();
        }
        _ => {}
    }
}

/// What events say about who touches whom.
#[derive(Default)]
struct Model {
    contacts: BTreeSet<(ShapeId, ShapeId)>,
    overlaps: BTreeSet<(ShapeId, ShapeId)>,
}

impl Model {
    fn follow(&mut self, world: &World) {
        let events = world.events();
        // A contact may end by a change and begin again in the step, or begin and end in one.
        for end in events.contact_end() {
            let known = self.contacts.remove(&(end.shape_a, end.shape_b));
            let begun = events
                .contact_begin()
                .iter()
                .any(|begin| (begin.shape_a, begin.shape_b) == (end.shape_a, end.shape_b));
            assert!(known || begun, "{end:?} has not begun");
        }
        for begin in events.contact_begin() {
            let pair = (begin.shape_a, begin.shape_b);
            assert!(world.shape(pair.0).is_some() && world.shape(pair.1).is_some());
            assert!(self.contacts.insert(pair), "{begin:?} twice");
        }
        for end in events.sensor_end() {
            assert!(self.overlaps.remove(&(end.sensor, end.visitor)), "{end:?} has not begun");
        }
        for begin in events.sensor_begin() {
            assert!(world.shape(begin.sensor).unwrap().is_sensor());
            assert!(self.overlaps.insert((begin.sensor, begin.visitor)), "{begin:?} twice");
        }
        let seen: BTreeSet<(ShapeId, ShapeId)> = world
            .shape_ids()
            .flat_map(|sensor| world.sensor_overlaps(sensor).map(move |visitor| (sensor, visitor)))
            .collect();
        assert_eq!(seen, self.overlaps);
        check_overlaps(world, &seen);
        for (a, b) in &self.contacts {
            assert!(world.shape(*a).is_some() && world.shape(*b).is_some(), "{a} {b} are gone");
        }
        for hit in events.hits() {
            assert!(hit.speed >= world.settings.hit_event_threshold);
        }
        for broken in events.joint_breaks() {
            assert!(world.joint(broken.joint).is_none(), "{broken:?} is still there");
            let load = broken.force.length().max(broken.torque.abs());
            assert!(load > 500.0, "{broken:?}");
        }
        for body in events.woke().iter().chain(events.fell_asleep()) {
            assert!(world.body(*body).is_some() || body.index() < 1 << 16);
        }
    }
}

/// Sensors see what overlaps them now; what they see beyond that went by fast.
fn check_overlaps(world: &World, seen: &BTreeSet<(ShapeId, ShapeId)>) {
    let info = |shape: ShapeId| {
        let shape = world.shape(shape).unwrap();
        (shape, world.body(shape.body()).unwrap())
    };
    let is_fast = |body: BodyId| {
        let mut fast = world.scratch.fast.iter().chain(&world.scratch.carriers);
        fast.any(|fast| fast.body == body.index)
    };
    for of in world.shape_ids() {
        for visitor in world.shape_ids() {
            let ((sensor, body), (shape, other)) = (info(of), info(visitor));
            let may_see = sensor.is_sensor()
                && !shape.is_sensor()
                && body.id() != other.id()
                && (body.is_enabled() && other.is_enabled())
                && sensor.filter().collides(&shape.filter())
                && (body.kind() != BodyKind::Static || other.kind() != BodyKind::Static);
            let gap = shape.pose().relative_to(sensor.pose());
            let overlaps =
                crate::geometry::distance(sensor.shape(), shape.shape(), gap).separation <= 0.0;
            let sees = seen.contains(&(of, visitor));
            if may_see && overlaps {
                assert!(sees, "{of} does not see {visitor}");
            } else if sees {
                assert!(may_see && (is_fast(body.id()) || is_fast(other.id())), "{of} {visitor}");
            }
        }
    }
}

fn play(seed: u64, threads: usize) -> u64 {
    let mut random = Random(seed);
    let mut world = world();
    world.set_threads(threads);
    add_ground(&mut world);
    let tiles = TileGrid::parse(1.0, &["........", "/##\\_\"--", "########", "########"]).unwrap();
    world.add_tiles(tiles.position(Vec2::new(-4.0, 0.0))).unwrap();
    let mut model = Model::default();
    let mut all = 0_u64;
    for _ in 0..200 {
        for _ in 0..random.below(4) {
            change(&mut world, &mut random);
            if let Err(problem) = world.validate() {
                panic!("seed {seed}: {problem}");
            }
        }
        world.step(DT);
        if let Err(problem) = world.validate() {
            panic!("seed {seed}: after the step: {problem}");
        }
        model.follow(&world);
        let events = world.events();
        for count in [events.hits().len(), events.woke().len(), events.contact_begin().len()] {
            all = all.wrapping_mul(31).wrapping_add(count as u64);
        }
    }
    all ^ world.state_hash()
}

#[test]
fn anything_may_be_removed_or_changed_at_any_time() {
    for seed in 0..40 {
        play(seed, 1);
    }
}

#[test]
fn random_changes_are_deterministic_on_threads() {
    for seed in 100..104 {
        assert_eq!(play(seed, 1), play(seed, 3));
    }
}
