//! Stand-ins until joints, threads and the rest of the geometry are merged; then this file goes.
use super::{BodyId, JointId, World};
use crate::describe::JointDef;
use crate::error::Error;
use crate::geometry::Shape;
use crate::math::{Aabb, Transform, Vec2};

/// A joint, to read.
pub struct JointRef;

impl JointRef {
    /// The joined bodies.
    pub fn bodies(&self) -> (BodyId, BodyId) {
        unreachable!()
    }
    /// Its description.
    pub fn def(&self) -> JointDef {
        unreachable!()
    }
}

impl World {
    /// Not yet.
    pub fn set_threads(&mut self, _: usize) {}
    /// Not yet.
    pub fn threads(&self) -> usize {
        1
    }
    /// Not yet.
    pub fn joint_ids(&self) -> impl Iterator<Item = JointId> + '_ {
        core::iter::empty()
    }
    /// Not yet.
    pub fn joint(&self, _: JointId) -> Option<JointRef> {
        None
    }
    /// Not yet.
    pub fn joint_count(&self) -> usize {
        0
    }
    /// Not yet.
    pub fn add_joint(&mut self, _: BodyId, _: BodyId, _: JointDef) -> Result<JointId, Error> {
        Err(Error::Unsupported { reason: "joints are not there yet" })
    }
    /// Not yet.
    pub fn remove_joint(&mut self, _: JointId) -> Result<(), Error> {
        Ok(())
    }
}

impl Shape {
    /// Not yet.
    pub fn aabb(&self, frame: Transform) -> Aabb {
        let box_of = |points: &[Vec2], radius: f32| {
            let empty = Aabb::EMPTY;
            let all = points.iter().fold(empty, |all, p| {
                let p = frame.apply(*p);
                all.union(&Aabb::new(p, p))
            });
            all.grown(radius)
        };
        match self {
            Self::Circle { radius } => box_of(&[Vec2::ZERO], *radius),
            Self::Aabb { half_extents } => Aabb::from_center(frame.p, *half_extents),
            Self::Capsule { a, b, radius } => box_of(&[*a, *b], *radius),
            Self::Segment { a, b } => box_of(&[*a, *b], 0.0),
            Self::Polygon(polygon) => box_of(polygon.vertices(), polygon.radius()),
        }
    }
    /// Not yet.
    pub fn contains(&self, p: Vec2) -> bool {
        self.aabb(Transform::IDENTITY).contains_point(p)
    }
}
