//! Tables and entries of a scene file, with their names, lines and text.

use std::ops::{Range, RangeInclusive};

use toml_edit::{Item, Key, TableLike, Value};

use super::letters::{LETTERS, elsewhere, listed, nearest, spelled};
use crate::error::{Error, shown};
use crate::excerpt::Excerpt;
use impact_pair_exact::Exact;

const NUMBER_EXPECTED: &str =
    "must be a number, or a string with an expression (\"3*pi\") or an interval (\"[9.42, 9.43]\")";

/// A table of the file, or the whole file.
pub(super) struct Section<'t> {
    text: &'t str,
    /// Empty for the whole file.
    name: &'static str,
    /// The place of the table's name in the text.
    span: Range<usize>,
    table: &'t dyn TableLike,
}

/// A key of a table with its value.
pub(super) struct Entry<'t> {
    /// The key with the table's name, in full where a letter stands for it: `pair.gap`.
    pub key: String,
    text: &'t str,
    name: Range<usize>,
    value: Range<usize>,
    item: &'t Item,
}

impl<'t> Section<'t> {
    /// The table of the whole file.
    pub fn file(text: &'t str, table: &'t dyn TableLike) -> Self {
        Self { text, name: "", span: 0..0, table }
    }

    /// The table `name` of the file, whose keys are among `keys`.
    pub fn section(&self, name: &'static str, keys: &[&str]) -> Result<Self, Error> {
        self.optional_section(name, keys)?.ok_or_else(|| {
            let missing = Error::entry(name, "missing", &format!("must be a table with {}", listed(keys)));
            // It may be added after the last line.
            match self.text.trim_end().len() {
                0 => missing,
                end => missing.at(Excerpt::new(self.text, end..end)),
            }
        })
    }

    /// The table `name` of the file, if there is one.
    pub fn optional_section(&self, name: &'static str, keys: &[&str]) -> Result<Option<Self>, Error> {
        let Some(entry) = self.entry(name) else { return Ok(None) };
        let table = entry.item.as_table_like();
        let table = table.ok_or_else(|| entry.refused(&format!("must be one table with {}", listed(keys))))?;
        let section = Self { text: self.text, name, span: entry.name, table };
        section.refuse_unknown(keys)?;
        section.refuse_twice()?;
        Ok(Some(section))
    }

    /// The entry of `key`, or of a letter that stands for it, if there is one.
    pub fn entry(&self, key: &str) -> Option<Entry<'t>> {
        self.entries().find(|entry| entry.key == self.full(key))
    }

    /// The entry of `key`; the error `missing` if there is none.
    pub fn require(&self, key: &str) -> Result<Entry<'t>, Error> {
        self.entry(key).ok_or_else(|| self.missing(key, NUMBER_EXPECTED))
    }

    pub fn missing(&self, key: &str, accepted: &str) -> Error {
        Error::entry(&self.full(key), "missing", accepted).at(Excerpt::new(self.text, self.span.clone()))
    }

    pub fn refuse_unknown(&self, accepted: &[&str]) -> Result<(), Error> {
        match self.entries().find(|entry| !accepted.iter().any(|key| entry.key == self.full(key))) {
            None => Ok(()),
            Some(unknown) => {
                let place = if self.name.is_empty() { "a scene".into() } else { format!("[{}]", self.name) };
                let but = format!("is not a key of {place}: accepted are {}", listed(accepted));
                let name = unknown.key.rsplit('.').next().unwrap_or_default();
                let meant = nearest(name, accepted).map_or_else(|| elsewhere(name), |meant| Some(meant.to_owned()));
                Err(unknown.refused_at(unknown.name.clone(), &but).meant(meant))
            }
        }
    }

    /// Refuses two names of one key.
    fn refuse_twice(&self) -> Result<(), Error> {
        let all: Vec<_> = self.entries().collect();
        let twice = all
            .iter()
            .enumerate()
            .find_map(|(i, own)| Some((own, all[..i].iter().find(|other| other.key == own.key)?)));
        match twice {
            None => Ok(()),
            Some((own, other)) => {
                let [name, other_name] = [own, other].map(|entry| self.full(entry.written_name()));
                let line = other.line();
                Err(own.refused(&format!("{name} and {other_name}, on line {line}, are one key: give one of them")))
            }
        }
    }

    /// The keys, each with the line of its value.
    pub fn places(&self) -> impl Iterator<Item = (String, Excerpt)> {
        self.entries().map(|entry| (entry.key.clone(), entry.excerpt()))
    }

    fn entries(&self) -> impl Iterator<Item = Entry<'t>> {
        let known = |(key, _): (&str, _)| self.table.get_key_value(key).map(|(key, item)| self.entry_of(key, item));
        self.table.iter().filter_map(known)
    }

    fn full(&self, key: &str) -> String {
        if self.name.is_empty() { key.to_owned() } else { format!("{}.{key}", self.name) }
    }

    /// The name that a letter stands for in this table.
    fn spelled<'n>(&self, name: &'n str) -> &'n str {
        let is_ours = LETTERS.iter().any(|(letter, table, _)| *letter == name && *table == self.name);
        if is_ours { spelled(name) } else { name }
    }

    fn entry_of(&self, key: &'t Key, item: &'t Item) -> Entry<'t> {
        let key_span = key.span().unwrap_or_default();
        // Tables made by dotted keys have no span of their own.
        let value = item.span().unwrap_or_else(|| key_span.clone());
        Entry { key: self.full(self.spelled(key.get())), text: self.text, name: key_span, value, item }
    }
}

impl<'t> Entry<'t> {
    /// The value as written, for messages and for exact decimals.
    fn written(&self) -> &'t str {
        self.text.get(self.value.clone()).unwrap_or_default()
    }

    /// The name as written.
    fn written_name(&self) -> &'t str {
        self.text.get(self.name.clone()).unwrap_or_default()
    }

    /// The line of the value.
    fn excerpt(&self) -> Excerpt {
        Excerpt::new(self.text, self.value.clone())
    }

    /// The number of the line, from 1.
    pub fn line(&self) -> usize {
        self.excerpt().line()
    }

    /// The error that shows the value and `but`, which says what is accepted.
    pub fn refused(&self, but: &str) -> Error {
        self.refused_at(self.value.clone(), but)
    }

    /// The error that shows the value, marks `place` in the text and says `but`.
    fn refused_at(&self, place: Range<usize>, but: &str) -> Error {
        Error::entry(&self.key, &shown(self.written()), but).at(Excerpt::new(self.text, place))
    }

    /// The value as a string.
    pub fn text(&self, accepted: &str) -> Result<&'t str, Error> {
        self.item.as_str().ok_or_else(|| self.refused(&format!("must be {accepted}")))
    }

    /// The value as a string that a table row and a picture can show: XML has no control characters and neither of the two noncharacters.
    pub fn one_line(&self) -> Result<&'t str, Error> {
        let text = self.text("a string")?;
        let is_hidden = |c: char| c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}');
        if text.contains(is_hidden) {
            Err(self.refused("must be one line without control characters"))
        } else {
            Ok(text)
        }
    }

    /// The value as an exact number or interval.
    pub fn number(&self) -> Result<Exact, Error> {
        self.item
            .as_value()
            .map_or_else(|| Err(self.refused(NUMBER_EXPECTED)), |value| self.exact(value, self.value.clone()))
    }

    /// The value as an exact number that is not an interval.
    pub fn point(&self) -> Result<Exact, Error> {
        let number = self.number()?;
        if number.is_point() { Ok(number) } else { Err(self.refused("must be a single number, not an interval")) }
    }

    /// An exact number for each term: a single number, or the numbers of a list.
    pub fn terms(&self) -> Result<Vec<Exact>, Error> {
        let Some(terms) = self.item.as_array() else { return Ok(vec![self.number()?]) };
        if terms.is_empty() {
            return Err(self.refused("must have a term: a number, or a list of them"));
        }
        let term = |term: &Value| self.exact(term, term.span().unwrap_or_default());
        terms.iter().map(term).collect()
    }

    /// Whether the value is a list.
    pub fn is_list(&self) -> bool {
        self.item.is_array()
    }

    /// The value as an integer of `range`.
    pub fn integer(&self, range: RangeInclusive<u64>) -> Result<u64, Error> {
        let value = self.item.as_integer().and_then(|value| u64::try_from(value).ok());
        value.filter(|value| range.contains(value)).ok_or_else(|| {
            let accepted = match range.end() {
                &end if end >= i64::MAX as u64 => format!("must be an integer of at least {}", range.start()),
                end => format!("must be an integer from {} to {end}", range.start()),
            };
            self.refused(&accepted)
        })
    }

    /// The exact number of a value at `place` in the text.
    fn exact(&self, value: &Value, place: Range<usize>) -> Result<Exact, Error> {
        let (expression, quote) = match value {
            Value::String(string) => (string.value().as_str(), 1),
            Value::Integer(_) | Value::Float(_) => (self.text.get(place.clone()).unwrap_or_default(), 0),
            Value::Boolean(_) | Value::Datetime(_) | Value::Array(_) | Value::InlineTable(_) => {
                return Err(self.refused_at(place, NUMBER_EXPECTED));
            }
        };
        Exact::parse(expression).map_err(|error| {
            // Strings with escapes, and strings of several lines, are longer in the file than their content.
            let is_plain = place.len() == expression.len() + 2 * quote;
            let at = place.start + quote + error.column() - 1;
            let at = if is_plain { at..at } else { place };
            self.refused_at(at, &format!("does not read as a number: {error}")).because(error)
        })
    }
}

/// A piece of the file in backticks.
pub(super) fn quoted(written: &str) -> String {
    format!("`{written}`")
}
