//! Handles: what the user keeps of a body, shape or joint.

use core::fmt;

macro_rules! handle {
    ($(#[$meta:meta])* $name:ident, $word:literal) => {
        $(#[$meta])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub struct $name {
            pub(crate) index: u32,
            pub(crate) generation: u32,
        }

        impl $name {
            pub(crate) fn new(index: u32, generation: u32) -> Self {
                Self { index, generation }
            }

            /// Dense index: small, reused after removal. For tables beside the world.
            pub fn index(self) -> usize {
                self.index as usize
            }

            /// The handle as a number, for other languages and tables: its index in the lower half, its
            /// generation in the upper.
            pub fn to_bits(self) -> u64 {
                u64::from(self.generation) << 32 | u64::from(self.index)
            }

            /// The handle of [`Self::to_bits`]. Of any other number it makes a handle that is stale.
            pub fn from_bits(bits: u64) -> Self {
                Self { index: bits as u32, generation: (bits >> 32) as u32 }
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, concat!($word, " {}v{}"), self.index, self.generation)
            }
        }

        impl fmt::Debug for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                fmt::Display::fmt(self, f)
            }
        }

        impl From<$name> for crate::error::Error {
            fn from(id: $name) -> Self {
                Self::StaleHandle { handle: id.to_string() }
            }
        }
    };
}

handle! {
    /// Handle of a body. It goes stale when the body is removed and never means another body.
    BodyId, "body"
}
handle! {
    /// Handle of a shape. It goes stale when the shape is removed and never means another shape.
    ShapeId, "shape"
}
handle! {
    /// Handle of a tile map. It goes stale when the map is removed and never means another map.
    TileGridId, "tile grid"
}
handle! {
    /// Handle of a joint. It goes stale when the joint is removed and never means another joint.
    JointId, "joint"
}

crate::codec::data!(BodyId { index } apart { generation });
crate::codec::data!(ShapeId { index } apart { generation });
crate::codec::data!(JointId { index } apart { generation });
crate::codec::data!(TileGridId { index } apart { generation });
