//! Which joints are solved directly: trees of joints, each with the order of its elimination.
//!
//! A *component* is what joints of rigid kinds and ropes tie together through dynamic bodies. Joints in the order of
//! their indices span it with a tree, ropes last; one that closes a loop is a *cut*: cuts are solved together, through the tree. Joints to
//! bodies that nothing moves are *anchors* and close no loop. A component is solved as a tree if it has not too many cuts
//! and needs it: where it is long, hangs from something fixed, or joins light bodies to heavy ones. Any other is left to the lanes whole, which
//! take a tenth of the time: a thousand ragdolls would make a step of theirs last twice as long. So are the ropes of one that they give
//! too many cuts, such as a net; what they tie together is a component by itself then.
//!
//! The forest follows from the records alone, so a frame need not hold it. It is brought up to date at the
//! start of a step ([`JointGraph::grow_forest`](super::JointGraph::grow_forest)), around bodies whose joints
//! have changed since.

use super::bodies::{Bodies, NULL};
use super::coloured::{Place, TREES, colour_at, place_of};
use super::disjoint_sets::DisjointSets;
use super::joint_blocks::{Axis, JointClass};
use super::joints::{JointRecord, Joints};
use super::places::{claim, put};
use crate::codec::clone_by_field;
use crate::describe::{BodyKind, JointDef, JointKind};
use crate::footprint::footprint;
use crate::simd::Three;

/// Joints in a row from which on a component needs a direct solution, and joints of one that hangs from something fixed: lanes let a
/// double pendulum gain a fifth of its energy in a minute, and boards on two rods sag.
const LEAST_DEPTH: usize = 8;
const LEAST_ANCHORED: usize = 2;
/// So it does where masses differ by this factor, were it one joint: of 100 pairs with masses of 1 to 5..10 that tumble on a
/// floor at 15 m/s the joints' widest gaps add up to 0.12 m in trees, to 1.8 m in lanes; awake on the ground a pair costs 15
/// times as much.
const LEAST_MASS_RATIO: f32 = 5.0;
/// A component with more loops is left to the lanes: each costs twice as much as the tree.
const MOST_CUTS: usize = 24;
/// So is one that is mostly of rods and ropes and has more loops than this, and than one in so many joints: what rods hold they turn, which
/// nothing makes stiff, and a net of them throws a load of a thousand times its knots about at .1 m/s.
const MOST_NET_CUTS: usize = 2;
const LINKS_PER_NET_CUT: usize = 8;

/// A row of a joint's Jacobian.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct TreeRow {
    /// On body A and on body B: x, y, angular.
    pub(crate) on: [Three; 2],
    /// Lever arms along the direction: how the force turns a body further when that has turned.
    pub(crate) reach: [f64; 2],
    /// Position error, metres or radians.
    pub(crate) error: f64,
    /// Velocity that gives way per impulse.
    pub(crate) compliance: f64,
}

/// A joint's Jacobian on one body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct TreeJacobian {
    /// Each row: x, y, angular.
    pub(crate) rows: [Three; 3],
    /// The same by columns: x of each row, y, angular.
    pub(crate) columns: [Three; 3],
}

/// A body of a tree, and what the solver keeps of it. The first ones are dynamic, in the order of a walk from
/// the root; those that nothing moves follow.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct TreeNode {
    pub(crate) body: u32,
    /// Velocity: x, y, angular.
    pub(crate) v: Three,
    /// What a substep adds to its velocity by half, where the tree is kicked so.
    pub(crate) half_gain: Three,
    /// Inverse moment of inertia of its own.
    pub(crate) own_inv_inertia: f64,
    /// That which all impulses of a substep ask for, at the last look.
    pub(crate) taut: f64,
    /// Inverse mass, twice, and inverse moment of inertia: with geometric stiffness once the rows are there. The last is kept here while that
    /// of errors counts as well.
    pub(crate) inv: Three,
    /// Mass matrix as felt from the root's side, or its inverse.
    pub(crate) hat: [Three; 3],
    /// Impulse as felt from the root's side.
    pub(crate) g: Three,
    /// Change of velocity.
    pub(crate) dv: Three,
    /// Those for impulses of one along x, y and about on some node.
    pub(crate) answers: [Three; 3],
}

/// A joint of a tree, and what the solver keeps of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct TreeLink {
    pub(crate) joint: u32,
    pub(crate) class: JointClass,
    /// Where in the bucket of its class.
    pub(crate) slot: u32,
    /// Nodes of body A and body B.
    pub(crate) a: u32,
    pub(crate) b: u32,
    /// The node away from the root: A or B; NULL for an anchor below a node, and for a cut.
    pub(crate) child: u32,
    /// The node towards the root; NULL for the root's own anchor, and for a cut.
    pub(crate) parent: u32,
    /// Number of rigid rows.
    pub(crate) rigid: usize,
    /// The rows: on A and on B, and the rest of [`TreeRow`].
    pub(crate) jacobians: [TreeJacobian; 2],
    pub(crate) reach: [Three; 2],
    pub(crate) error: Three,
    pub(crate) compliance: Three,
    /// Accumulated impulses of the rigid rows.
    pub(crate) impulses: Three,
    /// The free coordinate and its value.
    pub(crate) coordinate: TreeRow,
    pub(crate) value: f64,
    /// Limit that holds: 1 the lower, -1 the upper, 0 none. Its row, of that sign, comes after the rigid ones.
    pub(crate) limit: f64,
    /// That row is the motor's, which pushes either way.
    pub(crate) driven: bool,
    /// It stands still along that row: what holds there was not found.
    pub(crate) stuck: bool,
    /// Its motor turns freely, not along the coordinate; the row along which it pushes.
    pub(crate) turns: bool,
    pub(crate) drive: TreeRow,
    /// Inverse of the joint's block of the factorisation, right side, change of the impulses.
    pub(crate) inverse: [Three; 3],
    /// How the child answers impulses on each row; what the parent feels of each right side; how the child follows the parent.
    pub(crate) given: [Three; 3],
    pub(crate) felt: [Three; 3],
    pub(crate) follow: TreeJacobian,
    pub(crate) rhs: Three,
    /// Velocities that the rows' bodies lack on their circles.
    pub(crate) curve: Three,
    pub(crate) change: Three,
}

impl TreeLink {
    /// Writes row `i`.
    #[inline(always)]
    pub(crate) fn set_row(&mut self, i: usize, row: &TreeRow) {
        for (side, jacobian) in self.jacobians.iter_mut().enumerate() {
            jacobian.rows[i] = row.on[side];
            for (k, column) in jacobian.columns.iter_mut().enumerate() {
                column[i] = row.on[side][k];
            }
            self.reach[side][i] = row.reach[side];
        }
        self.error[i] = row.error;
        self.compliance[i] = row.compliance;
    }
}

/// What acts along a link's free coordinate; its motor may turn instead, see [`TreeLink::turns`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct TreeAxis {
    pub(crate) link: u32,
    /// In trees the first limit's impulse is that of both, the lower's less the upper's: at most one of them pushes.
    pub(crate) axis: Axis<f64>,
    /// Its limits give way.
    pub(crate) soft: bool,
    /// Velocity per impulse of the two bodies, as the rigid rows tie them.
    pub(crate) tied: f64,
    /// The same of its motor.
    pub(crate) driven: f64,
    /// The row that an impulse of one acts along with what the rigid rows then give, and how much they give.
    pub(crate) on: [Three; 2],
    pub(crate) given: Three,
}

impl TreeAxis {
    /// Does nothing but limits act along it?
    pub(crate) fn is_limit_only(&self) -> bool {
        self.axis.push == 0.0 && self.axis.motor_max == 0.0
    }

    /// How far a coordinate is beyond its limits.
    pub(crate) fn overrun(&self, value: f64) -> f64 {
        let [lower, upper] = self.axis.ends;
        (lower - value).max(value - upper)
    }
}

/// A component of joints that is solved directly.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct JointTree {
    pub(crate) nodes: Vec<TreeNode>,
    /// How many nodes are dynamic.
    pub(crate) dynamic: usize,
    /// The root's anchor if it has one, joints from the root outwards, further anchors, cuts.
    pub(crate) links: Vec<TreeLink>,
    /// Rows of the cuts: their links, and which of theirs.
    pub(crate) closing: Vec<(u32, u32)>,
    /// How the tree answers them, factored, and what acts along them; kept for their memory.
    pub(crate) answered: Vec<f64>,
    pub(crate) wanted: Vec<f64>,
    /// In the order of the links, of those that have any.
    pub(crate) axes: Vec<TreeAxis>,
    /// That of all its bodies.
    pub(crate) pace: usize,
    /// No other joint moves its bodies.
    pub(crate) alone: bool,
    /// Something that cannot move touches it.
    pub(crate) blocked: bool,
    /// It has more rows, or anchors of one body have, than the bodies have ways to move: they may contradict each other.
    pub(crate) tight: bool,
    /// Joints are open so far that bodies are stiff against turning.
    pub(crate) torn: bool,
    /// Its joints are out of place by more than they make good in a substep, or a limit of it gives way.
    pub(crate) snaps: bool,
    /// See [`JointTree::is_undisturbed`]; but for its axes.
    undisturbed: bool,
    /// The rows have been worked out in this step.
    pub(crate) begun: bool,
    /// The rows are those of the bodies' places now.
    pub(crate) fresh: bool,
    /// The bodies are about to move, or have moved since.
    pub(crate) moved: bool,
    /// Nothing but its contacts has acted on it since it was solved.
    pub(crate) solved: bool,
    /// The factorisation is of the rows now.
    pub(crate) factored: bool,
}

clone_by_field!(JointTree {
    nodes,
    dynamic,
    links,
    closing,
    answered,
    wanted,
    axes,
    pace,
    alone,
    blocked,
    tight,
    torn,
    snaps,
    undisturbed,
    begun,
    fresh,
    moved,
    solved,
    factored
});
footprint!(JointTree { nodes, links, closing, answered, wanted, axes } none {
    dynamic,
    pace,
    alone,
    blocked,
    tight,
    torn,
    snaps,
    undisturbed,
    begun,
    fresh,
    moved,
    solved,
    factored
});

impl JointTree {
    /// How many of its links are no cuts.
    pub(crate) fn uncut(&self) -> usize {
        self.links.iter().rposition(|link| link.child & link.parent != NULL).map_or(0, |at| at + 1)
    }

    /// Notes whether all its contacts go through it, and so leave its joints as they are.
    pub(crate) fn note_undisturbed(&mut self, all_through_it: bool) {
        self.undisturbed = self.alone && all_through_it;
    }

    /// Does nothing act on its bodies between two equal passes but what leaves its joints as they are? The second then has nothing
    /// to do.
    pub(crate) fn is_undisturbed(&self) -> bool {
        self.undisturbed && self.axes.is_empty()
    }
}

/// All trees of a world.
#[derive(Debug, Default)]
pub(crate) struct JointForest {
    /// By index; empty ones are free.
    pub(crate) trees: Vec<JointTree>,
    free: Vec<u32>,
    /// Tree of each joint, or NULL.
    tree_of: Vec<u32>,
    /// Bodies whose joints have changed.
    pub(super) dirty: Vec<u32>,
    /// Nothing is known yet.
    pub(super) all_dirty: bool,
    walk: Walk,
}

clone_by_field!(JointForest { trees, free, tree_of, dirty, all_dirty, walk });
footprint!(JointForest { free, tree_of, dirty, walk } each { trees } none { all_dirty });

/// It follows from the records.
impl PartialEq for JointForest {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// Can a tree hold the joint? What it keeps in place has to be rigid, at the engine's own stiffness.
pub(crate) fn is_rigid(def: &JointDef) -> bool {
    def.softness.is_none()
        && match def.kind {
            JointKind::Revolute { .. }
            | JointKind::Prismatic { .. }
            | JointKind::Wheel { .. }
            | JointKind::Gear { .. } => true,
            JointKind::Weld { linear, angular } => linear.is_none() && angular.is_none(),
            JointKind::Distance { spring, limits, motor, .. } => {
                spring.is_none() && limits.is_none() && motor.is_none()
            }
            _ => false,
        }
}

/// What of a joint decides whether it needs a tree, beside its being rigid.
pub(super) fn asks(def: &JointDef) -> (usize, bool, bool) {
    (rows_of(def), has_stops_and_spring(def), is_bare(def))
}

/// Does a joint do nothing but hold two ways or three, stop and drive? In lanes a hinge and what lies on its body heave each other up in turns,
/// until passivity brakes all of it, or the motor drives it on. What its motor does is no matter: it may be told otherwise in every step.
fn is_bare(def: &JointDef) -> bool {
    def.softness.is_none()
        && matches!(
            def.kind,
            JointKind::Revolute { spring: None, .. }
                | JointKind::Prismatic { spring: None, .. }
                | JointKind::Weld { linear: None, angular: None }
        )
}

/// Do a spring and a stop act on the same motion? Passivity does not watch what springs may drive, and in lanes the two throw back what hits
/// them.
fn has_stops_and_spring(def: &JointDef) -> bool {
    match def.kind {
        JointKind::Revolute { spring, limits, .. }
        | JointKind::Prismatic { spring, limits, .. }
        | JointKind::Wheel { spring, limits, .. } => spring.is_some() && limits.is_some(),
        _ => false,
    }
}

/// Is it a rope or a winch, of which a tree may hold the limits and the motor? Nothing else that is not rigid takes one way to move.
pub(super) fn is_rope(def: &JointDef) -> bool {
    rows_of(def) == 1 && !is_rigid(def)
}

/// How many ways to move a joint takes, or may take by its limits: none where it gives way as a spring.
pub(crate) fn rows_of(def: &JointDef) -> usize {
    match def.kind {
        _ if def.softness.is_some() => 0,
        JointKind::Weld { linear: None, angular: None } => 3,
        JointKind::Revolute { spring: None, limits, .. }
        | JointKind::Prismatic { spring: None, limits, .. } => 2 + usize::from(limits.is_some()),
        JointKind::Wheel { limits, .. } => 1 + usize::from(limits.is_some()),
        JointKind::Distance { spring: None, .. } | JointKind::Gear { .. } => 1,
        _ => 0,
    }
}

impl JointForest {
    /// Notes that any joint may be new.
    pub(super) fn note_all(&mut self) {
        self.all_dirty = true;
    }

    /// Notes that joints between two bodies have changed.
    pub(crate) fn note(&mut self, a: u32, b: u32) {
        self.dirty.extend([a, b]);
    }

    /// Is there anything to do?
    pub(crate) fn is_stale(&self) -> bool {
        self.all_dirty || !self.dirty.is_empty()
    }

    /// Joints of all trees.
    pub(crate) fn count(&self) -> usize {
        self.trees.iter().map(|tree| tree.links.len()).sum()
    }

    /// The tree that a joint is in.
    pub(super) fn tree_mut(&mut self, joint: u32) -> Option<&mut JointTree> {
        self.trees.get_mut(*self.tree_of.get(joint as usize)? as usize)
    }

    /// Fells the tree that a joint is in.
    pub(crate) fn dissolve(&mut self, joint: u32) {
        let Some(&tree) = self.tree_of.get(joint as usize) else { return };
        let Some(felled) = self.trees.get_mut(tree as usize) else { return };
        for link in felled.links.drain(..) {
            self.tree_of[link.joint as usize] = NULL;
        }
        felled.nodes.clear();
        felled.axes.clear();
        self.free.push(tree);
    }

    /// Plants the trees around all bodies whose joints have changed. Gives the joints that are in the wrong place: first
    /// those that belong to a tree, with its place, then those that belong to the lanes; both ascending.
    pub(super) fn grow(&mut self, bodies: &Bodies, joints: &Joints) -> Vec<(u32, Option<usize>)> {
        let mut dirty = core::mem::take(&mut self.dirty);
        if core::mem::take(&mut self.all_dirty) {
            dirty.clear();
            dirty.extend(bodies.indices());
        }
        dirty.sort_unstable();
        dirty.dedup();
        self.tree_of.resize(joints.records.len(), NULL);
        let mut walk = core::mem::take(&mut self.walk);
        walk.places.resize(bodies.infos.len(), NULL);
        let mut moves = Vec::new();
        let mut found = core::mem::take(&mut walk.found);
        found.ropes = true;
        let mut part = Component::default();
        for &body in &dirty {
            walk.collect(bodies, joints, body, &mut found);
            found.joints.iter().for_each(|&joint| self.dissolve(joint));
            let any = |&joint: &u32| is_rope(&joints.records[joint as usize].def);
            match plant(bodies, joints, &found, &walk.places) {
                None if found.joints.iter().any(any) => {
                    found.bodies.iter().for_each(|&body| walk.places[body as usize] = NULL);
                    for &body in &found.bodies {
                        walk.collect(bodies, joints, body, &mut part);
                        self.insert(plant(bodies, joints, &part, &walk.places));
                    }
                }
                tree => self.insert(tree),
            }
            for &joint in &found.joints {
                let Place::Graph { colour, .. } = joints.records[joint as usize].place else {
                    continue;
                };
                let place = usize::from(colour);
                let tree = self.trees.get(self.tree_of[joint as usize] as usize);
                let wanted = tree.map(|tree| place_of(tree.pace, TREES));
                if wanted != Some(place) && (wanted.is_some() || colour_at(place) == TREES) {
                    moves.push((joint, wanted));
                }
            }
        }
        walk.found = found;
        walk.forget();
        self.walk = walk;
        dirty.clear();
        self.dirty = dirty;
        moves.sort_unstable_by_key(|&(joint, place)| (place.is_none(), joint));
        moves
    }

    /// Gives an index to a tree that has any links.
    fn insert(&mut self, tree: Option<JointTree>) {
        let Some(tree) = tree.filter(|tree| !tree.links.is_empty()) else { return };
        let index = claim(&mut self.free, self.trees.len());
        for link in &tree.links {
            self.tree_of[link.joint as usize] = index;
        }
        put(&mut self.trees, index, tree);
    }
}

/// A walk over components; kept only for its memory.
#[derive(Debug, Default)]
struct Walk {
    /// Place of each body that has been met among those of its component, else NULL.
    places: Vec<u32>,
    met: Vec<u32>,
    /// The component at hand, and bodies that are still to be visited.
    found: Component,
    waiting: Vec<u32>,
}

footprint!(Walk { places, met, found, waiting });
footprint!(Component { bodies, joints } none { ropes });

impl Clone for Walk {
    fn clone(&self) -> Self {
        Self::default()
    }

    fn clone_from(&mut self, _: &Self) {}
}

/// What hangs together through joints: they are ascending.
#[derive(Debug, Default)]
struct Component {
    bodies: Vec<u32>,
    joints: Vec<u32>,
    /// May they be ropes?
    ropes: bool,
}

impl Walk {
    /// The component of a body; empty where that has been done before.
    fn collect(&mut self, bodies: &Bodies, joints: &Joints, body: u32, found: &mut Component) {
        found.bodies.clear();
        found.joints.clear();
        self.waiting.push(body);
        while let Some(body) = self.waiting.pop() {
            if !bodies.is_dynamic(body) || self.places[body as usize] != NULL {
                continue;
            }
            self.places[body as usize] = found.bodies.len() as u32;
            self.met.push(body);
            found.bodies.push(body);
            for (joint, _) in joints.of_body(bodies.infos[body as usize].first_joint) {
                let record = &joints.records[joint as usize];
                let ties = is_rigid(&record.def) || found.ropes && is_rope(&record.def);
                if record.place != Place::Asleep && ties {
                    found.joints.push(joint);
                    self.waiting.push(record.other(body));
                }
            }
        }
        found.joints.sort_unstable();
        found.joints.dedup();
    }

    fn forget(&mut self) {
        for body in self.met.drain(..) {
            self.places[body as usize] = NULL;
        }
    }
}

/// Do light bodies bear heavy ones?
fn is_uneven(bodies: &Bodies, component: &Component) -> bool {
    let (mut least, mut greatest) = (f32::INFINITY, 0.0);
    for &body in &component.bodies {
        let mass = bodies.infos[body as usize].mass;
        least = if mass < least { mass } else { least };
        greatest = if mass > greatest { mass } else { greatest };
    }
    greatest >= LEAST_MASS_RATIO * least
}

/// The tree of a component, or none where it has too few joints or too many loops, or no need of one.
fn plant(
    bodies: &Bodies,
    joints: &Joints,
    component: &Component,
    places: &[u32],
) -> Option<JointTree> {
    let links = component.joints.len();
    let uneven = is_uneven(bodies, component);
    let inner = |&joint: &u32| {
        let record = &joints.records[joint as usize];
        bodies.is_dynamic(record.body_a) && bodies.is_dynamic(record.body_b)
    };
    let inner_count = component.joints.iter().filter(|joint| inner(joint)).count();
    let anchored = inner_count < links;
    let is_still = |body: u32| bodies.infos[body as usize].kind == BodyKind::Static;
    let all = component.bodies.iter().flat_map(|&body| {
        joints.of_body(bodies.infos[body as usize].first_joint).map(|(joint, _)| joint)
    });
    let mut all = all.filter(|&joint| joints.records[joint as usize].place != Place::Asleep);
    let alone = all.all(|joint| component.joints.binary_search(&joint).is_ok());
    let is_firm = |joint: &u32| {
        let JointRecord { body_a, body_b, def, .. } = &joints.records[*joint as usize];
        let bare = alone && is_bare(def) && (is_still(*body_a) || is_still(*body_b));
        bare || has_stops_and_spring(def)
    };
    let least = match anchored {
        true if component.joints.iter().any(is_firm) => 1,
        true => LEAST_ANCHORED,
        false => LEAST_DEPTH,
    };
    if !uneven && links < least {
        return None;
    }
    let cuts = inner_count + 1 - component.bodies.len();
    let defs = component.joints.iter().map(|&joint| &joints.records[joint as usize].def);
    let lines = defs.filter(|def| matches!(def.kind, JointKind::Distance { .. })).count();
    let net = 2 * lines > links && cuts > MOST_NET_CUTS.max(links / LINKS_PER_NET_CUT);
    if cuts > MOST_CUTS || net {
        return None;
    }
    let mut sets = DisjointSets::default();
    let count = component.bodies.len();
    sets.reset(count, 0..count as u32);
    let (mut spanning, mut anchors, mut cut) = (Vec::new(), Vec::new(), Vec::new());
    // It is ropes that are left out, if any are.
    let mut all = component.joints.clone();
    all.sort_by_key(|&joint| is_rope(&joints.records[joint as usize].def));
    for joint in &all {
        if inner(joint) {
            let record = &joints.records[*joint as usize];
            if sets.join(places[record.body_a as usize], places[record.body_b as usize]) {
                spanning.push(*joint);
            } else {
                cut.push(*joint);
            }
        } else {
            anchors.push(*joint);
        }
    }
    let nodes = vec![NULL; component.bodies.len()];
    let tree = JointTree { alone, ..JointTree::default() };
    let mut planter = Planter { bodies, joints, places, nodes, tree, depth: Vec::new() };
    planter.plant(&spanning, &anchors);
    for &joint in &cut {
        let JointRecord { body_a, body_b, .. } = joints.records[joint as usize];
        let ends = [body_a, body_b].map(|body| planter.node_of(body));
        planter.add_link(joint, ends, NULL, NULL);
    }
    planter.tree.tight = planter.is_tight();
    let depth = planter.depth.last().copied().unwrap_or(0);
    let needed = uneven || anchored || depth >= LEAST_DEPTH;
    needed.then_some(planter.tree)
}

/// A tree in the making.
struct Planter<'a> {
    bodies: &'a Bodies,
    joints: &'a Joints,
    places: &'a [u32],
    /// Node of each body of the component, by its place, or NULL.
    nodes: Vec<u32>,
    tree: JointTree,
    /// Joints between the root and each node.
    depth: Vec<usize>,
}

impl Planter<'_> {
    /// Walks outwards from the first anchor, or from the first body.
    fn plant(&mut self, spanning: &[u32], anchors: &[u32]) {
        let mut edges: Vec<(u32, u32)> = Vec::with_capacity(2 * spanning.len());
        for &joint in spanning {
            let record = &self.joints.records[joint as usize];
            edges.extend([(record.body_a, joint), (record.body_b, joint)]);
        }
        edges.sort_unstable();
        let anchored = anchors.first().map(|&joint| self.ends_of(joint).0);
        let Some(root) = anchored.or(edges.first().map(|edge| edge.0)) else { return };
        self.tree.pace = usize::from(self.bodies.infos[root as usize].pace);
        self.add_mover(root, 0);
        let mut at = 0;
        while let Some(&TreeNode { body, .. }) = self.tree.nodes.get(at) {
            let first = edges.partition_point(|edge| edge.0 < body);
            for &(_, joint) in edges[first..].iter().take_while(|edge| edge.0 == body) {
                let other = self.joints.records[joint as usize].other(body);
                if self.node_of(other) == NULL {
                    let child = self.add_mover(other, self.depth[at] + 1);
                    self.add_link(joint, [at as u32, child], child, at as u32);
                }
            }
            at += 1;
        }
        self.tree.dynamic = self.tree.nodes.len();
        let first = self.tree.links.len();
        for &joint in anchors {
            let (body, fixed) = self.ends_of(joint);
            let (node, fixed) = (self.node_of(body), self.add_node(fixed));
            self.add_link(joint, [node, fixed], NULL, node);
        }
        // The root's anchor holds it as a joint holds its child, and comes first.
        if let Some(links) = self.tree.links.get_mut(..=first) {
            links.rotate_right(1);
            (links[0].child, links[0].parent) = (0, NULL);
        }
    }

    /// See [`JointTree::tight`].
    fn is_tight(&self) -> bool {
        let ways = 3 * self.tree.dynamic;
        let (mut all, mut of_anchors) = (0, vec![0; self.tree.dynamic]);
        for &TreeLink { joint, a, b, .. } in &self.tree.links {
            let rows = rows_of(&self.joints.records[joint as usize].def);
            all += rows;
            if self.tree.dynamic <= a.max(b) as usize {
                of_anchors[a.min(b) as usize] += rows;
            }
        }
        let free = if of_anchors.iter().all(|&rows| rows == 0) { 3 } else { 0 };
        all + free > ways || of_anchors.iter().any(|&rows| rows > 3)
    }

    /// The dynamic body of an anchor, and the other.
    fn ends_of(&self, joint: u32) -> (u32, u32) {
        let &JointRecord { body_a, body_b, .. } = &self.joints.records[joint as usize];
        if self.bodies.is_dynamic(body_a) { (body_a, body_b) } else { (body_b, body_a) }
    }

    /// The node of a dynamic body of the component, or NULL.
    fn node_of(&self, body: u32) -> u32 {
        self.nodes[self.places[body as usize] as usize]
    }

    fn add_node(&mut self, body: u32) -> u32 {
        self.tree.nodes.push(TreeNode { body, ..TreeNode::default() });
        self.tree.nodes.len() as u32 - 1
    }

    /// The node of a body of the component that many joints from the root.
    fn add_mover(&mut self, body: u32, depth: usize) -> u32 {
        let node = self.add_node(body);
        self.nodes[self.places[body as usize] as usize] = node;
        self.depth.push(depth);
        node
    }

    /// A joint between two nodes, in whichever order they have.
    fn add_link(&mut self, joint: u32, [one, other]: [u32; 2], child: u32, parent: u32) {
        let record = &self.joints.records[joint as usize];
        let is_a = record.body_a == self.tree.nodes[one as usize].body;
        let (a, b) = if is_a { (one, other) } else { (other, one) };
        if let Some(class) = record.class() {
            let link = TreeLink { joint, class, a, b, child, parent, ..TreeLink::default() };
            self.tree.links.push(link);
        }
    }
}
