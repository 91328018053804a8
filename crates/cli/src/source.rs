//! Finding the scene that the user means.

use crate::failure::{Failure, Outcome};
use std::path::Path;
use tiny_physics_scenes::{Options, Scene, all, find};

/// The built-in scene of that name, or the scene file at that path.
///
/// # Errors
/// There is neither, or the file is not a scene; with the nearest name where there is one.
pub fn open(name: &str, seed: u64) -> Outcome<Scene> {
    if let Some(entry) = find(name) {
        return Ok(entry.build(Options::default().seed(seed)));
    }
    let path = Path::new(name);
    let looks_like_a_path = name.contains(['/', '\\']) || path.extension().is_some();
    if path.exists() || looks_like_a_path {
        return Ok(Scene::load(path)?);
    }
    let names: Vec<_> = all().iter().map(|entry| entry.name).collect();
    Err(unknown(name, &names))
}

fn unknown(name: &str, names: &[&str]) -> Failure {
    let failure = Failure::new(format!("there is no scene and no file called '{name}'"));
    failure.hint(match nearest(name, names) {
        Some(near) => format!("did you mean '{near}'? 'tiny-physics list' shows all scenes"),
        None => "'tiny-physics list' shows all scenes".into(),
    })
}

/// The most similar name, if any is similar at all.
fn nearest<'a>(name: &str, names: &[&'a str]) -> Option<&'a str> {
    let name = name.to_lowercase().replace('-', "_");
    let similar = |other: &&str| strsim::jaro_winkler(&name, other);
    let best = names.iter().max_by(|a, b| similar(a).total_cmp(&similar(b)))?;
    (similar(best) > 0.75).then_some(*best)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_of_the_finger_are_understood() {
        let names = ["seed_demo", "large_pyramid", "tumbler", "rain"];
        assert_eq!(nearest("tumbelr", &names), Some("tumbler"));
        assert_eq!(nearest("Large-Pyramids", &names), Some("large_pyramid"));
        assert_eq!(nearest("xyzzy", &names), None);
    }

    #[test]
    fn unknown_names_give_a_hint() {
        let failure = open("seed_demmo", 1).unwrap_err().to_string();
        assert!(failure.contains("'seed_demmo'") && failure.contains("'seed_demo'"), "{failure}");
        let failure = open("nowhere/at_all.json", 1).unwrap_err().to_string();
        assert!(failure.contains("nowhere/at_all.json"), "{failure}");
    }
}
