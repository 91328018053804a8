//! The picture on the front page of the documentation, as SVG: `cargo run -p tiny-physics-draw --example front_picture >
//! docs/guide/front.svg`.

use tiny_physics::prelude::*;
use tiny_physics::{Color, DebugDraw, DebugDrawOptions};

fn main() -> Result<(), Error> {
    let mut world = scene()?;
    for _ in 0..68 {
        world.step(1.0 / 60.0);
    }
    let options = DebugDrawOptions {
        contacts: false,
        normals: false,
        depth_tint: false,
        ..Default::default()
    };
    let mut pen = Pen(String::new(), 0);
    world.debug_draw(&mut pen, &options);
    println!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-11 -7.6 22 9.2\" style=\"width:100%;max-width:46em;background:#1d2233;\
         border-radius:6px\" role=\"img\" aria-label=\"A ball hits a wall of boxes, on tiles and hills\">{}</svg>",
        pen.0
    );
    Ok(())
}

/// A wall of boxes on tiles, hit by a ball; a bridge that hangs over hills; somebody who watches.
fn scene() -> Result<World, Error> {
    let mut world = World::new((0.0, -9.8));
    let tiles = ["..........", "/########\\", "##########"];
    world.add_tiles(TileGrid::parse(0.75, &tiles)?.position((1.5, -1.5)))?;
    let hills: Vec<f32> = (0..=25).map(|i| (0.55 * i as f32).sin() * 0.5 - 0.5).collect();
    world.add_body(
        RigidBody::fixed().position((-11.0, 0.0)).chain(&ChainDef::heights(0.5, &hills))?,
    )?;
    world.add_body(RigidBody::fixed().position((10.0, -1.0)).shape(Shape::rect(1.2, 0.5)?))?;
    for i in 0..42 {
        let (column, row) = (i % 6, i / 6);
        let place =
            (4.1 + 0.62 * f64::from(column) + 0.3 * f64::from(row % 2), 0.3 + 0.6 * f64::from(row));
        world.add_body(RigidBody::dynamic().position(place).shape(Shape::rect(0.3, 0.3)?))?;
    }
    let ball = ShapeDef::new(Shape::circle(0.8)?).density(9.0);
    world.add_body(RigidBody::dynamic().position((-8.5, 1.0)).velocity((14.0, 8.0)).shape(ball))?;
    hang_bridge(&mut world)?;
    world.add_body(CharacterMover::new((2.6, 1.0), 1.4, 0.3).describe_body())?;
    Ok(world)
}

fn hang_bridge(world: &mut World) -> Result<(), Error> {
    let mut last = world.add_body(RigidBody::fixed().position((-10.0, 4.6)))?;
    for i in 0..14 {
        let x = -9.75 + 0.5 * f64::from(i);
        let plank = RigidBody::dynamic().position((x, 4.6)).shape(Shape::capsule(
            (-0.18, 0.0),
            (0.18, 0.0),
            0.09,
        )?);
        let plank = world.add_body(plank)?;
        world.add_joint(last, plank, JointDef::revolute().anchor_at((x - 0.25, 4.6)))?;
        last = plank;
    }
    // It comes nearer, so that the bridge sags.
    let post =
        world.add_body(RigidBody::kinematic().position((-3.0, 4.6)).velocity((-1.1, 0.2)))?;
    world.add_joint(last, post, JointDef::revolute().anchors((0.25, 0.0), (0.0, 0.0)))?;
    Ok(())
}

const COLORS: [&str; 7] =
    ["#e76f51", "#f4a261", "#e9c46a", "#8ab17d", "#2a9d8f", "#5b8fb9", "#9d7fb8"];

/// The text so far, and how many moving things have been drawn.
struct Pen(String, usize);

impl Pen {
    /// Grey for what stands still, the next colour for what moves.
    fn ink(&mut self, color: Color) -> String {
        if color == tiny_physics::Palette::default().fixed {
            return "fill=\"#4a5270\"".into();
        }
        self.1 += 1;
        format!(
            "fill=\"{}\" stroke=\"#1d2233\" stroke-width=\".05\"",
            COLORS[self.1 * 3 % COLORS.len()]
        )
    }
}

impl DebugDraw for Pen {
    fn polygon(&mut self, pose: &Transform, vertices: &[Vec2], _radius: f32, color: Color) {
        let points =
            vertices.iter().map(|v| pose.apply(*v)).map(|p| format!("{:.2},{:.2}", p.x, -p.y));
        let points = points.collect::<Vec<_>>().join(" ");
        let ink = self.ink(color);
        self.0 += &format!("<polygon points=\"{points}\" {ink}/>");
    }

    fn circle(&mut self, pose: &Transform, radius: f32, color: Color) {
        let ink = self.ink(color);
        self.0 += &format!(
            "<circle cx=\"{:.2}\" cy=\"{:.2}\" r=\"{radius:.2}\" {ink}/>",
            pose.p.x, -pose.p.y
        );
    }

    fn capsule(&mut self, a: Vec2, b: Vec2, radius: f32, _color: Color) {
        self.1 += 1;
        let (width, color) = (2.0 * radius, COLORS[self.1 * 3 % COLORS.len()]);
        self.0 += &format!(
            "<path d=\"M{:.2} {:.2}L{:.2} {:.2}\" stroke=\"{color}\" stroke-width=\"{width:.2}\" stroke-linecap=\"round\"/>",
            a.x, -a.y, b.x, -b.y
        );
    }

    fn segment(&mut self, a: Vec2, b: Vec2, _color: Color) {
        self.0 += &format!(
            "<path d=\"M{:.2} {:.2}L{:.2} {:.2}\" stroke=\"#8ab17d\" stroke-width=\".08\"/>",
            a.x, -a.y, b.x, -b.y
        );
    }

    fn point(&mut self, _p: Vec2, _size_px: f32, _color: Color) {}

    fn text(&mut self, _p: Vec2, _text: &str, _color: Color) {}
}
