//! The list of all scenes that this crate can build.

use crate::build::{Options, benchmark, course, fair, features, joints, level, seed, show, small};
use crate::scene::Scene;
use core::fmt;

/// A scene that can be built.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Its name.
    pub name: &'static str,
    /// What there is to see, in a sentence.
    pub description: &'static str,
    /// How many steps a run takes.
    pub steps: u32,
    /// What it is for: see [`tags`].
    pub tags: &'static [&'static str],
    build: fn(Options) -> Scene,
}

impl Entry {
    /// Builds the scene.
    pub fn build(&self, options: Options) -> Scene {
        (self.build)(options)
    }

    /// Has it this tag?
    pub fn has_tag(&self, tag: &str) -> bool {
        self.tags.contains(&tag)
    }
}

/// The tags.
pub mod tags {
    /// Scenes that Box2D publishes its own benchmark on.
    pub const BOX2D: &str = "box2d";
    /// Scenes to measure time on.
    pub const BENCHMARK: &str = "benchmark";
    /// Small scenes to look at; they are shipped as scene files too.
    pub const SHOW: &str = "show";
    /// Scenes that depend on the seed.
    pub const SEEDED: &str = "seeded";
    /// Scenes with very many bodies or shapes.
    pub const HUGE: &str = "huge";
    /// Scenes of the size that games have, to measure time on.
    pub const SMALL: &str = "small";
    /// One scene in several sizes: what a body costs as they become more.
    pub const SCALE: &str = "scale";
}

const BOX2D: &[&str] = &[tags::BENCHMARK, tags::BOX2D];
const BOX2D_HUGE: &[&str] = &[tags::BENCHMARK, tags::BOX2D, tags::HUGE];
const BENCHMARK: &[&str] = &[tags::BENCHMARK];
const SCALE: &[&str] = &[tags::BENCHMARK, tags::SCALE];
const SCALE_HUGE: &[&str] = &[tags::BENCHMARK, tags::SCALE, tags::HUGE];
const SMALL: &[&str] = &[tags::BENCHMARK, tags::SMALL];
const SHOW: &[&str] = &[tags::SHOW];

const fn entry(
    name: &'static str,
    description: &'static str,
    steps: u32,
    tags: &'static [&'static str],
    build: fn(Options) -> Scene,
) -> Entry {
    Entry { name, description, steps, tags, build }
}

#[rustfmt::skip]
static ENTRIES: &[Entry] = &[
    entry("joint_grid", "A net of 19,800 hinges hangs from a few fixed knots", 500, BOX2D, benchmark::joint_grid),
    entry("large_pyramid", "A pyramid of 5050 crates", 500, BOX2D, benchmark::large_pyramid),
    entry("many_pyramids", "400 small pyramids", 200, BOX2D, benchmark::many_pyramids),
    entry("rain", "A thousand ragdolls rain on five floors", 1000, BOX2D, benchmark::rain),
    entry("smash", "A heavy box flies into a wall of 9600 sleeping boxes", 300, BOX2D, benchmark::smash),
    entry("spinner", "A rotor stirs 6076 bodies in a ring", 500, BOX2D, benchmark::spinner),
    entry("tumbler", "A drum turns and tumbles 2025 boxes", 750, BOX2D, benchmark::tumbler),
    entry("sleep", "Ten pyramids fall asleep and are woken", 500, BOX2D, benchmark::sleep),
    entry("queries", "6000 queries a step through a field of boxes", 100, BOX2D_HUGE, benchmark::queries),
    entry("tile_world", "Ground of 290,000 tiles that moves on", 500, BOX2D_HUGE, benchmark::tile_world),
    entry("seed_demo", "Circles and boxes fall, bounce and come to rest", 600, &[tags::SHOW, tags::SEEDED], seed::seed_demo),
    entry("seed_pile_1000", "A pile of 1000 circles and never-turning boxes", 600, BENCHMARK, seed::seed_pile_1000),
    entry("seed_pile_5000", "A pile of 5000 circles and never-turning boxes", 600, BENCHMARK, seed::seed_pile_5000),
    entry("seed_pile_20000", "A pile of 20,000 circles and never-turning boxes", 600, BENCHMARK, seed::seed_pile_20000),
    entry("seed_pile_turning_5000", "A pile of 5000 circles and boxes that turn", 600, BENCHMARK, seed::seed_pile_turning_5000),
    entry("circles_10k", "A pile of 10,000 circles", 120, SCALE, seed::circles_10k),
    entry("circles_100k", "A pile of 100,000 circles", 120, SCALE_HUGE, seed::circles_100k),
    entry("circles_1m", "A pile of 1,000,000 circles", 120, SCALE_HUGE, seed::circles_1m),
    entry("crates_1", "One crate at rest, awake", 300, SMALL, small::crates_1),
    entry("crates_10", "10 crates at rest, awake", 300, SMALL, small::crates_10),
    entry("crates_30", "30 crates at rest, awake", 300, SMALL, small::crates_30),
    entry("crates_100", "100 crates at rest in rows of 30, awake", 300, SMALL, small::crates_100),
    entry("crates_300", "300 crates at rest in rows of 30, awake", 300, SMALL, small::crates_300),
    entry("crates_1000", "1000 crates at rest in rows of 30, awake", 300, SMALL, small::crates_1000),
    entry("pile_hexagons", "A pyramid of 210 hexagons comes down and falls asleep", 900, SMALL, small::pile_hexagons),
    entry("pile_capsules", "150 capsules fall into a pit and asleep", 900, SMALL, small::pile_capsules),
    entry("pile_triangles", "150 triangles fall into a pit and asleep", 900, SMALL, small::pile_triangles),
    entry("pile_bricks", "A wall of 900 bricks settles and falls asleep", 900, SMALL, small::pile_bricks),
    entry("pile_mixed", "300 shapes of every kind fall into a pit and asleep", 900, SMALL, small::pile_mixed),
    entry("pile_planks", "100 thin planks fall into a pit and asleep", 900, SMALL, small::pile_planks),
    entry("pile_rings", "60 rings of eight boxes fall into a pit and asleep", 900, SMALL, small::pile_rings),
    entry("pile_by_size", "14 boxes stacked by size fall asleep", 900, SMALL, small::pile_by_size),
    entry("game", "A platformer level with crates, lifts, a door, a rope and a character", 600, &[tags::BENCHMARK, tags::SMALL, tags::SEEDED], small::game),
    entry("tiles", "500 movers walk in a platformer level", 600, &[tags::BENCHMARK, tags::SEEDED], level::tiles),
    entry("tile_map", "Balls and crates on hills and platforms of tiles, and a chain", 600, &[tags::SEEDED], level::tile_map),
    entry("fair", "A pool, a cradle, an arch, a pyramid, and a ball that knocks a tower over", 600, SHOW, fair::fair),
    entry("stack", "A tower of crates", 600, SHOW, show::stack),
    entry("pyramid", "A small pyramid of crates", 600, SHOW, show::pyramid),
    entry("newton_cradle", "Five balls hand a knock through", 600, SHOW, show::newton_cradle),
    entry("domino", "A ball tips a row of dominoes", 600, SHOW, show::domino),
    entry("card_house", "A house of cards, held by friction alone", 600, SHOW, show::card_house),
    entry("bridge", "A bridge of hinged planks carries crates and balls", 600, SHOW, show::bridge),
    entry("ragdoll", "Ragdolls tumble down stairs", 600, SHOW, show::ragdoll),
    entry("bullet_wall", "Bullets at 400 m/s against a thin wall", 600, SHOW, show::bullet_wall),
    entry("wrecking_ball", "A heavy ball on a light chain", 600, SHOW, show::wrecking_ball),
    entry("arch", "An arch of stones without mortar", 600, SHOW, show::arch),
    entry("galton_board", "Balls fall through pegs into bins", 1200, SHOW, show::galton_board),
    entry("car", "A car drives over hills", 600, SHOW, show::car),
    entry("character", "A character walks over hills, stairs and platforms and pushes a crate", 2250, SHOW, course::character),
    entry("friction_ramp", "Crates of rising friction on a slope", 600, SHOW, show::friction_ramp),
    entry("joints", "Every kind of joint, side by side", 600, SHOW, joints::joints),
    entry("clockwork", "A motor, a train of wheels, and a rack that lifts a stack", 600, SHOW, joints::clockwork),
    entry("breaking_bridge", "A bridge whose joints break under too much load", 600, SHOW, joints::breaking_bridge),
    entry("bowl", "Shapes of every kind in a bowl drawn as a chain", 600, SHOW, features::bowl),
    entry("changing", "A ball grows, a slope freezes, shelves come loose", 600, SHOW, features::changing),
    entry("platforms", "Led platforms with cargo, and one-way planks", 600, SHOW, features::platforms),
    entry("harbour", "Things float or sink, and a boat sails", 900, SHOW, features::harbour),
    entry("blast", "Three explosions in a town of crates", 600, SHOW, features::blast),
    entry("orbits", "Stones circle two planets", 600, SHOW, features::orbits),
    entry("sorting", "Belts and gates sort parcels by their filters", 1500, SHOW, features::sorting),
    entry("sensor_door", "A ball opens a door by a sensor", 600, SHOW, features::sensor_door),
    entry("hero", "A character walks, climbs, jumps and rides", 900, SHOW, features::hero),
];

/// All scenes.
pub fn all() -> &'static [Entry] {
    ENTRIES
}

/// The scene with a name.
///
/// # Errors
/// There is none of that name; the error has the nearest name.
pub fn find(name: &str) -> Result<&'static Entry, UnknownScene> {
    ENTRIES.iter().find(|entry| entry.name == name).ok_or_else(|| UnknownScene::new(name))
}

/// The names of the scenes that a word stands for: a scene's own name, or a tag for all scenes that have it.
/// Huge ones come only with the tags [`tags::HUGE`] and [`tags::SCALE`].
///
/// # Errors
/// It is neither.
pub fn resolve(word: &str) -> Result<Vec<&'static str>, UnknownScene> {
    let huge_too = [tags::HUGE, tags::SCALE].contains(&word);
    let tagged = all().iter().filter(|e| e.has_tag(word) && (huge_too || !e.has_tag(tags::HUGE)));
    let names: Vec<_> = tagged.map(|entry| entry.name).collect();
    if names.is_empty() { find(word).map(|entry| vec![entry.name]) } else { Ok(names) }
}

/// There is no scene of this name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownScene {
    /// The name asked for.
    pub name: String,
    /// The name that was probably meant.
    pub nearest: Option<&'static str>,
}

impl UnknownScene {
    /// Greatest number of wrong letters for a name to count as probably meant, as a part of its length.
    const WRONG: f32 = 0.4;

    fn new(name: &str) -> Self {
        let asked = name.to_lowercase().replace(['-', ' '], "_");
        let by_distance = ENTRIES.iter().map(|e| (edit_distance(&asked, e.name), e.name)).min();
        let begins =
            ENTRIES.iter().map(|e| e.name).find(|n| asked.len() >= 3 && n.starts_with(&asked));
        let nearest = match by_distance {
            Some((wrong, near)) if wrong as f32 <= Self::WRONG * near.len() as f32 => Some(near),
            _ => begins,
        };
        Self { name: name.to_owned(), nearest }
    }
}

impl fmt::Display for UnknownScene {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "there is no scene `{}`", self.name)?;
        self.nearest.map_or(Ok(()), |nearest| write!(f, "; did you mean `{nearest}`?"))
    }
}

impl std::error::Error for UnknownScene {}

/// Least number of letters to insert, delete or replace (Levenshtein 1966).
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, to) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(from != *to);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suggests_what_was_probably_meant() {
        let meant = |name: &str| find(name).err().and_then(|e| e.nearest);
        assert_eq!(meant("large_piramid"), Some("large_pyramid"));
        assert_eq!(meant("Newton-Cradle"), Some("newton_cradle"));
        assert_eq!(meant("tumbler2"), Some("tumbler"));
        assert_eq!(meant("galton"), Some("galton_board"));
        assert_eq!(meant("xyz"), None);
        assert_eq!(meant(""), None);
        let message = find("dominoes").unwrap_err().to_string();
        assert_eq!(message, "there is no scene `dominoes`; did you mean `domino`?");
    }

    #[test]
    fn words_stand_for_scenes() {
        assert_eq!(resolve("tumbler"), Ok(vec!["tumbler"]));
        assert_eq!(resolve(tags::SCALE), Ok(vec!["circles_10k", "circles_100k", "circles_1m"]));
        let benchmark = resolve(tags::BENCHMARK).unwrap();
        assert!(benchmark.contains(&"rain") && benchmark.contains(&"sleep"));
        assert!(benchmark.contains(&"circles_10k") && !benchmark.contains(&"circles_1m"));
        assert_eq!(resolve("tumbler2").unwrap_err().nearest, Some("tumbler"));
    }

    #[test]
    fn measures_distance() {
        assert_eq!(edit_distance("kitten", "sitting"), 3);
        assert_eq!(edit_distance("", "abc"), 3);
        assert_eq!(edit_distance("abc", ""), 3);
        assert_eq!(edit_distance("same", "same"), 0);
    }
}
