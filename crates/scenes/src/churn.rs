//! A world in which nothing lasts: bodies, shapes and joints come and go, for endurance runs.

use crate::random::Random;
use tiny_physics::{
    BodyId, BodyKind, Error, JointDef, JointId, RigidBody, Shape, ShapeDef, ShapeId, Vec2, World,
};

/// A pit with at most [`Churn::MOST`] moving bodies. Before each step chance may add or remove a body, a shape or a
/// joint, push, change or put to sleep a body, rebuild the floor, or take the world through a saved frame.
/// The same seed gives the same run.
#[derive(Clone)]
pub struct Churn {
    world: World,
    frame: World,
    random: Random,
    counts: ChurnCounts,
}

/// What came and went so far.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub struct ChurnCounts {
    /// Bodies that were added.
    pub bodies: u64,
    /// Shapes that were added to bodies.
    pub shapes: u64,
    /// Joints that were added.
    pub joints: u64,
    /// Times that the world went back to a frame, or through bytes.
    pub frames: u64,
}

/// Length of a step, seconds.
const DT: f32 = 1.0 / 60.0;
/// Half the pit's width, metres.
const HALF_WIDTH: f32 = 8.0;
/// Joints at once, at most.
const MOST_JOINTS: usize = 20;
/// Shapes of a body, at most.
const MOST_SHAPES: usize = 3;

impl Churn {
    /// Moving bodies at once, at most.
    pub const MOST: usize = 40;

    /// A pit with nothing in it.
    ///
    /// # Errors
    /// None that its own numbers meet.
    pub fn new(seed: u64) -> Result<Self, Error> {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        for (x, y, w, h) in [(-9.0, 6.0, 1.0, 8.0), (9.0, 6.0, 1.0, 8.0), (0.0, -1.0, 8.0, 1.0)] {
            let wall = RigidBody::fixed().position(Vec2::new(x, y)).shape(Shape::rect(w, h)?);
            world.add_body(wall)?;
        }
        let (frame, random) = (world.clone(), Random::new(seed));
        Ok(Self { world, frame, random, counts: ChurnCounts::default() })
    }

    /// The world.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// The world, to choose threads and SIMD level.
    pub fn world_mut(&mut self) -> &mut World {
        &mut self.world
    }

    /// What came and went so far.
    pub fn counts(&self) -> ChurnCounts {
        self.counts
    }

    /// Perhaps a change, then a step.
    ///
    /// # Errors
    /// What the world refuses, though it should not; the bytes of a frame among it.
    pub fn step(&mut self) -> Result<(), Error> {
        // Quiet times let the pit fall asleep.
        let quiet = self.world.step_count() / 512 % 4 == 3;
        if self.random.below(if quiet { 400 } else { 4 }) == 0 {
            self.change()?;
        }
        self.world.step(DT);
        Ok(())
    }

    fn change(&mut self) -> Result<(), Error> {
        match self.random.below(20) {
            0..=5 => self.add_body(),
            6..=8 => self.remove_body(),
            9 | 10 => self.add_shape(),
            11 => self.remove_shape(),
            12..=14 => self.add_joint(),
            15 => self.remove_joint(),
            16 => self.rebuild_floor(),
            17 => self.pass_through_frames(),
            _ => {
                self.disturb();
                Ok(())
            }
        }
    }

    /// One of the moving bodies.
    fn pick(&mut self) -> Option<BodyId> {
        let moves =
            |id: &BodyId| self.world.body(*id).is_some_and(|body| body.kind() != BodyKind::Static);
        let ids: Vec<BodyId> = self.world.body_ids().filter(moves).collect();
        self.one_of(&ids)
    }

    fn one_of<T: Copy>(&mut self, items: &[T]) -> Option<T> {
        let count = u32::try_from(items.len()).ok().filter(|&count| count > 0)?;
        items.get(self.random.below(count) as usize).copied()
    }

    fn point(&mut self, half: f32, low: f32, high: f32) -> Vec2 {
        let x = self.random.range(-half, half);
        Vec2::new(x, self.random.range(low, high))
    }

    fn shape(&mut self) -> Result<ShapeDef, Error> {
        let (a, b) = (self.random.range(0.15, 0.5), self.random.range(0.15, 0.5));
        let shape = match self.random.below(6) {
            0 => Shape::circle(a)?,
            1 => Shape::capsule(Vec2::new(-a, 0.0), Vec2::new(a, 0.0), 0.5 * b)?,
            2 => Shape::regular(3 + self.random.below(5) as usize, a)?,
            3 => Shape::Aabb { half_extents: Vec2::new(a, b) },
            _ => Shape::rect(a, b)?,
        };
        let mut def = ShapeDef::new(shape).friction(self.random.range(0.0, 1.0));
        def.material.restitution = self.random.range(0.0, 0.6);
        def.sensor = self.random.below(12) == 0;
        Ok(if self.random.coin() { def.events() } else { def })
    }

    fn add_body(&mut self) -> Result<(), Error> {
        if self.world.body_count() >= 3 + Self::MOST {
            return self.remove_body();
        }
        let (place, velocity) =
            (self.point(HALF_WIDTH - 1.0, 2.0, 12.0), self.point(5.0, -5.0, 5.0));
        let mut body = RigidBody::dynamic().position(place).velocity(velocity).shape(self.shape()?);
        body.angle = self.random.range(-3.0, 3.0);
        body.bullet = self.random.below(8) == 0;
        self.counts.bodies += 1;
        self.world.add_body(body).map(drop)
    }

    fn remove_body(&mut self) -> Result<(), Error> {
        self.pick().map_or(Ok(()), |id| self.world.remove_body(id))
    }

    fn add_shape(&mut self) -> Result<(), Error> {
        let Some(id) = self.pick() else { return Ok(()) };
        if self.world.body(id).map_or(0, |body| body.shapes().count()) >= MOST_SHAPES {
            return Ok(());
        }
        let offset = self.point(0.4, -0.4, 0.4);
        let shape = self.shape()?.offset(offset);
        self.counts.shapes += 1;
        self.world.add_shape(id, shape).map(drop)
    }

    fn remove_shape(&mut self) -> Result<(), Error> {
        let Some(id) = self.pick() else { return Ok(()) };
        let body = self.world.body(id);
        let shapes: Vec<ShapeId> = body.map_or_else(Vec::new, |body| body.shapes().collect());
        if shapes.len() < 2 {
            return Ok(());
        }
        self.one_of(&shapes).map_or(Ok(()), |shape| self.world.remove_shape(shape))
    }

    fn add_joint(&mut self) -> Result<(), Error> {
        let (Some(a), Some(b)) = (self.pick(), self.pick()) else { return Ok(()) };
        if a == b || self.world.joint_count() >= MOST_JOINTS {
            return self.remove_joint();
        }
        let length = self.random.range(0.5, 3.0);
        let def = match self.random.below(6) {
            0 => JointDef::revolute(),
            1 => JointDef::distance(length).spring(2.0, 0.3),
            2 => JointDef::rope(length),
            3 => JointDef::weld().spring(4.0, 0.7),
            4 => JointDef::prismatic(Vec2::X).limits(-1.0, 1.0),
            _ => JointDef::wheel(Vec2::Y).break_at(500.0, 500.0),
        };
        self.counts.joints += 1;
        self.world.add_joint(a, b, def).map(drop)
    }

    fn remove_joint(&mut self) -> Result<(), Error> {
        let joints: Vec<JointId> = self.world.joint_ids().collect();
        self.one_of(&joints).map_or(Ok(()), |joint| self.world.remove_joint(joint))
    }

    /// Takes one of the static bodies away and puts another like it in its place.
    fn rebuild_floor(&mut self) -> Result<(), Error> {
        let is_static =
            |id: &BodyId| self.world.body(*id).is_some_and(|body| body.kind() == BodyKind::Static);
        let ids: Vec<BodyId> = self.world.body_ids().filter(is_static).collect();
        let Some(id) = self.one_of(&ids) else { return Ok(()) };
        let Some(place) = self.world.body(id).map(|body| body.position_f64()) else {
            return Ok(());
        };
        let shape = if place.x == 0.0 { Shape::rect(8.0, 1.0)? } else { Shape::rect(1.0, 8.0)? };
        self.world.remove_body(id)?;
        self.world.add_body(RigidBody::fixed().position(place).shape(shape)).map(drop)
    }

    /// Into a frame and back, or through bytes: the world must be the same after it.
    fn pass_through_frames(&mut self) -> Result<(), Error> {
        self.counts.frames += 1;
        if self.random.coin() {
            self.frame.clone_from(&self.world);
            (0..8).for_each(|_| self.world.step(DT));
            self.world.clone_from(&self.frame);
            return Ok(());
        }
        let bytes = self.world.to_bytes();
        self.world.restore_bytes(&bytes)
    }

    fn disturb(&mut self) {
        let (what, push) = (self.random.below(6), self.point(6.0, -2.0, 8.0));
        let place = self.point(HALF_WIDTH - 1.0, 2.0, 12.0);
        let Some(mut body) = self.pick().and_then(|id| self.world.body_mut(id)) else { return };
        match what {
            0 => body.set_position(place),
            1 => body.sleep(),
            2 => body.set_kind(BodyKind::Kinematic),
            3 => body.set_kind(BodyKind::Dynamic),
            _ => body.set_velocity(push),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A short endurance run: sound after every step, the same in two runs, and everything happens.
    #[test]
    fn churn_is_sound_and_repeatable() {
        let (mut a, mut b) = (Churn::new(3).unwrap(), Churn::new(3).unwrap());
        let mut fullest = 0;
        for step in 0..6000 {
            a.step().unwrap();
            b.step().unwrap();
            if step % 4 == 0 {
                a.world().validate().unwrap();
            }
            fullest = fullest.max(a.world().body_count());
        }
        assert_eq!(a.world().state_hash(), b.world().state_hash());
        let ChurnCounts { bodies, shapes, joints, frames } = a.counts();
        assert!(bodies > 100 && shapes > 50 && joints > 50 && frames > 20, "{:?}", a.counts());
        assert!(fullest > 20 && fullest <= 3 + Churn::MOST, "{fullest}");
        let mut other = Churn::new(4).unwrap();
        (0..500).for_each(|_| other.step().unwrap());
        assert_ne!(other.world().state_hash(), a.world().state_hash());
    }
}
