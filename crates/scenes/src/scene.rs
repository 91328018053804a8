//! The scene: what a world starts from, and what happens to it from outside while it runs.

use crate::check::{
    Check, check_body, check_joint, check_settings, each, finite_vec, index, positive,
};
use crate::error::{Problem, SceneError};
use crate::script::Script;
use crate::version::VERSION;
use core::fmt;
use serde::de::value::{MapAccessDeserializer, StrDeserializer};
use serde::de::{DeserializeSeed, Error as _, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use tiny_physics::{BodyKind, Error, JointDef, RigidBody, Settings, Vec2, World};

/// A world before its first step, described without an engine.
///
/// ```
/// use tiny_physics::{RigidBody, Shape, Vec2};
/// use tiny_physics_scenes::Scene;
/// let mut scene = Scene::new("drop", "A ball falls on the floor.");
/// scene.body(RigidBody::new(Shape::Aabb { half_extents: Vec2::new(10.0, 1.0) }, Vec2::ZERO, 0.0));
/// scene.body(RigidBody::new(Shape::Circle { radius: 0.5 }, Vec2::new(0.0, 5.0), 1.0));
/// let text = scene.to_json().unwrap();
/// assert_eq!(Scene::from_json(&text).unwrap(), scene);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Scene {
    /// Where an editor finds the JSON schema; nothing else reads it.
    #[serde(rename = "$schema", skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Version of the format: [`VERSION`].
    pub version: u32,
    /// Short name, as in a file name.
    pub name: String,
    /// What there is to see, in a sentence or two.
    pub description: String,
    /// Metres a second squared.
    pub gravity: Vec2,
    /// Settings of the world.
    pub settings: Settings,
    /// How many steps a run of it takes.
    pub steps: u32,
    /// Length of a step, seconds.
    pub dt: f32,
    /// What a picture should show: lower left and upper right corner, metres. Where it is not said, what moves.
    pub view: Option<(Vec2, Vec2)>,
    /// The bodies; their order gives them their index.
    pub bodies: Vec<RigidBody>,
    /// The joints, in the order in which they are added.
    pub joints: Vec<SceneJoint>,
    /// What happens from outside before each step.
    pub script: Option<Script>,
}

impl Default for Scene {
    fn default() -> Self {
        Self {
            schema: None,
            version: VERSION,
            name: String::new(),
            description: String::new(),
            gravity: Vec2::new(0.0, -9.8),
            settings: Settings::default(),
            steps: 600,
            dt: 1.0 / 60.0,
            view: None,
            bodies: Vec::new(),
            joints: Vec::new(),
            script: None,
        }
    }
}

impl Scene {
    /// An empty scene: gravity (0, -9.8), default settings, 600 steps of 1/60 s.
    pub fn new(name: impl Into<String>, description: impl Into<String>) -> Self {
        Self { name: name.into(), description: description.into(), ..Self::default() }
    }

    /// A scene that begins as a world is now: for editors, and to show a problem to others. Bodies and joints come in the
    /// order of their indices. What waits to happen (forces of the next step, warm starts, one-way platforms that somebody is
    /// passing) is not in it, nor are tile maps as such: their pieces are shapes.
    ///
    /// ```
    /// use tiny_physics::prelude::*;
    /// use tiny_physics_scenes::Scene;
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let mut world = World::new((0.0, -9.8));
    /// let hook = world.add_body(RigidBody::fixed())?;
    /// let ball = world.add_body(RigidBody::dynamic().position((1.0, 0.0)).shape(Shape::circle(0.3)?))?;
    /// world.add_joint(hook, ball, JointDef::distance(1.0))?;
    /// let scene = Scene::of_world("pendulum", &world);
    /// assert_eq!((scene.bodies.len(), scene.joints.len()), (2, 1));
    /// # Ok(())
    /// # }
    /// ```
    pub fn of_world(name: impl Into<String>, world: &World) -> Self {
        let ids: Vec<_> = world.body_ids().collect();
        let place = |id| ids.binary_search(&id).ok();
        let joints = world.joints().filter_map(|joint| {
            let (a, b) = joint.bodies();
            Some(SceneJoint { a: place(a)?, b: place(b)?, def: *joint.def() })
        });
        Self {
            gravity: world.gravity,
            settings: world.settings,
            bodies: world.bodies().map(|body| body.describe()).collect(),
            joints: joints.collect(),
            ..Self::new(name, "")
        }
    }

    /// Adds a body and gives its index.
    pub fn body(&mut self, body: RigidBody) -> usize {
        self.bodies.push(body);
        self.bodies.len() - 1
    }

    /// Adds a joint between two bodies, by index, and gives the joint's index.
    pub fn joint(&mut self, a: usize, b: usize, def: JointDef) -> usize {
        self.joints.push(SceneJoint { a, b, def });
        self.joints.len() - 1
    }

    /// How much is in the scene before its first step.
    pub fn counts(&self) -> Counts {
        let of_kind = |kind| self.bodies.iter().filter(|b| b.kind == kind).count();
        Counts {
            bodies: self.bodies.len(),
            dynamic: of_kind(BodyKind::Dynamic),
            shapes: self.bodies.iter().map(|b| b.shapes.len()).sum(),
            joints: self.joints.len(),
        }
    }
}

impl Scene {
    /// Can a world be made of it?
    ///
    /// # Errors
    /// The first field that makes no sense, by its path.
    pub fn check(&self) -> Check {
        if self.version != VERSION {
            return Err(SceneError::new("version", Problem::Version(self.version.into())));
        }
        finite_vec("gravity", self.gravity)?;
        check_settings(&self.settings).map_err(|e| e.under("settings"))?;
        positive("dt", self.dt)?;
        check_view(self.view).map_err(|e| e.under("view"))?;
        each("bodies", &self.bodies, check_body)?;
        each("joints", &self.joints, |joint| check_scene_joint(joint, self.bodies.len()))?;
        match &self.script {
            Some(script) => script.check(self.bodies.len()).map_err(|e| e.under("script")),
            None => Ok(()),
        }
    }
}

fn check_view(view: Option<(Vec2, Vec2)>) -> Check {
    let Some((min, max)) = view else { return Ok(()) };
    finite_vec("[0]", min)?;
    finite_vec("[1]", max)?;
    positive("width", max.x - min.x)?;
    positive("height", max.y - min.y)
}

fn check_scene_joint(joint: &SceneJoint, bodies: usize) -> Check {
    index("a", joint.a, bodies, "bodies")?;
    index("b", joint.b, bodies, "bodies")?;
    if joint.a == joint.b {
        let reason = "a joint needs two different bodies";
        return Err(SceneError::new("b", Problem::Value(Error::Unsupported { reason })));
    }
    check_joint(&joint.def)
}

/// How much there is of what.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Counts {
    /// Bodies of every kind.
    pub bodies: usize,
    /// Dynamic bodies.
    pub dynamic: usize,
    /// Shapes on all bodies.
    pub shapes: usize,
    /// Joints.
    pub joints: usize,
}

/// A joint between two bodies of a scene.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct SceneJoint {
    /// Index of body A in [`Scene::bodies`].
    pub a: usize,
    /// Index of body B.
    pub b: usize,
    /// What the joint does.
    #[serde(flatten)]
    pub def: JointDef,
}

/// Reads `a` and `b` and lets [`JointDef`] read everything else, so that a field that neither knows is
/// refused and errors keep their place. (Derived `flatten` reads into a buffer and loses both.)
impl<'de> Deserialize<'de> for SceneJoint {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(JointVisitor)
    }
}

struct JointVisitor;

impl<'de> Visitor<'de> for JointVisitor {
    type Value = SceneJoint;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a joint: an object with `a`, `b` and `kind`")
    }

    fn visit_map<M: MapAccess<'de>>(self, map: M) -> Result<SceneJoint, M::Error> {
        let mut ends = Ends { map, a: None, b: None };
        let def = JointDef::deserialize(MapAccessDeserializer::new(&mut ends))?;
        let a = ends.a.ok_or_else(|| M::Error::missing_field("a"))?;
        let b = ends.b.ok_or_else(|| M::Error::missing_field("b"))?;
        Ok(SceneJoint { a, b, def })
    }
}

/// A map without its keys `a` and `b`, which it keeps.
struct Ends<M> {
    map: M,
    a: Option<usize>,
    b: Option<usize>,
}

impl<'de, M: MapAccess<'de>> MapAccess<'de> for &mut Ends<M> {
    type Error = M::Error;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        mut seed: K,
    ) -> Result<Option<K::Value>, M::Error> {
        loop {
            let (name, unused) = match self.map.next_key_seed(EndOr(seed))? {
                None => return Ok(None),
                Some(Key::Other(key)) => return Ok(Some(key)),
                Some(Key::End(name, unused)) => (name, unused),
            };
            seed = unused;
            let end = if name == "a" { &mut self.a } else { &mut self.b };
            if end.is_some() {
                return Err(M::Error::duplicate_field(name));
            }
            *end = Some(self.map.next_value()?);
        }
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, M::Error> {
        self.map.next_value_seed(seed)
    }
}

/// Reads a key with the seed inside, unless it is `a` or `b`.
struct EndOr<K>(K);

/// What [`EndOr`] reads; the seed comes back where it was not used.
enum Key<K, V> {
    End(&'static str, K),
    Other(V),
}

impl<'de, K: DeserializeSeed<'de>> DeserializeSeed<'de> for EndOr<K> {
    type Value = Key<K, K::Value>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_identifier(self)
    }
}

impl<'de, K: DeserializeSeed<'de>> Visitor<'de> for EndOr<K> {
    type Value = Key<K, K::Value>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a field name")
    }

    fn visit_str<E: serde::de::Error>(self, key: &str) -> Result<Self::Value, E> {
        match key {
            "a" => Ok(Key::End("a", self.0)),
            "b" => Ok(Key::End("b", self.0)),
            _ => self.0.deserialize(StrDeserializer::new(key)).map(Key::Other),
        }
    }
}
