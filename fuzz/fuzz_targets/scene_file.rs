//! Any text as a scene file: refused, or a scene that can be played.
#![no_main]

use libfuzzer_sys::fuzz_target;
use tiny_physics_scenes::{Run, Scene};

fuzz_target!(|text: &str| {
    let Ok(scene) = Scene::from_json(text) else { return };
    if scene.bodies.len() > 200 || scene.settings.substeps > 16 || scene.settings.iterations > 16 {
        return;
    }
    if let Ok(mut run) = Run::start(&scene) {
        (0..3).for_each(|_| run.step());
        run.world().validate().expect("a sound world");
    }
});
