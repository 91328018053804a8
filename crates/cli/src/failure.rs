//! Why a command failed, and what to do about it.

use core::fmt;
use std::io;
use std::path::Path;

/// Result of a command or a part of one.
pub type Outcome<T = ()> = Result<T, Failure>;

/// An error for people: what went wrong, and a hint where there is one.
#[derive(Debug)]
pub struct Failure {
    what: String,
    hint: Option<String>,
    broken_pipe: bool,
}

impl Failure {
    /// A failure without a hint.
    pub fn new(what: impl Into<String>) -> Self {
        Self { what: what.into(), hint: None, broken_pipe: false }
    }

    /// A file or folder that cannot be written.
    pub fn cannot_write(path: &Path, error: &io::Error) -> Self {
        Self::new(format!("cannot write '{}': {error}", path.display()))
    }

    /// A failure about which everything has been said already.
    pub fn without_words() -> Self {
        Self::new("")
    }

    /// Is there anything to say?
    pub fn has_words(&self) -> bool {
        !self.what.is_empty()
    }

    /// Adds what to do about it.
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    /// Did the reader of our output go away?
    pub fn is_broken_pipe(&self) -> bool {
        self.broken_pipe
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "error: {}", self.what)?;
        self.hint.iter().try_for_each(|hint| write!(f, "\n  hint: {hint}"))
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        let broken_pipe = error.kind() == io::ErrorKind::BrokenPipe;
        Self { broken_pipe, ..Self::new(error.to_string()) }
    }
}

impl From<tiny_physics::Error> for Failure {
    fn from(error: tiny_physics::Error) -> Self {
        Self::new(error.to_string())
    }
}

impl From<tiny_physics_draw::DrawError> for Failure {
    fn from(error: tiny_physics_draw::DrawError) -> Self {
        Self::new(error.to_string())
    }
}

impl From<tiny_physics_scenes::SceneError> for Failure {
    fn from(error: tiny_physics_scenes::SceneError) -> Self {
        Self::new(error.to_string())
    }
}

impl From<serde_json::Error> for Failure {
    fn from(error: serde_json::Error) -> Self {
        Self::new(error.to_string())
    }
}
