//! Micro-benchmarks of the parts: `cargo bench --bench micro [NAME]`. Times are for one item: a box, a query, a
//! pair of shapes, a contact of a step, a joint of a step, a ray, a body of a frame.

mod parts;

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use parts::{DT, KINDS, MARGIN, Random};
use std::ops::ControlFlow;
use tiny_physics::broad_phase::{BroadPhase, DynamicTree, ProxyDef, ProxyId, ProxyKind};
use tiny_physics::{Aabb, QueryFilter, SimdLevel, SpatialHash, Vec2, World, collide};

const COUNTS: [usize; 2] = [1000, 20_000];

fn main() {
    divan::main();
}

fn hash(boxes: &[Aabb]) -> SpatialHash {
    let cell_size = SpatialHash::suggested_cell_size(boxes.iter().copied());
    let mut hash = SpatialHash::new(cell_size).expect("a positive size");
    fill(&mut hash, boxes);
    hash
}

fn fill(hash: &mut SpatialHash, boxes: &[Aabb]) {
    hash.clear();
    (0..).zip(boxes).for_each(|(id, aabb)| hash.insert(id, *aabb));
}

fn tree(boxes: &[Aabb]) -> DynamicTree {
    let mut tree = DynamicTree::new();
    (0..).zip(boxes).for_each(|(id, aabb)| tree.insert(id, *aabb, 1));
    tree.rebuild();
    tree
}

#[divan::bench(args = COUNTS)]
fn hash_insert(bencher: Bencher, count: usize) {
    let boxes = parts::boxes(count);
    let mut hash = hash(&boxes);
    bencher.counter(ItemsCount::new(count)).bench_local(|| fill(&mut hash, &boxes));
}

#[divan::bench(args = COUNTS)]
fn hash_pairs(bencher: Bencher, count: usize) {
    let hash = hash(&parts::boxes(count));
    let mut pairs = Vec::new();
    bencher.counter(ItemsCount::new(count)).bench_local(|| {
        pairs.clear();
        hash.pairs(&mut pairs);
        pairs.len()
    });
}

#[divan::bench(args = COUNTS)]
fn hash_query(bencher: Bencher, count: usize) {
    let boxes = parts::boxes(count);
    let hash = hash(&boxes);
    bencher.counter(ItemsCount::new(count)).bench_local(|| {
        let mut found = 0;
        for aabb in &boxes {
            hash.query(aabb, |_| {
                found += 1;
                ControlFlow::Continue(())
            });
        }
        found
    });
}

#[divan::bench(args = COUNTS)]
fn tree_query(bencher: Bencher, count: usize) {
    let boxes = parts::boxes(count);
    let tree = tree(&boxes);
    bencher.counter(ItemsCount::new(count)).bench_local(|| {
        let mut found = 0;
        for aabb in &boxes {
            tree.query(aabb, u64::MAX, |_| {
                found += 1;
                ControlFlow::Continue(())
            });
        }
        found
    });
}

/// What the world does where all boxes have left their fat boxes: moved boxes ask in groups.
#[divan::bench(args = COUNTS)]
fn tree_pairs(bencher: Bencher, count: usize) {
    let boxes = parts::boxes(count);
    let mut broad_phase = BroadPhase::new();
    for (user, aabb) in (0..).zip(&boxes) {
        let def = ProxyDef { kind: ProxyKind::Dynamic, category: 1, mask: 1, user, margin: MARGIN };
        broad_phase.create_proxy(def, *aabb);
    }
    let mut pairs = Vec::new();
    broad_phase.update_pairs(&mut pairs);
    bencher.counter(ItemsCount::new(count)).bench_local(|| {
        (0..count as u32).for_each(|id| broad_phase.buffer(ProxyId(id)));
        pairs.clear();
        broad_phase.update_pairs(&mut pairs);
        pairs.len()
    });
}

#[divan::bench(args = KINDS)]
fn manifold(bencher: Bencher, kind: &str) {
    let (a, b) = parts::shapes(kind);
    let places = parts::places(256);
    bencher.counter(ItemsCount::new(places.len())).bench_local(|| {
        let one = |place| usize::from(collide(black_box(&a), black_box(&b), place, 0.02).count);
        places.iter().copied().map(one).sum::<usize>()
    });
}

/// A whole step; the item is a contact.
#[divan::bench(args = [10, 40])]
fn step_of_pyramid(bencher: Bencher, rows: usize) {
    let mut world = parts::pyramid(rows, SimdLevel::detect());
    bencher.counter(ItemsCount::new(world.contact_count())).bench_local(|| world.step(DT));
}

/// The same with eight iterations more in each of the four substeps: what these cost is the contact solver's.
#[divan::bench(args = [10, 40])]
fn step_of_pyramid_with_32_more_passes(bencher: Bencher, rows: usize) {
    let mut world = parts::pyramid(rows, SimdLevel::detect());
    world.settings.iterations += 8;
    bencher.counter(ItemsCount::new(world.contact_count())).bench_local(|| world.step(DT));
}

#[divan::bench(args = [200, 2000])]
fn step_of_heap(bencher: Bencher, count: usize) {
    let mut world = parts::heap(count, SimdLevel::detect());
    bencher.counter(ItemsCount::new(world.contact_count())).bench_local(|| world.step(DT));
}

/// A whole step; the item is a joint.
#[divan::bench(args = [16, 50])]
fn step_of_net(bencher: Bencher, side: usize) {
    let mut world = parts::net(side, SimdLevel::detect());
    bencher.counter(ItemsCount::new(world.joint_count())).bench_local(|| world.step(DT));
}

fn rays(world: &World) -> Vec<(Vec2, Vec2)> {
    let mut random = Random(5);
    let side = (world.body_count() as f32).sqrt();
    let mut point = || Vec2::new(random.range(-side, side), random.range(0.0, side));
    (0..256).map(|_| (point(), point())).map(|(from, to)| (from, to - from)).collect()
}

#[divan::bench(args = [200, 2000])]
fn ray_cast(bencher: Bencher, count: usize) {
    let world = parts::heap(count, SimdLevel::detect());
    let (rays, filter) = (rays(&world), QueryFilter::default());
    bencher.counter(ItemsCount::new(rays.len())).bench_local(|| {
        rays.iter().filter(|(from, way)| world.ray_cast(*from, *way, &filter).is_some()).count()
    });
}

/// Saving a frame into new memory; the item is a body.
#[divan::bench(args = [200, 2000])]
fn frame_clone(bencher: Bencher, count: usize) {
    let world = parts::heap(count, SimdLevel::detect());
    bencher.counter(ItemsCount::new(world.body_count())).bench_local(|| world.clone());
}

/// Going back to a frame, in the memory at hand.
#[divan::bench(args = [200, 2000])]
fn frame_restore(bencher: Bencher, count: usize) {
    let frame = parts::heap(count, SimdLevel::detect());
    let mut world = frame.clone();
    bencher.counter(ItemsCount::new(frame.body_count())).bench_local(|| world.clone_from(&frame));
}
