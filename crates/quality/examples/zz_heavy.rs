//! Temporary: families of loads on light stacks.
use tiny_physics::{BodyId, JointDef, RigidBody, Shape, ShapeDef, Vec2, World};

struct R(u64);
impl R {
    fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E3779B97F4A7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58476D1CE4E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D049BB133111EB);
        z ^ (z >> 31)
    }
    fn f(&mut self, a: f32, b: f32) -> f32 {
        a + (b - a) * ((self.word() >> 40) as f32 / (1u64 << 24) as f32)
    }
    fn n(&mut self, a: usize, b: usize) -> usize {
        a + (self.word() % (b - a + 1) as u64) as usize
    }
}

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let kind = args[1].as_str();
    let count: u64 = args[2].parse().unwrap();
    let first: u64 = args.get(3).map_or(0, |a| a.parse().unwrap());
    let verbose = args.get(4).is_some();
    let (mut awake, mut deep, mut thrown, mut bad, mut fast) = (0, 0, 0, 0, 0);
    let mut sinks = vec![];
    let mut sleeps = vec![];
    for seed in first..first + count {
        let mut r = R(seed.wrapping_mul(7919) + 17);
        r.word();
        let base = kind == "base";
        let base_ish = kind.starts_with("base");
        let unit = if base_ish { 1.0 } else { [0.05, 0.2, 1.0, 1.0, 5.0, 20.0][r.n(0, 5)] };
        let size = if base_ish { 1.0 } else { unit * [0.1f32, 0.3, 1.0, 3.0, 10.0][r.n(0, 4)] };
        let hz = if base_ish { 60 } else { [30, 60, 60, 120, 240][r.n(0, 4)] };
        let sub = if base_ish { 4 } else { [1u32, 2, 4, 4, 8][r.n(0, 4)] };
        let ratio = if base { r.f(550.0, 1000.0) } else { 100.0 * 20f32.powf(r.f(0.0, 1.0)) };
        let n = if base { r.n(4, 12) } else { r.n(2, 12) };
        let shape = match kind {
            "base" | "baseall" => 0,
            "disks" => 1,
            "planks" => 2,
            "crates" | "drop" | "off" | "table" | "joint" | "varying" => 0,
            _ => r.n(0, 2),
        };
        let mut w = World::new(Vec2::new(0.0, -10.0 * unit));
        w.settings.length_unit = unit;
        w.settings.substeps = sub;
        let floor = RigidBody::fixed()
            .shape(Shape::rect(100.0 * size, size).unwrap())
            .position(Vec2::new(0.0, -size));
        let floor = w.add_body(floor).unwrap();
        let mut bodies: Vec<(BodyId, Vec2)> = vec![];
        let mass = 1.0;
        let columns = if kind == "table" { 2 } else { 1 };
        let mut top = 0.0f32;
        let jit = r.f(0.0, 0.05);
        for c in 0..columns {
            let x0 = if columns == 2 { (c as f32 - 0.5) * 4.0 * size } else { 0.0 };
            top = 0.0;
            let half0 = 0.5 * size;
            for _ in 0..n {
                let half = if columns == 2 { half0 } else { half0 * r.f(0.9, 1.1) };
                let x = x0 + r.f(-jit, jit) * size;
                let (s, h) = match shape {
                    0 => (Shape::rect(half, half).unwrap(), half),
                    1 => (Shape::circle(half0).unwrap(), half0),
                    _ => (Shape::rect(2.0 * half, 0.15 * half).unwrap(), 0.15 * half),
                };
                let x = if shape == 1 { 0.0 } else { x };
                let p = Vec2::new(x, top + h);
                let b = RigidBody::dynamic().shape(ShapeDef::new(s)).mass(mass).position(p);
                bodies.push((w.add_body(b).unwrap(), p));
                top += 2.0 * h;
            }
        }
        if shape == 1 {
            for s in [-1.0, 1.0] {
                let wall = Shape::rect(0.5 * size, 2.0 * top).unwrap();
                w.add_body(
                    RigidBody::fixed().shape(wall).position(Vec2::new(s * 1.01 * size, 0.0)),
                )
                .unwrap();
            }
        }
        let gap = if kind == "drop" || kind == "basedrop" { 1.0 * size } else { 0.0 };
        let half = 0.5 * size;
        let (s, h) = match kind {
            "table" => (Shape::rect(3.0 * size, half).unwrap(), half),
            _ if shape == 1 => (Shape::rect(half, half).unwrap(), half),
            _ => (Shape::rect(half, half).unwrap(), half),
        };
        let x = if kind == "off" {
            r.f(-0.35, 0.35) * size
        } else if shape == 1 {
            0.0
        } else {
            r.f(-jit, jit) * size
        };
        let p = Vec2::new(x, top + h + gap);
        let heavy = RigidBody::dynamic().shape(ShapeDef::new(s)).mass(mass * ratio);
        let load;
        if kind == "joint" {
            // A light press on the stack, a heavy thing hinged or welded to it.
            let press = RigidBody::dynamic()
                .shape(ShapeDef::new(Shape::rect(half, 0.5 * half).unwrap()))
                .mass(mass)
                .position(Vec2::new(x, top + 0.5 * half));
            let press = w.add_body(press).unwrap();
            let p = Vec2::new(x, top + 3.0 * size);
            load = (w.add_body(heavy.position(p)).unwrap(), p);
            let j = if seed % 2 == 0 {
                JointDef::weld()
            } else {
                JointDef::prismatic(Vec2::Y).direction(Vec2::Y).limits(-0.2 * size, 0.2 * size)
            };
            let rail =
                JointDef::prismatic(Vec2::Y).anchor_at(p).direction(Vec2::Y).collide_connected();
            w.add_joint(floor, load.0, rail).unwrap();
            w.add_joint(press, load.0, j.anchor_at(Vec2::new(x, top + half))).unwrap();
        } else {
            load = (w.add_body(heavy.position(p)).unwrap(), p);
        }
        bodies.push(load);
        let dt = 1.0 / hz as f32;
        let steps = 10 * hz;
        let mut asleep_at = None;
        let mut most_late = 0.0f32;
        let mut lowest = f32::INFINITY;
        for step in 0..steps {
            let dt = if kind == "varying" { r.f(1.0 / 120.0, 1.0 / 30.0) } else { dt };
            w.step(dt);
            if std::env::var("TRACE").is_ok()
                && (step >= std::env::var("TRACE").unwrap().parse::<usize>().unwrap()
                    && step < 50 + std::env::var("TRACE").unwrap().parse::<usize>().unwrap())
            {
                let v = |b: &BodyId| w.body(*b).unwrap().velocity() * (1.0 / size);
                let most = bodies.iter().map(|(b, _)| v(b).length()).fold(0.0f32, f32::max);
                println!(
                    "{step:4} squeezed {} refined {:?} heavy y {:.5} v {:.4} {:.4} most {most:.4} pen {:.4}",
                    w.stats().squeezed_bodies,
                    (),
                    (w.body(load.0).unwrap().position().y as f32 - load.1.y) / size,
                    v(&load.0).x,
                    v(&load.0).y,
                    w.max_penetration() / size
                );
            }
            let awake = w.awake_body_count() > 0;
            if !awake && asleep_at.is_none() {
                asleep_at = Some((step + 1) as f32 * dt);
            }
            if awake {
                asleep_at = None;
            }
            if step > steps / 2 {
                for (b, _) in &bodies {
                    most_late = most_late.max(w.body(*b).unwrap().velocity().length() / size);
                }
            }
            let drop = w.body(load.0).unwrap().position().y as f32;
            lowest = lowest.min(drop);
        }
        let side = bodies
            .iter()
            .map(|(b, p)| (w.body(*b).unwrap().position().x as f32 - p.x).abs() / size)
            .fold(0.0f32, f32::max);
        let pen = w.max_penetration() / size;
        let sink = (load.1.y - gap - w.body(load.0).unwrap().position().y as f32) / size;
        let sink = if kind == "joint" && seed % 2 == 1 { sink - 0.2 } else { sink };
        let dip = (load.1.y - gap - lowest) / size;
        let is_thrown = side > 0.2 || sink > 0.5;
        let is_deep = pen > 0.01 || sink > 0.01 * n as f32;
        if asleep_at.is_none() {
            awake += 1;
        }
        if is_thrown {
            thrown += 1;
        }
        if is_deep {
            deep += 1;
        }
        if most_late > 0.1 {
            fast += 1;
        }
        if is_thrown || is_deep || asleep_at.is_none() {
            bad += 1;
        }
        sinks.push(pen);
        if let Some(t) = asleep_at {
            sleeps.push(t);
        }
        if verbose {
            println!(
                "{seed:4} unit {unit:5} size {size:6.3} hz {hz:3} sub {sub} ratio {ratio:6.0} n {n:2} shape {shape} sleep {asleep_at:?} late {most_late:.3} side {side:.3} pen {pen:.4} sink {sink:.4} dip {dip:.4}{}",
                if is_thrown || is_deep || asleep_at.is_none() { " BAD" } else { "" }
            );
        }
    }
    sinks.sort_by(f32::total_cmp);
    sleeps.sort_by(f32::total_cmp);
    let mid = |v: &Vec<f32>| {
        (v.get(v.len() / 2).copied().unwrap_or(-1.0), v.last().copied().unwrap_or(-1.0))
    };
    println!(
        "{kind:8} {count}: bad {bad} awake {awake} deep {deep} thrown {thrown} fast {fast}; pen median/worst {:.4?} sleep {:.2?}",
        mid(&sinks),
        mid(&sleeps)
    );
}
