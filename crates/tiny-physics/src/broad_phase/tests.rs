//! Trees and broad phase against brute force, over random commands.

use super::*;
use core::ops::ControlFlow;
use proptest::prelude::*;

/// One command on a set of boxes.
#[derive(Clone, Debug)]
enum Command {
    Insert(u32, Aabb, u64),
    Remove(u32),
    Move(u32, Aabb),
    Category(u32, u64),
    Rebuild,
}

pub(crate) fn any_box() -> impl Strategy<Value = Aabb> {
    let coordinate = prop_oneof![
        8 => -20.0f32..20.0,
        1 => Just(1.0e7),
        1 => prop_oneof![Just(f32::INFINITY), Just(f32::NEG_INFINITY), Just(f32::NAN), Just(0.0)],
    ];
    let size = prop_oneof![8 => 0.0f32..3.0, 1 => 0.0f32..50.0, 1 => Just(-1.0)];
    (coordinate.clone(), coordinate, size.clone(), size).prop_map(|(x, y, width, height)| {
        Aabb::new(Vec2::new(x, y), Vec2::new(x + width, y + height))
    })
}

fn any_command() -> impl Strategy<Value = Command> {
    let category = prop_oneof![Just(1u64), Just(2), Just(3), Just(0), Just(u64::MAX)];
    prop_oneof![
        5 => (0u32..60, any_box(), category.clone()).prop_map(|(id, b, c)| Command::Insert(id, b, c)),
        2 => (0u32..60).prop_map(Command::Remove),
        5 => (0u32..60, any_box()).prop_map(|(id, b)| Command::Move(id, b)),
        1 => (0u32..60, category).prop_map(|(id, c)| Command::Category(id, c)),
        1 => Just(Command::Rebuild),
    ]
}

/// Tells where a proxy is now. True where it left its fat box.
fn move_proxy(boxes: &mut BroadPhase, id: ProxyId, tight: Aabb, ahead: Vec2) -> bool {
    boxes.needed_fat_aabb(id, tight, ahead).is_some_and(|fat| boxes.set_fat_aabb(id, fat))
}

fn found_by_tree(tree: &DynamicTree, aabb: &Aabb, mask: u64) -> Vec<u32> {
    let mut found = Vec::new();
    tree.query(aabb, mask, |id| {
        found.push(id);
        ControlFlow::Continue(())
    });
    found.sort_unstable();
    found
}

proptest! {
    #[test]
    fn tree_finds_what_brute_force_finds(
        commands in prop::collection::vec(any_command(), 1..200),
        probe in any_box(),
    ) {
        let mut tree = DynamicTree::new();
        let mut model: [Option<(Aabb, u64)>; 60] = [None; 60];
        for command in commands {
            match command {
                Command::Insert(id, aabb, category) => {
                    tree.insert(id, aabb, category);
                    model[id as usize] = Some((clamped(aabb), category));
                }
                Command::Remove(id) => {
                    prop_assert_eq!(tree.remove(id), model[id as usize].is_some());
                    model[id as usize] = None;
                }
                Command::Move(id, aabb) => {
                    prop_assert_eq!(tree.update(id, aabb), model[id as usize].is_some());
                    if let Some(entry) = &mut model[id as usize] {
                        entry.0 = clamped(aabb);
                    }
                }
                Command::Category(id, category) => {
                    prop_assert_eq!(tree.set_category(id, category), model[id as usize].is_some());
                    if let Some(entry) = &mut model[id as usize] {
                        entry.1 = category;
                    }
                }
                Command::Rebuild => tree.rebuild(),
            }
            prop_assert_eq!(tree.validate(), Ok(()));
        }
        prop_assert_eq!(tree.len(), model.iter().flatten().count());
        let boxes = model.iter().flatten().map(|entry| entry.0).chain([probe]);
        for aabb in boxes.collect::<Vec<_>>() {
            for mask in [1, 2, u64::MAX] {
                let expected: Vec<u32> = (0..60)
                    .filter(|&id| model[id as usize].is_some_and(|(other, category)| {
                        category & mask != 0 && other.overlaps(&clamped(aabb))
                    }))
                    .collect();
                prop_assert_eq!(found_by_tree(&tree, &aabb, mask), expected);
            }
        }
        let copy = tree.clone();
        prop_assert_eq!(copy.validate(), Ok(()));
        prop_assert_eq!(found_by_tree(&copy, &probe, 1), found_by_tree(&tree, &probe, 1));
    }

    #[test]
    fn cast_misses_no_box_that_the_segment_touches(
        boxes in prop::collection::vec((-20.0f32..20.0, -20.0f32..20.0, 0.0f32..3.0), 1..60),
        from in (-30.0f32..30.0, -30.0f32..30.0),
        to in (-30.0f32..30.0, -30.0f32..30.0),
    ) {
        let mut tree = DynamicTree::new();
        let boxes: Vec<Aabb> = boxes
            .iter()
            .map(|&(x, y, r)| Aabb::from_center(Vec2::new(x, y), Vec2::splat(r)))
            .collect();
        for (id, aabb) in boxes.iter().enumerate() {
            tree.insert(id as u32, *aabb, 1);
        }
        let (from, to) = (Vec2::from(from), Vec2::from(to));
        let cast = BoxCast::ray(from, to - from);
        let mut all = vec![false; boxes.len()];
        tree.cast(&cast, 1.0, 1, |id, limit| {
            all[id as usize] = true;
            limit
        });
        let entry = |aabb: &Aabb| {
            (0..=400).map(|k| k as f32 / 400.0).find(|&t| aabb.contains_point(from + (to - from) * t))
        };
        for (id, aabb) in boxes.iter().enumerate() {
            prop_assert!(all[id] || entry(aabb).is_none(), "box {} is missed", id);
        }
        let mut nearest = 1.0f32;
        tree.cast(&cast, 1.0, 1, |id, limit| {
            let hit = entry(&boxes[id as usize]).filter(|&t| t < limit);
            nearest = hit.unwrap_or(limit);
            nearest
        });
        let expected = boxes.iter().filter_map(entry).fold(1.0, |a: f32, b| if b < a { b } else { a });
        prop_assert_eq!(nearest, expected);
    }

    #[test]
    fn broad_phase_finds_the_pairs_of_brute_force(
        commands in prop::collection::vec((any_command(), 0u8..3, any::<bool>()), 1..150),
        chunk in 1usize..7,
    ) {
        let mut broad_phase = BroadPhase::new();
        let mut model: Model = [None; 60];
        let mut out = Vec::new();
        for (command, kind, update) in commands {
            apply(&mut broad_phase, &mut model, command, kind);
            prop_assert_eq!(broad_phase.validate(), Ok(()));
            if update {
                let expected = brute_force(&broad_phase, &model);
                prop_assert_eq!(&in_chunks(&mut broad_phase, chunk), &expected);
                let mut copy = BroadPhase::new();
                copy.clone_from(&broad_phase);
                broad_phase.update_pairs(&mut out);
                prop_assert_eq!(&out, &expected);
                copy.update_pairs(&mut out);
                prop_assert_eq!(&out, &expected);
                prop_assert!(broad_phase.moved().is_empty());
                for (id, _, asked) in model.iter_mut().flatten() {
                    *asked = broad_phase.fat_aabb(*id).expect("a proxy");
                }
            }
        }
    }
}

#[test]
fn what_rests_asks_for_nothing() {
    let mut broad_phase = BroadPhase::new();
    let mut pairs = Vec::new();
    let aabb = |i: u32| Aabb::from_center(Vec2::new(i as f32, 0.0), Vec2::splat(0.5));
    let ids: Vec<ProxyId> = (0..100)
        .map(|user| {
            let kind = if user < 50 { ProxyKind::Static } else { ProxyKind::Dynamic };
            let def = ProxyDef { kind, category: 1, mask: u64::MAX, user, margin: 0.05 };
            broad_phase.create_proxy(def, aabb(user))
        })
        .collect();
    broad_phase.update_pairs(&mut pairs);
    assert_eq!(pairs.len(), 50);
    for &id in &ids {
        assert!(!move_proxy(&mut broad_phase, id, aabb(id.0).grown(0.04), Vec2::ZERO));
    }
    assert!(broad_phase.moved().is_empty());
    assert_eq!(broad_phase.prepare_pairs(), 0);
    // A static proxy that is put elsewhere finds the dynamic ones there.
    assert!(move_proxy(&mut broad_phase, ids[3], aabb(70), Vec2::ZERO));
    broad_phase.update_pairs(&mut pairs);
    assert_eq!(pairs, [(3, 69), (3, 70), (3, 71)]);
}

#[test]
fn masks_keep_pairs_out() {
    let mut broad_phase = BroadPhase::new();
    for user in 0..1000 {
        let kind = ProxyKind::Dynamic;
        let def = ProxyDef { kind, category: 2, mask: !2, user, margin: 0.1 };
        broad_phase.create_proxy(def, Aabb::from_center(Vec2::ZERO, Vec2::splat(1.0)));
    }
    let mut pairs = vec![(0, 1)];
    broad_phase.update_pairs(&mut pairs);
    assert!(pairs.is_empty());
}

#[test]
fn a_tree_filled_in_any_order_stays_low() {
    let mut tree = DynamicTree::new();
    for id in 0..10_000 {
        tree.insert(id, Aabb::from_center(Vec2::new(id as f32, 0.0), Vec2::splat(0.5)), 1);
    }
    assert!(tree.height() <= 9, "{}", tree.height());
    let grown = tree.area_ratio();
    tree.rebuild();
    assert_eq!(tree.validate(), Ok(()));
    assert_eq!(tree.height(), 5);
    assert!(tree.area_ratio() <= grown);
}

/// One box at 20 km hid in a sum of perimeters how the others changed places: the tree was not built anew, and its nodes became four
/// times as large.
#[test]
fn a_box_far_off_does_not_keep_a_tree_from_being_built_anew() {
    let mut seed = 1_u32;
    let mut place = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 8) as f32 / (1 << 24) as f32 * 200.0
    };
    let mut tree = DynamicTree::new();
    tree.insert(300, Aabb::from_center(Vec2::new(2.0e4, 0.0), Vec2::splat(0.5)), 1);
    for round in 0..5 {
        for id in 0..300 {
            let aabb = Aabb::from_center(Vec2::new(place(), place()), Vec2::splat(0.5));
            if round == 0 {
                tree.insert(id, aabb, 1);
            } else {
                tree.update(id, aabb);
            }
        }
        tree.maintain();
    }
    tree.remove(300);
    let kept = tree.area_ratio();
    tree.rebuild();
    assert!(kept < 1.6 * tree.area_ratio(), "{kept} {}", tree.area_ratio());
}

/// Proxies with the boxes with which they last asked for partners.
type Model = [Option<(ProxyId, ProxyDef, Aabb)>; 60];

fn apply(broad_phase: &mut BroadPhase, model: &mut Model, command: Command, kind: u8) {
    let kind = [ProxyKind::Static, ProxyKind::Kinematic, ProxyKind::Dynamic][kind as usize];
    match command {
        Command::Insert(user, aabb, category) => {
            if let Some((id, ..)) = model[user as usize].take() {
                broad_phase.destroy_proxy(id);
            }
            let mask = if user % 5 == 0 { 2 } else { u64::MAX };
            let def = ProxyDef { kind, category, mask, user, margin: 0.1 };
            let id = broad_phase.create_proxy(def, aabb);
            model[user as usize] = Some((id, def, Aabb::EMPTY));
        }
        Command::Remove(user) => {
            if let Some((id, ..)) = model[user as usize].take() {
                assert!(broad_phase.destroy_proxy(id));
                assert!(!broad_phase.destroy_proxy(id));
            }
        }
        Command::Move(user, aabb) => {
            if let Some((id, ..)) = model[user as usize] {
                let inside = broad_phase.fat_aabb(id).is_some_and(|fat| fat.contains(&aabb));
                assert_ne!(move_proxy(broad_phase, id, aabb, Vec2::new(0.5, -0.5)), inside);
            }
        }
        Command::Category(user, category) => {
            if let Some((id, def, asked)) = &mut model[user as usize] {
                (def.category, def.mask) = (category, u64::MAX);
                *asked = Aabb::EMPTY;
                broad_phase.set_filter(*id, category, u64::MAX);
            }
        }
        Command::Rebuild => drop(broad_phase.prepare_pairs()),
    }
}

fn brute_force(broad_phase: &BroadPhase, model: &Model) -> Vec<(u32, u32)> {
    let moved = |id: ProxyId| broad_phase.moved().contains(&id);
    let mut pairs = Vec::new();
    for a in 0..60 {
        for b in a + 1..60 {
            let (Some((id_a, def_a, asked_a)), Some((id_b, def_b, asked_b))) = (model[a], model[b])
            else {
                continue;
            };
            let kinds = def_a.kind == ProxyKind::Dynamic || def_b.kind == ProxyKind::Dynamic;
            let filter = def_a.category & def_b.mask != 0 && def_b.category & def_a.mask != 0;
            let boxes = broad_phase.fat_aabb(id_a).zip(broad_phase.fat_aabb(id_b));
            let near = boxes.is_some_and(|(a, b)| a.overlaps(&b));
            let new = !asked_a.overlaps(&asked_b);
            if kinds && filter && near && new && (moved(id_a) || moved(id_b)) {
                pairs.push((a as u32, b as u32));
            }
        }
    }
    pairs
}

/// The pairs as several threads would find them.
fn in_chunks(broad_phase: &mut BroadPhase, chunk: usize) -> Vec<(u32, u32)> {
    let (mut out, count) = (Vec::new(), broad_phase.prepare_pairs());
    for start in (0..count).step_by(chunk).rev() {
        broad_phase.query_groups(start..(start + chunk).min(count), |_, _| true, &mut out);
    }
    let found = out.len();
    sort_pairs(&mut out);
    assert_eq!(found, out.len(), "a pair was found twice");
    out
}
