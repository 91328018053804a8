//! Seeing a world: the trait that a drawing library implements, and what it is asked to draw.
//!
//! [`World::debug_draw`](crate::World::debug_draw) walks bodies, joints and contacts and
//! calls a [`DebugDraw`] with plain outlines. Nothing here changes a world, so drawing can never change
//! a result. Everything arrives relative to [`DebugDrawOptions::origin`]: a level 100 km from (0, 0)
//! is drawn without trembling.
//!
//! ```
//! use tiny_physics::{Color, DebugDraw, Shape, Transform, Vec2, draw_shape};
//!
//! struct Count(usize);
//! impl DebugDraw for Count {
//!     fn polygon(&mut self, _: &Transform, _: &[Vec2], _: f32, _: Color) { self.0 += 1; }
//!     fn circle(&mut self, _: &Transform, _: f32, _: Color) { self.0 += 1; }
//!     fn capsule(&mut self, _: Vec2, _: Vec2, _: f32, _: Color) { self.0 += 1; }
//!     fn segment(&mut self, _: Vec2, _: Vec2, _: Color) { self.0 += 1; }
//!     fn point(&mut self, _: Vec2, _: f32, _: Color) { self.0 += 1; }
//!     fn text(&mut self, _: Vec2, _: &str, _: Color) {}
//! }
//! let mut count = Count(0);
//! draw_shape(&mut count, &Shape::Circle { radius: 1.0 }, &Transform::IDENTITY, Color::WHITE);
//! assert_eq!(count.0, 1);
//! ```

mod world;

use crate::codec::described;
use crate::{Aabb, BodyKind, DVec2, Shape, Transform, Vec2};

described! {
    /// A colour: red, green, blue and opacity, 0 to 255 each, sRGB, not premultiplied.
    #[derive(Clone, Copy, PartialEq, Eq, Debug, Hash)]
    pub struct Color {
        /// Red.
        pub r: u8,
        /// Green.
        pub g: u8,
        /// Blue.
        pub b: u8,
        /// Opacity: 0 is invisible, 255 hides what is below.
        pub a: u8,
    }
}

impl Color {
    /// White.
    pub const WHITE: Self = Self::rgb(255, 255, 255);
    /// Black.
    pub const BLACK: Self = Self::rgb(0, 0, 0);

    /// An opaque colour.
    pub const fn rgb(r: u8, g: u8, b: u8) -> Self {
        Self { r, g, b, a: 255 }
    }

    /// The same colour with another opacity.
    pub const fn with_alpha(self, a: u8) -> Self {
        Self { a, ..self }
    }

    /// Part of the way to `other`: 0 here, 1 there; outside of that it stays at the end.
    pub fn mix(self, other: Self, t: f32) -> Self {
        let t = if t > 0.0 { t } else { 0.0 };
        let t = if t < 1.0 { t } else { 1.0 };
        let part = |a: u8, b: u8| (f32::from(a) + (f32::from(b) - f32::from(a)) * t + 0.5) as u8;
        Self {
            r: part(self.r, other.r),
            g: part(self.g, other.g),
            b: part(self.b, other.b),
            a: part(self.a, other.a),
        }
    }
}

/// What the calls that follow show. A drawer may use it to choose symbols, to sort, or to leave
/// things out; the colour is chosen already.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Hash)]
#[non_exhaustive]
pub enum Layer {
    /// Shapes of static bodies.
    Static,
    /// Shapes of kinematic bodies.
    Kinematic,
    /// Shapes of dynamic bodies that are awake.
    Awake,
    /// Shapes of dynamic bodies that are asleep.
    Asleep,
    /// Shapes that only sense.
    Sensor,
    /// Bounding boxes.
    Bounds,
    /// Joints.
    Joint,
    /// Centres of mass and their axes.
    Mass,
    /// Contact points, coloured by depth.
    Contact,
    /// Contact normals, from A to B.
    Normal,
    /// Velocities.
    Velocity,
}

impl Layer {
    /// The layer that the shapes of a body belong to.
    pub fn of_body(kind: BodyKind, awake: bool) -> Self {
        match kind {
            BodyKind::Static => Self::Static,
            BodyKind::Kinematic => Self::Kinematic,
            BodyKind::Dynamic if awake => Self::Awake,
            BodyKind::Dynamic => Self::Asleep,
        }
    }
}

described! {
    /// Colours of everything that is drawn.
    #[derive(Clone, Copy, PartialEq, Eq, Debug)]
    pub struct Palette {
        /// Static bodies.
        pub fixed: Color = Color::rgb(112, 122, 138),
        /// Kinematic bodies.
        pub kinematic: Color = Color::rgb(178, 122, 240),
        /// Dynamic bodies, awake.
        pub awake: Color = Color::rgb(76, 158, 248),
        /// Dynamic bodies, asleep: the same hue, dimmed.
        pub asleep: Color = Color::rgb(52, 84, 122),
        /// Sensors.
        pub sensor: Color = Color::rgb(240, 190, 90).with_alpha(120),
        /// Bounding boxes.
        pub bounds: Color = Color::rgb(140, 140, 160).with_alpha(140),
        /// Joints.
        pub joint: Color = Color::rgb(238, 238, 170),
        /// Centres of mass.
        pub mass: Color = Color::rgb(250, 250, 250),
        /// Contact normals.
        pub normal: Color = Color::rgb(238, 240, 245),
        /// Velocities.
        pub velocity: Color = Color::rgb(120, 230, 170),
    }
}

impl Palette {
    /// The colour of a layer. Contacts take theirs from [`depth_color`]; here they give that of a
    /// touch without depth.
    pub fn color(&self, layer: Layer) -> Color {
        match layer {
            Layer::Static => self.fixed,
            Layer::Kinematic => self.kinematic,
            Layer::Awake => self.awake,
            Layer::Asleep => self.asleep,
            Layer::Sensor => self.sensor,
            Layer::Bounds => self.bounds,
            Layer::Joint => self.joint,
            Layer::Mass => self.mass,
            Layer::Contact => depth_color(0.0),
            Layer::Normal => self.normal,
            Layer::Velocity => self.velocity,
        }
    }
}

/// The scale of [`depth_color`]: depth in metres (of overlap, positive) and its colour. Up to the
/// slop of 5 mm is how bodies rest; past 1 cm something is wrong, past 5 cm badly.
pub const DEPTH_SCALE: [(f32, Color); 6] = [
    (0.0, Color::rgb(64, 196, 255)),
    (0.005, Color::rgb(70, 220, 120)),
    (0.01, Color::rgb(240, 230, 80)),
    (0.02, Color::rgb(255, 165, 50)),
    (0.05, Color::rgb(255, 60, 50)),
    (0.1, Color::rgb(255, 40, 190)),
];

/// The colour of a penetration depth in metres (0 or above; a gap counts as 0), see [`DEPTH_SCALE`].
pub fn depth_color(depth: f32) -> Color {
    for pair in DEPTH_SCALE.windows(2) {
        let ((lower, from), (upper, to)) = (pair[0], pair[1]);
        if depth < upper {
            return from.mix(to, (depth - lower) / (upper - lower));
        }
    }
    DEPTH_SCALE[DEPTH_SCALE.len() - 1].1
}

described! {
    /// What to draw, and in which colours.
    #[derive(Clone, Copy, PartialEq, Debug)]
    pub struct DebugDrawOptions {
        /// Shapes of bodies.
        pub shapes: bool = true,
        /// Joints: lines to their anchors.
        pub joints: bool = true,
        /// Bounding boxes of shapes.
        pub bounds: bool = false,
        /// Centres of mass with the body's axes.
        pub mass: bool = false,
        /// Contact points, coloured by penetration depth.
        pub contacts: bool = true,
        /// Contact normals.
        pub normals: bool = true,
        /// Velocities of moving bodies, as the way of a tenth of a second.
        pub velocities: bool = false,
        /// Bodies blend into the colour of their deepest contact where that is deeper than they should
        /// rest: trouble glows.
        pub depth_tint: bool = true,
        /// Diameter of points, pixels.
        pub point_size: f32 = 6.0,
        /// The world point that is (0, 0) in what is drawn, usually the camera's centre.
        pub origin: DVec2 = DVec2::ZERO,
        /// Bodies are drawn between the start (0) and the end (1) of the last step: see
        /// [`FixedStep::alpha`](crate::FixedStep::alpha).
        pub alpha: f32 = 1.0,
        /// Leave out what is outside this box (relative to the origin).
        pub clip: Option<Aabb> = None,
        /// The colours.
        pub palette: Palette = Palette::default(),
    }
}

/// Draws what it is told; implemented by whoever has a screen.
///
/// All points and frames are metres relative to [`DebugDrawOptions::origin`], y upwards.
pub trait DebugDraw {
    /// Says what the following calls show. Called often; does nothing by default.
    fn layer(&mut self, layer: Layer) {
        let _ = layer;
    }

    /// A convex polygon: vertices anticlockwise in the frame of `pose`, rounded outwards by `radius`
    /// metres.
    fn polygon(&mut self, pose: &Transform, vertices: &[Vec2], radius: f32, color: Color);

    /// A disk around the origin of `pose`, whose x axis shows how far it has turned.
    fn circle(&mut self, pose: &Transform, radius: f32, color: Color);

    /// All points within `radius` metres of the segment from `a` to `b`.
    fn capsule(&mut self, a: Vec2, b: Vec2, radius: f32, color: Color);

    /// A line.
    fn segment(&mut self, a: Vec2, b: Vec2, color: Color);

    /// A dot with a diameter in pixels, the same at any zoom.
    fn point(&mut self, p: Vec2, size_px: f32, color: Color);

    /// A short label beside a point.
    fn text(&mut self, p: Vec2, text: &str, color: Color);
}

/// Draws one shape in its frame `pose`.
pub fn draw_shape(draw: &mut dyn DebugDraw, shape: &Shape, pose: &Transform, color: Color) {
    match shape {
        Shape::Circle { radius } => draw.circle(pose, *radius, color),
        Shape::Aabb { half_extents } => {
            draw.polygon(pose, &box_corners(*half_extents), 0.0, color);
        }
        Shape::Capsule { a, b, radius } => {
            draw.capsule(pose.apply(*a), pose.apply(*b), *radius, color);
        }
        Shape::Segment { a, b } => draw.segment(pose.apply(*a), pose.apply(*b), color),
        Shape::Polygon(polygon) => {
            draw.polygon(pose, polygon.vertices(), polygon.radius(), color);
        }
    }
}

/// Draws the outline of a box that does not turn.
pub fn draw_bounds(draw: &mut dyn DebugDraw, bounds: &Aabb, color: Color) {
    let corners = box_corners(bounds.half_extents()).map(|corner| corner + bounds.center());
    for i in 0..4 {
        draw.segment(corners[i], corners[(i + 1) % 4], color);
    }
}

/// Corners of a centred box, anticlockwise from the lower left.
fn box_corners(half: Vec2) -> [Vec2; 4] {
    [-half, Vec2::new(half.x, -half.y), half, Vec2::new(-half.x, half.y)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Polygon, Rot};

    #[derive(Default)]
    struct Log(Vec<String>);

    impl DebugDraw for Log {
        fn polygon(&mut self, pose: &Transform, vertices: &[Vec2], _: f32, _: Color) {
            self.0.push(format!("polygon {} at {}", vertices.len(), pose.p));
        }
        fn circle(&mut self, pose: &Transform, radius: f32, _: Color) {
            self.0.push(format!("circle {radius} at {}", pose.p));
        }
        fn capsule(&mut self, a: Vec2, b: Vec2, _: f32, _: Color) {
            self.0.push(format!("capsule {a} {b}"));
        }
        fn segment(&mut self, a: Vec2, b: Vec2, _: Color) {
            self.0.push(format!("segment {a} {b}"));
        }
        fn point(&mut self, _: Vec2, _: f32, _: Color) {}
        fn text(&mut self, _: Vec2, _: &str, _: Color) {}
    }

    #[test]
    fn every_shape_reaches_its_call() {
        let mut log = Log::default();
        let pose = Transform::new(Vec2::new(1.0, 2.0), Rot { c: 0.0, s: 1.0 });
        let (a, b) = (Vec2::ZERO, Vec2::X);
        let shapes = [
            Shape::Circle { radius: 0.5 },
            Shape::Aabb { half_extents: Vec2::new(1.0, 2.0) },
            Shape::Capsule { a, b, radius: 0.5 },
            Shape::Segment { a, b },
            Polygon::rect(1.0, 2.0).unwrap().into(),
        ];
        for shape in &shapes {
            draw_shape(&mut log, shape, &pose, Color::WHITE);
        }
        let expected = [
            "circle 0.5 at (1, 2)",
            "polygon 4 at (1, 2)",
            "capsule (1, 2) (1, 3)",
            "segment (1, 2) (1, 3)",
            "polygon 4 at (1, 2)",
        ];
        assert_eq!(log.0, expected);
    }

    #[test]
    fn depth_colours_follow_the_scale_and_bear_any_number() {
        for (depth, color) in DEPTH_SCALE {
            assert_eq!(depth_color(depth), color);
        }
        assert_eq!(depth_color(-1.0), DEPTH_SCALE[0].1);
        assert_eq!(depth_color(1.0e9), DEPTH_SCALE[5].1);
        assert_eq!(depth_color(f32::NAN), DEPTH_SCALE[5].1);
    }

    #[test]
    fn mixing_ends_at_both_ends() {
        let (a, b) = (Color::BLACK, Color::WHITE.with_alpha(55));
        assert_eq!(a.mix(b, 0.0), a);
        assert_eq!(a.mix(b, 1.0), b);
        assert_eq!(a.mix(b, 7.0), b);
        assert_eq!(a.mix(b, f32::NAN), a);
    }
}
