//! What is wrong with a text, and where in it.

use crate::error::{Problem, SceneError};
use core::fmt;
use serde::de::{self, Unexpected};

/// What is wrong with a text, and where.
#[derive(Debug)]
pub(crate) struct Fault(Box<Wrong>);

#[derive(Debug)]
struct Wrong {
    /// Innermost first.
    path: Vec<String>,
    message: String,
    at: Option<usize>,
}

impl Fault {
    #[cold]
    #[inline(never)]
    pub(crate) fn new(message: String) -> Self {
        Self(Box::new(Wrong { path: Vec::new(), message, at: None }))
    }

    /// At a byte of the text, unless it says already where.
    #[cold]
    #[inline(never)]
    pub(crate) fn at(mut self, byte: usize) -> Self {
        self.0.at.get_or_insert(byte);
        self
    }

    /// In an item of a list.
    #[cold]
    #[inline(never)]
    pub(crate) fn in_item(mut self, index: usize) -> Self {
        self.0.path.push(format!("[{index}]"));
        self
    }

    /// In a field.
    #[cold]
    #[inline(never)]
    pub(crate) fn in_field(mut self, name: &str) -> Self {
        self.0.path.push(name.to_owned());
        self
    }

    /// With line and column.
    pub(crate) fn in_text(self, text: &str) -> SceneError {
        let Wrong { path, message, at } = *self.0;
        let (line, column) = line_column(text, at.unwrap_or(0));
        let error = SceneError::new("", Problem::Format(message)).at(line, column);
        path.into_iter().fold(error, SceneError::under)
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.message)
    }
}

impl std::error::Error for Fault {}

impl de::Error for Fault {
    #[cold]
    #[inline(never)]
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self::new(message.to_string())
    }

    #[cold]
    #[inline(never)]
    fn invalid_type(found: Unexpected<'_>, expected: &dyn de::Expected) -> Self {
        Self::new(format!("invalid type: {}, expected {expected}", Found(found)))
    }

    #[cold]
    #[inline(never)]
    fn invalid_value(found: Unexpected<'_>, expected: &dyn de::Expected) -> Self {
        Self::new(format!("invalid value: {}, expected {expected}", Found(found)))
    }
}

/// `null` by the name that it has in the text.
struct Found<'a>(Unexpected<'a>);

impl fmt::Display for Found<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Unexpected::Unit = self.0 { f.write_str("null") } else { self.0.fmt(f) }
    }
}

/// Line and column, counted from 1, of a byte of a text.
pub(crate) fn line_column(text: &str, byte: usize) -> (usize, usize) {
    let before = text.get(..byte).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    let column = before.chars().rev().take_while(|c| *c != '\n').count() + 1;
    (line, column)
}
