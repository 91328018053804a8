//! A frame of a simulation in pixels.

use crate::args::{Light, Looks, Overlay, Style};
use crate::simulation::{Framing, Simulation};
use tiny_physics::{DVec2, DebugDraw, DebugDrawOptions, Layer, Vec2, World};
use tiny_physics_doctor::Finding;
use tiny_physics_draw::{Camera, Canvas, Painting, Theme, Water};

/// How a picture looks, and what it shows besides bodies.
#[derive(Clone, Copy, Debug)]
pub struct Overlays {
    /// What it is for, and its colours.
    pub looks: Looks,
    /// What the world draws.
    pub world: DebugDrawOptions,
    /// Frame and counts.
    pub text: bool,
    /// The legend.
    pub legend: bool,
}

impl Overlays {
    /// What belongs to a style.
    pub fn of(looks: Looks) -> Self {
        let debug = looks.style == Style::Debug;
        let world = DebugDrawOptions {
            contacts: debug,
            normals: debug,
            depth_tint: debug,
            ..DebugDrawOptions::default()
        };
        Self { looks, world, text: debug, legend: debug }
    }

    /// What the debug style shows.
    pub fn debug() -> Self {
        Self::of(Looks { style: Style::Debug, ..Looks::default() })
    }

    /// The usual ones with some switched on and then some off.
    pub fn but(mut self, show: &[Overlay], hide: &[Overlay]) -> Self {
        show.iter().for_each(|overlay| *self.switch(*overlay) = true);
        hide.iter().for_each(|overlay| *self.switch(*overlay) = false);
        self
    }

    /// Pixels that notes take along the upper and the lower edge.
    pub fn room(&self) -> [u32; 2] {
        let lines = if self.looks.style == Style::Debug { 3 } else { 1 };
        [
            if self.text { Canvas::status_height(lines) } else { 0 },
            if self.legend { Canvas::LEGEND_HEIGHT } else { 0 },
        ]
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

/// Part of the height that is left over by which the camera looks up.
const ABOVE: f32 = 0.3;

/// Part of the picture's half height by which what is followed may leave the height at which it is looked at.
const STEADY: f32 = 0.35;

/// A camera that goes along with what moves.
#[derive(Clone, Copy, Debug)]
pub struct Follower {
    /// Where it looks.
    pub camera: Camera,
    /// Does it go along?
    pub follows: bool,
    middle: Option<DVec2>,
    /// How far it is above the height that the camera looks at, metres.
    height: f32,
}

impl Follower {
    /// A camera on a part of the scene; it goes along where the ground goes on outside the picture.
    pub fn on(
        simulation: &Simulation,
        framing: &Framing,
        size: (u32, u32),
        room: [u32; 2],
    ) -> Self {
        let mut camera = Camera::fit_between(framing.min, framing.max, size, room);
        if simulation.world().gravity.y < 0.0 {
            // There is more to see above ground than below.
            let height = size.1.saturating_sub(room[0] + room[1]).max(size.1 / 2);
            let all = height as f32 / camera.scale;
            let spare = (all - framing.max.relative_to(framing.min).y).max(0.0);
            camera.center += Vec2::new(0.0, ABOVE * spare);
        }
        Self {
            camera,
            follows: framing.goes_on,
            middle: simulation.middle_of_motion(),
            height: 0.0,
        }
    }

    /// A camera that stays where it is.
    pub fn fixed(camera: Camera) -> Self {
        Self { camera, follows: false, middle: None, height: 0.0 }
    }

    /// Moves by as much as the middle of what moves has moved.
    pub fn follow(&mut self, simulation: &Simulation) {
        self.look_at(simulation.middle_of_motion());
    }

    /// The same for a known middle. What goes up and down a little does not move the picture.
    pub fn look_at(&mut self, now: Option<DVec2>) {
        let before = self.middle;
        self.middle = now;
        let (true, Some(before), Some(now)) = (self.follows, before, now) else { return };
        let way = now.relative_to(before);
        let free = STEADY * self.camera.view().half_extents().y;
        let height = self.height + way.y;
        self.height = height.clamp(-free, free);
        self.camera.center += Vec2::new(way.x, height - self.height);
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
    let lines = match overlays.looks.style {
        Style::Show => vec![caption(simulation, note)],
        Style::Debug => status_lines(simulation, note),
    };
    let (world, waters) = (simulation.world(), simulation.waters());
    draw_world(canvas, world, camera, overlays, waters);
    if let Some((from, to)) = simulation.pull_line() {
        let relative = |p: DVec2| p.relative_to(camera.center);
        let color = overlays.world.palette.joint;
        canvas.layer(Layer::Joint);
        canvas.segment(relative(from), relative(to), color);
        canvas.point(relative(from), 7.0, color);
    }
    draw_notes(canvas, overlays, &lines);
}

/// Draws a world and its waters.
pub fn draw_world(
    canvas: &mut Canvas,
    world: &World,
    camera: &Camera,
    overlays: &Overlays,
    waters: Vec<Water>,
) {
    let mut options = DebugDrawOptions {
        origin: camera.center,
        clip: Some(camera.view()),
        point_size: (camera.scale * POINT_METRES).clamp(1.5, 6.5),
        ..overlays.world
    };
    if overlays.looks.style == Style::Debug {
        canvas.begin(camera);
    } else {
        let theme = if overlays.looks.theme == Light::Dark { Theme::DARK } else { Theme::LIGHT };
        let joints = core::mem::take(&mut options.joints);
        canvas.paint(world, camera, &Painting { theme, joints, waters, ..Painting::default() });
        options.shapes = false;
    }
    world.debug_draw(canvas, &options);
}

/// Writes what is shown beside a world.
pub fn draw_notes(canvas: &mut Canvas, overlays: &Overlays, lines: &[String]) {
    if overlays.legend {
        canvas.legend(&overlays.world.palette);
    }
    if overlays.text {
        canvas.status(lines);
    }
}

/// One line for those who look on: what, when, and what the doctor found last.
fn caption(simulation: &Simulation, note: &str) -> String {
    let seconds = simulation.world().step_count() as f32 * simulation.dt();
    let found = simulation.doctor().and_then(|doctor| doctor.latest(SHOWN)).map(Finding::line);
    let found = found.map_or(String::new(), |line| format!("   {line}"));
    format!("{}   {seconds:.1} s{note}{found}", simulation.scene().name)
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
