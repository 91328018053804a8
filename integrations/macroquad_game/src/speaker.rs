//! Plays sounds, made at the start.

use macroquad::audio::{PlaySoundParams, Sound, load_sound_from_bytes, play_sound};
use macroquad_game::sounds::{self, NAMES};

/// A sound of each kind.
pub struct Speaker(Vec<Sound>);

impl Speaker {
    /// Makes the sounds.
    pub async fn new() -> Self {
        let mut made = Vec::new();
        for which in 0..NAMES.len() {
            match load_sound_from_bytes(&sounds::wave(which)).await {
                Ok(sound) => made.push(sound),
                Err(error) => eprintln!("no sound \"{}\": {error:?}", NAMES[which]),
            }
        }
        Self(made)
    }

    /// Plays what is heard, each kind once, as loud as the loudest.
    pub fn play(&self, heard: &[sounds::Sound]) {
        for (which, sound) in self.0.iter().enumerate() {
            let volume = heard
                .iter()
                .filter(|heard| heard.which == which)
                .map(|heard| heard.volume)
                .fold(0.0, f32::max);
            if volume > 0.02 {
                play_sound(sound, PlaySoundParams { looped: false, volume });
            }
        }
    }
}
