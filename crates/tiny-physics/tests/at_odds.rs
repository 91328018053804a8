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
