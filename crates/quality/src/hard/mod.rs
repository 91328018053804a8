//! The rows of the hard suite: scenes in which engines, this one too, were seen to fail.
//!
//! Each row stands for a family; its other variant has other sizes, masses, speeds and seeds. Rows are lettered: things
//! that move (M), joints with contacts (J), energy, turning and units (E), ground and waking (G), frames and bits (F), and
//! costs that grow wrongly (C).

mod common;
mod costs;
mod energy;
mod fast;
mod frames;
mod ground;
mod joints;
mod machines;
mod moving;
mod ropes;

pub(crate) use joints::Gain;

use crate::row::{Row, Suite, row_list};
use crate::rows::momentum;

/// All rows of the hard suite, in order.
pub fn hard_rows() -> &'static [Row] {
    row_list![Suite::Hard;
        "M1" "lift" moving::lift;
        "M2" "wall meets ball" moving::wall_meets_ball;
        "M3" "flipper" moving::flipper;
        "M4" "wagon" moving::wagon;
        "M5" "drum" moving::drum;
        "M6" "rising pile" moving::rising_pile;
        "M7" "plate and ball" fast::plate_and_ball;
        "M8" "head on" fast::head_on;
        "M9" "turning rod" fast::turning_rod;
        "M10" "bar and peg" fast::bar_and_peg;
        "M11" "fast sensor" fast::fast_sensor, alone "the others have no events here";
        "M12" "debris" fast::debris;
        "M13" "crowds" fast::crowds;
        "M14" "seeds of the demo" fast::seeds_of_the_demo;
        "M15" "galilean" moving::galilean;
        "J1" "loaded bridge" joints::loaded_bridge;
        "J2" "slack bridge" joints::slack_bridge;
        "J3" "crates on a bridge" joints::crates_on_a_bridge;
        "J4" "chain over an edge" ropes::over_the_edge;
        "J5" "rope over a ball" ropes::over_a_ball;
        "J6" "ragdoll pit" joints::ragdoll_pit;
        "J7" "nets" ropes::nets;
        "J8" "cloth" ropes::cloth;
        "J9" "joints out of place" ropes::out_of_place;
        "J10" "fast car" machines::car;
        "J11" "motor against limit" machines::motor_against_limit;
        "J12" "double pendulum" machines::double_pendulum;
        "J13" "gear train" machines::gear_train, alone "the others have no gears";
        "E1" "fast turning" energy::fast_turning;
        "E2" "bouncing forever" energy::bouncing_forever;
        "E3" "elastic boxes" energy::elastic_boxes;
        "E4" "elastic gas" energy::elastic_gas;
        "E5" "energy of scenes" energy::energy_of_scenes;
        "E6" "units" energy::units, alone "about this engine's own setting";
        "E7" "momentum of a crowd" momentum;
        "E8" "large pyramid" energy::large_pyramid;
        "G1" "tile over a crate" ground::tile_over_a_crate;
        "G2" "tile over a sleeper" ground::tile_over_a_sleeper;
        "G3" "waking" ground::waking, alone "about this engine's own interface";
        "G4" "built-in card house" ground::built_in_card_house;
        "G5" "mover" ground::mover, alone "the others have no such character here";
        "F1" "frames with joints" frames::with_joints, alone "the others save no frames here";
        "F2" "blown up" frames::blown_up, alone "about this engine's own levels";
        "F3" "hashes tell all" frames::hashes_tell_all, alone "the others hash no worlds here";
        "F4" "whole runs" frames::whole_runs, alone "about this engine's own levels";
        "C1" "many shapes" costs::many_shapes, alone "about this engine's own interface";
        "C2" "one sensor" costs::one_sensor, alone "time within this engine";
        "C3" "breakable joints" costs::breakable_joints, alone "time within this engine";
        "C4" "joint to a level" costs::joint_to_a_level, alone "time within this engine";
        "C5" "put to sleep" costs::put_to_sleep, alone "time within this engine";
        "C6" "steps that survey" costs::steps_that_survey, alone "time within this engine";
        "C7" "steps that rebuild" costs::steps_that_rebuild, alone "time within this engine";
        "C8" "a joint beside a stack" costs::a_joint_beside_a_stack, alone "time within this engine";
        "C9" "ring of pieces" costs::ring_of_pieces, alone "time within this engine";
        "C10" "changing step" costs::changing_step, alone "time within this engine";
        "C11" "many contacts" costs::many_contacts, alone "time within this engine";
    ]
}
