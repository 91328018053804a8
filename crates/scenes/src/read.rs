//! Reads values from JSON text through `serde`, with errors that say where and in which field.
//!
//! It works on the tree of [`Node`]: one plain deserializer, whose machine code for each type is a third of that of
//! `serde_json` and `serde_path_to_error` together, by the bytes of the WebAssembly module. Only objects make structs,
//! only arrays make lists.

use crate::error::SceneError;
use crate::fault::Fault;
use crate::json::{Kind, Node, unescaped};
use serde::de::{
    self, DeserializeOwned, DeserializeSeed, Deserializer, EnumAccess, MapAccess, SeqAccess,
    Unexpected, VariantAccess, Visitor,
};
use serde::forward_to_deserialize_any;
use std::borrow::Cow;

/// Reads a value from JSON text.
///
/// # Errors
/// Text that is not JSON, a missing or unknown field, a value of the wrong kind. The error names line, column and field.
pub fn read<T: DeserializeOwned>(text: &str) -> Result<T, SceneError> {
    let read = |text| T::deserialize(Place(&Node::parse(text)?));
    read(text).map_err(|fault: Fault| fault.in_text(text))
}

/// A value to be read.
#[derive(Clone, Copy)]
struct Place<'de, 't>(&'de Node<'t>);

impl<'de, 't> Place<'de, 't> {
    #[cold]
    #[inline(never)]
    fn refuse(self, expected: &dyn de::Expected) -> Fault {
        let text = if let Kind::Plain(text) = &self.0.kind { text } else { "" };
        let string = unescaped(text);
        let found = match &self.0.kind {
            Kind::Array(_) => Unexpected::Seq,
            Kind::Object(_) => Unexpected::Map,
            Kind::Plain("null") => Unexpected::Unit,
            Kind::Plain("true") => Unexpected::Bool(true),
            Kind::Plain("false") => Unexpected::Bool(false),
            Kind::Plain(text) if text.starts_with('"') => Unexpected::Str(&string),
            Kind::Plain(text) => match (text.parse(), text.parse()) {
                (Ok(whole), _) => Unexpected::Unsigned(whole),
                (_, Ok(whole)) => Unexpected::Signed(whole),
                _ => Unexpected::Float(text.parse().unwrap_or_default()),
            },
        };
        <Fault as de::Error>::invalid_type(found, expected).at(self.0.start)
    }

    /// The text of a number.
    fn number(self) -> Option<&'t str> {
        match self.0.kind {
            Kind::Plain(text) if text.starts_with(|c: char| c == '-' || c.is_ascii_digit()) => {
                Some(text)
            }
            _ => None,
        }
    }

    /// What a string says.
    fn string(self) -> Option<Cow<'t, str>> {
        match self.0.kind {
            Kind::Plain(text) if text.starts_with('"') => Some(unescaped(text)),
            _ => None,
        }
    }

    fn items(self) -> Option<Items<'de, 't>> {
        match &self.0.kind {
            Kind::Array(nodes) => Some(Items { nodes, at: 0 }),
            _ => None,
        }
    }

    fn fields(self) -> Option<Fields<'de, 't>> {
        match &self.0.kind {
            Kind::Object(fields) => Some(Fields { fields, at: 0 }),
            _ => None,
        }
    }

    fn visit_items<V: Visitor<'de>>(
        self,
        items: Items<'de, 't>,
        visitor: V,
    ) -> Result<V::Value, Fault> {
        let mut items = items;
        let value = visitor.visit_seq(&mut items)?;
        match items.nodes.get(items.at) {
            None => Ok(value),
            Some(node) => Err(Fault::new("trailing items".to_owned()).at(node.start)),
        }
    }
}

/// Reads a number of a type by its own grammar, which is that of JSON where the text is a number of JSON.
macro_rules! number {
    ($($method:ident $visit:ident $type:ty),*) => {
        $(fn $method<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
            match self.number().and_then(|text| text.parse::<$type>().ok()) {
                Some(value) => visitor.$visit(value),
                None => Err(self.refuse(&visitor)),
            }
        })*
    };
}

macro_rules! float {
    ($($method:ident $visit:ident $type:ty),*) => {
        $(fn $method<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
            match self.number().and_then(|text| text.parse::<$type>().ok()) {
                Some(value) if value.is_finite() => visitor.$visit(value),
                Some(_) => Err(Fault::new("number out of range".to_owned()).at(self.0.start)),
                None => Err(self.refuse(&visitor)),
            }
        })*
    };
}

impl<'de> Deserializer<'de> for Place<'de, '_> {
    type Error = Fault;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match &self.0.kind {
            Kind::Array(_) => self.deserialize_seq(visitor),
            Kind::Object(_) => self.deserialize_map(visitor),
            Kind::Plain("null") => visitor.visit_unit(),
            Kind::Plain("true" | "false") => self.deserialize_bool(visitor),
            Kind::Plain(text) if text.starts_with('"') => self.deserialize_str(visitor),
            Kind::Plain(text) if text.parse::<u64>().is_ok() => self.deserialize_u64(visitor),
            Kind::Plain(text) if text.parse::<i64>().is_ok() => self.deserialize_i64(visitor),
            Kind::Plain(_) => self.deserialize_f64(visitor),
        }
    }

    number! {
        deserialize_u8 visit_u8 u8, deserialize_u16 visit_u16 u16, deserialize_u32 visit_u32 u32,
        deserialize_u64 visit_u64 u64, deserialize_i8 visit_i8 i8, deserialize_i16 visit_i16 i16,
        deserialize_i32 visit_i32 i32, deserialize_i64 visit_i64 i64
    }
    float! { deserialize_f32 visit_f32 f32, deserialize_f64 visit_f64 f64 }

    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match self.0.kind {
            Kind::Plain("true") => visitor.visit_bool(true),
            Kind::Plain("false") => visitor.visit_bool(false),
            _ => Err(self.refuse(&visitor)),
        }
    }

    fn deserialize_str<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match self.string() {
            Some(string) => visitor.visit_str(&string),
            None => Err(self.refuse(&visitor)),
        }
    }

    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.deserialize_str(visitor)
    }

    fn deserialize_identifier<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.deserialize_str(visitor)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match self.0.kind {
            Kind::Plain("null") => visitor.visit_none(),
            _ => visitor.visit_some(self),
        }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value, Fault> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match self.items() {
            Some(items) => self.visit_items(items, visitor),
            None => Err(self.refuse(&visitor)),
        }
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Fault> {
        self.deserialize_seq(visitor)
    }

    fn deserialize_tuple_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: usize,
        visitor: V,
    ) -> Result<V::Value, Fault> {
        self.deserialize_seq(visitor)
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match self.fields() {
            Some(fields) => visitor.visit_map(fields),
            None => Err(self.refuse(&visitor)),
        }
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        self.deserialize_map(visitor)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        let (name, content) = match &self.0.kind {
            Kind::Object(fields) if fields.len() == 1 => {
                (unescaped(fields[0].0), Some(&fields[0].1))
            }
            Kind::Plain(_) => match self.string() {
                Some(name) => (name, None),
                None => return Err(self.refuse(&visitor)),
            },
            _ => return Err(self.refuse(&"a name, or an object with one field")),
        };
        let variant = Variant { name: &name, content };
        visitor.visit_enum(variant)
    }

    fn deserialize_ignored_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_unit()
    }

    forward_to_deserialize_any! { i128 u128 char bytes byte_buf unit unit_struct }
}

struct Items<'de, 't> {
    nodes: &'de [Node<'t>],
    at: usize,
}

impl<'de> SeqAccess<'de> for &mut Items<'de, '_> {
    type Error = Fault;

    fn next_element_seed<S: DeserializeSeed<'de>>(
        &mut self,
        seed: S,
    ) -> Result<Option<S::Value>, Fault> {
        let Some(node) = self.nodes.get(self.at) else { return Ok(None) };
        self.at += 1;
        let read = seed.deserialize(Place(node));
        read.map(Some).map_err(|fault| fault.at(node.start).in_item(self.at - 1))
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.nodes.len() - self.at)
    }
}

struct Fields<'de, 't> {
    fields: &'de [(&'t str, Node<'t>)],
    at: usize,
}

impl<'de> MapAccess<'de> for Fields<'de, '_> {
    type Error = Fault;

    fn next_key_seed<S: DeserializeSeed<'de>>(
        &mut self,
        seed: S,
    ) -> Result<Option<S::Value>, Fault> {
        let Some((name, node)) = self.fields.get(self.at) else { return Ok(None) };
        let name = unescaped(name);
        let key = seed.deserialize(Name(&name));
        key.map(Some).map_err(|fault| fault.at(node.start).in_field(&name))
    }

    fn next_value_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<S::Value, Fault> {
        let (name, node) = &self.fields[self.at];
        self.at += 1;
        seed.deserialize(Place(node))
            .map_err(|fault| fault.at(node.start).in_field(&unescaped(name)))
    }
}

/// A name of a field or a variant.
struct Name<'a>(&'a str);

impl<'de> Deserializer<'de> for Name<'_> {
    type Error = Fault;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_str(self.0)
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct
        newtype_struct seq tuple tuple_struct map struct enum identifier ignored_any
    }
}

/// A variant of an enum, with what it holds.
struct Variant<'a, 'de, 't> {
    name: &'a str,
    content: Option<&'de Node<'t>>,
}

impl<'de, 't> Variant<'_, 'de, 't> {
    fn content(&self) -> Result<Place<'de, 't>, Fault> {
        match self.content {
            Some(node) => Ok(Place(node)),
            None => Err(Fault::new(format!("`{}` needs its content: an object", self.name))),
        }
    }

    fn inside<T>(&self, read: Result<T, Fault>) -> Result<T, Fault> {
        let start = self.content.map(|node| node.start);
        read.map_err(|fault| start.into_iter().fold(fault, Fault::at).in_field(self.name))
    }
}

impl<'de> EnumAccess<'de> for Variant<'_, 'de, '_> {
    type Error = Fault;
    type Variant = Self;

    fn variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<(S::Value, Self), Fault> {
        Ok((seed.deserialize(Name(self.name))?, self))
    }
}

impl<'de> VariantAccess<'de> for Variant<'_, 'de, '_> {
    type Error = Fault;

    fn unit_variant(self) -> Result<(), Fault> {
        match self.content {
            None => Ok(()),
            Some(node) => self.inside(de::Deserialize::deserialize(Place(node))),
        }
    }

    fn newtype_variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<S::Value, Fault> {
        self.inside(seed.deserialize(self.content()?))
    }

    fn tuple_variant<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Fault> {
        self.inside(self.content()?.deserialize_seq(visitor))
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        self.inside(self.content()?.deserialize_map(visitor))
    }
}
