//! Bytes as a value in files of any format (feature `serde`). In formats for people they are text in base64 (RFC 4648,
//! section 4), because lists of numbers take three times the room.

use crate::error::Error;
use base64::Engine;
use base64::engine::general_purpose::STANDARD as BASE64;
use core::fmt;
use core::marker::PhantomData;
use serde::de::{Error as _, SeqAccess, Visitor};
use serde::{Deserializer, Serializer};

/// Writes bytes.
pub(crate) fn serialize<S: Serializer>(bytes: &[u8], serializer: S) -> Result<S::Ok, S::Error> {
    if serializer.is_human_readable() {
        serializer.serialize_str(&BASE64.encode(bytes))
    } else {
        serializer.serialize_bytes(bytes)
    }
}

/// Reads bytes and makes something of them; `what` says what, for messages.
pub(crate) fn deserialize<'de, D: Deserializer<'de>, T>(
    deserializer: D,
    what: &'static str,
    make: fn(&[u8]) -> Result<T, Error>,
) -> Result<T, D::Error> {
    let reader = Bytes { what, make, made: PhantomData };
    if deserializer.is_human_readable() {
        deserializer.deserialize_str(reader)
    } else {
        deserializer.deserialize_byte_buf(reader)
    }
}

/// Takes text, bytes, or a list of numbers: formats differ in what they make of bytes.
struct Bytes<T> {
    what: &'static str,
    make: fn(&[u8]) -> Result<T, Error>,
    made: PhantomData<T>,
}

impl<'de, T> Visitor<'de> for Bytes<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} as bytes, or as text in base64", self.what)
    }

    fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<T, E> {
        let bytes = BASE64.decode(text);
        let bytes =
            bytes.map_err(|why| E::custom(format!("{} is not base64: {why}", self.what)))?;
        self.visit_bytes(&bytes)
    }

    fn visit_bytes<E: serde::de::Error>(self, bytes: &[u8]) -> Result<T, E> {
        (self.make)(bytes).map_err(E::custom)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<T, A::Error> {
        let mut bytes = Vec::new();
        while let Some(byte) = list.next_element()? {
            bytes.push(byte);
        }
        (self.make)(&bytes).map_err(A::Error::custom)
    }
}
