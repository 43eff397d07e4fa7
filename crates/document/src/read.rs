//! Reading of documents; errors name the path of the fault, such as `events[3].time`.

use impact_pair_model::Error;
use serde::de::DeserializeOwned;
use serde_json::{Deserializer, Map, Value};
use serde_path_to_error::{Path, Segment};

use super::once::UniqueKeys;
use super::strict::Strict;

/// A value of a document with its path.
#[derive(Clone, Debug)]
pub struct Place<'j> {
    key: String,
    value: &'j Value,
}

/// Returns the value of a text, in which no object has a key twice.
pub fn value(text: &str) -> Result<Value, Error> {
    serde_json::from_str(text).map(|UniqueKeys(value)| value).map_err(no_json)
}

/// Reads a document.
///
/// # Errors
/// Name the path of the fault.
pub fn read<T: DeserializeOwned>(text: &str) -> Result<T, Error> {
    Place::whole(&value(text)?).read()
}

/// Returns the values of a text, at least one; JSON Lines have several. No object has a key twice.
pub fn values(text: &str) -> Result<Vec<Value>, Error> {
    let values = Deserializer::from_str(text).into_iter().map(|value| value.map(|UniqueKeys(value)| value));
    let values: Vec<Value> = values.collect::<Result<_, _>>().map_err(no_json)?;
    if values.is_empty() { Err(Error::certificate("not JSON: the text is empty".into())) } else { Ok(values) }
}

fn no_json(error: serde_json::Error) -> Error {
    // A key that is there twice is no fault of JSON's grammar.
    let what = if error.is_data() { "" } else { "not JSON: " };
    Error::certificate(format!("{what}{error}")).because(error)
}

impl<'j> Place<'j> {
    /// Returns the whole document.
    pub fn whole(value: &'j Value) -> Self {
        Self { key: String::new(), value }
    }

    /// Returns the whole document, which must have this schema.
    pub fn of_schema(value: &'j Value, accepted: &str) -> Result<Self, Error> {
        let whole = Self::whole(value);
        whole.require_schema(accepted)?;
        Ok(whole)
    }

    /// Refuses a document of another schema.
    pub fn require_schema(&self, accepted: &str) -> Result<(), Error> {
        let schema = self.get("schema")?;
        let is_other = schema.read::<String>()? != accepted;
        if is_other { Err(schema.refused(&format!("accepted is \"{accepted}\""))) } else { Ok(()) }
    }

    /// Returns the whole document that is no JSON Lines.
    pub fn alone(values: &'j [Value]) -> Result<Self, Error> {
        let [value] = values else { return Err(Error::certificate("not JSON: more follows the document".to_owned())) };
        Ok(Self::whole(value))
    }

    /// Returns the whole document that is no JSON Lines, which must have this schema.
    pub fn alone_of_schema(values: &'j [Value], accepted: &str) -> Result<Self, Error> {
        Self::alone(values)?;
        Self::of_schema(&values[0], accepted)
    }

    /// Returns a value at a key.
    pub fn at(key: String, value: &'j Value) -> Self {
        Self { key, value }
    }

    /// Returns the value at one of its keys.
    pub fn get(&self, key: &str) -> Result<Self, Error> {
        let map: &Map<String, Value> = self.value.as_object().ok_or_else(|| self.refused("must be an object"))?;
        let value = map.get(key).ok_or_else(|| self.missing(key))?;
        Ok(Self { key: self.full(key), value })
    }

    /// Returns its items.
    pub fn list(&self) -> Result<Vec<Self>, Error> {
        let list = self.value.as_array().ok_or_else(|| self.refused("must be a list"))?;
        Ok(list.iter().enumerate().map(|(i, value)| Self { key: format!("{}[{i}]", self.key), value }).collect())
    }

    /// Returns its content: an object for a struct, with no other keys than the struct's.
    pub fn read<T: DeserializeOwned>(&self) -> Result<T, Error> {
        serde_path_to_error::deserialize(Strict(self.value))
            .map_err(|error| self.inner(error.path()).wrong(error.into_inner()))
    }

    /// The value at a path in it.
    fn inner(&self, path: &Path) -> Self {
        path.iter().fold(self.clone(), |Self { key, value }, segment| match segment {
            Segment::Seq { index } => Self { key: format!("{key}[{index}]"), value: &value[index] },
            Segment::Map { key: field } => Self { key: Self { key, value }.full(field), value: &value[field.as_str()] },
            Segment::Enum { .. } | Segment::Unknown => Self { key, value },
        })
    }

    /// Returns the error of serde in the words of this crate.
    fn wrong(&self, error: serde_json::Error) -> Error {
        let message = error.to_string();
        let quoted = |text: &str| text.replace('`', "\"").replace(" or ", " and ").replace("one of ", "");
        if let Some(field) = message.strip_prefix("missing field `").and_then(|rest| rest.split('`').next()) {
            return self.missing(field).because(error);
        }
        if let Some(field) = message.strip_prefix("unknown field `").and_then(|rest| rest.split('`').next()) {
            return self
                .get(field)
                .map_or_else(|error| error, |place| place.refused("there is no such key"))
                .because(error);
        }
        let refused = match message.rsplit_once(", expected ") {
            Some((variant, accepted)) if variant.starts_with("unknown") => {
                self.refused(&format!("accepted are {}", quoted(accepted)))
            }
            Some((_, accepted)) => self.refused(&format!("must be {accepted}")),
            None => self.refused(&message),
        };
        refused.because(error)
    }

    /// Returns the error of a value that is not accepted.
    pub fn refused(&self, but: &str) -> Error {
        let mut written = self.value.to_string();
        if written.len() > 60 {
            written = written.chars().take(57).chain("...".chars()).collect();
        }
        let key = if self.key.is_empty() { "the document" } else { &self.key };
        Error::certificate(format!("{key} is {written}, but {but}"))
    }

    /// Returns the error of a missing key.
    pub fn missing(&self, key: &str) -> Error {
        Error::certificate(format!("{} is missing", self.full(key)))
    }

    fn full(&self, key: &str) -> String {
        if self.key.is_empty() { key.to_owned() } else { format!("{}.{key}", self.key) }
    }
}
