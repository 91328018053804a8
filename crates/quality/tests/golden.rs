//! The same bits in the quality suite, for every SIMD level and number of threads, in debug and release builds.
//! `UPDATE_GOLDEN=1 cargo test -p tiny-physics-quality --test golden` writes `golden.txt` anew; say why in the
//! changelog. `scripts/platforms.sh` holds the same table against other architectures.

use tiny_physics::SimdLevel;
use tiny_physics_quality::{golden, row_hash, row_of, rows};

const PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden.txt");

#[test]
fn rows_have_their_golden_hashes() {
    let lines: Vec<_> = rows().iter().map(|row| row_hash(row, SimdLevel::detect(), 1)).collect();
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        let table: String = lines.iter().map(|line| format!("{line}\n")).collect();
        std::fs::write(PATH, table).expect("golden.txt can be written");
    } else {
        assert_eq!(lines, golden(), "other bits than in golden.txt");
    }
}

#[test]
fn levels_and_threads_agree() {
    for line in golden() {
        let row = row_of(&line).expect("a row of that name");
        for (level, threads) in [(SimdLevel::Scalar, 1), (SimdLevel::detect(), 3)] {
            assert_eq!(row_hash(row, level, threads), line, "{level} on {threads} threads");
        }
    }
}
