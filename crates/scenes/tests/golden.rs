//! The same bits: one hash a scene, for every SIMD level and number of threads, in debug and release
//! builds. `UPDATE_GOLDEN=1 cargo test -p tiny-physics-scenes --test golden` writes `golden.txt` anew; say
//! why in the changelog. `scripts/platforms.sh` holds the same table against other architectures.

use std::fmt::Write;
use tiny_physics::SimdLevel;
use tiny_physics_scenes::bits::{Way, hashes, parted};
use tiny_physics_scenes::{Entry, Golden, Options, all, golden, run_hash, tags};

const PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden.txt");

/// Bodies times steps that a scene may take, so that the test stays short.
const WORK: usize = 150_000;

/// Scenes small enough to be run at every level and thread count, and how many steps of each.
fn scenes() -> impl Iterator<Item = (&'static Entry, u32)> {
    all().iter().filter(|entry| !entry.has_tag(tags::HUGE)).filter_map(|entry| {
        let bodies = entry.build(Options::default()).bodies.len().max(100);
        let steps = (WORK / bodies).min(300) as u32;
        (steps >= 5).then_some((entry, steps.min(entry.steps)))
    })
}

/// The levels that this machine has.
fn levels() -> Vec<SimdLevel> {
    SimdLevel::ALL.into_iter().filter(|level| level.is_available()).collect()
}

fn hash(entry: &Entry, steps: u32, level: SimdLevel, threads: usize) -> u64 {
    run_hash(entry, steps, level, threads).expect(entry.name)
}

#[test]
fn scenes_have_their_golden_hashes() {
    let update = std::env::var_os("UPDATE_GOLDEN").is_some();
    let best = SimdLevel::detect();
    let golden = golden();
    let (mut table, mut wrong) = (String::new(), Vec::new());
    for (entry, steps) in scenes() {
        let line = Golden { name: entry.name.into(), steps, hash: hash(entry, steps, best, 1) };
        writeln!(table, "{line}").expect("text");
        if !golden.contains(&line) {
            wrong.push(entry.name);
        }
    }
    if update {
        std::fs::write(PATH, table).expect("golden.txt can be written");
    } else {
        assert!(wrong.is_empty(), "other bits than in golden.txt: {wrong:?}\n{table}");
    }
}

#[test]
fn simd_levels_agree() {
    for (entry, steps) in scenes() {
        let expected = hash(entry, steps / 2, SimdLevel::detect(), 1);
        for level in levels() {
            assert_eq!(hash(entry, steps / 2, level, 1), expected, "{} on {level:?}", entry.name);
        }
    }
}

/// Whole runs of the small scenes. The example `bits` plays all scenes in every way.
#[test]
fn levels_and_threads_may_change_during_whole_runs() {
    let scalar = Way::Steady(SimdLevel::ALL[0], 1);
    for entry in all().iter().filter(|entry| entry.has_tag(tags::SHOW)) {
        let run = |way| hashes(entry, entry.steps, 50, way).expect(entry.name);
        let parted = parted(&run(scalar), &run(Way::Changing));
        assert_eq!(parted, None, "{} differs by this step", entry.name);
    }
}

#[test]
fn thread_counts_agree() {
    for (entry, steps) in scenes() {
        let expected = hash(entry, steps / 2, SimdLevel::detect(), 1);
        for threads in [2, 3, 4, 8] {
            let hash = hash(entry, steps / 2, SimdLevel::detect(), threads);
            assert_eq!(hash, expected, "{} on {threads} threads", entry.name);
        }
    }
}
