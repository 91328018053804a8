//! The built-in scenes, for the playground.

use crate::outcome::words;
use crate::with_shelf;
use tiny_physics_scenes::{Options, all};

/// How many there are.
#[unsafe(no_mangle)]
pub extern "C" fn tp_scene_count() -> usize {
    all().len()
}

/// Name, sentence, steps and tags of one, as text.
#[unsafe(no_mangle)]
pub extern "C" fn tp_scene_entry(index: usize) -> bool {
    with_shelf(|shelf| {
        let Some(entry) = all().get(index) else { return false };
        let entry = (entry.name, entry.description, entry.steps, entry.tags);
        serde_json::to_vec(&entry).map(|text| shelf.say(text)).is_ok()
    })
}

/// The scene file of one, as text.
#[unsafe(no_mangle)]
pub extern "C" fn tp_scene_file(index: usize) -> bool {
    with_shelf(|shelf| {
        let scene = all().get(index).map(|entry| entry.build(Options::default()));
        let text = scene.ok_or_else(String::new).and_then(|scene| scene.to_json().map_err(words));
        let done = text.is_ok();
        shelf.say(text.unwrap_or_else(|reason| reason));
        done
    })
}
