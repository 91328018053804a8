//! A tree of JSON text that keeps each number as it was written and knows where each value stands.
//!
//! It serves three ends: to find the line and column of a field, to leave out what equals a default,
//! and to lay a file out so that a person can read it. It only reads text that `serde_json` has already
//! read or written, so it need not explain what is wrong with other text.

/// Lines get no longer than this where they can be broken.
const LINE_WIDTH: usize = 110;

/// A value and the byte at which it starts.
#[derive(Clone, Debug)]
pub(crate) struct Node<'t> {
    start: usize,
    kind: Kind<'t>,
}

#[derive(Clone, Debug)]
enum Kind<'t> {
    /// `null`, a boolean, a number or a string in quotes, as written.
    Plain(&'t str),
    Array(Vec<Node<'t>>),
    /// Keys as written between their quotes.
    Object(Vec<(&'t str, Node<'t>)>),
}

impl<'t> Node<'t> {
    /// Reads a text; `None` where it is not JSON.
    pub(crate) fn parse(text: &'t str) -> Option<Self> {
        let mut reader = Reader { text, at: 0 };
        let node = reader.value(0)?;
        reader.skip_space();
        (reader.at == text.len()).then_some(node)
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

/// Line and column, counted from 1, of a byte of a text.
pub(crate) fn line_column(text: &str, byte: usize) -> (usize, usize) {
    let before = text.get(..byte).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    let column = before.chars().rev().take_while(|c| *c != '\n').count() + 1;
    (line, column)
}

struct Reader<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Reader<'t> {
    /// Deepest nesting, the same as `serde_json` allows.
    const MAX_DEPTH: usize = 128;

    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    fn skip_space(&mut self) {
        while self.peek().is_some_and(|c| c.is_ascii_whitespace()) {
            self.at += 1;
        }
    }

    /// Takes a byte if it is next, after space.
    fn take(&mut self, byte: u8) -> Option<()> {
        self.skip_space();
        (self.peek()? == byte).then(|| self.at += 1)
    }

    fn value(&mut self, depth: usize) -> Option<Node<'t>> {
        if depth > Self::MAX_DEPTH {
            return None;
        }
        self.skip_space();
        let start = self.at;
        let kind = match self.peek()? {
            b'[' => Kind::Array(self.list(b']', |r| r.value(depth + 1))?),
            b'{' => Kind::Object(self.list(b'}', |r| {
                r.skip_space();
                let key = r.string()?;
                r.take(b':')?;
                Some((&key[1..key.len() - 1], r.value(depth + 1)?))
            })?),
            b'"' => Kind::Plain(self.string()?),
            _ => Kind::Plain(self.word()?),
        };
        Some(Node { start, kind })
    }

    /// Items between the bracket that is next and `close`.
    fn list<T>(
        &mut self,
        close: u8,
        mut item: impl FnMut(&mut Self) -> Option<T>,
    ) -> Option<Vec<T>> {
        self.at += 1;
        let mut items = Vec::new();
        if self.take(close).is_some() {
            return Some(items);
        }
        loop {
            items.push(item(self)?);
            if self.take(close).is_some() {
                return Some(items);
            }
            self.take(b',')?;
        }
    }

    /// A string with its quotes.
    fn string(&mut self) -> Option<&'t str> {
        let start = self.at;
        self.take(b'"')?;
        loop {
            match self.peek()? {
                b'"' => {
                    self.at += 1;
                    return self.text.get(start..self.at);
                }
                b'\\' => self.at += 2,
                _ => self.at += 1,
            }
        }
    }

    /// A number, `true`, `false` or `null`.
    fn word(&mut self) -> Option<&'t str> {
        let start = self.at;
        while self.peek().is_some_and(|c| c.is_ascii_alphanumeric() || b"+-.".contains(&c)) {
            self.at += 1;
        }
        (self.at > start).then(|| &self.text[start..self.at])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        for text in
            ["", "{", "[1,]", "{\"a\" 1}", "\"open", "[1 2]", "1 2", "\"\\", &"[".repeat(500)]
        {
            assert!(Node::parse(text).is_none(), "{text}");
        }
    }
}
