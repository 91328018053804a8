//! Tests of schedules and transfers, on graphs of many contacts.

use super::*;
use crate::describe::BodyKind;
use crate::geometry::manifold::PairClass;
use crate::math::{DVec2, Pose, Rot};
use crate::threads::{Pool, Team};

const BODIES: u32 = 60;

/// Bodies and contacts between them, none in the graph yet.
struct Stores {
    bodies: Bodies,
    contacts: Contacts,
    graph: Graph,
}

impl Stores {
    fn new(contact_count: usize) -> Self {
        let mut bodies = Bodies::default();
        for i in 0..BODIES {
            let kind = if i < 3 { BodyKind::Static } else { BodyKind::Dynamic };
            let info = BodyInfo { kind, awake: i >= 3, mass: 1.0, ..BodyInfo::default() };
            bodies.insert(info, Pose::new(DVec2::ZERO, Rot::IDENTITY));
        }
        let mut contacts = Contacts::default();
        let mut random = 12_345_u32;
        let mut next = |below: u32| {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (random >> 8) % below
        };
        for k in 0..contact_count as u32 {
            let body_a = 1 + next(BODIES);
            let body_b = 4 + (body_a + next(BODIES - 5)) % (BODIES - 4);
            let (id, tangent_impulse, rest) = (k as f32, 0.5, 0.25 * k as f32);
            let saved = SavedPoint { id, normal_impulse: id, tangent_impulse, rest };
            let contact = Contact {
                alive: true,
                touching: next(4) > 0,
                events: false,
                hit_events: false,
                class: PairClass::ALL[next(3) as usize],
                place: Place::Asleep,
                shape_a: 2 * k,
                shape_b: 2 * k + 1,
                body_a,
                body_b,
                friction: 0.5,
                restitution: 0.0,
                rolling_resistance: 0.0,
                tangent_speed: 0.0,
                saved: [saved; 2],
                links: [(NULL, NULL); 2],
            };
            contacts.insert(&mut bodies, contact);
        }
        Self { bodies, contacts, graph: Graph::default() }
    }

    fn insert(&mut self, team: &Team, indices: impl Iterator<Item = u32>) {
        let Self { bodies, contacts, graph } = self;
        Transfers::default().insert(team, graph, bodies, contacts, indices);
    }

    fn remove(&mut self, team: &Team, indices: impl Iterator<Item = u32>) {
        let Self { bodies, contacts, graph } = self;
        Transfers::default().remove(team, graph, bodies, contacts, indices);
    }

    /// Does the graph have these contacts and no others, each where its record says, with its bodies?
    fn check(&self, indices: impl Iterator<Item = u32>) {
        let mut count = 0;
        for index in indices {
            let contact = &self.contacts.records[index as usize];
            let Place::Graph { colour, slot } = contact.place else { panic!("{index} is not in") };
            assert_eq!(usize::from(colour) == IDLE, !contact.touching, "{index}");
            let bucket = self.graph.bucket(colour.into(), contact.class);
            assert_eq!(bucket.contacts[slot as usize], index);
            assert_eq!(bucket.bodies(slot as usize), (contact.body_a, contact.body_b));
            count += 1;
        }
        assert_eq!(self.graph.len(), count);
    }
}

#[test]
fn many_at_once_are_as_one_by_one() {
    const COUNT: u32 = 900;
    let pool = Pool::new(3);
    pool.scope(|team| {
        let mut many = Stores::new(COUNT as usize);
        let mut single = Stores::new(COUNT as usize);
        many.insert(team, 0..COUNT);
        for index in 0..COUNT {
            let Stores { bodies, contacts, graph } = &mut single;
            graph.insert(bodies, contacts, index);
        }
        assert_eq!(many.graph, single.graph);
        assert_eq!(many.contacts, single.contacts);
        many.check(0..COUNT);

        let gone = |index: &u32| index.is_multiple_of(3) || *index > 800;
        many.remove(team, (0..COUNT).filter(gone));
        many.check((0..COUNT).filter(|index| !gone(index)));
        for index in (0..COUNT).filter(gone) {
            let Stores { bodies, contacts, graph } = &mut single;
            graph.remove(bodies, contacts, index);
            let [many, single] = [&many, &single].map(|s| &s.contacts.records[index as usize]);
            assert_eq!(many.place, Place::Asleep);
            assert_eq!(many.saved, single.saved);
        }
        // Colours are free again alike.
        let colours = |stores: &Stores| -> Vec<u32> {
            stores.bodies.infos.iter().map(|info| info.contact_colours).collect()
        };
        assert_eq!(colours(&many), colours(&single));
        many.insert(team, (0..COUNT).rev());
        many.check(0..COUNT);
    });
}

/// What moves into a hole takes along that its constraint is not written yet.
#[test]
fn contacts_that_move_within_their_bucket_stay_fresh() {
    const COUNT: u32 = 900;
    let mut stores = Stores::new(COUNT as usize);
    let Stores { bodies, contacts, graph } = &mut stores;
    for index in 0..COUNT {
        let is_late = index >= COUNT / 2;
        if index == COUNT / 2 {
            graph.clear_fresh();
        }
        graph.insert(bodies, contacts, index);
        if is_late && index % 3 == 0 {
            graph.remove(bodies, contacts, index - COUNT / 2);
        }
    }
    graph.sort_fresh();
    let mut moved = 0;
    for index in COUNT / 2..COUNT {
        let contact = &contacts.records[index as usize];
        let Place::Graph { colour, slot } = contact.place else { panic!("{index} is not in") };
        if usize::from(colour) != IDLE {
            let address = (colour, contact.class as u8, slot / crate::simd::BLOCK as u32);
            assert!(graph.fresh().contains(&address), "{index} at {address:?}");
            moved += 1;
        }
    }
    assert!(moved > 200, "{moved} contacts to look at");
}

/// The same from one block into another, where nothing but the hole tells.
#[test]
fn holes_in_other_blocks_become_fresh() {
    for at_once in [false, true] {
        let mut stores = Stores::new(3000);
        stores.insert(&Team::alone(), 0..3000);
        let long = |(place, bucket): &(usize, &Bucket)| {
            *place != IDLE && bucket.contacts.len() > crate::simd::BLOCK
        };
        let (first, last) = {
            let mut buckets = stores.graph.touching_buckets().filter(long);
            let (_, bucket) = buckets.next().expect("a bucket of several blocks");
            (bucket.contacts[0], *bucket.contacts.last().unwrap())
        };
        let Stores { bodies, contacts, graph } = &mut stores;
        graph.clear_fresh();
        graph.mark_touching(&contacts.records[last as usize], true);
        if at_once {
            Transfers::default().remove(
                &Team::alone(),
                graph,
                bodies,
                contacts,
                [first].into_iter(),
            );
        } else {
            graph.remove(bodies, contacts, first);
        }
        graph.sort_fresh();
        let contact = &contacts.records[last as usize];
        let Place::Graph { colour, slot: 0 } = contact.place else { panic!("{last} is elsewhere") };
        assert!(graph.fresh().contains(&(colour, contact.class as u8, 0)), "{at_once}");
    }
}

#[test]
fn a_schedule_has_every_block_once() {
    let mut stores = Stores::new(3000);
    stores.insert(&Team::alone(), 0..3000);
    let mut schedule = Schedule::default();
    schedule.fill(&stores.graph, 4);
    let mut seen: Vec<_> = schedule
        .stages
        .iter()
        .flat_map(|stage| {
            let runs = &schedule.runs[stage.runs.clone()];
            runs.iter().inspect(move |run| assert_eq!(run.place, runs[0].place))
        })
        .flat_map(|run| run.blocks.clone().map(|block| (run.place, run.class as usize, block)))
        .collect();
    assert_eq!(
        schedule.runs(4).0.len(),
        schedule.stages.iter().map(|s| s.runs.len()).sum::<usize>()
    );
    seen.sort_unstable();
    let blocks = |(place, class, bucket): (usize, PairClass, &Bucket)| {
        (0..bucket.manifolds.len()).map(move |block| (place, class as usize, block))
    };
    let all: Vec<_> = stores.graph.all().flat_map(blocks).collect();
    assert_eq!(seen, all);
    assert!(all.iter().any(|&(place, ..)| is_overflow(place)), "no overflow to test");
    // An overflow is for one member, and in order.
    for stage in
        schedule.stages.iter().filter(|stage| is_overflow(schedule.runs[stage.runs.start].place))
    {
        assert!(stage.chunk >= stage.runs.len());
        let order = |run: &Run| (run.class, run.blocks.start);
        assert!(schedule.runs[stage.runs.clone()].is_sorted_by_key(order));
    }
}

#[test]
fn few_blocks_are_one_chunk() {
    let mut stores = Stores::new(30);
    stores.insert(&Team::alone(), 0..30);
    let mut schedule = Schedule::default();
    schedule.fill(&stores.graph, 8);
    assert!(schedule.stages.iter().any(|stage| stage.runs.len() > 1), "one kind of pair alone");
    for stage in &schedule.stages {
        assert!(stage.chunk >= stage.runs.len());
    }
}

#[test]
fn listed_blocks_make_runs_of_neighbours() {
    let mut stores = Stores::new(3000);
    stores.insert(&Team::alone(), 0..3000);
    // Two classes of one place, and one of another.
    let all: Vec<_> = stores.graph.all().map(|(place, class, _)| (place, class as usize)).collect();
    let at = (1..all.len() - 1).find(|&i| all[i].0 == all[i - 1].0 && all[i].0 != all[i + 1].0);
    let at = at.expect("two classes of a place, and another place");
    let [first, second, third] = [all[at - 1], all[at], all[at + 1]];
    let listed = [(first, 1), (first, 2), (first, 4), (second, 5), (third, 6)];
    let listed = listed.map(|((place, class), block)| (place as u8, class as u8, block));
    let mut schedule = Schedule::default();
    schedule.fill_with(&stores.graph, &listed, 8);
    let runs = |stage: &Listed| -> Vec<_> {
        let place = schedule.runs[stage.runs.start].place;
        assert_eq!(stage.buckets.len(), if place == first.0 { 2 } else { 1 });
        let run = |run: &Run| ((run.place, run.class as usize), run.blocks.clone());
        schedule.runs[stage.runs.clone()].iter().map(run).collect()
    };
    let stages: Vec<_> = schedule.stages.iter().map(runs).collect();
    assert_eq!(stages, [vec![(first, 1..3), (first, 4..5), (second, 5..6)], vec![(third, 6..7)]]);
}

/// Copies into a store keep what both have and forget the rest; empty buckets are gone from both.
#[test]
fn a_copy_into_another_graph_is_that_graph() {
    let (mut full, mut small) = (Stores::new(900), Stores::new(900));
    full.insert(&Team::alone(), 0..900);
    small.insert(&Team::alone(), 0..40);
    let mut copy = full.graph.clone();
    for source in [&small.graph, &full.graph, &Graph::default(), &small.graph] {
        copy.clone_from(source);
        assert_eq!(&copy, source);
    }
    small.remove(&Team::alone(), 0..40);
    assert_eq!(small.graph.buckets.list().len(), 0);
}
