//! The presentation style: worlds as people like to look at them. What shows trouble is left to the debug drawing.

mod backdrop;
mod cast;
mod figures;
mod ground;
mod joints;

use crate::camera::Camera;
use crate::canvas::{Canvas, paint};
use crate::theme::Theme;
use cast::Cast;
use tiny_physics::{Color, Vec2, World};
use tiny_skia::{FillRule, Path, PathBuilder, Transform as Placement};

/// What [`Canvas::paint`] is to know besides the world.
#[derive(Clone, Debug)]
pub struct Painting {
    /// The colours.
    pub theme: Theme,
    /// Bodies are painted between the start (0) and the end (1) of the last step.
    pub alpha: f32,
    /// Are joints shown: ropes, rods, springs, pins?
    pub joints: bool,
    /// Water, which no world knows.
    pub waters: Vec<Water>,
}

impl Default for Painting {
    /// By day, as of the end of the last step, with joints, without water.
    fn default() -> Self {
        Self { theme: Theme::LIGHT, alpha: 1.0, joints: true, waters: Vec::new() }
    }
}

/// Water up to a height.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Water {
    /// Height of its surface: world, metres.
    pub surface: f64,
    /// Left and right end, metres; all of the picture where not said.
    pub between: Option<(f64, f64)>,
}

impl Canvas {
    /// Paints a world in the presentation style. It takes the place of [`Canvas::begin`] and
    /// [`World::debug_draw`], which may still draw contacts and the like on top.
    ///
    /// ```
    /// use tiny_physics::prelude::*;
    /// use tiny_physics_draw::{Camera, Canvas, Painting, Theme, Water};
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let mut world = World::new((0.0, -10.0));
    /// world.add_body(RigidBody::dynamic().position((0.0, 1.0)).shape(Shape::circle(0.5)?))?;
    /// let camera = Camera::fit((-4.0, -2.0).into(), (4.0, 3.0).into(), 320, 200);
    /// let pond = Water { surface: 0.0, between: None };
    /// let painting = Painting { theme: Theme::DARK, waters: vec![pond], ..Painting::default() };
    /// let mut canvas = Canvas::new(320, 200)?;
    /// canvas.paint(&world, &camera, &painting);
    /// assert!(canvas.to_png()?.len() > 1000);
    /// # Ok(())
    /// # }
    /// ```
    pub fn paint(&mut self, world: &World, camera: &Camera, painting: &Painting) {
        self.begin(camera);
        self.note = painting.theme.note;
        let camera = *self.camera();
        let cast = Cast::of(world, &camera, painting);
        let mut easel = Easel { canvas: self, camera, theme: painting.theme };
        easel.backdrop(world);
        easel.waters(painting, world, false);
        easel.sensors(&cast, painting);
        easel.shadow(&cast);
        if painting.joints {
            easel.ropes(&cast);
        }
        easel.figures(&cast);
        easel.waters(painting, world, true);
        easel.ground(&cast);
        if painting.joints {
            easel.pins(&cast);
        }
    }
}

/// A canvas that is painted on.
struct Easel<'a> {
    canvas: &'a mut Canvas,
    camera: Camera,
    theme: Theme,
}

impl Easel<'_> {
    /// Metres as pixels, between bounds.
    fn pixels(&self, metres: f32, least: f32, most: f32) -> f32 {
        (metres * self.camera.scale).clamp(least, most)
    }

    fn fill(&mut self, path: &Path, color: Color) {
        self.canvas.fill_path(path, color);
    }

    fn stroke(&mut self, path: &Path, width: f32, color: Color) {
        self.canvas.stroke_path(path, width, color);
    }

    fn dot(&mut self, p: Vec2, radius: f32, color: Color) {
        if let Some(path) = PathBuilder::from_circle(p.x, p.y, radius) {
            self.fill(&path, color);
        }
    }

    /// One shadow below all that is there.
    fn shadow(&mut self, cast: &Cast) {
        let figures = cast.figures.iter().filter(|figure| !figure.is_small()).map(|f| &f.path);
        let Some(path) = merged(figures.chain(&cast.ground)) else { return };
        let by = self.pixels(0.09, 1.0, 5.0);
        let color = self.theme.shade.with_alpha(46);
        let place = Placement::from_translate(0.7 * by, by);
        self.canvas.pixmap.fill_path(&path, &paint(color), FillRule::Winding, place, None);
    }
}

/// Paths as one: where it is filled there are no seams, as all go round the same way.
fn merged<'a>(paths: impl IntoIterator<Item = &'a Path>) -> Option<Path> {
    let mut all = PathBuilder::new();
    paths.into_iter().for_each(|path| all.push_path(path));
    all.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use tiny_physics::{
        ChainDef, DVec2, JointDef, RigidBody, Shape, ShapeDef, TileGrid, World as Physics,
    };

    const SIZE: (u32, u32) = (200, 100);

    fn painted(world: &Physics, painting: &Painting) -> Canvas {
        let mut canvas = Canvas::new(SIZE.0, SIZE.1).unwrap();
        let camera = Camera { center: DVec2::ZERO, scale: 10.0, width: SIZE.0, height: SIZE.1 };
        canvas.paint(world, &camera, painting);
        canvas
    }

    /// The colour at a point of the world, metres.
    fn at(canvas: &Canvas, x: f32, y: f32) -> Color {
        let (column, row) = ((100.0 + 10.0 * x) as usize, (50.0 - 10.0 * y) as usize);
        let [r, g, b] = canvas.rgb().nth(row * SIZE.0 as usize + column).unwrap();
        Color::rgb(r, g, b)
    }

    fn near(a: Color, b: Color) -> bool {
        let off = [a.r.abs_diff(b.r), a.g.abs_diff(b.g), a.b.abs_diff(b.b)];
        off.into_iter().max() < Some(6)
    }

    #[test]
    fn what_is_joined_shares_a_colour_and_the_ground_has_an_edge() {
        let theme = Theme::DARK;
        let mut world = Physics::new((0.0, -10.0));
        let slab = RigidBody::fixed().position((0.0, -3.0)).shape(Shape::rect(9.0, 1.0).unwrap());
        world.add_body(slab).unwrap();
        let rect =
            |x: f64| RigidBody::dynamic().position((x, 0.0)).shape(Shape::rect(0.5, 0.5).unwrap());
        let [a, b, alone] = [-5.0, -3.0, 4.0].map(|x| world.add_body(rect(x)).unwrap());
        world.add_joint(a, b, JointDef::revolute().anchor_at((-4.0, 0.0))).unwrap();
        let canvas = painted(&world, &Painting { theme, joints: false, ..Painting::default() });
        let group = a.index();
        assert!(near(at(&canvas, -4.65, 0.0), theme.body(group, 0)));
        assert!(near(at(&canvas, -2.65, 0.0), theme.body(group, 1)));
        assert!(near(at(&canvas, 4.35, 0.0), theme.body(alone.index(), 0)));
        assert!(near(at(&canvas, 0.0, -2.05), theme.ground[1]));
        assert!(near(at(&canvas, 0.0, -3.0), theme.ground[0]));
    }

    #[test]
    fn hills_are_filled_and_ceilings_are_not() {
        let theme = Theme::LIGHT;
        let mut world = Physics::new((0.0, -10.0));
        let heights = [0.0; 21];
        let hill = RigidBody::fixed().position((-8.0, -2.0));
        world.add_body(hill.chain(&ChainDef::heights(0.8, &heights)).unwrap()).unwrap();
        let ceiling: Vec<Vec2> = (0..21).map(|i| Vec2::new(0.8 * i as f32 - 8.0, 3.0)).collect();
        world.add_body(RigidBody::fixed().chain(&ChainDef::open(&ceiling)).unwrap()).unwrap();
        let canvas = painted(&world, &Painting::default());
        assert!(near(at(&canvas, 0.0, -3.0), theme.ground[0]));
        assert!(!near(at(&canvas, 0.0, 2.5), theme.ground[0]));
    }

    #[test]
    fn water_is_blue_and_hides_no_ground() {
        let theme = Theme::LIGHT;
        let mut world = Physics::new((0.0, -10.0));
        world
            .add_body(RigidBody::fixed().shape(ShapeDef::new(Shape::circle(1.0).unwrap())))
            .unwrap();
        let water = Water { surface: 2.0, between: Some((-3.0, 3.0)) };
        let canvas = painted(&world, &Painting { waters: vec![water], ..Painting::default() });
        let wet = at(&canvas, 2.0, 0.0);
        assert!(u32::from(wet.b) > 60 + u32::from(wet.r), "{wet:?}");
        let dry = at(&canvas, 5.0, 0.0);
        assert!(u32::from(dry.b) < 60 + u32::from(dry.r), "{dry:?}");
        assert!(near(at(&canvas, 0.0, 0.0), theme.ground[0]));
    }

    #[test]
    fn worlds_of_every_kind_and_size_can_be_painted() {
        let mut world = Physics::new((0.0, 0.0));
        world.add_tiles(TileGrid::parse(1.0, &["#/\\-", "####"]).unwrap()).unwrap();
        let base = world
            .add_body(
                RigidBody::fixed().chain(&ChainDef::half_space((0.0, 0.0), (0.0, 1.0))).unwrap(),
            )
            .unwrap();
        let shapes = [
            Shape::circle(1.0e5).unwrap(),
            Shape::circle(1.0e-3).unwrap(),
            Shape::rect(1.0e6, 1.0).unwrap(),
            Shape::capsule((-1.0, 0.0), (1.0, 0.0), 0.2).unwrap(),
            Shape::Aabb { half_extents: Vec2::new(0.5, 3.0e5) },
        ];
        let kinds = [
            JointDef::revolute(),
            JointDef::distance(1.0).spring(2.0, 0.1),
            JointDef::rope(1.0e6),
            JointDef::weld(),
            JointDef::mouse((1.0e8, 0.0), 1.0),
            JointDef::pulley((-1.0e7, 5.0), (4.0, 5.0), 3.0e7),
            JointDef::prismatic((0.0, 1.0)),
        ];
        for (i, shape) in shapes.into_iter().enumerate() {
            for body in [RigidBody::dynamic(), RigidBody::kinematic(), RigidBody::fixed()] {
                let place = (i as f64, 10.0_f64.powi(2 * i as i32));
                let id = world.add_body(body.position(place).shape(shape)).unwrap();
                for kind in &kinds {
                    // A joint between two bodies that do not move is refused.
                    let _ = world.add_joint(base, id, *kind);
                }
            }
        }
        assert!(world.joint_count() >= kinds.len());
        let waters = vec![Water { surface: f64::MAX, between: Some((3.0, -3.0)) }];
        for theme in [Theme::LIGHT, Theme::DARK] {
            let canvas =
                painted(&world, &Painting { theme, waters: waters.clone(), ..Painting::default() });
            assert!(canvas.rgb().any(|pixel| pixel != [0; 3]));
        }
    }
}
