//! Water and areas of force: they act on a world, which does not know of them.

use crate::session::Session;
use tiny_physics::record::Command;
use tiny_physics_scenes::{Act, Deed, Scene, Script};

/// What a scene does to places, but for what is over at once.
pub(crate) fn of_scene(scene: &Scene) -> Vec<Act> {
    let Some(Script::Timeline(timeline)) = &scene.script else { return Vec::new() };
    let lasts = |act: &&Act| matches!(act.deed, Deed::Water { .. } | Deed::Zone { .. });
    timeline.acts.iter().filter(lasts).cloned().collect()
}

/// What acts on places at the moment: by the scene, or by the recording where there is no scene.
pub(crate) fn now(session: &Session) -> Vec<Command> {
    let step = u32::try_from(session.world().step_count()).unwrap_or(u32::MAX);
    let acts = session.places.iter().filter(|act| act.when.is_before(step) == Some(true));
    let of_scene = acts.filter_map(|act| act.deed.on_place(0.0));
    of_scene
        .chain(session.commands().iter().filter(|_| session.places.is_empty()).cloned())
        .collect()
}
