//! Somebody plays it to the end, without a window.

use macroquad_game::game::{Game, Input};
use macroquad_game::pieces::DT;
use macroquad_game::sounds::Sound;

/// Until when to do what.
type Act = (&'static str, fn(&Game) -> bool, fn(&Game) -> Input);

fn x(game: &Game) -> f64 {
    game.hero.position.x
}

fn y(game: &Game) -> f64 {
    game.hero.position.y
}

fn towards(game: &Game, place: f64) -> Input {
    let way = place - x(game);
    Input { walk: (way.signum() as f32) * f32::from(way.abs() > 0.15), ..Input::default() }
}

fn hop(game: &Game, place: f64) -> Input {
    Input { jump: true, ..towards(game, place) }
}

/// Stands on the lift when it is below.
fn lift_is_down(game: &Game) -> bool {
    game.world.body(game.lifts[0].body).unwrap().position().y < 1.95
}

const SCRIPT: [Act; 12] = [
    ("the coin on the platform", |g| g.coins.len() == 3, |g| hop(g, 8.5)),
    ("the coin on the hill", |g| g.coins.len() == 2, |g| hop(g, 14.5)),
    ("down the hill to the lift", |g| x(g) > 18.8 && lift_is_down(g), |g| towards(g, 19.0)),
    ("on the lift", |g| x(g) > 20.8, |g| towards(g, 21.0)),
    ("up", |g| y(g) > 8.4, |g| towards(g, 21.0)),
    ("the coin on the plateau", |g| g.coins.len() == 1, |g| towards(g, 26.5)),
    (
        "over the crate and down to the barrel",
        |g| x(g) > 31.2 && y(g) < 3.5,
        |g| if y(g) > 7.5 { hop(g, 31.5) } else { towards(g, 31.5) },
    ),
    ("light it", |g| g.barrels[0].burns(), |g| Input { light: true, ..towards(g, 33.4) }),
    ("get away", |g| g.barrels.is_empty(), |g| towards(g, 30.4)),
    ("the coin in the tunnel", |g| g.coins.is_empty(), |g| hop(g, 39.5)),
    ("the door", |g| x(g) > 44.0, |g| hop(g, 45.0)),
    ("the flag", |g| g.won, |g| towards(g, 46.5)),
];

/// Plays the script from where the game is; gives the inputs and all that was heard.
fn play(game: &mut Game, script: &[Act]) -> (Vec<Input>, Vec<Sound>) {
    let (mut inputs, mut heard) = (Vec::new(), Vec::new());
    for (name, done, act) in script {
        let start = game.steps;
        while !done(game) {
            let input = act(game);
            inputs.push(input);
            heard.extend(game.step(input));
            let place = game.hero.position;
            assert!(
                game.steps - start < 1800,
                "stuck for 30 s before: {name}, at {place:?}, {} coins",
                game.coins.len()
            );
            assert!(
                (0.0..50.0).contains(&place.x) && (0.0..14.0).contains(&place.y),
                "{name}: out of the level at {place:?}"
            );
        }
    }
    (inputs, heard)
}

#[test]
fn the_level_can_be_completed() {
    let mut game = Game::new().unwrap();
    let (_, heard) = play(&mut game, &SCRIPT);
    assert!(game.won && game.coins_in_all == 4);
    assert!(game.steps as f32 * DT < 90.0, "{} s", game.steps as f32 * DT);
    assert_eq!(heard.iter().filter(|sound| **sound == Sound::COIN).count(), 4);
    assert!(
        heard.contains(&Sound::BLAST)
            && heard.contains(&Sound::FUSE)
            && heard.contains(&Sound::JUMP)
    );
    let thuds: Vec<f32> =
        heard.iter().filter(|sound| sound.which >= 4).map(|sound| sound.volume).collect();
    assert!(
        thuds.len() > 5
            && thuds.iter().any(|loud| *loud > 0.5)
            && thuds.iter().any(|loud| *loud < 0.3),
        "{thuds:?}"
    );
}

#[test]
fn the_door_is_shut_until_all_coins_are_found_and_bricks_bar_the_way() {
    let mut game = Game::new().unwrap();
    game.hero.position.x = 40.5;
    game.hero.position.y = 3.0;
    (0..300).for_each(|_| drop(game.step(Input { walk: 1.0, ..Input::default() })));
    assert!(x(&game) < 42.0 && !game.won, "at {}", x(&game));
    let mut game = Game::new().unwrap();
    game.hero.position.x = 35.0;
    game.hero.position.y = 3.0;
    (0..300).for_each(|_| drop(game.step(Input { walk: 1.0, jump: true, ..Input::default() })));
    assert!(x(&game) < 37.0, "at {}", x(&game));
}

#[test]
fn a_saved_game_goes_on_as_it_would_have() {
    let mut game = Game::new().unwrap();
    play(&mut game, &SCRIPT[..8]);
    let mut loaded = Game::load(&game.save().unwrap()).unwrap();
    let (inputs, heard) = play(&mut game, &SCRIPT[8..]);
    let mut again = Vec::new();
    inputs.into_iter().for_each(|input| again.extend(loaded.step(input)));
    assert_eq!((loaded.won, loaded.steps), (true, game.steps));
    assert_eq!(loaded.world.state_hash(), game.world.state_hash());
    assert_eq!(again, heard);
    assert!(Game::load("{}").is_err());
}

#[test]
fn sounds_are_files() {
    for which in 0..macroquad_game::sounds::NAMES.len() {
        let wave = macroquad_game::sounds::wave(which);
        assert!(wave.len() > 1000 && &wave[..4] == b"RIFF");
        let samples =
            wave[44..].chunks(2).map(|pair| i16::from_le_bytes([pair[0], pair[1]]).unsigned_abs());
        assert!(samples.max().unwrap() > 2000, "sound {which} is heard");
    }
}
