//! Reads the engine's sources.

use std::fs;
use std::path::{Path, PathBuf};

/// One source file.
pub struct Source {
    /// Below `src`.
    pub path: String,
    /// Without comments, strings and tests.
    pub code: String,
}

impl Source {
    /// By its path below `src` and its text.
    pub fn new(path: &str, text: &str) -> Self {
        Self { path: path.to_owned(), code: without_tests(&without_comments(text)) }
    }
}

/// Words, `::`, and every other sign by itself.
pub fn tokens(code: &str) -> Vec<&str> {
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
pub fn sources() -> Vec<Source> {
    sources_below(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"))
}

/// The same of any crate, by its folder `src`.
pub fn sources_below(root: &Path) -> Vec<Source> {
    let (mut folders, mut files) = (vec![root.to_owned()], Vec::<PathBuf>::new());
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
            let below = file.strip_prefix(root).expect("below src");
            let path: Vec<_> = below.iter().map(|part| part.to_string_lossy()).collect();
            Source::new(&path.join("/"), &fs::read_to_string(file).expect("a source"))
        })
        .filter(|source| !source.path.contains("tests"))
        .collect()
}

impl Source {
    /// Public functions that can change a world, as `Type::name`: those that take `&mut World`, and those that take
    /// `&mut self` of a type whose name is listed.
    pub fn changing_functions(&self, types: &[&str]) -> Vec<String> {
        let tokens = tokens(&self.code);
        let (mut found, mut depth, mut block) = (Vec::new(), 0, None::<(String, usize)>);
        for (i, token) in tokens.iter().enumerate() {
            match *token {
                "impl" if block.is_none() => block = implemented(&tokens[i..]).map(|t| (t, depth)),
                "{" => depth += 1,
                "}" => {
                    depth -= 1;
                    block = block.filter(|(_, outside)| *outside < depth);
                }
                "pub" if tokens.get(i + 1) == Some(&"fn") => {
                    let owner = block.as_ref().map_or("", |(name, _)| name.as_str());
                    let borrowed = borrowed_to_change(&tokens[i..]);
                    if borrowed.contains(&"World")
                        || borrowed.contains(&"self") && types.contains(&owner)
                    {
                        found.push(format!("{owner}::{}", tokens[i + 2]));
                    }
                }
                _ => {}
            }
        }
        found
    }

    /// Names directly inside the braces of a public `enum` or `struct`: variants, or public fields.
    pub fn members(&self, of: &str) -> Vec<String> {
        let tokens = tokens(&self.code);
        let start = tokens.windows(3).position(|t| t[0] == "pub" && t[2] == of);
        let Some(start) = start else { return Vec::new() };
        let is_struct = tokens[start + 1] == "struct";
        let open = start + tokens[start..].iter().take_while(|&&token| token != "{").count();
        let (mut depth, mut names) = (0, Vec::new());
        for i in open..tokens.len() {
            let before = if is_struct { "pub" } else { "," };
            let begins = tokens[i - 1] == before || tokens[i - 1] == "{" && !is_struct;
            match tokens[i] {
                "{" | "(" | "[" | "<" => depth += 1,
                "}" | ")" | "]" | ">" => depth -= 1,
                name if depth == 1 && begins => names.push(name.to_owned()),
                _ => {}
            }
            if depth == 0 {
                break;
            }
        }
        names
    }
}

/// The type that functions follow for; `None` for those of a trait.
fn implemented(tokens: &[&str]) -> Option<String> {
    let header: Vec<_> = tokens.iter().take_while(|&&token| token != "{").collect();
    let generic = header.get(1) == Some(&&"<");
    let end = if generic { header.iter().position(|token| **token == ">")? } else { 0 };
    let name = header.get(end + 1)?;
    (!header.contains(&&"for")).then(|| (**name).to_owned())
}

/// What a function borrows to change: `self`, or types of parameters.
fn borrowed_to_change<'a>(function: &[&'a str]) -> Vec<&'a str> {
    let open = function.iter().take_while(|&&token| token != "(").count();
    let mut depth = 0;
    let parameters = function[open..].iter().take_while(|&&token| {
        depth += i32::from(token == "(") - i32::from(token == ")");
        depth > 0
    });
    let parameters: Vec<&str> = parameters.copied().collect();
    let muts = (1..parameters.len()).filter(|&i| parameters[i] == "mut");
    let borrowed = muts.filter(|&i| parameters[i - 1] == "&" || parameters[i.max(2) - 2] == "'");
    borrowed.filter_map(|i| parameters.get(i + 1).copied()).collect()
}
