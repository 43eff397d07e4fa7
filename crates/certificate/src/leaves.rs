//! The values of a document one by one, sorted by what is said of them.

use std::collections::BTreeSet;

use serde_json::Value;

use crate::marks::{Mark, Said};

/// Sorts the values of a document into checked and unchecked values.
pub(super) struct Leaves<'n> {
    /// The list whose items are claims one after another.
    pub items: Option<&'n str>,
    /// Checked paths: each a plain value, or a list of plain values.
    pub judged: Vec<String>,
    /// Unchecked paths, each with everything below it.
    pub others: Vec<String>,
    /// Unchecked paths with a claim, without positions in lists.
    pub unchecked: Vec<String>,
    /// Unchecked paths, but for those whose value makes no claim; with positions in lists where that is decided for each item.
    pub names: BTreeSet<String>,
}

impl<'n> Leaves<'n> {
    pub fn new(items: Option<&'n str>) -> Self {
        let (judged, others, unchecked) = (Vec::new(), Vec::new(), Vec::new());
        Self { items, judged, others, unchecked, names: BTreeSet::new() }
    }

    /// Sorts the lines of a document that are the items of a list.
    pub fn add_lines(&mut self, list: &str, lines: &[Value], mark: Option<&Mark>) {
        for (i, line) in lines.iter().enumerate() {
            let mark = mark.and_then(|mark| mark.item(i)).expect("a mark for each line");
            self.add(&format!("{list}[{i}]"), list, line, mark);
        }
    }

    /// Sorts the value at a path; `unnumbered` is the path without the positions in lists.
    pub fn add(&mut self, path: &str, unnumbered: &str, value: &Value, mark: &Mark) {
        if mark.said != Said::Checked || self.says_nothing(unnumbered, value, mark) {
            if mark.said == Said::Claimed && says_something(value) {
                self.unchecked.push(unnumbered.to_owned());
            }
            if matches!(mark.said, Said::Claimed | Said::Setting) {
                self.names.insert(if mark.is_of_item { path } else { unnumbered }.to_owned());
            }
            return self.others.push(path.to_owned());
        }
        match value {
            Value::Object(entries) if !entries.is_empty() => {
                let full =
                    |path: &str, key: &str| if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
                for (key, value) in entries {
                    let mark = mark.at(key).expect("a mark for each key");
                    self.add(&full(path, key), &full(unnumbered, key), value, mark);
                }
            }
            Value::Array(items) if !self.is_one_claim(unnumbered, items, mark) => {
                for (i, item) in items.iter().enumerate() {
                    let mark = mark.item(i).expect("a mark for each item");
                    self.add(&format!("{path}[{i}]"), unnumbered, item, mark);
                }
            }
            _ => self.judged.push(path.to_owned()),
        }
    }

    /// Whether a list consists of plain values that are checked together, such as bounds.
    fn is_one_claim(&self, unnumbered: &str, items: &[Value], mark: &Mark) -> bool {
        items.iter().enumerate().all(|(i, item)| {
            let is_plain = !item.is_object() && !item.is_array();
            let is_checked = mark.item(i).is_none_or(|mark| mark.said == Said::Checked);
            is_plain && is_checked && !self.says_nothing(unnumbered, item, mark)
        })
    }

    /// Whether a value at a path claims nothing.
    fn says_nothing(&self, unnumbered: &str, value: &Value, mark: &Mark) -> bool {
        match value {
            Value::Null => !mark.null_claims,
            Value::Array(items) => items.is_empty() && self.items != Some(unnumbered),
            Value::Object(entries) => entries.is_empty(),
            Value::Bool(_) | Value::Number(_) | Value::String(_) => false,
        }
    }
}

/// Whether there is a value in it that is not null.
fn says_something(value: &Value) -> bool {
    match value {
        Value::Null => false,
        Value::Array(items) => items.iter().any(says_something),
        Value::Object(entries) => entries.values().any(says_something),
        Value::Bool(_) | Value::Number(_) | Value::String(_) => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::marks::{checked, claimed, each, items, setting};
    use serde_json::json;

    #[test]
    fn each_value_is_checked_by_its_path_or_its_list_or_is_unchecked() {
        let document = json!({
            "program": "x", "certified": false, "exhaustive": true, "undecided": [],
            "scene": {"amplitude": ["1", "2"], "start": {"time": "0", "velocity": "1"}},
            "events": [{"time": ["0", "1"], "mapping": null, "note": null}, {"time": ["1", "2"], "mapping": "P1"}],
            "time": ["3", "4"],
        });
        let event =
            Mark::of_fields(vec![("time", checked("")), ("mapping", checked("").or_null()), ("note", checked(""))]);
        let of_two = |used: [bool; 2]| items(&used, |&is_used| checked("").used_here(is_used, "why"));
        let scene = Mark::of_fields(vec![("amplitude", of_two([true, false])), ("start", setting("why"))]);
        let mark = Mark::of_fields(vec![
            ("program", setting("why")),
            ("certified", checked("").flag(false)),
            ("exhaustive", claimed("why").flag(true)),
            ("undecided", setting("why")),
            ("scene", scene),
            ("events", each(&[()], |()| event.clone())),
            ("time", of_two([true, false])),
        ]);
        let mut leaves = Leaves::new(Some("events"));
        leaves.add("", "", &document, &mark);
        let (mut judged, mut others) = (leaves.judged, leaves.others);
        judged.sort();
        others.sort();
        let expected = [
            "events[0].mapping",
            "events[0].time",
            "events[1].mapping",
            "events[1].time",
            "scene.amplitude[0]",
            "time[0]",
        ];
        assert_eq!(judged, expected);
        let expected = [
            "certified",
            "events[0].note",
            "exhaustive",
            "program",
            "scene.amplitude[1]",
            "scene.start",
            "time[1]",
            "undecided",
        ];
        assert_eq!(others, expected);
        assert_eq!(leaves.unchecked, ["exhaustive"]);
        let names: Vec<String> = leaves.names.into_iter().collect();
        assert_eq!(names, ["exhaustive", "program", "scene.amplitude[1]", "scene.start", "time[1]", "undecided"]);
    }
}
