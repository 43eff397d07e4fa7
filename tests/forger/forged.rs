//! Documents that are false, what of them is, and decimals.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Pow, Signed};
use serde_json::{Value, json};

/// A true document.
#[derive(Clone)]
pub struct Original {
    /// The column of the table.
    pub kind: &'static str,
    pub name: String,
    /// The lines of a sweep are a list.
    pub document: Value,
}

impl Original {
    pub fn new(kind: &'static str, name: &str, document: Value) -> Self {
        Self { kind, name: name.to_owned(), document }
    }

    /// A document of its kind as it is written.
    pub fn text(&self, document: &Value) -> String {
        match document.as_array().filter(|_| self.is(&["sweep", "atlas"])) {
            Some(lines) => lines.iter().map(Value::to_string).collect::<Vec<_>>().join("\n"),
            None => document.to_string(),
        }
    }

    /// Whether the document is of one of these kinds.
    pub fn is(&self, kinds: &[&str]) -> bool {
        kinds.contains(&self.kind)
    }

    pub fn forged(&self, what: impl Into<String>, document: Value) -> Forged {
        let (what, of) = (what.into(), self.document.clone());
        Forged { what, document, of, is_certain: true, false_claims: None }
    }

    /// A forgery with other values at these paths.
    pub fn with(&self, what: impl Into<String>, changes: &[(&str, Value)]) -> Forged {
        self.forged(what, with(&self.document, changes))
    }

    /// The records of its points, of a document of this kind.
    pub fn points(&self, kind: &str) -> Vec<Value> {
        self.document.as_array().filter(|_| self.kind == kind).map_or(Vec::new(), |lines| lines[1..].to_vec())
    }

    /// With other records of its points.
    pub fn with_points(&self, what: impl Into<String>, points: Vec<Value>) -> Forged {
        let lines = std::iter::once(self.document[0].clone()).chain(points).collect();
        self.forged(what, Value::Array(lines))
    }

    /// The name that `check` has for a path: the first line of a sweep is its head, the others are its points.
    pub fn name_of(&self, path: &str) -> String {
        let line =
            path.strip_prefix('[').filter(|_| self.is(&["sweep", "atlas"])).and_then(|path| path.split_once(']'));
        match line.map(|(line, rest)| (line.parse::<usize>().expect("a position"), rest)) {
            Some((0, rest)) => rest.trim_start_matches('.').to_owned(),
            Some((line, rest)) => format!("points[{}]{rest}", line - 1),
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

/// A document that is false.
pub struct Forged {
    /// The forgery in words.
    pub what: String,
    pub document: Value,
    /// The document that it differs from least.
    pub of: Value,
    /// True if it is false by construction; if not, what is confirmed is computed anew.
    pub is_certain: bool,
    /// The paths of the claims that are false; without them all that are changed.
    pub false_claims: Option<Vec<String>>,
}

/// The path of the document itself, which is covered by no name of an unchecked value.
pub const DOCUMENT_ROOT: &str = "";

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

impl Forgery {
    /// All that it makes of a document; in a list, of the last one.
    pub fn of(&self, original: &Original) -> Vec<Forged> {
        let Some((last, others)) =
            original.document.as_array().filter(|_| original.kind == "list").and_then(|all| all.split_last())
        else {
            return (self.forge)(original);
        };
        let kind = if last["schema"] == "impact-pair/orbit/1" { "orbit" } else { "periodic" };
        let listed = |document: Value| Value::Array(others.iter().cloned().chain([document]).collect());
        let within = |forged: Forged| Forged {
            document: listed(forged.document),
            of: listed(forged.of),
            false_claims: forged
                .false_claims
                .map(|paths| paths.iter().map(|path| format!("[{}].{path}", others.len())).collect()),
            ..forged
        };
        (self.forge)(&Original::new(kind, &original.name, last.clone())).into_iter().map(within).collect()
    }
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

/// Calls a function with each value in a document and its pointer.
pub fn walk(value: &Value, path: &mut String, each: &mut impl FnMut(&str, &Value)) {
    each(path, value);
    let inner: Vec<(String, &Value)> = match value {
        Value::Object(entries) => entries.iter().map(|(key, value)| (key.clone(), value)).collect(),
        Value::Array(items) => items.iter().enumerate().map(|(k, item)| (k.to_string(), item)).collect(),
        _ => Vec::new(),
    };
    for (key, value) in inner {
        let length = path.len();
        path.push('/');
        path.push_str(&key);
        walk(value, path, each);
        path.truncate(length);
    }
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

/// The value of a decimal or of another exact expression that is rational.
pub fn rational(text: &Value) -> Option<BigRational> {
    impact_pair::exact::Exact::parse(text.as_str()?).ok()?.as_rational().cloned()
}

/// Two decimals in order, or not.
pub fn bounds(pair: &Value) -> Option<[BigRational; 2]> {
    let [lower, upper] = pair.as_array()?.as_slice() else { return None };
    Some([rational(lower)?, rational(upper)?])
}

/// A decimal of 80 places, rounded down.
pub fn decimal(x: &BigRational) -> String {
    let places = BigRational::from_integer(Pow::pow(BigInt::from(10), 80u32));
    format!("{}e-80", (x * places).floor().to_integer())
}

pub fn pair(lower: &BigRational, upper: &BigRational) -> Value {
    json!([decimal(lower), decimal(upper)])
}

/// A rational of small numbers.
pub fn fraction(numerator: i64, denominator: i64) -> BigRational {
    BigRational::new(numerator.into(), denominator.into())
}

/// An expression with the sign changed; of a decimal a decimal.
pub fn negated(text: &Value) -> Value {
    let text = text.as_str().unwrap();
    let is_decimal = text.parse::<f64>().is_ok();
    json!(match text.strip_prefix('-') {
        Some(rest) if is_decimal => rest.to_owned(),
        None if is_decimal => format!("-{text}"),
        _ => format!("-({text})"),
    })
}

/// The power of ten of a number's first digit.
pub fn magnitude(x: &BigRational) -> i32 {
    let ten = fraction(10, 1);
    let (mut size, mut power) = (x.abs(), 0);
    if size == fraction(0, 1) {
        return 0;
    }
    while size >= ten {
        (size, power) = (size / &ten, power + 1);
    }
    while size < fraction(1, 1) {
        (size, power) = (size * &ten, power - 1);
    }
    power
}
