//! Shapes: what hangs on bodies.

use super::bodies::NULL;
use super::places::{claim, put};
use crate::broad_phase::ProxyId;
use crate::codec::{Generations, data_enum, kept_as_described, record, store};
use crate::describe::{ChainLink, Filter, Material, ShapeDef};
use crate::geometry::Shape;
use crate::geometry::manifold::ShapeClass;
use crate::math::{Aabb, Transform, Vec2};
use crate::simd::Row;
use crate::work;

record! {
    /// One shape of a body. What a step touches lies in the first cache line.
    #[derive(Clone, Copy, PartialEq, Debug)]
    #[repr(C, align(64))]
    pub(crate) struct ShapeRecord {
        pub(crate) body: u32 = NULL,
        /// Next shape of the body.
        pub(crate) next: u32 = NULL,
        /// Leaf in the broad phase; NULL while the body is disabled.
        pub(crate) proxy: u32 = NULL,
        pub(crate) class: ShapeClass = ShapeClass::Circle,
        pub(crate) alive: bool = false,
        pub(crate) sensor: bool = false,
        pub(crate) sees_sensors: bool = false,
        pub(crate) contact_events: bool = false,
        pub(crate) hit_events: bool = false,
        pub(crate) filter: Filter = Filter::default(),
        pub(crate) generation: u32 as apart = 0,
        pub(crate) material: Material = Material::default(),
        /// Shape's frame in the body's frame.
        pub(crate) local: Transform = Transform::IDENTITY,
        /// Shape's frame in the frame of the body's centre of mass.
        pub(crate) central: Transform = Transform::IDENTITY,
        /// Frame of the shape as a rounded box (see [`Shapes::rows`]) in the shape's frame.
        pub(crate) box_frame: Transform = Transform::IDENTITY,
        pub(crate) one_way: Option<Vec2> = None,
        pub(crate) link: Option<ChainLink> = None,
        pub(crate) user_data: u64 = 0,
        /// Geometry in the shape's frame.
        pub(crate) shape: Shape = Shape::Circle { radius: 0.0 },
    }
}

kept_as_described!(ShapeRecord of ShapeDef {
    shape, material, filter, sensor, sees_sensors, one_way, link, contact_events, hit_events, user_data,
});

const _: () = assert!(core::mem::offset_of!(ShapeRecord, material) <= 64);

/// What may have changed guards, or have buried sleepers.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Change {
    /// Static shapes came or went in a box.
    Ground { bounds: Aabb },
    /// Ground that makes surfaces with itself alone came, went or was moved there.
    Moved { bounds: Aabb },
    /// A body that is not static has got or lost parts.
    Parts { body: u32 },
}

data_enum!(Change { 0 => Ground { bounds }, 1 => Moved { bounds }, 2 => Parts { body } });

/// Bits that say why contacts with a shape are looked at again: faces and corners that other static
/// shapes touch, chains, one-way platforms.
pub(crate) mod guard {
    use super::ShapeRecord;
    use crate::math::Vec2;

    pub(crate) const CHAIN: u32 = 1 << 16;
    pub(crate) const ONE_WAY: u32 = 1 << 17;

    pub(crate) fn face(index: usize) -> u32 {
        1 << index
    }

    pub(crate) fn corner(index: usize) -> u32 {
        1 << (8 + index)
    }

    /// Another shape goes from an end of this face, wholly before it.
    pub(crate) fn nook(face: usize) -> u32 {
        1 << (24 + face)
    }

    /// The bit that says that the face with this normal (in the frame of the rounded box) is touched by
    /// nothing; 0 for normals that are not along an axis.
    #[inline]
    pub(crate) fn free(normal: Vec2) -> u32 {
        const ALONG: f32 = 1.0 - 1.0e-6;
        if normal.y > ALONG {
            1 << 20
        } else if normal.y < -ALONG {
            1 << 21
        } else if normal.x > ALONG {
            1 << 22
        } else if normal.x < -ALONG {
            1 << 23
        } else {
            0
        }
    }

    /// Those that a shape has by itself.
    pub(crate) fn of(record: &ShapeRecord) -> u32 {
        let chain = if record.link.is_some() { CHAIN } else { 0 };
        chain | if record.one_way.is_some() { ONE_WAY } else { 0 }
    }

    /// The last value of a row without the mark of guards.
    pub(crate) fn exact(value: f32) -> f32 {
        if value >= 2.0 { value - 2.0 } else { value }
    }
}

store! {
    /// All shapes of a world, by stable index.
    #[derive(Debug, PartialEq, Default)]
    pub(crate) struct Shapes {
        pub(crate) records: Vec<ShapeRecord>,
        /// The shape as a rounded box in the frame of the body's centre of mass, for the lane kernels:
        /// place x, y, rotation c, s, half extents x, y, radius, and 1 where this is all there is to the
        /// shape, plus 2 where it has guards. The row of a general polygon is the box around it, and in place
        /// of the 1 is the part of the box's thickness that is its own.
        pub(crate) rows: Vec<Row>,
        /// The boxes of the shapes as they are.
        pub(crate) tight: Vec<Aabb>,
        /// The fat boxes that the broad phase has, for a quick look.
        pub(crate) fat: Vec<Aabb>,
        /// Which contacts are looked at again: see [`guard`].
        pub(crate) guards: Vec<u32>,
        /// What has changed since guards were last found.
        pub(crate) changed_ground: Vec<Change>,
        pub(crate) free: Vec<u32>,
        pub(crate) count: usize,
        generations: Generations,
    }
}

impl Shapes {
    /// Shapes alive.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// Indices of the shapes alive, ascending.
    pub(crate) fn indices(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.records.len() as u32).filter(|&i| self.records[i as usize].alive)
    }

    pub(crate) fn insert(&mut self, mut record: ShapeRecord) -> u32 {
        self.count += 1;
        record.alive = true;
        record.generation = self.generations.next();
        let index = claim(&mut self.free, self.records.len());
        put(&mut self.guards, index, guard::of(&record));
        put(&mut self.records, index, record);
        put(&mut self.rows, index, [0.0; 8]);
        put(&mut self.tight, index, Aabb::EMPTY);
        put(&mut self.fat, index, Aabb::EMPTY);
        index
    }

    /// Notes which faces and corners of a shape others touch, and which they do not.
    pub(crate) fn set_touched(&mut self, index: u32, touched: u32) {
        work::note();
        self.guards[index as usize] = guard::of(&self.records[index as usize]) | touched;
        self.mark_row(index);
    }

    /// Marks the row of a shape as its guards say.
    pub(crate) fn mark_row(&mut self, index: u32) {
        let value = &mut self.rows[index as usize][7];
        *value = guard::exact(*value) + if self.guards[index as usize] != 0 { 2.0 } else { 0.0 };
    }

    pub(crate) fn remove(&mut self, index: u32) {
        self.count -= 1;
        let record = &mut self.records[index as usize];
        record.alive = false;
        record.body = NULL;
        record.proxy = NULL;
        record.next = NULL;
        self.free.push(index);
    }

    /// Do the fat boxes of two shapes overlap?
    #[inline]
    pub(crate) fn may_touch(&self, a: u32, b: u32) -> bool {
        self.fat[a as usize].overlaps(&self.fat[b as usize])
    }

    /// Are the boxes of two shapes less than `reach` metres apart?
    #[inline]
    pub(crate) fn are_near(&self, a: u32, b: u32, reach: f32) -> bool {
        let (a, b) = (&self.tight[a as usize], &self.tight[b as usize]);
        // Differences of what is close are exact, however far out.
        (a.min.x - b.max.x <= reach)
            & (b.min.x - a.max.x <= reach)
            & (a.min.y - b.max.y <= reach)
            & (b.min.y - a.max.y <= reach)
    }

    /// How far the box of a shape reaches from the centre of mass, metres; what is round at its corners.
    pub(crate) fn reach(&self, index: u32) -> f32 {
        self.arm(index) + self.rows[index as usize][6]
    }

    /// That of the box without its radius.
    #[inline]
    pub(crate) fn arm(&self, index: u32) -> f32 {
        let row = &self.rows[index as usize];
        Vec2::new(row[0], row[1]).length() + Vec2::new(row[4], row[5]).length()
    }

    /// The leaf of a shape in the broad phase.
    #[inline]
    pub(crate) fn proxy(&self, index: u32) -> ProxyId {
        ProxyId(self.records[index as usize].proxy)
    }

    /// Indices of a body's shapes, from the head of its list.
    pub(crate) fn of_body(&self, first: u32) -> impl Iterator<Item = u32> + '_ {
        core::iter::successors((first != NULL).then_some(first), |&i| {
            work::note();
            let next = self.records[i as usize].next;
            (next != NULL).then_some(next)
        })
    }
}
