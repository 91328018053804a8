//! Recordings hold everything that can be done to a world, play it again bit for bit, and are refused where they
//! are damaged.

mod common;

use common::sources::sources;
use common::*;
use proptest::prelude::*;
use proptest::test_runner::{RngSeed, TestRunner};
use std::cell::RefCell;
use std::collections::BTreeSet;
use tiny_physics::record::{
    BodyCommand, Command, FilterData, Made, Player, Recorder, Recording, ShapeCommand,
};
use tiny_physics::*;

/// Functions that change a world and need no command, with the reason.
const WITHOUT_COMMAND: [(&str, &str); 20] = [
    ("World::step", "every step is recorded"),
    ("World::try_step", "the same"),
    ("World::body_mut", "what it gives has commands"),
    ("World::shape_mut", "what it gives has commands"),
    ("World::joint_mut", "what it gives does what SetJoint does"),
    ("World::body_pair_mut", "what it gives has commands"),
    ("ShapeMut::set_friction", "what SetMaterial does"),
    ("ShapeMut::set_restitution", "what SetMaterial does"),
    ("ShapeMut::set_density", "what SetMaterial does"),
    ("CharacterMover::lead_body", "what SetPose and SetShape do"),
    ("World::remove_shapes", "what RemoveShape does, one by one"),
    ("Chain::set_material", "what SetMaterial does, one by one"),
    ("Chain::remove", "what RemoveShape does, one by one"),
    ("World::set_threads", "changes no results"),
    ("World::set_simd", "changes no results"),
    ("World::time_stages", "changes no results"),
    ("World::set_pair_filter", "code"),
    ("World::clear_pair_filter", "code"),
    ("World::set_pre_solve", "code"),
    ("World::clear_pre_solve", "code"),
];

/// The enum whose variants stand for the functions of a type.
const ENUMS: [(&str, &str); 3] =
    [("World", "Command"), ("BodyMut", "BodyCommand"), ("ShapeMut", "ShapeCommand")];

/// `set_gravity_scale` as `SetGravityScale`.
fn camel(name: &str) -> String {
    let words = name.split('_').map(|word| {
        let (first, rest) = word.split_at(1);
        first.to_uppercase() + rest
    });
    words.collect()
}

/// The variants of an enum of the module `record`, as the sources have them.
fn variants(of: &str) -> BTreeSet<String> {
    let sources = sources();
    let files = sources.iter().filter(|source| source.path.starts_with("play/record/"));
    files.flat_map(|source| source.members(of)).collect()
}

#[test]
fn everything_that_changes_a_world_has_a_command() {
    let sources = sources();
    let world: Vec<_> = sources.iter().filter(|s| !s.path.starts_with("play/record/")).collect();
    let types = ENUMS.map(|(owner, _)| owner);
    let changing: Vec<_> = world.iter().flat_map(|s| s.changing_functions(&types)).collect();
    assert!(changing.len() > 50, "found only {changing:?}");
    for (exempt, _) in WITHOUT_COMMAND {
        assert!(changing.iter().any(|name| name == exempt), "{exempt} is not there");
    }
    let has_command = |function: &str| {
        let (owner, name) = function.split_once("::").expect("a type and a name");
        let listed = ENUMS.iter().find(|(of, _)| *of == owner);
        listed.is_some_and(|(_, commands)| variants(commands).contains(&camel(name)))
            || function == "CharacterMover::update" && variants("Command").contains("MoveCharacter")
    };
    let exempt = |name: &String| WITHOUT_COMMAND.iter().any(|(exempt, _)| exempt == name);
    let missing: Vec<_> =
        changing.iter().filter(|name| !exempt(name) && !has_command(name)).collect();
    assert!(missing.is_empty(), "no command for {missing:?}, and no reason why not");
    let fields: Vec<_> = world.iter().flat_map(|source| source.members("World")).collect();
    assert_eq!(fields, ["gravity", "settings"]);
    for field in fields {
        assert!(variants("Command").contains(&camel(&format!("set_{field}"))), "{field}");
    }
}

/// Numbers for a command: its kind, what it is done to, how.
#[derive(Clone, Debug)]
struct Draw {
    kind: usize,
    which: [usize; 2],
    n: [f32; 4],
    flag: bool,
}

/// Kinds of commands that are done to the world, a body, a shape.
const KINDS: [usize; 3] = [22, 27, 8];

/// Mostly sensible, now and then hostile.
fn number() -> impl Strategy<Value = f32> {
    let hostile = [0.0, -0.0, f32::NAN, f32::INFINITY, f32::MAX, f32::MIN_POSITIVE, -1.0e20];
    prop_oneof![30 => -4.0_f32..4.0, 1 => prop::sample::select(hostile.to_vec())]
}

fn draw() -> impl Strategy<Value = Draw> {
    let which = [0..1000_usize, 0..1000];
    let n = [number(), number(), number(), number()];
    let kinds = 0..KINDS.iter().sum();
    (kinds, which, n, any::<bool>()).prop_map(|(kind, which, n, flag)| Draw {
        kind,
        which,
        n,
        flag,
    })
}

/// A recorder, and every handle that was ever given out.
struct Session {
    recorder: Recorder,
    bodies: Vec<BodyId>,
    shapes: Vec<ShapeId>,
    joints: Vec<JointId>,
    grids: Vec<TileGridId>,
    hero: CharacterMover,
    frame: Vec<u8>,
}

impl Session {
    /// A pile on a tile map, with a chain of bodies, a lift, a sensor, and a character.
    fn new() -> Self {
        let mut world = world();
        let rows = [&"#".repeat(20)[..], "#.../..............#", &"#".repeat(20)];
        let grid = TileGrid::parse(1.0, &rows).unwrap();
        world.add_tiles(grid.position(Vec2::new(-10.0, -2.0))).unwrap();
        for i in 0..12 {
            let place = Vec2::new((i % 4) as f32 - 2.0, 1.0 + (i / 4) as f32);
            let shape = [circle(0.4), rect(0.4, 0.3), capsule(0.2, 0.2)][i % 3];
            world.add_body(RigidBody::dynamic().position(place).shape(shape)).unwrap();
        }
        let lift = RigidBody::kinematic().position(Vec2::new(4.0, 1.0)).shape(rect(1.0, 0.1));
        let lift = world.add_body(lift.velocity(Vec2::new(0.0, 0.5))).unwrap();
        let sensor = ShapeDef { sensor: true, ..ShapeDef::new(rect(3.0, 1.0)) };
        let sensor = world.add_body(RigidBody::fixed().shape(sensor)).unwrap();
        let links = [0.0, 0.5, 1.0].map(|x| {
            let link = RigidBody::dynamic().position(Vec2::new(4.0 + x, 3.0)).shape(circle(0.2));
            world.add_body(link).unwrap()
        });
        for (a, b) in [(lift, links[0]), (links[0], links[1]), (links[1], links[2])] {
            world.add_joint(a, b, JointDef::distance(0.5)).unwrap();
        }
        let hero = CharacterMover::new(Vec2::new(-4.0, 1.0), 1.6, 0.3);
        let (bodies, frame) = ([lift, sensor].to_vec(), world.to_bytes());
        let mut session = Self {
            recorder: Recorder::new(world),
            bodies,
            shapes: Vec::new(),
            joints: Vec::new(),
            grids: Vec::new(),
            hero,
            frame,
        };
        session.learn();
        session
    }

    /// Keeps the handles that are valid now.
    fn learn(&mut self) {
        let world = self.recorder.world();
        self.bodies.extend(world.body_ids());
        self.shapes.extend(world.shape_ids());
        self.joints.extend(world.joint_ids());
        self.grids.extend(world.tile_grid_ids());
        fn sort<T: Ord>(list: &mut Vec<T>) {
            list.sort_unstable();
            list.dedup();
        }
        sort(&mut self.bodies);
        sort(&mut self.shapes);
        sort(&mut self.joints);
        sort(&mut self.grids);
    }

    /// Does what was drawn, and gives the name of the command if that was accepted.
    fn play(&mut self, draw: &Draw) -> Option<String> {
        let command = self.command(draw)?;
        let name = name(&command);
        let made = self.recorder.apply(command).ok()?;
        if let Made::Character(hero) = made {
            self.hero = hero;
        } else if made != Made::Nothing {
            self.learn();
        }
        Some(name)
    }

    fn command(&self, draw: &Draw) -> Option<Command> {
        let pick = |i: usize| self.bodies[draw.which[i] % self.bodies.len()];
        let [worlds, bodies, _] = KINDS;
        Some(if draw.kind < worlds {
            self.world_command(draw, pick(0), pick(1))?
        } else if draw.kind < worlds + bodies {
            Command::Body(pick(0), body_command(draw.kind - worlds, draw))
        } else {
            let shape = self.shapes[draw.which[0] % self.shapes.len()];
            Command::Shape(shape, shape_command(draw.kind - worlds - bodies, draw))
        })
    }

    fn world_command(&self, draw: &Draw, body: BodyId, other: BodyId) -> Option<Command> {
        let &Draw { kind, which, n, flag } = draw;
        let place = Vec2::new(n[0], n[1]);
        let joint = || Some(*self.joints.get(which[0] % self.joints.len().max(1))?);
        let grid = || Some(*self.grids.get(which[0] % self.grids.len().max(1))?);
        let filter = FilterData {
            filter: Filter { group: which[1] as i32 % 3, ..FilterData::default().filter },
            exclude_body: (which[1] % 4 == 0).then_some(body),
            sensors: flag,
        };
        Some(match kind {
            0..=2 => Command::AddBody(
                RigidBody::dynamic().position(place).angle(n[2]).shape(geometry(which[0], n[3])),
            ),
            3 => Command::RemoveBody(body),
            4 => Command::AddShape(body, ShapeDef::new(geometry(which[1], n[3])).offset(place)),
            5 => {
                let points = [Vec2::new(9.0, n[0]), Vec2::new(0.0, n[1]), Vec2::new(-9.0, n[2])];
                Command::AddChain(body, ChainDef::open(&points).friction(n[3]))
            }
            6 => {
                let corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 0.3), (0.0, 1.0)];
                let corners = corners.map(|(x, y)| Vec2::new(x, y) * n[0].abs()).to_vec();
                Command::AddOutline(body, corners, ShapeDef::new(geometry(0, n[1])))
            }
            7 => Command::RemoveShape(self.shapes[which[0] % self.shapes.len()]),
            8 => Command::AddJoint(body, other, JointDef::revolute().motor(n[0], n[1].abs())),
            9 => {
                Command::SetJoint(joint()?, JointDef::distance(n[0].abs()).spring(n[1].abs(), 0.5))
            }
            10 => Command::RemoveJoint(joint()?),
            11 => {
                let grid = TileGrid::parse(n[2].abs(), &["#-#", "[_]"]).ok()?;
                Command::AddTiles(grid.position(Vec2::new(n[0], 5.0)).friction(n[3].abs()))
            }
            12 => Command::SetTile(grid()?, which[1] as u32 % 20, 1, which[0] as u16 % 3),
            13 => Command::RemoveTiles(grid()?),
            14 => {
                let (center, radius, falloff) = (place.into(), n[2].abs(), n[3]);
                let blast = Explosion { center, radius, falloff, impulse_per_metre: 2.0 };
                Command::Explode(blast, filter)
            }
            15 => {
                let area = flag.then_some(Aabb { min: Vec2::ZERO, max: place.abs() });
                let (surface, flow) = (place.into(), Vec2::new(n[2], 0.0));
                Command::ApplyWater(Water { surface, flow, area, ..Water::default() }, filter, DT)
            }
            16 => {
                let (shape, pose) =
                    (geometry(which[0], n[2]), Pose::new(place.into(), Rot::IDENTITY));
                let force = zone_force(which[1], n);
                Command::ApplyZone(ForceZone { shape, pose, force, wakes: flag }, filter, DT)
            }
            17 | 18 => {
                let input = MoverInput { walk: n[0], jump: n[1], drop: flag };
                Command::MoveCharacter(self.hero.clone(), input, DT)
            }
            19 => Command::SetGravity(Vec2::new(n[0], -9.8)),
            20 => Command::SetSettings(Settings {
                substeps: 1 + which[0] as u32 % 4,
                push_speed: n[0],
                ..Settings::default()
            }),
            _ => Command::RestoreBytes(self.frame.clone()),
        })
    }
}

fn geometry(kind: usize, size: f32) -> Shape {
    let size = if size.abs() < 5.0 { 0.1 + 0.1 * size.abs() } else { size };
    let sides = 3 + kind % 5;
    match kind % 5 {
        0 => circle(size),
        1 => Polygon::rect(size, 0.4).map_or(circle(size), Shape::Polygon),
        2 => capsule(0.3, size),
        3 => Shape::Segment { a: Vec2::ZERO, b: Vec2::new(size, 1.0) },
        _ => Polygon::regular(sides, size).map_or(circle(size), Shape::Polygon),
    }
}

fn zone_force(kind: usize, n: [f32; 4]) -> ZoneForce {
    match kind % 4 {
        0 => ZoneForce::Acceleration(Vec2::new(n[0], n[3])),
        1 => ZoneForce::Attraction { center: DVec2::ZERO, acceleration: n[3] },
        2 => ZoneForce::Wind(Wind { velocity: Vec2::new(n[3], 1.0), ..Wind::default() }),
        _ => ZoneForce::Damping { linear: n[0].abs(), angular: n[3].abs() },
    }
}

fn body_command(kind: usize, draw: &Draw) -> BodyCommand {
    let &Draw { which, n, flag, .. } = draw;
    let (v, point) = (Vec2::new(n[0], n[1]), DVec2::new(n[2].into(), n[3].into()));
    match kind {
        0 => BodyCommand::SetPosition(point),
        1 => BodyCommand::SetAngle(n[0]),
        2 => BodyCommand::SetPose(Pose::new(point, Rot::from_angle(n[0]))),
        3 => BodyCommand::SetVelocity(v),
        4 => BodyCommand::SetAngularVelocity(n[0]),
        5 => BodyCommand::SetTarget(Pose::new(point, Rot::from_angle(n[0])), DT),
        6 => BodyCommand::ApplyForce(v * 100.0, point),
        7 => BodyCommand::ApplyForceToCenter(v * 100.0),
        8 => BodyCommand::ApplyTorque(n[0]),
        9 => BodyCommand::ApplyImpulse(v, point),
        10 => BodyCommand::ApplyImpulseToCenter(v),
        11 => BodyCommand::ApplyAngularImpulse(n[0]),
        12 => BodyCommand::ApplyWind(Wind { velocity: v, density: n[2], drag: n[3] }, DT),
        13 => BodyCommand::Wake,
        14 => BodyCommand::Sleep,
        15 => {
            let kinds = [BodyKind::Static, BodyKind::Kinematic, BodyKind::Dynamic];
            BodyCommand::SetKind(kinds[which[1] % 3])
        }
        16 => BodyCommand::SetEnabled(flag),
        17 => BodyCommand::SetLocks(Locks { x: flag, y: false, rotation: n[0] > 0.0 }),
        18 => BodyCommand::SetMass(flag.then_some(n[0])),
        19 => BodyCommand::SetGravityScale(n[0]),
        20 => BodyCommand::SetDamping(n[0], n[1]),
        21 => BodyCommand::SetCanSleep(flag),
        22 => BodyCommand::SetSleepSpeed(n[0]),
        23 => BodyCommand::SetBullet(flag),
        24 => BodyCommand::SetCenter(flag.then_some(v)),
        25 => BodyCommand::SetInertia(flag.then_some(n[0].abs())),
        _ => BodyCommand::SetUserData(which[1] as u64),
    }
}

fn shape_command(kind: usize, draw: &Draw) -> ShapeCommand {
    let &Draw { which, n, flag, .. } = draw;
    match kind {
        0 => ShapeCommand::SetShape(geometry(which[1], n[0])),
        1 => ShapeCommand::SetLocal(Vec2::new(0.2 * n[0], 0.2 * n[1]), n[2]),
        2 => {
            let [friction, restitution, tangent_speed, _] = n;
            ShapeCommand::SetMaterial(Material {
                friction,
                restitution,
                tangent_speed,
                ..Material::default()
            })
        }
        3 => ShapeCommand::SetFilter(Filter { mask: which[1] as u64, ..Filter::default() }),
        4 => ShapeCommand::SetSensor(flag),
        5 => ShapeCommand::SetOneWay(flag.then_some(Vec2::new(n[0], n[1]))),
        6 => ShapeCommand::SetEvents(flag, n[0] > 0.0),
        _ => ShapeCommand::SetUserData(which[1] as u64),
    }
}

/// `Enum::Variant`.
fn name(command: &Command) -> String {
    let (of, text) = match command {
        Command::Body(_, command) => ("BodyCommand", format!("{command:?}")),
        Command::Shape(_, command) => ("ShapeCommand", format!("{command:?}")),
        command => ("Command", format!("{command:?}")),
    };
    format!("{of}::{}", text.split('(').next().unwrap_or_default())
}

/// All handles, with the generations that no hash covers.
fn handles(world: &World) -> String {
    let bodies: Vec<_> = world.body_ids().collect();
    let shapes: Vec<_> = world.shape_ids().collect();
    let joints: Vec<_> = world.joint_ids().collect();
    let grids: Vec<_> = world.tile_grid_ids().collect();
    format!("{bodies:?} {shapes:?} {joints:?} {grids:?}")
}

/// Plays it from the start, then goes to and fro, and compares with what was recorded.
fn check(recording: &Recording, end: &World) -> Result<(), TestCaseError> {
    let bytes = recording.to_bytes();
    let read = Recording::from_bytes(&bytes);
    prop_assert!(read.is_ok(), "{:?}", read.err());
    let read = read.unwrap();
    prop_assert!(read.to_bytes() == bytes, "other bytes when written again");
    let mut other = World::new(Vec2::ZERO);
    other.set_simd(SimdLevel::Scalar).unwrap();
    for mut player in [Player::new(&read).unwrap(), Player::in_world(&read, other).unwrap()] {
        // Every step is compared with its hash.
        prop_assert_eq!(player.seek(usize::MAX), Ok(()));
        prop_assert_eq!(player.world().state_hash(), end.state_hash());
        prop_assert!(handles(player.world()) == handles(end), "other handles at the end");
        for part in [2, 4, 1, 3, 0, 2] {
            let step = read.len() * part / 4;
            prop_assert_eq!(player.seek(step), Ok(()));
            let hash = if step == 0 { None } else { Some(player.world().state_hash()) };
            prop_assert_eq!((player.at(), hash), (step, recording.hash(step)));
        }
    }
    Ok(())
}

#[test]
fn any_commands_are_played_again() {
    let config = ProptestConfig {
        cases: 60,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(3),
        ..ProptestConfig::default()
    };
    let steps = prop::collection::vec(prop::collection::vec(draw(), 0..8), 1..50);
    let seen = RefCell::new(BTreeSet::new());
    let played = TestRunner::new(config).run(&steps, |steps| {
        let mut session = Session::new();
        for (i, draws) in steps.iter().enumerate() {
            draws.iter().for_each(|draw| seen.borrow_mut().extend(session.play(draw)));
            session.recorder.step(DT);
            if i == 5 {
                session.frame = session.recorder.world().to_bytes();
            }
        }
        let (world, recording) = session.recorder.finish();
        prop_assert_eq!(world.validate(), Ok(()));
        check(&recording, &world)
    });
    played.unwrap_or_else(|error| panic!("{error}"));
    // And every kind of command was among them.
    let all = ENUMS.iter().flat_map(|(_, of)| variants(of).into_iter().map(move |v| (of, v)));
    let mut expected: BTreeSet<_> = all.map(|(of, kind)| format!("{of}::{kind}")).collect();
    // These two hold the others.
    assert!(expected.remove("Command::Body") && expected.remove("Command::Shape"));
    assert_eq!(*seen.borrow(), expected);
}

/// A recording of every kind of command, with the length of all before its steps.
fn busy_recording() -> (Vec<u8>, usize) {
    let mut session = Session::new();
    let start = session.recorder.recording().to_bytes().len();
    let mut random = Random::new(5);
    for kind in (0..KINDS.iter().sum()).chain(0..KINDS[0]) {
        for _ in 0..3 {
            let which = [0; 2].map(|_| random.below(1000) as usize);
            let n = [0.0; 4].map(|_| random.range(-3.0, 3.0));
            session.play(&Draw { kind, which, n, flag: which[0] % 2 == 0 });
        }
        if kind % 8 == 0 {
            session.recorder.step(DT);
        }
    }
    session.recorder.step(DT);
    (session.recorder.recording().to_bytes(), start)
}

#[test]
fn recordings_that_end_too_early_or_late_are_refused() {
    let (bytes, start) = busy_recording();
    Recording::from_bytes(&bytes).unwrap();
    let lengths = (0..start).step_by(501).chain((start..bytes.len()).step_by(7));
    for length in lengths.chain([bytes.len() - 1]) {
        assert!(Recording::from_bytes(&bytes[..length]).is_err(), "{length}");
    }
    assert!(Recording::from_bytes(&[&bytes[..], &[0]].concat()).is_err());
}

/// Whatever is changed in a recording: it is refused, stops with an error, or plays; it does not panic.
#[test]
fn damaged_recordings_do_no_harm() {
    let (bytes, start) = busy_recording();
    let mut random = Random::new(9);
    let (mut refused, mut stopped, rounds) = (0, 0, 1500);
    for round in 0..rounds {
        let mut bad = bytes.clone();
        for _ in 0..=random.below(2) {
            // Mostly where the commands are.
            let from = if round % 10 == 0 { 0 } else { start };
            let at = from + random.below((bad.len() - from) as u64) as usize;
            bad[at] = match random.below(4) {
                0 => 0,
                1 => 255,
                2 => bad[at] ^ 1 << random.below(8),
                _ => random.below(256) as u8,
            };
        }
        let Ok(recording) = Recording::from_bytes(&bad) else {
            refused += 1;
            continue;
        };
        let mut player = Player::new(&recording).unwrap();
        stopped += usize::from(player.seek(usize::MAX).is_err());
        assert_eq!(player.world().validate(), Ok(()), "round {round}");
    }
    assert!(refused > rounds / 50 && stopped > rounds / 20, "{refused} refused, {stopped} stopped");
}
