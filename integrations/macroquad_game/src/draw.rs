//! What is seen: the world in metres, then words over it.

use macroquad::prelude::*;
use macroquad_game::barrel::{BARREL, FLASH, FUSE};
use macroquad_game::game::{Game, HERO};
use macroquad_game::level::ROWS;
use macroquad_game::moving::{DOOR, LIFT};
use tiny_physics::{BodyId, Shape};

/// Height of what is seen, metres.
const VIEW: f32 = 11.0;

const SKY: Color = color_u8!(126, 182, 214, 255);
const FAR: Color = color_u8!(104, 152, 178, 255);
const NEAR: Color = color_u8!(86, 133, 142, 255);
const EARTH: Color = color_u8!(98, 76, 66, 255);
const EARTH_DARK: Color = color_u8!(92, 71, 62, 255);
const GRASS: Color = color_u8!(126, 168, 92, 255);
const WOOD: Color = color_u8!(190, 136, 82, 255);
const WOOD_DARK: Color = color_u8!(128, 86, 52, 255);
const STONE: Color = color_u8!(160, 152, 156, 255);
const IRON: Color = color_u8!(76, 84, 104, 255);
const RED: Color = color_u8!(208, 76, 62, 255);
const GOLD: Color = color_u8!(246, 200, 80, 255);
const GOLD_DARK: Color = color_u8!(196, 142, 42, 255);
const INK: Color = color_u8!(42, 40, 56, 255);

/// Draws a frame, between the last two steps.
pub fn frame(game: &Game, alpha: f32) {
    let eye = eye(game, alpha);
    hills(eye);
    let aspect = screen_width() / screen_height();
    set_camera(&Camera2D {
        target: eye,
        zoom: vec2(2.0 / (VIEW * aspect), -2.0 / VIEW),
        ..Camera2D::default()
    });
    for door in &game.doors {
        slab(game, door.body, alpha);
    }
    ground();
    things(game, alpha);
    hero(game, alpha);
    for flash in &game.flashes {
        blast(vec2(flash.center.x as f32, flash.center.y as f32), flash.left as f32 / FLASH as f32);
    }
    set_default_camera();
    words(game);
}

/// Follows the hero, but not out of the level.
fn eye(game: &Game, alpha: f32) -> Vec2 {
    let hero = game.hero.interpolated_position(alpha);
    let half = 0.5 * VIEW * screen_width() / screen_height();
    let (width, height) = (ROWS[0].len() as f32, ROWS.len() as f32);
    let x = (hero.x as f32).clamp(half, width - half);
    vec2(x, (hero.y as f32 + 0.4).clamp(VIEW / 2.0, height - VIEW / 2.0))
}

/// Hills in the distance, which pass slowly.
fn hills(eye: Vec2) {
    clear_background(SKY);
    draw_poly(
        0.3 * screen_width(),
        0.2 * screen_height(),
        64,
        42.0,
        0.0,
        color_u8!(250, 236, 190, 255),
    );
    for (color, height, pace, width) in [(FAR, 0.55, 6.0, 0.004), (NEAR, 0.7, 14.0, 0.007)] {
        for x in 0..=(screen_width() as i32 / 2) {
            let x = x as f32 * 2.0;
            let at = (x + pace * eye.x) * width;
            let top = screen_height() * height - 40.0 * at.sin() - 18.0 * (2.3 * at + 1.0).sin();
            draw_rectangle(x, top, 3.0, screen_height() - top, color);
        }
    }
}

fn letter(x: i32, y: i32) -> char {
    let row = usize::try_from(y).ok().and_then(|y| ROWS.iter().rev().nth(y));
    row.and_then(|row| row.chars().nth(usize::try_from(x).ok()?)).unwrap_or('#')
}

fn ground() {
    let solid = |x, y| letter(x, y) == '#';
    for y in 0..ROWS.len() as i32 {
        for x in 0..ROWS[0].len() as i32 {
            let (left, low) = (x as f32, y as f32);
            let corner = |dx: f32, dy: f32| vec2(left + dx, low + dy);
            match letter(x, y) {
                '#' => {
                    // A hair more than the cell, so that no gaps are seen.
                    draw_rectangle(
                        left - 0.01,
                        low - 0.01,
                        1.02,
                        1.02,
                        if (x + y) % 2 == 0 { EARTH } else { EARTH_DARK },
                    );
                    if !solid(x, y + 1) && !"/\\".contains(letter(x, y + 1)) {
                        draw_rectangle(left - 0.01, low + 0.78, 1.02, 0.22, GRASS);
                    }
                }
                '/' => slope(
                    corner(0.0, 0.0),
                    corner(1.0, 0.0),
                    corner(1.0, 1.0),
                    corner(0.0, 0.0),
                    corner(1.0, 1.0),
                ),
                '\\' => slope(
                    corner(0.0, 0.0),
                    corner(1.0, 0.0),
                    corner(0.0, 1.0),
                    corner(0.0, 1.0),
                    corner(1.0, 0.0),
                ),
                '-' => {
                    draw_rectangle(left, low + 0.82, 1.0, 0.18, WOOD);
                    draw_rectangle(left + 0.42, low + 0.6, 0.16, 0.22, WOOD_DARK);
                }
                _ => {}
            }
        }
    }
}

fn slope(a: Vec2, b: Vec2, c: Vec2, from: Vec2, to: Vec2) {
    draw_triangle(a, b, c, EARTH);
    let down = vec2(0.0, -0.3);
    draw_triangle(from, to, to + down, GRASS);
    draw_triangle(from, from + down, to + down, GRASS);
}

fn things(game: &Game, alpha: f32) {
    for lift in &game.lifts {
        let (at, _) = place(game, lift.body, alpha);
        draw_line(at.x, at.y, at.x, 0.9, 0.08, IRON);
        plank(at, 0.0, vec2(LIFT.0, LIFT.1), IRON, INK);
    }
    let time = game.steps as f32 / 60.0;
    for (number, coin) in game.coins.iter().enumerate() {
        let (at, _) = place(game, *coin, alpha);
        let at = at + vec2(0.0, 0.08 * (3.0 * time + number as f32).sin());
        draw_ellipse(at.x, at.y, 0.06 + 0.24 * (2.5 * time).cos().abs(), 0.3, 0.0, GOLD_DARK);
        draw_ellipse(at.x, at.y, 0.03 + 0.19 * (2.5 * time).cos().abs(), 0.23, 0.0, GOLD);
    }
    for body in &game.crates {
        let (at, angle) = place(game, *body, alpha);
        let half = half_of(game, *body);
        let stone = game.world.body(*body).is_some_and(|body| body.mass() > 20.0);
        let (fill, rim) = if stone { (STONE, IRON) } else { (WOOD, WOOD_DARK) };
        plank(at, angle, half, fill, rim);
        if !stone {
            let across = Vec2::from_angle(angle).rotate(half * 0.8);
            draw_line(
                at.x - across.x,
                at.y - across.y,
                at.x + across.x,
                at.y + across.y,
                0.09,
                WOOD_DARK,
            );
        }
    }
    for barrel in &game.barrels {
        let (at, angle) = place(game, barrel.body, alpha);
        plank(at, angle, vec2(BARREL.0, BARREL.1), RED, INK);
        plank(at, angle, vec2(BARREL.0, 0.07), INK, INK);
        if let Some(left) = barrel.fuse {
            let spark = at + vec2(0.0, BARREL.1 + 0.35 * left as f32 / FUSE as f32);
            draw_line(at.x, at.y + BARREL.1, spark.x, spark.y, 0.05, INK);
            draw_poly(spark.x, spark.y, 5, 0.14 + 0.06 * (40.0 * time).sin(), 300.0 * time, GOLD);
        }
    }
    for flag in &game.flags {
        let (at, _) = place(game, *flag, alpha);
        draw_line(at.x, at.y - 0.5, at.x, at.y + 1.6, 0.08, INK);
        let wave = 0.1 * (4.0 * time).sin();
        draw_triangle(
            at + vec2(0.04, 1.6),
            at + vec2(0.04, 0.9),
            at + vec2(0.95, 1.25 + wave),
            RED,
        );
    }
}

fn slab(game: &Game, body: BodyId, alpha: f32) {
    let (at, angle) = place(game, body, alpha);
    plank(at, angle, vec2(DOOR.0, DOOR.1), WOOD, WOOD_DARK);
    for y in [-0.9, 0.0, 0.9] {
        plank(at + vec2(0.0, y), angle, vec2(DOOR.0, 0.08), IRON, IRON);
    }
}

fn hero(game: &Game, alpha: f32) {
    let at = game.hero.interpolated_position(alpha);
    let (at, (height, radius)) = (vec2(at.x as f32, at.y as f32), HERO);
    let middle = height / 2.0 - radius;
    let body = |radius: f32, color| {
        draw_circle(at.x, at.y + middle, radius, color);
        draw_circle(at.x, at.y - middle, radius, color);
        draw_rectangle(at.x - radius, at.y - middle, 2.0 * radius, 2.0 * middle, color);
    };
    body(radius, INK);
    body(radius - 0.06, color_u8!(74, 132, 190, 255));
    draw_rectangle(at.x - radius, at.y + 0.02, 2.0 * radius, 0.16, RED);
    let tail = at + vec2(-game.facing * radius, 0.1);
    draw_triangle(
        tail + vec2(0.0, 0.08),
        tail - vec2(0.0, 0.08),
        tail + vec2(-game.facing * 0.4, -0.1 - 0.02 * game.hero.velocity.y),
        RED,
    );
    for x in [0.04, 0.2] {
        let eye = at + vec2(game.facing * x, middle + 0.06);
        draw_ellipse(eye.x, eye.y, 0.08, 0.11, 0.0, WHITE);
        draw_circle(eye.x + 0.03 * game.facing, eye.y, 0.05, INK);
    }
}

/// `left` goes from 1 to 0.
fn blast(at: Vec2, left: f32) {
    let gone = 1.0 - left;
    draw_circle(at.x, at.y, 0.6 + 1.8 * gone, Color::new(1.0, 0.75, 0.3, 0.7 * left));
    draw_circle(at.x, at.y, 0.3 + 1.0 * gone, Color::new(1.0, 0.95, 0.75, 0.9 * left));
    draw_circle_lines(at.x, at.y, 0.5 + 5.0 * gone, 0.1, Color::new(1.0, 1.0, 1.0, left));
    for spark in 0..14 {
        let way = Vec2::from_angle(spark as f32 * 2.4)
            * (1.0 + 3.2 * gone * (0.6 + 0.4 * (spark as f32 * 1.7).sin()));
        draw_poly(
            at.x + way.x,
            at.y + way.y,
            4,
            0.16 * left,
            90.0 * gone + 20.0 * spark as f32,
            GOLD,
        );
    }
}

/// A box with a rim.
fn plank(at: Vec2, angle: f32, half: Vec2, fill: Color, rim: Color) {
    let draw = |half: Vec2, color| {
        let rotation = angle;
        let offset = vec2(0.5, 0.5);
        draw_rectangle_ex(
            at.x,
            at.y,
            2.0 * half.x,
            2.0 * half.y,
            DrawRectangleParams { offset, rotation, color },
        );
    };
    draw(half, rim);
    draw((half - vec2(0.06, 0.06)).max(vec2(0.01, 0.01)), fill);
}

fn place(game: &Game, body: BodyId, alpha: f32) -> (Vec2, f32) {
    let pose = game
        .world
        .body(body)
        .map(|body| body.interpolated_pose(alpha))
        .unwrap_or_default()
        .to_transform();
    (vec2(pose.p.x, pose.p.y), pose.q.angle())
}

/// Half extents of a box.
fn half_of(game: &Game, body: BodyId) -> Vec2 {
    let shape = game
        .world
        .body(body)
        .and_then(|body| body.shapes().next())
        .and_then(|shape| game.world.shape(shape));
    match shape.map(|shape| *shape.shape()) {
        Some(Shape::Polygon(polygon)) => {
            polygon.as_rect().map_or(Vec2::ONE, |(half, _)| vec2(half.x, half.y))
        }
        _ => Vec2::ONE,
    }
}

fn words(game: &Game) {
    let found = game.coins_in_all - game.coins.len();
    draw_circle(34.0, 34.0, 14.0, GOLD_DARK);
    draw_circle(34.0, 34.0, 10.0, GOLD);
    write(&format!("{found} / {}", game.coins_in_all), 58.0, 43.0, 32.0);
    let near = game
        .barrels
        .iter()
        .any(|barrel| !barrel.burns() && barrel.is_near(&game.world, game.hero.position));
    let hint = match (game.won, near, game.steps < 400) {
        (true, _, _) => "The flag! R plays again",
        (_, true, _) => "X lights the fuse. Then run!",
        (_, _, true) => "Arrows, Space jumps, F5 saves, F9 loads",
        _ => return,
    };
    let width = measure_text(hint, None, 30, 1.0).width;
    write(hint, (screen_width() - width) / 2.0, 84.0, 30.0);
}

fn write(text: &str, x: f32, y: f32, size: f32) {
    draw_text(text, x + 2.0, y + 2.0, size, INK);
    draw_text(text, x, y, size, WHITE);
}
