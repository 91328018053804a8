//! Chains of segments: ground drawn as a line.

use super::{ChainLink, Filter, Material, ShapeDef};
use crate::codec::{described, setters};
use crate::error::Error;
use crate::geometry::{MAX_EXTENT, Shape};
use crate::math::Vec2;

described! {
    /// A line of segments, open or closed, free of bumps at its joints.
    ///
    /// The right of the way along the points is outside: a hill is drawn from right to left, a closed chain
    /// anticlockwise is a solid island, clockwise a room. Things behind the line pass through.
    ///
    /// ```
    /// use tiny_physics::{ChainDef, RigidBody, Vec2, World};
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let points = [(8.0, 0.0), (3.0, 0.5), (-3.0, 0.0), (-8.0, 1.0)].map(|(x, y)| Vec2::new(x, y));
    /// let mut world = World::new(Vec2::new(0.0, -9.8));
    /// let ground = world.add_body(RigidBody::fixed())?;
    /// let chain = world.add_chain(ground, &ChainDef::open(&points).friction(0.8))?;
    /// assert_eq!(chain.len(), 3);
    /// # Ok(())
    /// # }
    /// ```
    #[derive(Clone, Debug, PartialEq)]
    pub struct ChainDef {
        /// Corners, metres in the body's frame: two or more, three or more for a closed chain.
        pub points: Vec<Vec2>,
        /// Does a segment lead from the last point to the first?
        pub closed: bool = default,
        /// Surfaces of the segments in order. Fewer than segments: the last goes on; none: the default.
        pub materials: Vec<Material> = default,
        /// What it collides with.
        pub filter: Filter = default,
        /// Free for the user; all segments get it.
        pub user_data: u64 = default,
    }
    with fn of_points(points: Vec<Vec2>);
}

impl ChainDef {
    /// A chain that ends at its first and last point.
    pub fn open(points: &[Vec2]) -> Self {
        Self::of_points(points.to_vec())
    }

    /// A chain whose last point is joined to its first.
    pub fn closed(points: &[Vec2]) -> Self {
        Self { closed: true, ..Self::open(points) }
    }

    /// Ground of which the heights at even distances are known, from left to right: a height field. The first is at
    /// x = 0, all in metres. The chain goes from right to left, as hills do: its first segment, that of `materials[0]`, is
    /// the rightmost.
    ///
    /// ```
    /// use tiny_physics::prelude::*;
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let mut world = World::new((0.0, -10.0));
    /// let hills: Vec<f32> = (0..100).map(|i| (0.3 * i as f32).sin()).collect();
    /// let ground = RigidBody::fixed().position((-50.0, 0.0)).chain(&ChainDef::heights(1.0, &hills))?;
    /// world.add_body(ground)?;
    /// # Ok(())
    /// # }
    /// ```
    pub fn heights(spacing: f32, heights: &[f32]) -> Self {
        let points = heights.iter().enumerate().map(|(i, &y)| Vec2::new(i as f32 * spacing, y));
        Self::open(&points.rev().collect::<Vec<_>>())
    }

    /// Ground without hills: a line through `point`, solid from the side that `normal` points to, that goes on 900 km each
    /// way, as far as coordinates go, in segments that grow: the one with `point` has 2 km. A flat floor is `RigidBody::fixed().chain(&ChainDef::half_space((0.0, 0.0), (0.0, 1.0)))?`.
    pub fn half_space(point: impl Into<Vec2>, normal: impl Into<Vec2>) -> Self {
        let (point, way) = (point.into(), normal.into().normalized().perp());
        // A segment of all the length would be rounded to centimetres where it is aslant.
        let along = [-9e5, -1e5, -1e4, -1e3, 1e3, 1e4, 1e5, 9e5].map(|at| point + way * at);
        let near = |at: Vec2| at.x.abs() <= MAX_EXTENT && at.y.abs() <= MAX_EXTENT;
        let all = along.into_iter().enumerate().filter(|&(k, at)| matches!(k, 3 | 4) || near(at));
        Self::of_points(all.map(|(_, at)| at).collect())
    }

    /// Sets the friction of all segments.
    pub fn friction(mut self, friction: f32) -> Self {
        if self.materials.is_empty() {
            self.materials.push(Material::default());
        }
        self.materials.iter_mut().for_each(|material| material.friction = friction);
        self
    }

    /// The segments as shapes of a body, in order.
    ///
    /// # Errors
    /// Too few points, a point that is not finite, or neighbours closer than
    /// [`MIN_EXTENT`](crate::geometry::MIN_EXTENT).
    pub fn shapes(&self) -> Result<Vec<ShapeDef>, Error> {
        let count = self.points.len();
        let (least, reason) = if self.closed {
            (3, "a closed chain needs three points")
        } else {
            (2, "a chain needs two points")
        };
        if count < least {
            return Err(Error::BadPoints { reason, index: count });
        }
        let segments = if self.closed { count } else { count - 1 };
        (0..segments).map(|i| self.segment(i)).collect()
    }

    fn segment(&self, i: usize) -> Result<ShapeDef, Error> {
        let count = self.points.len();
        let point = |k: usize| self.points[k % count];
        let shape = Shape::segment(point(i), point(i + 1)).map_err(|error| match error {
            Error::BadPoints { .. } => {
                Error::BadPoints { reason: "points of a chain are closer than 1e-5 m", index: i }
            }
            other => other,
        })?;
        let link = ChainLink {
            previous: (self.closed || i > 0).then(|| point(i + count - 1)),
            next: (self.closed || i + 2 < count).then(|| point(i + 2)),
        };
        let mut def = ShapeDef::new(shape).filter(self.filter).user_data(self.user_data);
        if let Some(material) = self.materials.get(i).or(self.materials.last()) {
            def.material = *material;
        }
        def.link = Some(link);
        Ok(def)
    }
}

setters! {
    ChainDef {
        /// Sets one material for all segments.
        material(material: Material): materials = vec![material];
        /// Sets [`ChainDef::filter`].
        filter(filter: Filter): filter = filter;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segments_know_their_neighbours() {
        let points = [Vec2::ZERO, Vec2::X, Vec2::new(2.0, 1.0), Vec2::new(0.0, 3.0)];
        let open = ChainDef::open(&points).friction(0.3).shapes().unwrap();
        assert_eq!(open.len(), 3);
        assert_eq!(open[0].link, Some(ChainLink { previous: None, next: Some(points[2]) }));
        assert_eq!(open[2].link, Some(ChainLink { previous: Some(points[1]), next: None }));
        assert!(open.iter().all(|shape| shape.material.friction == 0.3));
        let closed = ChainDef::closed(&points).shapes().unwrap();
        assert_eq!(closed.len(), 4);
        let last = ChainLink { previous: Some(points[2]), next: Some(points[1]) };
        assert_eq!(closed[3].link, Some(last));
        assert_eq!(closed[3].shape, Shape::Segment { a: points[3], b: points[0] });
    }

    #[test]
    fn bad_chains_are_refused() {
        assert!(ChainDef::open(&[Vec2::ZERO]).shapes().is_err());
        assert!(ChainDef::closed(&[Vec2::ZERO, Vec2::X]).shapes().is_err());
        let error = ChainDef::open(&[Vec2::ZERO, Vec2::X, Vec2::X]).shapes().unwrap_err();
        assert!(matches!(error, Error::BadPoints { index: 1, .. }));
        assert!(ChainDef::open(&[Vec2::ZERO, Vec2::new(f32::NAN, 0.0)]).shapes().is_err());
    }
}
