//! Functions of the user's that the step calls: which pairs may collide, and how a contact behaves.
//!
//! Hooks are not part of the state of a world: they are neither hashed nor saved, and a clone shares them.
//! They are called on all threads of the world, in no fixed order. The step stays deterministic where a hook's
//! answer depends on nothing but its arguments.

use super::World;
use super::contacts::ContactView;
use super::ids::{BodyId, ShapeId};
use crate::dynamics::{Bodies, IDLE, Shapes, flags};
use crate::geometry::manifold::PairClass;
use crate::simd::BLOCK;
use crate::stages::pairs::PairRule;
use crate::threads::Team;
use core::fmt;
use std::sync::Arc;

/// Two shapes that are about to become a pair, for [`World::set_pair_filter`].
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ShapePair {
    /// Shape with the smaller index.
    pub shape_a: ShapeId,
    /// Shape with the larger index.
    pub shape_b: ShapeId,
    /// Body of the first shape.
    pub body_a: BodyId,
    /// Body of the second shape.
    pub body_b: BodyId,
    /// The user's number of the first shape.
    pub user_data_a: u64,
    /// The user's number of the second shape.
    pub user_data_b: u64,
}

/// How a contact behaves in this step, for [`World::set_pre_solve`].
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ContactRules {
    /// Does the contact act at all? It touches without force where not.
    pub enabled: bool,
    /// Coulomb friction, 0 or above.
    pub friction: f32,
    /// Bounce, 0 or above.
    pub restitution: f32,
    /// Speed of the surfaces along themselves, metres a second: see
    /// [`Material::tangent_speed`](crate::Material::tangent_speed).
    pub tangent_speed: f32,
}

type PairFilter = Arc<dyn Fn(&ShapePair) -> bool + Send + Sync>;
type PreSolve = Arc<dyn Fn(&World, &ContactView, &mut ContactRules) + Send + Sync>;

/// The hooks of a world.
#[derive(Clone, Default)]
pub(super) struct Hooks {
    pair_filter: Option<PairFilter>,
    pre_solve: Option<PreSolve>,
    /// Has the state come from bytes, perhaps with what a hook made of its contacts?
    pub(super) loaded: bool,
}

impl fmt::Debug for Hooks {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Hooks")
            .field("pair_filter", &self.pair_filter.is_some())
            .field("pre_solve", &self.pre_solve.is_some())
            .finish()
    }
}

impl Hooks {
    /// The user's word on pairs, if there is any.
    pub(super) fn pair_filter(&self) -> Option<&dyn PairRule> {
        self.pair_filter.as_ref().map(|_| self as &dyn PairRule)
    }
}

impl PairRule for Hooks {
    fn allows(&self, bodies: &Bodies, shapes: &Shapes, a: u32, b: u32) -> bool {
        let Some(filter) = &self.pair_filter else { return true };
        let (a, b) = if a < b { (a, b) } else { (b, a) };
        let record = |i: u32| &shapes.records[i as usize];
        let body = |i: u32| BodyId::new(i, bodies.infos[i as usize].generation);
        filter(&ShapePair {
            shape_a: ShapeId::new(a, record(a).generation),
            shape_b: ShapeId::new(b, record(b).generation),
            body_a: body(record(a).body),
            body_b: body(record(b).body),
            user_data_a: record(a).user_data,
            user_data_b: record(b).user_data,
        })
    }
}

/// Contacts that one member of the team asks about at a time.
const CHUNK: usize = 64;

/// A contact of the graph: place, class, slot.
pub(super) type At = (u8, PairClass, u32);

impl World {
    /// Sets a function that decides, beyond the filters of the shapes, which pairs may collide. It is asked when
    /// the boxes of two shapes come to overlap, once a pair, and when a fast body might hit something. Sensors
    /// and queries do not ask it. Contacts that it does not allow end, and all bodies
    /// wake.
    ///
    /// ```
    /// use tiny_physics::{ShapePair, Vec2, World};
    /// let mut world = World::new(Vec2::new(0.0, -10.0));
    /// // Shapes of one team (user data) pass through each other.
    /// world.set_pair_filter(|pair: &ShapePair| pair.user_data_a != pair.user_data_b);
    /// ```
    pub fn set_pair_filter(&mut self, filter: impl Fn(&ShapePair) -> bool + Send + Sync + 'static) {
        self.hooks.pair_filter = Some(Arc::new(filter));
        for index in 0..self.state.contacts.records.len() as u32 {
            let contact = &self.state.contacts.records[index as usize];
            let (a, b) = (contact.shape_a, contact.shape_b);
            if contact.alive && !self.hooks.allows(&self.state.bodies, &self.state.shapes, a, b) {
                self.destroy_contact(index);
            }
        }
        self.look_for_all_pairs();
    }

    /// Takes the function of [`World::set_pair_filter`] away again.
    pub fn clear_pair_filter(&mut self) {
        self.hooks.pair_filter = None;
        self.look_for_all_pairs();
    }

    /// Sets a function that is asked in every step about every contact that touches, before it is solved: it can
    /// switch the contact off for this step or change how it behaves. The world that it sees is that at the
    /// start of the step. Numbers that are not finite or negative count as 0. All bodies wake. What only the sweep of a fast body finds
    /// within the step is not asked about: it may hold that back for one step.
    ///
    /// ```
    /// use tiny_physics::{Vec2, World};
    /// let mut world = World::new(Vec2::new(0.0, -10.0));
    /// // Ice on everything steep.
    /// world.set_pre_solve(|_, contact, rules| {
    ///     if contact.normal.y.abs() < 0.7 {
    ///         rules.friction = 0.0;
    ///     }
    /// });
    /// ```
    pub fn set_pre_solve(
        &mut self,
        hook: impl Fn(&Self, &ContactView, &mut ContactRules) + Send + Sync + 'static,
    ) {
        self.hooks.pre_solve = Some(Arc::new(hook));
        self.wake_all();
    }

    /// Takes the function of [`World::set_pre_solve`] away again.
    pub fn clear_pre_solve(&mut self) {
        if self.hooks.pre_solve.take().is_some() {
            self.wake_all();
            self.forget_rules();
        }
    }

    /// Without a hook, contacts of what was loaded are as their shapes say.
    pub(super) fn forget_loaded_rules(&mut self) {
        if core::mem::take(&mut self.hooks.loaded) && self.hooks.pre_solve.is_none() {
            self.forget_rules();
        }
    }

    fn forget_rules(&mut self) {
        let super::State { graph, contacts, .. } = &mut self.state;
        contacts.records.iter().for_each(|contact| graph.write_materials(contact));
    }

    /// Wakes all, and makes the next step look for partners of all.
    fn look_for_all_pairs(&mut self) {
        let bodies: Vec<u32> = self.state.bodies.indices().collect();
        for body in bodies {
            self.wake_index(body);
            self.buffer_shapes(body);
        }
    }

    /// Asks the user about all contacts that touch.
    pub(super) fn call_pre_solve(&mut self, team: &Team) {
        self.scratch.switched_off.clear();
        let Some(hook) = self.hooks.pre_solve.clone() else { return };
        let mut places = core::mem::take(&mut self.scratch.touching);
        let mut answers = core::mem::take(&mut self.scratch.answers);
        self.list_touching(&mut places);
        let world = &*self;
        let chunks = team.map_chunks(places.len(), CHUNK, &mut answers, |range, answers| {
            answers.clear();
            answers.extend(places[range].iter().map(|&at| {
                let mut rules = world.rules(at);
                let bucket = world.state.graph.bucket(at.0.into(), at.1);
                hook(world, &world.view_ahead(bucket, at.2 as usize), &mut rules);
                rules
            }));
        });
        for (&at, rules) in places.iter().zip(chunks.iter().flatten()) {
            self.apply_rules(at, rules);
        }
        let off = &mut self.scratch.switched_off;
        off.sort_unstable();
        if !off.is_empty() {
            let super::State { graph, contacts, bodies, .. } = &mut self.state;
            self.scratch.predictions.let_go(off, (bodies, contacts), graph);
        }
        self.scratch.touching = places;
        self.scratch.answers = answers;
    }

    /// Lists all contacts that touch and are awake, in the order of the graph.
    fn list_touching(&self, places: &mut Vec<At>) {
        places.clear();
        let touching = self.state.graph.all().take_while(|&(place, ..)| place != IDLE);
        for (place, class, bucket) in touching {
            let slots = 0..bucket.contacts.len() as u32;
            places.extend(slots.map(|slot| (place as u8, class, slot)));
        }
    }

    /// How a contact behaves by its materials.
    fn rules(&self, (place, class, slot): At) -> ContactRules {
        let bucket = self.state.graph.bucket(place.into(), class);
        let contact = &self.state.contacts.records[bucket.contacts[slot as usize] as usize];
        ContactRules {
            enabled: true,
            friction: contact.friction,
            restitution: contact.restitution,
            // The lanes have it the other way round.
            tangent_speed: -contact.tangent_speed,
        }
    }

    /// Writes the rules into the lanes of a contact.
    fn apply_rules(&mut self, (place, class, slot): At, rules: &ContactRules) {
        let (block, lane) = (slot as usize / BLOCK, slot as usize % BLOCK);
        let bucket = self.state.graph.bucket_mut(place.into(), class);
        let restitution = positive(rules.restitution);
        let known = flags::RESTITUTION | flags::SUMMED;
        if restitution > 0.0 && bucket.heads[block].flags & known == 0 {
            let rows = &self.state.bodies.rows;
            (0..BLOCK).for_each(|lane| _ = bucket.note_approach(rows, (block, lane)));
        }
        let head = &mut bucket.heads[block];
        let (constraint, surface) = (&mut bucket.constraints[block], &mut bucket.surfaces[block]);
        constraint.friction[lane] = positive(rules.friction);
        surface.restitution[lane] = restitution;
        let speed = if rules.tangent_speed.is_finite() { rules.tangent_speed } else { 0.0 };
        surface.tangent_speed[lane] = -speed;
        head.flags |= if restitution > 0.0 { flags::RESTITUTION } else { 0 };
        head.flags |= if speed != 0.0 { flags::TANGENT_SPEED } else { 0 };
        if !rules.enabled {
            let lanes = &bucket.manifolds[block];
            let off = &mut self.scratch.switched_off;
            off.push([lanes.shape_a[lane], lanes.body_b[lane]]);
            off.push([lanes.shape_b[lane], lanes.body_a[lane]]);
            surface.rolling_impulse[lane] = 0.0;
            for point in &mut constraint.points {
                point.normal_mass[lane] = 0.0;
                point.tangent_mass[lane] = 0.0;
                point.normal_impulse[lane] = 0.0;
                point.tangent_impulse[lane] = 0.0;
            }
        }
    }
}

fn positive(value: f32) -> f32 {
    if value.is_finite() && value > 0.0 { value } else { 0.0 }
}
