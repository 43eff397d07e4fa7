//! Layout of documents: one entry per line, and in long lists one item per line.

use std::io::{self, Write};

use serde::Serialize;
use serde_json::{Map, Value};

use super::orbit::{EventDocument, OrbitHead};
use super::outcome::OutcomeDocument;

/// Returns a document as text, one entry per line; in the lists with these names, one item per line.
///
/// # Panics
/// If the document is not a struct: never for those of this crate.
///
/// # Examples
/// ```
/// use impact_pair_document::one_a_line;
///
/// #[derive(serde::Serialize)]
/// struct Found {
///     schema: &'static str,
///     orbits: Vec<u32>,
/// }
/// let text = one_a_line(&Found { schema: "mine/1", orbits: vec![12, 20] }, &["orbits"]);
/// assert_eq!(text, "{\"schema\":\"mine/1\",\n \"orbits\":[\n  12,\n  20]}");
/// ```
pub fn one_a_line(document: &impl Serialize, lists: &[&str]) -> String {
    let Ok(Value::Object(entries)) = serde_json::to_value(document) else { panic!("a document is an object") };
    format!("{{{}}}", broken(&entries, lists).join(",\n "))
}

/// The entries of an object, their lists of these names an item a line.
fn broken(entries: &Map<String, Value>, lists: &[&str]) -> Vec<String> {
    let item = |item: &Value| match item {
        Value::Object(entries) => format!("{{{}}}", broken(entries, lists).join(",")),
        other => other.to_string(),
    };
    let entry = |(key, value): (&String, &Value)| match value {
        Value::Array(items) if lists.contains(&key.as_str()) && !items.is_empty() => {
            format!("\"{key}\":[\n  {}]", items.iter().map(item).collect::<Vec<_>>().join(",\n  "))
        }
        value => format!("\"{key}\":{value}"),
    };
    entries.iter().map(entry).collect()
}

/// Writes the orbit JSON, one entry or event per line, as the events arrive.
///
/// # Errors
/// Those of `out`.
pub fn write_orbit(
    out: &mut impl Write,
    head: &OrbitHead,
    outcome: &OutcomeDocument,
    events: impl Iterator<Item = EventDocument>,
) -> io::Result<()> {
    let head = one_a_line(head, &[]);
    let head = head.strip_suffix('}').expect("an object");
    write!(out, "{head},\n \"outcome\":{},\n \"events\":[", serde_json::to_string(outcome)?)?;
    for (i, event) in events.enumerate() {
        write!(out, "{}\n  {}", if i == 0 { "" } else { "," }, serde_json::to_string(&event)?)?;
    }
    out.write_all(b"]}\n")
}
