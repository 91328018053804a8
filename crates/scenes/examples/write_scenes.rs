//! Writes the shipped scene files: `cargo run -p tiny-physics-scenes --example write_scenes -- scenes`.

use std::path::PathBuf;
use tiny_physics_scenes::{Options, SceneError, all, tags};

fn main() -> Result<(), SceneError> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "scenes".to_owned()));
    for entry in all().iter().filter(|entry| entry.has_tag(tags::SHOW)) {
        let mut scene = entry.build(Options::default());
        scene.schema = Some("scene.schema.json".to_owned());
        scene.save(folder.join(format!("{}.json", entry.name)))?;
    }
    Ok(())
}
