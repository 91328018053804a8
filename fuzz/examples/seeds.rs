//! Writes seeds for the fuzz targets: `cargo run --example seeds` in this folder.

use std::fs;
use tiny_physics_scenes::{Options, Run, all};

fn main() -> std::io::Result<()> {
    fs::create_dir_all("corpus/saved_frame")?;
    fs::create_dir_all("corpus/scene_file")?;
    for entry in all() {
        let scene = entry.build(Options::default());
        if scene.bodies.len() > 120 {
            continue;
        }
        let text = scene.to_json().expect("a scene as text");
        fs::write(format!("corpus/scene_file/{}", entry.name), text)?;
        let mut run = Run::start(&scene).expect("a sound scene");
        for step in 0..=60 {
            if step % 30 == 0 {
                let bytes = run.world().to_bytes();
                fs::write(format!("corpus/saved_frame/{}_{step}", entry.name), bytes)?;
            }
            run.step();
        }
    }
    Ok(())
}
