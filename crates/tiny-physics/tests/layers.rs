//! Reads the engine's sources and checks the rules of the house: no layer knows an upper one, `unsafe` is
//! in `threads` alone, and nothing is computed in a way that platforms or runs differ in.

use std::fs;
use std::path::{Path, PathBuf};

/// The layers, lowest first. Modules of one layer may know each other.
const LAYERS: [&[&str]; 9] = [
    &["error", "math", "codec", "footprint"],
    &["simd", "threads"],
    &["geometry"],
    &["broad_phase"],
    &["describe", "debug_draw"],
    &["dynamics"],
    &["stages"],
    &["world", "fixed_step"],
    &["record"],
];

/// The one module that may say `unsafe`.
const UNSAFE_MODULE: &str = "threads";

/// Their order is another in every run.
const HASHED: [&str; 2] = ["HashMap", "HashSet"];

/// The one file that may name them: it asks what is in them, for checks, and never goes through them.
const HASHED_FILE: &str = "world/validate.rs";

/// Methods whose last bits differ between platforms, or between a function and its fused twin.
const INEXACT: [&str; 29] = [
    "sin",
    "cos",
    "tan",
    "asin",
    "acos",
    "atan",
    "atan2",
    "sin_cos",
    "sinh",
    "cosh",
    "tanh",
    "asinh",
    "acosh",
    "atanh",
    "exp",
    "exp2",
    "exp_m1",
    "ln",
    "ln_1p",
    "log",
    "log2",
    "log10",
    "powf",
    "powi",
    "cbrt",
    "hypot",
    "mul_add",
    "mul_sub",
    "relaxed_simd",
];

/// One source file: its path below `src`, and its code without comments, strings and tests.
struct Source {
    path: String,
    code: String,
}

impl Source {
    fn new(path: &str, text: &str) -> Self {
        Self { path: path.to_owned(), code: without_tests(&without_comments(text)) }
    }

    /// The top module that the file belongs to; `lib` for the crate's root.
    fn module(&self) -> &str {
        let first = self.path.split('/').next().unwrap_or_default();
        first.strip_suffix(".rs").unwrap_or(first)
    }

    /// How many modules lie between the file and the crate's root, itself included.
    fn depth(&self) -> usize {
        let parts = self.path.split('/').count();
        if self.path.ends_with("mod.rs") { parts - 1 } else { parts }
    }

    fn violations(&self) -> Vec<String> {
        let mut found = Vec::new();
        found.extend(self.upward_imports());
        found.extend(self.unsafe_code());
        found.extend(self.inexact_methods());
        found.extend(self.hashed());
        found.iter().map(|what| format!("{}: {what}", self.path)).collect()
    }

    /// Names reached from the crate's root that lie above the file's own layer.
    fn upward_imports(&self) -> Vec<String> {
        let Some(own) = layer(self.module()) else {
            let known = self.module() == "lib";
            return if known { vec![] } else { vec![format!("`{}` has no layer", self.module())] };
        };
        self.root_names()
            .into_iter()
            // What is no module is a re-export of lib.rs: that is above everything but the world.
            .filter(|name| layer(name).unwrap_or(LAYERS.len() - 1) > own)
            .map(|name| format!("imports `crate::{name}`, which is above `{}`", self.module()))
            .collect()
    }

    /// Every name that follows `crate::`, or as many `super::` as lead to the crate's root.
    fn root_names(&self) -> Vec<String> {
        let tokens = tokens(&self.code);
        let mut names = Vec::new();
        for (i, token) in tokens.iter().enumerate() {
            let inside_path = i > 0 && tokens[i - 1] == "::";
            let start = match *token {
                "crate" if !inside_path => i + 1,
                "super" if !inside_path => {
                    let supers =
                        tokens[i..].chunks(2).take_while(|pair| pair[0] == "super").count();
                    if supers < self.depth() {
                        continue;
                    }
                    i + 2 * self.depth() - 1
                }
                _ => continue,
            };
            if tokens.get(start) == Some(&"::") {
                names.extend(first_names(&tokens[start + 1..]));
            }
        }
        names
    }

    fn unsafe_code(&self) -> Option<String> {
        let says_unsafe = tokens(&self.code).contains(&"unsafe");
        (says_unsafe && self.module() != UNSAFE_MODULE).then(|| "says `unsafe`".to_owned())
    }

    fn inexact_methods(&self) -> Vec<String> {
        let tokens = tokens(&self.code);
        let calls = tokens.windows(3).filter(|t| {
            let called = (t[0] == "." || t[0] == "::") && t[2] == "(";
            called && (INEXACT.contains(&t[1]) || t[1].starts_with("approximate_"))
        });
        // `trig::sin` and its like are our own.
        let foreign = calls.filter(|t| t[0] == "." || self.calls_on_primitive(t[1]));
        foreign.map(|t| format!("calls `{}`, whose bits depend on the platform", t[1])).collect()
    }

    fn hashed(&self) -> Option<String> {
        let named = tokens(&self.code).iter().any(|token| HASHED.contains(token));
        let what = "names a hash map, whose order differs from run to run";
        (named && self.path != HASHED_FILE).then(|| what.to_owned())
    }

    fn calls_on_primitive(&self, method: &str) -> bool {
        ["f32", "f64"].iter().any(|float| self.code.contains(&format!("{float}::{method}(")))
    }
}

fn layer(module: &str) -> Option<usize> {
    LAYERS.iter().position(|modules| modules.contains(&module))
}

/// The first names of a path: one, or several where a group in braces follows.
fn first_names(tokens: &[&str]) -> Vec<String> {
    if tokens.first() != Some(&"{") {
        return tokens.first().map(|&name| name.to_owned()).into_iter().collect();
    }
    let (mut depth, mut names, mut at_start) = (0, Vec::new(), false);
    for &token in tokens {
        match token {
            "{" => depth += 1,
            "}" => depth -= 1,
            "," => {}
            name if depth == 1 && at_start => names.push(name.to_owned()),
            _ => {}
        }
        at_start = depth == 1 && (token == "," || token == "{");
        if depth == 0 {
            break;
        }
    }
    names
}

/// Words, `::`, and every other sign by itself.
fn tokens(code: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let mut rest = code.trim_start();
    while let Some(first) = rest.chars().next() {
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        let length = match first {
            c if is_word(c) => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
            ':' if rest.starts_with("::") => 2,
            c => c.len_utf8(),
        };
        let (token, after) = rest.split_at(length);
        tokens.push(token);
        rest = after.trim_start();
    }
    tokens
}

/// The code alone: comments are gone, strings and characters are empty.
fn without_comments(text: &str) -> String {
    let (mut code, mut rest) = (String::with_capacity(text.len()), text);
    while let Some(first) = rest.chars().next() {
        let skipped = match first {
            '/' if rest.starts_with("//") => rest.find('\n').unwrap_or(rest.len()),
            '/' if rest.starts_with("/*") => block_comment(rest),
            'r' if raw_string(rest).is_some() => raw_string(rest).unwrap_or(1),
            '"' => quoted(rest, '"'),
            '\'' if is_character(rest) => quoted(rest, '\''),
            _ => 0,
        };
        if skipped == 0 {
            code.push(first);
            rest = &rest[first.len_utf8()..];
        } else {
            code.push(' ');
            rest = &rest[skipped..];
        }
    }
    code
}

fn block_comment(text: &str) -> usize {
    let mut depth = 0;
    for (i, _) in text.char_indices() {
        if text[i..].starts_with("/*") {
            depth += 1;
        } else if text[i..].starts_with("*/") {
            depth -= 1;
            if depth == 0 {
                return i + 2;
            }
        }
    }
    text.len()
}

/// Length of the raw string that the text starts with.
fn raw_string(text: &str) -> Option<usize> {
    let hashes = text[1..].chars().take_while(|&c| c == '#').count();
    text[1 + hashes..].strip_prefix('"')?;
    let end = format!("\"{}", "#".repeat(hashes));
    let start = 2 + hashes;
    Some(text[start..].find(&end).map_or(text.len(), |i| start + i + end.len()))
}

fn quoted(text: &str, quote: char) -> usize {
    let mut escaped = false;
    for (i, c) in text.char_indices().skip(1) {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            c if c == quote => return i + 1,
            _ => {}
        }
    }
    text.len()
}

/// A character in quotes, not a lifetime.
fn is_character(text: &str) -> bool {
    let mut chars = text.chars().skip(1);
    chars.next() == Some('\\') || chars.next() == Some('\'')
}

/// The code without items that only tests see.
fn without_tests(code: &str) -> String {
    let mut kept = String::with_capacity(code.len());
    let mut rest = code;
    while let Some(start) = rest.find("#[cfg(test)]").or_else(|| rest.find("#[cfg(all(test")) {
        kept.push_str(&rest[..start]);
        rest = &rest[start..];
        rest = &rest[item_length(rest)..];
    }
    kept + rest
}

/// Length of an item: to its semicolon, or to the end of its braces.
fn item_length(code: &str) -> usize {
    let mut depth = 0;
    for (i, c) in code.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 && (c == ';' || c == '}') {
            return i + 1;
        }
    }
    code.len()
}

/// All sources of the engine but those that only tests see.
fn sources() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let (mut folders, mut files) = (vec![root.clone()], Vec::<PathBuf>::new());
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder of sources") {
            let path = entry.expect("an entry").path();
            match path.extension() {
                _ if path.is_dir() => folders.push(path),
                Some(extension) if extension == "rs" => files.push(path),
                _ => {}
            }
        }
    }
    files.sort();
    files
        .iter()
        .map(|file| {
            let below = file.strip_prefix(&root).expect("below src");
            let path: Vec<_> = below.iter().map(|part| part.to_string_lossy()).collect();
            Source::new(&path.join("/"), &fs::read_to_string(file).expect("a source"))
        })
        .filter(|source| !source.path.contains("tests"))
        .collect()
}

#[test]
fn the_engine_keeps_the_rules_of_the_house() {
    let sources = sources();
    assert!(sources.len() > 20, "found only {} files", sources.len());
    let violations: Vec<_> = sources.iter().flat_map(Source::violations).collect();
    assert!(violations.is_empty(), "\n{}\n", violations.join("\n"));
}

#[test]
fn every_module_of_the_crate_has_a_layer() {
    for source in sources().iter().filter(|source| source.module() != "lib") {
        assert!(layer(source.module()).is_some(), "{} has no layer", source.path);
    }
}

#[test]
fn an_import_from_above_is_found_however_it_is_written() {
    for import in [
        "use crate::world::World;",
        "use crate::{math::Vec2, world::World};",
        "use crate::{\n    math::{Aabb, Vec2},\n    stages::{self, pairs},\n};",
        "fn f(world: &crate::world::World) {}",
        "use super::super::world::World;",
        "use crate::World;",
        "use super::super::{math, dynamics::Bodies};",
        "pub(crate) use crate :: dynamics :: Bodies;",
    ] {
        let source = Source::new("geometry/shape.rs", import);
        assert_eq!(source.violations().len(), 1, "{import}: {:?}", source.violations());
    }
}

#[test]
fn what_is_allowed_is_not_found() {
    for code in [
        "use crate::math::Vec2;",
        "use crate::geometry::Shape; use super::polygon::Polygon; use super::*;",
        "use crate::{error::Error, math::{Aabb, Vec2}, simd};",
        "//! See [`World`](crate::world::World).\n/// And crate::world.\nstruct S;",
        "/* use crate::world::World; /* unsafe */ */",
        "const NAME: &str = \"crate::world::World \\\" unsafe\";",
        "const RAW: &str = r#\"unsafe { \"x\".sin() }\"#;",
        "#[cfg(test)]\nmod tests {\n use crate::world::World;\n fn f(x: f32) -> f32 { x.sin() }\n}",
        "#[cfg(test)]\nuse crate::world::World;\nstruct S;",
        "#![allow(unsafe_code)]",
        "fn f<'a>(x: &'a str) -> char { '\"' } // unsafe",
        "const QUOTES: [char; 2] = ['\\'', '\"']; // unsafe \" unsafe",
        "fn f(x: f32) -> f32 { math::sin(x) + trig::cos(x) + x.sqrt() }",
    ] {
        let source = Source::new("geometry/shape.rs", code);
        assert_eq!(source.violations(), Vec::<String>::new(), "{code}");
    }
}

#[test]
fn unsafe_outside_its_module_is_found() {
    let code = "fn f() { unsafe { g() } }";
    assert_eq!(Source::new("world/mod.rs", code).violations().len(), 1);
    assert_eq!(Source::new("threads/pool.rs", code).violations().len(), 0);
}

#[test]
fn methods_that_differ_between_platforms_are_found() {
    for code in [
        "fn f(x: f32) -> f32 { x.sin() }",
        "fn f(x: f32) -> f32 { x\n    .powf(2.0) }",
        "fn f(x: f32) -> f32 { f32::atan2(x, 1.0) }",
        "fn f(x: f32) -> f32 { x.mul_add(x, x) }",
        "fn f(x: f32x4) -> f32x4 { x.approximate_recip() }",
    ] {
        assert_eq!(Source::new("math/trig.rs", code).violations().len(), 1, "{code}");
    }
}

#[test]
fn hash_maps_are_found() {
    let code = "use std::collections::{BTreeMap, HashMap};";
    assert_eq!(Source::new("stages/pairs.rs", code).violations().len(), 1);
    assert_eq!(Source::new(HASHED_FILE, code).violations().len(), 0);
}

#[test]
fn a_module_without_a_layer_is_found() {
    assert_eq!(Source::new("cellar.rs", "struct S;").violations().len(), 1);
}
