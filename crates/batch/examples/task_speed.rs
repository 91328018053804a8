//! Steps a CPU-second of a task under random actions: `task_speed [lander|walker|hardcore|driving|stacking|ragdoll]
//! [worlds] [steps]`.

use std::time::Instant;
use tiny_physics_batch::tasks::{BipedalWalker, Driving, LunarLander, Ragdoll, Stacking};
use tiny_physics_batch::{Autoreset, BatchError, Random, TaskBatch, Tasks};

fn batch(name: &str, count: usize) -> Result<Box<dyn Tasks>, BatchError> {
    let mode = Autoreset::NextStep;
    Ok(match name {
        "walker" => Box::new(TaskBatch::new(BipedalWalker::new(false)?, count, 1, mode)?),
        "hardcore" => Box::new(TaskBatch::new(BipedalWalker::new(true)?, count, 1, mode)?),
        "driving" => Box::new(TaskBatch::new(Driving::new()?, count, 1, mode)?),
        "stacking" => Box::new(TaskBatch::new(Stacking::new()?, count, 1, mode)?),
        "ragdoll" => Box::new(TaskBatch::new(Ragdoll::new()?, count, 1, mode)?),
        _ => Box::new(TaskBatch::new(LunarLander::new(false, -10.0, None)?, count, 1, mode)?),
    })
}

fn main() -> Result<(), BatchError> {
    let mut words = std::env::args().skip(1);
    let name = words.next().unwrap_or_default();
    let mut number = |other| words.next().and_then(|word| word.parse().ok()).unwrap_or(other);
    let (count, steps): (usize, usize) = (number(64), number(200));
    let mut batch = batch(&name, count)?;
    let (spec, mut random) = (batch.spec(), Random::new(1));
    let start = Instant::now();
    for _ in 0..steps {
        let act = |_| match spec.choices {
            Some(choices) => random.whole(0, choices.into()) as f32,
            None => random.uniform(-1.0, 1.0),
        };
        let actions: Vec<f32> = (0..count * spec.action).map(act).collect();
        batch.step(&actions)?;
    }
    let seconds = start.elapsed().as_secs_f64();
    let rate = (count * steps) as f64 / seconds;
    println!("{rate:.0} steps a second, {} bytes a world", batch.memory() / count);
    Ok(())
}
