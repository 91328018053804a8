//! A character that walks by a script, and platforms that move to and fro.

use crate::check::{Check, finite, finite_dvec, finite_vec, index, positive, range};
use crate::host::Host;
use serde::{Deserialize, Serialize};
use tiny_physics::{CharacterMover, DVec2, MoverInput, Vec2};

/// A character mover starts at a place and does what `keys` say; `rides` move the platforms of the level.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Character {
    /// Where its middle is at first: world, metres.
    pub position: DVec2,
    /// Height of its capsule, metres.
    pub height: f32,
    /// Radius of its capsule, metres.
    pub radius: f32,
    /// Index of a kinematic body that shows where it is, one step late. It should collide with nothing.
    pub body: usize,
    /// What it is asked to do, by rising time.
    #[serde(default)]
    pub keys: Vec<Key>,
    /// How platforms move.
    #[serde(default)]
    pub rides: Vec<Ride>,
}

/// What a character is asked to do from a time on, until the next key.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Key {
    /// Seconds since the start.
    pub from: f32,
    /// Metres a second, positive to the right.
    pub walk: f32,
    /// Speed of a jump at the beginning, metres a second; 0 is none.
    pub jump: f32,
    /// Does it fall through one-way platforms?
    pub drop: bool,
}

/// A kinematic body that does the same again and again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ride {
    /// Index of the body.
    pub body: usize,
    /// Seconds until it begins anew.
    pub period: f32,
    /// When it moves how; between them it stands.
    pub legs: Vec<Leg>,
}

/// A part of a ride.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Leg {
    /// Seconds since the start of the period.
    pub from: f32,
    /// Likewise.
    pub to: f32,
    /// Metres a second.
    pub velocity: Vec2,
    /// Radians a second.
    pub angular_velocity: f32,
}

impl Character {
    pub(super) fn check(&self, bodies: usize) -> Check {
        finite_dvec("position", self.position)?;
        positive("height", self.height)?;
        positive("radius", self.radius)?;
        index("body", self.body, bodies, "bodies")?;
        for (i, key) in self.keys.iter().enumerate() {
            let before = self.keys[i.saturating_sub(1)].from;
            key.check(before).map_err(|e| e.under(format_args!("keys[{i}]")))?;
        }
        for (i, ride) in self.rides.iter().enumerate() {
            ride.check(bodies).map_err(|e| e.under(format_args!("rides[{i}]")))?;
        }
        Ok(())
    }

    /// The character at the start.
    pub fn mover(&self) -> CharacterMover {
        CharacterMover::new(self.position, self.height, self.radius)
    }

    /// What the script asks for in the step of `dt` seconds that begins at `time`. A jump is asked for once.
    pub fn input(&self, time: f64, dt: f32) -> MoverInput {
        let now = time + 0.5 * f64::from(dt);
        let begun = self.keys.iter().rev().find(|key| f64::from(key.from) < now);
        let Some(&Key { from, walk, jump, drop }) = begun else { return MoverInput::default() };
        let begins = now - f64::from(from) < f64::from(dt);
        MoverInput { walk, jump: if begins { jump } else { 0.0 }, drop }
    }

    /// Gives the platforms their speeds for the step of `dt` seconds that begins at `time`; `bodies` are the
    /// host's numbers of the scene's bodies.
    pub fn move_platforms(&self, host: &mut dyn Host, bodies: &[usize], time: f64, dt: f32) {
        for ride in &self.rides {
            let Some(&body) = bodies.get(ride.body) else { continue };
            let (velocity, angular_velocity) = ride.speeds(time, dt);
            if host.velocity(body) != velocity {
                host.set_velocity(body, velocity);
            }
            host.set_angular_velocity(body, angular_velocity);
        }
    }

    pub(super) fn start(&self, bodies: &[usize], dt: f32) -> Walking {
        Walking { mover: self.mover(), script: self.clone(), bodies: bodies.to_vec(), dt }
    }
}

impl Key {
    /// `before`: when the key before it begins.
    fn check(&self, before: f32) -> Check {
        finite("from", self.from)?;
        range("from", self.from, self.from >= before, "not before the key before it")?;
        finite("walk", self.walk)?;
        finite("jump", self.jump)
    }
}

impl Ride {
    fn check(&self, bodies: usize) -> Check {
        index("body", self.body, bodies, "bodies")?;
        positive("period", self.period)?;
        for (i, leg) in self.legs.iter().enumerate() {
            leg.check().map_err(|e| e.under(format_args!("legs[{i}]")))?;
        }
        Ok(())
    }

    /// Mean velocity and angular velocity over a step, so that the way does not depend on the steps' length.
    fn speeds(&self, time: f64, dt: f32) -> (Vec2, f32) {
        let (period, dt) = (f64::from(self.period), f64::from(dt));
        let start = time % period;
        let (mut velocity, mut angular_velocity) = (Vec2::ZERO, 0.0);
        for leg in &self.legs {
            // A step may begin in one period and end in the next.
            let overlap: f64 = [start, start - period]
                .map(|start| {
                    let from = start.max(f64::from(leg.from));
                    ((start + dt).min(f64::from(leg.to)) - from).max(0.0)
                })
                .iter()
                .sum();
            let part = (overlap / dt) as f32;
            velocity += leg.velocity * part;
            angular_velocity += leg.angular_velocity * part;
        }
        (velocity, angular_velocity)
    }
}

impl Leg {
    fn check(&self) -> Check {
        finite("from", self.from)?;
        finite("to", self.to)?;
        finite_vec("velocity", self.velocity)?;
        finite("angular_velocity", self.angular_velocity)
    }
}

/// A script on its way.
#[derive(Clone, Debug)]
pub(crate) struct Walking {
    mover: CharacterMover,
    script: Character,
    /// The host's numbers of the scene's bodies.
    bodies: Vec<usize>,
    dt: f32,
}

impl Walking {
    pub(super) fn before_step(&mut self, host: &mut dyn Host, step: u32) {
        let time = |step: u32| f64::from(step) * f64::from(self.dt);
        if let Some(last) = step.checked_sub(1) {
            let input = self.script.input(time(last), self.dt);
            host.move_character(&mut self.mover, input, self.dt);
            if let Some(&body) = self.bodies.get(self.script.body) {
                let way = self.mover.position.relative_to(host.position(body));
                host.set_velocity(body, way / self.dt);
            }
        }
        self.script.move_platforms(host, &self.bodies, time(step), self.dt);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rides_go_the_same_way_at_every_rate() {
        let leg = |from, to, x| Leg { from, to, velocity: Vec2::new(x, 0.0), ..Leg::default() };
        let ride =
            Ride { body: 0, period: 2.5, legs: vec![leg(0.3, 1.1, 1.0), leg(2.0, 2.5, -3.0)] };
        for hertz in [7_u32, 30, 60, 144] {
            let dt = 1.0 / hertz as f32;
            let way = |seconds: u32| -> f64 {
                let steps = 0..seconds * hertz;
                let speeds = steps.map(|i| ride.speeds(f64::from(i) * f64::from(dt), dt).0.x);
                speeds.map(f64::from).sum::<f64>() * f64::from(dt)
            };
            assert!((way(2) - 0.8).abs() < 1e-4, "{hertz} Hz: {}", way(2));
            assert!((way(5) - 2.0 * (0.8 - 1.5)).abs() < 1e-4, "{hertz} Hz: {}", way(5));
        }
    }

    #[test]
    fn a_jump_is_asked_for_once() {
        let key = |from, jump| Key { from, jump, ..Key::default() };
        let script = Character {
            position: DVec2::ZERO,
            height: 1.8,
            radius: 0.3,
            body: 0,
            keys: vec![key(0.0, 0.0), key(0.5, 5.0)],
            rides: Vec::new(),
        };
        for hertz in [30_u32, 60, 120] {
            let dt = 1.0 / hertz as f32;
            let jumps: Vec<u32> = (0..hertz)
                .filter(|&i| script.input(f64::from(i) * f64::from(dt), dt).jump > 0.0)
                .collect();
            assert_eq!(jumps, [hertz / 2], "{hertz} Hz");
        }
    }
}
