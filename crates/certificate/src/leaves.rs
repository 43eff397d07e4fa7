//! The values of a document one by one, and the values that a check does not compare with anything.

use std::collections::HashSet;

use serde_json::Value;

use crate::settings::is_setting;

/// Sorts the values of a document into checked and unchecked values.
pub(super) struct Leaves<'n> {
    /// Unchecked paths: with the positions in lists, or without them for all items.
    unjudged: HashSet<&'n str>,
    /// The list whose items are claims one after another.
    items: Option<&'n str>,
    /// Checked paths: each a plain value, or a list of plain values.
    pub judged: Vec<String>,
    /// Unchecked paths, each with everything below it.
    pub others: Vec<String>,
    /// Unchecked paths with a claim: the path, and the path without positions in lists.
    pub unchecked: Vec<[String; 2]>,
}

/// Keys of flags that claim nothing where they are false.
const FLAGS: [&str; 5] = ["certified", "exhaustive", "no_attractor", "no_rest", "stable_between"];

/// Keys at which `null` is a claim: that no mapping is named, that no two of the words are free.
const NULL_CLAIMS: [&str; 2] = ["events.mapping", "horseshoe"];

/// Whether a value exists at a path without the positions in lists.
pub(super) fn is_there(value: &Value, path: &str) -> bool {
    let (key, rest) = path.split_once('.').map_or((path, None), |(key, rest)| (key, Some(rest)));
    match value {
        Value::Array(items) => items.iter().any(|item| is_there(item, path)),
        Value::Object(entries) => entries.get(key).is_some_and(|value| rest.is_none_or(|rest| is_there(value, rest))),
        _ => false,
    }
}

impl<'n> Leaves<'n> {
    pub fn new(unjudged: &'n [String], items: Option<&'n str>) -> Self {
        let unjudged = unjudged.iter().map(String::as_str).collect();
        Self { unjudged, items, judged: Vec::new(), others: Vec::new(), unchecked: Vec::new() }
    }

    /// Sorts the value at a path; `unnumbered` is the path without the positions in lists.
    pub fn add(&mut self, path: &str, unnumbered: &str, value: &Value) {
        let is_unjudged = self.unjudged.contains(path) || self.unjudged.contains(unnumbered);
        if is_unjudged || self.says_nothing(unnumbered, value) {
            if !is_setting(path) && self.claims(unnumbered, value) {
                self.unchecked.push([path, unnumbered].map(str::to_owned));
            }
            return self.others.push(path.to_owned());
        }
        match value {
            Value::Object(entries) if !entries.is_empty() => {
                let full =
                    |path: &str, key: &str| if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
                for (key, value) in entries {
                    self.add(&full(path, key), &full(unnumbered, key), value);
                }
            }
            Value::Array(items) if !self.is_one_claim(path, unnumbered, items) => {
                for (i, item) in items.iter().enumerate() {
                    self.add(&format!("{path}[{i}]"), unnumbered, item);
                }
            }
            _ => self.judged.push(path.to_owned()),
        }
    }

    /// Whether a list consists of plain values that are checked together, such as bounds.
    fn is_one_claim(&self, path: &str, unnumbered: &str, items: &[Value]) -> bool {
        items.iter().enumerate().all(|(i, item)| {
            !item.is_object()
                && !item.is_array()
                && !self.says_nothing(unnumbered, item)
                && !self.unjudged.contains(format!("{path}[{i}]").as_str())
        })
    }

    /// Whether a value, or a value below it, claims something.
    fn claims(&self, unnumbered: &str, value: &Value) -> bool {
        !is_setting(unnumbered)
            && !self.says_nothing(unnumbered, value)
            && match value {
                Value::Object(entries) => {
                    entries.iter().any(|(key, value)| self.claims(&format!("{unnumbered}.{key}"), value))
                }
                Value::Array(items) => items.iter().any(|item| self.claims(unnumbered, item)),
                _ => true,
            }
    }

    /// Whether a value at a path claims nothing.
    fn says_nothing(&self, unnumbered: &str, value: &Value) -> bool {
        let key = unnumbered.rsplit('.').next().unwrap_or(unnumbered); // exact: the whole path
        match value {
            Value::Null => !NULL_CLAIMS.contains(&unnumbered),
            Value::Array(items) => items.is_empty() && self.items != Some(unnumbered),
            Value::Object(entries) => entries.is_empty(),
            Value::Bool(is_so) => !is_so && FLAGS.contains(&key),
            Value::String(word) => key == "stability" && word == "undecided",
            Value::Number(_) => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn each_value_is_checked_by_its_path_or_its_list_or_is_unchecked() {
        let document = json!({
            "program": "x", "certified": true, "exhaustive": false, "undecided": [],
            "scene": {"excitation": {"amplitude": ["1", "2"]}, "start": {"time": "0", "velocity": "1"}},
            "events": [{"time": ["0", "1"], "mapping": null, "note": null}, {"time": ["1", "2"], "mapping": "P1"}],
            "outcome": {"time": ["3", "4"], "orbit": {"trace": null, "stability": "undecided", "impacts": [{"wall": "left"}]}},
        });
        let names = ["program", "scene.start", "scene.excitation.amplitude[1]", "outcome.time[1]"].map(str::to_owned);
        let mut leaves = Leaves::new(&names, Some("events"));
        leaves.add("", "", &document);
        let (mut judged, mut others) = (leaves.judged, leaves.others);
        judged.sort();
        others.sort();
        let expected = [
            "certified",
            "events[0].mapping",
            "events[0].time",
            "events[1].mapping",
            "events[1].time",
            "outcome.orbit.impacts[0].wall",
            "outcome.time[0]",
            "scene.excitation.amplitude[0]",
        ];
        assert_eq!(judged, expected);
        let expected = [
            "events[0].note",
            "exhaustive",
            "outcome.orbit.stability",
            "outcome.orbit.trace",
            "outcome.time[1]",
            "program",
            "scene.excitation.amplitude[1]",
            "scene.start",
            "undecided",
        ];
        assert_eq!(others, expected);
    }
}
