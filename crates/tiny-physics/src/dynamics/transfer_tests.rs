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
        let mut bodies = Bodies::new();
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
            let saved = SavedPoint { id: k as f32, normal_impulse: k as f32, tangent_impulse: 0.5 };
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
        Self { bodies, contacts, graph: Graph::new() }
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
            let bucket = &self.graph.buckets[usize::from(colour)][contact.class as usize];
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

#[test]
fn a_schedule_has_every_block_once() {
    let mut stores = Stores::new(3000);
    stores.insert(&Team::alone(), 0..3000);
    let mut schedule = Schedule::default();
    schedule.fill(&stores.graph, 0..=IDLE, 4);
    let mut seen: Vec<_> = schedule
        .stages()
        .flat_map(|stage| stage.runs.iter().inspect(move |run| assert_eq!(run.place, stage.place)))
        .flat_map(|run| run.blocks.clone().map(|block| (run.place, run.class as usize, block)))
        .collect();
    assert_eq!(schedule.runs(4).0.len(), schedule.stages().map(|s| s.runs.len()).sum::<usize>());
    seen.sort_unstable();
    let buckets = stores.graph.buckets.iter().enumerate().flat_map(|(place, buckets)| {
        buckets.iter().enumerate().map(move |(class, bucket)| (place, class, bucket))
    });
    let all: Vec<_> = buckets
        .flat_map(|(place, class, bucket)| {
            (0..bucket.manifolds.len()).map(move |block| (place, class, block))
        })
        .collect();
    assert_eq!(seen, all);
    assert!(all.iter().any(|&(place, ..)| is_overflow(place)), "no overflow to test");
    // An overflow is for one member, and in order.
    for stage in schedule.stages().filter(|stage| is_overflow(stage.place)) {
        assert!(stage.chunk >= stage.runs.len());
        let order = |run: &Run| (run.class, run.blocks.start);
        assert!(stage.runs.is_sorted_by_key(order));
    }
}

#[test]
fn few_blocks_are_one_chunk() {
    let mut stores = Stores::new(30);
    stores.insert(&Team::alone(), 0..30);
    let mut schedule = Schedule::default();
    schedule.fill(&stores.graph, 0..=IDLE, 8);
    assert!(schedule.stages().any(|stage| stage.runs.len() > 1), "one kind of pair alone");
    for stage in schedule.stages() {
        assert!(stage.chunk >= stage.runs.len());
    }
}

#[test]
fn listed_blocks_make_runs_of_neighbours() {
    let mut schedule = Schedule::default();
    schedule.fill_with(&[(0, 0, 1), (0, 0, 2), (0, 0, 4), (0, 1, 5), (3, 1, 6)], 8);
    let runs = |stage: Stage<'_>| -> Vec<_> {
        stage.runs.iter().map(|run| (stage.place, run.class as usize, run.blocks.clone())).collect()
    };
    let stages: Vec<_> = schedule.stages().map(runs).collect();
    assert_eq!(stages, [vec![(0, 0, 1..3), (0, 0, 4..5), (0, 1, 5..6)], vec![(3, 1, 6..7)]]);
}
