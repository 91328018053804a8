//! The rows of the hard suite: scenes in which engines, this one too, were seen to fail.
//!
//! Each row stands for a family; its other variant has other sizes, masses, speeds and seeds. Rows are lettered: things
//! that move (M), joints with contacts (J), energy, turning and units (E), ground and waking (G), frames and bits (F), and
//! costs that grow wrongly (C).

mod costs;
mod energy;
mod frames;
mod ground;
mod joints;
mod moving;

use crate::row::{Row, Suite, row_list};

/// All rows of the hard suite, in order.
pub fn hard_rows() -> &'static [Row] {
    row_list![Suite::Hard;
        "M1" "lift" moving::lift;
        "M2" "wall meets ball" moving::wall_meets_ball;
        "M8" "head on" moving::head_on;
        "J1" "loaded bridge" joints::loaded_bridge;
        "J6" "ragdoll pit" joints::ragdoll_pit;
        "E1" "fast turning" energy::fast_turning;
        "E3" "elastic boxes" energy::elastic_boxes;
        "G1" "tile over a crate" ground::tile_over_a_crate;
        "F1" "frames with joints" frames::with_joints, alone "only this engine saves frames here";
        "C1" "many shapes on a body" costs::many_shapes, alone "about this engine's own interface";
    ]
}
