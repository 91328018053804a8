//! Handles as numbers of JavaScript, which holds 53 bits of an integer: 24 for the index, 29 for the generation.

use tiny_physics::{BodyId, JointId, ShapeId, TileGridId};

const INDEX_BITS: u32 = 24;
const INDEX_MASK: u64 = (1 << INDEX_BITS) - 1;

fn pack(bits: u64) -> f64 {
    ((bits >> 32) << INDEX_BITS | bits & INDEX_MASK) as f64
}

fn unpack(number: f64) -> u64 {
    // What is no whole number, or negative, becomes some handle that is stale.
    let bits = number as u64;
    bits >> INDEX_BITS << 32 | bits & INDEX_MASK
}

/// A handle to and from a number.
pub(crate) trait Handle: Copy {
    fn number(self) -> f64;
    fn of(number: f64) -> Self;
}

macro_rules! handle {
    ($($id:ident),*) => {
        $(impl Handle for $id {
            fn number(self) -> f64 {
                pack(self.to_bits())
            }
            fn of(number: f64) -> Self {
                Self::from_bits(if number >= 0.0 { unpack(number) } else { u64::MAX })
            }
        })*
    };
}

handle!(BodyId, ShapeId, JointId, TileGridId);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn handles_come_back() {
        for bits in [0, 5, 7 << 32 | 3, ((1 << 29) - 1) << 32 | INDEX_MASK] {
            let id = BodyId::from_bits(bits);
            assert_eq!(BodyId::of(id.number()), id);
        }
        assert_eq!(BodyId::of(f64::NAN), BodyId::from_bits(u64::MAX));
    }
}
