//! What is wrong with a scene, and where.

use crate::version::VERSION;
use core::fmt;
use std::path::{Path, PathBuf};

/// Why a scene cannot be used, with the place: file, line and column where it came from a text, and the
/// field by its path, like `bodies[3].shapes[0].shape.circle.radius`.
#[derive(Debug)]
pub struct SceneError {
    file: Option<PathBuf>,
    place: Option<(usize, usize)>,
    field: String,
    problem: Problem,
}

/// What is wrong, without the place.
#[derive(Debug)]
#[non_exhaustive]
pub enum Problem {
    /// The file could not be read or written.
    Io(std::io::Error),
    /// The text is no JSON, or a value is not of the kind that its field takes.
    Format(String),
    /// The file says that it is of a version that this crate does not read.
    Version(u64),
    /// A number makes no sense there.
    Value(tiny_physics::Error),
    /// An index points at nothing.
    Index {
        /// The index.
        index: usize,
        /// How many there are.
        count: usize,
        /// Of what: "bodies".
        of: &'static str,
    },
}

impl SceneError {
    pub(crate) fn new(field: impl Into<String>, problem: Problem) -> Self {
        Self { file: None, place: None, field: field.into(), problem }
    }

    pub(crate) fn in_file(mut self, file: &Path) -> Self {
        self.file = Some(file.to_owned());
        self
    }

    pub(crate) fn at(mut self, line: usize, column: usize) -> Self {
        self.place = Some((line, column));
        self
    }

    /// The field gets a name in front: `radius` under `shapes[0]` is `shapes[0].radius`.
    pub(crate) fn under(mut self, parent: impl fmt::Display) -> Self {
        let dot = if self.field.is_empty() || self.field.starts_with('[') { "" } else { "." };
        self.field = format!("{parent}{dot}{}", self.field);
        self
    }

    /// The file, if the scene came from one.
    pub fn file(&self) -> Option<&Path> {
        self.file.as_deref()
    }

    /// Line of the text, counted from 1, if the scene came from a text.
    pub fn line(&self) -> Option<usize> {
        self.place.map(|p| p.0)
    }

    /// Column in the line, counted from 1.
    pub fn column(&self) -> Option<usize> {
        self.place.map(|p| p.1)
    }

    /// Path of the field, like `joints[2].anchor_a`; empty where it is the scene as a whole.
    pub fn field(&self) -> &str {
        &self.field
    }

    /// What is wrong.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.file, self.place) {
            (Some(file), Some((line, column))) => {
                write!(f, "{}:{line}:{column}: ", file.display())?
            }
            (Some(file), None) => write!(f, "{}: ", file.display())?,
            (None, Some((line, column))) => write!(f, "line {line} column {column}: ")?,
            (None, None) => {}
        }
        if !self.field.is_empty() {
            write!(f, "{}: ", self.field)?;
        }
        self.problem.fmt(f)
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io(error) => error.fmt(f),
            Self::Format(text) => f.write_str(text),
            Self::Version(version) => {
                write!(f, "version is {version}; this program reads version {}", VERSION)
            }
            Self::Value(error) => error.fmt(f),
            Self::Index { index, count: 0, of } => {
                write!(f, "index is {index}, but there are no {of}")
            }
            Self::Index { index, count, of } => {
                write!(f, "index is {index}, but {of} are numbered 0 to {}", count - 1)
            }
        }
    }
}

impl std::error::Error for SceneError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.problem {
            Problem::Io(error) => Some(error),
            Problem::Value(error) => Some(error),
            Problem::Format(_) | Problem::Version(_) | Problem::Index { .. } => None,
        }
    }
}
