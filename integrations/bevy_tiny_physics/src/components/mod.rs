//! What a game puts on its entities.

mod body;
mod character;
mod collider;
mod force;
mod joint;

pub use body::*;
pub use character::*;
pub use collider::*;
pub use force::*;
pub use joint::*;
