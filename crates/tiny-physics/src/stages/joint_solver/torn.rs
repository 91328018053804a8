//! Torn: joints out of place whose bodies something else keeps apart, such as what a hand drags against a wall.
//!
//! No impulse brings it into place, and each solve would add to the last until the wall gives way. So what is torn lets go of a
//! part of its impulses in each solve. How far out of place a joint is does not tell this from a heavy load, which needs all of
//! them: what tells is that each of its bodies is fixed, or something fixed pushes it against what the joint would have.

use super::JointKernel;
use super::parts::{Stride, Substep, add, sub};
use crate::dynamics::{
    FrameLanes, JointClass, JointColour, JointPlaces, JointTree, joint_classes, with_bucket,
};
use crate::math::Vec2;
use crate::simd::{BLOCK, Lanes};
use crate::stages::islands::Stores;

/// Out of place by more than a joint gets in a substep at this speed, length units a second, what is torn begins to let go: by 1 cm at
/// the usual 240 Hz. At 5 a hand has dragged a body 0.4 into a wall by then.
const TORN: f32 = 2.4;
/// Over so many times more it comes to let go of all that it does.
const SPREAD: f32 = 2.5;
/// The part that it lets go of in a solve at most, of fewer than 240 a second in proportion less: with all of it the second of two solves
/// undoes the first.
const MOST: f32 = 0.5;
/// A push is against another by this cosine.
const AGAINST: f32 = 0.1;
/// So many contacts and joints of a body are asked at most, the newest: each joint of a hub asks.
const MOST_ASKED: usize = 64;

/// Writes how far joints are out of place.
#[inline(always)]
pub(super) fn prepare<L: Lanes, B: JointKernel>(stride: &Stride<L>, block: &mut B) {
    let frame = block.frame();
    let between = stride.load2(&frame.between_x, &frame.between_y);
    let b = add(between, stride.load2(&frame.b_x, &frame.b_y));
    let gap = sub(b, stride.load2(&frame.a_x, &frame.a_y));
    let off = block.off(stride, gap);
    let frame = block.frame();
    stride.store2(off, &mut frame.off_x, &mut frame.off_y);
    stride.store(stride.zero, &mut frame.yields);
}

/// A joint that is torn, where its lane is, and what it lets go of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found {
    colour: usize,
    class: JointClass,
    slot: usize,
    part: f32,
}

/// Finds joints that are torn.
struct Search<'a> {
    stores: &'a Stores<'a>,
    /// Out of place by no more than this, metres, none is.
    torn: f32,
    most: f32,
    found: &'a mut Vec<Found>,
}

/// Finds the joints of a pace that are torn, and of trees those that are out of place where the tree hangs on something fixed and
/// touches something else that is.
pub(crate) fn find(
    stores: &mut Stores<'_>,
    pace: usize,
    places: &JointPlaces,
    substep: Substep,
    found: &mut Vec<Found>,
) {
    found.clear();
    let most = MOST.min(MOST / (240.0 * substep.h));
    let mut search = Search { stores, torn: TORN * substep.unit * substep.h, most, found };
    let colours = &stores.joint_graph.colours;
    let mut in_trees = None;
    for colour in places.all() {
        macro_rules! find_all {
            (() $($bucket:ident $class:ident $block:ident),*) => {
                $(for (at, block) in colours.list()[colour].$bucket.blocks.iter().enumerate() {
                    if !search.is_off(&block.frame) {
                    } else if places.of_trees(colour) {
                        in_trees = Some(colour);
                    } else {
                        search.look_at((colour, JointClass::$class, at * BLOCK), &block.frame);
                    }
                })*
            };
        }
        joint_classes!(find_all!());
    }
    if let Some(colour) = in_trees {
        let trees = stores.joint_graph.forest.trees.iter().filter(|tree| tree.pace == pace);
        trees.for_each(|tree| search.look_at_tree(tree, colour));
    }
    for &Found { colour, class, slot, part } in &*found {
        let colour = &mut stores.joint_graph.colours.list_mut()[colour];
        with_bucket!(colour, class, bucket => {
            bucket.blocks[slot / BLOCK].frame.yields[slot % BLOCK] = part;
        });
    }
}

impl Search<'_> {
    /// Is any joint of a block out of place?
    fn is_off(&self, frame: &FrameLanes) -> bool {
        let far = |any: bool, off: &f32| any | (off.abs() > self.torn);
        frame.off_y.iter().fold(frame.off_x.iter().fold(false, far), far)
    }

    fn look_at(&mut self, (colour, class, start): (usize, JointClass, usize), frame: &FrameLanes) {
        for lane in 0..BLOCK {
            let (a, b) = (frame.body_a[lane], frame.body_b[lane]);
            let off = frame.off(lane);
            let part = self.part(off);
            if part > 0.0 && self.is_held(a, b, off) && self.is_held(b, a, -off) {
                self.found.push(Found { colour, class, slot: start + lane, part });
            }
        }
    }

    fn look_at_tree(&mut self, tree: &JointTree, colour: usize) {
        let mut held = None;
        for link in &tree.links {
            let (class, slot) = (link.class, link.slot as usize);
            let lanes = &self.stores.joint_graph.colours.list()[colour];
            let part = self.part(off_of(lanes, class, slot));
            if part > 0.0 && *held.get_or_insert_with(|| self.is_tree_held(tree)) {
                self.found.push(Found { colour, class, slot, part });
            }
        }
    }

    /// The part of its impulses that what is so far out of place lets go of, if it is torn.
    fn part(&self, off: Vec2) -> f32 {
        let far = off.x.abs().max(off.y.abs()) / self.torn - 1.0;
        (self.most / SPREAD * far).clamp(0.0, self.most)
    }

    fn is_tree_held(&self, tree: &JointTree) -> bool {
        let (moving, fixed) = tree.nodes.split_at(tree.dynamic);
        let [anchor, ..] = fixed else { return false };
        moving.iter().any(|node| self.is_pushed(node.body, anchor.body, |_| true))
    }

    /// Does something fixed other than this push a body so?
    fn is_pushed(&self, body: u32, other: u32, so: impl Fn(Vec2) -> bool) -> bool {
        let Stores { bodies, contacts, graph, .. } = self.stores;
        let asked = contacts.of_body(bodies.infos[body as usize].first_contact).take(MOST_ASKED);
        asked.into_iter().any(|(index, side)| {
            let contact = &contacts.records[index as usize];
            let by = contact.other(body);
            let pushed = |normal: Vec2| so(if side == 1 { normal } else { -normal });
            let fixed = by != other && !bodies.is_dynamic(by) && graph.impulse(contact) > 0.0;
            fixed && graph.normal(contact).is_some_and(pushed)
        })
    }

    /// Is a body fixed, or does something fixed push it, or another joint to something fixed want it, against where a joint to
    /// this other one wants it?
    fn is_held(&self, body: u32, other: u32, wanted: Vec2) -> bool {
        let Stores { bodies, joints, joint_graph, .. } = self.stores;
        let against = |push: Vec2| push.dot(wanted) < -AGAINST * push.length() * wanted.length();
        let hangs = || {
            let asked = joints.of_body(bodies.infos[body as usize].first_joint).take(MOST_ASKED);
            asked.into_iter().any(|(index, side)| {
                let joint = &joints.records[index as usize];
                let Some((place, class, slot)) = joint.lanes() else { return false };
                let off = off_of(&joint_graph.colours[place], class, slot as usize);
                let off = if side == 1 { off } else { -off };
                !bodies.is_dynamic(joint.other(body)) && off.length() > self.torn && against(-off)
            })
        };
        !bodies.is_dynamic(body)
            || self.is_pushed(body, other, against)
            || !bodies.is_dynamic(other) && hangs()
    }
}

fn off_of(colour: &JointColour, class: JointClass, slot: usize) -> Vec2 {
    with_bucket!(colour, class, bucket => bucket.blocks[slot / BLOCK].frame.off(slot % BLOCK))
}
