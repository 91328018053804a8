//! What is kept between calls: sessions, and the buffers that arguments and answers go through.

use crate::outcome::{Outcome, words};
use crate::session::Session;
use serde::de::DeserializeOwned;
use tiny_physics_scenes::Problem;

/// Sessions and buffers.
#[derive(Default)]
pub struct Shelf {
    sessions: Vec<Option<Box<Session>>>,
    pub(crate) input: Vec<u8>,
    pub(crate) text: Vec<u8>,
    pub(crate) numbers: Vec<f64>,
}

impl Shelf {
    /// Puts a session in and gives its number, which is not 0; 0 where there is none, with the reason as text.
    pub(crate) fn put(&mut self, session: Outcome<Session>) -> u32 {
        match session {
            Err(reason) => {
                self.say(reason);
                0
            }
            Ok(session) => {
                let free = self.sessions.iter().position(Option::is_none);
                let place = free.unwrap_or(self.sessions.len());
                if place == self.sessions.len() {
                    self.sessions.push(None);
                }
                self.sessions[place] = Some(Box::new(session));
                place as u32 + 1
            }
        }
    }

    /// Drops a session.
    pub(crate) fn free(&mut self, session: u32) {
        if let Some(place) = self.sessions.get_mut(session.wrapping_sub(1) as usize) {
            *place = None;
        }
    }

    /// Does something with a session, which is off the shelf meanwhile.
    pub(crate) fn with(
        &mut self,
        session: u32,
        work: impl FnOnce(&mut Session, &mut Self) -> Outcome,
    ) -> bool {
        let place = session.wrapping_sub(1) as usize;
        let Some(mut taken) = self.sessions.get_mut(place).and_then(Option::take) else {
            self.say("this world has been freed");
            return false;
        };
        let done = work(&mut taken, self);
        self.sessions[place] = Some(taken);
        match done {
            Ok(()) => true,
            Err(reason) => {
                self.say(reason);
                false
            }
        }
    }

    /// A text as the answer.
    pub(crate) fn say(&mut self, text: impl Into<Vec<u8>>) {
        self.text = text.into();
    }

    /// Numbers as the answer.
    pub(crate) fn count(&mut self, numbers: impl IntoIterator<Item = f64>) {
        self.numbers.clear();
        self.numbers.extend(numbers);
    }

    /// The input as text.
    pub(crate) fn input_text(&self) -> Outcome<&str> {
        core::str::from_utf8(&self.input).map_err(words)
    }

    /// What the input describes; an error names the field.
    pub(crate) fn read<T: DeserializeOwned>(&self) -> Outcome<T> {
        tiny_physics_scenes::read(self.input_text()?).map_err(|error| {
            // Where in the text means nothing to one who gave an object.
            let Problem::Format(message) = error.problem() else { return error.to_string() };
            match error.field() {
                "" => message.clone(),
                field => format!("{field}: {message}"),
            }
        })
    }
}
