//! The game: two players in a yard of crates, who run, jump and throw balls at each other's heap.

use tiny_physics::{BodyId, Error, JointDef, RigidBody, Shape, ShapeDef, Vec2, World};

/// What a player holds down: bits of `LEFT`, `RIGHT`, `JUMP` and `THROW`.
pub type Input = u8;

/// Runs to the left.
pub const LEFT: Input = 1;
/// Runs to the right.
pub const RIGHT: Input = 2;
/// Jumps, when standing.
pub const JUMP: Input = 4;
/// Throws a ball now and then.
pub const THROW: Input = 8;

/// Length of a frame, seconds.
const DT: f32 = 1.0 / 60.0;
/// Speed of a runner, metres a second.
const RUN: f32 = 5.0;
/// Speed of a jump, metres a second.
const LEAP: f32 = 6.0;
/// Frames between two throws of a player.
const PAUSE: u32 = 20;
/// Frames after which a ball is gone.
const LIFE: u32 = 150;

/// The game's whole state.
#[derive(Clone, Debug)]
pub struct Game {
    world: World,
    rest: Rest,
}

/// A saved state. The world is a plain value, so this is only a copy.
pub type Frame = Game;

/// What the game knows beside the world.
#[derive(Clone, Debug)]
struct Rest {
    frame: u32,
    players: [Player; crate::PLAYERS],
    balls: Vec<Ball>,
}

#[derive(Clone, Copy, Debug)]
struct Player {
    body: BodyId,
    /// The frame from which it may throw again.
    ready: u32,
}

#[derive(Clone, Copy, Debug)]
struct Ball {
    body: BodyId,
    /// The frame at which it goes.
    end: u32,
}

impl Game {
    /// The start of a game with this gravity, metres a second squared downwards.
    ///
    /// # Errors
    /// None that the numbers of this game meet.
    pub fn new(gravity: f32) -> Result<Self, Error> {
        let mut world = World::new(Vec2::new(0.0, -gravity));
        build_yard(&mut world)?;
        let mut player = |x: f32| -> Result<Player, Error> {
            let shape = Shape::capsule(Vec2::new(0.0, -0.4), Vec2::new(0.0, 0.4), 0.3)?;
            let body =
                RigidBody::dynamic().position(Vec2::new(x, 0.8)).lock_rotation().shape(shape);
            Ok(Player { body: world.add_body(body.can_sleep(false))?, ready: 0 })
        };
        let players = [player(-6.0)?, player(6.0)?];
        Ok(Self { world, rest: Rest { frame: 0, players, balls: Vec::new() } })
    }

    /// The world, to draw.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// One frame with what the players hold down.
    pub fn advance(&mut self, inputs: [Input; crate::PLAYERS]) {
        for (player, input) in inputs.into_iter().enumerate() {
            self.act(player, input);
        }
        let (frame, world) = (self.rest.frame, &mut self.world);
        self.rest.balls.retain(|ball| ball.end > frame || world.remove_body(ball.body).is_err());
        world.step(DT);
        self.rest.frame += 1;
    }

    fn act(&mut self, player: usize, input: Input) {
        let Player { body: id, ready } = self.rest.players[player];
        let Some(velocity) = self.world.body(id).map(|body| body.velocity()) else { return };
        let direction = f32::from(input & RIGHT != 0) - f32::from(input & LEFT != 0);
        let stands = velocity.y.abs() < 0.05;
        let up = if input & JUMP != 0 && stands { LEAP } else { velocity.y };
        if let Some(mut body) = self.world.body_mut(id) {
            body.set_velocity(Vec2::new(RUN * direction, up));
        }
        if input & THROW != 0 && self.rest.frame >= ready {
            self.throw(player, id);
        }
    }

    /// A fast small ball towards the other side.
    fn throw(&mut self, player: usize, from: BodyId) {
        let Some(place) = self.world.body(from).map(|body| body.position()) else { return };
        let side = if player == 0 { 1.0 } else { -1.0 };
        let shape = ShapeDef::new(Shape::Circle { radius: 0.15 }).restitution(0.4).density(4.0);
        let ball = RigidBody::dynamic()
            .position(place + Vec2::new(0.7 * side, 0.5))
            .velocity(Vec2::new(25.0 * side, 4.0))
            .bullet()
            .shape(shape);
        if let Ok(body) = self.world.add_body(ball) {
            self.rest.balls.push(Ball { body, end: self.rest.frame + LIFE });
            self.rest.players[player].ready = self.rest.frame + PAUSE;
        }
    }

    /// What two peers compare: all that the next frame depends on. Handles count by their index, because
    /// generations tell how often a world went back.
    pub fn checksum(&self) -> u128 {
        let Rest { frame, players, balls } = &self.rest;
        let players = players.iter().map(|player| (player.body.index(), player.ready));
        let balls = balls.iter().map(|ball| (ball.body.index(), ball.end));
        let rest = players.chain(balls).fold(u64::from(*frame), |hash, (index, frame)| {
            (hash.rotate_left(7) ^ (index as u64) << 32 ^ u64::from(frame))
                .wrapping_mul(0x9E37_79B9_7F4A_7C15)
        });
        u128::from(self.world.state_hash()) << 64 | u128::from(rest)
    }

    /// A copy of all of it: `ggrs` takes a frame whole, so an older one's memory cannot be used again.
    pub fn save(&self) -> Frame {
        self.clone()
    }

    /// Goes back to a frame in place, so that handles since then are refused.
    pub fn restore(&mut self, frame: &Frame) {
        self.world.clone_from(&frame.world);
        self.rest.clone_from(&frame.rest);
    }

    /// Balls in the air.
    pub fn ball_count(&self) -> usize {
        self.rest.balls.len()
    }
}

/// Floor, walls, two heaps of crates, a see-saw and a hanging chain.
fn build_yard(world: &mut World) -> Result<(), Error> {
    let wall = |x: f32, y: f32, w: f32, h: f32| -> Result<RigidBody, Error> {
        Ok(RigidBody::fixed().position(Vec2::new(x, y)).shape(Shape::rect(w, h)?))
    };
    let floor = world.add_body(wall(0.0, -1.0, 14.0, 1.0)?)?;
    for x in [-13.0, 13.0] {
        world.add_body(wall(x, 5.0, 1.0, 6.0)?)?;
    }
    for side in [-1.0, 1.0] {
        for i in 0..10_u8 {
            let (column, row) = (f32::from(i % 2), f32::from(i / 2));
            let place = Vec2::new(side * (8.0 + 0.9 * column), 0.4 + 0.8 * row);
            let shape = if i % 5 == 4 { Shape::circle(0.4)? } else { Shape::rect(0.4, 0.4)? };
            world.add_body(RigidBody::dynamic().position(place).shape(shape))?;
        }
    }
    let plank = RigidBody::dynamic().position(Vec2::new(0.0, 1.0)).shape(Shape::rect(2.0, 0.1)?);
    let plank = world.add_body(plank)?;
    let axle = JointDef::revolute().anchors(Vec2::new(0.0, 2.0), Vec2::ZERO).limits(-0.4, 0.4);
    world.add_joint(floor, plank, axle)?;
    let (mut above, mut anchor) = (floor, Vec2::new(0.0, 8.0));
    for i in 0..5_u8 {
        let place = Vec2::new(0.0, 6.7 - 0.6 * f32::from(i));
        let link = RigidBody::dynamic().position(place).shape(Shape::rect(0.1, 0.3)?);
        let link = world.add_body(link)?;
        let pin = JointDef::revolute().anchors(anchor, Vec2::new(0.0, 0.3));
        world.add_joint(above, link, pin)?;
        (above, anchor) = (link, Vec2::new(0.0, -0.3));
    }
    Ok(())
}

/// What a player holds down in a frame: chance, but the same in every run. Keys are held for a while, so that
/// predictions are sometimes right.
pub fn input_of(seed: u64, player: usize, frame: u32) -> Input {
    use rand_pcg::{Pcg32, rand_core::Rng};
    let span = 3 + 4 * player as u32;
    Pcg32::new(seed ^ u64::from(frame / span) << 8, player as u64).next_u32() as u8 & 15
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Frames that are played again have the same checksums, and other inputs make others.
    #[test]
    fn a_frame_brings_everything_back() {
        let mut game = Game::new(10.0).unwrap();
        let play = |game: &mut Game, seed: u64, frames: std::ops::Range<u32>| -> Vec<u128> {
            let step = |frame| {
                game.advance([0, 1].map(|player| input_of(seed, player, frame)));
                game.checksum()
            };
            frames.map(step).collect()
        };
        play(&mut game, 1, 0..200);
        let frame = game.save();
        let first = play(&mut game, 1, 200..400);
        assert!(game.ball_count() > 0 && game.world().validate().is_ok());
        game.restore(&frame);
        let other = play(&mut game, 2, 200..400);
        game.restore(&frame);
        assert_eq!(play(&mut game, 1, 200..400), first);
        assert_ne!(other, first);
    }

    #[test]
    fn players_move_and_inputs_vary() {
        let mut game = Game::new(10.0).unwrap();
        (0..30).for_each(|_| game.advance([RIGHT, LEFT]));
        let place = |game: &Game, player: usize| {
            game.world().body(game.rest.players[player].body).unwrap().position().x
        };
        assert!(place(&game, 0) > -4.5 && place(&game, 1) < 4.5);
        let inputs: std::collections::BTreeSet<_> = (0..400).map(|f| input_of(3, 0, f)).collect();
        assert_eq!(inputs.len(), 16);
    }
}
