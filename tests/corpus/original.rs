//! True documents, documents that are false, and where they differ.

use std::collections::BTreeSet;

use serde_json::{Value, json};

use super::numbers::bounds;

/// A true document.
#[derive(Clone)]
pub struct Original {
    /// The column of the table.
    pub kind: &'static str,
    pub name: String,
    /// Of JSON Lines a list of the lines.
    pub document: Value,
    pub is_lines: bool,
}

impl Original {
    pub fn new(name: &str, lines: &[Value]) -> Self {
        let is_lines = lines.len() > 1;
        let document = if is_lines { json!(lines) } else { lines[0].clone() };
        Self { kind: kind(&document, is_lines), name: name.to_owned(), document, is_lines }
    }

    /// A document of its kind as it is written.
    pub fn text(&self, document: &Value) -> String {
        match document.as_array().filter(|_| self.is_lines) {
            Some(lines) => lines.iter().map(|line| format!("{line}\n")).collect(),
            None => document.to_string(),
        }
    }

    /// Whether the document is of one of these kinds.
    pub fn is(&self, kinds: &[&str]) -> bool {
        kinds.contains(&self.kind)
    }

    pub fn forged(&self, what: impl Into<String>, document: Value) -> Forged {
        Forged { what: what.into(), document, is_certain: true, false_claims: None }
    }

    /// A forgery with other values at these paths.
    pub fn with(&self, what: impl Into<String>, changes: &[(&str, Value)]) -> Forged {
        self.forged(what, with(&self.document, changes))
    }

    /// The records of its points.
    pub fn points(&self) -> Vec<Value> {
        self.document
            .as_array()
            .filter(|_| self.is(&["sweep", "atlas"]))
            .map_or(Vec::new(), |lines| lines[1..].to_vec())
    }

    /// With other records of its points.
    pub fn with_points(&self, what: impl Into<String>, points: Vec<Value>) -> Forged {
        let lines = std::iter::once(self.document[0].clone()).chain(points).collect();
        self.forged(what, Value::Array(lines))
    }

    /// The name that `check` has for a path: of JSON Lines the first and the last line are the document's own, the others are items.
    pub fn name_of(&self, path: &str) -> String {
        let line = path.strip_prefix('[').filter(|_| self.is_lines).and_then(|path| path.split_once(']'));
        let last = self.document.as_array().map_or(0, Vec::len).wrapping_sub(1);
        let is_orbit = self.document[0]["schema"] == "impact-pair/orbit/1";
        match line.map(|(line, rest)| (line.parse::<usize>().expect("a position"), rest)) {
            Some((line, rest)) if line == 0 || is_orbit && line == last => rest.trim_start_matches('.').to_owned(),
            Some((line, rest)) => format!("{}[{}]{rest}", if is_orbit { "events" } else { "points" }, line - 1),
            None => path.to_owned(),
        }
    }

    /// The outcome's word; none where it is no orbit.
    pub fn outcome(&self) -> &str {
        self.document["outcome"]["kind"].as_str().unwrap_or("")
    }

    pub fn events(&self) -> &[Value] {
        self.document["events"].as_array().map_or(&[], Vec::as_slice)
    }
}

/// The kind of a document: a column of the table.
fn kind(document: &Value, is_lines: bool) -> &'static str {
    let head = if is_lines { &document[0] } else { document };
    match head["schema"].as_str().and_then(|schema| schema.split('/').nth(1)) {
        Some("orbit") if is_lines => "lines",
        Some("orbit") if head["claim"] == "shadowed" => "shadow",
        Some("orbit") => "orbit",
        Some("periodic") if head["solved_for"].is_string() => "two-impact",
        Some("periodic") => "periodic",
        Some("chaos") if head["hyperbolic"].is_object() => "hyperbolic",
        Some(own) => KINDS.into_iter().find(|kind| *kind == own).unwrap_or_else(|| panic!("a document of kind {own}")),
        None => "list",
    }
}

/// Kinds of documents, in the order of the table.
pub const KINDS: [&str; 18] = [
    "orbit",
    "lines",
    "shadow",
    "periodic",
    "two-impact",
    "bifurcations",
    "cycles",
    "windows",
    "global",
    "tangency",
    "trap",
    "chaos",
    "chaos-cells",
    "hyperbolic",
    "description",
    "sweep",
    "atlas",
    "list",
];

/// A document that is false.
pub struct Forged {
    /// The forgery in words.
    pub what: String,
    pub document: Value,
    /// True if it is false by construction; if not, what is confirmed is computed anew.
    pub is_certain: bool,
    /// The paths of the claims that are false; without them all that are changed.
    pub false_claims: Option<Vec<String>>,
}

impl Forged {
    pub fn probably(self) -> Self {
        Self { is_certain: false, ..self }
    }

    pub fn at(self, paths: &[&str]) -> Self {
        Self { false_claims: Some(paths.iter().map(|path| (*path).to_owned()).collect()), ..self }
    }
}

/// A way to make a document false.
pub struct Forgery {
    pub name: &'static str,
    /// The reason why the documents that it makes are false.
    pub why: &'static str,
    pub forge: fn(&Original) -> Vec<Forged>,
}

/// A document with other values at these paths; those that are not there yet are added.
pub fn with(document: &Value, changes: &[(&str, Value)]) -> Value {
    let mut copy = document.clone();
    for (path, value) in changes {
        let (outer, key) = path.rsplit_once('/').unwrap();
        match copy.pointer_mut(outer).unwrap_or_else(|| panic!("{path}")) {
            Value::Array(items) => items[key.parse::<usize>().unwrap()] = value.clone(),
            outer => outer[key] = value.clone(),
        }
    }
    copy
}

/// Paths in `a.b[0].c` notation where two documents differ.
pub fn changed(of: &Value, document: &Value) -> Vec<String> {
    let mut paths = Vec::new();
    compare(of, document, "", &mut paths);
    paths
}

fn compare(one: &Value, other: &Value, path: &str, paths: &mut Vec<String>) {
    match (one, other) {
        (Value::Object(one), Value::Object(other)) => {
            let keys = one.keys().chain(other.keys().filter(|key| !one.contains_key(*key)));
            for key in keys {
                let inner = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                compare(one.get(key).unwrap_or(&Value::Null), other.get(key).unwrap_or(&Value::Null), &inner, paths);
            }
        }
        (Value::Array(one), Value::Array(other)) if one.len() == other.len() => {
            for (i, (one, other)) in one.iter().zip(other).enumerate() {
                compare(one, other, &format!("{path}[{i}]"), paths);
            }
        }
        _ if one == other => {}
        _ => paths.push(path.to_owned()),
    }
}

/// Whether a document differs in bounds alone, which hold those that another one has: it claims less.
pub fn is_wider(of: &Value, document: &Value) -> bool {
    let list = |path: String| path.rsplit_once('[').map_or(path.clone(), |(list, _)| list.to_owned());
    let lists: BTreeSet<String> = changed(of, document).into_iter().map(list).collect();
    lists.iter().all(|path| {
        let pointer = format!("/{path}").replace("/[", "/").replace(['[', '.'], "/").replace(']', "");
        let [own, other] = [of, document].map(|document| document.pointer(&pointer).and_then(bounds));
        let is_datum =
            ["scene", "over", "values"].iter().any(|key| path.split(['.', '[', ']']).any(|step| step == *key));
        !is_datum && own.zip(other).is_some_and(|([a, b], [low, high])| low <= a && b <= high)
    })
}

/// Whether each path is unchecked, or lies in an unchecked path; a list may be named without positions.
pub fn are_named(paths: &[String], unjudged: &[String]) -> bool {
    let covers = |key: &[String], path: &[String]| {
        let mut path = path.iter();
        key.iter().all(|part| {
            path.by_ref().find(|other| *other == part || !is_position(other)).is_some_and(|other| other == part)
        })
    };
    let unjudged: Vec<_> = unjudged.iter().map(|key| parts(key)).collect();
    paths.iter().map(|path| parts(path)).all(|path| unjudged.iter().any(|key| covers(key, &path)))
}

fn parts(path: &str) -> Vec<String> {
    path.replace('[', ".[").split('.').filter(|part| !part.is_empty()).map(str::to_owned).collect()
}

fn is_position(part: &str) -> bool {
    part.starts_with('[')
}
