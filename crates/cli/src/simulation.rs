//! A scene that runs on the engine, as the commands need it.

use crate::args::WorldArgs;
use crate::failure::Outcome;
use core::fmt;
use std::time::{Duration, Instant};
use tiny_physics::record::Command;
use tiny_physics::{Aabb, BodyKind, DVec2, Pose, Rot, Transform, Vec2, World};
use tiny_physics_doctor::Doctor;
use tiny_physics_draw::Water;
use tiny_physics_scenes::{Deed, Grip, PausedScript, Run, Scene, Script, Tape};

/// A scene, its world, and a body that the mouse may hold.
pub struct Simulation {
    scene: Scene,
    how: WorldArgs,
    run: Course,
    held: Option<Grip>,
    doctor: Option<Box<Doctor>>,
}

/// How the scene runs.
enum Course {
    /// On and on.
    Once(Box<Run>),
    /// So that one can go back.
    Kept(Box<Tape>),
}

impl Course {
    fn world(&self) -> &World {
        match self {
            Self::Once(run) => run.world(),
            Self::Kept(tape) => tape.world(),
        }
    }

    fn dt(&self) -> f32 {
        match self {
            Self::Once(run) => run.dt(),
            Self::Kept(tape) => tape.dt(),
        }
    }

    /// Nothing happens where the world refuses it.
    fn apply(&mut self, command: Command) {
        let _ = match self {
            Self::Once(run) => command.apply(run.world_mut()),
            Self::Kept(tape) => tape.apply(command),
        };
    }
}

/// The numbers of a status line.
#[derive(Clone, Copy, Debug)]
pub struct Status {
    /// Steps made.
    pub frame: u64,
    /// Contacts that touch.
    pub contacts: usize,
    /// Deepest penetration, metres.
    pub deepest: f32,
    /// Moving bodies that are awake.
    pub awake: usize,
    /// Bodies that can move.
    pub moving: usize,
}

/// The part of the world that a picture should show.
#[derive(Clone, Copy, Debug)]
pub struct Framing {
    /// Lower left corner.
    pub min: DVec2,
    /// Upper right corner.
    pub max: DVec2,
    /// Is there more ground outside, on which bodies may leave the picture?
    pub goes_on: bool,
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { frame, contacts, deepest, awake, moving } = self;
        let millimetres = deepest * 1000.0;
        write!(
            f,
            "frame {frame}   contacts {contacts}   deepest {millimetres:.1} mm   awake {awake} of {moving}"
        )
    }
}

/// Time for steps between two pictures.
const PICTURE_TIME: Duration = Duration::from_millis(25);
/// What a camera leaves free around what it is to show, as a part of that: a view that a scene says is met exactly.
const EDGE: f32 = 0.04;
/// Memory of a run that one can go back in, bytes.
const MEMORY: usize = 256 << 20;

impl Simulation {
    /// Sets the scene up.
    ///
    /// # Errors
    /// The scene holds something that the engine refuses, or the machine lacks the SIMD level.
    pub fn new(scene: Scene, how: &WorldArgs) -> Outcome<Self> {
        scene.check()?;
        let mut run = Run::start(&scene)?;
        Self::equip(run.world_mut(), how)?;
        Ok(Self {
            scene,
            how: how.clone(),
            run: Course::Once(Box::new(run)),
            held: None,
            doctor: None,
        })
    }

    /// The same, so that one can go back in the run.
    ///
    /// # Errors
    /// As [`Simulation::new`].
    pub fn kept(scene: Scene, how: &WorldArgs) -> Outcome<Self> {
        scene.check()?;
        let (script, mut world) = PausedScript::start(&scene)?;
        Self::equip(&mut world, how)?;
        let script = scene.script.is_some().then_some(script);
        let tape = Tape::of_world(world, script, scene.dt, MEMORY);
        Ok(Self {
            scene,
            how: how.clone(),
            run: Course::Kept(Box::new(tape)),
            held: None,
            doctor: None,
        })
    }

    /// Gives a world the threads and the level that were asked for, and lets it time its stages.
    ///
    /// # Errors
    /// This machine has no such level.
    pub fn equip(world: &mut World, how: &WorldArgs) -> Outcome {
        world.set_threads(usize::from(how.threads));
        world.time_stages(true);
        if let Some(level) = how.simd {
            world.set_simd(level)?;
        }
        Ok(())
    }

    /// Lets the doctor watch each step from now on.
    pub fn watched(mut self) -> Self {
        self.doctor = Some(Box::default());
        self
    }

    /// The doctor, if there is one.
    pub fn doctor(&self) -> Option<&Doctor> {
        self.doctor.as_deref()
    }

    /// Back to the start.
    ///
    /// # Errors
    /// As [`Simulation::new`].
    pub fn restart(&mut self) -> Outcome {
        let begin = match self.run {
            Course::Once(_) => Self::new,
            Course::Kept(_) => Self::kept,
        };
        let again = begin(self.scene.clone(), &self.how)?;
        *self = if self.doctor.is_some() { again.watched() } else { again };
        Ok(())
    }

    /// Was all done that the script asked for?
    ///
    /// # Errors
    /// The first thing that the engine refused.
    pub fn all_done(&self) -> Outcome {
        let error = match &self.run {
            Course::Once(run) => run.host().error(),
            Course::Kept(tape) => tape.error(),
        };
        error.map_or(Ok(()), |error| Err(error.clone().into()))
    }

    /// One step of the scene; in the past the one that was, unless something is held.
    pub fn step(&mut self) {
        self.pull();
        match &mut self.run {
            Course::Once(run) => run.step(),
            Course::Kept(tape) => {
                let at = tape.history().at();
                if at == tape.history().len() || tape.go_to(at + 1).is_err() {
                    tape.step();
                }
            }
        }
        if let Some(doctor) = &mut self.doctor {
            doctor.watch(self.run.world());
        }
    }

    /// Steps to here, and steps that can be gone to.
    pub fn place(&self) -> (usize, usize) {
        match &self.run {
            Course::Once(run) => (run.steps_done() as usize, run.steps_done() as usize),
            Course::Kept(tape) => (tape.history().at(), tape.history().len()),
        }
    }

    /// Goes to a step of the run, at most to its end.
    ///
    /// # Errors
    /// The run does not repeat itself.
    pub fn go_to(&mut self, step: usize) -> Outcome {
        self.held = None;
        if let Course::Kept(tape) = &mut self.run {
            tape.go_to(step)?;
        }
        Ok(())
    }

    /// So many steps, fewer where they take longer than the time until the next picture: the scene
    /// then plays slowly instead of standing still.
    pub fn play(&mut self, steps: u32) {
        let start = Instant::now();
        for _ in 0..steps {
            self.step();
            if start.elapsed() > PICTURE_TIME {
                break;
            }
        }
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The world.
    pub fn world(&self) -> &World {
        self.run.world()
    }

    /// Length of a step, seconds.
    pub fn dt(&self) -> f32 {
        self.run.dt()
    }

    /// Numbers for a status line.
    pub fn status(&self) -> Status {
        let world = self.world();
        let bodies = world.body_ids().filter_map(|id| world.body(id));
        Status {
            frame: world.step_count(),
            contacts: world.contact_count(),
            // Adding nothing turns -0 into 0.
            deepest: world.max_penetration() + 0.0,
            awake: world.awake_body_count(),
            moving: bodies.filter(|body| body.kind() != BodyKind::Static).count(),
        }
    }

    /// The deepest overlap of all that touches, metres; that of sleeping bodies as it is a step after they were woken.
    pub fn overlap(&self) -> f32 {
        let mut world = self.world().clone();
        let ids: Vec<_> = world.body_ids().collect();
        for id in ids {
            if let Some(mut body) = world.body_mut(id) {
                body.wake();
            }
        }
        world.step(self.dt());
        // Adding nothing turns -0 into 0.
        world.max_penetration() + 0.0
    }

    /// What a picture should show at the start: what the scene says, or all bodies with room for large ones to turn, but of
    /// ground much larger than what moves only the part near it.
    pub fn framing(&self) -> Framing {
        if let Some((min, max)) = self.scene.view {
            let edge = (max - min) * EDGE;
            return Framing { min: (min + edge).into(), max: (max - edge).into(), goes_on: false };
        }
        if let Some(middle) = self.character() {
            let (min, max) = (middle + Vec2::new(-9.0, -3.5), middle + Vec2::new(9.0, 6.5));
            return Framing { min, max, goes_on: true };
        }
        let origin = self.some_position();
        let (mut moving, fixed) = self.extents(origin);
        let mut turning = Vec::new();
        self.each_shape(origin, |kind, frame, bounds| {
            if kind != BodyKind::Static {
                let reach = (bounds.min - frame.p).abs().max((bounds.max - frame.p).abs()).length();
                turning.push((frame.p, reach));
            }
        });
        let large = 0.3 * largest_side(&moving);
        for (center, reach) in turning.into_iter().filter(|(_, reach)| *reach > large) {
            moving = moving.union(&Aabb::from_center(center, Vec2::splat(reach)));
        }
        let bounds = part_of_interest(moving, fixed);
        let goes_on = !bounds.contains(&moving.union(&fixed)) && moving.is_valid();
        Framing { min: origin + bounds.min, max: origin + bounds.max, goes_on }
    }

    /// Boxes around what moves and what stands still, relative to a point.
    pub fn extents(&self, origin: DVec2) -> (Aabb, Aabb) {
        let (mut moving, mut fixed) = (Aabb::EMPTY, Aabb::EMPTY);
        self.each_shape(origin, |kind, _, bounds| {
            let all = if kind == BodyKind::Static { &mut fixed } else { &mut moving };
            *all = all.union(&bounds);
        });
        (moving, fixed)
    }

    /// Kind and frame of each shape's body, and the shape's box, relative to a point.
    pub fn each_shape(&self, origin: DVec2, mut see: impl FnMut(BodyKind, Transform, Aabb)) {
        let reference = Pose::new(origin, Rot::IDENTITY);
        for shape in self.world().shapes() {
            let Some(body) = self.world().body(shape.body()) else { continue };
            let frame = body.pose().relative_to(reference);
            see(body.kind(), frame, shape.shape().aabb(frame.compose(shape.local())));
        }
    }

    /// The water of the scene at the moment, which its world does not know.
    pub fn waters(&self) -> Vec<Water> {
        let step = u32::try_from(self.world().step_count()).unwrap_or(u32::MAX);
        let Some(Script::Timeline(timeline)) = &self.scene.script else { return Vec::new() };
        let now = timeline.acts.iter().filter(|act| act.when.is_before(step) == Some(true));
        let waters = now.filter_map(|act| match act.deed {
            Deed::Water { surface, between, .. } => Some(Water {
                surface: surface.into(),
                between: between.map(|(left, right)| (left.into(), right.into())),
            }),
            _ => None,
        });
        waters.collect()
    }

    /// Where the scene's character is, if it has one.
    pub fn character(&self) -> Option<DVec2> {
        let Some(Script::Character(character)) = &self.scene.script else { return None };
        let id = self.world().body_ids().nth(character.body)?;
        Some(self.world().body(id)?.center())
    }

    /// Where the scene's character is, or the point with as many moving bodies left as right of it, and above as below.
    pub fn middle_of_motion(&self) -> Option<DVec2> {
        if let Some(character) = self.character() {
            return Some(character);
        }
        let world = self.world();
        let bodies = world.body_ids().filter_map(|id| world.body(id));
        let moving = bodies.filter(|body| body.kind() != BodyKind::Static);
        let (mut xs, mut ys): (Vec<_>, Vec<_>) =
            moving.map(|body| (body.center().x, body.center().y)).unzip();
        xs.sort_by(f64::total_cmp);
        ys.sort_by(f64::total_cmp);
        Some(DVec2::new(*xs.get(xs.len() / 2)?, *ys.get(ys.len() / 2)?))
    }

    /// Where some body is: a point near all that matters.
    pub fn some_position(&self) -> DVec2 {
        let world = self.world();
        let first = world.body_ids().find_map(|id| world.body(id));
        first.map_or(DVec2::ZERO, |body| body.position_f64())
    }

    /// Takes the moving body at a point of the world, if there is one.
    pub fn grab(&mut self, point: DVec2) {
        self.held = Grip::take(self.world(), point);
    }

    /// Moves the point that the held body follows.
    pub fn drag(&mut self, point: DVec2) {
        if let Some(held) = &mut self.held {
            held.target = point;
        }
    }

    /// Lets go.
    pub fn release(&mut self) {
        self.held = None;
    }

    /// Where the held body is held and where it is to go.
    pub fn pull_line(&self) -> Option<(DVec2, DVec2)> {
        let held = self.held?;
        Some((held.point(self.world())?, held.target))
    }

    /// An impulse that brings the held point towards the pointer.
    fn pull(&mut self) {
        match self.held.and_then(|held| held.pull(self.world(), self.run.dt())) {
            Some(command) => self.run.apply(command),
            None => self.held = None,
        }
    }
}

/// Both boxes; where the fixed one is far larger, only its part near the moving one.
fn part_of_interest(moving: Aabb, fixed: Aabb) -> Aabb {
    /// Sizes of the moving box: how much larger all may be, and how far to look where it is larger.
    const LARGER: f32 = 4.0;
    const NEAR: f32 = 0.4;
    match (moving.is_valid(), fixed.is_valid()) {
        (true, true) => {
            let size = 1.0 + largest_side(&moving);
            let all = moving.union(&fixed);
            if largest_side(&all) <= LARGER * size {
                return all;
            }
            let near = moving.grown(NEAR * size);
            let cut = Aabb::new(fixed.min.max(near.min), fixed.max.min(near.max));
            if cut.is_valid() { moving.union(&cut) } else { moving }
        }
        (true, false) => moving,
        (false, true) => fixed,
        (false, false) => Aabb::new(Vec2::splat(-5.0), Vec2::splat(5.0)),
    }
}

pub fn largest_side(bounds: &Aabb) -> f32 {
    let size = bounds.max - bounds.min;
    size.x.max(size.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ground_without_end_does_not_hide_what_moves() {
        let moving = Aabb::new(Vec2::new(-5.0, 0.0), Vec2::new(5.0, 8.0));
        let near = Aabb::new(Vec2::new(-20.0, -2.0), Vec2::new(20.0, 0.0));
        assert_eq!(part_of_interest(moving, near), moving.union(&near));
        let endless = Aabb::new(Vec2::new(-1000.0, -2.0), Vec2::new(1000.0, 0.0));
        let shown = part_of_interest(moving, endless);
        assert!(shown.contains(&moving) && shown.min.y == -2.0 && largest_side(&shown) < 20.0);
        assert!(part_of_interest(Aabb::EMPTY, Aabb::EMPTY).is_valid());
    }
}
