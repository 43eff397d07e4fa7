//! Lists in JSON: an array of objects, an object of arrays, JSON Lines, and the orbit JSON of impact-pair itself.
//!
//! Numbers are taken as they are written, never through a double.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use serde::de::{Deserialize, MapAccess, Visitor};
use serde_json::value::RawValue;

use super::{Column, Columns, List, Listed, Number, Walls, is_impact_name, read_wall, shortened};
use crate::Error;

type Object<'j> = BTreeMap<String, &'j RawValue>;

/// An object, and a key that it has twice: of two values one reader takes the first, another the last.
struct UniqueKeys<'j> {
    object: Object<'j>,
    twice: Option<String>,
}

impl<'j> Deserialize<'j> for UniqueKeys<'j> {
    fn deserialize<D: serde::Deserializer<'j>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(Members)
    }
}

struct Members;

impl<'j> Visitor<'j> for Members {
    type Value = UniqueKeys<'j>;

    fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str("an object")
    }

    fn visit_map<A: MapAccess<'j>>(self, mut members: A) -> Result<UniqueKeys<'j>, A::Error> {
        let mut found = UniqueKeys { object: Object::new(), twice: None };
        while let Some((key, value)) = members.next_entry::<String, &RawValue>()? {
            if found.object.insert(key.clone(), value).is_some() {
                found.twice.get_or_insert(key);
            }
        }
        Ok(found)
    }
}

pub(super) fn read(text: &str, columns: &Columns, walls: &Walls) -> Result<List, Error> {
    let values: Result<Vec<&RawValue>, _> = serde_json::Deserializer::from_str(text).into_iter().collect();
    let values = values.map_err(|error| Error::list(format!("no JSON: {error}")).because(error))?;
    let mut unused = BTreeSet::new();
    let rows = match values.as_slice() {
        [one] if one.get().starts_with('[') => objects("", &list(one)?)?,
        [one] => match object("the document", one)? {
            document if document.contains_key("events") => objects("events", &list(document["events"])?)?,
            document => {
                unused.extend(document.keys().cloned());
                by_columns(&document, columns)?
            }
        },
        lines => objects("", lines)?,
    };
    // Of an orbit JSON the impacts; in JSON Lines its first and last line are no events.
    let is_ours = rows.first().is_some_and(|(_, row)| row.contains_key("schema"));
    let is_impact = |row: &Object<'_>| match row.get("event") {
        Some(event) => is_impact_name(&unquoted(event)),
        None => !is_ours,
    };
    let mut read = BTreeSet::from(["event".to_owned()]);
    let mut listed = Vec::new();
    for (place, row) in rows.iter().filter(|(_, row)| is_impact(row)) {
        let (event, keys) = event(place, row, columns, walls)?;
        unused.extend(row.keys().filter(|key| !unused.contains(*key)).cloned().collect::<Vec<_>>());
        read.extend(keys.into_iter().filter(|&key| !read.contains(key)).map(str::to_owned).collect::<Vec<_>>());
        listed.push(event);
    }
    if listed.is_empty() {
        refuse!("the list has no events: accepted is at least one");
    }
    let unused = unused.difference(&read).map(|name| shortened(name)).collect();
    Ok(List { rows: listed, unused, velocities: columns.velocity.is_some() })
}

fn list(value: &RawValue) -> Result<Vec<&RawValue>, Error> {
    serde_json::from_str(value.get())
        .map_err(|_| Error::list(format!("`{}` is no list, but accepted is an array", shortened(value.get()))))
}

fn object<'j>(place: &str, value: &'j RawValue) -> Result<Object<'j>, Error> {
    let UniqueKeys { object, twice } = serde_json::from_str(value.get())
        .map_err(|_| Error::list(format!("{place} is `{}`, but accepted is an object", shortened(value.get()))))?;
    match twice {
        Some(key) => refuse!("{place} has the key `{}` twice", shortened(&key)),
        None => Ok(object),
    }
}

fn objects<'j>(name: &str, rows: &[&'j RawValue]) -> Result<Vec<(String, Object<'j>)>, Error> {
    let row = |(i, value): (usize, &&'j RawValue)| {
        let place = format!("{name}[{i}]");
        object(&place, value).map(|row| (place, row))
    };
    rows.iter().enumerate().map(row).collect()
}

/// The rows of an object of arrays, with their events if it has such a column.
fn by_columns<'j>(document: &Object<'j>, columns: &Columns) -> Result<Vec<(String, Object<'j>)>, Error> {
    let named = |column: &Column| column.names().find_map(|name| document.get_key_value(name));
    let needed = [Some(&columns.time), Some(&columns.wall), columns.velocity.as_ref()].map(|column| named(column?));
    let mut rows: Vec<(String, Object<'j>)> = Vec::new();
    for (number, column) in needed.into_iter().chain([document.get_key_value("event")]).enumerate() {
        let Some((name, values)) = column else { continue };
        let values = list(values).map_err(|error| Error::list(format!("{name}: {error}")))?;
        if number == 0 {
            rows = (0..values.len()).map(|i| (format!("[{i}]"), Object::new())).collect();
        }
        if values.len() != rows.len() {
            refuse!("{name} has {} values, but the column before has {}", values.len(), rows.len());
        }
        for ((_, row), value) in rows.iter_mut().zip(values) {
            row.insert(name.clone(), value);
        }
    }
    if rows.is_empty() {
        return Err(columns.time.missing("the object"));
    }
    Ok(rows)
}

/// An event, and the keys that are read of it.
fn event<'r>(
    place: &str,
    row: &'r Object<'_>,
    columns: &Columns,
    walls: &Walls,
) -> Result<(Listed, Vec<&'r str>), Error> {
    let find = |column: &Column| column.names().find_map(|name| row.get_key_value(name));
    let need = |column: &Column| find(column).ok_or_else(|| column.missing(place));
    let (key, time) = need(&columns.time)?;
    let time = number(&format!("{place}.{key}"), time)?;
    let mut keys = vec![key.as_str()];
    let (key, wall) = need(&columns.wall)?;
    keys.push(key);
    let wall = read_wall(place, &unquoted(wall), walls)?;
    let velocity = match &columns.velocity {
        Some(column) if column.given.is_some() => Some(need(column)?),
        Some(column) => find(column),
        None => None,
    };
    keys.extend(velocity.map(|(key, _)| key.as_str()));
    let is_given = |(_, value): &(&String, &&RawValue)| {
        value.get() != "null" || columns.velocity.as_ref().is_some_and(|column| column.given.is_some())
    };
    let velocity =
        velocity.filter(is_given).map(|(key, value)| number(&format!("{place}.{key}"), value)).transpose()?;
    Ok((Listed { place: place.to_owned(), wall, time, velocity }, keys))
}

/// A number, a decimal in a string, or a list of two bounds.
fn number(place: &str, value: &RawValue) -> Result<Number, Error> {
    let decimal = |value: &RawValue| Number::decimal(&unquoted(value));
    let bounds = || {
        let bounds: [&RawValue; 2] = serde_json::from_str(value.get()).ok()?;
        let [low, high] = bounds.map(decimal);
        Number::between([low?, high?])
    };
    decimal(value).or_else(bounds).ok_or_else(|| {
        let (written, accepted) =
            (shortened(value.get()), "a finite decimal number, or a list of a lower and an upper bound");
        Error::list(format!("{place} is `{written}`, but accepted is {accepted}"))
    })
}

/// A string without its quotes, anything else as it is written.
fn unquoted(value: &RawValue) -> String {
    serde_json::from_str(value.get()).unwrap_or_else(|_| value.get().to_owned())
}
