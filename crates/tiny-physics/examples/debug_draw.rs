//! Debug drawing through a trait: a drawer of forty lines that writes an SVG picture.
//! `cargo run -p tiny-physics --example debug_draw > picture.svg`

use std::fmt::Write;
use tiny_physics::{
    Color, DebugDraw, DebugDrawOptions, Error, RigidBody, Shape, Transform, Vec2, World,
};

/// Forty pixels a metre, y upwards, the origin in the middle.
struct Svg(String);

fn to_screen(p: Vec2) -> (f32, f32) {
    (400.0 + 40.0 * p.x, 300.0 - 40.0 * p.y)
}

fn css(color: Color) -> String {
    format!("rgba({},{},{},{:.2})", color.r, color.g, color.b, f32::from(color.a) / 255.0)
}

impl DebugDraw for Svg {
    fn polygon(&mut self, pose: &Transform, vertices: &[Vec2], radius: f32, color: Color) {
        let corners = vertices.iter().map(|v| to_screen(pose.apply(*v)));
        let points: String = corners.map(|(x, y)| format!("{x:.1},{y:.1} ")).collect();
        let (fill, width) = (css(color), 80.0 * radius);
        let style =
            format!("fill='{fill}' stroke='{fill}' stroke-width='{width}' stroke-linejoin='round'");
        let _ = writeln!(self.0, "<polygon points='{points}' {style}/>");
    }

    fn circle(&mut self, pose: &Transform, radius: f32, color: Color) {
        let (x, y) = to_screen(pose.p);
        let _ = writeln!(
            self.0,
            "<circle cx='{x}' cy='{y}' r='{}' fill='{}'/>",
            40.0 * radius,
            css(color)
        );
    }

    fn capsule(&mut self, a: Vec2, b: Vec2, radius: f32, color: Color) {
        self.line(a, b, 80.0 * radius, color);
    }

    fn segment(&mut self, a: Vec2, b: Vec2, color: Color) {
        self.line(a, b, 1.0, color);
    }

    fn point(&mut self, p: Vec2, size_px: f32, color: Color) {
        self.line(p, p, size_px, color);
    }

    fn text(&mut self, p: Vec2, text: &str, color: Color) {
        let (x, y) = to_screen(p);
        let _ = writeln!(self.0, "<text x='{x}' y='{y}' fill='{}'>{text}</text>", css(color));
    }
}

impl Svg {
    fn line(&mut self, a: Vec2, b: Vec2, width: f32, color: Color) {
        let ((x1, y1), (x2, y2), stroke) = (to_screen(a), to_screen(b), css(color));
        let ends = format!("x1='{x1}' y1='{y1}' x2='{x2}' y2='{y2}'");
        let style = format!("stroke='{stroke}' stroke-width='{width}' stroke-linecap='round'");
        let _ = writeln!(self.0, "<line {ends} {style}/>");
    }
}

/// Runs the example.
pub fn main() -> Result<(), Error> {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    world.add_body(
        RigidBody::fixed().position(Vec2::new(0.0, -5.0)).shape(Shape::rect(9.0, 0.5)?),
    )?;
    for i in 0..12 {
        let place =
            Vec2::new((i % 3) as f32 - 1.0 + 0.1 * (i / 3) as f32, -3.9 + 1.1 * (i / 3) as f32);
        let shape = if i % 2 == 0 { Shape::circle(0.5)? } else { Shape::rect(0.5, 0.5)? };
        world.add_body(RigidBody::dynamic().position(place).shape(shape))?;
    }
    for _ in 0..60 {
        world.step(1.0 / 60.0);
    }
    let mut svg = Svg("<svg xmlns='http://www.w3.org/2000/svg' width='800' height='600'>\n".into());
    world.debug_draw(&mut svg, &DebugDrawOptions::default());
    println!("{}</svg>", svg.0);
    // `matches` counts: six balls; six boxes and the ground.
    assert_eq!(svg.0.matches("<circle").count(), 6);
    assert_eq!(svg.0.matches("<polygon").count(), 7);
    assert!(svg.0.matches("<line").count() > 10, "contact points and normals");
    Ok(())
}
