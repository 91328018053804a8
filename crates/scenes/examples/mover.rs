//! The character's level in the terminal: `cargo run -p tiny-physics-scenes --example mover` shows the
//! scripted run, with `-- play` it reads keys from lines: `d` right, `a` left, `w` jump, `s` through a
//! one-way platform, `q` quit; each letter is a fifth of a second.

use std::io::BufRead;
use tiny_physics::{BodyKind, CharacterMover, MoverInput, QueryFilter, Vec2};
use tiny_physics_scenes::{Character, Options, Run, Script, find};

const DT: f32 = 1.0 / 60.0;

/// The scene of this name, its character in our hands.
struct Level {
    run: Run,
    script: Character,
    hero: CharacterMover,
    step: u32,
}

impl Level {
    fn new() -> Result<Self, Box<dyn std::error::Error>> {
        let mut scene = find("character")?.build(Options::default());
        let Some(Script::Character(script)) = scene.script.take() else {
            return Err("the scene has no character".into());
        };
        let (run, hero) = (Run::start(&scene)?, script.mover());
        Ok(Self { run, script, hero, step: 0 })
    }

    fn time(&self) -> f64 {
        f64::from(self.step) * f64::from(DT)
    }

    fn step(&mut self, input: MoverInput) {
        let (time, bodies) = (self.time(), self.run.bodies().to_vec());
        self.script.move_platforms(self.run.host_mut(), &bodies, time, DT);
        self.run.world_mut().step(DT);
        self.hero.update(self.run.world_mut(), input, DT);
        self.step += 1;
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut level = Level::new()?;
    if std::env::args().any(|argument| argument == "play") {
        return play(&mut level);
    }
    while level.time() < 37.5 {
        level.step(level.script.input(level.time(), DT));
        if level.step.is_multiple_of(120) {
            print(&level);
        }
    }
    let world = level.run.world();
    for body in world.body_ids().filter_map(|id| world.body(id)) {
        if body.kind() == BodyKind::Dynamic {
            println!("the crate was pushed to x = {:.2}", body.position().x);
        }
    }
    Ok(())
}

fn play(level: &mut Level) -> Result<(), Box<dyn std::error::Error>> {
    print(level);
    for line in std::io::stdin().lock().lines() {
        for key in line?.chars() {
            let mut input = match key {
                'd' => MoverInput { walk: 4.0, ..MoverInput::default() },
                'a' => MoverInput { walk: -4.0, ..MoverInput::default() },
                'w' => MoverInput { jump: 8.0, ..MoverInput::default() },
                's' => MoverInput { drop: true, ..MoverInput::default() },
                'q' => return Ok(()),
                _ => MoverInput::default(),
            };
            for _ in 0..12 {
                level.step(input);
                input.jump = 0.0;
            }
        }
        print(level);
    }
    Ok(())
}

/// The world around the hero, four letters a metre across and two up.
fn print(level: &Level) {
    let (hero, world) = (&level.hero, level.run.world());
    let filter = QueryFilter::from(hero.filter);
    let center = hero.position.to_vec2();
    let place = if hero.ground().is_some() { "on the ground" } else { "in the air" };
    println!("{:5.1} s  at ({:.2}, {:.2}), {place}", level.time(), center.x, center.y);
    for row in (0..14).rev() {
        let line: String = (-36..36)
            .map(|column| {
                let at = Vec2::new(center.x + column as f32 * 0.25, row as f32 * 0.5 + 0.25);
                let away = at - center;
                if away.x.abs() <= hero.radius && away.y.abs() <= 0.5 * hero.height {
                    '@'
                } else if world.overlap_point(at, &filter).is_empty() {
                    ' '
                } else {
                    '#'
                }
            })
            .collect();
        println!("  {line}");
    }
}
