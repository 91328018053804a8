//! A tree of JSON text that keeps each number as it was written and knows where each value stands.
//!
//! It serves four ends: to read values from (see [`read`](crate::read())), to find the line and column of a field, to leave
//! out what equals a default, and to lay a file out so that a person can read it.

use crate::fault::Fault;
use std::borrow::Cow;

/// Lines get no longer than this where they can be broken.
const LINE_WIDTH: usize = 110;

/// A value and the byte at which it starts.
#[derive(Clone, Debug)]
pub(crate) struct Node<'t> {
    pub(crate) start: usize,
    pub(crate) kind: Kind<'t>,
}

#[derive(Clone, Debug)]
pub(crate) enum Kind<'t> {
    /// `null`, a boolean, a number or a string in quotes, as written.
    Plain(&'t str),
    Array(Vec<Node<'t>>),
    /// Keys as written between their quotes.
    Object(Vec<(&'t str, Node<'t>)>),
}

impl<'t> Node<'t> {
    /// Reads a text; the error says where it is not JSON.
    pub(crate) fn parse(text: &'t str) -> Result<Self, Fault> {
        let mut reader = Reader { text, at: 0 };
        let node = reader.value(0)?;
        reader.skip_space();
        if reader.at < text.len() { Err(reader.expected("nothing more")) } else { Ok(node) }
    }

    /// Byte at which the value named by a path like `bodies[3].shapes[0].radius` starts, or the deepest
    /// value on the way that is there.
    pub(crate) fn find(&self, path: &str) -> usize {
        let steps =
            path.split(['.', '[']).map(|s| s.trim_end_matches(']')).filter(|s| !s.is_empty());
        let mut node = self;
        for step in steps {
            match node.child(step) {
                Some(child) => node = child,
                None => break,
            }
        }
        node.start
    }

    fn child(&self, step: &str) -> Option<&Self> {
        match &self.kind {
            Kind::Plain(_) => None,
            Kind::Array(items) => items.get(step.parse::<usize>().ok()?),
            Kind::Object(fields) => {
                fields.iter().find(|(key, _)| *key == step).map(|(_, node)| node)
            }
        }
    }

    /// The value of a field of an object.
    pub(crate) fn field_mut(&mut self, name: &str) -> Option<&mut Self> {
        match &mut self.kind {
            Kind::Object(fields) => {
                fields.iter_mut().find(|(key, _)| *key == name).map(|(_, node)| node)
            }
            Kind::Plain(_) | Kind::Array(_) => None,
        }
    }

    /// The items of an array; nothing where it is none.
    pub(crate) fn items_mut(&mut self) -> &mut [Self] {
        match &mut self.kind {
            Kind::Array(items) => items,
            Kind::Plain(_) | Kind::Object(_) => &mut [],
        }
    }

    /// Leaves out the fields that have the same value in `default`, at every depth.
    pub(crate) fn omit_defaults(&mut self, default: &Node<'_>) {
        self.omit_defaults_but(default, "");
    }

    /// The same, but keeps the field `kept` as it is.
    pub(crate) fn omit_defaults_but(&mut self, default: &Node<'_>, kept: &str) {
        let (Kind::Object(fields), Kind::Object(_)) = (&mut self.kind, &default.kind) else {
            return;
        };
        fields.retain_mut(|(key, node)| match default.child(key) {
            Some(other) if *key != kept => {
                let same = node.same(other);
                node.omit_defaults(other);
                !same
            }
            _ => true,
        });
    }

    /// Leaves out the fields that are `null`, at every depth.
    pub(crate) fn omit_nulls(&mut self) {
        match &mut self.kind {
            Kind::Plain(_) => {}
            Kind::Array(items) => items.iter_mut().for_each(Self::omit_nulls),
            Kind::Object(fields) => {
                fields.retain(|(_, node)| !matches!(node.kind, Kind::Plain("null")));
                fields.iter_mut().for_each(|(_, node)| node.omit_nulls());
            }
        }
    }

    fn same(&self, other: &Node<'_>) -> bool {
        match (&self.kind, &other.kind) {
            (Kind::Plain(a), Kind::Plain(b)) => a == b,
            (Kind::Array(a), Kind::Array(b)) => {
                a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.same(b))
            }
            (Kind::Object(a), Kind::Object(b)) => {
                a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.0 == b.0 && a.1.same(&b.1))
            }
            _ => false,
        }
    }

    /// The text, laid out: what fits on a line stands on one line.
    pub(crate) fn pretty(&self) -> String {
        let mut out = String::new();
        self.write(&mut out, 0, 0);
        out.push('\n');
        out
    }

    /// `used` columns of the line are taken by what stands before and after the value.
    fn write(&self, out: &mut String, indent: usize, used: usize) {
        let plain = matches!(self.kind, Kind::Plain(_));
        if plain || (indent > 0 && self.width_up_to(LINE_WIDTH - used.min(LINE_WIDTH)).is_some()) {
            return self.write_line(out);
        }
        let (open, close) =
            if matches!(self.kind, Kind::Array(_)) { ('[', ']') } else { ('{', '}') };
        out.push(open);
        let inner = indent + 2;
        self.for_each(|first, key, node| {
            out.push_str(if first { "\n" } else { ",\n" });
            out.extend(core::iter::repeat_n(' ', inner));
            if let Some(key) = key {
                write_key(out, key);
            }
            node.write(out, inner, inner + key.map_or(0, |k| k.len() + 4) + 1);
        });
        if !out.ends_with(open) {
            out.push('\n');
            out.extend(core::iter::repeat_n(' ', indent));
        }
        out.push(close);
    }

    fn write_line(&self, out: &mut String) {
        match &self.kind {
            Kind::Plain(text) => out.push_str(text),
            Kind::Array(_) => {
                out.push('[');
                self.for_each(|first, _, node| {
                    out.push_str(if first { "" } else { ", " });
                    node.write_line(out);
                });
                out.push(']');
            }
            Kind::Object(fields) => {
                out.push_str(if fields.is_empty() { "{" } else { "{ " });
                self.for_each(|first, key, node| {
                    out.push_str(if first { "" } else { ", " });
                    write_key(out, key.unwrap_or_default());
                    node.write_line(out);
                });
                out.push_str(if fields.is_empty() { "}" } else { " }" });
            }
        }
    }

    /// Columns that the value takes on one line, if not more than `limit`.
    fn width_up_to(&self, limit: usize) -> Option<usize> {
        let mut width = if let Kind::Plain(text) = &self.kind { text.len() } else { 2 };
        let mut fits = width <= limit;
        self.for_each(|first, key, node| {
            width += if first { 0 } else { 2 } + key.map_or(0, |k| k.len() + 5);
            if fits && width <= limit {
                fits = node.width_up_to(limit - width).is_some_and(|w| {
                    width += w;
                    true
                });
            } else {
                fits = false;
            }
        });
        fits.then_some(width)
    }

    fn for_each(&self, mut f: impl FnMut(bool, Option<&str>, &Self)) {
        match &self.kind {
            Kind::Plain(_) => {}
            Kind::Array(items) => items.iter().enumerate().for_each(|(i, n)| f(i == 0, None, n)),
            Kind::Object(fields) => {
                fields.iter().enumerate().for_each(|(i, (k, n))| f(i == 0, Some(k), n));
            }
        }
    }
}

fn write_key(out: &mut String, key: &str) {
    out.push('"');
    out.push_str(key);
    out.push_str("\": ");
}

struct Reader<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Reader<'t> {
    /// Deepest nesting.
    const MAX_DEPTH: usize = 128;

    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    fn skip_space(&mut self) {
        while self.peek().is_some_and(|c| b" \t\n\r".contains(&c)) {
            self.at += 1;
        }
    }

    /// What was expected is not there.
    #[cold]
    fn expected(&self, what: &str) -> Fault {
        let end = if self.at < self.text.len() { "" } else { "; the text ends here" };
        Fault::new(format!("expected {what}{end}")).at(self.at)
    }

    /// Takes a byte if it is next, after space.
    fn take(&mut self, byte: u8) -> bool {
        self.skip_space();
        let there = self.peek() == Some(byte);
        self.at += usize::from(there);
        there
    }

    fn value(&mut self, depth: usize) -> Result<Node<'t>, Fault> {
        if depth > Self::MAX_DEPTH {
            return Err(Fault::new("it is nested too deeply".to_owned()).at(self.at));
        }
        self.skip_space();
        let start = self.at;
        let kind = match self.peek() {
            Some(b'[') => Kind::Array(self.list(b']', |reader, index| {
                reader.value(depth + 1).map_err(|fault| fault.in_item(index))
            })?),
            Some(b'{') => Kind::Object(self.list(b'}', |reader, _| reader.field(depth))?),
            Some(b'"') => Kind::Plain(self.string()?),
            _ => Kind::Plain(self.word()?),
        };
        Ok(Node { start, kind })
    }

    fn field(&mut self, depth: usize) -> Result<(&'t str, Node<'t>), Fault> {
        self.skip_space();
        if self.peek() != Some(b'"') {
            return Err(self.expected("a field: a key must be a string"));
        }
        let key = self.string()?;
        let key = &key[1..key.len() - 1];
        if !self.take(b':') {
            return Err(self.expected("`:`"));
        }
        let value = self.value(depth + 1).map_err(|fault| fault.in_field(&unescaped(key)))?;
        Ok((key, value))
    }

    /// Items between the bracket that is next and `close`.
    fn list<T>(
        &mut self,
        close: u8,
        mut item: impl FnMut(&mut Self, usize) -> Result<T, Fault>,
    ) -> Result<Vec<T>, Fault> {
        self.at += 1;
        let mut items = Vec::new();
        if self.take(close) {
            return Ok(items);
        }
        loop {
            items.push(item(self, items.len())?);
            if self.take(close) {
                return Ok(items);
            }
            if !self.take(b',') {
                return Err(self.expected(&format!("`,` or `{}`", char::from(close))));
            }
        }
    }

    /// A string with its quotes.
    fn string(&mut self) -> Result<&'t str, Fault> {
        let start = self.at;
        self.at += 1;
        loop {
            match self.peek() {
                Some(b'"') => {
                    self.at += 1;
                    return Ok(&self.text[start..self.at]);
                }
                Some(b'\\') => match escape(&self.text.as_bytes()[self.at..]) {
                    Some((_, length)) => self.at += length,
                    None => return Err(self.expected("an escape of JSON")),
                },
                Some(32..) => self.at += 1,
                _ => return Err(self.expected("the end of a string")),
            }
        }
    }

    /// A number, `true`, `false` or `null`.
    fn word(&mut self) -> Result<&'t str, Fault> {
        let rest = &self.text[self.at..];
        let inside = |c: char| c.is_ascii_alphanumeric() || "+-.".contains(c);
        let word = &rest[..rest.find(|c| !inside(c)).unwrap_or(rest.len())];
        if !matches!(word, "true" | "false" | "null") && !is_number(word.as_bytes()) {
            return Err(self.expected("value"));
        }
        self.at += word.len();
        Ok(word)
    }
}

/// Is it a number by the grammar of JSON, which has no `+1`, `01`, `1.` and `.5`?
fn is_number(text: &[u8]) -> bool {
    let digits = |text: &[u8]| text.iter().take_while(|c| c.is_ascii_digit()).count();
    let text = text.strip_prefix(b"-").unwrap_or(text);
    let whole = digits(text);
    if whole == 0 || (whole > 1 && text[0] == b'0') {
        return false;
    }
    let mut rest = &text[whole..];
    if let Some(fraction) = rest.strip_prefix(b".") {
        let count = digits(fraction);
        if count == 0 {
            return false;
        }
        rest = &fraction[count..];
    }
    if let [b'e' | b'E', exponent @ ..] = rest {
        let exponent = match exponent {
            [b'+' | b'-', exponent @ ..] => exponent,
            _ => exponent,
        };
        return !exponent.is_empty() && digits(exponent) == exponent.len();
    }
    rest.is_empty()
}

/// The character of an escape at the beginning of a text, and its bytes.
fn escape(text: &[u8]) -> Option<(char, usize)> {
    let plain = |c| Some((c, 2));
    match text.get(1)? {
        b'n' => plain('\n'),
        b't' => plain('\t'),
        b'r' => plain('\r'),
        b'b' => plain('\u{8}'),
        b'f' => plain('\u{c}'),
        c @ (b'"' | b'\\' | b'/') => plain(char::from(*c)),
        b'u' => {
            let high = code_unit(text)?;
            if let Some(c) = char::from_u32(high) {
                return Some((c, 6));
            }
            let low = code_unit(text.get(6..)?)?;
            let mut pair = char::decode_utf16([high as u16, low as u16]);
            Some((pair.next()?.ok()?, 12))
        }
        _ => None,
    }
}

/// The number of an escape like `\u00e9`.
fn code_unit(text: &[u8]) -> Option<u32> {
    let [b'\\', b'u', digits @ ..] = text else { return None };
    let digits = digits.get(..4)?.iter();
    digits.map(|c| char::from(*c).to_digit(16)).try_fold(0, |all, digit| Some(all * 16 + digit?))
}

/// What a string of a text that has been read says: without quotes and escapes.
pub(crate) fn unescaped(text: &str) -> Cow<'_, str> {
    let text = text.strip_prefix('"').and_then(|text| text.strip_suffix('"')).unwrap_or(text);
    if !text.contains('\\') {
        return Cow::Borrowed(text);
    }
    let (mut plain, mut rest) = (String::new(), text);
    while let Some(at) = rest.find('\\') {
        plain.push_str(&rest[..at]);
        let Some((c, length)) = escape(&rest.as_bytes()[at..]) else { break };
        plain.push(c);
        rest = &rest[at + length..];
    }
    plain.push_str(rest);
    Cow::Owned(plain)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fault::line_column;

    const TEXT: &str = "{\n  \"a\": [1.50, {\"b\": \"x\\\"]\"}],\n  \"c\": null\n}";

    #[test]
    fn finds_values_by_path() {
        let node = Node::parse(TEXT).unwrap();
        assert_eq!(line_column(TEXT, node.find("")), (1, 1));
        assert_eq!(line_column(TEXT, node.find("a[1].b")), (2, 21));
        assert_eq!(
            line_column(TEXT, node.find("a[1].missing.deeper")),
            (2, 15),
            "the deepest that is there"
        );
        assert_eq!(line_column(TEXT, node.find("c")), (3, 8));
    }

    #[test]
    fn omits_and_lays_out() {
        let mut node = Node::parse(TEXT).unwrap();
        assert_eq!(node.pretty(), "{\n  \"a\": [1.50, { \"b\": \"x\\\"]\" }],\n  \"c\": null\n}\n");
        node.omit_nulls();
        assert_eq!(node.pretty(), "{\n  \"a\": [1.50, { \"b\": \"x\\\"]\" }]\n}\n");
        let default = Node::parse("{\"a\": [1.50, {\"b\": \"x\\\"]\"}]}").unwrap();
        node.omit_defaults(&default);
        assert_eq!(node.pretty(), "{}\n");
    }

    #[test]
    fn breaks_long_lines_and_keeps_short_ones() {
        let text = format!(
            "{{\"long\":[{}],\"short\":[1,2],\"empty\":[]}}",
            vec!["[1.25,2.5]"; 20].join(",")
        );
        let pretty = Node::parse(&text).unwrap().pretty();
        assert!(pretty.lines().all(|l| l.len() <= LINE_WIDTH));
        assert!(pretty.contains("    [1.25, 2.5],\n"));
        assert!(pretty.contains("\"short\": [1, 2],\n  \"empty\": []\n"));
    }

    #[test]
    fn refuses_what_is_not_json() {
        for text in [
            "",
            "{",
            "[1,]",
            "{\"a\" 1}",
            "\"open",
            "[1 2]",
            "1 2",
            "\"\\",
            &"[".repeat(500),
            "+1",
            "01",
            "1.",
            ".5",
            "1e",
            "-",
            "nan",
            "\"\\x\"",
            "\"\\ud800\"",
            "\"\n\"",
            "\u{c}1",
            "{1: 2}",
        ] {
            assert!(Node::parse(text).is_err(), "{text}");
        }
    }

    #[test]
    fn strings_lose_their_escapes_and_numbers_have_the_grammar_of_json() {
        let text = r#""a\"b\\\/\n\u00e9\ud83d\ude00z""#;
        assert!(Node::parse(text).is_ok());
        assert_eq!(unescaped(text), "a\"b\\/\n\u{e9}\u{1f600}z");
        for number in ["0", "-0", "10.5", "-1e5", "1E+5", "2.5e-30"] {
            assert!(Node::parse(number).is_ok(), "{number}");
        }
    }
}
