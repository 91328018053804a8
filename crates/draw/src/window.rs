//! A window that shows a canvas and reads keys and mouse.

use crate::canvas::Canvas;
use crate::error::DrawError;
use std::cell::RefCell;
use std::rc::Rc;
use tiny_physics::Vec2;

/// A key of the keyboard.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Key {
    /// A letter or digit, lower case.
    Char(char),
    /// The space bar.
    Space,
    /// Enter.
    Enter,
    /// Escape.
    Escape,
    /// Arrow to the left.
    Left,
    /// Arrow to the right.
    Right,
    /// Arrow up.
    Up,
    /// Arrow down.
    Down,
}

/// What the user did since the last frame.
#[derive(Clone, Debug, Default)]
pub struct Input {
    /// Keys that went down.
    pub pressed: Vec<Key>,
    /// Keys that went down, and those held that repeat.
    pub repeated: Vec<Key>,
    /// Mouse, in pixels of the window; `None` outside of it.
    pub mouse: Option<Vec2>,
    /// Is the left button down?
    pub left_down: bool,
    /// Is the right button down?
    pub right_down: bool,
    /// Turns of the wheel, away from the user positive.
    pub wheel: f32,
}

/// A window on the screen.
pub struct Window {
    window: minifb::Window,
    buffer: Vec<u32>,
    typed: Rc<RefCell<Typed>>,
    /// Keys that went down in the frame before: their held state arrives a frame late.
    before: Vec<Key>,
}

/// Key events as they come. A tap can be over before the next frame, so states are not enough.
#[derive(Default)]
struct Typed {
    down: Vec<minifb::Key>,
    pressed: Vec<Key>,
}

struct Listener(Rc<RefCell<Typed>>);

impl minifb::InputCallback for Listener {
    fn add_char(&mut self, _: u32) {}

    fn set_key_state(&mut self, code: minifb::Key, is_down: bool) {
        let Ok(mut typed) = self.0.try_borrow_mut() else { return };
        let was_down = typed.down.contains(&code);
        if is_down && !was_down {
            typed.down.push(code);
            typed.pressed.extend(key(code));
        } else if !is_down {
            typed.down.retain(|other| *other != code);
        }
    }
}

impl Window {
    /// Opens a window of a size in pixels that the user can change, updated at most 60 times a second.
    ///
    /// # Errors
    /// No display, or the window system refuses.
    pub fn open(title: &str, width: u32, height: u32) -> Result<Self, DrawError> {
        let options = minifb::WindowOptions {
            resize: true,
            scale_mode: minifb::ScaleMode::AspectRatioStretch,
            ..minifb::WindowOptions::default()
        };
        let mut window = minifb::Window::new(title, width as usize, height as usize, options)
            .map_err(|error| DrawError::Window(explain(&error)))?;
        window.set_target_fps(60);
        let typed = Rc::new(RefCell::new(Typed::default()));
        window.set_input_callback(Box::new(Listener(Rc::clone(&typed))));
        Ok(Self { window, buffer: Vec::new(), typed, before: Vec::new() })
    }

    /// False after the user has closed it.
    pub fn is_open(&self) -> bool {
        self.window.is_open()
    }

    /// Sets the title.
    pub fn set_title(&mut self, title: &str) {
        self.window.set_title(title);
    }

    /// Width and height in pixels, at least 16.
    pub fn size(&self) -> (u32, u32) {
        let (width, height) = self.window.get_size();
        (width.clamp(16, 16384) as u32, height.clamp(16, 16384) as u32)
    }

    /// Shows the picture and waits for the next frame.
    ///
    /// # Errors
    /// The window system's, in words.
    pub fn show(&mut self, canvas: &Canvas) -> Result<(), DrawError> {
        canvas.copy_to_window(&mut self.buffer);
        let (width, height) = (canvas.width() as usize, canvas.height() as usize);
        self.window
            .update_with_buffer(&self.buffer, width, height)
            .map_err(|error| DrawError::Window(error.to_string()))
    }

    /// What the user did since the last call.
    pub fn input(&mut self) -> Input {
        use minifb::{KeyRepeat, MouseButton, MouseMode};
        let pressed = core::mem::take(&mut self.typed.borrow_mut().pressed);
        let held = self.window.get_keys_pressed(KeyRepeat::Yes).into_iter().filter_map(key);
        let again = held.filter(|key| !pressed.contains(key) && !self.before.contains(key));
        let repeated = pressed.iter().copied().chain(again).collect();
        self.before.clone_from(&pressed);
        Input {
            pressed,
            repeated,
            mouse: self.window.get_mouse_pos(MouseMode::Discard).map(|(x, y)| Vec2::new(x, y)),
            left_down: self.window.get_mouse_down(MouseButton::Left),
            right_down: self.window.get_mouse_down(MouseButton::Right),
            wheel: self.window.get_scroll_wheel().map_or(0.0, |(_, y)| y),
        }
    }
}

/// The window library's error, with the usual reason.
fn explain(error: &minifb::Error) -> String {
    let set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    if cfg!(unix) && !cfg!(target_os = "macos") && !set("DISPLAY") && !set("WAYLAND_DISPLAY") {
        "this session has no display (neither DISPLAY nor WAYLAND_DISPLAY is set)".into()
    } else {
        error.to_string()
    }
}

fn key(key: minifb::Key) -> Option<Key> {
    use minifb::Key as K;
    Some(match key {
        K::Space => Key::Space,
        K::Enter => Key::Enter,
        K::Escape => Key::Escape,
        K::Left => Key::Left,
        K::Right => Key::Right,
        K::Up => Key::Up,
        K::Down => Key::Down,
        other => {
            // Letters and digits are called "A" and "Key1".
            let name = format!("{other:?}");
            let mut letters = name.strip_prefix("Key").unwrap_or(&name).chars();
            match (letters.next(), letters.next()) {
                (Some(letter), None) => Key::Char(letter.to_ascii_lowercase()),
                _ => return None,
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tap_within_a_frame_is_not_lost() {
        use minifb::InputCallback as _;
        let typed = Rc::new(RefCell::new(Typed::default()));
        let mut listener = Listener(Rc::clone(&typed));
        for is_down in [true, true, false] {
            listener.set_key_state(minifb::Key::N, is_down);
        }
        assert_eq!(typed.borrow().pressed, [Key::Char('n')]);
        assert!(typed.borrow().down.is_empty());
    }

    #[test]
    fn keys_have_their_letters() {
        assert_eq!(key(minifb::Key::A), Some(Key::Char('a')));
        assert_eq!(key(minifb::Key::Key7), Some(Key::Char('7')));
        assert_eq!(key(minifb::Key::Space), Some(Key::Space));
        assert_eq!(key(minifb::Key::F5), None);
    }
}
