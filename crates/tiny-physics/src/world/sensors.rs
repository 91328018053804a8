//! Sensors of the world: the stage of the step, and what the user sees of it.

use super::World;
use super::events::{SensorBegin, SensorEnd};
use super::ids::ShapeId;
use super::state::State;
use crate::dynamics::Overlap;
use crate::stages::sensors;
use crate::threads::Team;

impl World {
    /// Finds out what the sensors see now, and what has begun and ended.
    pub(super) fn update_sensors(&mut self, team: &Team) {
        if self.state.sensors.shapes.is_empty() && self.state.sensors.overlaps.is_empty() {
            return;
        }
        let mut overlaps = core::mem::take(&mut self.scratch.overlaps);
        let State { bodies, shapes, broad_phase, sensors, events, .. } = &mut self.state;
        let scratch = &mut self.scratch;
        let scene = sensors::Scene { bodies, shapes, broad_phase, sensors };
        sensors::find_overlaps(
            team,
            scene,
            &scratch.fast,
            &mut scratch.found_overlaps,
            &mut overlaps,
        );
        sensors::compare(
            &sensors.overlaps,
            &overlaps,
            |begun| {
                let (sensor, visitor) = handles(begun);
                events.sensor_begin.push(SensorBegin { sensor, visitor });
            },
            |ended| {
                let (sensor, visitor) = handles(ended);
                events.sensor_end.push(SensorEnd { sensor, visitor });
            },
        );
        core::mem::swap(&mut sensors.overlaps, &mut overlaps);
        sensors.clear_changed();
        scratch.overlaps = overlaps;
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
        for shape in self.state.shapes.of_body(self.state.bodies.infos[body as usize].first_shape) {
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
