//! The rows of the first suite, one function each.

mod contacts;
mod fast;
mod joints;
mod motion;
mod piles;
mod stacks;

use crate::row::{Row, Suite, row_list};

pub(crate) use motion::momentum;

/// All rows of the first suite, in order.
pub fn rows() -> &'static [Row] {
    row_list![Suite::First;
        "1" "card house" stacks::card_house;
        "2" "heavy on light" stacks::heavy_on_light;
        "3" "heavy tower" stacks::heavy_tower;
        "4" "ball and chain" joints::ball_and_chain;
        "5" "bridge" joints::bridge;
        "6" "stack" stacks::stack;
        "7" "pyramid" piles::pyramid;
        "8" "arch" piles::arch;
        "9" "dominoes" motion::dominoes;
        "10" "deep overlap" piles::deep_overlap;
        "11" "ramp" contacts::ramp;
        "12" "rolling" contacts::rolling;
        "13" "bounce" contacts::bounce;
        "14" "cradle" motion::cradle;
        "15" "pendulum period" joints::pendulum_period;
        "16" "pendulum apex" joints::pendulum_apex;
        "17" "spring" joints::spring;
        "18" "free spin" motion::free_spin;
        "19" "momentum" motion::momentum;
        "20" "billiard break" motion::billiard_break;
        "21" "conveyor" contacts::conveyor;
        "22" "thin wall" fast::thin_wall;
        "23" "tiles" fast::tiles;
        "24" "channel" piles::channel;
        "25" "limits" joints::limits;
        "26" "far away" piles::far_away;
    ]
}
