//! Barrels of powder: lit, they blow up.

use crate::pieces::solid;
use serde::{Deserialize, Serialize};
use tiny_physics::prelude::*;
use tiny_physics::{Explosion, Vec2};

/// Half width and half height of a barrel, metres.
pub const BARREL: (f32, f32) = (0.35, 0.45);
/// Steps from light to blast.
pub const FUSE: u32 = 100;
/// How far one reaches to light it, metres.
const REACH: f64 = 1.6;
/// Full strength up to here, nothing beyond the second, metres.
const BLAST: (f32, f32) = (2.0, 6.0);

/// A barrel.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Barrel {
    /// Its body.
    pub body: BodyId,
    /// Steps that are left of the fuse; `None` where it is not lit.
    pub fuse: Option<u32>,
}

impl Barrel {
    /// One that stands in a cell.
    ///
    /// # Errors
    /// The place is none.
    pub fn add(world: &mut World, place: DVec2) -> Result<Self, Error> {
        let body = solid(place, Shape::rect(BARREL.0, BARREL.1)?, 200.0);
        Ok(Self { body: world.add_body(body)?, fuse: None })
    }

    /// Is it lit?
    pub fn burns(&self) -> bool {
        self.fuse.is_some()
    }

    /// Lights it.
    pub fn light(&mut self) {
        self.fuse = Some(FUSE);
    }

    /// A step passes.
    pub fn burn(&mut self) {
        self.fuse = self.fuse.map(|left| left.saturating_sub(1));
    }

    /// Has the fuse burnt down?
    pub fn is_over(&self) -> bool {
        self.fuse == Some(0)
    }

    /// Can somebody who is there light it?
    pub fn is_near(&self, world: &World, place: DVec2) -> bool {
        world.body(self.body).is_some_and(|body| (body.position_f64() - place).length() < REACH)
    }

    /// Pushes what is around, and is no more.
    pub fn blow_up(self, world: &mut World) -> Option<Flash> {
        let center = world.body(self.body)?.position_f64();
        let _ = world.remove_body(self.body);
        let explosion = Explosion {
            center,
            radius: BLAST.0,
            falloff: BLAST.1 - BLAST.0,
            impulse_per_metre: 500.0,
        };
        world.explode(&explosion, &QueryFilter::new());
        Some(Flash { center, left: FLASH })
    }
}

/// Steps that the light of a blast lasts.
pub const FLASH: u32 = 30;

/// The light of a blast.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Flash {
    /// Where it was.
    pub center: DVec2,
    /// Steps that it is still seen.
    pub left: u32,
}

impl Flash {
    /// A step passes; `false` when it is over.
    pub fn fades(&mut self) -> bool {
        self.left = self.left.saturating_sub(1);
        self.left > 0
    }

    /// The speed that it gives to somebody who is there, metres a second.
    pub fn push_at(&self, place: DVec2) -> Vec2 {
        let away = (place - self.center).to_vec2();
        let (direction, distance) = away.direction_and_length();
        let strength = (1.0 - distance / BLAST.1).max(0.0);
        if strength == 0.0 {
            Vec2::ZERO
        } else {
            (direction + Vec2::new(0.0, 0.5)) * (12.0 * strength)
        }
    }
}
