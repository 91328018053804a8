//! The picture that people see first: what stands still beside what moves.

use super::{Options, ground};
use crate::scene::Scene;
use crate::script::{Act, Deed, Script, Timeline, When};
use crate::shapes;
use core::f32::consts::PI;
use tiny_physics::math::{cos, sin};
use tiny_physics::{Filter, JointDef, RigidBody, Shape, ShapeDef, Vec2};

fn body(x: f32, y: f32, shape: impl Into<ShapeDef>) -> RigidBody {
    RigidBody::dynamic().position(Vec2::new(x, y)).shape(shape)
}

/// A pool, a cradle, an arch, a pyramid, and a heavy ball that knocks a tower over beside it; the size is of no account.
pub(crate) fn fair(_: Options) -> Scene {
    let mut scene = Scene::new(
        "fair",
        "A pool, a cradle, an arch and a pyramid, beside which a heavy ball knocks a tower over.",
    );
    scene.view = Some((Vec2::new(-16.0, -4.4), Vec2::new(16.0, 11.0)));
    let part = |half_width: f32, half_height: f32, x: f32, y: f32| {
        ShapeDef::new(shapes::rect(half_width, half_height)).offset(Vec2::new(x, y))
    };
    // Floor and wall of the pool, and a beam in the air.
    let land = ground(Vec2::new(6.75, -2.25), 12.25, 2.25);
    let land = land.shape(part(12.0, 1.5, -18.0, -2.75)).shape(part(2.0, 2.5, -24.25, 0.25));
    let land = scene.body(land.shape(part(2.8, 0.15, -17.0, 11.25)));
    add_pool(&mut scene);
    add_cradle(&mut scene, land);
    add_arch(&mut scene, Vec2::new(-2.4, 0.0));
    for row in 0..8 {
        for column in row..8 {
            let x = 1.2 + 0.7 * column as f32 - 0.35 * row as f32;
            scene.body(body(x, 0.35 + 0.7 * row as f32, shapes::rect(0.35, 0.35)));
        }
    }
    let plank = |x: f32, y: f32| ShapeDef::new(shapes::rect(x, y)).density(1.5);
    for floor in 0..4 {
        let y = 1.4 * floor as f32;
        for side in [-0.7, 0.0, 0.7] {
            scene.body(body(8.6 + side, y + 0.6, plank(0.12, 0.6)));
        }
        scene.body(body(8.6, y + 1.3, plank(1.0, 0.1)));
    }
    add_wrecker(&mut scene, land, Vec2::new(10.9, 9.3));
    scene
}

/// A boat and things that float and sink.
fn add_pool(scene: &mut Scene) {
    let surface = -0.5;
    let part = |shape: Shape, density: f32| ShapeDef::new(shape).density(density);
    let hull = [(-1.2, 0.3), (-0.8, -0.4), (0.8, -0.4), (1.3, 0.3)].map(|(x, y)| Vec2::new(x, y));
    let sail = [(0.1, 0.7), (1.0, 0.7), (0.1, 2.2)].map(|(x, y)| Vec2::new(x, y));
    let boat = body(-13.6, surface + 0.1, part(shapes::hull(&hull, 0.0), 0.6))
        .shape(part(shapes::rect(0.05, 1.0), 0.2).offset(Vec2::new(0.0, 1.3)))
        .shape(part(shapes::hull(&sail, 0.0), 0.04))
        .shape(part(shapes::rect(0.4, 0.12), 6.0).offset(Vec2::new(0.0, -0.5)));
    scene.body(boat);
    for (i, density) in [0.6, 3.2, 1.0, 0.3, 1.4].into_iter().enumerate() {
        let shape = if i % 2 == 0 { shapes::rect(0.4, 0.35) } else { shapes::circle(0.38) };
        let (x, y) = (-11.4 + 1.25 * i as f32, 1.2 + 1.1 * i as f32);
        scene.body(body(x, y, part(shape, density)).angle(0.3 * i as f32));
    }
    let between = Some((-15.5, -5.5));
    let deed = Deed::Water { surface, between, density: 2.0, flow: Vec2::ZERO };
    let acts = vec![Act { when: When::Always, deed }];
    scene.script = Some(Script::Timeline(Timeline { acts }));
}

/// Five balls on rods, the first of them let go from the side.
fn add_cradle(scene: &mut Scene, land: usize) {
    const ROD: f32 = 3.4;
    for i in 0..5 {
        let hook = Vec2::new(-11.85 + 0.8 * i as f32, 8.9);
        let angle = if i == 0 { -1.1_f32 } else { 0.0 };
        let hanging = Vec2::new(ROD * sin(angle), -ROD * cos(angle));
        let ball = ShapeDef::new(shapes::circle(0.4)).friction(0.0).restitution(1.0).density(8.0);
        let ball =
            scene.body(RigidBody::dynamic().position(hook + hanging).can_sleep(false).shape(ball));
        let anchor = hook - Vec2::new(6.75, -2.25);
        scene.joint(land, ball, JointDef::distance(ROD).anchors(anchor, Vec2::ZERO));
    }
}

/// Thirteen stones without mortar.
fn add_arch(scene: &mut Scene, middle: Vec2) {
    const STONES: u32 = 13;
    let around = |radius: f32, a: f32| Vec2::new(radius * cos(a), radius * sin(a));
    for i in 0..STONES {
        let angle = |k: f32| PI * k / STONES as f32;
        let (from, to) = (angle(i as f32), angle(i as f32 + 1.0));
        let center = around(2.2, 0.5 * (from + to));
        let corners = [around(1.8, from), around(2.6, from), around(2.6, to), around(1.8, to)];
        let stone = ShapeDef::new(shapes::hull(&corners.map(|c| c - center), 0.0)).friction(0.8);
        scene.body(RigidBody::dynamic().position(middle + center).shape(stone));
    }
}

/// A ball on a chain of light links, held up on the right.
fn add_wrecker(scene: &mut Scene, land: usize, hook: Vec2) {
    const LINKS: u32 = 13;
    const ANGLE: f32 = -0.45;
    let filter = Filter { group: -1, ..Filter::default() };
    let way = Vec2::new(cos(ANGLE), sin(ANGLE));
    let (mut last, mut anchor) = (land, hook - Vec2::new(6.75, -2.25));
    for i in 0..LINKS {
        let (a, b) = (Vec2::new(-0.2, 0.0), Vec2::new(0.2, 0.0));
        let link = ShapeDef::new(Shape::Capsule { a, b, radius: 0.06 }).filter(filter);
        let place = hook + way * (0.5 * i as f32 + 0.25);
        let link = scene.body(RigidBody::dynamic().position(place).angle(ANGLE).shape(link));
        scene.joint(last, link, JointDef::revolute().anchors(anchor, Vec2::new(-0.25, 0.0)));
        (last, anchor) = (link, Vec2::new(0.25, 0.0));
    }
    let ball = ShapeDef::new(shapes::circle(0.8)).density(4.0).filter(filter);
    let place = hook + way * (0.5 * LINKS as f32);
    let ball = scene.body(RigidBody::dynamic().position(place).shape(ball));
    scene.joint(last, ball, JointDef::revolute().anchors(anchor, Vec2::ZERO));
}
