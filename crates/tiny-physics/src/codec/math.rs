//! Vectors and frames as data.

use super::data;
use crate::math::{Aabb, DVec2, Pose, Rot, Transform, Vec2};

data!(Vec2 { x, y });
data!(DVec2 { x, y });
data!(Rot { c, s });
data!(Transform { p, q });
data!(Pose { p, q });
data!(Aabb { min, max });
