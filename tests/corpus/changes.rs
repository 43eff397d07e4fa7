//! A true document with one thing changed: each value by each other one that fits it, as it stands and with all that follows told anew.

use std::collections::{BTreeMap, BTreeSet};

use impact_pair_exact::Exact;
use num_rational::BigRational;
use serde_json::{Value, json};

use super::numbers::{bounds, decimal, fraction, leading, negated, pair, pi, rational, unit};
use super::told::told_anew;

/// Items of a list that are changed one by one; of a longer list as many, spread over it.
const ITEMS: usize = 12;
/// Longest text that is a word and not a sentence.
const WORD: usize = 40;

/// Words of which each may stand for another, beside those that documents have at the same key.
const WORDS: [&[&str]; 10] = [
    &["left", "right"],
    &["exact start", "shadowed"],
    &["impact", "graze", "rest", "release"],
    &["P1", "P2", "P3", "P4"],
    &["impacts-reached", "time-reached", "periodic", "attracted", "rests-forever", "never-impacts", "undecided"],
    &["stable", "unstable", "undecided"],
    &["positive", "negative", "zero"],
    &["graze", "width", "precision", "budget"],
    &["P1 P2", "P2 P1", "P3", "P1 P2 P1 P2", "P4 P4 P1 P3 P2"],
    &["fold", "pitchfork", "period-doubling"],
];

/// A count made of another one, and the change in words.
type Count = (&'static str, fn(i64) -> i64);

/// Other numbers in the place of a count.
const COUNTS: [Count; 8] = [
    ("one more", |n| n + 1),
    ("one less", |n| n - 1),
    ("two more", |n| n + 2),
    ("two less", |n| n - 2),
    ("twice as many", |n| 2 * n),
    ("half as many", |n| n / 2),
    ("none", |_| 0),
    ("9999", |_| 9999),
];

/// Other values in the place of an expression.
const VALUES: [(&str, &str); 9] = [
    ("a billionth more", "({}) + 1e-9"),
    ("a thousandth more", "({}) + 1e-3"),
    ("a thousandth less", "({}) - 1e-3"),
    ("one more", "({}) + 1"),
    ("a thousandfold", "({}) * 1000"),
    ("a thousandth part", "({}) / 1000"),
    ("an interval", "[{}, {} + 1]"),
    ("1e-300", "1e-300"),
    ("9999", "9999"),
];

/// The words that documents have, by their keys.
pub type Vocabulary = BTreeMap<String, BTreeSet<String>>;

/// Adds the words of a document.
pub fn learn(document: &Value, vocabulary: &mut Vocabulary) {
    walk(document, &mut Vec::new(), &mut |path, value| {
        if let Some(text) = value.as_str().filter(|text| text.len() < WORD && Exact::parse(text).is_err()) {
            vocabulary.entry(key(path).to_owned()).or_default().insert(text.to_owned());
        }
    });
}

/// The last key of a path that is no position.
fn key(path: &[String]) -> &str {
    path.iter().rev().find(|step| !is_position(step)).map_or("", String::as_str)
}

pub fn is_position(step: &str) -> bool {
    step.parse::<usize>().is_ok()
}

/// A change that fits a document: where, how, and what stands there then; `None` is nothing at all.
pub struct Plan {
    path: Vec<String>,
    pub what: String,
    other: Option<Value>,
}

/// The plans of all changes of a document.
pub fn plans(document: &Value, vocabulary: &Vocabulary) -> Vec<Plan> {
    let mut plans = Vec::new();
    walk(document, &mut Vec::new(), &mut |path, value| {
        let plan = |(what, other): (&str, _)| Plan { path: path.to_vec(), what: what.to_owned(), other };
        plans.extend(others(path, value, vocabulary).into_iter().map(plan));
    });
    plans
}

impl Plan {
    /// The path without positions in lists.
    pub fn place(&self) -> String {
        self.path.iter().filter(|step| !is_position(step)).map(String::as_str).collect::<Vec<_>>().join(".")
    }

    /// The path with positions.
    pub fn path(&self) -> &[String] {
        &self.path
    }

    /// The changed document as it stands and, where that is another one, with all that follows told anew.
    pub fn documents(&self, document: &Value, is_told: bool) -> Vec<Value> {
        let mut changed = document.clone();
        match &self.other {
            Some(other) => *changed.pointer_mut(&pointer(&self.path)).unwrap() = other.clone(),
            None => remove(&mut changed, &self.path),
        }
        let told = is_told.then(|| told_anew(&changed)).filter(|told| *told != changed && told != document);
        std::iter::once(changed).chain(told).collect()
    }
}

fn pointer(path: &[String]) -> String {
    path.iter().map(|key| format!("/{key}")).collect()
}

/// Calls a function with each value in a document, and of long lists with some of the items.
fn walk(value: &Value, path: &mut Vec<String>, each: &mut impl FnMut(&[String], &Value)) {
    if !path.is_empty() {
        each(path, value);
    }
    let entries: Vec<(String, &Value)> = match value {
        Value::Object(entries) => entries.iter().map(|(key, value)| (key.clone(), value)).collect(),
        Value::Array(items) => {
            let step = items.len().div_ceil(ITEMS).max(1);
            items.iter().enumerate().step_by(step).map(|(i, item)| (i.to_string(), item)).collect()
        }
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
    match document.pointer_mut(&pointer(outer)).unwrap() {
        Value::Object(entries) => drop(entries.remove(last)),
        Value::Array(items) => drop(items.remove(last.parse().unwrap())),
        _ => unreachable!("what has entries"),
    }
}

/// What may stand in a place instead, with the change in words; `None` leaves the key or the item out.
type Others = Vec<(&'static str, Option<Value>)>;

fn others(path: &[String], value: &Value, vocabulary: &Vocabulary) -> Others {
    let is_item = path.last().is_some_and(|step| is_position(step));
    let mut others: Others = vec![(if is_item { "an item left out" } else { "left out" }, None)];
    let mut put = |what, value| others.push((what, Some(value)));
    match value {
        Value::Null => {
            for value in [json!(true), json!("P2"), json!(["0", "1"]), json!("left"), json!({})] {
                put("told", value);
            }
        }
        Value::Bool(is_so) => {
            put("denied", json!(!is_so));
            put("not told", Value::Null);
        }
        Value::Number(number) => match number.as_i64() {
            Some(n) => COUNTS
                .into_iter()
                .map(|(what, count)| (what, count(n)))
                .filter(|(_, other)| *other >= 0 || n < 0)
                .for_each(|(what, other)| put(what, json!(other))),
            None => {
                let x = number.as_f64().unwrap();
                [x + 0.01, x - 0.01, x + 1.0, x + 2e-6, x - 2e-6, 1.0 - x]
                    .into_iter()
                    .for_each(|other| put("another number", json!(other)));
            }
        },
        Value::Object(entries) => siblings(entries).into_iter().for_each(|(what, value)| put(what, value)),
        Value::Array(items) => match bounds(value) {
            Some(own) => moved(path, &own).into_iter().for_each(|(what, value)| put(what, value)),
            None => lists(items).into_iter().for_each(|(what, value)| put(what, value)),
        },
        Value::String(text) => texts(path, text, vocabulary).into_iter().for_each(|(what, value)| put(what, value)),
    }
    others.retain(|(_, other)| other.as_ref() != Some(value));
    others
}

/// Two bounds of one object exchanged, and each in the place of the other.
fn siblings(entries: &serde_json::Map<String, Value>) -> Vec<(&'static str, Value)> {
    let all: Vec<&String> = entries.iter().filter(|(_, value)| bounds(value).is_some()).map(|(key, _)| key).collect();
    let with = |changes: [(&String, &Value); 2]| {
        let mut copy = entries.clone();
        changes.into_iter().for_each(|(key, value)| copy[key] = value.clone());
        Value::Object(copy)
    };
    let of = |pair: &[&String]| {
        let [a, b] = [pair[0], pair[1]];
        [
            ("two values exchanged", with([(a, &entries[b]), (b, &entries[a])])),
            ("one value twice", with([(a, &entries[b]), (b, &entries[b])])),
            ("one value twice", with([(a, &entries[a]), (b, &entries[a])])),
        ]
    };
    all.windows(2).flat_map(of).collect()
}

/// An item twice, two exchanged, and all from one on left out.
fn lists(items: &[Value]) -> Vec<(&'static str, Value)> {
    let mut all = Vec::new();
    for at in (0..items.len()).step_by(items.len().div_ceil(ITEMS).max(1)) {
        let mut twice = items.to_vec();
        twice.insert(at, items[at].clone());
        all.push(("one twice", json!(twice)));
        all.push(("cut off", json!(items[..at])));
        if at > 0 {
            let mut copy = items.to_vec();
            copy.swap(at - 1, at);
            all.push(("two exchanged", json!(copy)));
        }
    }
    all
}

/// Bounds that are wider, narrower, elsewhere, whole forcing periods later, mirrored, exchanged, at the edge 0, of one digit.
fn moved(path: &[String], [lower, upper]: &[BigRational; 2]) -> Vec<(&'static str, Value)> {
    let (zero, width) = (fraction(0, 1), upper - lower);
    let unit = unit(lower).min(unit(upper));
    let middle = (lower + upper) / fraction(2, 1);
    let by = |by: &BigRational| pair(&(lower + by), &(upper + by));
    let far = &width * fraction(3, 1) + fraction(1, 100) * (fraction(1, 1) + leading(lower));
    let (next, twice, part) = (&width + &unit, &width * fraction(2, 1), lower * fraction(1, 1_000_000));
    let power = leading(lower);
    let (floor, ceil) = ((lower / &power).floor() * &power, (upper / &power).ceil() * &power);
    let mut all = vec![
        ("wider", pair(&(lower - &unit), &(upper + &unit))),
        ("the lower half", pair(lower, &middle)),
        ("the upper half", pair(&middle, upper)),
        ("the lower bound alone", pair(lower, lower)),
        ("the upper bound alone", pair(upper, upper)),
        ("beyond by a unit", by(&next)),
        ("beyond by a unit", by(&-&next)),
        ("two widths away", by(&twice)),
        ("two widths away", by(&-&twice)),
        ("a millionth away", by(&part)),
        ("far away", by(&far)),
        ("far away", by(&-&far)),
        ("exchanged", pair(upper, lower)),
        ("mirrored", pair(&-upper, &-lower)),
        ("ten turns of a phase later", by(&(pi() * fraction(20, 1)))),
        ("half a turn of a phase later", by(&pi())),
        ("two later", by(&fraction(2, 1))),
        ("of one digit", pair(&floor, &floor)),
        ("of one digit", pair(&ceil, &ceil)),
    ];
    if *lower > unit {
        all.push(("from 0 on", pair(&zero, &(lower - &unit))));
    } else if *upper < -&unit {
        all.push(("up to 0", pair(&(upper + &unit), &zero)));
    }
    if path.iter().any(|key| key == "phase") {
        all.push(("a turn earlier", by(&(pi() * fraction(-2, 1)))));
    }
    all
}

/// Other words, numbers, expressions and sentences.
fn texts(path: &[String], text: &str, vocabulary: &Vocabulary) -> Vec<(&'static str, Value)> {
    let known = WORDS.iter().filter(|words| words.contains(&text)).copied().flatten().map(|word| (*word).to_owned());
    let seen = vocabulary.get(key(path)).filter(|words| words.contains(text)).into_iter().flatten().cloned();
    let words: BTreeSet<String> = known.chain(seen).collect();
    let mut all: Vec<(&'static str, String)> = words.into_iter().map(|word| ("another word", word)).collect();
    if Exact::parse(text).is_ok() {
        let value = rational(&json!(text));
        if let Some(value) = &value {
            let (unit, tenth) = (unit(value), leading(value) * fraction(1, 10));
            let moved = [("a unit more", &unit), ("a tenth more", &tenth)].map(|(what, by)| (what, value + by));
            let back = [("a unit less", &unit), ("a tenth less", &tenth)].map(|(what, by)| (what, value - by));
            all.extend(moved.into_iter().chain(back).map(|(what, other)| (what, decimal(&other))));
        }
        // Of 0 a multiple is 0.
        let is_zero = value == Some(fraction(0, 1));
        if !is_zero {
            all.push(("negative", negated(&json!(text)).as_str().unwrap().to_owned()));
        }
        let values = VALUES
            .into_iter()
            .filter(|(what, _)| !is_zero || !what.starts_with("a thousandth part") && *what != "a thousandfold");
        all.extend(values.map(|(what, other)| (what, other.replace("{}", text))));
    } else if text.chars().all(|c| "FN".contains(c)) {
        let swapped = text.chars().map(|c| if c == 'F' { 'N' } else { 'F' }).collect();
        all.extend(
            [swapped, format!("{text}F"), format!("{text}{text}"), text[1..].to_owned()].map(|x| ("flights", x)),
        );
    } else if text.starts_with('P') {
        let parts: Vec<&str> = text.split(' ').collect();
        all.push(("read from the next", [&parts[1..], &parts[..1]].concat().join(" ")));
        all.push(("twice over", format!("{text} {text}")));
    } else if let Some(at) = text.find(|c: char| c.is_ascii_digit()) {
        let digit = (text.as_bytes()[at] - b'0' + 1) % 10;
        all.push(("another digit", format!("{}{digit}{}", &text[..at], &text[at + 1..])));
    }
    all.push(("nothing said", String::new()));
    all.into_iter().map(|(what, text)| (what, json!(text))).collect()
}
