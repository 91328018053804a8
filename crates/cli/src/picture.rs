//! A frame of a simulation in pixels.

use crate::args::Overlay;
use crate::simulation::{Framing, Simulation};
use tiny_physics::{DVec2, DebugDraw, DebugDrawOptions, Layer, World};
use tiny_physics_doctor::Finding;
use tiny_physics_draw::{Camera, Canvas};

/// What a picture shows besides bodies.
#[derive(Clone, Copy, Debug)]
pub struct Overlays {
    /// What the world draws.
    pub world: DebugDrawOptions,
    /// Frame and counts.
    pub text: bool,
    /// The legend.
    pub legend: bool,
}

impl Default for Overlays {
    fn default() -> Self {
        Self { world: DebugDrawOptions::default(), text: true, legend: true }
    }
}

impl Overlays {
    /// The default with some switched on and then some off.
    pub fn new(show: &[Overlay], hide: &[Overlay]) -> Self {
        let mut overlays = Self::default();
        show.iter().for_each(|overlay| *overlays.switch(*overlay) = true);
        hide.iter().for_each(|overlay| *overlays.switch(*overlay) = false);
        overlays
    }

    /// On the other way.
    pub fn toggle(&mut self, overlay: Overlay) {
        let switch = self.switch(overlay);
        *switch = !*switch;
    }

    fn switch(&mut self, overlay: Overlay) -> &mut bool {
        match overlay {
            Overlay::Joints => &mut self.world.joints,
            Overlay::Bounds => &mut self.world.bounds,
            Overlay::Mass => &mut self.world.mass,
            Overlay::Contacts => &mut self.world.contacts,
            Overlay::Normals => &mut self.world.normals,
            Overlay::Velocities => &mut self.world.velocities,
            Overlay::Tint => &mut self.world.depth_tint,
            Overlay::Text => &mut self.text,
            Overlay::Legend => &mut self.legend,
        }
    }
}

/// Size of points in the world, metres, as far as pixels allow: far away they must not hide bodies.
const POINT_METRES: f32 = 0.14;

/// A camera that goes along with what moves.
#[derive(Clone, Copy, Debug)]
pub struct Follower {
    /// Where it looks.
    pub camera: Camera,
    /// Does it go along?
    pub follows: bool,
    middle: Option<DVec2>,
}

impl Follower {
    /// A camera on the whole scene; it goes along where the ground goes on outside the picture.
    pub fn on(simulation: &Simulation, width: u32, height: u32) -> Self {
        let Framing { min, max, goes_on } = simulation.framing();
        let camera = Camera::fit_above(min, max, width, height, Canvas::LEGEND_HEIGHT);
        Self { camera, follows: goes_on, middle: simulation.middle_of_motion() }
    }

    /// A camera that stays where it is.
    pub fn fixed(camera: Camera) -> Self {
        Self { camera, follows: false, middle: None }
    }

    /// Moves by as much as the middle of what moves has moved.
    pub fn follow(&mut self, simulation: &Simulation) {
        let now = simulation.middle_of_motion();
        if let (true, Some(before), Some(now)) = (self.follows, self.middle, now) {
            self.camera.center += now - before;
        }
        self.middle = now;
    }
}

/// Draws a frame. `note` follows the scene's name in the status.
pub fn draw(
    canvas: &mut Canvas,
    simulation: &Simulation,
    camera: &Camera,
    overlays: &Overlays,
    note: &str,
) {
    let lines = status_lines(simulation, note);
    draw_world(canvas, simulation.world(), camera, overlays, &lines);
    if let Some((from, to)) = simulation.pull_line() {
        let relative = |p: DVec2| p.relative_to(camera.center);
        let color = overlays.world.palette.joint;
        canvas.layer(Layer::Joint);
        canvas.segment(relative(from), relative(to), color);
        canvas.point(relative(from), 7.0, color);
    }
}

/// Draws a world, with lines of text if those are shown.
pub fn draw_world(
    canvas: &mut Canvas,
    world: &World,
    camera: &Camera,
    overlays: &Overlays,
    lines: &[String],
) {
    canvas.begin(camera);
    let options = DebugDrawOptions {
        origin: camera.center,
        clip: Some(camera.view()),
        point_size: (camera.scale * POINT_METRES).clamp(1.5, 6.5),
        ..overlays.world
    };
    world.debug_draw(canvas, &options);
    if overlays.legend {
        canvas.legend(&options.palette);
    }
    if overlays.text {
        canvas.status(lines);
    }
}

/// Steps for which a finding stays in the status.
const SHOWN: u64 = 120;

/// The lines of the status: what the doctor found last is the last one.
pub fn status_lines(simulation: &Simulation, note: &str) -> Vec<String> {
    let (status, world) = (simulation.status(), simulation.world());
    let mut lines = vec![
        format!("{}   frame {}{note}", simulation.scene().name, status.frame),
        format!(
            "bodies {} ({} of {} awake)   contacts {}   joints {}",
            world.body_count(),
            status.awake,
            status.moving,
            status.contacts,
            world.joint_count()
        ),
        format!("deepest penetration {:.2} mm", status.deepest * 1000.0),
    ];
    let found = simulation.doctor().and_then(|doctor| doctor.latest(SHOWN));
    lines.extend(found.map(Finding::line));
    lines
}
