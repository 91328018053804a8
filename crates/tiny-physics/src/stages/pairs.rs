//! From pairs of the broad phase to contact records, and back when boxes part.

use crate::broad_phase::{BroadPhase, sort_pairs};
use crate::describe::Settings;
use crate::dynamics::{Bodies, Contact, Contacts, Graph, Joints, NULL, Place, SavedPoint, Shapes};
use crate::geometry::manifold::PairClass;
use crate::simd::BLOCK;
use crate::threads::Team;

/// Groups of moved shapes whose partners one member of the team looks for at a time.
const CHUNK: usize = 8;

/// Finds the pairs around shapes that left their fat boxes which may collide and have no contact yet,
/// each once, sorted.
pub(crate) fn find_new(
    team: &Team,
    broad_phase: &mut BroadPhase,
    stores: &Partners<'_>,
    found: &mut Vec<Vec<(u32, u32)>>,
    pairs: &mut Vec<(u32, u32)>,
) {
    let group_count = broad_phase.prepare_pairs();
    let boxes = &*broad_phase;
    let chunks = team.map_chunks(group_count, CHUNK, found, |range, found| {
        found.clear();
        boxes.query_groups(range, |a, b| stores.may_meet(a, b), found);
    });
    pairs.clear();
    chunks.iter().for_each(|found| pairs.extend_from_slice(found));
    sort_pairs(pairs);
    broad_phase.clear_moved();
}

/// What the user has to say about pairs of shapes, beyond filters.
pub(crate) trait PairRule: Sync {
    /// May the two shapes collide?
    fn allows(&self, bodies: &Bodies, shapes: &Shapes, a: u32, b: u32) -> bool;
}

/// What decides whether two shapes may meet.
#[derive(Clone, Copy)]
pub(crate) struct Partners<'a> {
    pub(crate) shapes: &'a Shapes,
    pub(crate) bodies: &'a Bodies,
    pub(crate) contacts: &'a Contacts,
    pub(crate) joints: &'a Joints,
    /// The user's word on a pair of shapes, if there is any.
    pub(crate) custom: Option<&'a dyn PairRule>,
}

impl Partners<'_> {
    /// Do filters, bodies and joints let the two shapes collide, and have they no contact yet?
    fn may_meet(&self, a: u32, b: u32) -> bool {
        let (shape_a, shape_b) =
            (&self.shapes.records[a as usize], &self.shapes.records[b as usize]);
        shape_a.body != shape_b.body
            && !shape_a.sensor
            && !shape_b.sensor
            && shape_a.filter.collides(&shape_b.filter)
            && self.contacts.pairs.get(a, b).is_none()
            && self.joints.may_collide(self.bodies, shape_a.body, shape_b.body)
            && self.custom.is_none_or(|rule| rule.allows(self.bodies, self.shapes, a, b))
    }
}

/// Creates the contacts of new pairs of shapes.
pub(crate) fn create_contacts(
    pairs: &[(u32, u32)],
    settings: &Settings,
    shapes: &Shapes,
    bodies: &mut Bodies,
    contacts: &mut Contacts,
    graph: &mut Graph,
) {
    for &(a, b) in pairs {
        let contact = new_contact(a, b, settings, shapes);
        let awake = is_awake(bodies, &contact);
        let index = contacts.insert(bodies, contact);
        if awake {
            graph.insert(bodies, contacts, index);
        }
    }
}

/// Is one of the two bodies awake and able to move?
pub(crate) fn is_awake(bodies: &Bodies, contact: &Contact) -> bool {
    bodies.infos[contact.body_a as usize].awake || bodies.infos[contact.body_b as usize].awake
}

fn new_contact(a: u32, b: u32, settings: &Settings, shapes: &Shapes) -> Contact {
    let class = |i: u32| shapes.records[i as usize].class;
    let (a, b) = if class(a) < class(b) { (b, a) } else { (a, b) };
    let (shape_a, shape_b) = (&shapes.records[a as usize], &shapes.records[b as usize]);
    let mut contact = Contact {
        alive: true,
        touching: false,
        events: false,
        hit_events: false,
        class: PairClass::of(shape_a.class, shape_b.class),
        place: Place::Asleep,
        shape_a: a,
        shape_b: b,
        body_a: shape_a.body,
        body_b: shape_b.body,
        friction: 0.0,
        restitution: 0.0,
        rolling_resistance: 0.0,
        tangent_speed: 0.0,
        saved: [SavedPoint::NONE; 2],
        links: [(NULL, NULL); 2],
    };
    mix_materials(&mut contact, settings, shapes);
    contact
}

/// Sets what a contact has of the materials of its two shapes, and which events it sends. A contact that
/// touches keeps sending begin and end events or not, so that these stay paired.
pub(crate) fn mix_materials(contact: &mut Contact, settings: &Settings, shapes: &Shapes) {
    let (a, b) = (contact.shape_a, contact.shape_b);
    let (shape_a, shape_b) = (&shapes.records[a as usize], &shapes.records[b as usize]);
    let (material_a, material_b) = (&shape_a.material, &shape_b.material);
    let radius = |i: u32| shapes.rows[i as usize][6];
    if !contact.touching {
        contact.events = shape_a.contact_events || shape_b.contact_events;
    }
    contact.hit_events = shape_a.hit_events || shape_b.hit_events;
    contact.friction = settings.friction_mix.apply(material_a.friction, material_b.friction);
    contact.restitution =
        settings.restitution_mix.apply(material_a.restitution, material_b.restitution);
    contact.rolling_resistance = larger(
        material_a.rolling_resistance * radius(a),
        material_b.rolling_resistance * radius(b),
    );
    // The solver's tangent points along the surface of A; a belt goes the other way round B.
    contact.tangent_speed = -(material_a.tangent_speed + material_b.tangent_speed);
}

fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// Lists the contacts of moved shapes whose fat boxes no longer overlap, ascending.
///
/// Few moved shapes go through the contact lists of their bodies; where much moves, running down the
/// blocks of the graph is quicker (spinner, 6,000 bodies: 13 ms a step by lists, 0.2 ms by blocks). Both
/// find the same.
pub(crate) fn find_parted(
    broad_phase: &BroadPhase,
    bodies: &Bodies,
    shapes: &Shapes,
    contacts: &Contacts,
    graph: &Graph,
    parted: &mut Vec<u32>,
) {
    parted.clear();
    let moved = broad_phase.moved();
    let much = moved.len() * 64 > graph.len();
    for &proxy in moved {
        let Some(shape) = broad_phase.user(proxy) else { continue };
        let body = &bodies.infos[shapes.records[shape as usize].body as usize];
        if much && body.awake {
            continue;
        }
        for (index, _) in contacts.of_body(body.first_contact) {
            let contact = &contacts.records[index as usize];
            let own = contact.shape_a == shape || contact.shape_b == shape;
            if own && !shapes.may_touch(contact.shape_a, contact.shape_b) {
                parted.push(index);
            }
        }
    }
    if much {
        for bucket in graph.buckets.iter().flatten() {
            for (contacts, block) in bucket.contacts.chunks(BLOCK).zip(&bucket.manifolds) {
                for (lane, &index) in contacts.iter().enumerate() {
                    if !shapes.may_touch(block.shape_a[lane], block.shape_b[lane]) {
                        parted.push(index);
                    }
                }
            }
        }
    }
    parted.sort_unstable();
    parted.dedup();
}
