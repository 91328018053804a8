//! `view`: a scene in a window.

use crate::args::{Light, Looks, Overlay, Style, ViewArgs, WorldArgs};
use crate::failure::{Failure, Outcome};
use crate::picture::{self, Follower, Overlays};
use crate::simulation::Simulation;
use crate::source;
use std::time::Instant;
use tiny_physics::{FixedStep, Vec2};
use tiny_physics_draw::{Camera, Canvas, Input, Key, Window};
use tiny_physics_scenes::all;

const HELP: [&str; 20] = [
    "keys and mouse",
    "space      play, pause",
    "right, s   one step",
    "left       one step back",
    "u, i       a second back, on",
    "0 to 9, e  to a part of the run, its end",
    "up, down   faster, slower",
    "r          restart",
    "n, b       next, previous scene",
    "left btn   drag a body",
    "right btn  move the view",
    "wheel      zoom",
    "f, o       fit, follow motion",
    "c, v       contacts, normals",
    "j, x       joints, boxes",
    "m, a       masses, velocities",
    "d          tint by depth",
    "p, k       debug style, dark",
    "t, l       text, legend",
    "h, q       this help, quit",
];

/// Parts of real time at which the scene can play.
const SPEEDS: [f32; 6] = [0.02, 0.1, 0.25, 0.5, 1.0, 2.0];
/// Real time in [`SPEEDS`].
const USUAL_SPEED: usize = 4;

/// Opens the window and runs until it is closed.
///
/// # Errors
/// No such scene, or no window can be opened.
pub fn run(args: &ViewArgs) -> Outcome {
    let mut viewer = Viewer::new(args)?;
    let (width, height) = args.size;
    let mut window = Window::open(&viewer.title(), width, height).map_err(|error| {
        Failure::from(error).hint(
            "'tiny-physics render' draws pictures and 'tiny-physics demo' letters without a display",
        )
    })?;
    let mut canvas = Canvas::new(width, height)?;
    let mut last = Instant::now();
    while window.is_open() && !viewer.quit {
        let (width, height) = window.size();
        if (canvas.width(), canvas.height()) != (width, height) {
            canvas = Canvas::new(width, height)?;
            viewer.eye.camera = viewer.eye.camera.resized(width, height);
        }
        let elapsed = last.elapsed().as_secs_f32();
        last = Instant::now();
        if viewer.handle(&window.input())? {
            window.set_title(&viewer.title());
        }
        viewer.advance(elapsed);
        viewer.draw(&mut canvas);
        window.show(&canvas)?;
    }
    viewer.simulation.all_done()
}

/// The scene in the window and what the user has set; knows no window, so that it can be tested.
struct Viewer {
    how: WorldArgs,
    simulation: Simulation,
    eye: Follower,
    overlays: Overlays,
    clock: FixedStep,
    speed: usize,
    playing: bool,
    help: bool,
    quit: bool,
    /// The mouse in the frame before.
    mouse: Option<Vec2>,
    /// Was the left button down in the frame before?
    holding: bool,
}

impl Viewer {
    fn new(args: &ViewArgs) -> Outcome<Self> {
        let scene = source::open(&args.scene, args.world.seed)?;
        let simulation = Simulation::kept(scene, &args.world)?.watched();
        let overlays = overlays(args.looks);
        let framing = simulation.framing();
        Ok(Self {
            how: args.world.clone(),
            eye: Follower::on(&simulation, &framing, args.size, overlays.room()),
            clock: FixedStep::new(simulation.dt()),
            simulation,
            overlays,
            speed: USUAL_SPEED,
            playing: !args.paused,
            help: true,
            quit: false,
            mouse: None,
            holding: false,
        })
    }

    fn title(&self) -> String {
        format!("tiny-physics: {}", self.simulation.scene().name)
    }

    /// Does what keys and mouse say; true where the scene is another one.
    fn handle(&mut self, input: &Input) -> Outcome<bool> {
        self.mouse(input);
        for key in &input.repeated {
            self.time_key(*key)?;
        }
        let mut changed = false;
        for key in &input.pressed {
            changed |= self.key(*key)?;
        }
        Ok(changed)
    }

    /// Goes back and on in the run.
    fn time_key(&mut self, key: Key) -> Outcome {
        let (at, end) = self.simulation.place();
        let second = (1.0 / self.simulation.dt()).round() as usize;
        let step = match key {
            Key::Right | Key::Char('s') => {
                self.playing = false;
                self.simulation.step();
                return Ok(());
            }
            Key::Left => at.saturating_sub(1),
            Key::Char('u') => at.saturating_sub(second),
            Key::Char('i') => at + second,
            Key::Char('e') => end,
            Key::Char(digit) if digit.is_ascii_digit() => {
                end * (digit as usize - '0' as usize) / 10
            }
            _ => return Ok(()),
        };
        self.playing = false;
        self.simulation.go_to(step)
    }

    fn key(&mut self, key: Key) -> Outcome<bool> {
        match key {
            Key::Space => self.playing = !self.playing,
            Key::Up => self.speed = (self.speed + 1).min(SPEEDS.len() - 1),
            Key::Down => self.speed = self.speed.saturating_sub(1),
            Key::Escape | Key::Char('q') => self.quit = true,
            Key::Char('r') => {
                self.simulation.restart()?;
                self.fit();
            }
            Key::Char('f') => self.fit(),
            Key::Char('o') => self.eye.follows = !self.eye.follows,
            Key::Char('h') => self.help = !self.help,
            Key::Char('p') => {
                let style = match self.overlays.looks.style {
                    Style::Show => Style::Debug,
                    Style::Debug => Style::Show,
                };
                self.overlays = overlays(Looks { style, ..self.overlays.looks });
            }
            Key::Char('k') => {
                let looks = &mut self.overlays.looks;
                looks.theme = if looks.theme == Light::Light { Light::Dark } else { Light::Light };
            }
            Key::Char('n') => return self.other_scene(1),
            Key::Char('b') => return self.other_scene(-1),
            Key::Char(letter) => {
                if let Some(overlay) = overlay_of(letter) {
                    self.overlays.toggle(overlay);
                }
            }
            _ => {}
        }
        Ok(false)
    }

    /// Left drags a body, right moves the view, the wheel zooms.
    fn mouse(&mut self, input: &Input) {
        let before = core::mem::replace(&mut self.mouse, input.mouse);
        let was_holding = core::mem::replace(&mut self.holding, input.left_down);
        if !input.left_down {
            self.simulation.release();
        }
        let Some(mouse) = input.mouse else { return };
        if input.wheel != 0.0 {
            self.eye.camera.zoom(if input.wheel > 0.0 { 1.1 } else { 1.0 / 1.1 }, mouse);
        }
        let point = self.eye.camera.to_world(mouse);
        match (input.left_down, was_holding) {
            (true, false) => self.simulation.grab(point),
            (true, true) => self.simulation.drag(point),
            (false, _) => {}
        }
        if let (true, Some(before)) = (input.right_down, before) {
            self.eye.camera.pan(mouse - before);
        }
    }

    fn fit(&mut self) {
        let Camera { width, height, .. } = self.eye.camera;
        let (framing, room) = (self.simulation.framing(), self.overlays.room());
        self.eye = Follower::on(&self.simulation, &framing, (width, height), room);
    }

    /// The built-in scene so many places further on; around at the ends.
    fn other_scene(&mut self, offset: isize) -> Outcome<bool> {
        let scenes = all();
        let name = &self.simulation.scene().name;
        let here = scenes.iter().position(|entry| entry.name == name);
        let next = match here {
            Some(here) => (here as isize + offset).rem_euclid(scenes.len() as isize) as usize,
            None => 0,
        };
        let scene = source::open(scenes[next].name, self.how.seed)?;
        self.simulation = Simulation::kept(scene, &self.how)?.watched();
        self.clock = FixedStep::new(self.simulation.dt());
        self.fit();
        Ok(true)
    }

    /// Lets the time pass that has passed.
    fn advance(&mut self, elapsed: f32) {
        if self.playing {
            let steps = self.clock.advance(elapsed * SPEEDS[self.speed]);
            self.simulation.play(steps);
        }
        self.eye.follow(&self.simulation);
    }

    fn draw(&self, canvas: &mut Canvas) {
        let (at, end) = self.simulation.place();
        let note = match (self.playing, self.speed == USUAL_SPEED) {
            _ if at < end => format!("   step {at} of {end}"),
            (true, true) => String::new(),
            (true, false) => format!("   speed {}", SPEEDS[self.speed]),
            (false, _) => "   paused".into(),
        };
        picture::draw(canvas, &self.simulation, &self.eye.camera, &self.overlays, &note);
        if self.help {
            canvas.side_text(&HELP);
        }
    }
}

/// What a window shows at first: text in any style.
fn overlays(looks: Looks) -> Overlays {
    Overlays::of(looks).but(&[Overlay::Text], &[])
}

fn overlay_of(letter: char) -> Option<Overlay> {
    Some(match letter {
        'c' => Overlay::Contacts,
        'v' => Overlay::Normals,
        'j' => Overlay::Joints,
        'x' => Overlay::Bounds,
        'm' => Overlay::Mass,
        'a' => Overlay::Velocities,
        'd' => Overlay::Tint,
        't' => Overlay::Text,
        'l' => Overlay::Legend,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn viewer() -> Viewer {
        let world = WorldArgs { seed: 1, threads: 1, simd: None };
        let args = ViewArgs {
            scene: "seed_demo".into(),
            size: (320, 200),
            paused: true,
            looks: Looks::default(),
            world,
        };
        Viewer::new(&args).unwrap()
    }

    fn press(viewer: &mut Viewer, key: Key) {
        let input = Input { pressed: vec![key], repeated: vec![key], ..Input::default() };
        viewer.handle(&input).unwrap();
    }

    #[test]
    fn keys_step_play_restart_and_quit() {
        let mut viewer = viewer();
        viewer.advance(1.0);
        assert_eq!(viewer.simulation.status().frame, 0);
        press(&mut viewer, Key::Char('s'));
        press(&mut viewer, Key::Right);
        assert_eq!(viewer.simulation.status().frame, 2);
        press(&mut viewer, Key::Space);
        viewer.advance(0.051);
        assert_eq!(viewer.simulation.status().frame, 5);
        press(&mut viewer, Key::Char('r'));
        assert_eq!(viewer.simulation.status().frame, 0);
        press(&mut viewer, Key::Char('q'));
        assert!(viewer.quit);
    }

    #[test]
    fn the_status_shows_what_the_doctor_found_last() {
        let world = WorldArgs { seed: 1, threads: 1, simd: None };
        let args = ViewArgs {
            scene: "bowl".into(),
            size: (320, 200),
            paused: true,
            looks: Looks::default(),
            world,
        };
        let mut viewer = Viewer::new(&args).unwrap();
        let last = |viewer: &Viewer| picture::status_lines(&viewer.simulation, "").pop().unwrap();
        assert!(last(&viewer).starts_with("deepest"));
        press(&mut viewer, Key::Right);
        assert!(last(&viewer).starts_with("warning: overlap_at_start"), "{}", last(&viewer));
        press(&mut viewer, Key::Char('r'));
        assert!(last(&viewer).starts_with("deepest"));
    }

    #[test]
    fn keys_go_back_and_on_and_a_pull_in_the_past_makes_another_run() {
        let mut viewer = viewer();
        let hash = |viewer: &Viewer| viewer.simulation.world().state_hash();
        let mut hashes = vec![hash(&viewer)];
        for _ in 0..100 {
            press(&mut viewer, Key::Right);
            hashes.push(hash(&viewer));
        }
        let keys = [(Key::Left, 99), (Key::Char('u'), 39), (Key::Right, 40), (Key::Char('7'), 70)];
        for (key, step) in keys.into_iter().chain([(Key::Char('0'), 0), (Key::Char('i'), 60)]) {
            press(&mut viewer, key);
            assert_eq!((viewer.simulation.place(), hash(&viewer)), ((step, 100), hashes[step]));
        }
        let body = viewer.simulation.world().body_ids().last().unwrap();
        let place = viewer.simulation.world().body(body).unwrap().center();
        viewer.simulation.grab(place);
        viewer.simulation.drag(place + Vec2::new(3.0, 3.0));
        // Not by a key: a frame without the button lets go.
        viewer.simulation.step();
        assert_eq!(viewer.simulation.place(), (61, 61));
        assert_ne!(hash(&viewer), hashes[61]);
        press(&mut viewer, Key::Char('e'));
        assert_eq!(viewer.simulation.place(), (61, 61));
    }

    #[test]
    fn scenes_follow_each_other_both_ways() {
        let mut viewer = viewer();
        let start = viewer.simulation.scene().name.clone();
        press(&mut viewer, Key::Char('n'));
        assert_ne!(viewer.simulation.scene().name, start);
        press(&mut viewer, Key::Char('b'));
        assert_eq!(viewer.simulation.scene().name, start);
    }

    #[test]
    fn the_mouse_pulls_a_body_where_it_goes() {
        let mut viewer = viewer();
        let world = viewer.simulation.world();
        let moving = world.body_ids().filter_map(|id| world.body(id));
        let body = moving.filter(|b| b.kind() == tiny_physics::BodyKind::Dynamic).last().unwrap();
        let (id, start) = (body.id(), body.position_f64());
        let pixel = viewer.eye.camera.to_pixels(start.relative_to(viewer.eye.camera.center));
        let at = |pixel| Input { mouse: Some(pixel), left_down: true, ..Input::default() };
        viewer.handle(&at(pixel)).unwrap();
        assert!(viewer.simulation.pull_line().is_some());
        let target = pixel + Vec2::new(0.0, -20.0);
        for _ in 0..120 {
            viewer.handle(&at(target)).unwrap();
            viewer.simulation.step();
        }
        let there = viewer.eye.camera.to_world(target);
        let now = viewer.simulation.world().body(id).unwrap().position_f64();
        assert!(now.relative_to(there).length() < 1.0, "{now} is not at {there}");
        viewer.handle(&Input::default()).unwrap();
        assert!(viewer.simulation.pull_line().is_none());
    }
}
