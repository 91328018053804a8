//! The rows of the suite, one function each.

mod contacts;
mod fast;
mod joints;
mod motion;
mod piles;
mod stacks;

use crate::lab::{Lab, MakeSubject, Variant};
use crate::report::{Measure, Report};

/// One row of the suite.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Number, from 1.
    pub id: u32,
    /// Short name.
    pub name: &'static str,
    play: fn(&mut Lab<'_>) -> Vec<Measure>,
}

impl Row {
    /// Plays the row. `awake` forbids all sleep: harder than an engine's defaults. `progress` is told of
    /// steps done and steps expected, now and then.
    pub fn run(
        &self,
        make: MakeSubject<'_>,
        variant: Variant,
        awake: bool,
        progress: &mut dyn FnMut(u64, u64),
    ) -> Report {
        let mut lab = Lab::new(make, (variant, awake), progress);
        Report::new(self.id, self.name, (self.play)(&mut lab))
    }
}

macro_rules! rows {
    ($($id:literal $name:literal $play:path),* $(,)?) => {
        &[$(Row { id: $id, name: $name, play: $play }),*]
    };
}

/// All rows, in order.
pub fn rows() -> &'static [Row] {
    rows![
        1 "card house" stacks::card_house,
        2 "heavy on light" stacks::heavy_on_light,
        3 "heavy tower" stacks::heavy_tower,
        4 "ball and chain" joints::ball_and_chain,
        5 "bridge" joints::bridge,
        6 "stack" stacks::stack,
        7 "pyramid" piles::pyramid,
        8 "arch" piles::arch,
        9 "dominoes" motion::dominoes,
        10 "deep overlap" piles::deep_overlap,
        11 "ramp" contacts::ramp,
        12 "rolling" contacts::rolling,
        13 "bounce" contacts::bounce,
        14 "cradle" motion::cradle,
        15 "pendulum period" joints::pendulum_period,
        16 "pendulum apex" joints::pendulum_apex,
        17 "spring" joints::spring,
        18 "free spin" motion::free_spin,
        19 "momentum" motion::momentum,
        20 "billiard break" motion::billiard_break,
        21 "conveyor" contacts::conveyor,
        22 "thin wall" fast::thin_wall,
        23 "tiles" fast::tiles,
        24 "channel" piles::channel,
        25 "limits" joints::limits,
        26 "far away" piles::far_away,
    ]
}

/// The row of a name or number.
pub fn find(name: &str) -> Option<&'static Row> {
    let number = name.parse().unwrap_or(0);
    rows().iter().find(|row| row.id == number || row.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_numbered_in_order_and_found() {
        for (i, row) in rows().iter().enumerate() {
            assert_eq!(row.id as usize, i + 1);
            assert_eq!(find(row.name).map(|row| row.id), Some(row.id));
            assert_eq!(find(&row.id.to_string()).map(|row| row.id), Some(row.id));
        }
        assert_eq!(rows().len(), 26);
        assert!(find("no such row").is_none());
    }
}
