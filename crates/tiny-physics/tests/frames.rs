//! Frames of beams that spin: their joints close loops, strain each other, and do no work.

mod common;

use common::{DT, Random, circle, rect};
use tiny_physics::{BodyId, Filter, JointDef, RigidBody, ShapeDef, Vec2, World};

/// Corners of a frame: where in its grid, the last beam there, and its end in that beam's own axes.
type Corners = Vec<((u64, u64), BodyId, Vec2)>;

/// A frame of square cells, of beams as dense as `densities` says: welded, or hinged with a brace in each cell.
fn frame(
    world: &mut World,
    (side, columns, rows): (f32, u64, u64),
    welded: bool,
    mut density: impl FnMut() -> f32,
) -> Corners {
    let mut corners = Corners::new();
    let mut beam = |from: (u64, u64), to: (u64, u64)| {
        let [a, b] = [from, to].map(|(x, y)| Vec2::new(x as f32, y as f32) * side);
        let (half, angle) = (0.5 * (b - a).length(), (b.y - a.y).atan2(b.x - a.x));
        let shape = ShapeDef::new(rect(half, 0.04 * side)).density(density());
        let shape = shape.filter(Filter { group: -1, ..Filter::default() });
        let body = RigidBody::dynamic().position((a + b) * 0.5).angle(angle).shape(shape);
        let body = world.add_body(body).unwrap();
        for (corner, end) in [(from, -half), (to, half)] {
            let anchor = Vec2::new(end, 0.0);
            if let Some((_, other, there)) = corners.iter_mut().find(|found| found.0 == corner) {
                let turn = world.body(*other).unwrap().angle() - angle;
                let weld = JointDef::weld().angles(0.0, turn);
                let joint = if welded { weld } else { JointDef::revolute() };
                world.add_joint(*other, body, joint.anchors(*there, anchor)).unwrap();
                (*other, *there) = (body, anchor);
            } else {
                corners.push((corner, body, anchor));
            }
        }
    };
    for (x, y) in (0..=rows).flat_map(|y| (0..=columns).map(move |x| (x, y))) {
        if x < columns {
            beam((x, y), (x + 1, y));
        }
        if y < rows {
            beam((x, y), (x, y + 1));
        }
        if x < columns && y < rows && !welded {
            beam((x, y), (x + 1, y + 1));
        }
    }
    corners
}

/// A frame of square cells of welded beams floats, and a ball hits it: the energy of all six seconds later, of what it was. It has more
/// rows than ways to move; solved at once, its rows at odds gave it seven times as much as it spun.
fn welded_frame(random: &mut Random) -> f64 {
    let mut world = World::new(Vec2::ZERO);
    world.settings.substeps = [2, 4, 4, 8][random.below(4) as usize];
    let (side, columns, rows) = (random.range(0.5, 1.5), 1 + random.below(3), 1 + random.below(4));
    frame(&mut world, (side, columns, rows), true, || 1.0);
    let height = side * rows as f32 * random.range(0.3, 0.9);
    let ball = RigidBody::dynamic().position(Vec2::new(-3.0 * side, height));
    let ball = ball.velocity(Vec2::new(random.range(3.0, 15.0), 0.0)).mass(random.range(1.0, 50.0));
    world.add_body(ball.shape(circle(0.25 * side))).unwrap();
    let before = world.kinetic_energy();
    (0..360).for_each(|_| world.step(DT));
    world.kinetic_energy() / before
}

#[test]
fn welded_frames_that_spin_gain_nothing() {
    let mut random = Random::new(5);
    for k in 0..60 {
        let energy = welded_frame(&mut random);
        assert!(energy < 1.02, "{k}: {energy}");
    }
}

/// A frame of beams up to thirty times as dense as each other, pinned to the ground at a corner, spins without gravity: the most and the
/// last of its energy within ten seconds, of what it was.
fn pinned_frame(random: &mut Random) -> [f64; 2] {
    let unit = [0.05, 0.1, 1.0, 1.0, 10.0][random.below(5) as usize];
    let rate = [30.0, 60.0, 60.0, 120.0][random.below(4) as usize];
    let substeps = [2, 4, 4, 8][random.below(4) as usize];
    let mut world = World::new(Vec2::ZERO);
    (world.settings.substeps, world.settings.length_unit) = (substeps, unit);
    let (side, columns, rows) = (random.range(0.5, 1.5), 1 + random.below(3), 1 + random.below(4));
    let welded = random.below(2) == 0;
    let density = || 10.0_f32.powf(random.range(0.0, 1.5)) / (unit * unit);
    let corners = frame(&mut world, (unit * side, columns, rows), welded, density);
    let (place, body, there) = corners[random.below(corners.len() as u64) as usize];
    let pin = Vec2::new(place.0 as f32, place.1 as f32) * (unit * side);
    let ground = world.add_body(RigidBody::fixed()).unwrap();
    world.add_joint(ground, body, JointDef::revolute().anchors(pin, there)).unwrap();
    let spin = random.range(1.0, 12.0).min(0.05 * rate * substeps as f32);
    for id in world.body_ids().collect::<Vec<_>>() {
        let mut body = world.body_mut(id).unwrap();
        let arm = body.position() - pin;
        body.set_velocity(Vec2::new(-arm.y, arm.x) * spin);
        body.set_angular_velocity(spin);
    }
    let (before, mut most) = (world.kinetic_energy(), 0.0_f64);
    for _ in 0..10 * rate as u32 {
        world.step(1.0 / rate);
        most = most.max(world.kinetic_energy());
    }
    [most, world.kinetic_energy()].map(|energy| energy / before)
}

/// What joints of their loops strained each other with grew from substep to substep: energies of up to a hundred times as much.
#[test]
fn pinned_frames_that_spin_keep_their_energy() {
    let mut random = Random::new(7);
    for k in 0..60 {
        let [most, last] = pinned_frame(&mut random);
        assert!(most < 1.01 && last > 0.99, "{k}: {most} at most, {last} at last");
    }
}
