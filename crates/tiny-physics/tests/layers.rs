//! Reads the engine's sources and checks the rules of the house: no layer knows an upper one, `unsafe` is
//! in `threads` alone, and nothing is computed in a way that platforms or runs differ in.

mod common;

use common::sources::{Source, sources, tokens};

/// The layers, lowest first. Modules of one layer may know each other.
const LAYERS: [&[&str]; 9] = [
    &["error", "math", "codec", "footprint", "work"],
    &["simd", "threads"],
    &["geometry"],
    &["broad_phase"],
    &["describe"],
    &["dynamics"],
    &["stages"],
    &["world"],
    &["play", "prelude"],
];

/// What stands on the public API alone.
const PLAY: &str = "play";

/// The modules that it may name: the public ones, itself, and the codec for what it writes to files.
const OPEN_TO_PLAY: [&str; 5] = ["math", "geometry", "broad_phase", "codec", PLAY];

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

impl Source {
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
        found.extend(self.imports_from_the_inside());
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

    /// Modules of the inside, named by what stands on the public API alone.
    fn imports_from_the_inside(&self) -> Vec<String> {
        let names = if self.module() == PLAY { self.root_names() } else { vec![] };
        names
            .into_iter()
            .filter(|name| layer(name).is_some() && !OPEN_TO_PLAY.contains(&name.as_str()))
            .map(|name| format!("imports `crate::{name}`, which is no public API"))
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

#[test]
fn the_engine_keeps_the_rules_of_the_house() {
    let sources = sources();
    assert!(sources.len() > 20, "found only {} files", sources.len());
    let violations: Vec<_> = sources.iter().flat_map(Source::violations).collect();
    assert!(violations.is_empty(), "\n{}\n", violations.join("\n"));
}

/// Files that the page names, by their paths below `src`.
fn named_files(page: &str) -> Vec<&str> {
    let quoted = page.split('`').skip(1).step_by(2);
    quoted.filter(|name| name.ends_with(".rs") && name.contains('/')).collect()
}

#[test]
fn files_that_the_architecture_names_are_there() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    for page in ["ARCHITECTURE.md", "CONTRIBUTING.md"] {
        let text = std::fs::read_to_string(root.join("../..").join(page)).expect("a page");
        let files = named_files(&text);
        assert!(files.len() > 10, "{page} names only {files:?}");
        let places = ["src", ".", "../.."].map(|place| root.join(place));
        let there = |file: &&str| places.iter().any(|place| place.join(file).exists());
        let gone: Vec<_> = files.into_iter().filter(|file| !there(file)).collect();
        assert!(gone.is_empty(), "{page} names files that are not there: {gone:?}");
    }
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
fn what_stands_on_the_public_api_names_no_inside() {
    for import in ["use crate::dynamics::Bodies;", "use super::super::{stages, math};"] {
        let source = Source::new("play/mover.rs", import);
        assert_eq!(source.violations().len(), 1, "{import}: {:?}", source.violations());
    }
    let code = "use crate::{World, Vec2}; use crate::math::sin_cos; use super::record::Command;";
    assert_eq!(Source::new("play/mover.rs", code).violations(), Vec::<String>::new());
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
