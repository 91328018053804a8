//! The game as a value: what there is, and what happens in a step.

use crate::barrel::{Barrel, Flash};
use crate::level::{self, Thing};
use crate::moving::{Door, Lift};
use crate::pieces::{DT, MOVING, solid};
use crate::sounds::{self, Sound};
use serde::{Deserialize, Serialize};
use tiny_physics::prelude::*;

/// Height and radius of the hero, metres.
pub const HERO: (f32, f32) = (1.5, 0.35);
const WALK: f32 = 5.0;
const JUMP: f32 = 10.0;

/// What the player asks for.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Input {
    /// -1 left, 1 right.
    pub walk: f32,
    /// Jump, or fall through what one stands on.
    pub jump: bool,
    /// Down through a platform.
    pub drop: bool,
    /// Light the barrel that is near.
    pub light: bool,
}

/// Everything, so that to save the game is to write this down.
#[derive(Debug, Serialize, Deserialize)]
pub struct Game {
    /// Bodies and what they do.
    pub world: World,
    /// Who is played.
    pub hero: CharacterMover,
    /// Which way the hero looks, -1 or 1.
    pub facing: f32,
    /// Coins that are still there: sensors.
    pub coins: Vec<BodyId>,
    /// How many there were.
    pub coins_in_all: usize,
    /// Crates and bricks.
    pub crates: Vec<BodyId>,
    /// Lifts.
    pub lifts: Vec<Lift>,
    /// Barrels of powder.
    pub barrels: Vec<Barrel>,
    /// Light of explosions, for the eye.
    pub flashes: Vec<Flash>,
    /// Doors.
    pub doors: Vec<Door>,
    /// Ends the game where the hero meets one.
    pub flags: Vec<BodyId>,
    /// Was a flag met?
    pub won: bool,
    /// Steps since the start.
    pub steps: u32,
}

impl Game {
    /// A new game.
    ///
    /// # Errors
    /// The level makes no sense.
    pub fn new() -> Result<Self, Error> {
        let mut world = World::new((0.0, -20.0));
        world.add_tiles(level::ground()?)?;
        let mut game = Self {
            world,
            hero: CharacterMover::new((0.0, 0.0), HERO.0, HERO.1),
            facing: 1.0,
            coins: Vec::new(),
            coins_in_all: 0,
            crates: Vec::new(),
            lifts: Vec::new(),
            barrels: Vec::new(),
            flashes: Vec::new(),
            doors: Vec::new(),
            flags: Vec::new(),
            won: false,
            steps: 0,
        };
        game.hero.filter.category = MOVING;
        for (thing, place) in level::things() {
            game.add(thing, place)?;
        }
        game.coins_in_all = game.coins.len();
        game.hero.body = Some(game.world.add_body(game.hero.describe_body())?);
        Ok(game)
    }

    fn add(&mut self, thing: Thing, place: DVec2) -> Result<(), Error> {
        let world = &mut self.world;
        match thing {
            Thing::Hero => self.hero.position = place + DVec2::new(0.0, 0.4),
            Thing::Coin => self.coins.push(world.add_body(sensor(place, Shape::circle(0.3)?))?),
            Thing::Flag => self.flags.push(world.add_body(sensor(place, Shape::rect(0.3, 1.0)?))?),
            Thing::Crate => {
                self.crates.push(world.add_body(solid(place, Shape::rect(0.45, 0.45)?, 15.0))?)
            }
            Thing::Brick => {
                self.crates.push(world.add_body(solid(place, Shape::rect(0.42, 0.42)?, 60.0))?)
            }
            Thing::Lift => self.lifts.push(Lift::add(world, place)?),
            Thing::Barrel => self.barrels.push(Barrel::add(world, place)?),
            Thing::Door => self.doors.push(Door::add(world, place)?),
        }
        Ok(())
    }

    /// Moves everything on by [`DT`]; gives what is to be heard.
    pub fn step(&mut self, input: Input) -> Vec<Sound> {
        let mut heard = Vec::new();
        self.steps += 1;
        for lift in &self.lifts {
            lift.run(&mut self.world, self.steps);
        }
        for door in &self.doors {
            door.run(&mut self.world, self.coins.is_empty());
        }
        self.world.step(DT);
        heard.extend(sounds::of_hits(&self.world));
        self.walk(input, &mut heard);
        self.meet(&mut heard);
        self.burn(input.light, &mut heard);
        heard
    }

    fn walk(&mut self, input: Input, heard: &mut Vec<Sound>) {
        let jumps = input.jump && self.hero.ground().is_some();
        heard.extend(jumps.then_some(Sound::JUMP));
        if input.walk != 0.0 {
            self.facing = input.walk.signum();
        }
        let asked = MoverInput {
            walk: WALK * input.walk,
            jump: if jumps { JUMP } else { 0.0 },
            drop: input.drop,
        };
        self.hero.update(&mut self.world, asked, DT);
    }

    /// Coins and flags are sensors; the hero's own body meets them.
    fn meet(&mut self, heard: &mut Vec<Sound>) {
        let met = self
            .world
            .events()
            .sensor_begin()
            .iter()
            .filter(|event| Some(event.sensor_body) == self.hero.body);
        let met: Vec<BodyId> = met.map(|event| event.visitor_body).collect();
        for body in met {
            self.won |= self.flags.contains(&body);
            if let Some(at) = self.coins.iter().position(|coin| *coin == body) {
                self.coins.remove(at);
                // It was there a moment ago.
                let _ = self.world.remove_body(body);
                heard.push(Sound::COIN);
            }
        }
    }

    fn burn(&mut self, light: bool, heard: &mut Vec<Sound>) {
        let hero = self.hero.position;
        for barrel in &mut self.barrels {
            if light && !barrel.burns() && barrel.is_near(&self.world, hero) {
                barrel.light();
                heard.push(Sound::FUSE);
            }
        }
        self.flashes.retain_mut(Flash::fades);
        let (gone, left) = self.barrels.drain(..).partition(Barrel::is_over);
        self.barrels = left;
        for barrel in Vec::<Barrel>::from_iter(gone) {
            let Some(flash) = barrel.blow_up(&mut self.world) else { continue };
            self.hero.launch(flash.push_at(hero));
            self.flashes.push(flash);
            heard.push(Sound::BLAST);
        }
        self.barrels.iter_mut().for_each(Barrel::burn);
    }

    /// The game as text.
    ///
    /// # Errors
    /// None that is known: all of it is plain data.
    pub fn save(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string(self)
    }

    /// The game of [`Game::save`]. It goes on as that would have, bit for bit.
    ///
    /// # Errors
    /// The text is no saved game.
    pub fn load(text: &str) -> Result<Self, serde_json::Error> {
        serde_json::from_str(text)
    }
}

fn sensor(place: DVec2, shape: Shape) -> RigidBody {
    RigidBody::fixed().position(place).shape(ShapeDef::new(shape).sensor())
}
