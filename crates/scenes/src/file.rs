//! Scene files: JSON that people can read, write and compare.

use crate::error::{Problem, SceneError};
use crate::fault::{Fault, line_column};
use crate::json::Node;
use crate::read::read;
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
            Ok(node) => {
                let (line, column) = line_column(text, node.find(error.field()));
                error.at(line, column)
            }
            Err(_) => error,
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
        let mut scene = Node::parse(&text).map_err(unreadable)?;
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
    let Version { version } = read(text)?;
    if version == u64::from(VERSION) {
        return Ok(());
    }
    let start = Node::parse(text).map_or(0, |node| node.find("version"));
    let (line, column) = line_column(text, start);
    Err(SceneError::new("version", Problem::Version(version)).at(line, column))
}

fn compact(value: &impl Serialize) -> Result<String, SceneError> {
    serde_json::to_string(value).map_err(|e| SceneError::new("", Problem::Format(e.to_string())))
}

fn unreadable(fault: Fault) -> SceneError {
    SceneError::new("", Problem::Format(format!("the text cannot be read again: {fault}")))
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
            let mut node = Node::parse(text).map_err(unreadable)?;
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
