//! Ragdolls rain down in rows of columns; when all columns are full, the oldest is taken away and filled
//! again.

use crate::check::{Check, at_least_one, count, finite, finite_vec};
use crate::host::Host;
use crate::human::{BONE_COUNT, Human};
use serde::{Deserialize, Serialize};
use tiny_physics::Vec2;

/// Parameters of the rain. Every `interval` steps one column gets a group of humans in each row.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Rain {
    /// Rows, one above the other.
    pub rows: u32,
    /// Columns before the first is taken away.
    pub columns: u32,
    /// Humans in a group, side by side.
    pub group: u32,
    /// Steps from one column to the next.
    pub interval: u32,
    /// Left edge of the first column and height of the lowest row's spawn, metres.
    pub origin: Vec2,
    /// Width of a column, metres.
    pub column_width: f32,
    /// Height of a row, metres.
    pub row_height: f32,
    /// Distance between the humans of a group, metres.
    pub spacing: f32,
}

impl Default for Rain {
    fn default() -> Self {
        Self {
            rows: 5,
            columns: 40,
            group: 5,
            interval: 8,
            origin: Vec2::new(-125.0, 40.0),
            column_width: 6.25,
            row_height: 45.0,
            spacing: 0.5,
        }
    }
}

impl Rain {
    pub(super) fn check(&self) -> Check {
        count("rows", self.rows)?;
        count("columns", self.columns)?;
        count("group", self.group)?;
        at_least_one("interval", self.interval)?;
        finite_vec("origin", self.origin)?;
        finite("column_width", self.column_width)?;
        finite("row_height", self.row_height)?;
        finite("spacing", self.spacing)
    }

    pub(super) fn start(&self) -> Raining {
        Raining { rain: *self, columns: Vec::new(), next: 0 }
    }
}

/// Rain that falls.
#[derive(Clone, Debug)]
pub(crate) struct Raining {
    rain: Rain,
    /// Humans of each column that has been filled.
    columns: Vec<Vec<Bones>>,
    /// Column to be taken away next.
    next: usize,
}

/// The host's numbers of a human's bodies and joints.
#[derive(Clone, Debug)]
struct Bones {
    bodies: [usize; BONE_COUNT],
    joints: [usize; BONE_COUNT - 1],
}

impl Raining {
    pub(super) fn before_step(&mut self, host: &mut dyn Host, step: u32) {
        if !step.is_multiple_of(self.rain.interval.max(1)) {
            return;
        }
        if self.columns.len() < self.rain.columns as usize {
            let column = self.spawn_column(host, self.columns.len());
            self.columns.push(column);
            return;
        }
        let column = self.next;
        for bones in self.columns.get_mut(column).into_iter().flat_map(|c| c.drain(..)) {
            bones.joints.iter().for_each(|joint| host.remove_joint(*joint));
            bones.bodies.iter().for_each(|body| host.remove_body(*body));
        }
        let humans = self.spawn_column(host, column);
        if let Some(slot) = self.columns.get_mut(column) {
            *slot = humans;
        }
        self.next = (column + 1) % self.columns.len().max(1);
    }

    fn spawn_column(&self, host: &mut dyn Host, column: usize) -> Vec<Bones> {
        let rain = &self.rain;
        let x = rain.origin.x + rain.column_width * (column as f32 + 0.5);
        let places = (0..rain.rows).flat_map(|row| (0..rain.group).map(move |h| (row, h)));
        let spawn = |(row, h): (u32, u32)| {
            let offset = Vec2::new(rain.spacing * h as f32, rain.row_height * row as f32);
            let position = Vec2::new(x, rain.origin.y) + offset;
            let group = -i32::try_from(h).unwrap_or(i32::MAX - 1) - 1;
            spawn(host, Human { position, group })
        };
        places.map(spawn).collect()
    }
}

fn spawn(host: &mut dyn Host, human: Human) -> Bones {
    let (bodies, joints) = human.build();
    let mut bones = Bones { bodies: [0; BONE_COUNT], joints: [0; BONE_COUNT - 1] };
    for (number, body) in bones.bodies.iter_mut().zip(&bodies) {
        *number = host.add_body(body);
    }
    for (number, (a, b, def)) in bones.joints.iter_mut().zip(&joints) {
        *number = host.add_joint(bones.bodies[*a], bones.bodies[*b], def);
    }
    bones
}
