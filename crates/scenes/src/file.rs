//! Scene files: JSON that people can read, write and compare.

use crate::error::{Problem, SceneError};
use crate::json::{Node, line_column};
use crate::scene::Scene;
use crate::version::VERSION;
use serde::{Deserialize, Serialize};
use std::path::Path;
use tiny_physics::{JointDef, RigidBody, Shape, ShapeDef};

impl Scene {
    /// Reads a scene file.
    ///
    /// # Errors
    /// As [`Scene::from_json`]; the error names the file. A file that cannot be read.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, SceneError> {
        let path = path.as_ref();
        std::fs::read_to_string(path)
            .map_err(|e| SceneError::new("", Problem::Io(e)))
            .and_then(|text| Self::from_json(&text))
            .map_err(|e| e.in_file(path))
    }

    /// Reads a scene from JSON text and checks it.
    ///
    /// # Errors
    /// Text that is not JSON, a missing or unknown field, a value of the wrong kind, another version, a
    /// number that makes no sense, an index that points at nothing. The error names line, column, field
    /// and value.
    pub fn from_json(text: &str) -> Result<Self, SceneError> {
        check_version(text)?;
        let scene: Self = read(text)?;
        scene.check().map_err(|error| match Node::parse(text) {
            Some(node) => {
                let (line, column) = line_column(text, node.find(error.field()));
                error.at(line, column)
            }
            None => error,
        })?;
        Ok(scene)
    }

    /// Writes the scene file: the same text for the same scene, every time.
    ///
    /// # Errors
    /// As [`Scene::to_json`]. A file that cannot be written.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), SceneError> {
        let path = path.as_ref();
        self.to_json()
            .and_then(|text| {
                std::fs::write(path, text).map_err(|e| SceneError::new("", Problem::Io(e)))
            })
            .map_err(|e| e.in_file(path))
    }

    /// The scene as JSON text, laid out for people; fields at their default are left out.
    ///
    /// # Errors
    /// A scene that [`Scene::check`] refuses: it could not be read again.
    pub fn to_json(&self) -> Result<String, SceneError> {
        self.check()?;
        let text = compact(self)?;
        let defaults = Defaults::new()?;
        let mut scene = Node::parse(&text).ok_or_else(unreadable)?;
        scene.omit_nulls();
        defaults.omit(&mut scene)?;
        Ok(scene.pretty())
    }
}

/// The version comes first: a newer file may well have fields that this version does not know.
fn check_version(text: &str) -> Result<(), SceneError> {
    #[derive(Deserialize)]
    struct Version {
        version: u64,
    }
    let version = match read::<Version>(text) {
        Ok(read) => read.version,
        // Text that is no JSON at all: reading it as a scene finds the field where it breaks off.
        Err(error) => return Err(read::<Scene>(text).err().unwrap_or(error)),
    };
    if version == u64::from(VERSION) {
        return Ok(());
    }
    let start = Node::parse(text).map_or(0, |node| node.find("version"));
    let (line, column) = line_column(text, start);
    Err(SceneError::new("version", Problem::Version(version)).at(line, column))
}

fn read<T: serde::de::DeserializeOwned>(text: &str) -> Result<T, SceneError> {
    let mut json = serde_json::Deserializer::from_str(text);
    let value = serde_path_to_error::deserialize(&mut json).map_err(|error| {
        let path = error.path().to_string();
        let field = if path == "." || path == "?" { "" } else { &path };
        at_value(format_error(field, error.inner()), text, error.inner())
    })?;
    json.end().map_err(|error| format_error("", &error))?;
    Ok(value)
}

/// `serde_json` puts the place at the end of its message; we put it in front.
fn format_error(field: &str, error: &serde_json::Error) -> SceneError {
    let (line, column) = (error.line(), error.column());
    let message = error.to_string();
    let place = format!(" at line {line} column {column}");
    let message = message.strip_suffix(&place).unwrap_or(&message);
    SceneError::new(field, Problem::Format(message.to_owned())).at(line, column)
}

/// `serde_json` gives the place after a value that it refuses; we give the place of the value.
fn at_value(error: SceneError, text: &str, json: &serde_json::Error) -> SceneError {
    let Some(node) = Node::parse(text).filter(|_| json.is_data()) else { return error };
    let (line, column) = line_column(text, node.find(error.field()));
    if error.line() == Some(line) { error.at(line, column) } else { error }
}

fn compact(value: &impl Serialize) -> Result<String, SceneError> {
    serde_json::to_string(value).map_err(|e| SceneError::new("", Problem::Format(e.to_string())))
}

fn unreadable() -> SceneError {
    SceneError::new("", Problem::Format("the text cannot be read again".to_owned()))
}

/// Texts of default descriptions; a field that is the same there need not be written.
struct Defaults {
    scene: String,
    body: String,
    shape: String,
    joint: String,
}

impl Defaults {
    fn new() -> Result<Self, SceneError> {
        let circle = Shape::Circle { radius: 1.0 };
        Ok(Self {
            scene: compact(&Scene::default())?,
            body: compact(&RigidBody::default())?,
            shape: compact(&ShapeDef::new(circle))?,
            joint: compact(&JointDef::revolute())?,
        })
    }

    fn omit(&self, scene: &mut Node<'_>) -> Result<(), SceneError> {
        let parse = |text| {
            let mut node = Node::parse(text).ok_or_else(unreadable)?;
            node.omit_nulls();
            Ok::<_, SceneError>(node)
        };
        let (body, shape, joint) = (parse(&self.body)?, parse(&self.shape)?, parse(&self.joint)?);
        for node in scene.field_mut("bodies").map_or(&mut [][..], Node::items_mut) {
            for node in node.field_mut("shapes").map_or(&mut [][..], Node::items_mut) {
                node.omit_defaults_but(&shape, "shape");
            }
            node.omit_defaults(&body);
        }
        for node in scene.field_mut("joints").map_or(&mut [][..], Node::items_mut) {
            node.omit_defaults_but(&joint, "kind");
        }
        scene.omit_defaults_but(&parse(&self.scene)?, "version");
        Ok(())
    }
}
