//! Milliseconds of each stage over a run, the least of some repeats: `stage_cost [repeats] [steps] SCENE...`.

use tiny_physics::Stage;
use tiny_physics_scenes::{Options, Run, find, resolve};

fn main() {
    let mut arguments = std::env::args().skip(1);
    let repeats: u32 = arguments.next().and_then(|word| word.parse().ok()).expect("repeats");
    let steps: u32 = arguments.next().and_then(|word| word.parse().ok()).expect("steps");
    for name in arguments.flat_map(|word| resolve(&word).expect("a scene or a tag")) {
        let scene = find(name).expect("a scene").build(Options::default());
        let mut least = vec![Vec::new(); steps as usize];
        let mut names = Vec::new();
        let mut counts = [0; 4];
        for _ in 0..repeats {
            let mut run = Run::start(&scene).expect("a scene that the world takes");
            run.world_mut().time_stages(true);
            counts = [0; 4];
            for least in &mut least {
                run.step();
                let stats = run.world().stats();
                names = Stage::ALL.map(Stage::name).to_vec();
                least.resize(names.len(), f64::INFINITY);
                for (stage, least) in Stage::ALL.into_iter().zip(&mut *least) {
                    *least = least.min(stats.seconds(stage));
                }
                counts[0] += stats.fast_bodies;
                counts[1] += stats.contacts_begun;
                counts[2] += stats.moved_shapes;
                counts[3] += stats.predicted_contacts;
            }
        }
        println!(
            "{name}  fast {} begun {} moved {} predicted {}",
            counts[0], counts[1], counts[2], counts[3]
        );
        for (stage, name) in names.iter().enumerate() {
            let total: f64 = least.iter().map(|step| step[stage]).sum();
            println!("  {name:14}{:10.3}", total * 1.0e3);
        }
    }
}
