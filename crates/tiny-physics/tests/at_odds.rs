//! Joints that contradict each other share what cannot be made good, and rest.

mod common;

use common::{DT, Random, rect};
use tiny_physics::{BodyId, JointDef, Locks, RigidBody, ShapeDef, Vec2, World};

/// What is at odds with the pins at the ends of a row of planks.
#[derive(Clone, Copy, Debug)]
enum Odd {
    /// A hinge that is beside the line, a hinge with a limit on the angle, a weld and a slider at another angle.
    Hinge,
    Limit,
    Weld,
    Slider,
    /// Two ropes that pull both ways, a slider that wants to be elsewhere along its line.
    Ropes,
    End,
    /// The place, of a plank that is locked along x.
    Lock,
}

const ALL: [Odd; 7] =
    [Odd::Hinge, Odd::Limit, Odd::Weld, Odd::Slider, Odd::Ropes, Odd::End, Odd::Lock];

/// A row of planks whose ends are pinned to what does not move, of which the first is held once more, otherwise.
fn planks(random: &mut Random, odd: Odd, count: usize, unit: f32) -> (World, Vec<BodyId>) {
    let mut world = World::new(Vec2::new(0.0, -10.0 * unit));
    world.settings.length_unit = unit;
    let base = world.add_body(RigidBody::fixed()).expect("a base");
    let (length, thick) = (random.range(0.5, 3.0) * unit, random.range(0.05, 0.3) * unit);
    let side = if random.below(2) == 0 { 1.0 } else { -1.0 };
    let error = random.range(0.006, 0.03) * side;
    let angle = random.range(-1.5, 1.5);
    let along = Vec2::new(angle.cos(), angle.sin());
    let (across, off) = (along.perp(), 0.5 * error * length);
    let damping = if count > 1 { 1.0 } else { 0.0 };
    let locks = Locks { x: matches!(odd, Odd::Lock), ..Locks::default() };
    let at = |k: f32| along * (k * length);
    let all: Vec<_> = (0..count)
        .map(|i| {
            let shape = ShapeDef::new(rect(0.5 * length, 0.5 * thick)).density(1.0 / (unit * unit));
            let body = RigidBody::dynamic().position(at(i as f32)).angle(angle).shape(shape);
            let body = body.damping(damping, damping).locks(locks);
            world.add_body(body).expect("a plank")
        })
        .collect();
    let mut join = |a: BodyId, b: BodyId, def: JointDef| {
        world.add_joint(a, b, def).expect("a joint");
    };
    join(base, all[0], JointDef::revolute().anchor_at(at(-0.5)));
    for (i, pair) in all.windows(2).enumerate() {
        join(pair[0], pair[1], JointDef::revolute().anchor_at(at(i as f32 + 0.5)));
    }
    if !locks.x {
        join(base, all[count - 1], JointDef::revolute().anchor_at(at(count as f32 - 0.5)));
    }
    let ends = if error > 0.0 { [error, error + 0.5] } else { [error - 0.5, error] };
    let hinge = |off: Vec2| JointDef::revolute().anchors(off, Vec2::ZERO);
    let rope = |from: Vec2, on: Vec2| JointDef::rope(from.length() - off.abs()).anchors(from, on);
    let slider = |direction: f32| JointDef::prismatic(Vec2::new(direction.cos(), direction.sin()));
    match odd {
        Odd::Hinge => join(base, all[0], hinge(across * off)),
        Odd::Limit => {
            join(base, all[0], hinge(along * off).angles(angle, 0.0).limits(ends[0], ends[1]));
        }
        Odd::Weld => join(base, all[0], JointDef::weld().angles(angle + error, 0.0)),
        Odd::Slider => join(base, all[0], slider(angle + 0.7).angles(angle + 0.7, 0.7 - error)),
        Odd::Ropes => {
            join(base, all[0], rope(across * (-0.7 * length), Vec2::ZERO));
            join(base, all[0], rope(across * (0.7 * length), Vec2::new(0.2 * length, 0.0)));
        }
        Odd::End => {
            let (quarter, off) = (core::f32::consts::FRAC_PI_2, off.abs());
            let slider = slider(angle + quarter).angles(angle + quarter, quarter);
            join(base, all[0], slider.limits(off, off + unit));
        }
        Odd::Lock => join(base, all[0], hinge(Vec2::new(off, off))),
    }
    (world, all)
}

/// Before, planks of nearly all of these kinds were flung about, ropes at 190 m/s, or trembled at up to 18 m/s, and of those that are
/// locked 17 in 24 went off by up to 970 lengths.
#[test]
fn joints_that_contradict_each_other_share_it_and_rest() {
    let mut random = Random::new(5);
    for odd in ALL {
        for count in [1, 2, 3] {
            // What ropes pull at is solved in turns with the tree.
            if matches!(odd, Odd::Lock | Odd::Ropes) && count > 1 {
                continue;
            }
            for member in 0..16 {
                let unit = [1.0, 1.0, 30.0][member % 3];
                let (mut world, all) = planks(&mut random, odd, count, unit);
                let start = common::position(&world, all[0]);
                let (mut fastest, mut late) = (0.0_f32, 0.0_f32);
                for step in 0..240 {
                    world.step(DT);
                    for body in all.iter().map(|&id| world.body(id).expect("a plank")) {
                        let speed = body.velocity().length() / unit;
                        let speed = speed.max(body.angular_velocity().abs());
                        fastest = fastest.max(speed);
                        late = if step < 180 { 0.0 } else { late.max(speed) };
                    }
                }
                let gone = (common::position(&world, all[0]) - start).length() / unit;
                let what =
                    format!("{odd:?} {count} {member}: {fastest} m/s, {late} late, {gone} m");
                println!("{what}");
                assert!(fastest < 8.0 && late < 1.0 && gone < 0.2, "{what}");
            }
        }
    }
}

/// Of doors whose hinges are too far apart, with a limit that their rest contradicts and maybe a motor, 9 in 24 spun at up to 6,400 rad/s, and
/// of triangles with a bar that does not fit between its pins some.
#[test]
fn doors_with_hinges_too_far_apart_hang_still() {
    let mut random = Random::new(7);
    for member in 0..192 {
        let (unit, hertz) = ([0.05, 1.0, 20.0][member % 3], [30, 60, 120, 240][member % 4]);
        let mut world = World::new(Vec2::new(0.0, -10.0 * unit));
        world.settings.length_unit = unit;
        world.settings.substeps = [1, 2, 4, 8][random.below(4) as usize];
        let base = world.add_body(RigidBody::fixed()).expect("a base");
        let (half, gap) = (random.range(0.2, 2.5) * unit, random.range(0.005, 0.15));
        let density = [0.1, 1.0, 100.0][random.below(3) as usize] / (unit * unit);
        let shape = ShapeDef::new(rect(half, 0.06 * unit)).density(density);
        let door = world.add_body(RigidBody::dynamic().shape(shape)).expect("a door");
        let hinge = |side: f32| {
            let on = |x: f32| Vec2::new(side * x * half, 0.0);
            JointDef::revolute().anchors(on(1.0 + gap), on(1.0))
        };
        let mut second = hinge(1.0);
        if member % 5 != 0 {
            second = second.limits(random.range(-0.01, 0.03), 0.2);
        }
        if member % 2 == 0 {
            let weight = 10.0 * unit * world.body(door).expect("a door").mass();
            second = second.motor(random.range(-5.0, 5.0), 20.0 * weight * half);
        }
        world.add_joint(base, door, hinge(-1.0)).expect("a hinge");
        world.add_joint(base, door, second).expect("a hinge");
        let (mut fastest, mut late) = (0.0_f32, 0.0_f32);
        for step in 0..4 * hertz {
            world.step(1.0 / hertz as f32);
            let door = world.body(door).expect("a door");
            let speed = (door.velocity().length() / unit).max(door.angular_velocity().abs());
            fastest = fastest.max(speed);
            late = if step < 2 * hertz { 0.0 } else { late.max(speed) };
        }
        let gone = common::position(&world, door).length() / half;
        let what = format!("{member}: {fastest} m/s, {late} late, {gone} of its half");
        println!("{what}");
        assert!(fastest < 1.0 && late < 0.01 && gone < 0.02, "{what}");
    }
}

/// A triangle of bars of which one is pinned at both ends, up to 15 % too short or too long for that.
#[test]
fn a_triangle_with_a_bar_that_does_not_fit_rests() {
    let mut random = Random::new(11);
    for member in 0..64 {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        let base = world.add_body(RigidBody::fixed()).expect("a base");
        let (l, more) = (random.range(0.2, 2.5), random.range(-0.15, 0.15));
        let density = [0.1, 1.0, 100.0][member % 3];
        let corners = [Vec2::new(-l, 0.0), Vec2::new(l, 0.0), Vec2::new(0.0, 1.3 * l)];
        let bars = [0, 1, 2].map(|i| {
            let (from, to) = (corners[i], corners[(i + 1) % 3]);
            let along = to - from;
            let half = 0.5 * along.length() * if i == 0 { 1.0 + more } else { 1.0 };
            let shape = ShapeDef::new(rect(half, 0.05)).density(density);
            let filter = tiny_physics::Filter { mask: 0, ..Default::default() };
            let bar = RigidBody::dynamic().position((from + to) * 0.5).shape(shape.filter(filter));
            (world.add_body(bar.angle(along.y.atan2(along.x))).expect("a bar"), half)
        });
        let end = |half: f32| Vec2::new(half, 0.0);
        for (i, corner) in corners.into_iter().enumerate() {
            let ((a, ha), (b, hb)) = (bars[i], bars[(i + 1) % 3]);
            let pin = JointDef::revolute().anchors(end(ha), end(-hb));
            world.add_joint(a, b, pin).expect("a pin");
            if i < 2 {
                let half = bars[0].1 * (2.0 * i as f32 - 1.0);
                let pin = JointDef::revolute().anchors(corner, end(half));
                world.add_joint(base, bars[0].0, pin).expect("a pin");
            }
        }
        let mut late = 0.0_f32;
        for step in 0..480 {
            world.step(DT);
            for body in bars.map(|(bar, _)| world.body(bar).expect("a bar")) {
                let speed = body.velocity().length().max(body.angular_velocity().abs());
                late = if step < 240 { 0.0 } else { late.max(speed) };
                assert!(speed < 5.0, "{member}: {speed} m/s in step {step}");
            }
        }
        assert!(late < 0.01, "{member}: {late} m/s late");
    }
}
