//! Tasks for agents. [`LunarLander`] and [`BipedalWalker`] follow the documented rules and numbers of the Gymnasium
//! environments of these names (O. Klimov), so that agents and scores carry over; [`Driving`] follows the
//! car of `CarRacing` on tracks and with observations of its own; [`Stacking`] and [`Ragdoll`] are our own.

mod bipedal_walker;
mod common;
mod driving;
mod lunar_lander;
mod ragdoll;
mod stacking;
mod terrain;
mod track;

pub use bipedal_walker::BipedalWalker;
pub use driving::Driving;
pub use lunar_lander::LunarLander;
pub use ragdoll::Ragdoll;
pub use stacking::Stacking;
