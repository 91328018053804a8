//! The demo in a terminal: letters in colour, keys to step, play, pause, restart.

use crate::args::{DemoArgs, WorldArgs};
use crate::failure::Outcome;
use crate::simulation::{Framing, Simulation};
use crate::{source, text_frame};
use crossterm::event::{self, Event, KeyCode, KeyEvent, KeyEventKind, KeyModifiers};
use crossterm::style::{Color, Print, ResetColor, SetForegroundColor};
use crossterm::terminal::{
    BeginSynchronizedUpdate, Clear, ClearType, EndSynchronizedUpdate, EnterAlternateScreen,
    LeaveAlternateScreen, disable_raw_mode, enable_raw_mode, size,
};
use crossterm::{cursor, execute, queue};
use std::io::{Stdout, Write, stdout};
use std::time::{Duration, Instant};
use tiny_physics::{FixedStep, Layer};
use tiny_physics_draw::TextView;

const HELP: &str = "space step  p play  s slow  r restart  n next seed  q quit";
/// Time between looks at the keyboard while playing.
const TICK: Duration = Duration::from_millis(15);

/// Plays until the user quits.
///
/// # Errors
/// The terminal's, or the scene cannot be opened.
pub fn run(args: &DemoArgs) -> Outcome {
    let mut player = Player::new(args)?;
    let mut screen = Screen::enter()?;
    let mut last = Instant::now();
    while player.state != State::Quit {
        screen.draw(&player)?;
        let playing = player.state == State::Playing;
        let waiting = if playing { TICK } else { Duration::from_secs(1) };
        if event::poll(waiting)?
            && let Event::Key(key) = event::read()?
        {
            player.key(key)?;
        }
        // The time of a pause is not caught up with.
        player.play(if playing { last.elapsed().as_secs_f32() } else { 0.0 });
        last = Instant::now();
    }
    Ok(())
}

/// The demo's scene with a seed.
///
/// # Errors
/// No such scene, or the engine refuses it.
pub(super) fn open(args: &DemoArgs, seed: u64) -> Outcome<Simulation> {
    let how = WorldArgs { seed, threads: 1, simd: None };
    Simulation::new(source::open(&args.scene, seed)?, &how)
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum State {
    Playing,
    Paused,
    Quit,
}

/// The demo and what the user wants of it.
struct Player {
    args: DemoArgs,
    seed: u64,
    simulation: Simulation,
    framing: Framing,
    clock: FixedStep,
    state: State,
    slow: bool,
}

impl Player {
    fn new(args: &DemoArgs) -> Outcome<Self> {
        let simulation = open(args, args.seed)?;
        Ok(Self {
            args: args.clone(),
            seed: args.seed,
            framing: simulation.framing(),
            clock: FixedStep::new(simulation.dt()),
            simulation,
            state: State::Playing,
            slow: false,
        })
    }

    fn key(&mut self, key: KeyEvent) -> Outcome {
        if key.kind == KeyEventKind::Release {
            return Ok(());
        }
        let control = key.modifiers.contains(KeyModifiers::CONTROL);
        match key.code {
            KeyCode::Char('c' | 'd') if control => self.state = State::Quit,
            KeyCode::Char('q') | KeyCode::Esc => self.state = State::Quit,
            KeyCode::Char('p') => {
                let playing = self.state == State::Playing;
                self.state = if playing { State::Paused } else { State::Playing };
            }
            KeyCode::Char('s') => self.slow = !self.slow,
            KeyCode::Char('r') => self.simulation.restart()?,
            KeyCode::Char('n') => {
                self.seed = self.seed.wrapping_add(1);
                self.simulation = open(&self.args, self.seed)?;
                self.framing = self.simulation.framing();
            }
            KeyCode::Char(' ') | KeyCode::Enter | KeyCode::Right => {
                self.state = State::Paused;
                self.simulation.step();
            }
            _ => {}
        }
        Ok(())
    }

    fn play(&mut self, elapsed: f32) {
        if self.state != State::Playing {
            return;
        }
        let elapsed = if self.slow { 0.2 * elapsed } else { elapsed };
        let steps = self.clock.advance(elapsed);
        self.simulation.play(steps);
    }

    fn title(&self) -> String {
        let state = match self.state {
            State::Playing if self.slow => "playing slowly",
            State::Playing => "playing",
            State::Paused | State::Quit => "paused",
        };
        format!("{} seed {}   {state}", self.args.scene, self.seed)
    }
}

/// The terminal, given back as it was when dropped.
struct Screen(Stdout);

impl Screen {
    fn enter() -> Outcome<Self> {
        let mut out = stdout();
        enable_raw_mode()?;
        execute!(out, EnterAlternateScreen, cursor::Hide)?;
        Ok(Self(out))
    }

    fn draw(&mut self, player: &Player) -> Outcome {
        let (columns, rows) = size()?;
        let mut view = TextView::new(usize::from(columns), usize::from(rows.saturating_sub(2)));
        text_frame::draw(&mut view, &player.simulation, &player.framing);
        let out = &mut self.0;
        queue!(out, BeginSynchronizedUpdate)?;
        for (row, cells) in view.cells().enumerate() {
            queue!(out, cursor::MoveTo(0, row as u16))?;
            draw_row(out, cells)?;
        }
        let status = format!("{}   {}", player.simulation.status(), player.title());
        for (row, line) in [(2, status.as_str()), (1, HELP)] {
            let line: String = line.chars().take(usize::from(columns)).collect();
            let color = if row == 2 { Color::White } else { Color::DarkGrey };
            queue!(out, cursor::MoveTo(0, rows.saturating_sub(row)), SetForegroundColor(color))?;
            queue!(out, Print(line), Clear(ClearType::UntilNewLine))?;
        }
        queue!(out, ResetColor, EndSynchronizedUpdate)?;
        Ok(out.flush()?)
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        // Nothing is left to be done where the terminal itself fails.
        let _ = execute!(self.0, cursor::Show, LeaveAlternateScreen);
        let _ = disable_raw_mode();
    }
}

/// One row, a colour change only where the layer changes.
fn draw_row(out: &mut Stdout, cells: &[(char, Layer)]) -> Outcome {
    for part in cells.chunk_by(|a, b| a.1 == b.1) {
        let text: String = part.iter().map(|(letter, _)| letter).collect();
        queue!(out, SetForegroundColor(color(part[0].1)), Print(text))?;
    }
    Ok(queue!(out, Clear(ClearType::UntilNewLine))?)
}

fn color(layer: Layer) -> Color {
    match layer {
        Layer::Static => Color::Grey,
        Layer::Kinematic => Color::Magenta,
        Layer::Asleep => Color::DarkBlue,
        _ => Color::Cyan,
    }
}
