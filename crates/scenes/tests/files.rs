//! Scene files: the shipped ones load, bad ones are refused with the place.

use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use tiny_physics::{ChainLink, JointDef, Locks, RigidBody, Shape, ShapeDef, Vec2};
use tiny_physics_scenes::{
    Options, PausedScript, Problem, Scene, SceneJoint, Script, all, find, tags,
};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

#[test]
fn shipped_files_load_and_are_what_the_builders_make() {
    let mut count = 0;
    for entry in all().iter().filter(|e| e.has_tag(tags::SHOW)) {
        let path = folder().join(format!("{}.json", entry.name));
        let loaded = Scene::load(&path).unwrap_or_else(|e| panic!("{e}"));
        let mut built = entry.build(Options::default());
        built.schema = Some("scene.schema.json".to_owned());
        assert!(
            loaded == built,
            "{} is out of date: write it again with the example",
            path.display()
        );
        assert_eq!(fs::read_to_string(&path).unwrap(), built.to_json().unwrap(), "{}", entry.name);
        count += 1;
    }
    assert!(count >= 8);
}

#[test]
fn no_other_files_are_shipped() {
    for file in fs::read_dir(folder()).unwrap() {
        let path = file.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let Some(scene) = name.strip_suffix(".json").filter(|n| *n != "scene.schema") else {
            continue;
        };
        assert!(all().iter().any(|e| e.name == scene && e.has_tag(tags::SHOW)), "{name}");
    }
}

/// Text of a file with one body in line 3 and one joint in line 4, with a part replaced.
fn text(from: &str, to: &str) -> String {
    let text = r#"{
  "version": 1, "gravity": [0, -9.8], "dt": 0.0166,
  "bodies": [{ "shapes": [{ "shape": { "circle": { "radius": 0.4 } }, "material": { "friction": 0.3 } }], "mass": 1 }, {}],
  "joints": [{ "a": 0, "b": 1, "kind": { "revolute": { "motor": { "speed": 1, "max": 5 } } } }],
  "settings": { "substeps": 4 }
}"#;
    assert!(text.contains(from), "{from} is in the text");
    text.replacen(from, to, 1)
}

#[test]
fn the_text_that_is_spoilt_below_is_good() {
    let scene = Scene::from_json(&text("", "")).unwrap();
    assert_eq!((scene.bodies.len(), scene.joints.len()), (2, 1));
    assert_eq!(scene.bodies[0].shapes[0].material.friction, 0.3);
}

#[test]
fn bad_files_are_refused_with_line_field_and_value() {
    #[rustfmt::skip]
    let cases = [
        // what is spoilt, by what, then line, field, part of the message
        ("\"radius\": 0.4", "\"radius\": -1", 3, "bodies[0].shapes[0].shape.circle.radius", "radius is -1; allowed is"),
        ("\"radius\": 0.4", "\"radius\": 0", 3, "bodies[0].shapes[0].shape.circle.radius", "radius is 0; allowed is"),
        ("\"radius\": 0.4", "\"radius\": 1e39", 3, "bodies[0].shapes[0].shape.circle.radius", "number out of range"),
        ("\"radius\": 0.4", "\"radius\": null", 3, "bodies[0].shapes[0].shape.circle.radius", "null"),
        ("\"radius\": 0.4", "\"radius\": \"big\"", 3, "bodies[0].shapes[0].shape.circle.radius", "\"big\""),
        ("\"radius\": 0.4", "\"radius\": NaN", 3, "bodies[0].shapes[0].shape.circle.radius", "expected value"),
        ("\"radius\": 0.4", "\"diameter\": 0.8", 3, "bodies[0].shapes[0].shape.circle.diameter", "unknown field `diameter`"),
        ("\"radius\": 0.4", "", 3, "bodies[0].shapes[0].shape.circle", "missing field `radius`"),
        ("\"circle\"", "\"sphere\"", 3, "bodies[0].shapes[0].shape", "unknown variant `sphere`"),
        ("\"friction\": 0.3", "\"friction\": -0.3", 3, "bodies[0].shapes[0].material.friction", "-0.3"),
        ("\"friction\": 0.3", "\"grip\": 0.3", 3, "bodies[0].shapes[0].material.grip", "unknown field `grip`"),
        ("\"mass\": 1", "\"mass\": 0", 3, "bodies[0].mass", "above 0"),
        ("\"mass\": 1", "\"angle\": 1e60", 3, "bodies[0].angle", "number out of range"),
        ("\"mass\": 1", "\"position\": [0, 1e999]", 3, "bodies[0].position[1]", "number out of range"),
        ("\"mass\": 1", "\"position\": [0]", 3, "bodies[0].position", "invalid length 1"),
        ("\"mass\": 1", "\"position\": [0, 1, 2]", 3, "bodies[0].position", "trailing"),
        ("\"mass\": 1", "\"velocity\": [0, \"up\"]", 3, "bodies[0].velocity[1]", "\"up\""),
        ("\"mass\": 1", "\"velocity\": [1e39, 0]", 3, "bodies[0].velocity[0]", "number out of range"),
        ("\"mass\": 1", "\"kind\": \"fixed\"", 3, "bodies[0].kind", "unknown variant `fixed`"),
        ("\"mass\": 1", "\"mass\": 1, \"mass\": 2", 3, "bodies[0]", "duplicate field `mass`"),
        ("\"mass\": 1", "\"mass\": 1e13", 3, "bodies[0].mass", "1e-9 to 1e12"),
        ("\"mass\": 1", "\"inertia\": 1e-10", 3, "bodies[0].inertia", "1e-9 to 1e12"),
        ("\"mass\": 1", "\"center\": [0, 1e7]", 3, "bodies[0].center", "center is 10000000"),
        ("\"mass\": 1", "\"position\": [0, 2e12]", 3, "bodies[0].position", "within 1e12 of the origin"),
        ("\"friction\": 0.3", "\"density\": 1e13", 3, "bodies[0].shapes[0].material.density", "1e-9 to 1e12"),
        ("\"material\"", "\"offset\": [1e7, 0], \"material\"", 3, "bodies[0].shapes[0].offset", "offset is 10000000"),
        ("\"material\"", "\"link\": {}, \"material\"", 3, "bodies[0].shapes[0].link", "only segments"),
        ("\"kind\": {", "\"anchor_b\": [0, 1e7], \"kind\": {", 4, "joints[0].anchor_b", "anchor_b is 10000000"),
        ("\"kind\": {", "\"break_at\": { \"force\": -1, \"torque\": 1 }, \"kind\": {", 4, "joints[0].break_at.force", "-1"),
        ("\"motor\": { \"speed\": 1, \"max\": 5 }", "\"limits\": { \"lower\": -4, \"upper\": 4 }", 4, "joints[0].kind.revolute.limits.upper", "less than a whole turn"),
        ("\"revolute\": { \"motor\"", "\"distance\": { \"length\": 1, \"limits\": { \"lower\": -1, \"upper\": 5 }, \"motor\"", 4, "joints[0].kind.distance.limits.lower", "-1"),
        ("\"mass\": 1", "\"weight\": 1", 3, "bodies[0].weight", "unknown field `weight`"),
        ("\"b\": 1", "\"b\": 7", 4, "joints[0].b", "7, but bodies are numbered 0 to 1"),
        ("\"b\": 1", "\"b\": 0", 4, "joints[0].b", "two different bodies"),
        ("\"b\": 1", "\"b\": -1", 4, "joints[0].b", "-1"),
        ("\"b\": 1, ", "", 4, "joints[0]", "missing field `b`"),
        ("\"b\": 1", "\"c\": 1", 4, "joints[0].c", "unknown field `c`"),
        ("\"b\": 1", "\"b\": 1, \"b\": 1", 4, "joints[0]", "duplicate field `b`"),
        ("\"max\": 5", "\"max\": -5", 4, "joints[0].kind.revolute.motor.max", "-5"),
        ("\"max\": 5", "\"power\": 5", 4, "joints[0].kind.revolute.motor.power", "unknown field `power`"),
        ("\"revolute\"", "\"glue\"", 4, "joints[0].kind", "unknown variant `glue`"),
        ("\"motor\": { \"speed\": 1, \"max\": 5 }", "\"limits\": { \"lower\": 1, \"upper\": 0.5 }", 4, "joints[0].kind.revolute.limits.upper", "0.5"),
        ("\"substeps\": 4", "\"substeps\": 0", 5, "settings.substeps", "1 to 1000"),
        ("\"substeps\": 4", "\"substeps\": 1.5", 5, "settings.substeps", "1.5"),
        ("\"substeps\": 4", "\"sub_steps\": 4", 5, "settings.sub_steps", "unknown field"),
        ("\"dt\": 0.0166", "\"dt\": 0", 2, "dt", "above 0"),
        ("[0, -9.8]", "[0, -1e50]", 2, "gravity[1]", "number out of range"),
        ("\"version\": 1", "\"version\": 2, \"new\": 1", 2, "version", "version is 2; this program reads version 1"),
        ("\"version\": 1,", "", 1, "", "missing field `version`"),
        ("\"dt\": 0.0166,", "\"dt\": 0.0166,\n \"wind\": 3,", 3, "wind", "unknown field `wind`"),
        ("\"substeps\": 4 }", "\"substeps\": 4 }, \"script\": { \"walkers\": { \"first\": 1, \"count\": 9, \"speed\": 1 } }", 5, "script.walkers.count", "9, but bodies"),
        ("\"substeps\": 4 }", "\"substeps\": 4 }, \"script\": { \"rain\": { \"rows\": 0 } }", 5, "script.rain.rows", "0; allowed is 1"),
        ("\"substeps\": 4 }", "\"substeps\": 4 }, \"script\": { \"wake_sleepers\": { \"bodies\": [0, 5] } }", 5, "script.wake_sleepers.bodies[1]", "5"),
        ("\"substeps\": 4 }", "\"substeps\": 4 }, \"script\": { \"timeline\": { \"acts\": [{ \"when\": \"always\", \"deed\": { \"water\": { \"surface\": 0, \"between\": [10, -10], \"density\": 1 } } }] } }", 5, "script.timeline.acts[0].deed.water.between", "-10; allowed is the left end or more"),
        ("\"substeps\": 4 }", "\"substeps\": 4 }, \"script\": { \"character\": { \"position\": [0, 0], \"height\": 1.8, \"radius\": 0.3, \"body\": 0, \"keys\": [{ \"from\": 2 }, { \"from\": 1 }] } }", 5, "script.character.keys[1].from", "not before the key before it"),
        ("\"substeps\": 4 }", "\"substeps\": 4 }, \"script\": { \"snow\": {} }", 5, "script", "unknown variant `snow`"),
        ("\"substeps\": 4 }", "\"substeps\": 4 }, []", 5, "", "key must be a string"),
    ];
    let mut wrong = Vec::new();
    for (from, to, line, field, message) in cases {
        let text = text(from, to);
        let Err(error) = Scene::from_json(&text) else {
            wrong.push(format!("{to}: not refused"));
            continue;
        };
        let shown = error.to_string();
        if (error.line(), error.field()) != (Some(line), field) || !shown.contains(message) {
            wrong.push(format!("{to}\n    {shown}\n    wanted {line}, {field}, {message}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn errors_say_file_line_column_field_and_value() {
    let path = std::env::temp_dir().join(format!("tiny-physics-scene-{}.json", std::process::id()));
    fs::write(&path, text("\"radius\": 0.4", "\"radius\": -1")).unwrap();
    let error = Scene::load(&path).unwrap_err();
    fs::remove_file(&path).unwrap();
    let wanted = format!(
        "{}:3:62: bodies[0].shapes[0].shape.circle.radius: radius is -1; allowed is 1e-5 to 1e6",
        path.display()
    );
    assert_eq!(error.to_string(), wanted);
    assert_eq!(error.file(), Some(path.as_path()));
    let missing = Scene::load(&path).unwrap_err();
    assert!(matches!(missing.problem(), Problem::Io(_)) && missing.line().is_none());
    assert!(missing.to_string().starts_with(&path.display().to_string()));
}

#[test]
fn text_that_is_no_scene_is_refused() {
    for text in [
        "",
        " ",
        "null",
        "[]",
        "1",
        "{",
        "{}",
        "\"\"",
        "{\"version\": \"1\"}",
        "{\"version\": 1} x",
        "\u{feff}{}",
    ] {
        let error = Scene::from_json(text).expect_err(text);
        assert!(error.line().is_some(), "{text}: {error}");
    }
    let deep = "[".repeat(100_000);
    assert!(Scene::from_json(&deep).is_err());
}

#[test]
fn a_scene_that_could_not_be_read_again_is_not_written() {
    let mut scene = Scene::new("bad", "");
    scene.body(RigidBody::new(Shape::Circle { radius: f32::NAN }, Vec2::ZERO, 1.0));
    let error = scene.to_json().unwrap_err();
    assert_eq!(error.field(), "bodies[0].shapes[0].shape.circle.radius");
    assert!(error.line().is_none() && matches!(error.problem(), Problem::Value(_)));
}

#[test]
fn extreme_numbers_come_back_to_the_bit() {
    let mut scene = Scene::new("extreme \"quoted\" \\ \u{1F600}", "line\nbreak");
    for bits in
        [1_u32, 0x007F_FFFF, 0x0080_0000, 0x3DCC_CCCD, 0x7F7F_FFFF, 0x8000_0000, 0x3FFF_FFFF]
    {
        let mut body = RigidBody::dynamic().angle(f32::from_bits(bits));
        body.position.x = f64::from_bits(0x3FB9_9999_9999_999A + u64::from(bits));
        body.user_data = u64::MAX - u64::from(bits);
        scene.body(body);
    }
    let again = Scene::from_json(&scene.to_json().unwrap()).unwrap();
    assert_eq!(again.name, scene.name);
    for (a, b) in scene.bodies.iter().zip(&again.bodies) {
        assert_eq!(a.position.x.to_bits(), b.position.x.to_bits());
        assert_eq!((a.angle, a.user_data), (b.angle, b.user_data));
    }
}

/// The keys of an object in the schema, by a path of keys.
fn schema_keys(schema: &Value, path: &str) -> BTreeSet<String> {
    let object = schema.pointer(&format!("{path}/properties")).and_then(Value::as_object);
    object.unwrap_or_else(|| panic!("{path} has properties")).keys().cloned().collect()
}

fn keys(value: impl serde::Serialize) -> BTreeSet<String> {
    serde_json::to_value(value).unwrap().as_object().unwrap().keys().cloned().collect()
}

#[test]
fn the_schema_knows_every_field() {
    let text = fs::read_to_string(folder().join("scene.schema.json")).unwrap();
    let schema: Value = serde_json::from_str(&text).unwrap();
    let mut scene = Scene { schema: Some(String::new()), ..Scene::default() };
    let joint = SceneJoint { a: 0, b: 1, def: JointDef::revolute() };
    let mut shape = ShapeDef::new(Shape::Circle { radius: 1.0 });
    shape.link = Some(ChainLink { previous: None, next: None });
    assert_eq!(keys(&scene), schema_keys(&schema, ""));
    assert_eq!(keys(scene.settings), schema_keys(&schema, "/$defs/settings"));
    assert_eq!(keys(RigidBody::default()), schema_keys(&schema, "/$defs/body"));
    assert_eq!(keys(Locks::default()), schema_keys(&schema, "/$defs/body/properties/locks"));
    assert_eq!(keys(&shape), schema_keys(&schema, "/$defs/shape_def"));
    assert_eq!(keys(shape.material), schema_keys(&schema, "/$defs/shape_def/properties/material"));
    assert_eq!(keys(shape.filter), schema_keys(&schema, "/$defs/shape_def/properties/filter"));
    assert_eq!(keys(joint), schema_keys(&schema, "/$defs/joint"));
    let joints = [
        ("distance", JointDef::distance(1.0)),
        ("revolute", JointDef::revolute()),
        ("prismatic", JointDef::prismatic(Vec2::Y)),
        ("weld", JointDef::weld()),
        ("wheel", JointDef::wheel(Vec2::Y)),
        ("motor", JointDef::drive()),
        ("mouse", JointDef::mouse(Vec2::ZERO, 1.0)),
        ("pulley", JointDef::pulley(Vec2::ZERO, Vec2::X, 1.0)),
        ("gear", JointDef::gear(1.0)),
    ];
    for (kind, joint) in joints {
        let value = serde_json::to_value(joint.kind).unwrap();
        let path = format!("/$defs/joint_kind/properties/{kind}");
        assert_eq!(keys(&value[kind]), schema_keys(&schema, &path), "{kind}");
    }
    for name in ["rain", "sleep", "tiles", "tile_world", "queries", "hero", "blast"] {
        scene.script = find(name).unwrap().build(Options::default().size(1)).script;
        let value = serde_json::to_value(&scene.script).unwrap();
        let (kind, parameters) = value.as_object().unwrap().iter().next().unwrap();
        let path = format!("/$defs/script/properties/{kind}");
        assert_eq!(keys(parameters), schema_keys(&schema, &path), "{kind}");
    }
}

/// Every deed of the shipped scenes has the fields that the schema says, and every deed has a scene.
#[test]
fn the_schema_knows_every_deed() {
    let text = fs::read_to_string(folder().join("scene.schema.json")).unwrap();
    let schema: Value = serde_json::from_str(&text).unwrap();
    let mut seen = BTreeSet::new();
    for entry in all().iter().filter(|e| e.has_tag(tags::SHOW)) {
        let Some(Script::Timeline(line)) = entry.build(Options::default()).script else { continue };
        for act in &line.acts {
            let deed = serde_json::to_value(&act.deed).unwrap();
            let (name, fields) = deed.as_object().unwrap().iter().next().unwrap();
            let known = schema_keys(&schema, &format!("/$defs/deed/properties/{name}"));
            assert_eq!(keys(fields), known, "{name}");
            seen.insert(name.clone());
        }
    }
    // What comes and goes is in worlds that are drawn at random, not in a show scene.
    seen.extend(["add", "remove"].map(String::from));
    assert_eq!(seen, schema_keys(&schema, "/$defs/deed"), "each is in a scene");
}

/// The JSON texts of the page are what the page says.
#[test]
fn the_page_shows_a_scene_that_loads() {
    let page = fs::read_to_string(folder().join("../docs/scene-files.md")).unwrap();
    let text = page.split("```json").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    let scene = Scene::from_json(text).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(scene.bodies.len(), 3);
}

/// A scene taken from a world in the middle of its run goes on as the world does: from a file, too.
#[test]
fn a_world_becomes_a_scene() {
    let built = find("ragdoll").unwrap().build(Options::default());
    let mut world = PausedScript::start(&built).unwrap().1;
    (0..30).for_each(|_| world.step(built.dt));
    let scene = Scene::of_world("frozen", &world);
    assert_eq!(scene.counts().joints, world.joint_count());
    let read = Scene::from_json(&scene.to_json().unwrap()).unwrap();
    let mut again = PausedScript::start(&read).unwrap().1;
    assert_eq!(again.body_count(), world.body_count());
    assert_eq!(again.shape_count(), world.shape_count());
    for _ in 0..5 {
        world.step(built.dt);
        again.step(built.dt);
    }
    for (a, b) in world.bodies().zip(again.bodies()) {
        let off = (a.position() - b.position()).length();
        // Warm starts are not in it.
        assert!(off < 0.01, "{off} m after five steps");
        assert_eq!(a.mass(), b.mass());
    }
}
