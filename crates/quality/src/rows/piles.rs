//! Things beside, between and inside each other.

use crate::lab::{Lab, Trial, greatest};
use crate::report::Measure;
use crate::scenery::{add_pyramid, crate_at, disk, fixed, floored, moving, rect};
use crate::target::Target;
use core::f64::consts::PI;
use tiny_physics::{DVec2, Polygon, ShapeDef, Vec2};

/// A pyramid for 60 s: how far crates go sideways, and how far they drift once it has settled for 1 s.
pub(super) fn pyramid(lab: &mut Lab<'_>) -> Vec<Measure> {
    lab.expect_seconds(60.0, 1.0 / 60.0);
    let base = lab.pick(40, 30);
    let mut scene = floored("pyramid");
    add_pyramid(&mut scene, base, 0.0);
    lab.may_sleep(&mut scene);
    let crates = 1..scene.bodies.len();
    let mut trial = lab.build(scene);
    lab.run(&mut trial, 1.0, |_| {});
    let settled: Vec<DVec2> = crates.clone().map(|body| trial.position(body)).collect();
    lab.run(&mut trial, 59.0, |_| {});
    let sideways = greatest(crates.clone().map(|body| trial.moved(body).x.abs()));
    let drift = greatest(crates.clone().zip(&settled).map(|(body, from)| {
        let now = trial.position(body);
        (now.x - from.x).hypot(now.y - from.y)
    }));
    vec![
        Measure::new(
            format!("base {base}, 60 s, sideways"),
            1000.0 * sideways,
            "mm",
            Target::AtMost(5.0),
        ),
        Measure::new(
            format!("base {base}, drift from 1 s to 60 s"),
            1000.0 * drift,
            "mm",
            Target::AtMost(1.0),
        ),
    ]
}

/// A half circle of stones without mortar: how far the keystone drops in 60 s.
///
/// Inner radius 4 m, outer 5.2 m, friction 0.8; it stands on its two end faces.
pub(super) fn arch(lab: &mut Lab<'_>) -> Vec<Measure> {
    const INNER: f64 = 4.0;
    const OUTER: f64 = 5.2;
    lab.expect_seconds(60.0, 1.0 / 60.0);
    let stones = lab.pick(15, 11);
    let mut scene = floored("arch");
    for i in 0..stones {
        let angle = |k: f64| PI * k / f64::from(stones);
        let at = |radius: f64, angle: f64| {
            Vec2::new((radius * angle.cos()) as f32, (radius * angle.sin()) as f32)
        };
        let (from, to) = (angle(f64::from(i)), angle(f64::from(i) + 1.0));
        let center = at(0.5 * (INNER + OUTER), 0.5 * (from + to));
        let corners = [at(INNER, from), at(OUTER, from), at(OUTER, to), at(INNER, to)];
        let stone = Polygon::hull(&corners.map(|corner| corner - center))
            .expect("wedges have four corners");
        scene.body(moving(ShapeDef::new(stone).friction(0.8), center));
    }
    let keystone = 1 + stones as usize / 2;
    let mut trial = lab.build(scene);
    lab.run(&mut trial, 60.0, |_| {});
    let moved = trial.moved(keystone);
    let metric = format!("{stones} stones, 60 s, drop of the keystone");
    vec![Measure::new(metric, 1000.0 * moved.x.hypot(moved.y), "mm", Target::AtMost(5.0))]
}

/// Crates that each start half inside the one below: how fast they fly apart, and where they rest.
pub(super) fn deep_overlap(lab: &mut Lab<'_>) -> Vec<Measure> {
    lab.expect_seconds(20.0, 1.0 / 60.0);
    let (count, pitch) = (lab.pick(10, 8), lab.pick(0.5, 0.6));
    let mut scene = floored("deep overlap");
    for i in 0..count {
        scene.body(crate_at(0.0, 0.5 + pitch * i as f32, 1.0));
    }
    let top = count as usize;
    let mut trial = lab.build(scene);
    let mut fastest: f64 = 0.0;
    lab.run(&mut trial, 20.0, |trial| {
        fastest = fastest.max(greatest((1..=top).map(|body| trial.speed(body))));
    });
    let height = f64::from(count) - 0.5;
    let place = trial.position(top);
    let rest = if place.x.abs() < 0.5 { place.y } else { f64::INFINITY };
    vec![
        Measure::new(
            format!("{count} crates, greatest speed"),
            fastest,
            "m/s",
            Target::AtMost(4.0),
        ),
        Measure::new(
            format!("{count} crates, height of the top at rest"),
            rest,
            "m",
            Target::Within { value: height, tolerance: 0.05 },
        ),
    ]
}

/// Balls in a channel that is a fifth wider than they are: what moves between 10 s and 60 s.
pub(super) fn channel(lab: &mut Lab<'_>) -> Vec<Measure> {
    lab.expect_seconds(60.0, 1.0 / 60.0);
    let (count, width) = (lab.pick(20, 15), lab.pick(1.2, 1.3));
    let mut scene = floored("channel");
    for side in [-1.0, 1.0] {
        let wall = Vec2::new(side * (0.5 * width + 1.0), 15.0);
        scene.body(fixed(rect(1.0, 20.0), wall));
    }
    // Each ball leans on one wall and on the ball below.
    let lean = 0.5 * (width - 1.0);
    let rise = (1.0 - 4.0 * lean * lean).sqrt();
    for i in 0..count {
        let x = if i % 2 == 0 { -lean } else { lean };
        scene.body(moving(disk(0.5), Vec2::new(x, 0.5 + rise * i as f32)));
    }
    let balls = 3..scene.bodies.len();
    let mut trial = lab.build(scene);
    lab.run(&mut trial, 10.0, |_| {});
    let settled: Vec<DVec2> = balls.clone().map(|body| trial.position(body)).collect();
    let mut sum = 0.0;
    let mut samples = 0.0;
    lab.run(&mut trial, 50.0, |trial| {
        sum += balls.clone().map(|body| trial.speed(body).powi(2)).sum::<f64>();
        samples += f64::from(count);
    });
    let drift = greatest(balls.clone().zip(&settled).map(|(body, from)| {
        let now = trial.position(body);
        (now.x - from.x).hypot(now.y - from.y)
    }));
    vec![
        Measure::new(
            format!("{count} balls, drift from 10 s to 60 s"),
            1000.0 * drift,
            "mm",
            Target::AtMost(1.0),
        ),
        Measure::new(
            format!("{count} balls, root mean square speed"),
            1000.0 * (sum / samples).sqrt(),
            "mm/s",
            Target::AtMost(1.0),
        ),
    ]
}

/// A pyramid here and one far away, 10 s: how far the crates' motions differ.
pub(super) fn far_away(lab: &mut Lab<'_>) -> Vec<Measure> {
    lab.expect_seconds(20.0, 1.0 / 60.0);
    let (base, distance) = (lab.pick(20, 15), lab.pick(1.0e5, -2.0e5));
    let [near, far] = [0.0, distance].map(|middle| {
        let mut scene = floored("far away");
        scene.bodies[0].position.x = middle;
        add_pyramid(&mut scene, base, middle);
        let mut trial = lab.build(scene);
        lab.run(&mut trial, 10.0, |_| {});
        trial
    });
    let crates = 1..near.scene().bodies.len();
    let difference = greatest(crates.map(|body| difference(&near, &far, body)));
    vec![Measure::new(
        format!("base {base}, {distance} m away, difference from the one at the origin"),
        1000.0 * difference,
        "mm",
        Target::AtMost(1.0),
    )]
}

fn difference(near: &Trial, far: &Trial, body: usize) -> f64 {
    let (a, b) = (near.moved(body), far.moved(body));
    (a.x - b.x).hypot(a.y - b.y)
}
