//! Documents with one thing changed.

#![allow(dead_code, reason = "the library and the checker take their own")]

use impact_pair_document::OutcomeDocument;
use impact_pair_exact::{Exact, decimal_bounds};
use serde_json::{Value, json};

/// A document with one thing changed.
pub struct Change {
    /// The path of the change, without the positions in lists.
    pub path: String,
    /// The change in words.
    pub what: String,
    pub document: Value,
    /// The path with the positions in lists.
    place: String,
}

impl Change {
    /// Whether the change is at a key, which may have positions in lists, or in the value at that key.
    pub fn is_at(&self, key: &str) -> bool {
        self.path.starts_with(key) || self.place.starts_with(key)
    }
}

/// A change that fits a document: where, how, and what stands there then; `None` is nothing at all.
pub struct Plan {
    path: Vec<String>,
    what: String,
    other: Option<Value>,
}

/// The plans of all changes of a document.
pub fn plans(document: &Value) -> Vec<Plan> {
    let mut plans = Vec::new();
    walk(document, &mut Vec::new(), &mut |path, value| {
        let of = |(what, other)| Plan { path: path.to_vec(), what, other };
        plans.extend(others(path, value).into_iter().map(of));
    });
    plans
}

impl Plan {
    /// A document that is changed so, as it stands and, where that differs, with what counts or says in words what is changed anew.
    pub fn changes(self, document: &Value) -> Vec<Change> {
        let Self { path, what, other } = self;
        let place = numbered(&path);
        let mut copy = document.clone();
        let pointer: String = path.iter().map(|key| format!("/{key}")).collect();
        match other {
            Some(other) => *copy.pointer_mut(&pointer).unwrap() = other,
            None => remove(&mut copy, &path),
        }
        let name: String =
            path.iter().filter(|key| key.parse::<usize>().is_err()).map(|key| format!(".{key}")).collect();
        let path = name.trim_start_matches('.').to_owned();
        let anew = made_consistent(&copy);
        let change =
            |what: String, document: Value| Change { path: path.clone(), what, document, place: place.clone() };
        let consistent = (anew != copy).then(|| change(format!("{what}, told anew"), anew));
        [Some(change(what, copy)), consistent].into_iter().flatten().collect()
    }
}

/// A path as it is written: `events[0].time`.
fn numbered(path: &[String]) -> String {
    let step = |key: &String| if key.parse::<usize>().is_ok() { format!("[{key}]") } else { format!(".{key}") };
    path.iter().map(step).collect::<String>().trim_start_matches('.').to_owned()
}

fn walk(value: &Value, path: &mut Vec<String>, each: &mut impl FnMut(&[String], &Value)) {
    if !path.is_empty() {
        each(path, value);
    }
    let entries: Vec<(String, &Value)> = match value {
        Value::Object(entries) => entries.iter().map(|(key, value)| (key.clone(), value)).collect(),
        Value::Array(items) => items.iter().enumerate().map(|(i, item)| (i.to_string(), item)).collect(),
        _ => Vec::new(),
    };
    for (key, inner) in entries {
        path.push(key);
        walk(inner, path, each);
        path.pop();
    }
}

fn remove(document: &mut Value, path: &[String]) {
    let (last, outer) = path.split_last().unwrap();
    let pointer: String = outer.iter().map(|key| format!("/{key}")).collect();
    match document.pointer_mut(&pointer).unwrap() {
        Value::Object(entries) => drop(entries.remove(last)),
        Value::Array(items) => drop(items.remove(last.parse().unwrap())),
        _ => unreachable!("what has entries"),
    }
}

/// Other values for a place, each with its name; `None` leaves the key out.
fn others(path: &[String], value: &Value) -> Vec<(String, Option<Value>)> {
    let mut others: Vec<(String, Option<Value>)> = vec![("left out".into(), None)];
    let mut put = |what: &str, value: Value| others.push((what.into(), Some(value)));
    match value {
        Value::Null => {
            for value in [json!(true), json!("P2"), json!(["0", "1"]), json!("left")] {
                put("told", value);
            }
        }
        Value::Bool(is_so) => {
            put("denied", json!(!is_so));
            put("not told", Value::Null);
        }
        Value::Number(number) => {
            let number = number.as_u64().unwrap();
            for other in [number + 1, number.wrapping_sub(1), 2 * number, 0, 9999] {
                put("counted otherwise", json!(other));
            }
        }
        Value::Object(_) => {}
        Value::Array(items) => {
            if let Some(bounds) = bounds(items) {
                for (what, [lower, upper]) in moved_bounds(path, &bounds) {
                    put(what, json!([lower, upper]));
                }
            }
            for at in 0..items.len().min(12) {
                let mut copy = items.clone();
                copy.insert(at, items[at].clone());
                put("one twice", json!(copy));
                if at > 0 {
                    let mut copy = items.clone();
                    copy.swap(at - 1, at);
                    put("two exchanged", json!(copy));
                }
            }
        }
        Value::String(text) => {
            for other in WORDS.iter().filter(|words| words.contains(&text.as_str())).copied().flatten() {
                put("another word", json!(other));
            }
            let is_number = text.starts_with(|c: char| c.is_ascii_digit() || c == '-');
            if is_number {
                for other in [moved(text, 1), moved(text, -1)] {
                    put("a unit of the last place", json!(other));
                }
            }
            for other in
                [format!("-({text})"), format!("{text} + 1e-9"), format!("{text} + 1"), "9999".into(), String::new()]
            {
                put("another value", json!(other));
            }
        }
    }
    others.retain(|(_, other)| other.as_ref() != Some(value));
    others
}

/// Words of which each may stand for another.
const WORDS: [&[&str]; 9] = [
    &["left", "right"],
    &["exact start", "shadowed"],
    &["impact", "graze", "rest", "release"],
    &["P1", "P2", "P3", "P4"],
    &["impacts-reached", "time-reached", "periodic", "attracted", "rests-forever", "never-impacts", "undecided"],
    &["stable", "unstable", "undecided"],
    &["positive", "negative", "zero"],
    &["graze", "width", "precision", "budget"],
    &["P1 P2", "P2 P1", "P3", "P1 P2 P1 P2", "P4 P4 P1 P3 P2"],
];

/// The words that may stand in the place of one.
pub fn other_words(text: &str) -> Option<Vec<&'static str>> {
    let all = [&WORDS[..], &[&["fold", "pitchfork", "period-doubling"]]].concat();
    let words = all.into_iter().find(|words| words.contains(&text))?;
    Some(words.iter().copied().filter(|word| *word != text).collect())
}

fn bounds(items: &[Value]) -> Option<[String; 2]> {
    let [Value::String(lower), Value::String(upper)] = items else { return None };
    let is_number = |text: &str| text.parse::<f64>().is_ok();
    (is_number(lower) && is_number(upper)).then(|| [lower.clone(), upper.clone()])
}

/// Bounds that are wider, narrower, elsewhere, whole forcing periods later, mirrored, exchanged.
fn moved_bounds(path: &[String], [lower, upper]: &[String; 2]) -> Vec<(&'static str, [String; 2])> {
    let width = units(lower, upper).max(1);
    let both = |by: i64| [moved(lower, by), moved(upper, by)];
    let plus = |by: &str| [lower, upper].map(|bound| decimal(&format!("{bound} + ({by})")));
    let minus = [upper, lower].map(|bound| decimal(&format!("-({bound})")));
    let mut all = vec![
        ("wider", [moved(lower, -1), moved(upper, 1)]),
        ("the lower bound as the upper one", [lower.clone(), lower.clone()]),
        ("the upper bound as the lower one", [upper.clone(), upper.clone()]),
        ("later by its width", both(width + 1)),
        ("earlier by its width", both(-width - 1)),
        ("exchanged", [upper.clone(), lower.clone()]),
        ("mirrored", minus),
        ("ten turns of a phase later", plus("20*pi")),
        ("half a turn of a phase later", plus("pi")),
        ("two later", plus("2")),
    ];
    if path.iter().any(|key| key == "phase") {
        all.push(("a turn earlier", plus("-2*pi")));
    }
    all
}

/// A decimal, `units` units of its last place higher.
pub fn moved(text: &str, units: i64) -> String {
    let (digits, power) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let places = digits.split_once('.').map_or(0, |(_, part)| part.len() as i64);
    let Ok(whole) = digits.replace('.', "").parse::<i128>() else { return format!("{text} + ({units})") };
    format!("{}e{}", whole + i128::from(units), power.parse::<i64>().unwrap() - places)
}

/// Approximate number of units of the last place between two decimals.
fn units(lower: &str, upper: &str) -> i64 {
    let place = lower.split_once('.').map_or(0, |(_, part)| part.split(['e', 'E']).next().unwrap_or("").len() as i32);
    let apart = upper.parse::<f64>().unwrap() - lower.parse::<f64>().unwrap();
    (apart * 10f64.powi(place)).ceil() as i64
}

/// An expression as a decimal of 25 places.
fn decimal(expression: &str) -> String {
    let exact = Exact::parse(expression).unwrap();
    decimal_bounds(&exact.enclose(96))[0].clone()
}

/// The document with all derived values recomputed: numbers and mappings of impacts, their count, the message.
pub fn made_consistent(document: &Value) -> Value {
    let mut made_consistent = document.clone();
    let Some(events) = made_consistent.get_mut("events").and_then(Value::as_array_mut) else { return made_consistent };
    for (i, event) in events.iter_mut().filter(|event| event["event"] == "impact").enumerate() {
        if let Some(entries) = event.as_object_mut() {
            entries.entry("index").and_modify(|number| *number = json!(i + 1));
        }
    }
    let Some(outcome) = made_consistent.get("outcome") else { return made_consistent };
    let Ok(outcome) = serde_json::from_value::<OutcomeDocument>(outcome.clone()) else { return made_consistent };
    // If only the count was changed it is the error; if impacts were, it follows from them.
    let listed = document["events"]
        .as_array()
        .map_or(0, |events| events.iter().filter(|event| event["event"] == "impact").count());
    let is_listed = outcome.impacts.is_some_and(|impacts| impacts.abs_diff(listed as u64) == 1);
    let impacts = if is_listed { Some(listed as u64) } else { outcome.impacts };
    let outcome = OutcomeDocument { impacts, ..outcome };
    let message = outcome.words().unwrap_or(outcome.message.clone());
    made_consistent["outcome"] = json!(OutcomeDocument { message, ..outcome });
    made_consistent
}

/// A key without the positions in lists.
pub fn unnumbered(key: &str) -> String {
    key.split('[').map(|part| part.split_once(']').map_or(part, |(_, rest)| rest)).collect()
}
