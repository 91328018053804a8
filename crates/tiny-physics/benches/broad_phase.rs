//! Broad phase structures on synthetic motion: all in one process, interleaved, medians.
//!
//! Every contender keeps the same fat boxes and finds the pairs of those that moved; printed are
//! nanoseconds per moved proxy for moving and for querying.

use std::ops::ControlFlow;
use std::time::Instant;
use tiny_physics::broad_phase::{BroadPhase, DynamicTree, ProxyDef, ProxyId, ProxyKind};
use tiny_physics::{Aabb, SpatialHash, Vec2};

const MARGIN: f32 = 0.1;

/// A structure under test.
trait Finder {
    fn name(&self) -> String;
    fn insert(&mut self, id: u32, aabb: Aabb);
    /// The boxes of these ids are new.
    fn moved(&mut self, ids: &[u32], fat: &[Aabb]);
    fn pairs(&self, ids: &[u32], fat: &[Aabb], is_moved: &[bool]) -> (usize, u64);
}

fn mixed(a: u32, b: u32) -> u64 {
    (u64::from(a) << 32 | u64::from(b)).wrapping_mul(0x9E37_79B9_7F4A_7C15)
}

/// Counts pairs and mixes them into a number that does not depend on their order.
macro_rules! count_pairs {
    () => {
        fn pairs(&self, ids: &[u32], fat: &[Aabb], is_moved: &[bool]) -> (usize, u64) {
            let (mut count, mut sum) = (0, 0u64);
            for &id in ids {
                self.find(&fat[id as usize], |other| {
                    if other != id && (other > id || !is_moved[other as usize]) {
                        count += 1;
                        let (a, b) = if id < other { (id, other) } else { (other, id) };
                        sum = sum.wrapping_add(
                            (u64::from(a) << 32 | u64::from(b)).wrapping_mul(0x9E37_79B9_7F4A_7C15),
                        );
                    }
                });
            }
            (count, sum)
        }
    };
}

/// The tree alone: every moved box asks for itself.
#[derive(Default)]
struct Tree {
    tree: DynamicTree,
}

impl Tree {
    #[inline]
    fn find(&self, aabb: &Aabb, mut visit: impl FnMut(u32)) {
        self.tree.query(aabb, u64::MAX, |id| {
            visit(id);
            ControlFlow::Continue(())
        });
    }
}

impl Finder for Tree {
    fn name(&self) -> String {
        "tree, one by one".into()
    }
    fn insert(&mut self, id: u32, aabb: Aabb) {
        self.tree.insert(id, aabb, 1);
    }
    fn moved(&mut self, ids: &[u32], fat: &[Aabb]) {
        for &id in ids {
            self.tree.update(id, fat[id as usize]);
        }
        self.tree.maintain();
    }
    count_pairs!();
}

/// What the world uses.
#[derive(Default)]
struct Facade {
    broad_phase: BroadPhase,
    groups: usize,
}

impl Finder for Facade {
    fn name(&self) -> String {
        "broad phase".into()
    }
    fn insert(&mut self, user: u32, aabb: Aabb) {
        let kind = ProxyKind::Dynamic;
        let def = ProxyDef { kind, category: 1, mask: u64::MAX, user, margin: 0.0 };
        assert_eq!(self.broad_phase.create_proxy(def, aabb), ProxyId(user));
    }
    fn moved(&mut self, ids: &[u32], fat: &[Aabb]) {
        self.broad_phase.clear_moved();
        for &id in ids {
            self.broad_phase.set_fat_aabb(ProxyId(id), fat[id as usize]);
        }
        self.groups = self.broad_phase.prepare_pairs();
    }
    fn pairs(&self, _: &[u32], _: &[Aabb], _: &[bool]) -> (usize, u64) {
        let (mut count, mut sum) = (0, 0u64);
        let accept = |a, b| {
            count += 1;
            sum = sum.wrapping_add(mixed(a, b));
            false
        };
        self.broad_phase.query_groups(0..self.groups, accept, &mut Vec::new());
        (count, sum)
    }
}

/// The spatial hash, filled anew every step.
struct Hash {
    hash: SpatialHash,
    boxes: Vec<Aabb>,
}

impl Hash {
    fn new(boxes: &[Aabb]) -> Self {
        let cell_size = SpatialHash::suggested_cell_size(boxes.iter().copied());
        Self { hash: SpatialHash::new(cell_size).expect("a positive size"), boxes: Vec::new() }
    }
    #[inline]
    fn find(&self, aabb: &Aabb, mut visit: impl FnMut(u32)) {
        self.hash.query(aabb, |id| {
            visit(id);
            ControlFlow::Continue(())
        });
    }
}

impl Finder for Hash {
    fn name(&self) -> String {
        "spatial hash".into()
    }
    fn insert(&mut self, _: u32, aabb: Aabb) {
        self.boxes.push(aabb);
    }
    fn moved(&mut self, ids: &[u32], fat: &[Aabb]) {
        for &id in ids {
            self.boxes[id as usize] = fat[id as usize];
        }
        self.hash.clear();
        for (id, aabb) in self.boxes.iter().enumerate() {
            self.hash.insert(id as u32, *aabb);
        }
    }
    count_pairs!();
}

/// Uniform grid made anew every step by counting sort; each box in the cell of its centre.
#[derive(Default)]
struct Grid {
    boxes: Vec<Aabb>,
    cell: f32,
    origin: Vec2,
    columns: usize,
    rows: usize,
    starts: Vec<u32>,
    sorted: Vec<(Aabb, u32)>,
}

impl Grid {
    fn cell_of(&self, p: Vec2) -> (usize, usize) {
        let v = (p - self.origin) * (1.0 / self.cell);
        ((v.x.max(0.0) as usize).min(self.columns - 1), (v.y.max(0.0) as usize).min(self.rows - 1))
    }
    #[inline]
    fn find(&self, aabb: &Aabb, mut visit: impl FnMut(u32)) {
        let reach = Vec2::splat(0.5 * self.cell);
        let (low, high) = (self.cell_of(aabb.min - reach), self.cell_of(aabb.max + reach));
        for row in low.1..=high.1 {
            let start = self.starts[row * self.columns + low.0];
            let end = self.starts[row * self.columns + high.0 + 1];
            for (other, id) in &self.sorted[start as usize..end as usize] {
                if other.overlaps(aabb) {
                    visit(*id);
                }
            }
        }
    }
    fn build(&mut self) {
        let mut all = Aabb::EMPTY;
        let mut side = 0.0f32;
        for aabb in &self.boxes {
            all = all.union(aabb);
            let size = aabb.max - aabb.min;
            side = side.max(size.x).max(size.y);
        }
        self.cell = side;
        self.origin = all.min;
        let size = (all.max - all.min) * (1.0 / side);
        (self.columns, self.rows) = (size.x as usize + 1, size.y as usize + 1);
        self.starts.clear();
        self.starts.resize(self.columns * self.rows + 2, 0);
        let cells: Vec<u32> = self
            .boxes
            .iter()
            .map(|b| {
                let (x, y) = self.cell_of(b.center());
                (y * self.columns + x) as u32
            })
            .collect();
        for &cell in &cells {
            self.starts[cell as usize + 2] += 1;
        }
        for i in 2..self.starts.len() {
            self.starts[i] += self.starts[i - 1];
        }
        self.sorted.resize(self.boxes.len(), (Aabb::EMPTY, 0));
        for (id, &cell) in cells.iter().enumerate() {
            let at = &mut self.starts[cell as usize + 1];
            self.sorted[*at as usize] = (self.boxes[id], id as u32);
            *at += 1;
        }
    }
}

impl Finder for Grid {
    fn name(&self) -> String {
        "grid".into()
    }
    fn insert(&mut self, _: u32, aabb: Aabb) {
        self.boxes.push(aabb);
    }
    fn moved(&mut self, ids: &[u32], fat: &[Aabb]) {
        for &id in ids {
            self.boxes[id as usize] = fat[id as usize];
        }
        self.build();
    }
    count_pairs!();
}

struct Random(u64);

impl Random {
    fn unit(&mut self) -> f32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 40) as f32 / (1u64 << 24) as f32
    }
}

/// Boxes with velocities, and how these change.
struct Scene {
    name: &'static str,
    center: Vec<Vec2>,
    velocity: Vec<Vec2>,
    half: Vec<Vec2>,
    kind: Motion,
    steps: usize,
}

#[derive(Clone, Copy)]
enum Motion {
    /// Round the origin, faster outside, with noise: neighbours mix.
    Stir,
    Fall,
    Rest,
    /// A wave front that runs through a grid at rest.
    Smash,
}

fn scene(name: &'static str, kind: Motion, count: usize, half: f32, steps: usize) -> Scene {
    let mut random = Random(88_172_645_463_325_252);
    let columns = (count as f32).sqrt() as usize;
    let spacing = 2.0 * half;
    let (mut center, mut sizes) = (Vec::new(), Vec::new());
    for i in 0..count {
        let (x, y) = ((i % columns) as f32, (i / columns) as f32);
        center.push(Vec2::new(x, y) * spacing - Vec2::splat(columns as f32 * half));
        sizes.push(Vec2::splat(half * (0.7 + 0.5 * random.unit())));
    }
    Scene { name, velocity: vec![Vec2::ZERO; count], center, half: sizes, kind, steps }
}

impl Scene {
    fn step(&mut self, time: usize, random: &mut Random) {
        let dt = 1.0 / 60.0;
        let extent = (self.center.len() as f32).sqrt() * self.half[0].x;
        for i in 0..self.center.len() {
            let p = self.center[i];
            let noise = Vec2::new(random.unit() - 0.5, random.unit() - 0.5);
            let v = &mut self.velocity[i];
            match self.kind {
                Motion::Stir => {
                    *v = p.perp() * (10.0 / extent) * (p.length() / extent) + noise * 8.0
                }
                Motion::Fall => *v += Vec2::new(0.0, -10.0 * dt) + noise,
                Motion::Rest => *v = noise * 0.01,
                Motion::Smash => {
                    let front = time as f32 * 0.3 - extent;
                    *v = if (p.x - front).abs() < 3.0 { noise * 20.0 } else { Vec2::ZERO };
                }
            }
            self.center[i] += *v * dt;
        }
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn run(mut scene: Scene) {
    let count = scene.center.len();
    let tight = |scene: &Scene, i: usize| Aabb::from_center(scene.center[i], scene.half[i]);
    let mut fat: Vec<Aabb> = (0..count).map(|i| tight(&scene, i).grown(MARGIN)).collect();
    let mut finders: Vec<Box<dyn Finder>> = vec![
        Box::<Tree>::default(),
        Box::<Facade>::default(),
        Box::<Grid>::default(),
        Box::new(Hash::new(&fat)),
    ];
    for finder in &mut finders {
        let start = Instant::now();
        for (id, aabb) in fat.iter().enumerate() {
            finder.insert(id as u32, *aabb);
        }
        finder.moved(&[], &fat);
        print!("[{} {:.0}] ", finder.name(), start.elapsed().as_nanos() as f64 / count as f64);
    }
    println!();
    let mut times = vec![(Vec::new(), Vec::new(), Vec::new()); finders.len()];
    let mut random = Random(1);
    let (mut moved_total, mut pair_total) = (0, 0);
    for time in 0..scene.steps {
        scene.step(time, &mut random);
        let mut ids = Vec::new();
        let mut is_moved = vec![false; count];
        for i in 0..count {
            let tight = tight(&scene, i);
            if !fat[i].contains(&tight) {
                fat[i] = tight.grown(MARGIN);
                ids.push(i as u32);
                is_moved[i] = true;
            }
        }
        if ids.is_empty() {
            continue;
        }
        let mut first = None;
        let n = finders.len();
        for k in 0..n {
            let k = (k + time) % n;
            let start = Instant::now();
            finders[k].moved(&ids, &fat);
            let moving = start.elapsed().as_nanos() as f64 / ids.len() as f64;
            let start = Instant::now();
            let found = finders[k].pairs(&ids, &fat, &is_moved);
            let querying = start.elapsed().as_nanos() as f64 / ids.len() as f64;
            assert_eq!(*first.get_or_insert(found), found);
            times[k].0.push(moving);
            times[k].1.push(querying);
            times[k].2.push(moving + querying);
        }
        moved_total += ids.len();
        pair_total += first.unwrap().0;
    }
    println!(
        "{}: {count} boxes, {} moved a step, {:.1} pairs a moved",
        scene.name,
        moved_total / scene.steps,
        pair_total as f64 / moved_total.max(1) as f64
    );
    for (finder, (moving, querying, both)) in finders.iter().zip(times) {
        if !moving.is_empty() {
            let mean = both.iter().sum::<f64>() / both.len() as f64;
            println!(
                "  {:18} move {:6.0}  query {:6.0}  both median {:6.0} mean {:6.0} ns",
                finder.name(),
                median(moving),
                median(querying),
                median(both),
                mean
            );
        }
    }
}

fn main() {
    let big = std::env::args().any(|arg| arg == "big");
    run(scene("tumbler", Motion::Stir, 2000, 0.15, 200));
    run(scene("spinner", Motion::Stir, 6000, 0.35, 200));
    run(scene("falling", Motion::Fall, 10_000, 0.5, 100));
    run(scene("smash", Motion::Smash, 9600, 0.2, 200));
    run(scene("resting", Motion::Rest, 5050, 0.5, 100));
    if big {
        run(scene("circles", Motion::Fall, 300_000, 0.5, 30));
    }
}
