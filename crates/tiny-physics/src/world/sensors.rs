//! Sensors of the world: the stage of the step, and what the user sees of it.

use super::events::{SensorBegin, SensorEnd};
use super::ids::ShapeId;
use super::state::State;
use super::{Scratch, World};
use crate::describe::Settings;
use crate::dynamics::{Overlap, ShapeRecord};
use crate::stages::sensors;
use crate::threads::Team;
use crate::work;
use core::mem::take;

impl World {
    /// Finds out what the sensors see now, and what has begun and ended.
    pub(super) fn update_sensors(&mut self, team: &Team) {
        if !self.state.sensors.shapes.is_empty() || !self.state.sensors.overlaps.is_empty() {
            self.look_with_sensors(team);
        }
        // What ended before the step stands before the rest.
        self.state.events.sensor_end.sort_unstable_by_key(|end| (end.sensor, end.visitor));
    }

    fn look_with_sensors(&mut self, team: &Team) {
        let mut overlaps = take(&mut self.scratch.overlaps);
        let State { bodies, shapes, broad_phase, sensors, .. } = &self.state;
        let Scratch { fast, carriers, found_overlaps, turning, .. } = &mut self.scratch;
        let Settings { length_unit, continuous, .. } = self.settings;
        let scene =
            sensors::Scene { bodies, shapes, broad_phase, sensors, length_unit, continuous };
        let memory = (found_overlaps, turning);
        sensors::find_overlaps(team, scene, [fast, carriers], memory, &mut overlaps);
        let mut begun = take(&mut self.state.events.sensor_begin);
        let mut ended = take(&mut self.state.events.sensor_end);
        sensors::compare(
            &self.state.sensors.overlaps,
            &overlaps,
            |overlap| begun.push(SensorBegin::from(self.sensor_event(overlap))),
            |overlap| ended.push(self.sensor_event(overlap)),
        );
        let State { sensors, events, .. } = &mut self.state;
        (events.sensor_begin, events.sensor_end) = (begun, ended);
        core::mem::swap(&mut sensors.overlaps, &mut overlaps);
        sensors.clear_changed();
        self.scratch.overlaps = overlaps;
    }

    /// What a sensor and a visitor, both alive, are.
    fn sensor_event(&self, overlap: &Overlap) -> SensorEnd {
        let body = |shape: u32| self.body_id(self.state.shapes.records[shape as usize].body);
        SensorEnd {
            sensor: self.shape_id(overlap.sensor),
            visitor: self.shape_id(overlap.visitor),
            sensor_body: body(overlap.sensor),
            visitor_body: body(overlap.visitor),
            sensor_data: self.state.user_data(overlap.sensor),
            visitor_data: self.state.user_data(overlap.visitor),
        }
    }

    /// Ends the overlaps of shapes that are about to be removed: all in one go through the list.
    pub(super) fn end_overlaps_of(&mut self, goes: impl Fn(&ShapeRecord, u32) -> bool) {
        let mut overlaps = take(&mut self.state.sensors.overlaps);
        overlaps.retain(|overlap| {
            work::note();
            let goes = |shape: u32| goes(&self.state.shapes.records[shape as usize], shape);
            let ends = goes(overlap.sensor) || goes(overlap.visitor);
            let end = ends.then(|| self.sensor_event(overlap));
            self.state.events.pending_sensor_end.extend(end);
            !ends
        });
        self.state.sensors.overlaps = overlaps;
    }

    /// What a sensor saw in the last step, in index order; nothing for shapes that are no sensors. Shapes that
    /// have been removed since are left out.
    pub fn sensor_overlaps(&self, sensor: ShapeId) -> impl Iterator<Item = ShapeId> + '_ {
        let overlaps = match self.shape_index(sensor) {
            Ok(index) => self.state.sensors.seen_by(index),
            Err(_) => &[],
        };
        overlaps
            .iter()
            .map(handles)
            .filter(move |&(of, visitor)| of == sensor && self.shape_index(visitor).is_ok())
            .map(|(_, visitor)| visitor)
    }

    /// Tells the sensors that the shapes of a body are not where or what they were.
    pub(super) fn mark_shapes_changed(&mut self, body: u32) {
        for shape in self.shapes_of(body) {
            self.state.sensors.mark_changed(shape);
        }
    }
}

fn handles(overlap: &Overlap) -> (ShapeId, ShapeId) {
    (
        ShapeId::new(overlap.sensor, overlap.sensor_generation),
        ShapeId::new(overlap.visitor, overlap.visitor_generation),
    )
}
