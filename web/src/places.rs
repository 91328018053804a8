//! Water and areas of force: they act on a world, which does not know of them.

use tiny_physics::World;
use tiny_physics::record::Command;
use tiny_physics_scenes::{Act, Deed, Scene, Script};

/// What a scene does to places, but for what is over at once.
pub(crate) fn of_scene(scene: &Scene) -> Vec<Act> {
    let Some(Script::Timeline(timeline)) = &scene.script else { return Vec::new() };
    let lasts = |act: &&Act| matches!(act.deed, Deed::Water { .. } | Deed::Zone { .. });
    timeline.acts.iter().filter(lasts).cloned().collect()
}

/// What acts on places at the moment: by the scene's acts, or by the commands of the recording where there are none.
pub(crate) fn now(world: &World, acts: &[Act], commands: &[Command]) -> Vec<Command> {
    let step = u32::try_from(world.step_count()).unwrap_or(u32::MAX);
    let acting = acts.iter().filter(|act| act.when.is_before(step) == Some(true));
    let of_scene = acting.filter_map(|act| act.deed.on_place(0.0));
    of_scene.chain(commands.iter().filter(|_| acts.is_empty()).cloned()).collect()
}
