//! The engine stays light: its lines of code may become fewer, not more. `scripts/budget.sh` prints the rest.

mod common;

use common::sources::{Source, sources};
use std::collections::BTreeMap;

/// Lines of the engine without blanks, comments and tests. Lower it where code has gone; the goal is 16,000.
const MOST_LINES: usize = 32_180;

/// Lines of a file. One subject needs no more.
const MOST_LINES_OF_A_FILE: usize = 600;

/// Lines of a function, and of the median one.
const MOST_LINES_OF_A_FUNCTION: usize = 80;
const MEDIAN_LINES_OF_A_FUNCTION: usize = 8;

fn lines(source: &Source) -> usize {
    source.code.lines().filter(|line| !line.trim().is_empty()).count()
}

/// With `--nocapture` a table by module.
#[test]
fn the_engine_is_no_larger_than_its_budget() {
    let mut modules = BTreeMap::<String, usize>::new();
    for source in sources() {
        let module = source.path.split(['/', '.']).next().unwrap_or_default();
        *modules.entry(module.to_owned()).or_default() += lines(&source);
    }
    println!();
    modules.iter().for_each(|(module, lines)| println!("{lines:>7}  {module}"));
    let total: usize = modules.values().sum();
    println!("{total:>7}  together, of {MOST_LINES}");
    assert!(total <= MOST_LINES, "{total} lines of code, more than {MOST_LINES}");
    assert!(total > 5_000, "{total} lines of code: not all have been found");
}

#[test]
fn files_have_one_subject() {
    let long = sources().into_iter().map(|source| (lines(&source), source.path));
    let long: Vec<_> = long.filter(|&(lines, _)| lines > MOST_LINES_OF_A_FILE).collect();
    assert!(long.is_empty(), "files of more than {MOST_LINES_OF_A_FILE} lines: {long:?}");
}

/// Lines of each function with a body, by its name.
fn functions(code: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    for (start, _) in code.match_indices("fn ") {
        let inside_a_word = code[..start].ends_with(|c: char| c.is_alphanumeric() || c == '_');
        let name = code[start + 3..].split(|c: char| !(c.is_alphanumeric() || c == '_')).next();
        let name = name.filter(|name| !name.is_empty() && !inside_a_word);
        if let (Some(name), Some(length)) = (name, function_length(&code[start..])) {
            let lines = code[start..start + length].lines();
            found.push((lines.filter(|line| !line.trim().is_empty()).count(), name.to_owned()));
        }
    }
    found
}

/// To the end of the braces; `None` for one that is only declared.
fn function_length(code: &str) -> Option<usize> {
    let (mut braces, mut brackets) = (0, 0);
    for (i, c) in code.char_indices() {
        match c {
            '(' | '[' => brackets += 1,
            ')' | ']' => brackets -= 1,
            ';' if braces == 0 && brackets == 0 => return None,
            '{' => braces += 1,
            '}' if braces == 1 => return Some(i + 1),
            '}' => braces -= 1,
            _ => {}
        }
    }
    None
}

#[test]
fn functions_are_short() {
    let of = |source: &Source| {
        let path = source.path.clone();
        let named = move |(lines, name)| (lines, format!("{path}: {name}"));
        functions(&source.code).into_iter().map(named)
    };
    let mut all: Vec<_> = sources().iter().flat_map(of).collect();
    all.sort_unstable();
    assert!(all.len() > 1000, "found only {} functions", all.len());
    let (median, longest) = (all[all.len() / 2].0, &all[all.len() - 1]);
    println!("{} functions, of {median} lines in the median; the longest: {longest:?}", all.len());
    assert!(longest.0 <= MOST_LINES_OF_A_FUNCTION, "{longest:?}");
    assert!(median <= MEDIAN_LINES_OF_A_FUNCTION, "{median} lines in the median");
}

#[test]
fn functions_are_measured_by_their_braces() {
    let code = "fn one() {}\ntrait T {\n fn none(x: [u8; 2]);\n}\nfn three() {\n if x { y }\n}\n";
    let source = Source::new("a.rs", code);
    assert_eq!(functions(&source.code), [(1, "one".to_owned()), (3, "three".to_owned())]);
}

/// Closures that are handed to functions of the standard library are built without the instructions of their kernel, and each
/// of their operations becomes a call: two `array::map` made heaps of hexagons take 1.8 times the instructions.
#[test]
fn kernels_map_no_arrays() {
    let mut count = 0;
    for source in sources() {
        for (start, _) in source.code.match_indices("fn ") {
            let Some(length) = function_length(&source.code[start..]) else { continue };
            let function = &source.code[start..start + length];
            let (head, body) = function.split_once('{').unwrap_or_default();
            let is_kernel = ["Lanes>", ": Lanes", "<L>", "[L; "].iter().any(|of| head.contains(of));
            count += usize::from(is_kernel);
            assert!(!is_kernel || !body.contains(".map(|"), "{}: {head}", source.path);
        }
    }
    assert!(count > 100, "found only {count} kernels");
}

/// Lines of the reading path through the core, and how far off what the page says of its parts may be.
const MOST_LINES_OF_AN_EVENING: usize = 6_850;
const ROUGHLY: usize = 40;

#[test]
fn the_core_in_an_evening_is_as_long_as_it_says() {
    let page =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../ARCHITECTURE.md"))
            .expect("the page");
    let path = page.split("## The core in an evening").nth(1).expect("the reading path");
    let files: BTreeMap<String, usize> =
        sources().iter().map(|s| (s.path.clone(), lines(s))).collect();
    let mut total = 0;
    for row in
        path.split("\n## ").next().unwrap_or_default().lines().filter(|line| line.contains(".rs`"))
    {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let Some(told) = cells.get(3).and_then(|cell| cell.parse::<usize>().ok()) else { continue };
        let named = cells[2].split('`').filter(|name| name.ends_with(".rs"));
        let found: usize = named.map(|name| files[name]).sum();
        assert!(found.abs_diff(told) <= ROUGHLY, "{}: {found} lines, not {told}", cells[1]);
        total += found;
    }
    println!("{total} lines in an evening");
    assert!((5_000..=MOST_LINES_OF_AN_EVENING).contains(&total), "{total} lines in an evening");
}
