//! The game on a screen: a clock, keys, pictures, sounds.

mod draw;
#[cfg(feature = "sound")]
mod speaker;

use macroquad::prelude::*;
use macroquad_game::game::{Game, Input};
use macroquad_game::pieces::DT;
use tiny_physics::FixedStep;

fn window() -> Conf {
    Conf {
        window_title: "Fuse".into(),
        window_width: 960,
        window_height: 540,
        sample_count: 4,
        ..Conf::default()
    }
}

#[macroquad::main(window)]
async fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if let [_, flag, file, place] = &arguments[..]
        && flag == "--picture"
    {
        return picture(file, place.parse().unwrap_or(3.0)).await;
    }
    #[cfg(feature = "sound")]
    let speaker = speaker::Speaker::new().await;
    let (mut game, mut clock) = (new(), FixedStep::new(DT));
    // Keys that went down in a frame without a step count in the next step.
    let mut asked = Input::default();
    loop {
        if is_key_pressed(KeyCode::Escape) {
            return;
        }
        files(&mut game);
        ask(&mut asked);
        for _ in 0..clock.advance(get_frame_time()) {
            let _heard = game.step(asked);
            #[cfg(feature = "sound")]
            speaker.play(&_heard);
            asked = Input { walk: asked.walk, ..Input::default() };
        }
        draw::frame(&game, clock.alpha());
        next_frame().await;
    }
}

fn new() -> Game {
    Game::new().unwrap_or_else(|error| panic!("the level: {error}"))
}

fn ask(asked: &mut Input) {
    let down = |keys: &[KeyCode]| keys.iter().any(|key| is_key_down(*key));
    let pressed = |keys: &[KeyCode]| keys.iter().any(|key| is_key_pressed(*key));
    asked.walk = f32::from(down(&[KeyCode::Right, KeyCode::D]))
        - f32::from(down(&[KeyCode::Left, KeyCode::A]));
    asked.jump |= pressed(&[KeyCode::Space, KeyCode::Up, KeyCode::W]);
    asked.drop |= pressed(&[KeyCode::Down, KeyCode::S]);
    asked.light |= pressed(&[KeyCode::X, KeyCode::E]);
}

const FILE: &str = "save.json";

/// R begins anew, F5 saves, F9 loads.
fn files(game: &mut Game) {
    if is_key_pressed(KeyCode::R) {
        *game = new();
    }
    if is_key_pressed(KeyCode::F5) {
        let saved = game.save().map_err(|error| error.to_string());
        tell(saved.and_then(|text| std::fs::write(FILE, text).map_err(|error| error.to_string())));
    }
    if is_key_pressed(KeyCode::F9) {
        let text = std::fs::read_to_string(FILE).map_err(|error| error.to_string());
        tell(
            text.and_then(|text| Game::load(&text).map_err(|error| error.to_string()))
                .map(|loaded| *game = loaded),
        );
    }
}

fn tell(result: Result<(), String>) {
    if let Err(error) = result {
        eprintln!("{FILE}: {error}");
    }
}

/// Writes what is seen when the hero is at a place; beside the barrel, when it blows up.
async fn picture(file: &str, place: f64) {
    let mut game = new();
    game.hero.position.x = place;
    game.hero.position.y = 3.0;
    let blast = (27.0..33.0).contains(&place);
    for step in 0..170 {
        if blast && step == 60 {
            game.barrels.iter_mut().for_each(|barrel| barrel.light());
        }
        game.step(Input {
            walk: if blast { 0.0 } else { 0.6 },
            jump: step == 150,
            ..Input::default()
        });
    }
    // A frame to make the window, one to read.
    for _ in 0..2 {
        draw::frame(&game, 1.0);
        next_frame().await;
    }
    draw::frame(&game, 1.0);
    get_screen_data().export_png(file);
}
