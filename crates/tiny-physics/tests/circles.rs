//! No two files of a crate need each other, but for a `mod.rs` and what lies below it: each can be read, and changed,
//! knowing only what it stands on.

mod common;

use common::sources::{Source, sources_below, tokens};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Most names that stand for one another in a row.
const MOST_REEXPORTS: usize = 8;

/// The files of a crate by their module paths; the root has the empty one.
struct Crate {
    files: BTreeMap<Vec<String>, File>,
}

struct File {
    path: String,
    /// Names that stand for something elsewhere: `use a::b as c` is `c` and `a::b`.
    aliases: BTreeMap<String, Vec<String>>,
    /// Modules of which everything is taken over.
    globs: Vec<Vec<String>>,
    /// Paths that the code names.
    paths: BTreeSet<Vec<String>>,
    /// What is declared in it.
    items: BTreeSet<String>,
}

/// The module that a file below `src` is.
fn module_of(path: &str) -> Vec<String> {
    let path = path.strip_suffix(".rs").unwrap_or(path);
    let path = path.strip_suffix("/mod").unwrap_or(path);
    if path == "lib" || path == "main" {
        return Vec::new();
    }
    path.split('/').map(str::to_owned).collect()
}

impl File {
    fn new(source: &Source) -> Self {
        let tokens = tokens(&source.code);
        let mut file = Self {
            path: source.path.clone(),
            aliases: BTreeMap::new(),
            globs: Vec::new(),
            paths: BTreeSet::new(),
            items: items(&tokens),
        };
        let mut i = 0;
        while i < tokens.len() {
            if tokens[i] == "use" {
                let end = i + tokens[i..].iter().take_while(|&&token| token != ";").count();
                file.take_tree(&tokens[i + 1..end], &[]);
                i = end;
            } else if i == 0 || tokens[i - 1] != "::" {
                let path = path_at(&tokens[i..]);
                if path.len() > 1 {
                    file.paths.insert(path);
                }
            }
            i += 1;
        }
        file
    }

    /// Takes in the tree of a `use`, below a path.
    fn take_tree(&mut self, tree: &[&str], above: &[String]) {
        let mut path = above.to_vec();
        let mut i = 0;
        while i < tree.len() && tree[i] != "{" && tree[i] != "as" && tree[i] != "*" {
            if tree[i] != "::" {
                path.push(tree[i].to_owned());
            }
            i += 1;
        }
        match tree.get(i) {
            Some(&"{") => {
                for part in parts(&tree[i + 1..tree.len() - 1]) {
                    self.take_tree(part, &path);
                }
            }
            Some(&"*") => self.globs.push(path),
            after => {
                if path.last().is_some_and(|last| last == "self") {
                    path.pop();
                }
                let name = if after.is_some() { tree[i + 1].to_owned() } else { last_of(&path) };
                self.paths.insert(path.clone());
                self.aliases.insert(name, path);
            }
        }
    }
}

fn last_of(path: &[String]) -> String {
    path.last().cloned().unwrap_or_default()
}

/// The parts of a group between its commas.
fn parts<'a, 'b>(group: &'a [&'b str]) -> Vec<&'a [&'b str]> {
    let (mut depth, mut start, mut parts) = (0, 0, Vec::new());
    for (i, token) in group.iter().enumerate() {
        match *token {
            "{" => depth += 1,
            "}" => depth -= 1,
            "," if depth == 0 => {
                parts.push(&group[start..i]);
                start = i + 1;
            }
            _ => {}
        }
    }
    parts.push(&group[start..]);
    parts.retain(|part| !part.is_empty());
    parts
}

/// The path that begins at a token: names with `::` between.
fn path_at(tokens: &[&str]) -> Vec<String> {
    let is_name = |token: &str| token.starts_with(|c: char| c.is_alphabetic() || c == '_');
    let mut path = Vec::new();
    for pair in tokens.chunks(2) {
        if !is_name(pair[0]) {
            break;
        }
        path.push(pair[0].to_owned());
        if pair.get(1) != Some(&"::") {
            break;
        }
    }
    path
}

/// Names that a file declares.
fn items(tokens: &[&str]) -> BTreeSet<String> {
    const WORDS: [&str; 8] = ["struct", "enum", "fn", "trait", "type", "const", "static", "union"];
    let declared = tokens.windows(2).filter(|pair| WORDS.contains(&pair[0]));
    let macros = tokens.windows(3).filter(|t| t[0] == "macro_rules" && t[1] == "!");
    declared.map(|pair| pair[1]).chain(macros.map(|t| t[2])).map(str::to_owned).collect()
}

impl Crate {
    fn new(sources: &[Source]) -> Self {
        let files = sources.iter().filter(|source| !source.path.starts_with("bin/"));
        Self { files: files.map(|source| (module_of(&source.path), File::new(source))).collect() }
    }

    /// The file in which that is declared what a path means in a module.
    fn find(&self, from: &[String], path: &[String], depth: usize) -> Option<Vec<String>> {
        let mut module = from.to_vec();
        let mut rest = path;
        match path.first().map(String::as_str) {
            Some("crate") => (module, rest) = (Vec::new(), &path[1..]),
            Some("self") => rest = &path[1..],
            Some("super") => {
                while rest.first().is_some_and(|first| first == "super") {
                    module.pop();
                    rest = &rest[1..];
                }
            }
            Some(first) => {
                let file = self.files.get(from)?;
                let child = [from, &[first.to_owned()]].concat();
                let known = self.files.contains_key(&child) || file.aliases.contains_key(first);
                if !known || file.aliases.get(first).is_some_and(|to| to == path) {
                    return None;
                }
            }
            None => return None,
        }
        self.walk(module, rest, depth)
    }

    /// Goes down from a module along names.
    fn walk(&self, mut module: Vec<String>, path: &[String], depth: usize) -> Option<Vec<String>> {
        for (i, name) in path.iter().enumerate() {
            let child = [&module[..], std::slice::from_ref(name)].concat();
            if self.files.contains_key(&child) {
                module = child;
                continue;
            }
            let file = self.files.get(&module)?;
            if depth > 0 && !file.items.contains(name) {
                if let Some(to) = file.aliases.get(name) {
                    let to = [&to[..], &path[i + 1..]].concat();
                    return self.find(&module, &to, depth - 1);
                }
                for glob in &file.globs {
                    let to = [&glob[..], &path[i..]].concat();
                    let found = self.find(&module, &to, depth - 1);
                    if let Some(found) = found.filter(|found| self.declares(found, name)) {
                        return Some(found);
                    }
                }
            }
            break;
        }
        self.files.contains_key(&module).then_some(module)
    }

    /// Is the module this, or does its file declare it?
    fn declares(&self, module: &[String], name: &str) -> bool {
        module.last().is_some_and(|last| last == name) || self.files[module].items.contains(name)
    }

    /// What a file needs, but for files that lie above or below it.
    fn needs(&self, module: &[String]) -> BTreeSet<Vec<String>> {
        let file = &self.files[module];
        let paths = file.paths.iter().chain(&file.globs);
        let found = paths.filter_map(|path| self.find(module, path, MOST_REEXPORTS));
        found.filter(|other| !other.starts_with(module) && !module.starts_with(other)).collect()
    }

    /// Files that need each other, each circle once: which of its files needs which.
    fn circles(&self) -> Vec<String> {
        let needs: Needs = self.files.keys().map(|file| (file, self.needs(file))).collect();
        let reach: BTreeMap<_, _> =
            needs.keys().map(|file| (*file, reached(&needs, file))).collect();
        let name = |module: &Vec<String>| self.files[module].path.clone();
        let mut circles = BTreeSet::new();
        for (file, others) in &reach {
            let others = others.iter().copied();
            let circle: BTreeSet<_> =
                others.filter(|other| reach[*other].contains(*file)).collect();
            let inside = circle.iter().flat_map(|from| {
                let needed = needs[*from].iter().filter(|to| circle.contains(*to));
                needed.map(|to| format!("{} needs {}", name(from), name(to)))
            });
            circles.insert(inside.collect::<Vec<_>>().join(", "));
        }
        circles.into_iter().filter(|circle| !circle.is_empty()).collect()
    }
}

/// What each file needs.
type Needs<'a> = BTreeMap<&'a Vec<String>, BTreeSet<Vec<String>>>;

/// All that a file needs, and what that needs.
fn reached<'a>(needs: &'a Needs<'_>, from: &Vec<String>) -> BTreeSet<&'a Vec<String>> {
    let mut found = BTreeSet::new();
    let mut open: Vec<&Vec<String>> = needs[from].iter().collect();
    while let Some(next) = open.pop() {
        if found.insert(next) {
            open.extend(&needs[next]);
        }
    }
    found
}

/// The folders `src` of all crates of the repository, of every workspace in it.
fn crates() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut found = Vec::new();
    let mut open = vec![root.clone()];
    while let Some(folder) = open.pop() {
        let entries = std::fs::read_dir(&folder).expect("a folder").map(|e| e.expect("an entry"));
        for path in entries.map(|entry| entry.path()).filter(|path| path.is_dir()) {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if name == "src" && folder.join("Cargo.toml").exists() {
                found.push(path);
            } else if !name.starts_with('.') && name != "target" && name != "node_modules" {
                open.push(path);
            }
        }
    }
    found.sort();
    found
}

#[test]
fn no_two_files_need_each_other() {
    let crates = crates();
    assert!(crates.len() >= 10, "found only {crates:?}");
    let mut found = Vec::new();
    for folder in crates {
        let circles = Crate::new(&sources_below(&folder)).circles();
        found.extend(circles.iter().map(|circle| format!("{}: {circle}", folder.display())));
    }
    assert!(found.is_empty(), "files that need each other:\n{}\n", found.join("\n"));
}

fn circles_of(files: &[(&str, &str)]) -> Vec<String> {
    let sources: Vec<_> = files.iter().map(|(path, text)| Source::new(path, text)).collect();
    Crate::new(&sources).circles()
}

#[test]
fn circles_are_found_however_they_are_written() {
    let b = ("b.rs", "use crate::a::A; pub struct B(A);");
    for a in [
        "pub struct A; fn f() -> crate::b::B {}",
        "use super::b::{self, B}; pub struct A(B);",
        "use crate::{b::*}; pub struct A(B);",
        "use crate::B; pub struct A(B);",
        "use crate::Renamed; pub struct A(Renamed);",
        "use crate::c::C; pub struct A(C);",
    ] {
        let root = ("lib.rs", "mod a; mod b; mod c; pub use b::B; pub use b::B as Renamed;");
        let c = ("c/mod.rs", "pub mod d; pub use d::*;");
        let d = ("c/d.rs", "use crate::b; pub struct C(b::B);");
        let circles = circles_of(&[root, ("a.rs", a), b, c, d]);
        assert_eq!(circles.len(), 1, "{a}: {circles:?}");
    }
}

#[test]
fn a_module_and_what_lies_below_it_may_need_each_other() {
    let files = [
        ("lib.rs", "mod a; pub use a::{A, B};"),
        ("a/mod.rs", "mod b; pub use b::B; pub struct A(B);"),
        ("a/b.rs", "use super::A; use crate::c::C; pub struct B(Option<Box<A>>);"),
        ("c.rs", "pub struct C; #[cfg(test)] mod tests { use crate::B; }"),
    ];
    assert_eq!(circles_of(&files), Vec::<String>::new());
}
