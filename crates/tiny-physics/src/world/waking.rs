//! What wakes sleepers besides contacts: changes from outside that concern them.

use super::World;
use super::state::State;
use crate::broad_phase::ProxyKind;
use crate::describe::BodyKind;
use crate::dynamics::Change;
use crate::geometry::{LINEAR_SLOP, collide};
use crate::math::Vec2;
use crate::stages::solve::Lengths;
use core::ops::ControlFlow;

impl World {
    /// Wakes what sleeps under another gravity than it fell asleep under, or where sleep has been switched off, and what ground
    /// has been put into.
    pub(super) fn wake_disturbed(&mut self) {
        let felt = self.state.gravity.replace(self.gravity);
        if let Some(felt) = felt.filter(|&felt| felt != self.gravity) {
            self.wake_all();
            self.state.graph.scale(kept_weight(felt, self.gravity));
            for i in 0..self.state.bodies.awake.len() {
                self.state.bodies.disturb(self.state.bodies.awake[i]);
            }
        }
        let slept = core::mem::replace(&mut self.state.sleeps, self.settings.sleep);
        if slept && !self.settings.sleep {
            self.wake_all();
        }
        for body in self.buried_sleepers() {
            self.wake_index(body);
        }
    }

    /// Is there nothing that a step could move or see move? Then it is over.
    pub(super) fn rests(&mut self, lengths: Lengths) -> bool {
        let State { bodies, broad_phase, waiting, sensors, events, .. } = &self.state;
        let sees = !sensors.shapes.is_empty() || !sensors.overlaps.is_empty();
        let rests = bodies.awake.is_empty()
            && bodies.pressed.is_empty()
            && broad_phase.moved().is_empty()
            && waiting.pairs.is_empty()
            && !(sees && sensors.any_changed)
            && events.sensor_end.is_empty();
        if rests {
            self.state.waiting.stale = false;
            self.stay_at_rest(lengths);
            self.stats.rest();
        }
        rests
    }

    /// Wakes all dynamic bodies.
    pub(super) fn wake_all(&mut self) {
        let bodies = &self.state.bodies;
        let sleeps = |&i: &u32| !bodies.infos[i as usize].awake && bodies.is_dynamic(i);
        let sleepers: Vec<u32> = bodies.indices().filter(sleeps).collect();
        sleepers.into_iter().for_each(|body| self.wake_index(body));
    }

    /// Sleeping bodies inside ground, where ground has changed since the last step; ascending.
    fn buried_sleepers(&self) -> Vec<u32> {
        let (bodies, shapes) = (&self.state.bodies, &self.state.shapes);
        let mut near = Vec::new();
        for change in &shapes.changed_ground {
            let (Change::Ground { bounds } | Change::Moved { bounds }) = change else { continue };
            self.state.broad_phase.each_of(ProxyKind::Dynamic, bounds, u64::MAX, |shape| {
                let body = shapes.records[shape as usize].body;
                if !bodies.infos[body as usize].awake {
                    near.push(shape);
                }
            });
        }
        near.sort_unstable();
        near.dedup();
        near.retain(|&shape| self.is_in_ground(shape));
        let mut buried: Vec<u32> =
            near.iter().map(|&shape| shapes.records[shape as usize].body).collect();
        buried.sort_unstable();
        buried.dedup();
        buried
    }

    /// Is a shape further inside something fixed than what rests on it?
    fn is_in_ground(&self, shape: u32) -> bool {
        let State { bodies, shapes, broad_phase, joints, .. } = &self.state;
        let record = &shapes.records[shape as usize];
        let slop = LINEAR_SLOP * self.settings.length_unit;
        let place = bodies.poses[record.body as usize].compose(record.central);
        let mut found = false;
        broad_phase.query(&shapes.tight[shape as usize], record.filter.reach().1, |other| {
            let ground = &shapes.records[other as usize];
            let fixed = bodies.infos[ground.body as usize].kind != BodyKind::Dynamic;
            let solid = !record.sensor && !ground.sensor && ground.one_way.is_none();
            if fixed
                && solid
                && record.filter.collides(&ground.filter)
                && joints.may_collide(bodies, record.body, ground.body)
            {
                let from = bodies.poses[ground.body as usize].compose(ground.central);
                let manifold = collide(&ground.shape, &record.shape, place.relative_to(from), 0.0);
                found = manifold.points().iter().any(|point| point.separation < -slop);
            }
            if found { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        found
    }
}

/// What part of the weight that contacts carry is still there under another gravity. All of what the old one left in them would
/// throw stacks apart where the new one does not press them together; a greater weight they find by themselves.
fn kept_weight(old: Vec2, new: Vec2) -> f32 {
    let [x, y] = [old.x, old.y].map(f64::from);
    let square = x * x + y * y;
    let along = f64::from(new.x) * x + f64::from(new.y) * y;
    if square > 0.0 { (along / square).clamp(0.0, 1.0) as f32 } else { 1.0 }
}
