//! Mass, centre of mass and moment of inertia of shapes of even density.
//!
//! Exact for every shape, corner radii included: a rounded core is its polygon (triangles from one corner),
//! a rectangle along every edge and a sector of a disk at every corner. Sums are kept in 64 bits about the
//! first core point, so a shape far from its frame's origin loses nothing.

use super::{Core, Polygon, Shape};
use crate::math::{DVec2, Transform, Vec2, atan2};
use core::f64::consts::TAU;

/// Mass, where its centre is, and how hard it is to turn about that centre.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct MassProperties {
    /// Kilograms.
    pub mass: f32,
    /// Centre of mass, metres in the frame of the shape (or of whatever it was moved to).
    pub center: Vec2,
    /// Moment of inertia about the centre of mass, kg m^2.
    pub inertia: f32,
}

impl MassProperties {
    /// The same seen from the parent frame.
    pub fn transformed(self, frame: Transform) -> Self {
        Self { center: frame.apply(self.center), ..self }
    }

    /// The same shape with another mass, in kilograms; inertia follows. Without mass it stays as it is.
    pub fn with_mass(self, mass: f32) -> Self {
        if self.mass > 0.0 {
            Self { mass, inertia: self.inertia * (mass / self.mass), ..self }
        } else {
            self
        }
    }

    /// Moment of inertia about another point of the same frame, kg m^2 (parallel axes).
    pub fn inertia_about(self, point: Vec2) -> f32 {
        self.inertia + self.mass * (self.center - point).length_sq()
    }

    /// Several parts of one frame as one. Without mass at all, the centre is the mean of the centres.
    pub fn combined(parts: &[Self]) -> Self {
        let origin = DVec2::from(parts.first().map_or(Vec2::ZERO, |part| part.center));
        let mut sum = Moments { area: 0.0, first: DVec2::ZERO, second: 0.0 };
        let (mut centers, mut count) = (DVec2::ZERO, 0.0);
        for part in parts {
            let (mass, center) = (f64::from(part.mass), DVec2::from(part.center) - origin);
            sum.area += mass;
            sum.first += center * mass;
            sum.second += f64::from(part.inertia) + mass * center.length_sq();
            (centers, count) = (centers + center, count + 1.0);
        }
        if sum.area > 0.0 {
            return sum.finish(origin, 1.0);
        }
        let mean = centers * (1.0 / if count > 0.0 { count } else { 1.0 });
        Self { center: (origin + mean).to_vec2(), ..Self::default() }
    }
}

impl Polygon {
    /// Centre of area, corner radius included, metres in the shape's frame.
    pub fn centroid(&self) -> Vec2 {
        Shape::Polygon(*self).mass_properties(1.0).center
    }
}

impl Shape {
    /// Mass properties for a density in kg a square metre. A segment has none; its centre is its middle.
    pub fn mass_properties(&self, density: f32) -> MassProperties {
        let core = self.core();
        let origin = DVec2::from(core.points[0]);
        let moments = Moments::of_core(&core, origin);
        if moments.area <= 0.0 {
            let center = (core.points[0] + core.points[core.count - 1]) * 0.5;
            return MassProperties { center, ..MassProperties::default() };
        }
        moments.finish(origin, f64::from(density))
    }

    /// Area, square metres.
    pub fn area(&self) -> f32 {
        self.mass_properties(1.0).mass
    }
}

/// Integrals over an area (or a mass), about one origin: of 1, of the position, of its square.
struct Moments {
    area: f64,
    first: DVec2,
    second: f64,
}

impl Moments {
    fn of_core(core: &Core, origin: DVec2) -> Self {
        let mut sum = Self { area: 0.0, first: DVec2::ZERO, second: 0.0 };
        let radius = f64::from(core.radius);
        let point = |i: usize| DVec2::from(core.points[i]) - origin;
        if core.count == 1 {
            sum.add_sector(point(0), DVec2::ZERO, TAU, radius);
        }
        for i in 0..core.edge_count() {
            let next = (i + 1) % core.count;
            let (normal, next_normal) = (core.normal(i), core.normal(next));
            sum.add_triangle(point(i), point(next));
            if radius > 0.0 {
                sum.add_edge(point(i), point(next), normal.into(), radius);
                sum.add_corner(point(next), normal, next_normal, radius);
            }
        }
        sum
    }

    /// Mass, centre and inertia about the centre, for a density; the area must be above 0.
    fn finish(&self, origin: DVec2, density: f64) -> MassProperties {
        let center = self.first * (1.0 / self.area);
        let inertia = self.second - self.area * center.length_sq();
        MassProperties {
            mass: (density * self.area) as f32,
            center: (origin + center).to_vec2(),
            inertia: (density * inertia) as f32,
        }
    }

    /// The triangle from the origin to p and q, signed.
    fn add_triangle(&mut self, p: DVec2, q: DVec2) {
        let doubled = p.x * q.y - p.y * q.x;
        self.area += doubled / 2.0;
        self.first += (p + q) * (doubled / 6.0);
        self.second += doubled / 12.0 * (p.length_sq() + p.dot(q) + q.length_sq());
    }

    /// The rectangle of the given thickness outside the edge.
    fn add_edge(&mut self, start: DVec2, end: DVec2, normal: DVec2, thickness: f64) {
        let edge = end - start;
        let length_sq = edge.length_sq();
        let area = length_sq.sqrt() * thickness;
        let center = (start + end) * 0.5 + normal * (0.5 * thickness);
        self.area += area;
        self.first += center * area;
        self.second += area * ((length_sq + thickness * thickness) / 12.0 + center.length_sq());
    }

    /// The sector between the normals of two edges that meet. With u the unit vector that goes from one to
    /// the other, the integral of u over the angle is perp(normal) - perp(next).
    fn add_corner(&mut self, corner: DVec2, normal: Vec2, next: Vec2, radius: f64) {
        let angle = f64::from(atan2(normal.cross(next), normal.dot(next)));
        let direction = DVec2::from(normal.perp()) - DVec2::from(next.perp());
        self.add_sector(corner, direction, angle, radius);
    }

    /// A sector of a disk; `direction` is the integral of its unit vectors over its angle.
    fn add_sector(&mut self, center: DVec2, direction: DVec2, angle: f64, radius: f64) {
        let radius_sq = radius * radius;
        let area = 0.5 * radius_sq * angle;
        let first = direction * (radius_sq * radius / 3.0);
        self.area += area;
        self.first = self.first + center * area + first;
        self.second += 0.25 * radius_sq * radius_sq * angle
            + 2.0 * center.dot(first)
            + area * center.length_sq();
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::any_shape;
    use super::*;
    use crate::geometry::Polygon;
    use crate::math::Rot;
    use proptest::prelude::*;

    fn close(a: f32, b: f32, relative: f32) -> bool {
        (a - b).abs() <= relative * (1.0 + b.abs())
    }

    #[test]
    fn known_formulas() {
        let circle = Shape::circle(2.0).unwrap().mass_properties(3.0);
        let mass = 12.0 * core::f32::consts::PI;
        assert!(close(circle.mass, mass, 1e-6) && close(circle.inertia, mass * 2.0, 1e-6));
        let rect = Shape::rect(1.0, 2.0).unwrap().mass_properties(0.5);
        assert!(close(rect.mass, 4.0, 1e-6) && close(rect.inertia, 4.0 * 20.0 / 12.0, 1e-6));
        assert_eq!(Shape::aabb_box(Vec2::new(1.0, 2.0)).unwrap().mass_properties(0.5), rect);
        let segment = Shape::segment(Vec2::ZERO, Vec2::X).unwrap().mass_properties(1.0);
        assert_eq!((segment.mass, segment.inertia), (0.0, 0.0));
        assert_eq!(segment.center, Vec2::new(0.5, 0.0));
    }

    #[test]
    fn far_from_the_origin_nothing_is_lost() {
        let near = Polygon::rect(0.5, 0.25).unwrap();
        let frame = Transform::from_angle(Vec2::new(4096.0, -8192.0), 0.0);
        let far = Shape::from(near.transformed(frame).unwrap()).mass_properties(1.0);
        let near = Shape::from(near).mass_properties(1.0);
        assert!(close(far.inertia, near.inertia, 1e-5), "{far:?}");
        assert_eq!(far.center, frame.p);
    }

    #[test]
    fn parts_combine_to_the_whole() {
        let whole = Shape::rect(2.0, 1.0).unwrap().mass_properties(1.5);
        let half = Shape::rect(1.0, 1.0).unwrap().mass_properties(1.5);
        let at = |x| half.transformed(Transform::from_angle(Vec2::new(x, 0.0), 0.0));
        let both = MassProperties::combined(&[at(-1.0), at(1.0)]);
        assert!(close(both.mass, whole.mass, 1e-6) && close(both.inertia, whole.inertia, 1e-6));
        assert_eq!(both.center, Vec2::ZERO);
        assert_eq!(MassProperties::combined(&[]), MassProperties::default());
        assert!(close(half.inertia_about(Vec2::X), half.inertia + half.mass, 1e-6));
        assert!(close(whole.with_mass(12.0).inertia, whole.inertia, 1e-6));
        assert_eq!(MassProperties::default().with_mass(3.0), MassProperties::default());
    }

    /// Sums over the middles of a grid of cells.
    fn integrated(shape: &Shape) -> MassProperties {
        // No common divisor: a box's diagonal must not run through the middles of all its cells.
        const COLUMNS: usize = 300;
        const ROWS: usize = 331;
        let bounds = shape.aabb(Transform::IDENTITY);
        let size = bounds.max - bounds.min;
        let cell = Vec2::new(size.x / COLUMNS as f32, size.y / ROWS as f32);
        let area = f64::from(cell.x * cell.y);
        let mut sum = Moments { area: 0.0, first: DVec2::ZERO, second: 0.0 };
        for i in 0..COLUMNS * ROWS {
            let (column, row) = ((i % COLUMNS) as f32 + 0.5, (i / COLUMNS) as f32 + 0.5);
            let point = bounds.min + Vec2::new(cell.x * column, cell.y * row);
            if shape.contains(point) {
                let point = DVec2::from(point);
                sum.area += area;
                sum.first += point * area;
                sum.second += point.length_sq() * area;
            }
        }
        sum.finish(DVec2::ZERO, 1.0)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]
        #[test]
        fn formulas_agree_with_integration(shape in any_shape()) {
            let found = shape.mass_properties(1.0);
            // Slivers fall between the cells of the grid, and so do edges of what is thin across it.
            let size = shape.aabb(Transform::IDENTITY).half_extents();
            if found.mass < 0.05 || found.mass < 0.4 * size.x * size.y {
                return Ok(());
            }
            let expected = integrated(&shape);
            prop_assert!((found.mass / expected.mass - 1.0).abs() < 0.02, "{found:?} {expected:?}");
            prop_assert!((found.inertia / expected.inertia - 1.0).abs() < 0.02, "{found:?} {expected:?}");
            prop_assert!(found.center.distance(expected.center) < 0.01, "{found:?} {expected:?}");
        }

        #[test]
        fn turning_a_polygon_turns_its_mass(
            polygon in super::super::tests::any_polygon(),
            angle in -4.0_f32..4.0,
        ) {
            let frame = Transform::new(Vec2::new(3.0, -2.0), Rot::from_angle(angle));
            let Ok(moved) = polygon.transformed(frame) else { return Ok(()) };
            let expected = Shape::from(polygon).mass_properties(2.0).transformed(frame);
            let found = Shape::from(moved).mass_properties(2.0);
            prop_assert!((found.mass - expected.mass).abs() < 1e-4 * (1.0 + expected.mass));
            prop_assert!((found.inertia - expected.inertia).abs() < 1e-4 * (1.0 + expected.inertia));
            prop_assert!(found.center.distance(expected.center) < 1e-3);
        }
    }
}
