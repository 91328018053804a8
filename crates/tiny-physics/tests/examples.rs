//! Every example runs to its end without a screen; what it claims, it asserts.

use std::collections::BTreeSet;
use std::path::Path;

macro_rules! examples {
    ($($name:ident $path:literal)*) => {
        $(
            #[path = $path]
            mod $name;

            #[test]
            fn $name() {
                $name::main().unwrap();
            }
        )*

        const TESTED: &[&str] = &[$(stringify!($name)),*];
    };
}

examples! {
    breaking "../examples/breaking.rs"
    changes "../examples/changes.rs"
    debug_draw "../examples/debug_draw.rs"
    distances "../examples/distances.rs"
    events "../examples/events.rs"
    filters "../examples/filters.rs"
    first_steps "../examples/first_steps.rs"
    forces "../examples/forces.rs"
    frames "../examples/frames.rs"
    hinges "../examples/hinges.rs"
    machines "../examples/machines.rs"
    platforms "../examples/platforms.rs"
    queries "../examples/queries.rs"
    recording "../examples/recording.rs"
    shapes "../examples/shapes.rs"
    tile_map "../examples/tile_map.rs"
}

/// `mover` is a folder with a level of its own, which `tests/mover.rs` plays.
#[test]
fn no_example_is_left_out() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let found: BTreeSet<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path().file_stem().unwrap().to_string_lossy().into_owned())
        .filter(|name| name != "mover")
        .collect();
    let tested: BTreeSet<String> = TESTED.iter().map(|name| (*name).to_owned()).collect();
    assert_eq!(found, tested);
}
