//! Draws a picture without a world: every shape, every layer, every depth of the scale.
//!
//! `cargo run -p tiny-physics-draw --example picture -- picture.png`

use tiny_physics::{
    DEPTH_SCALE, DVec2, DebugDraw, Layer, Palette, Polygon, Rot, Shape, Transform, Vec2,
    depth_color, draw_bounds, draw_shape,
};
use tiny_physics_draw::{Camera, Canvas};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "picture.png".into());
    let camera = Camera::fit(DVec2::new(-10.0, -3.0), DVec2::new(10.0, 8.0), 1280, 720);
    let mut canvas = Canvas::new(camera.width, camera.height)?;
    canvas.begin(&camera);
    let palette = Palette::default();
    let place = |x: f64, y: f64, angle: f32| {
        Transform::new(DVec2::new(x, y).relative_to(camera.center), Rot::from_angle(angle))
    };

    canvas.layer(Layer::Static);
    let ground = Shape::Aabb { half_extents: Vec2::new(500.0, 1.0) };
    draw_shape(&mut canvas, &ground, &place(0.0, -1.0, 0.0), palette.fixed);

    let shapes = [
        Shape::Circle { radius: 0.7 },
        Shape::Aabb { half_extents: Vec2::new(0.8, 0.5) },
        Shape::Capsule { a: Vec2::new(-0.6, 0.0), b: Vec2::new(0.6, 0.2), radius: 0.4 },
        Shape::Segment { a: Vec2::new(-0.7, -0.4), b: Vec2::new(0.7, 0.4) },
        Polygon::rect(0.7, 0.7)?.into(),
    ];
    let layers = [Layer::Static, Layer::Kinematic, Layer::Awake, Layer::Asleep, Layer::Sensor];
    for (row, layer) in layers.into_iter().enumerate() {
        canvas.layer(layer);
        for (column, shape) in shapes.iter().enumerate() {
            let pose = place(-8.5 + 2.2 * column as f64, 0.9 + 1.6 * row as f64, 0.3);
            draw_shape(&mut canvas, shape, &pose, palette.color(layer));
        }
    }

    canvas.layer(Layer::Contact);
    for (i, (depth, _)) in DEPTH_SCALE.iter().enumerate() {
        let p = place(3.0 + i as f64, 5.0, 0.0).p;
        let tinted = palette.awake.mix(depth_color(*depth), 0.8);
        canvas.layer(Layer::Awake);
        canvas.circle(&place(3.0 + i as f64, 6.5, 0.5), 0.45, tinted);
        canvas.layer(Layer::Contact);
        canvas.segment(p, p + Vec2::new(0.0, 0.5), palette.normal);
        canvas.point(p, 8.0, depth_color(*depth));
        canvas.text(p + Vec2::new(0.0, -0.4), &format!("{:.0} mm", depth * 1000.0), palette.joint);
    }
    let view = camera.view().grown(-0.5);
    draw_bounds(&mut canvas, &view, palette.bounds);
    canvas.segment(place(3.0, 2.0, 0.0).p, place(6.0, 3.0, 0.0).p, palette.joint);

    canvas.status(&["a picture by hand   frame 0", "25 bodies   6 contacts"]);
    canvas.side_text(&["space  play or pause", "s      one step"]);
    canvas.legend(&palette);
    std::fs::write(&path, canvas.to_png()?)?;
    println!("{path}");
    Ok(())
}
