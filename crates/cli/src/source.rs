//! Finding the scene that the user means.

use crate::failure::{Failure, Outcome};
use std::path::Path;
use tiny_physics_scenes::{Entry, Options, Scene, find, resolve};

/// Where a scene comes from.
enum Source<'a> {
    BuiltIn(&'static Entry),
    File(&'a Path),
}

/// The built-in scene of that name, or the scene file at that path.
///
/// # Errors
/// There is neither, or the file is not a scene; with the nearest name where there is one.
pub fn open(name: &str, seed: u64) -> Outcome<Scene> {
    Ok(match find_source(name)? {
        Source::BuiltIn(entry) => entry.build(Options::default().seed(seed)),
        Source::File(path) => Scene::load(path)?,
    })
}

/// The scenes that words stand for: built-in scenes by name or tag, and scene files.
///
/// # Errors
/// A word that stands for nothing.
pub fn names(words: &[String]) -> Outcome<Vec<String>> {
    let mut names = Vec::new();
    for word in words {
        match resolve(word) {
            Ok(built_in) => names.extend(built_in.into_iter().map(str::to_owned)),
            Err(_) => find_source(word).map(|_| names.push(word.clone()))?,
        }
    }
    Ok(names)
}

fn find_source(name: &str) -> Outcome<Source<'_>> {
    let unknown = match find(name) {
        Ok(entry) => return Ok(Source::BuiltIn(entry)),
        Err(unknown) => unknown,
    };
    let path = Path::new(name);
    let looks_like_a_path = name.contains(['/', '\\']) || path.extension().is_some();
    if path.exists() || looks_like_a_path {
        return Ok(Source::File(path));
    }
    let failure = Failure::new(format!("there is no scene and no file called '{name}'"));
    Err(failure.hint(match unknown.nearest {
        Some(near) => format!("did you mean '{near}'? 'tiny-physics list' shows all scenes"),
        None => "'tiny-physics list' shows all scenes".into(),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unknown_names_give_a_hint() {
        let failure = open("seed_demmo", 1).unwrap_err().to_string();
        assert!(failure.contains("'seed_demmo'") && failure.contains("'seed_demo'"), "{failure}");
        let failure = open("nowhere/at_all.json", 1).unwrap_err().to_string();
        assert!(failure.contains("nowhere/at_all.json"), "{failure}");
    }
}
