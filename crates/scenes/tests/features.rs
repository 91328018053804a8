//! The scenes that show an ability each: at their end, what they show has come about.

use tiny_physics::{BodyKind, RigidBody, Shape, ShapeDef, Vec2};
use tiny_physics_scenes::{Act, Deed, Options, Run, Scene, Script, Timeline, When, find};

/// The run of a scene at its end.
fn end_of(name: &str) -> Run {
    let entry = find(name).unwrap();
    let mut run = Run::start(&entry.build(Options::default())).unwrap();
    while !run.is_done() {
        run.step();
    }
    assert_eq!(run.host().error(), None, "{name}");
    run.world().validate().unwrap();
    run
}

/// Where the bodies of the scene are, in its order.
fn places(run: &Run) -> Vec<tiny_physics::Vec2> {
    let ids = run.bodies().iter().map(|body| run.host().body_id(*body).unwrap());
    ids.map(|id| run.world().body(id).unwrap().position()).collect()
}

#[test]
fn at_the_fair_what_is_to_stand_stands() {
    let (run, scene) = (end_of("fair"), find("fair").unwrap().build(Options::default()));
    let moved: Vec<f32> = places(&run)
        .iter()
        .zip(&scene.bodies)
        .map(|(now, body)| now.distance(body.position.to_vec2()))
        .collect();
    // Land, boat, five things in the pool, five balls; then the arch, and the pyramid.
    let (arch, pyramid) = (12..25, 25..61);
    assert!(moved[arch].iter().all(|way| *way < 0.03), "{moved:?}");
    assert!(moved[pyramid].iter().all(|way| *way < 0.3), "{moved:?}");
    // The tower does not, and the boat is on the water.
    assert!(moved[61..77].iter().any(|way| *way > 2.0), "{moved:?}");
    assert!(moved[1] < 8.0 && places(&run)[1].y > -0.9, "{moved:?}");
}

#[test]
fn every_kind_of_joint_does_what_it_should() {
    let run = end_of("joints");
    let joints = find("joints").unwrap().build(Options::default()).joints;
    let kinds: std::collections::BTreeSet<String> = joints
        .iter()
        .map(|joint| format!("{:?}", joint.def.kind).split([' ', '{']).next().unwrap().to_owned())
        .collect();
    assert_eq!(kinds.len(), 10, "all kinds: {kinds:?}");
    assert_eq!(run.world().joint_count(), joints.len() - 1, "one has broken");
}

#[test]
fn the_rack_is_lifted_to_its_limit() {
    let run = end_of("clockwork");
    let rack = places(&run)[6];
    assert!((rack.y - (-2.3 + 3.5)).abs() < 0.05, "{rack:?}");
}

#[test]
fn the_bridge_breaks_in_part() {
    let scene = find("breaking_bridge").unwrap().build(Options::default());
    let left = end_of("breaking_bridge").world().joint_count();
    assert!(left > 0 && left < scene.joints.len(), "{left} of {}", scene.joints.len());
}

#[test]
fn nothing_leaves_the_bowl() {
    let places = places(&end_of("bowl"));
    let inside = |p: &tiny_physics::Vec2| (p.x / 9.0).powi(2) + (p.y / 7.0).powi(2) < 1.0;
    assert!(places[1..].iter().all(|p| inside(p) || p.y > 0.0));
    assert!(places[1..].iter().all(|p| p.y > -7.0 && p.x.abs() < 9.0));
}

#[test]
fn what_was_to_change_has_changed() {
    let run = end_of("changing");
    let world = run.world();
    let body = |index: usize| world.body(run.host().body_id(run.bodies()[index]).unwrap()).unwrap();
    let balloon = world.shape(body(1).shapes().next().unwrap()).unwrap();
    assert!(matches!(balloon.shape(), Shape::Circle { radius } if *radius > 2.0));
    let shelves = world.body_ids().filter(|id| world.body(*id).unwrap().kind() == BodyKind::Static);
    assert_eq!(shelves.count(), 2, "the ground and the slope");
    assert!(places(&run)[15..19].iter().all(|crate_| crate_.y < 0.6), "all slid off the ice");
}

#[test]
fn balls_stay_on_the_planks() {
    let places = places(&end_of("platforms"));
    assert!(places[17..].iter().all(|ball| ball.y > 2.0 && ball.x > 3.0), "{:?}", &places[17..]);
}

#[test]
fn light_things_float() {
    let run = end_of("harbour");
    let places = places(&run);
    let density = |i: usize| [100.0, 400.0, 700.0, 950.0, 1500.0][i % 5];
    for (i, place) in places[3..].iter().enumerate() {
        let floats = place.y > -3.0; // It may be under the boat.
        assert_eq!(floats, density(i) < 1000.0, "{i} of density {} at {place:?}", density(i));
    }
    assert!(places[2].x > -11.0, "the boat has sailed: {:?}", places[2]);
}

#[test]
fn parcels_come_into_the_box_of_their_kind() {
    let run = end_of("sorting");
    let places = places(&run);
    for (i, place) in places[1..].iter().enumerate() {
        let (kind, left) = (i % 3, 14.4 - 2.4 * (i % 3) as f32);
        let boxed = (left..left + 2.4).contains(&place.x) && (-0.3..3.0).contains(&place.y);
        assert!(boxed, "parcel {i} of kind {kind} is at {place:?}");
    }
}

#[test]
fn the_door_opens() {
    let places = places(&end_of("sensor_door"));
    assert!(places[5].y > 6.5, "the door is up: {:?}", places[5]);
    // From a shelf of 2.6 m: three may come to lie on each other.
    assert!(places[7..].iter().all(|load| load.y < 2.5), "all has come down: {:?}", &places[7..]);
}

#[test]
fn the_hero_arrives() {
    let places = places(&end_of("hero"));
    let hero = places.last().unwrap();
    assert!(hero.x > 26.0 && hero.y > 5.0, "{hero:?}");
}

#[test]
fn a_scene_whose_deeds_make_no_sense_is_refused() {
    let text = find("harbour").unwrap().build(Options::default()).to_json().unwrap();
    for (from, to, message) in [
        ("\"density\": 1000.0, \"flow\"", "\"density\": -1.0, \"flow\"", "water.density"),
        ("\"wind\": { \"body\": 2", "\"wind\": { \"body\": 99", "wind.body"),
        ("\"water\": {", "\"lava\": {", "unknown variant `lava`"),
    ] {
        assert!(text.contains(from), "{from} is in {text}");
        let error = tiny_physics_scenes::Scene::from_json(&text.replacen(from, to, 1));
        let error = error.unwrap_err().to_string();
        assert!(error.contains(message), "{error}");
    }
}

#[test]
fn water_between_two_ends_bears_what_is_in_it_alone() {
    let mut scene = Scene::new("pond", "One ball in a pond, one beside it.");
    let ball = ShapeDef::new(Shape::Circle { radius: 0.5 }).density(500.0);
    let at = |x: f32| RigidBody::dynamic().position(Vec2::new(x, 0.0)).shape(ball.clone());
    let [wet, dry] = [-2.0, 2.0].map(|x| scene.body(at(x)));
    let between = Some((-6.0, 0.0));
    let deed = Deed::Water { surface: 0.0, between, density: 1000.0, flow: Vec2::ZERO };
    let acts = vec![Act { when: When::Always, deed }];
    scene.script = Some(Script::Timeline(Timeline { acts }));
    let mut run = Run::start(&scene).unwrap();
    for _ in 0..300 {
        run.step();
    }
    let height = |body: usize| {
        let id = run.world().body_ids().nth(body).unwrap();
        run.world().body(id).unwrap().position().y
    };
    assert!(height(wet).abs() < 0.1, "{}", height(wet));
    assert!(height(dry) < -50.0, "{}", height(dry));
}

/// Of a body of several shapes the first that is described is the one that a script changes.
#[test]
fn a_script_changes_the_first_shape() {
    let (small, large) = (Shape::circle(0.1).unwrap(), Shape::circle(0.7).unwrap());
    let other = ShapeDef::new(Shape::rect(0.2, 0.3).unwrap()).offset(Vec2::new(3.0, 0.0));
    let body = RigidBody::dynamic().shape(small).shape(other.clone());
    let act = Act { when: When::At(2), deed: Deed::SetShape { body: 0, shape: large } };
    let script = Script::Timeline(Timeline { acts: vec![act] });
    let scene = Scene { bodies: vec![body], steps: 5, script: Some(script), ..Scene::default() };
    let mut run = Run::start(&scene).unwrap();
    while !run.is_done() {
        run.step();
    }
    let body = run.world().body(run.host().body_id(run.bodies()[0]).unwrap()).unwrap();
    let shapes: Vec<Shape> =
        body.shapes().map(|id| *run.world().shape(id).unwrap().shape()).collect();
    assert_eq!(shapes, [large, other.shape]);
}
