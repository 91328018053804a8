//! A character walks through a level: `cargo run -p tiny-physics --example mover` shows the scripted run as text,
//! `cargo run -p tiny-physics --example mover -- play` reads keys from lines: `d` right, `a` left, `w` jump, `s` through a
//! one-way platform, `q` quit; each letter is a fifth of a second.

mod level;

use level::{END, Level};
use std::io::BufRead;
use tiny_physics::{MoverInput, QueryFilter, Vec2};

const DT: f32 = 1.0 / 60.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut level = Level::new()?;
    if std::env::args().any(|argument| argument == "play") {
        return play(&mut level);
    }
    while level.time < END {
        let input = level.scripted_input(DT);
        level.step(input, DT);
        if ((level.time * 60.0).round() as u32).is_multiple_of(120) {
            print(&level);
        }
    }
    if let Some(body) = level.world.body(level.crate_) {
        println!("the crate was pushed to x = {:.2}", body.position().x);
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
                level.step(input, DT);
                input.jump = 0.0;
            }
        }
        print(level);
    }
    Ok(())
}

/// The world around the hero, four letters a metre across and two up.
fn print(level: &Level) {
    let hero = &level.hero;
    let center = hero.position.to_vec2();
    let place = if hero.ground().is_some() { "on the ground" } else { "in the air" };
    println!("{:5.1} s  at ({:.2}, {:.2}), {place}", level.time, center.x, center.y);
    for row in (0..14).rev() {
        let line: String = (-36..36)
            .map(|column| {
                let at = Vec2::new(center.x + column as f32 * 0.25, row as f32 * 0.5 + 0.25);
                let away = at - center;
                if away.x.abs() <= hero.radius && away.y.abs() <= 0.5 * hero.height {
                    '@'
                } else if level.world.overlap_point(at, &QueryFilter::new()).is_empty() {
                    ' '
                } else {
                    '#'
                }
            })
            .collect();
        println!("  {line}");
    }
}
