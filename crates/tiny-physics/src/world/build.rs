//! Adding and removing bodies and shapes.

use super::World;
use super::descriptions::{check_body, check_shape};
use super::ids::{BodyId, ShapeId};
use super::state::State;
use crate::broad_phase::{ProxyDef, ProxyKind};
use crate::describe::{BodyKind, RigidBody, ShapeDef};
use crate::dynamics::{BodyInfo, Change, Contact, Given, GivenPoint, NULL, ShapeRecord};
use crate::error::Error;
use crate::geometry::manifold::{RoundedBox, ShapeClass};
use crate::geometry::{MassProperties, Shape};
use crate::math::{Pose, Rot, Transform, Vec2};
use crate::simd::Row;
use crate::stages::boxes;

/// Shapes of a body that go at once and are each asked whether they count.
const FEW: usize = 8;

impl World {
    /// Adds a body and gives its handle.
    ///
    /// # Errors
    /// A number in the description is NaN, infinite or out of range, or a shape is degenerate; the
    /// error names it. Nothing has been added then.
    pub fn add_body(&mut self, body: RigidBody) -> Result<BodyId, Error> {
        check_body(&body)?;
        let moving = body.kind != BodyKind::Static && body.enabled;
        // What lies on a platform goes by its velocity.
        let goes = body.velocity != Vec2::ZERO || body.angular_velocity != 0.0;
        let awake = moving && (body.awake || body.kind == BodyKind::Kinematic && goes);
        let rotation = Rot::from_angle(body.angle);
        let info = BodyInfo {
            fixed_mass: Given::new(body.mass),
            fixed_center: GivenPoint::new(body.center),
            fixed_inertia: Given::new(body.inertia),
            awake,
            ..BodyInfo::default().take_over(&body)
        };
        let index = self.state.bodies.insert(info, Pose::new(body.position, rotation));
        self.state.shapes.records.reserve(body.shapes.len());
        // Pushed to the front of the list, so the last goes first.
        for shape in body.shapes.iter().rev() {
            self.insert_shape(index, shape);
        }
        self.update_mass(index);
        if body.kind != BodyKind::Static {
            self.state.bodies.set_velocity(index, body.velocity);
            self.state.bodies.set_angular_velocity(index, body.angular_velocity);
        }
        if awake {
            self.state.bodies.push_awake(index);
        } else if moving {
            self.state.bodies.infos[index as usize].island_next = index;
        }
        self.create_proxies(index);
        Ok(self.body_id(index))
    }

    /// Removes a body with its shapes, contacts and joints. What rested on it wakes.
    ///
    /// # Errors
    /// The handle is stale.
    pub fn remove_body(&mut self, id: BodyId) -> Result<(), Error> {
        let index = self.body_index(id)?;
        self.wake_index(index);
        self.destroy_joints_of(index);
        self.destroy_contacts_of(index, |_, _| true);
        let shapes = self.shapes_of(index);
        self.end_overlaps_of(|record, _| record.body == index);
        self.unlink_shapes(index, |_| true);
        shapes.into_iter().for_each(|shape| self.forget_shape(shape));
        self.state.bodies.remove_awake(index);
        self.state.bodies.remove(index);
        Ok(())
    }

    /// Adds a shape to a body; mass and inertia follow.
    ///
    /// # Errors
    /// The handle is stale, or a number in the description is out of range.
    pub fn add_shape(
        &mut self,
        body: BodyId,
        shape: impl Into<ShapeDef>,
    ) -> Result<ShapeId, Error> {
        let index = self.body_index(body)?;
        let shape = shape.into();
        check_shape(&shape)?;
        self.wake_index(index);
        let id = self.insert_shape(index, &shape);
        if self.state.bodies.is_dynamic(index) {
            self.update_mass(index);
        } else {
            self.settle_shape(id);
        }
        self.create_proxy(id);
        Ok(self.shape_id(id))
    }

    /// Adds all shapes to a body, or none.
    pub(crate) fn add_shapes(
        &mut self,
        body: BodyId,
        shapes: &[ShapeDef],
    ) -> Result<Vec<ShapeId>, Error> {
        let body = self.body_index(body)?;
        self.insert_shapes(body, shapes)
    }

    /// The same, by the body's index.
    pub(super) fn insert_shapes(
        &mut self,
        body: u32,
        shapes: &[ShapeDef],
    ) -> Result<Vec<ShapeId>, Error> {
        shapes.iter().try_for_each(check_shape)?;
        self.wake_index(body);
        self.state.shapes.records.reserve(shapes.len());
        let ids: Vec<u32> = shapes.iter().map(|shape| self.insert_shape(body, shape)).collect();
        self.update_mass(body);
        self.create_proxies(body);
        Ok(ids.into_iter().map(|id| self.shape_id(id)).collect())
    }

    /// Removes a shape from its body; mass and inertia follow. What rested on it wakes.
    ///
    /// # Errors
    /// The handle is stale.
    pub fn remove_shape(&mut self, id: ShapeId) -> Result<(), Error> {
        self.remove_shapes(&[id])
    }

    /// Removes many shapes, such as those of a chain: mass and inertia of each body are counted once.
    ///
    /// ```
    /// use tiny_physics::prelude::*;
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let mut world = World::new((0.0, -10.0));
    /// let ground = world.add_body(RigidBody::fixed())?;
    /// let ledge = world.add_chain(ground, &ChainDef::heights(1.0, &[0.0, 0.2, 0.1, 0.3]))?;
    /// world.remove_shapes(&ledge)?;
    /// assert_eq!(world.shape_count(), 0);
    /// assert!(world.remove_shapes(&ledge).is_err());
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// A handle is stale. Nothing has been removed then.
    pub fn remove_shapes(&mut self, ids: &[ShapeId]) -> Result<(), Error> {
        let shapes: Result<Vec<u32>, Error> = ids.iter().map(|id| self.shape_index(*id)).collect();
        let mut shapes = shapes?;
        shapes.sort_unstable();
        shapes.dedup();
        let body_of = |shape: u32| self.state.shapes.records[shape as usize].body;
        let mut pairs: Vec<_> = shapes.iter().map(|&shape| (body_of(shape), shape)).collect();
        pairs.sort_unstable();
        let parts = || pairs.chunk_by(|a, b| a.0 == b.0).map(|part| (part[0].0, part));
        let goes = |shape: u32| shapes.binary_search(&shape).is_ok();
        for (body, _) in parts() {
            self.wake_index(body);
            self.destroy_contacts_of(body, |_, c| goes(c.shape_a) || goes(c.shape_b));
        }
        self.end_overlaps_of(|_, shape| goes(shape));
        parts().for_each(|(body, _)| self.unlink_shapes(body, goes));
        // For many, counting anew costs less than asking each.
        let tell = |part: &[(u32, u32)]| {
            part.len() > FEW || part.iter().any(|&(_, shape)| self.tells(shape))
        };
        let told = parts().filter(|(_, part)| tell(part));
        let told: Vec<u32> = told.map(|(body, _)| body).collect();
        shapes.iter().for_each(|&shape| self.forget_shape(shape));
        told.into_iter().for_each(|body| self.update_mass(body));
        Ok(())
    }

    /// Destroys the contacts of a body for which the predicate holds.
    pub(super) fn destroy_contacts_of(
        &mut self,
        body: u32,
        which: impl Fn(&State, &Contact) -> bool,
    ) {
        for index in self.contacts_where(body, |contact| which(&self.state, contact)) {
            self.destroy_contact(index);
        }
    }

    /// The contacts of a body for which the predicate holds, ascending.
    pub(super) fn contacts_where(&self, body: u32, which: impl Fn(&Contact) -> bool) -> Vec<u32> {
        let contacts = self.state.contacts_of(body).filter(|(_, contact)| which(contact));
        let mut indices: Vec<u32> = contacts.map(|(index, _)| index).collect();
        indices.sort_unstable();
        indices
    }

    /// Puts a shape record at the head of a body's list.
    fn insert_shape(&mut self, body: u32, def: &ShapeDef) -> u32 {
        let info = &mut self.state.bodies.infos[body as usize];
        let record = ShapeRecord {
            body,
            next: info.first_shape,
            class: ShapeClass::of(&def.shape),
            local: Transform::from_angle(def.offset, def.angle),
            ..ShapeRecord::default().take_over(def)
        };
        let index = self.state.shapes.insert(record);
        if def.sensor {
            self.state.sensors.insert(index);
        }
        self.state.sensors.mark_changed(index);
        info.first_shape = index;
        info.shape_count += 1;
        index
    }

    /// Takes shapes out of their body's list.
    fn unlink_shapes(&mut self, body: u32, goes: impl Fn(u32) -> bool) {
        let mut stay = self.shapes_of(body);
        stay.retain(|&shape| !goes(shape));
        let info = &mut self.state.bodies.infos[body as usize];
        (info.shape_count, info.first_shape) = (stay.len() as u32, NULL);
        for shape in stay.into_iter().rev() {
            self.state.shapes.records[shape as usize].next = info.first_shape;
            info.first_shape = shape;
        }
    }

    /// Takes a shape out of the world that has no contacts and overlaps, and is in no body's list.
    fn forget_shape(&mut self, shape: u32) {
        self.note_ground(shape, true);
        self.state.broad_phase.destroy_proxy(self.state.shapes.proxy(shape));
        self.state.waiting.stale = true;
        self.state.sensors.remove(shape);
        self.state.shapes.remove(shape);
    }

    /// Computes mass, centre of mass, inertia and extents from the shapes. The body's frame stays
    /// where it is.
    pub(super) fn update_mass(&mut self, index: u32) {
        let origin = self.state.bodies.origin_pose(index);
        let (mut total, never_turns) = self.sum_masses(index, None);
        let given = self.state.bodies.infos[index as usize].fixed_mass.get();
        if given.is_some() && total.mass == 0.0 {
            // Shapes without density still say how a mass is spread.
            total = self.sum_masses(index, Some(1.0)).0;
        }
        let info = &mut self.state.bodies.infos[index as usize];
        info.never_turns = never_turns;
        let dynamic = info.kind == BodyKind::Dynamic;
        let scale = match info.fixed_mass.get() {
            Some(mass) if total.mass > 0.0 => mass / total.mass,
            _ => 1.0,
        };
        info.mass = match info.fixed_mass.get() {
            _ if !dynamic => 0.0,
            Some(mass) => mass,
            // Something that forces are to move needs a mass.
            None if total.mass > 0.0 => total.mass,
            None => 1.0,
        };
        info.inertia = match (info.fixed_inertia.get(), info.fixed_center.get()) {
            _ if !dynamic => 0.0,
            (Some(inertia), _) => inertia,
            (None, Some(center)) => {
                let off = if total.mass > 0.0 { center.distance(total.center) } else { 0.0 };
                total.inertia * scale + info.mass * off * off
            }
            (None, None) => total.inertia * scale,
        };
        let center =
            if dynamic { info.fixed_center.get().unwrap_or(total.center) } else { Vec2::ZERO };
        let shift = center - core::mem::replace(&mut info.local_center, center);
        let (way, shifted) = (origin.q.rotate(shift), shift != Vec2::ZERO);
        let bodies = &mut self.state.bodies;
        let mut previous = bodies.previous[index as usize];
        previous.p = previous.apply(shift);
        bodies.set_origin_pose(index, origin.p, origin.q);
        bodies.previous[index as usize] = previous;
        // Every point of it goes on as it was, its frame too.
        let turning = bodies.angular_velocity(index);
        if shifted && turning != 0.0 {
            bodies.set_velocity(index, bodies.velocity(index) + way.perp() * turning);
        }
        self.state.bodies.update_inverse_masses(index);
        self.update_central_frames(index);
        if shifted {
            // Shapes have stayed where they were, but for rounding, which a far centre of mass makes visible.
            self.update_boxes(index);
        }
        self.refresh_joints(index);
    }

    /// Lets the joints of a body know that its mass is another, or its centre, or how it is locked.
    pub(super) fn refresh_joints(&mut self, index: u32) {
        let State { bodies, joints, joint_graph, .. } = &mut self.state;
        for (joint, _) in joints.of_body(bodies.infos[index as usize].first_joint) {
            joint_graph.refresh(joints, joint);
        }
    }

    /// Brings the boxes of a body's shapes to where they are.
    pub(super) fn update_boxes(&mut self, index: u32) {
        let State { bodies, shapes, broad_phase, .. } = &mut self.state;
        boxes::update(bodies, shapes, broad_phase, index);
    }

    /// Mass properties of all shapes in the body's frame, by their densities or one for all, and whether one of them must not turn.
    fn sum_masses(&self, index: u32, density: Option<f32>) -> (MassProperties, bool) {
        let mut never_turns = false;
        let parts = self.state.shapes_of(index).map(|i| {
            let record = &self.state.shapes.records[i as usize];
            never_turns |= matches!(record.shape, Shape::Aabb { .. });
            let density = density.unwrap_or(record.material.density);
            record.shape.mass_properties(density).transformed(record.local)
        });
        let parts: Vec<MassProperties> = parts.collect();
        (MassProperties::combined(&parts), never_turns)
    }

    /// Recomputes what depends on the centre of mass: frames and rows of the shapes, extents.
    fn update_central_frames(&mut self, index: u32) {
        let info = &mut self.state.bodies.infos[index as usize];
        (info.min_extent, info.max_extent) = (0.0, 0.0);
        let mut is_first = true;
        for shape in self.shapes_of(index) {
            is_first &= !self.update_central_frame(shape, is_first);
        }
    }

    /// Computes frame and row of a shape from its body's centre of mass, and takes it into the body's extents. Is
    /// it solid? `is_first` says that no other shape so far is.
    fn update_central_frame(&mut self, shape: u32, is_first: bool) -> bool {
        let State { bodies, shapes, .. } = &mut self.state;
        let record = &mut shapes.records[shape as usize];
        let info = &mut bodies.infos[record.body as usize];
        record.central = Transform::new(record.local.p - info.local_center, record.local.q);
        let lane = LaneShape::new(&record.shape, record.central);
        record.box_frame = lane.box_frame;
        let is_solid = !record.sensor;
        if is_solid && (is_first || lane.thickness < info.min_extent) {
            info.min_extent = lane.thickness;
        }
        if is_solid {
            info.max_extent = info.max_extent.max(lane.reach);
        }
        shapes.rows[shape as usize] = lane.row;
        shapes.mark_row(shape);
        is_solid
    }

    /// Takes a shape that is new, or another now, into what is known of a body that is not dynamic. Its centre stays where it is, so what
    /// other shapes have does too.
    pub(super) fn settle_shape(&mut self, shape: u32) {
        let State { bodies, shapes, .. } = &mut self.state;
        let record = &shapes.records[shape as usize];
        let info = &mut bodies.infos[record.body as usize];
        info.never_turns |= matches!(record.shape, Shape::Aabb { .. });
        let solid = |other: u32| other != shape && !shapes.records[other as usize].sensor;
        // A sensor has no say in it, and there may be many of them.
        let is_first = !record.sensor && !shapes.of_body(info.first_shape).any(solid);
        self.update_central_frame(shape, is_first);
    }

    /// Is what is known of a body another without this shape: is it larger or thinner than all others, or alone upright?
    pub(super) fn tells(&self, shape: u32) -> bool {
        let State { bodies, shapes, .. } = &self.state;
        let record = |shape: u32| &shapes.records[shape as usize];
        let lane = |shape| LaneShape::new(&record(shape).shape, record(shape).central);
        let (body, own) = (record(shape).body, lane(shape));
        let info = &bodies.infos[body as usize];
        let others = || shapes.of_body(info.first_shape).filter(|&other| other != shape);
        let is_as_thin = |at: u32| !record(at).sensor && lane(at).thickness <= own.thickness;
        let is_upright = |at: u32| matches!(record(at).shape, Shape::Aabb { .. });
        bodies.is_dynamic(body)
            || own.reach >= info.max_extent
            || !record(shape).sensor && !others().any(is_as_thin)
            || is_upright(shape) && !others().any(is_upright)
    }

    /// Gives a broad-phase leaf to those shapes of an enabled body that have none.
    pub(super) fn create_proxies(&mut self, index: u32) {
        for shape in self.shapes_of(index) {
            self.create_proxy(shape);
        }
    }

    /// Gives a shape a broad-phase leaf, if its body is enabled and it has none.
    pub(super) fn create_proxy(&mut self, shape: u32) {
        let record = &self.state.shapes.records[shape as usize];
        let info = &self.state.bodies.infos[record.body as usize];
        if !info.enabled || record.proxy != NULL {
            return;
        }
        let kind = proxy_kind(info.kind);
        let margin = super::FAT_MARGIN * self.settings.length_unit;
        let pose = self.state.bodies.poses[record.body as usize];
        let (category, mask) = record.filter.reach();
        let def = ProxyDef { kind, category, mask, user: shape, margin };
        let tight = boxes::shape_box(&self.state.shapes, shape, pose);
        let proxy = self.state.broad_phase.create_proxy(def, tight);
        self.state.shapes.tight[shape as usize] = tight;
        self.state.shapes.records[shape as usize].proxy = proxy.0;
        self.state.shapes.fat[shape as usize] =
            self.state.broad_phase.fat_aabb(proxy).unwrap_or(tight);
        self.note_ground(shape, true);
    }

    /// Notes that all ground of a body is about to move, or has moved. What is kinematic makes surfaces with itself alone.
    pub(super) fn note_ground_of(&mut self, body: u32) {
        let guards = self.state.bodies.infos[body as usize].kind == BodyKind::Static;
        self.shapes_of(body).into_iter().for_each(|shape| self.note_ground(shape, guards));
    }

    /// Notes that ground comes, goes or changes where the box of this shape is, and whether guards may be others. What moves makes a
    /// surface with the rest of its body, wherever that is.
    pub(super) fn note_ground(&mut self, shape: u32, guards: bool) {
        let State { bodies, shapes, broad_phase, .. } = &mut self.state;
        let ShapeRecord { sensor, body, .. } = shapes.records[shape as usize];
        let BodyInfo { kind, first_shape, .. } = bodies.infos[body as usize];
        if sensor {
            return;
        }
        let solid = |other: u32| other != shape && !shapes.records[other as usize].sensor;
        if guards && kind != BodyKind::Static && shapes.of_body(first_shape).any(solid) {
            shapes.changed_ground.push(Change::Parts { body });
        }
        if kind != BodyKind::Dynamic
            && let Some(bounds) = broad_phase.fat_aabb(shapes.proxy(shape))
        {
            let is_ground = guards && kind == BodyKind::Static;
            let moved = Change::Moved { bounds };
            shapes.changed_ground.push(if is_ground { Change::Ground { bounds } } else { moved });
        }
    }
}

/// Parts of a box's thickness that a polygon's is counted in.
const PARTS: f32 = 1024.0;

/// A shape as the lane kernels see it.
struct LaneShape {
    /// See [`Shapes::rows`](crate::dynamics::Shapes).
    row: Row,
    /// Frame of the row in the shape's frame.
    box_frame: Transform,
    /// From the centre of mass to its furthest point, metres.
    reach: f32,
    /// Half of the least thickness, metres.
    thickness: f32,
}

impl LaneShape {
    fn new(shape: &Shape, central: Transform) -> Self {
        let rounded = RoundedBox::of(shape);
        let [x, y, radius] = rounded.extents();
        let frame = central.compose(rounded.frame);
        let is_general = ShapeClass::of(shape) == ShapeClass::General;
        let thinner = if x < y { x } else { y } + radius;
        let (part, reach, thickness) = if is_general {
            let (core, center) = (shape.core(), central.unapply(Vec2::ZERO));
            let thickness = shape.inner_radius();
            // In steps that a mark beside them leaves alone.
            let part = (PARTS * thickness / thinner).clamp(0.0, PARTS - 1.0) as u16;
            (f32::from(part) / PARTS, core.reach(center) + core.radius, thickness)
        } else {
            (1.0, frame.p.length() + rounded.half_extents.length() + radius, thinner)
        };
        let row = [frame.p.x, frame.p.y, frame.q.c, frame.q.s, x, y, radius, part];
        Self { row, box_frame: rounded.frame, reach, thickness }
    }
}

/// The tree that the shapes of a body are in.
pub(super) fn proxy_kind(kind: BodyKind) -> ProxyKind {
    match kind {
        BodyKind::Static => ProxyKind::Static,
        BodyKind::Kinematic => ProxyKind::Kinematic,
        BodyKind::Dynamic => ProxyKind::Dynamic,
    }
}
