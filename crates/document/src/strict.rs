//! Deserializer of JSON values in which a struct is an object of its own keys, an enum a word, and a list as long as its type.
//!
//! Derived code takes the list of a struct's values for the struct, an object of one key for a word, and ignores keys that it does not know.
//! This deserializer refuses all three for every struct, without an attribute at any of them.

use serde::de::value::{MapDeserializer, SeqDeserializer, StrDeserializer};
use serde::de::{Deserializer, Error, IntoDeserializer, Unexpected, Visitor};
use serde::forward_to_deserialize_any;
use serde_json::{Map, Value};

/// A value that is read strictly.
#[derive(Clone, Copy)]
pub(super) struct Strict<'de>(pub &'de Value);

/// The key of an entry, which may be a number.
struct Key<'de>(&'de str);

impl<'de> Strict<'de> {
    fn wrong(self, accepted: &str) -> serde_json::Error {
        let found = match self.0 {
            Value::Null => Unexpected::Unit,
            Value::Bool(is_so) => Unexpected::Bool(*is_so),
            Value::Number(_) => Unexpected::Other("number"),
            Value::String(text) => Unexpected::Str(text),
            Value::Array(_) => Unexpected::Seq,
            Value::Object(_) => Unexpected::Map,
        };
        serde_json::Error::invalid_type(found, &accepted)
    }

    fn list<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, serde_json::Error> {
        let Value::Array(items) = self.0 else { return Err(self.wrong("a list")) };
        let mut items = SeqDeserializer::<_, serde_json::Error>::new(items.iter().map(Strict));
        let list = visitor.visit_seq(&mut items)?;
        // Fails where items are left over.
        items.end().map(|()| list)
    }

    fn entries<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, serde_json::Error> {
        let Value::Object(entries) = self.0 else { return Err(self.wrong("an object")) };
        visitor.visit_map(MapDeserializer::new(entries.iter().map(|(key, value)| (Key(key), Strict(value)))))
    }
}

impl<'de> IntoDeserializer<'de, serde_json::Error> for Strict<'de> {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}

impl<'de> IntoDeserializer<'de, serde_json::Error> for Key<'de> {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}

impl<'de> Deserializer<'de> for Strict<'de> {
    type Error = serde_json::Error;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Self::Error> {
        match self.0 {
            Value::Array(_) => self.list(visitor),
            Value::Object(_) => self.entries(visitor),
            plain => plain.deserialize_any(visitor),
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Self::Error> {
        if self.0.is_null() { visitor.visit_none() } else { visitor.visit_some(self) }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, _: &str, visitor: V) -> Result<V::Value, Self::Error> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Self::Error> {
        self.list(visitor)
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Self::Error> {
        self.list(visitor)
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Self::Error> {
        self.entries(visitor)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Self::Error> {
        let mut keys = self.0.as_object().into_iter().flat_map(Map::keys);
        match keys.find(|key| !fields.contains(&key.as_str())) {
            Some(key) => Err(Error::unknown_field(key, fields)),
            None => self.entries(visitor),
        }
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Self::Error> {
        let Value::String(word) = self.0 else { return Err(self.wrong("a word")) };
        let word: StrDeserializer<'_, Self::Error> = word.as_str().into_deserializer();
        word.deserialize_enum(name, variants, visitor)
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct tuple_struct identifier
        ignored_any
    }
}

impl<'de> Deserializer<'de> for Key<'de> {
    type Error = serde_json::Error;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Self::Error> {
        visitor.visit_borrowed_str(self.0)
    }

    /// A number in one spelling: with two of them an object could have one key twice.
    fn deserialize_u32<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Self::Error> {
        match self.0.parse::<u32>() {
            Ok(number) if number.to_string() == self.0 => visitor.visit_u32(number),
            _ => Err(Error::invalid_value(Unexpected::Str(self.0), &"a whole number")),
        }
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct newtype_struct seq tuple
        tuple_struct map struct enum identifier ignored_any
    }
}
