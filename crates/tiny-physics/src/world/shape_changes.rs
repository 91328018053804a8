//! Changing a shape while the world runs.

use super::World;
use super::ids::ShapeId;
use super::shapes::ShapeRef;
use super::state::State;
use crate::describe::{Filter, Material, ShapeDef};
use crate::dynamics::{NULL, ShapeRecord};
use crate::error::Error;
use crate::geometry::manifold::ShapeClass;
use crate::geometry::{Shape, check_point};
use crate::math::{Transform, Vec2};
use crate::stages::pairs;

/// A shape of the world, to change. Changes wake its body and what touches it; what is the same already changes nothing, so a
/// game may set a material in every frame.
pub struct ShapeMut<'a> {
    world: &'a mut World,
    index: u32,
}

impl World {
    /// A shape to change; `None` if it has been removed.
    ///
    /// ```
    /// use tiny_physics::{RigidBody, Shape, Vec2, World};
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let mut world = World::new(Vec2::ZERO);
    /// let body = world.add_body(RigidBody::dynamic().shape(Shape::circle(0.5)?))?;
    /// let shape = world.body(body).unwrap().shapes().next().unwrap();
    /// let light = world.body(body).unwrap().mass();
    /// world.shape_mut(shape).unwrap().set_shape(Shape::circle(1.0)?)?;
    /// assert_eq!(world.body(body).unwrap().mass(), 4.0 * light);
    /// # Ok(())
    /// # }
    /// ```
    pub fn shape_mut(&mut self, id: ShapeId) -> Option<ShapeMut<'_>> {
        let index = self.shape_index(id).map_err(|_| self.stats.stale_handles += 1).ok()?;
        Some(ShapeMut { world: self, index })
    }
}

impl ShapeMut<'_> {
    /// The shape, to read.
    pub fn as_ref(&self) -> ShapeRef<'_> {
        ShapeRef::new(self.world, self.index)
    }

    /// Changes the geometry; mass and inertia of the body follow, its contacts begin anew, even if it is the same. What a
    /// segment of a chain and its neighbours know of each other stays: see [`ChainLink`](crate::ChainLink).
    ///
    /// # Errors
    /// The geometry is degenerate or not finite.
    pub fn set_shape(&mut self, shape: impl Into<Shape>) -> Result<(), Error> {
        let shape = shape.into();
        shape.validate()?;
        let (class, old) = (ShapeClass::of(&shape), self.record());
        let link = old.link.filter(|_| matches!(shape, Shape::Segment { .. }));
        self.replace(ShapeRecord { class, shape, link, ..old });
        Ok(())
    }

    /// Changes the place of the shape's frame in the body's frame: metres, radians. Mass and inertia of the
    /// body follow, its contacts begin anew.
    ///
    /// # Errors
    /// A number is not finite, or the offset beyond 1e6.
    pub fn set_local(&mut self, offset: impl Into<Vec2>, angle: f32) -> Result<(), Error> {
        let offset = offset.into();
        check_point("offset", offset)?;
        Error::check_finite("angle", angle)?;
        self.change(|record| record.local = Transform::from_angle(offset, angle));
        Ok(())
    }

    /// Changes surface and stuff, also for the contacts that it has; mass and inertia of the body follow.
    ///
    /// # Errors
    /// A number is out of range.
    pub fn set_material(&mut self, material: Material) -> Result<(), Error> {
        let record = self.record();
        let def = ShapeDef { material, ..ShapeDef::new(record.shape) };
        super::descriptions::check_shape(&def)?;
        if record.material == material {
            return Ok(());
        }
        let (body, density) = (record.body, record.material.density);
        self.world.state.shapes.records[self.index as usize].material = material;
        self.world.wake_index(body);
        if density != material.density && self.world.state.bodies.is_dynamic(body) {
            self.world.update_mass(body);
        }
        self.world.refresh_contacts_of(self.index);
        Ok(())
    }

    /// Changes the friction alone: see [`ShapeMut::set_material`].
    ///
    /// # Errors
    /// It is not finite or below 0.
    pub fn set_friction(&mut self, friction: f32) -> Result<(), Error> {
        self.set_material(Material { friction, ..self.as_ref().material() })
    }

    /// Changes the restitution alone: see [`ShapeMut::set_material`].
    ///
    /// # Errors
    /// It is not finite or below 0.
    pub fn set_restitution(&mut self, restitution: f32) -> Result<(), Error> {
        self.set_material(Material { restitution, ..self.as_ref().material() })
    }

    /// Changes the density alone, kilograms a square metre; mass and inertia of the body follow.
    ///
    /// # Errors
    /// It is out of range.
    pub fn set_density(&mut self, density: f32) -> Result<(), Error> {
        self.set_material(Material { density, ..self.as_ref().material() })
    }

    /// Changes what it collides with. Contacts that are no longer allowed end.
    pub fn set_filter(&mut self, filter: Filter) {
        let (world, index) = (&mut *self.world, self.index);
        let record = &mut world.state.shapes.records[index as usize];
        if core::mem::replace(&mut record.filter, filter) == filter {
            return;
        }
        let body = record.body;
        world.wake_index(body);
        let (category, mask) = filter.reach();
        world.state.broad_phase.set_filter(world.state.shapes.proxy(index), category, mask);
        world.state.sensors.mark_changed(index);
        world.note_ground(index, true);
        world.destroy_contacts_of(body, |state, contact| {
            let filter = |shape: u32| state.shapes.records[shape as usize].filter;
            !filter(contact.shape_a).collides(&filter(contact.shape_b))
        });
    }

    /// Makes it a sensor or a solid shape. Its contacts end.
    pub fn set_sensor(&mut self, sensor: bool) {
        if sensor {
            self.world.state.sensors.insert(self.index);
        } else {
            self.world.state.sensors.remove(self.index);
        }
        self.change(|record| record.sensor = sensor);
    }

    /// Makes it a one-way platform, solid from the side that `direction` (in the body's frame) points out of,
    /// or solid from everywhere. Its contacts begin anew.
    ///
    /// # Errors
    /// A number is not finite.
    pub fn set_one_way(&mut self, direction: Option<Vec2>) -> Result<(), Error> {
        if let Some(direction) = direction {
            Error::check_finite_vec("one_way", direction)?;
        }
        self.change(|record| record.one_way = direction);
        Ok(())
    }

    /// Sets whether contact (begin and end) and hit events are sent. A contact that touches already keeps to
    /// what it was until it ends.
    pub fn set_events(&mut self, contact: bool, hit: bool) {
        let record = &mut self.world.state.shapes.records[self.index as usize];
        if (record.contact_events, record.hit_events) != (contact, hit) {
            (record.contact_events, record.hit_events) = (contact, hit);
            self.world.refresh_contacts_of(self.index);
        }
    }

    /// Sets the user's number.
    pub fn set_user_data(&mut self, data: u64) {
        self.world.state.shapes.records[self.index as usize].user_data = data;
    }

    fn record(&self) -> ShapeRecord {
        self.world.state.shapes.records[self.index as usize]
    }

    /// Replaces the record where that changes anything.
    fn change(&mut self, change: impl FnOnce(&mut ShapeRecord)) {
        let mut new = self.record();
        change(&mut new);
        if new != self.record() {
            self.replace(new);
        }
    }

    /// Replaces the record by one that lets no contact live on.
    fn replace(&mut self, new: ShapeRecord) {
        let (world, index) = (&mut *self.world, self.index);
        let (body, told) = (new.body, world.tells(index));
        world.wake_index(body);
        world.contacts_of(index).into_iter().for_each(|index| world.destroy_contact(index));
        world.note_ground(index, true);
        world.state.shapes.records[index as usize] = new;
        world.state.shapes.set_touched(index, 0);
        world.state.broad_phase.destroy_proxy(world.state.shapes.proxy(index));
        world.state.shapes.records[index as usize].proxy = NULL;
        if told {
            world.update_mass(body);
        } else {
            world.settle_shape(index);
        }
        world.create_proxy(index);
        if world.state.bodies.is_dynamic(body) {
            // The centre of mass may be another: the frames of all shapes are computed anew.
            world.mark_shapes_changed(body);
        }
        world.state.sensors.mark_changed(index);
    }
}

impl World {
    /// Contacts of a shape, ascending.
    fn contacts_of(&self, shape: u32) -> Vec<u32> {
        let body = self.state.shapes.records[shape as usize].body;
        self.contacts_where(body, |contact| contact.shape_a == shape || contact.shape_b == shape)
    }

    /// Brings what contacts know of the materials of their shapes up to date, and wakes what touches.
    fn refresh_contacts_of(&mut self, shape: u32) {
        for index in self.contacts_of(shape) {
            let record = &self.state.contacts.records[index as usize];
            for body in [record.body_a, record.body_b] {
                self.wake_index(body);
            }
            let State { contacts, shapes, graph, .. } = &mut self.state;
            let contact = &mut contacts.records[index as usize];
            pairs::mix_materials(contact, &self.settings, shapes);
            graph.write_materials(contact);
        }
    }
}
