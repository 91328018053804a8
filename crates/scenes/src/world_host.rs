//! Plays scenes on the engine's own world.

use crate::host::Host;
use crate::player::Player;
use crate::scene::Scene;
use crate::script::{Deed, lead_progress};
use tiny_physics::record::{BodyCommand, Command, History, Made, Recorder, ShapeCommand};
use tiny_physics::{
    Aabb, Body, BodyId, CharacterMover, DVec2, Error, JointDef, JointId, MoverInput, QueryFilter,
    RigidBody, Rot, Settings, Shape, ShapeId, Transform, Vec2, Wind, World,
};

/// A scene that runs in a [`World`].
///
/// ```
/// use tiny_physics_scenes::{Options, Run, find};
/// let scene = find("stack")?.build(Options::default());
/// let mut run = Run::start(&scene)?;
/// run.step();
/// assert_eq!(run.world().body_count(), scene.bodies.len());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub type Run = Player<WorldHost>;

impl Run {
    /// Makes a world of a scene.
    ///
    /// # Errors
    /// A body or joint that the world refuses.
    pub fn start(scene: &Scene) -> Result<Self, Error> {
        let run = Self::new(scene, WorldHost::new(scene.gravity, scene.settings));
        match run.host().error() {
            Some(error) => Err(error.clone()),
            None => Ok(run),
        }
    }

    /// The world.
    pub fn world(&self) -> &World {
        self.host().world()
    }

    /// The world, to act on.
    pub fn world_mut(&mut self) -> &mut World {
        self.host_mut().world_mut()
    }
}

/// A scene's script without the world that it acts on.
///
/// ```
/// use tiny_physics_scenes::{Options, PausedScript, Run, find};
/// let scene = find("rain")?.build(Options::default());
/// let (mut script, mut world) = PausedScript::start(&scene)?;
/// let mut run = Run::start(&scene)?;
/// for _ in 0..30 {
///     script.before_step(&mut world);
///     world.step(scene.dt);
///     run.step();
/// }
/// assert_eq!(world.state_hash(), run.world().state_hash());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct PausedScript(Option<Player<CommandHost<()>>>);

impl PausedScript {
    /// The world of a scene, and its script.
    ///
    /// # Errors
    /// A body or joint that the world refuses.
    pub fn start(scene: &Scene) -> Result<(Self, World), Error> {
        let run = Run::start(scene)?;
        let mut world = World::new(scene.gravity);
        let mut script = run.map(|host| host.onto((), |target| world = target));
        // What comes now comes from the script, which forgets the numbers of what it removes.
        let host = script.host_mut();
        host.bodies.lasting = host.bodies.ids.len();
        host.joints.lasting = host.joints.ids.len();
        Ok((Self(Some(script)), world))
    }

    /// Lets the script act on the world, or on what passes commands on to it, before a step.
    pub fn before_step<T: Commanded>(&mut self, target: T) {
        if let Some(script) = self.0.take() {
            let mut script = script.map(|host| host.onto(target, |()| {}));
            script.before_step();
            self.0 = Some(script.map(|host| host.onto((), drop)));
        }
    }

    /// The world's handle of a body of the scene.
    pub fn body_id(&self, body: usize) -> Option<BodyId> {
        let script = self.0.as_ref()?;
        script.host().bodies.get(*script.bodies().get(body)?)
    }

    /// The first thing that the world refused.
    pub fn error(&self) -> Option<&Error> {
        self.0.as_ref()?.host().error.as_ref()
    }
}

/// What commands are sent to: a [`World`] does them, a [`Recorder`] notes them as well.
pub trait Commanded {
    /// The world, to read.
    fn world(&self) -> &World;
    /// Does something to it.
    ///
    /// # Errors
    /// As [`Command::apply`].
    fn apply(&mut self, command: Command) -> Result<Made, Error>;
    /// Moves it on by `dt` seconds.
    fn step(&mut self, dt: f32);
}

impl Commanded for World {
    fn world(&self) -> &World {
        self
    }
    fn apply(&mut self, command: Command) -> Result<Made, Error> {
        command.apply(self)
    }
    fn step(&mut self, dt: f32) {
        self.step(dt);
    }
}

impl Commanded for History {
    fn world(&self) -> &World {
        self.world()
    }
    fn apply(&mut self, command: Command) -> Result<Made, Error> {
        self.apply(command)
    }
    fn step(&mut self, dt: f32) {
        self.step(dt);
    }
}

impl<T: Commanded> Commanded for &mut T {
    fn world(&self) -> &World {
        (**self).world()
    }
    fn apply(&mut self, command: Command) -> Result<Made, Error> {
        (**self).apply(command)
    }
    fn step(&mut self, dt: f32) {
        (**self).step(dt);
    }
}

impl Commanded for Recorder {
    fn world(&self) -> &World {
        self.world()
    }
    fn apply(&mut self, command: Command) -> Result<Made, Error> {
        self.apply(command)
    }
    fn step(&mut self, dt: f32) {
        self.step(dt);
    }
}

/// Plays scenes in a world that is not recorded.
pub type WorldHost = CommandHost<World>;

/// Plays scenes in a world, with numbers for its bodies and joints in the order in which they were added. All that
/// it does are commands, so what is recorded is what happens without recording.
#[derive(Clone, Debug)]
pub struct CommandHost<T> {
    target: T,
    bodies: Numbers<BodyId>,
    joints: Numbers<JointId>,
    error: Option<Error>,
}

/// Handles by number.
#[derive(Clone, Debug)]
struct Numbers<I> {
    ids: Vec<Option<I>>,
    /// Places of what is gone, to be used again, so that a script that adds and removes for ever stays small.
    free: Vec<usize>,
    /// Places below are never used again: a timeline may speak of bodies of its scene that are gone.
    lasting: usize,
}

impl<I: Copy> Numbers<I> {
    /// Without any; no place is used again so far.
    fn new() -> Self {
        Self { ids: Vec::new(), free: Vec::new(), lasting: usize::MAX }
    }

    fn get(&self, number: usize) -> Option<I> {
        self.ids.get(number).copied().flatten()
    }

    fn add(&mut self, id: Option<I>) -> usize {
        if let Some(number) = self.free.pop() {
            self.ids[number] = id;
            return number;
        }
        self.ids.push(id);
        self.ids.len() - 1
    }

    fn remove(&mut self, number: usize) {
        if self.ids.get_mut(number).and_then(Option::take).is_some() && number >= self.lasting {
            self.free.push(number);
        }
    }
}

impl WorldHost {
    /// An empty world.
    pub fn new(gravity: Vec2, settings: Settings) -> Self {
        Self::on(World::with_settings(gravity, settings))
    }

    /// The world, to act on.
    pub fn world_mut(&mut self) -> &mut World {
        &mut self.target
    }

    /// The world, for good.
    pub fn into_world(self) -> World {
        self.target
    }
}

impl CommandHost<Recorder> {
    /// Records what is played in an empty world.
    pub fn recording(gravity: Vec2, settings: Settings) -> Self {
        Self::on(Recorder::new(World::with_settings(gravity, settings)))
    }

    /// What records.
    pub fn recorder(&self) -> &Recorder {
        &self.target
    }
}

impl<T> CommandHost<T> {
    /// The same numbers for another target; the old one goes to `leave`.
    fn onto<U>(self, target: U, leave: impl FnOnce(T)) -> CommandHost<U> {
        let Self { target: old, bodies, joints, error } = self;
        leave(old);
        CommandHost { target, bodies, joints, error }
    }
}

impl<T: Commanded> CommandHost<T> {
    /// Sends commands to something in whose world nothing is yet.
    pub fn on(target: T) -> Self {
        Self { target, bodies: Numbers::new(), joints: Numbers::new(), error: None }
    }

    /// The world.
    pub fn world(&self) -> &World {
        self.target.world()
    }

    /// The world's handle of a body.
    pub fn body_id(&self, body: usize) -> Option<BodyId> {
        self.bodies.get(body)
    }

    /// The world's handle of a joint.
    pub fn joint_id(&self, joint: usize) -> Option<JointId> {
        self.joints.get(joint)
    }

    /// The first thing that the world refused.
    pub fn error(&self) -> Option<&Error> {
        self.error.as_ref()
    }

    fn body(&self, body: usize) -> Option<Body<'_>> {
        self.body_id(body).and_then(|id| self.world().body(id))
    }

    /// Does it, and keeps the first error.
    fn apply(&mut self, command: Command) -> Made {
        self.target.apply(command).unwrap_or_else(|error| {
            self.error.get_or_insert(error);
            Made::Nothing
        })
    }

    /// Does it to a body; nothing where that has been removed.
    fn tell(&mut self, body: usize, command: BodyCommand) {
        if let Some(id) = self.body(body).map(|body| body.id()) {
            self.apply(Command::Body(id, command));
        }
    }

    /// Does what is done to a body; nothing where it has been removed.
    fn act_on_body(&mut self, deed: &Deed, time: f32, dt: f32) {
        match *deed {
            Deed::SetVelocity { body, velocity, angular_velocity } => {
                self.tell(body, BodyCommand::SetVelocity(velocity));
                self.tell(body, BodyCommand::SetAngularVelocity(angular_velocity));
            }
            Deed::SetKind { body, kind } => self.tell(body, BodyCommand::SetKind(kind)),
            Deed::SetShape { body, shape } => {
                if let Some(first) = self.shapes_of(body).first() {
                    self.apply(Command::Shape(*first, ShapeCommand::SetShape(shape)));
                }
            }
            Deed::SetMaterial { body, material } => {
                for id in self.shapes_of(body) {
                    self.apply(Command::Shape(id, ShapeCommand::SetMaterial(material)));
                }
            }
            Deed::Lead { body, from, to, turn, period } => {
                let done = lead_progress(time + dt, period);
                let target = Transform::from_angle(from + (to - from) * done, turn * done);
                self.tell(body, BodyCommand::SetTarget(target.into(), dt));
            }
            Deed::Wind { body, velocity } => {
                let wind = Wind { velocity, ..Wind::default() };
                self.tell(body, BodyCommand::ApplyWind(wind, dt));
            }
            _ => {}
        }
    }

    /// The shapes of a body in the order in which it was described.
    fn shapes_of(&self, body: usize) -> Vec<ShapeId> {
        self.body(body).map_or(Vec::new(), |body| body.shapes().collect())
    }
}

impl<T: Commanded> Host for CommandHost<T> {
    fn add_body(&mut self, body: &RigidBody) -> usize {
        let made = self.apply(Command::AddBody(body.clone()));
        self.bodies.add(if let Made::Body(id) = made { Some(id) } else { None })
    }

    fn remove_body(&mut self, body: usize) {
        if let Some(id) = self.body_id(body) {
            self.apply(Command::RemoveBody(id));
            self.bodies.remove(body);
        }
    }

    fn add_joint(&mut self, a: usize, b: usize, def: &JointDef) -> usize {
        let made = match (self.body_id(a), self.body_id(b)) {
            (Some(a), Some(b)) => self.apply(Command::AddJoint(a, b, *def)),
            _ => Made::Nothing,
        };
        self.joints.add(if let Made::Joint(id) = made { Some(id) } else { None })
    }

    fn remove_joint(&mut self, joint: usize) {
        if let Some(id) = self.joint_id(joint) {
            self.apply(Command::RemoveJoint(id));
            self.joints.remove(joint);
        }
    }

    fn position(&self, body: usize) -> DVec2 {
        self.body(body).map_or(DVec2::ZERO, |body| body.position_f64())
    }

    fn velocity(&self, body: usize) -> Vec2 {
        self.body(body).map_or(Vec2::ZERO, |body| body.velocity())
    }

    fn set_velocity(&mut self, body: usize, velocity: Vec2) {
        self.tell(body, BodyCommand::SetVelocity(velocity));
    }

    fn set_angular_velocity(&mut self, body: usize, radians_per_second: f32) {
        let now = self.body(body).map(|body| body.angular_velocity());
        if now.is_some_and(|now| now != radians_per_second) {
            self.tell(body, BodyCommand::SetAngularVelocity(radians_per_second));
        }
    }

    fn apply_force(&mut self, body: usize, newtons: Vec2) {
        self.tell(body, BodyCommand::ApplyForceToCenter(newtons));
    }

    fn move_character(&mut self, mover: &mut CharacterMover, input: MoverInput, dt: f32) {
        let command = Command::MoveCharacter(mover.clone(), input, dt);
        if let Made::Character(moved) = self.apply(command) {
            *mover = moved;
        }
    }

    fn is_awake(&self, body: usize) -> bool {
        self.body(body).is_some_and(|body| body.is_awake())
    }

    fn wake(&mut self, body: usize) {
        self.tell(body, BodyCommand::Wake);
    }

    fn step(&mut self, dt: f32) {
        self.target.step(dt);
    }

    fn ray_cast(&mut self, origin: Vec2, translation: Vec2, mask: u64) -> Option<f32> {
        let filter = QueryFilter::default().mask(mask);
        self.world().ray_cast(origin, translation, &filter).map(|hit| hit.fraction)
    }

    fn circle_cast(
        &mut self,
        center: Vec2,
        radius: f32,
        translation: Vec2,
        mask: u64,
    ) -> Option<f32> {
        let (shape, filter) = (Shape::Circle { radius }, QueryFilter::default().mask(mask));
        let pose = Transform::new(center, Rot::IDENTITY);
        self.world().cast_shape(&shape, pose, translation, &filter).map(|hit| hit.fraction)
    }

    fn count_overlaps(&mut self, lower: Vec2, upper: Vec2, mask: u64) -> usize {
        let filter = QueryFilter::default().mask(mask);
        self.world().overlap_aabb(Aabb { min: lower, max: upper }, &filter).len()
    }

    fn act(&mut self, deed: &Deed, time: f32, dt: f32) {
        match deed.on_place(dt) {
            Some(command) => drop(self.apply(command)),
            None => self.act_on_body(deed, time, dt),
        }
    }

    fn is_entered(&mut self, body: usize) -> bool {
        let Some(body) = self.body(body) else {
            return false;
        };
        body.shapes().any(|shape| self.world().sensor_overlaps(shape).next().is_some())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::script::{Rain, Script};
    use crate::{Options, find};

    #[test]
    fn a_script_that_adds_and_removes_stays_as_small_as_its_world() {
        let mut scene = find("rain").unwrap().build(Options::default());
        scene.script =
            Some(Script::Rain(Rain { rows: 1, columns: 2, group: 1, ..Rain::default() }));
        let (mut script, mut world) = PausedScript::start(&scene).unwrap();
        let mut most = 0;
        for _ in 0..2000 {
            script.before_step(&mut world);
            world.step(scene.dt);
            most = most.max(world.body_count());
        }
        let host = script.0.as_ref().unwrap().host();
        let (bodies, joints) = (host.bodies.ids.len(), host.joints.ids.len());
        assert!(bodies <= most && joints <= 2 * most, "{bodies}, {joints} of {most}");
    }

    #[test]
    fn numbers_of_the_scene_itself_are_not_used_again() {
        let mut numbers = Numbers::new();
        let [a, b] = [10, 11].map(|id| numbers.add(Some(id)));
        numbers.lasting = 2;
        let c = numbers.add(Some(12));
        [a, c, c].into_iter().for_each(|number| numbers.remove(number));
        assert_eq!([13, 14].map(|id| numbers.add(Some(id))), [c, 3]);
        assert_eq!([a, b, c].map(|number| numbers.get(number)), [None, Some(11), Some(13)]);
    }
}
