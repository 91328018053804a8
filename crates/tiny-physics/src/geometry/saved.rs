//! Shapes as data of a saved frame. What is read is checked.

use super::polygon::MAX_VERTICES;
use super::{Polygon, Shape};
use crate::codec::{Data, Reader, Sink, bad, data_enum};
use crate::error::Error;
use crate::geometry::manifold::{PairClass, ShapeClass};
use crate::math::Vec2;

data_enum!(Shape {
    0 => Circle { radius },
    1 => Aabb { half_extents },
    2 => Capsule { a, b, radius },
    3 => Segment { a, b },
    4 => Polygon(polygon),
} load with Shape::validate);

impl Data for Polygon {
    fn save(&self, sink: &mut Sink) {
        sink.put([self.vertices().len() as u8]);
        self.vertices().iter().for_each(|vertex| vertex.save(sink));
        self.radius().save(sink);
    }

    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        let count = usize::from(u8::load(reader)?);
        let mut vertices = [Vec2::ZERO; MAX_VERTICES];
        let vertices = vertices.get_mut(..count).ok_or(bad("a polygon has many corners"))?;
        for vertex in &mut *vertices {
            *vertex = Data::load(reader)?;
        }
        Self::convex(vertices)?.rounded(Data::load(reader)?)
    }
}

data_enum!(ShapeClass { 0 => Circle, 1 => Capsule, 2 => Box, 3 => General });
data_enum!(PairClass {
    0 => BoxBox,
    1 => BoxCircle,
    2 => CapsuleCircle,
    3 => CircleCircle,
    4 => General,
});
