//! Plays random worlds in this engine alone: `arena A..B [OUT]` prints what no world should show, and whether SIMD levels
//! and threads agree; worlds that show something are shrunk and written to the folder OUT. The runner that compares engines is in `peers`.

use std::path::Path;
use tiny_physics_quality::{arena, our_engine};
use tiny_physics_scenes::Scene;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let range = arguments.first().map_or("0..100", String::as_str);
    let (first, end) = range.split_once("..").expect("seeds as A..B");
    let (first, end): (u64, u64) = (first.parse().expect("a seed"), end.parse().expect("a seed"));
    let out = arguments.get(1);
    let mut shown = 0;
    for seed in first..end {
        let scene = arena::draw(seed);
        let Some(what) = broken(&scene) else { continue };
        shown += 1;
        let least =
            arena::shrink(&scene, 150, &mut |smaller| broken(smaller).as_deref() == Some(&what));
        println!(
            "{seed}: {what} ({}); {} of {} bodies",
            scene.description,
            least.bodies.len(),
            scene.bodies.len()
        );
        if let Some(out) = out {
            let name = format!("{}-{seed}.json", what.replace(' ', "-"));
            if let Err(error) = least.save(Path::new(out).join(name)) {
                eprintln!("{error}");
            }
        }
    }
    println!("{shown} of {} worlds", end.saturating_sub(first));
}

/// What a world shows that none should.
fn broken(scene: &Scene) -> Option<String> {
    match arena::bits(scene) {
        Ok([scalar, best, threads]) if scalar == best && best == threads => {}
        Ok(_) => return Some("other bits".into()),
        Err(why) => return Some(format!("unsound: {}", why.split(':').next().unwrap_or_default())),
    }
    arena::play(scene, &our_engine, &|| 0.0).broken().map(String::from)
}
