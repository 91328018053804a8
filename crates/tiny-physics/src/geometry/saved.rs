//! Shapes as data of a saved frame. What is read is checked.

use super::polygon::MAX_VERTICES;
use super::{Polygon, Shape};
use crate::codec::{Data, Reader, Sink, bad};
use crate::error::Error;
use crate::geometry::manifold::{PairClass, ShapeClass};
use crate::math::Vec2;

impl Data for Shape {
    fn save(&self, sink: &mut Sink) {
        match self {
            Self::Circle { radius } => {
                sink.put([0]);
                radius.save(sink);
            }
            Self::Aabb { half_extents } => {
                sink.put([1]);
                half_extents.save(sink);
            }
            Self::Capsule { a, b, radius } => {
                sink.put([2]);
                (*a, (*b, *radius)).save(sink);
            }
            Self::Segment { a, b } => {
                sink.put([3]);
                (*a, *b).save(sink);
            }
            Self::Polygon(polygon) => {
                sink.put([4]);
                sink.put([polygon.vertices().len() as u8]);
                polygon.vertices().iter().for_each(|vertex| vertex.save(sink));
                polygon.radius().save(sink);
            }
        }
    }

    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        let shape = match u8::load(reader)? {
            0 => Self::Circle { radius: Data::load(reader)? },
            1 => Self::Aabb { half_extents: Data::load(reader)? },
            2 => {
                let (a, (b, radius)) = Data::load(reader)?;
                Self::Capsule { a, b, radius }
            }
            3 => {
                let (a, b) = Data::load(reader)?;
                Self::Segment { a, b }
            }
            4 => {
                let count = usize::from(u8::load(reader)?);
                let mut vertices = [Vec2::ZERO; MAX_VERTICES];
                let vertices =
                    vertices.get_mut(..count).ok_or(bad("a polygon has many corners"))?;
                for vertex in &mut *vertices {
                    *vertex = Data::load(reader)?;
                }
                let polygon = Polygon::convex(vertices)?;
                Self::Polygon(polygon.rounded(Data::load(reader)?)?)
            }
            _ => return Err(bad("a kind of shape is unknown")),
        };
        shape.validate().map(|()| shape)
    }
}

impl Data for ShapeClass {
    fn save(&self, sink: &mut Sink) {
        sink.put([*self as u8]);
    }
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        let all = [Self::Circle, Self::Capsule, Self::Box, Self::General];
        let number = usize::from(u8::load(reader)?);
        all.get(number).copied().ok_or(bad("a class of shape is unknown"))
    }
}

impl Data for PairClass {
    fn save(&self, sink: &mut Sink) {
        sink.put([*self as u8]);
    }
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        let number = usize::from(u8::load(reader)?);
        Self::ALL.get(number).copied().ok_or(bad("a class of contact is unknown"))
    }
}
